"""Reads a run and its exports with h5py, VTK, csv and the project's own reader, and compares every value.

Usage: read_back_run.py RUN CSV_FOLDER VTK_FOLDER PLY_FOLDER SMOKE_ABOVE
What h5py reads from the VTKHDF frames is the truth. Prints a line a format; ends with an error at the first difference.
"""

import csv
import json
import pathlib
import sys
import xml.etree.ElementTree

import h5py
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools"))
import spindrift_reader

n_values = {}


def same(what, found, expected):
    """Both arrays are of one shape and type and equal to the bit."""
    found, expected = np.asarray(found), np.asarray(expected)
    assert found.shape == expected.shape, f"{what}: shape {found.shape}, expected {expected.shape}"
    assert found.dtype == expected.dtype, f"{what}: {found.dtype}, expected {expected.dtype}"
    assert np.array_equal(found, expected), f"{what}: values differ"
    kind = what.split()[0]
    n_values[kind] = n_values.get(kind, 0) + expected.size


def truth(path):
    """A frame by h5py: arrays by name, with the points of particles as "Points", attributes, and the lattice if any."""
    with h5py.File(path, "r") as file:
        root = file["VTKHDF"]
        arrays = {name: data[()] for name, data in root["PointData"].items()}
        attributes = {name: value for name, value in file["spindrift"].attrs.items()}
        if "Points" in root:
            arrays["Points"] = root["Points"][()]
            return arrays, attributes, None
        extent, origin, spacing = (root.attrs[name] for name in ("WholeExtent", "Origin", "Spacing"))
        return arrays, attributes, (extent[1::2] + 1, origin, spacing)


def unit(attributes, name):
    value = "m" if name == "Points" else attributes.get("unit." + name)
    return "" if value is None else f" [{value.decode() if isinstance(value, bytes) else value}]"


def chosen_points(arrays, lattice, dim, above):
    """Cells of smoke as points: what csv and ply hold."""
    shape, origin, spacing = lattice
    density = arrays["density"]
    kept = density.astype(np.float64) > above
    if dim == 2:
        assert shape[1] == 2
        for name, values in arrays.items():
            same(f"h5py the two layers of {name}", values[:, 0], values[:, 1])
        kept[:, 1] = False
    at = np.argwhere(kept)
    points = {name: values[kept] for name, values in arrays.items()}
    points["Points"] = (origin + at[:, ::-1] * spacing).astype(np.float32)
    return points


def flat_columns(points, attributes, with_units):
    """Columns in no order, (heading, values)."""
    for name, values in points.items():
        text = unit(attributes, name) if with_units else ""
        if values.ndim == 1:
            yield name + text, values
        for k in range(values.shape[1] if values.ndim == 2 else 0):
            yield ("xyz"[k] if name == "Points" else f"{name}_{'xyz'[k]}") + text, values[:, k]


def check_csv(path, points, attributes):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    heading, rows = rows[0], rows[1:]
    expected = dict(flat_columns(points, attributes, with_units=True))
    assert sorted(heading) == sorted(expected), f"{path}: {heading}"
    assert heading[:3] == ["x [m]", "y [m]", "z [m]"], f"{path}: {heading}"
    for k, name in enumerate(heading):
        column = [row[k] for row in rows]
        same(f"csv {path}: {name}", np.array(column, dtype=expected[name].dtype), expected[name])


def check_ply(path, points, dim, radius):
    reader = vtk.vtkPLYReader()
    reader.SetFileName(str(path))
    reader.Update()
    read = reader.GetOutput()
    assert read.GetNumberOfPoints() == len(points["Points"])
    if read.GetNumberOfPoints():
        same(f"ply-by-VTK {path}", vtk_to_numpy(read.GetPoints().GetData()), points["Points"])

    content = path.read_bytes()
    head, body = content.split(b"end_header\n", 1)
    lines = head.decode().split("\n")
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"]
    types = {"float": "<f4", "double": "<f8", "uchar": "u1", "int": "<i4"}
    properties = [line.split()[1:] for line in lines if line.startswith("property ")]
    table = np.frombuffer(body, dtype=[(name, types[kind]) for kind, name in properties])
    expected = dict(flat_columns(points, {}, with_units=False))
    assert sorted(table.dtype.names) == sorted([*expected, "radius"]), table.dtype.names
    for name, values in expected.items():
        found = table[name]
        same(f"ply {path}: {name}", found.astype(np.int64) if values.dtype == np.int64 else found, values)
    assert np.allclose(table["radius"], radius, rtol=1e-6), "radius"


def field_of(read, name):
    return vtk_to_numpy(read.GetFieldData().GetArray(name))


def check_vtk_arrays(what, read, arrays):
    data = read.GetPointData()
    names = [data.GetArrayName(k) for k in range(data.GetNumberOfArrays())]
    assert sorted(names) == sorted(set(arrays) - {"Points"}), names
    for name in names:
        values = vtk_to_numpy(data.GetArray(name))
        expected = arrays[name]
        tail = expected.shape[-1:] if values.ndim == 2 else ()
        same(f"{what}: {name}", values.astype(expected.dtype), expected.reshape((-1,) + tail))


