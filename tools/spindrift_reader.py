"""Reads the run folders of Spindrift into numpy arrays. Needs numpy and h5py, nothing else; Python 3.8 or newer.

    from spindrift_reader import Run

    run = Run("runs/quickstart")
    run.info["front_speed_max"]                # run.json                                        [m/s]
    run.diagnostics["front_m"]                 # one value a step: shape (n_steps,)               [m]
    run.times                                  # one value a frame: shape (n_frames,)             [s]
    snow = run.particles(40)                   # frame number 40; -1 is the last one
    snow["position"]                           # shape (n, 2), x and z; in 3D (n, 3)              [m]
    smoke = run.smoke(40)
    smoke["density"]                           # shape (nx, nz), in 3D (nx, ny, nz)               [kg/m^3]

`python3 spindrift_reader.py RUN` prints what a run folder holds.
"""

import functools
import json
import pathlib
import re
import sys

import h5py
import numpy as np


class Run:
    """A run folder, read when it is asked for. A run that still goes on, or was killed, can be read as far as it came.

    path      the run folder
    Raises    FileNotFoundError: no such folder, or it has no run.json.
    """

    def __init__(self, path):
        self.folder = pathlib.Path(path)
        if not self.folder.is_dir():
            raise FileNotFoundError(f"{self.folder}: there is no such folder, expected a run folder")
        if not (self.folder / "run.json").is_file():
            raise FileNotFoundError(f"{self.folder}: not a run folder, it has no run.json")

    @functools.cached_property
    def info(self):
        """run.json as a dict: status, dim, time [s], masses [kg], front_x [m], wall_seconds, digest, ..."""
        return json.loads((self.folder / "run.json").read_text(encoding="utf-8"))

    @property
    def dim(self):
        """2 or 3."""
        return self.info["dim"]

    @functools.cached_property
    def diagnostics(self):
        """diagnostics.csv as a dict of arrays of shape (n_steps,), by the headings, which end in the unit.

        Numbers are float64; "limiter", the name of what bounded the time step, is an array of strings. The momenta
        (exchange_..., gravity_..., ...) are those of each step [kg m/s]. In 2D, masses and momenta are per metre of
        width. A last row that is cut off, as of a killed run, is left out.
        """
        lines = (self.folder / "diagnostics.csv").read_text(encoding="utf-8").split("\n")
        heading = lines[0].split(",")
        rows = [row for row in (line.split(",") for line in lines[1:-1]) if len(row) == len(heading)]
        columns = {}
        for k, name in enumerate(heading):
            words = [row[k] for row in rows]
            columns[name] = np.array(words, dtype=str if name == "limiter" else float)
        return columns

    def frames(self, layer=None):
        """Numbers of the frames on disk, ascending: a list of int. layer: "particles", "smoke", None: of either."""
        pattern = re.compile(f"({layer or 'particles|smoke'})_([0-9]{{6,}})[.]hdf")
        names = (pattern.fullmatch(path.name) for path in (self.folder / "frames").glob("*.hdf"))
        return sorted({int(name[2]) for name in names if name})

    @functools.cached_property
    def times(self):
        """Times of the frames in the order of frames() [s], shape (n_frames,)."""
        particles = set(self.frames("particles"))
        return np.array([self._time("particles" if n in particles else "smoke", n) for n in self.frames()], dtype=float)

    def particles(self, frame=-1):
        """The snow of a frame, dense flow and cover, ordered by id: a dict of arrays with n the number of particles.

        position      (n, dim)  x, z or x, y, z   [m]          velocity      (n, dim)   [m/s]
        density       (n,)      [kg/m^3]                       pressure      (n,)       [Pa]
        mass          (n,)      [kg], in 2D [kg/m]             entrained_at  (n,)       [s], -1: released
        layer         (n,)      0 dense flow, 1 cover          overlap       (n,)       1: in the overlap region
        id            (n,)      int64                          time          float      [s]

        frame     its number; negative ones count from the last
        Raises    IndexError: there is no such frame.
        """
        with self._open("particles", frame) as file:
            result = {"time": float(file["spindrift"].attrs["time"]), "position": self._axes(file["VTKHDF/Points"][()])}
            for name, data in file["VTKHDF/PointData"].items():
                result[name] = self._axes(data[()]) if data.ndim == 2 else data[()]
        return result

    def smoke(self, frame=-1):
        """The cloud of a frame on the cells of its grid: a dict of arrays, indexed [x, z] in 2D and [x, y, z] in 3D.

        density       (nx, nz) or (nx, ny, nz)   of smoke [kg/m^3]
        velocity      the same and a last axis of dim components, of the air [m/s]
        solid         as density, bool: inside the ground
        origin        (dim,)    centre of the first cell [m]   spacing       (dim,)     size of a cell [m]
        time          float     [s]

        The centre of cell [i, k] is origin + spacing * (i, k).
        frame     its number; negative ones count from the last
        Raises    IndexError: there is no such frame.
        """
        axes = [0, 2] if self.dim == 2 else [0, 1, 2]
        with self._open("smoke", frame) as file:
            root = file["VTKHDF"]
            result = {
                "time": float(file["spindrift"].attrs["time"]),
                "origin": root.attrs["Origin"][axes],
                "spacing": root.attrs["Spacing"][axes],
            }
            for name, data in root["PointData"].items():
                values = data[()]  # [z, y, x] and perhaps components
                values = values.transpose([2, 1, 0] + list(range(3, values.ndim)))
                if self.dim == 2:  # one layer of cells, which the file holds twice
                    values = values[:, 0]
                result[name] = self._axes(values) if data.ndim == 4 else values
        result["solid"] = result["solid"].astype(bool)
        return result

    def units(self, layer):
        """Units of a layer's arrays as the frames tell them: {"velocity": "m/s", ...}. layer: "particles" or "smoke"."""
        with self._open(layer, -1) as file:
            stored = {name: _text(value) for name, value in file["spindrift"].attrs.items()}
        return {name[len("unit.") :]: text for name, text in stored.items() if name.startswith("unit.")}

    def _axes(self, vectors):
        """(x, y, z) as (x, z) in 2D: along the last axis."""
        return vectors[..., [0, 2]] if self.dim == 2 else vectors

    def _open(self, layer, frame):
        numbers = self.frames(layer)
        number = numbers[frame] if frame < 0 and -frame <= len(numbers) else frame
        if number not in numbers:
            there = f"it has {numbers[0]} to {numbers[-1]}" if numbers else "it has none"
            raise IndexError(f"{self.folder}: there is no frame {frame} of {layer}, {there}")
        return h5py.File(self.folder / "frames" / f"{layer}_{number:06}.hdf", "r")

    def _time(self, layer, frame):
        with self._open(layer, frame) as file:
            return file["spindrift"].attrs["time"]


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def _range(values):
    return f"{values.min():.4g} to {values.max():.4g}" if values.size else "none"


