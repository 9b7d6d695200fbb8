#!/usr/bin/env python3
"""Writes the two tables of docs/fig09.md anew from results.csv, in place; the rest of the page stays as it is.

  /usr/bin/python3 studies/fig09/tables.py
"""
import csv
import os
import statistics

import run as study

PAGE = os.path.join(study.ROOT, "docs", "fig09.md")
PAPER = {"gentle": 2040, "bumpy": 2560, "steep": 3700}  # dense particles at the end (Sec. 5.1)
SEEDS_HEADER = "| slope | angle | paper | mean |"
FACTORS_HEADER = "| factor | dense particles |"
QUANTITIES = [("n_dense", "{:,.0f}"), ("front_speed_max_m_s", "{:.1f}"), ("cloud_height_max_m", "{:.1f}"),
              ("head_ratio", "{:.1f}"), ("smoke_kg", "{:,.0f}")]


def extent(values, text, unit=""):
    """The least and the most, once where they read alike."""
    low, high = text.format(min(values)), text.format(max(values))
    return (low if low == high else f"{low} to {high}") + unit


def seed_rows(rows):
    """Rows of the first table: the chosen set over its seeds."""
    for slope, paper in PAPER.items():
        runs = [row for row in rows if row["factor"] == "chosen" and row["slope"] == slope]
        counts = [float(row["n_dense"]) for row in runs]
        mean = statistics.mean(counts)
        of = {key: [float(row[key]) for row in runs] for key, _ in QUANTITIES[1:4]}
        smoking = [100 * float(row["smoking_share"]) for row in runs]
        yield [slope, f"{study.ANGLES[slope]} deg", f"{paper:,}", f"{mean:,.0f}",
               f"{100 * (mean / paper - 1):+.0f} %".replace("-", "−"), f"{min(counts):,.0f}", f"{max(counts):,.0f}",
               f"{0.75 * paper:,.0f} to {1.25 * paper:,.0f}", extent(of["front_speed_max_m_s"], "{:.1f}"),
               extent(of["cloud_height_max_m"], "{:.1f}"), extent(of["head_ratio"], "{:.1f}"),
               extent(smoking, "{:.0f}", " %")]


def variations():
    """Label of each row of the second table, and the value on each slope of the factor that it is about."""
    yield "chosen", "chosen", dict.fromkeys(PAPER, "")
    for change in (-4, 4):
        yield f"slope angles {change:+d} deg", "angle", {s: str(a + change) for s, a in study.ANGLES.items()}
    for stop in study.STOP_TIMES:
        if stop != study.STOP:
            yield f"stop time {stop:g} s", "stop_time", dict.fromkeys(PAPER, str(stop))
    for factor, (key, unit, values, _) in study.FACTORS.items():
        name = key if key.startswith(("cover", "entrainment.rate")) else key.split(".", 1)[1]
        name = name.replace("entrainment.", "", 1) if name == "entrainment.friction_strain" else name
        for value in values:
            yield f"`{name}` {value} {unit.replace('^', '')}".rstrip(), factor, dict.fromkeys(PAPER, str(value))


def factor_rows(rows):
    """Rows of the second table: one factor changed at a time, first seed, gentle / bumpy / steep."""
    first = rows[0]["seed"]
    for label, factor, values in variations():
        runs = [next(row for row in rows if row["slope"] == slope and row["factor"] == factor and row["seed"] == first
                     and row["value"] == value) for slope, value in values.items()]
        yield [label] + [" / ".join(text.format(float(row[key])) for row in runs) for key, text in QUANTITIES]


def with_table(lines, header, rows):
    """The page's lines with the rows below `header` and its rule replaced."""
    start = next(i for i, line in enumerate(lines) if line.startswith(header)) + 2
    end = next(i for i in range(start, len(lines)) if not lines[i].startswith("|"))
    return lines[:start] + ["| " + " | ".join(row) + " |" for row in rows] + lines[end:]


def main():
    with open(os.path.join(study.HERE, "results.csv")) as file:
        rows = list(csv.DictReader(file))
    with open(PAGE) as file:
        lines = file.read().split("\n")
    lines = with_table(lines, SEEDS_HEADER, seed_rows(rows))
    lines = with_table(lines, FACTORS_HEADER, factor_rows(rows))
    with open(PAGE, "w") as file:
        file.write("\n".join(lines))


if __name__ == "__main__":
    main()
