#!/usr/bin/env python3
"""Draws the pictures of the Fig. 9 study into docs/pictures (needs numpy, matplotlib and Pillow).

From results.csv: fig09_seeds.png, fig09_counts.png, fig09_look.png. From the previews of the chosen set's first seed
(written by run.py): fig09_slopes.png; it is left out where they are missing.
"""
import argparse
import csv
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from PIL import Image, ImageDraw, ImageFont  # noqa: E402

import run as study  # noqa: E402

PAPER = {"gentle": 2040, "bumpy": 2560, "steep": 3700}  # dense particles at the end (Sec. 5.1)
COLOURS = {"gentle": "#1b7837", "bumpy": "#2166ac", "steep": "#b2182b"}
TITLES = {
    "angle": "slope angle, change [deg]", "stop_time": "stop time [s]", "friction_mu": "friction, mu",
    "friction_xi": "friction, xi [m/s²]", "friction_acts_on": "friction acts on", "cover_depth": "cover depth [m]",
    "entrainment_rate": "entrainment rate [kg/m²/s]", "friction_strain": "factor on gamma_f",
    "compaction_time": "compaction time [s]", "generation": "generation constant C_g",
}
LOGARITHMIC = {"friction_xi", "entrainment_rate", "generation"}
EVENLY = {"friction_strain", "compaction_time"}  # spaced evenly: 0 is among the values
TIMES = [3.0, 6.0, 9.0]      # of the contact sheet [s]
PIXELS_PER_METRE = 1380 / 227.7
CROP = (0, 0, 720, 480)      # of a preview [pixels]: the left 119 m
TILE = (480, 320)            # of the contact sheet [pixels]


def read_results():
    """The rows of results.csv, numbers as numbers."""
    with open(os.path.join(study.HERE, "results.csv")) as file:
        return [{key: number_or_text(text) for key, text in row.items()} for row in csv.DictReader(file)]


def number_or_text(text):
    """The number that a text stands for, or the text."""
    try:
        return float(text)
    except ValueError:
        return text


def chosen(rows, slope, quantity):
    """The values of the chosen set, one a seed."""
    return [row[quantity] for row in rows if row["factor"] == "chosen" and row["slope"] == slope]


def curve(rows, factor, slope, quantity):
    """Values of a factor, ascending, and a quantity at them, the chosen one among them (first seed)."""
    here = {row["value"]: row[quantity] for row in rows if row["factor"] == factor and row["slope"] == slope}
    base = chosen(rows, slope, quantity)[0]
    if factor == "angle":
        here = {value - study.ANGLES[slope]: count for value, count in here.items()}
        here[0] = base
    elif factor in study.FACTORS:
        here[study.FACTORS[factor][3]] = base
    values = [v for v in ("column", "base", "none") if v in here] if factor == "friction_acts_on" else sorted(here)
    return values, [here[value] for value in values]


def draw_panel(axes, rows, factor, quantity):
    """One factor: three curves, the paper's counts dashed, the seeds' range as a band."""
    for slope in study.SLOPES:
        values, counts = curve(rows, factor, slope, quantity)
        axes.plot(range(len(values)) if factor in EVENLY else values, counts, "o-", ms=4,
                  color=COLOURS[slope], label=slope)
        if factor in EVENLY:
            axes.set_xticks(range(len(values)), [f"{value:g}" for value in values])
        seeds = chosen(rows, slope, quantity)
        axes.axhspan(min(seeds), max(seeds), color=COLOURS[slope], alpha=0.15, lw=0)
        if quantity == "n_dense":
            axes.axhline(PAPER[slope], color=COLOURS[slope], ls="--", lw=1)
    if factor in LOGARITHMIC:
        axes.set_xscale("log")
        axes.set_xticks(values, [f"{value:g}" for value in values], minor=False)
        axes.minorticks_off()
    elif factor != "friction_acts_on" and factor not in EVENLY:
        axes.set_xticks(values, [f"{value:g}" for value in values])
    axes.set_title(TITLES[factor], fontsize=9)
    axes.tick_params(labelsize=8)
    axes.grid(alpha=0.25)


def draw_factors(rows, quantity, title, path, limits=None):
    """A small panel a factor, all on one scale."""
    factors = [factor for factor in TITLES if any(row["factor"] == factor for row in rows)]
    figure, panels = plt.subplots(2, 5, figsize=(13, 5.6), sharey=True)
    for axes, factor in zip(panels.flat, factors):
        draw_panel(axes, rows, factor, quantity)
    for axes in panels.flat[len(factors):]:
        axes.axis("off")
    if limits:
        panels.flat[0].set_ylim(*limits)
    handles, labels = panels.flat[0].get_legend_handles_labels()
    figure.suptitle(title, fontsize=11)
    figure.legend(handles, labels, loc="lower center", ncol=3, frameon=False, fontsize=9)
    figure.tight_layout(rect=(0, 0.05, 1, 1))
    figure.savefig(path, dpi=100)
    plt.close(figure)


