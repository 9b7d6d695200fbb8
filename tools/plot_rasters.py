"""Draws the maps of a 3D run of Spindrift, peaks/*.asc of its folder, on one page.

    python3 tools/plot_rasters.py runs/slope_3d [-o OUT.png]

Needs numpy and matplotlib.
"""

import argparse
import sys
from pathlib import Path

try:
    import matplotlib

    matplotlib.use("Agg")  # a file, no window
    import matplotlib.pyplot as plt
    import numpy as np
except ModuleNotFoundError as missing:
    sys.exit(f"{missing}; ./dev extras installs it for Debian's /usr/bin/python3")

MAPS = {
    "flow_thickness": "peak flow thickness [m]",
    "flow_speed": "peak flow speed [m/s]",
    "flow_pressure": "peak flow pressure [kPa]",
    "smoke_density": "peak smoke density [kg/m^3]",
    "cloud_height": "peak cloud height [m]",
    "deposit": "deposit [m]",
    "erosion": "erosion [m]",
}


def read_grid(file):
    """An ESRI grid: its values, the first row in the north, and (west, east, south, north) [m]."""
    with open(file) as lines:
        header = {word.lower(): float(number) for word, number in (next(lines).split() for _ in range(6))}
        values = np.loadtxt(lines, ndmin=2)
    values[values == header["nodata_value"]] = np.nan
    cell = header["cellsize"]
    west, south = header["xllcenter"] - cell / 2, header["yllcenter"] - cell / 2
    return values, (west, west + cell * values.shape[1], south, south + cell * values.shape[0])


def main():
    parser = argparse.ArgumentParser(description="Draws the maps of a 3D run on one page.")
    parser.add_argument("run", type=Path, help="run folder")
    parser.add_argument("-o", "--output", type=Path, help="picture (default: rasters.png in the run folder)")
    arguments = parser.parse_args()
    files = {name: arguments.run / "peaks" / f"{name}.asc" for name in MAPS}
    files = {name: file for name, file in files.items() if file.exists()}
    if not files:
        parser.error(f"{arguments.run / 'peaks'} has no maps: expected a 3D run with a terrain")
    rows = (len(files) + 1) // 2
    figure, axes = plt.subplots(rows, 2, figsize=(14, 3.4 * rows), squeeze=False, layout="constrained")
    for axis in axes.flat[len(files):]:
        axis.axis("off")
    for axis, (name, file) in zip(axes.flat, files.items()):
        values, extent = read_grid(file)
        shown = np.ma.masked_where(~(values > 0), values)
        image = axis.imshow(shown, extent=extent, cmap="viridis", interpolation="nearest")
        axis.set(title=MAPS[name], xlabel="x [m]", ylabel="y [m]", facecolor="0.93")
        figure.colorbar(image, ax=axis)
    output = arguments.output or arguments.run / "rasters.png"
    figure.savefig(output, dpi=110)
    print(output)


if __name__ == "__main__":
    main()