def _summary(run):
    info = run.info
    print(f"{run.folder}: {info['scene']}, {run.dim}D, {info['status']} at {info['time']:.6g} s, {info['steps']} steps")
    mass = ", ".join(f"{name} {value:.6g}" for name, value in info["mass"].items() if name != "error_relative")
    print(f"mass [{'kg/m' if run.dim == 2 else 'kg'}]: {mass}; relative error {info['mass']['error_relative']:.2g}")
    print(f"diagnostics: {len(run.diagnostics['time_s'])} rows of {len(run.diagnostics)} columns")
    print(f"frames: {len(run.times)}, {_range(run.times)} s")
    for layer, read in (("particles", run.particles), ("smoke", run.smoke)):
        if not run.frames(layer):
            print(f"{layer}: no frames")
            continue
        units = run.units(layer)
        units["position"] = units.get("Points", "m")
        frame = read(-1)
        print(f"{layer} of the last frame, {frame['time']:.6g} s:")
        for name, values in frame.items():
            if name != "time":
                unit = f" [{units[name]}]" if name in units else " [m]" if name in ("origin", "spacing") else ""
                print(f"  {name + unit:<24} {values.dtype!s:<8} {str(values.shape):<18} {_range(values)}")


if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit("Usage: spindrift_reader.py RUN")
    try:
        _summary(Run(sys.argv[1]))
    except (OSError, IndexError) as problem:
        sys.exit(str(problem))