def draw_seeds(rows, path):
    """The chosen set: each seed, its mean, the paper's count and 25 % about it."""
    figure, axes = plt.subplots(figsize=(6, 4))
    for place, slope in enumerate(study.SLOPES):
        counts, paper = chosen(rows, slope, "n_dense"), PAPER[slope]
        axes.bar(place, 0.5 * paper, bottom=0.75 * paper, width=0.7, color="0.9", zorder=0,
                 label="paper, 25 % about it" if place == 0 else None)
        axes.hlines(paper, place - 0.35, place + 0.35, color="0.3", ls="--", label="paper" if place == 0 else None)
        spread = [place + 0.06 * (seed - (len(counts) - 1) / 2) for seed in range(len(counts))]
        axes.plot(spread, counts, "o", ms=4, color=COLOURS[slope], label="one seed" if place == 0 else None)
        mean = sum(counts) / len(counts)
        axes.hlines(mean, place - 0.2, place + 0.2, color=COLOURS[slope])
        axes.text(place + 0.23, mean, f"{mean:,.0f}", va="center", fontsize=9, color=COLOURS[slope])
    axes.set_xticks(range(3), [f"{slope}\n{study.ANGLES[slope]}°" for slope in study.SLOPES])
    axes.set_ylim(0, 5000)
    axes.set_ylabel(f"dense particles after {study.STOP:g} s")
    axes.legend(loc="upper left", fontsize=9)
    figure.tight_layout()
    figure.savefig(path, dpi=100)
    plt.close(figure)


def preview_at(runs, slope, seed, time):
    """The preview of a chosen run at a time [s], cropped and shrunk; None where there is none."""
    name = study.Case(slope, "chosen", "", seed).name
    frame = round(time * study.FRAMES_PER_SECOND)
    path = os.path.join(runs, name, "preview", f"{frame:06d}.png")
    if not os.path.exists(path):
        return None
    return Image.open(path).convert("RGB").crop(CROP).resize(TILE, Image.LANCZOS)


def draw_slopes(runs, seed, path):
    """Contact sheet: a row a slope, a column a time. Returns whether the previews were there."""
    gap = 6
    sheet = Image.new("RGB", (len(TIMES) * (TILE[0] + gap) - gap, len(study.SLOPES) * (TILE[1] + gap) - gap), "white")
    draw = ImageDraw.Draw(sheet)
    font = ImageFont.truetype(os.path.join(matplotlib.get_data_path(), "fonts", "ttf", "DejaVuSans.ttf"), 17)
    for row, slope in enumerate(study.SLOPES):
        for column, time in enumerate(TIMES):
            tile = preview_at(runs, slope, seed, time)
            if tile is None:
                return False
            x, y = column * (TILE[0] + gap), row * (TILE[1] + gap)
            sheet.paste(tile, (x, y))
            draw.text((x + TILE[0] - 12, y + 10), f"{slope}, {study.ANGLES[slope]}°", "white", font, "ra")
    bar = 20 * PIXELS_PER_METRE * TILE[0] / (CROP[2] - CROP[0])
    right, low = sheet.width - 14, sheet.height - 16
    draw.line((right - bar, low, right, low), "white", 3)
    draw.text((right - bar / 2, low - 6), "20 m", "white", font, "ms")
    sheet.quantize(192, Image.Quantize.MEDIANCUT, dither=Image.Dither.FLOYDSTEINBERG).save(path, optimize=True)
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", default=os.path.join(study.ROOT, "runs", "fig09"), metavar="DIR",
                        help="the run folders of run.py (default: runs/fig09)")
    parser.add_argument("--out", default=os.path.join(study.ROOT, "docs", "pictures"), metavar="DIR",
                        help="where the pictures go (default: docs/pictures)")
    options = parser.parse_args()
    rows = read_results()
    seed = int(next(row["seed"] for row in rows if row["factor"] == "chosen"))
    draw_seeds(rows, os.path.join(options.out, "fig09_seeds.png"))
    draw_factors(rows, "n_dense", "Dense particles at the end, one factor at a time. Dashed: the paper. "
                 "Bands: range of the seeds at the chosen set", os.path.join(options.out, "fig09_counts.png"))
    draw_factors(rows, "head_ratio", "Head ratio: median of cloud depth over flow depth within 20 m behind the front "
                 "(smoking from 2)", os.path.join(options.out, "fig09_look.png"), (0, None))
    if not draw_slopes(options.runs, seed, os.path.join(options.out, "fig09_slopes.png")):
        print("no previews of the chosen set: fig09_slopes.png is left out", file=sys.stderr)


if __name__ == "__main__":
    main()
