"""Opens frames with h5py and VTK and prints what they hold as JSON. Usage: read_back.py FILE..."""

import json
import sys

import h5py
import vtk
from vtk.util.numpy_support import vtk_to_numpy


def by_vtk(path):
    reader = vtk.vtkHDFReader()
    if not reader.CanReadFile(path):
        return {}
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutputDataObject(0)
    arrays = data.GetPointData()
    result = {
        "class": data.GetClassName(),
        "bounds": list(data.GetBounds()),
        "n_points": data.GetNumberOfPoints(),
        "n_cells": data.GetNumberOfCells(),
        "arrays": {},
    }
    if data.GetNumberOfCells() > 0:
        result["cell_type"] = data.GetCellType(0)
    for k in range(arrays.GetNumberOfArrays()):
        values = vtk_to_numpy(arrays.GetArray(k))
        result["arrays"][arrays.GetArrayName(k)] = {"type": str(values.dtype), "values": values.ravel().tolist()}
    return result


def plain(value):
    value = value.tolist() if hasattr(value, "tolist") else value
    return value.decode() if isinstance(value, bytes) else value


def by_h5py(path):
    with h5py.File(path, "r") as f:
        root = f["VTKHDF"]
        return {
            "type": plain(root.attrs["Type"]),
            "shapes": {name: list(data.shape) for name, data in root["PointData"].items()},
            "attributes": {name: plain(value) for name, value in f["spindrift"].attrs.items()},
        }


print(json.dumps([{"vtk": by_vtk(path), "h5py": by_h5py(path)} for path in sys.argv[1:]]))
