"""The last particles that MPM3D-F90 has written of Cook's membrane, as `mpm-verify score` reads them.

    python convert.py Cookmo_Gimp.mpm Cookmo_Gimp_anim_21.vtu result

The input deck says where the particles start, in the order of the output. Of the output, in ASCII with four digits,
displacements and the mean normal stress are taken; places in four digits would be worth nothing.
"""

import base64
import re
import struct
import sys
import zlib
from pathlib import Path

deck, grid, out = map(Path, sys.argv[1:4])
rows = [line.split() for line in deck.read_text().splitlines()]
start = [[float(x) for x in row[3:5]] for row in rows if len(row) == 6 and row[0].isdigit()]
text = grid.read_text()


def values(name):
    found = re.search(rf'Name="{name}"[^>]*>(.*?)</DataArray>', text, re.DOTALL)
    column = [float(word) for word in found.group(1).split()]
    assert len(column) == len(start), f"{name}: the deck is another"
    return column


ux, uy, stress = map(values, ["disx", "disy", "MeanNormalStress"])
columns = {
    "reference_x (m)": [x for x, _ in start],
    "reference_y (m)": [y for _, y in start],
    "ux (m)": ux,
    "uy (m)": uy,
    "mean_stress (Pa)": stress,
}


def array(name, components, numbers):
    packed = struct.pack(f"<{len(numbers)}f", *numbers)
    small = zlib.compress(packed, 9)
    head = struct.pack("<4I", 1, len(packed), 0, len(small))
    data = base64.b64encode(head).decode() + base64.b64encode(small).decode()
    return f'<DataArray type="Float32" Name="{name}" NumberOfComponents="{components}" format="binary">{data}</DataArray>'


places = [p for (x, y), a, b in zip(start, ux, uy) for p in (x + a, y + b, 0.0)]
parts = [
    '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" header_type="UInt32" '
    'compressor="vtkZLibDataCompressor">',
    f'<UnstructuredGrid><Piece NumberOfPoints="{len(start)}" NumberOfCells="0">',
    f"<Points>{array('place', 3, places)}</Points>",
    "<PointData>",
    *(array(name, 1, column) for name, column in columns.items()),
    "</PointData>",
    "<Cells>",
    '<DataArray type="Int32" Name="connectivity" format="ascii"></DataArray>',
    '<DataArray type="Int32" Name="offsets" format="ascii"></DataArray>',
    '<DataArray type="UInt8" Name="types" format="ascii"></DataArray>',
    "</Cells></Piece></UnstructuredGrid></VTKFile>",
]
out.mkdir(parents=True, exist_ok=True)
(out / "particles.vtu").write_text("\n".join(parts) + "\n")
