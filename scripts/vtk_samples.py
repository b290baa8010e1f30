#!/usr/bin/env python3
"""Writes two points with arrays of every kind as VTK itself does, in each of its layouts: what score/vtu.rs and
score/legacy.rs are tried on.

    pip install vtk numpy
    scripts/vtk_samples.py mpm-verify/src/score
"""

import pathlib
import sys

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk

KINDS = {
    "Float64": (numpy.float64, [-0.1, 1e30]),
    "Float32": (numpy.float32, [-7.5, 8.25]),
    "Int64": (numpy.int64, [-(2**40), 2**40]),
    "UInt64": (numpy.uint64, [0, 2**40]),
    "Int32": (numpy.int32, [-70000, 70000]),
    "UInt32": (numpy.uint32, [0, 3_000_000_000]),
    "Int16": (numpy.int16, [-300, 300]),
    "UInt16": (numpy.uint16, [0, 60000]),
    "Int8": (numpy.int8, [-100, 100]),
    "UInt8": (numpy.uint8, [0, 200]),
}
# Where the numbers stand, whether they are compressed, the order of their bytes, and the bits of what counts them.
LAYOUTS = [
    ("ascii", False, "little", 32),
    ("binary", False, "little", 32),
    ("binary", True, "big", 64),
    ("base64", True, "little", 32),
    ("raw", False, "big", 64),
    ("raw", True, "little", 32),
]


def array(name, kind, values):
    made = numpy_to_vtk(numpy.array(values, dtype=kind), deep=True)
    made.SetName(name)
    return made


def filled(grid):
    """The grid with two points, a cell each, and data of all kinds."""
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    grid.Allocate(2)
    grid.SetPoints(points)
    for k, place in enumerate([(0.5, 0.25, 0.0), (1.5, -0.25, 2.0)]):
        points.InsertNextPoint(*place)
        grid.InsertNextCell(vtk.VTK_VERTEX, 1, [k])
    # A vector: VTK writes its ranges as elements inside the array.
    grid.GetPointData().AddArray(array("velocity (m/s)", numpy.float64, [[1, 2, 3], [4, 5, 6]]))
    for name, (kind, values) in KINDS.items():
        grid.GetPointData().AddArray(array(name, kind, values))
    grid.GetCellData().AddArray(array("of cells", numpy.float64, [9, 9]))
    return grid


grid = filled(vtk.vtkUnstructuredGrid())
folder = pathlib.Path(sys.argv[1])
for mode, packed, order, header in LAYOUTS:
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    {"ascii": writer.SetDataModeToAscii, "binary": writer.SetDataModeToBinary}.get(mode, writer.SetDataModeToAppended)()
    writer.SetEncodeAppendedData(mode == "base64")
    (writer.SetCompressorTypeToZLib if packed else writer.SetCompressorTypeToNone)()
    # So that arrays of 16 bytes take two blocks.
    writer.SetBlockSize(8)
    (writer.SetByteOrderToBigEndian if order == "big" else writer.SetByteOrderToLittleEndian)()
    (writer.SetHeaderTypeToUInt64 if header == 64 else writer.SetHeaderTypeToUInt32)()
    writer.SetFileName(str(folder / "vtu" / f"{mode}{'-zlib' if packed else ''}-{order}-{header}.vtu"))
    writer.Write()

# The old format, in which attributes have sections of their own.
WRITERS = [
    ("grid", vtk.vtkUnstructuredGrid, vtk.vtkUnstructuredGridWriter),
    ("polygons", vtk.vtkPolyData, vtk.vtkPolyDataWriter),
]
for kind, of, made_by in WRITERS:
    for version in (42, 51):
        for mode in ("ascii", "binary"):
            grid = filled(of())
            data = grid.GetPointData()
            named = array("named", numpy.float64, [[1, 2, 3], [4, 5, 6]])
            # A block of metadata, one of whose lines is blank.
            named.SetComponentName(0, "first")
            named.SetComponentName(2, "third")
            data.AddArray(named)
            data.SetScalars(array("ux (m)", numpy.float32, [0.5, -0.5]))
            data.SetVectors(array("displacement (m)", numpy.float64, [[1, 2, 3], [4, 5, 6]]))
            data.GetVectors().SetComponentName(1, "second")
            data.GetVectors().GetInformation().Set(vtk.vtkDataArray.UNITS_LABEL(), "m")
            data.SetTensors(array("stress", numpy.float64, [[1, 4, 0, 4, 2, 0, 0, 0, 6], [-1, 7, 0, 7, -2, 0, 0, 0, -6]]))
            data.SetNormals(array("normals", numpy.float32, [[1, 0, 0], [0, 1, 0]]))
            data.SetTCoords(array("texture", numpy.float64, [[1, 0], [0, 1]]))
            data.SetGlobalIds(array("ids", numpy.int64, [7, 8]))
            grid.GetFieldData().AddArray(array("TIME", numpy.float64, [0.5]))
            writer = made_by()
            writer.SetInputData(grid)
            writer.SetFileVersion(version)
            (writer.SetFileTypeToASCII if mode == "ascii" else writer.SetFileTypeToBinary)()
            writer.SetFileName(str(folder / "legacy" / f"{kind}-{mode}-{version}.vtk"))
            writer.Write()
