#!/usr/bin/env python3
"""Writes two points with arrays of every kind as VTK itself does, in each of its layouts: what score/vtu.rs is tried on.

    pip install vtk numpy
    scripts/vtk_samples.py mpm-verify/src/score/vtu
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


points = vtk.vtkPoints()
points.SetDataTypeToDouble()
grid = vtk.vtkUnstructuredGrid()
grid.SetPoints(points)
for k, place in enumerate([(0.5, 0.25, 0.0), (1.5, -0.25, 2.0)]):
    points.InsertNextPoint(*place)
    grid.InsertNextCell(vtk.VTK_VERTEX, 1, [k])
# A vector: VTK writes its ranges as elements inside the array.
grid.GetPointData().AddArray(array("velocity (m/s)", numpy.float64, [[1, 2, 3], [4, 5, 6]]))
for name, (kind, values) in KINDS.items():
    grid.GetPointData().AddArray(array(name, kind, values))
grid.GetCellData().AddArray(array("of cells", numpy.float64, [9, 9]))

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
    writer.SetFileName(str(folder / f"{mode}{'-zlib' if packed else ''}-{order}-{header}.vtu"))
    writer.Write()