def read_by(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def check_vtp(path, arrays, attributes):
    read = read_by(vtk.vtkXMLPolyDataReader(), path)
    same(f"vtp {path}: points", vtk_to_numpy(read.GetPoints().GetData()), arrays["Points"])
    assert read.GetNumberOfVerts() == read.GetNumberOfCells() == len(arrays["Points"])
    same(f"vtp {path}: time", field_of(read, "TimeValue"), np.array([attributes["time"]]))
    check_vtk_arrays(f"vtp {path}", read, arrays)


def check_vti(path, arrays, attributes, lattice):
    read = read_by(vtk.vtkXMLImageDataReader(), path)
    for found, expected in zip((read.GetDimensions(), read.GetOrigin(), read.GetSpacing()), lattice):
        same(f"vti {path}: lattice", np.array(found, dtype=expected.dtype), expected)
    same(f"vti {path}: time", field_of(read, "TimeValue"), np.array([attributes["time"]]))
    check_vtk_arrays(f"vti {path}", read, arrays)


def check_vtkhdf(path, arrays, lattice):
    read = read_by(vtk.vtkHDFReader(), path)
    if lattice is None:
        same(f"vtkhdf {path}: points", vtk_to_numpy(read.GetPoints().GetData()), arrays["Points"])
    check_vtk_arrays(f"vtkhdf {path}", read, arrays)


def check_index(path, key, files, times):
    """A .series of JSON or a .pvd names the files with their times."""
    if key == "pvd":
        entries = [(e.get("file"), float(e.get("timestep"))) for e in xml.etree.ElementTree.parse(path).iter("DataSet")]
    else:
        entries = [(e["name"], e["time"]) for e in json.loads(path.read_text())["files"]]
    assert entries == list(zip(files, times)), f"{path}: {entries}"
    n_values[key] = n_values.get(key, 0) + len(entries)


def check_reader(run, number, arrays, lattice):
    axes = [0, 2] if run.dim == 2 else [0, 1, 2]
    if lattice is None:
        frame = run.particles(number)
        same("reader position", frame["position"], arrays["Points"][:, axes])
        same("reader velocity", frame["velocity"], arrays["velocity"][:, axes])
        for name in set(arrays) - {"Points", "velocity"}:
            same(f"reader {name}", frame[name], arrays[name])
        return
    frame = run.smoke(number)
    nx, ny, nz = lattice[0]
    shape = (nx, nz) if run.dim == 2 else (nx, ny, nz)
    assert frame["density"].shape == shape and frame["velocity"].shape == shape + (run.dim,)
    same("reader origin", frame["origin"], lattice[1][axes])
    same("reader spacing", frame["spacing"], lattice[2][axes])
    for i, j, k in [(0, 0, 0), (nx - 1, 0, nz - 1), (nx // 2, ny - 1, nz // 3)]:
        at = (i, k) if run.dim == 2 else (i, j, k)
        same("reader density", frame["density"][at], arrays["density"][k, j, i])
        same("reader velocity", frame["velocity"][at], arrays["velocity"][k, j, i][axes])
        assert frame["solid"][at] == bool(arrays["solid"][k, j, i])
    assert frame["density"].sum(dtype=float) == arrays["density"][:, : 1 if run.dim == 2 else None].sum(dtype=float)


def main(folder, csv_folder, vtk_folder, ply_folder, above):
    run = spindrift_reader.Run(folder)
    for layer in ("particles", "smoke"):
        paths = sorted((folder / "frames").glob(f"{layer}_*.hdf"))
        times = []
        for path in paths:
            arrays, attributes, lattice = truth(path)
            times.append(attributes["time"])
            check_vtkhdf(path, arrays, lattice)
            check_reader(run, int(path.stem.split("_")[1]), arrays, lattice)
            if lattice is None:
                points = arrays
                radius = 0.5 * (arrays["mass"].astype(float) / arrays["density"]) ** (1 / run.dim)
                check_vtp((vtk_folder / path.name).with_suffix(".vtp"), arrays, attributes)
            else:
                points = chosen_points(arrays, lattice, run.dim, above)
                radius = lattice[2][0] / 2
                check_vti((vtk_folder / path.name).with_suffix(".vti"), arrays, attributes, lattice)
            check_csv((csv_folder / path.name).with_suffix(".csv"), points, attributes)
            check_ply((ply_folder / path.name).with_suffix(".ply"), points, run.dim, radius)
        check_index(folder / f"{layer}.hdf.series", "series", [f"frames/{path.name}" for path in paths], times)
        ending = "vtp" if layer == "particles" else "vti"
        check_index(vtk_folder / f"{layer}.pvd", "pvd", [f"{path.stem}.{ending}" for path in paths], times)
        assert [int(path.stem.split("_")[1]) for path in paths] == run.frames(layer)
        assert np.array_equal(run.times, times)

    assert all(len(column) == run.info["steps"] for column in run.diagnostics.values())
    assert run.diagnostics["limiter"].dtype.kind == "U" and run.diagnostics["time_s"][-1] == run.info["time"]
    for kind, count in sorted(n_values.items()):
        print(f"{kind}: {count} values equal")


if __name__ == "__main__":
    main(*map(pathlib.Path, sys.argv[1:5]), float(sys.argv[5]))
