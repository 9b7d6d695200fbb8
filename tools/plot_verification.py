"""Draws what `spindrift verify` measured.

    python3 tools/plot_verification.py cases DIR        error against seconds, DIR/CASE.png from DIR/points.csv
    python3 tools/plot_verification.py refinement DIR   the same for a scene of one's own, from DIR/refinement.csv
    python3 tools/plot_verification.py stability DIR    the stability map, DIR/stability.png from DIR/stability.csv

`spindrift verify` calls it. Needs matplotlib.
"""

import csv
import itertools
import math
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")  # a file, no window
    import matplotlib.pyplot as plt
except ModuleNotFoundError as missing:
    sys.exit(f"{missing}; ./dev extras installs it for Debian's /usr/bin/python3")

COLOURS = plt.get_cmap("tab10").colors
MARKERS = "osD^vP*Xhd"


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def groups(rows, *keys):
    """Consecutive rows with the same values of the keys."""
    return itertools.groupby(rows, key=lambda row: tuple(row[key] for key in keys))


SMALLEST = 1e-16  # errors below are drawn there


def usable(rows):
    """The points that a logarithmic diagram can show."""
    found = [row for row in rows if not row["failure"] and float(row["error_l2"]) < math.inf and float(row["seconds"]) > 0]
    for row in found:
        row["error_l2"] = max(float(row["error_l2"]), SMALLEST)
    return found


def work_precision(axes, curves):
    """One curve a series: error against seconds, both logarithmic."""
    for number, (label, rows) in enumerate(curves):
        rows = usable(rows)
        if not rows:
            continue
        style = dict(color=COLOURS[number % 10], marker=MARKERS[number % 10])
        axes.plot([float(r["seconds"]) for r in rows], [float(r["error_l2"]) for r in rows], label=label,
                  lw=2.2 if number == 0 else 1.2, ms=6, zorder=3 if number == 0 else 2, **style)
        if len(rows) > 1:
            for row in (rows[0], rows[-1]):
                axes.annotate(row["level"], (float(row["seconds"]), float(row["error_l2"])), fontsize=7,
                              xytext=(4, 4), textcoords="offset points", color=style["color"])
    axes.set_xscale("log")
    axes.set_yscale("log")
    low, high = axes.get_ylim()
    for level, name in ((0.05, "5 %"), (0.01, "1 %")):
        if low < level < high:
            axes.axhline(level, color="0.6", lw=0.8, ls=":")
            axes.text(1, level, name, transform=axes.get_yaxis_transform(), fontsize=7, color="0.4", ha="right")
    axes.grid(True, which="major", color="0.9")
    axes.set_xlabel("run time [s]")


def draw_cases(folder):
    for (name,), rows in groups(rows_of(folder / "points.csv"), "case"):
        rows = list(rows)
        curves = [(f"{factor}: {series}", list(points))
                  for (factor, series), points in groups(rows, "factor", "series")]
        figure, axes = plt.subplots(figsize=(7.2, 4.6))
        work_precision(axes, curves)
        gate = [float(row["gate"]) for row in curves[0][1]][-1]
        if math.isfinite(gate):
            axes.axhline(gate, color="tab:red", lw=0.8, ls="--")
            axes.text(0, gate, " gate, finest level", transform=axes.get_yaxis_transform(), fontsize=7,
                      color="tab:red", va="bottom")
        axes.set_ylabel("relative L2 error")
        axes.set_title(name)
        axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False)
        figure.savefig(folder / f"{name}.png", dpi=100, bbox_inches="tight")
        plt.close(figure)


def draw_refinement(folder):
    rows = rows_of(folder / "refinement.csv")
    names = list(dict.fromkeys(row["quantity"] for row in rows))
    columns = min(3, len(names))
    figure, all_axes = plt.subplots(-(-len(names) // columns), columns, squeeze=False,
                                    figsize=(4.2 * columns, 3.6 * -(-len(names) // columns)))
    for axes, name in itertools.zip_longest(all_axes.flat, names):
        if name is None:
            axes.set_axis_off()
            continue
        mine = sorted((row for row in rows if row["quantity"] == name), key=lambda row: row["order"])
        work_precision(axes, [(factor, list(points)) for (factor,), points in groups(mine, "factor")])
        axes.set_title(name, fontsize=9)
        axes.set_ylabel("relative error", fontsize=8)
    all_axes.flat[0].legend(fontsize=7, frameon=False)
    figure.tight_layout()
    figure.savefig(folder / "refinement.png", dpi=100)


def draw_stability(folder):
    points = [row for row in rows_of(folder / "stability.csv") if row["set"] == "map"]
    if not points:
        return
    names = list(points[0])[list(points[0]).index("reason") + 1:]
    kinds = (("passed", "o", "tab:blue"), ("stopped", "s", "tab:orange"), ("refused", "D", "0.5"),
             ("failed", "X", "tab:red"))
    n = len(names)
    figure, all_axes = plt.subplots(n - 1, n - 1, figsize=(1.9 * (n - 1), 1.8 * (n - 1)), squeeze=False)
    for row in range(1, n):
        for column in range(n - 1):
            axes = all_axes[row - 1][column]
            if column >= row:
                axes.set_axis_off()
                continue
            for kind, marker, colour in kinds:
                for beyond in ("0", "1"):
                    mine = [p for p in points if p["verdict"] == kind and p["beyond"] == beyond]
                    axes.scatter([float(p[names[column]]) for p in mine], [float(p[names[row]]) for p in mine], s=9,
                                 marker=marker, facecolors=colour if beyond == "0" else "none", edgecolors=colour,
                                 linewidths=0.7, zorder=3 if kind != "passed" else 2)
            for name, scale in ((names[column], axes.set_xscale), (names[row], axes.set_yscale)):
                if "[deg]" not in name:
                    scale("log")
            axes.tick_params(labelsize=5)
            axes.minorticks_off()
            if row == n - 1:
                axes.set_xlabel(names[column], fontsize=7)
            if column == 0:
                axes.set_ylabel(names[row], fontsize=7)
    handles = [plt.Line2D([], [], ls="", marker=m, color=c, label=k) for k, m, c in kinds]
    handles.append(plt.Line2D([], [], ls="", marker="o", mfc="none", color="0.3", label="hollow: beyond the documented range"))
    figure.legend(handles=handles, loc="upper right", bbox_to_anchor=(0.95, 0.9), fontsize=10, frameon=False)
    figure.tight_layout()
    figure.savefig(folder / "stability.png", dpi=80)


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in ("cases", "refinement", "stability"):
        sys.exit(__doc__.strip())
    {"cases": draw_cases, "refinement": draw_refinement, "stability": draw_stability}[sys.argv[1]](
        pathlib.Path(sys.argv[2]))
