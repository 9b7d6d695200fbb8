#!/usr/bin/env python3
"""Numbers of docs/real.md from a run's frames of particles.

    spindrift export RUN --to csv -o FOLDER
    python3 studies/real/measure.py FOLDER

Lengths in metres, speeds in m/s. The deposit is the moving snow of the last frame; its far end, and the front's
speed, leave out the hundredth that is farthest or fastest: single particles fly ahead.
"""
import csv
import math
import pathlib
import sys


def snow(path):
    """Rows (x, y, z, mass, density, speed, entrained) of the dense flow's particles."""
    rows = []
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            if row["layer"] != "0":
                continue
            speed = math.hypot(*(float(row[f"velocity_{k} [m/s]"]) for k in "xyz"))
            rows.append((*(float(row[f"{k} [m]"]) for k in "xyz"), float(row["mass [kg]"]),
                         float(row["density [kg/m^3]"]), speed, float(row["entrained_at [s]"]) >= 0))
    return rows


def percentile(values, share):
    ordered = sorted(values)
    return ordered[int(share * (len(ordered) - 1))]


def main(folder):
    frames = sorted(pathlib.Path(folder).glob("particles_*.csv"))
    start, end = snow(frames[0]), snow(frames[-1])
    top = max(start, key=lambda p: p[2])
    lowest = min(p[2] for p in end)
    way = lambda p: math.hypot(p[0] - top[0], p[1] - top[1])
    reach = percentile([way(p) for p in end], 0.99)
    far = min(end, key=lambda p: abs(way(p) - reach))
    fall = top[2] - far[2]
    fastest = max(percentile([p[5] for p in snow(frame)], 0.99) for frame in frames)
    bins = {}
    size = 20
    for x, y, _, mass, density, *_ in end:
        key = (math.floor(x / size), math.floor(y / size))
        bins[key] = bins.get(key, 0) + mass / density / size**2
    print(f"released {sum(p[3] for p in start) / 1e3:.0f} t, at the end {sum(p[3] for p in end) / 1e3:.0f} t, of it "
          f"entrained {sum(p[3] for p in end if p[6]) / 1e3:.0f} t")
    print(f"still faster than 1 m/s: {100 * sum(p[5] > 1 for p in end) / len(end):.1f} %")
    print(f"reach in plan {reach:.0f}, fall {fall:.0f}, energy line {math.degrees(math.atan2(fall, reach)):.1f} deg")
    print(f"front at most {fastest:.0f}; sqrt(g H / 2) of the whole fall {math.sqrt(9.81 * (top[2] - lowest) / 2):.0f}")
    print(f"deposit in squares of {size}: {len(bins) * size**2} m^2, mean {sum(bins.values()) / len(bins):.2f}, most "
          f"{max(bins.values()):.2f}")


if __name__ == "__main__":
    main(sys.argv[1])
