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


def packed(numbers):
    whole = struct.pack(f"<{len(numbers)}f", *numbers)
    small = zlib.compress(whole, 9)
    return struct.pack("<4I", 1, len(whole), 0, len(small)) + small


places = [p for x, y in start for p in (x, y, 0.0)]
blocks = [packed(places)] + [packed(column) for column in columns.values()]
offsets = [sum(map(len, blocks[:k])) for k in range(len(blocks))]


def array(name, components, k):
    return (
        f'<DataArray type="Float32" Name="{name}" NumberOfComponents="{components}" format="appended" '
        f'offset="{offsets[k]}"/>'
    )


parts = [
    '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" header_type="UInt32" '
    'compressor="vtkZLibDataCompressor">',
    f'<UnstructuredGrid><Piece NumberOfPoints="{len(start)}" NumberOfCells="0">',
    f"<Points>{array('place', 3, 0)}</Points>",
    "<PointData>",
    *(array(name, 1, k + 1) for k, name in enumerate(columns)),
    "</PointData>",
    "<Cells>",
    '<DataArray type="Int32" Name="connectivity" format="ascii"></DataArray>',
    '<DataArray type="Int32" Name="offsets" format="ascii"></DataArray>',
    '<DataArray type="UInt8" Name="types" format="ascii"></DataArray>',
    "</Cells></Piece></UnstructuredGrid>",
    '<AppendedData encoding="raw">',
]
out.mkdir(parents=True, exist_ok=True)
text = "\n".join(parts).encode() + b"\n_" + b"".join(blocks) + b"\n</AppendedData></VTKFile>\n"
(out / "particles.vtu").write_bytes(text)
