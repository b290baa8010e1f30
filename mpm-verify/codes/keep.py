"""Makes a submission small enough to be kept: particles column by column, results to 5e-4, compressed.

    python keep.py FOLDER [FILE.vtu ...]

rewrites every .vtu that FOLDER/score.json names (appended raw data, zlib, as `keep.py` writes); of the files that are named
one particle of each cell is left, each in turn another one. Needs numpy.
"""
import json, re, struct, sys, zlib
from pathlib import Path
import numpy as np


def read(path):
    whole = path.read_bytes()
    text, data = whole.split(b"\n_", 1)
    columns, count = {}, int(re.search(rb'NumberOfPoints="(\d+)"', text)[1])
    for name, parts, offset in re.findall(rb'Name="([^"]+)" NumberOfComponents="(\d)" format="appended" offset="(\d+)"', text):
        blocks, size, last, *_ = struct.unpack_from("<3I", data, int(offset))
        sizes = struct.unpack_from(f"<{blocks}I", data, int(offset) + 12)
        at, parts_of = int(offset) + 12 + 4 * blocks, []
        for n in sizes:
            parts_of.append(zlib.decompress(data[at:at + n])); at += n
        columns[name.decode()] = np.frombuffer(b"".join(parts_of), "<f4").reshape(count, int(parts)).squeeze()
    columns.pop("place", None)
    return columns


def packed(a, cut):
    bits = np.ascontiguousarray(a, "<f4").view("<u4").ravel().astype(np.uint64)
    bits = np.where(bits >> 23 & 255 == 0, 0, (bits + (1 << cut - 1)) >> cut << cut).astype("<u4")
    small = zlib.compress(bits.tobytes(), 9)
    return struct.pack("<4I", 1, 4 * len(bits), 0, len(small)) + small


def write(path, columns):
    n = len(next(iter(columns.values())))
    blocks = [packed(np.zeros(3 * n), 13)] + [packed(c, 6 if "reference" in k else 13) for k, c in columns.items()]
    at = np.cumsum([0] + [len(b) for b in blocks])
    array = lambda name, parts, k: f'<DataArray type="Float32" Name="{name}" NumberOfComponents="{parts}" format="appended" offset="{at[k]}"/>'
    text = "\n".join([
        '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">',
        f'<UnstructuredGrid><Piece NumberOfPoints="{n}" NumberOfCells="0">', f"<Points>{array('place', 3, 0)}</Points>", "<PointData>",
        *(array(k, 1, i + 1) for i, k in enumerate(columns)), "</PointData>", "<Cells>",
        *(f'<DataArray type="{t}" Name="{k}" format="ascii"></DataArray>' for t, k in (("Int32", "connectivity"), ("Int32", "offsets"), ("UInt8", "types"))),
        "</Cells></Piece></UnstructuredGrid>", '<AppendedData encoding="raw">'])
    path.write_bytes(text.encode() + b"\n_" + b"".join(blocks) + b"\n</AppendedData></VTKFile>\n")


folder = Path(sys.argv[1])
manifest = json.loads((folder / "score.json").read_text())
for run in manifest.get("runs", [manifest]):
    run = {**manifest, **run}
    if not run.get("particles", "").endswith(".vtu"):
        continue
    if b'"Float64"' in (folder / run["particles"]).read_bytes():
        continue  # numbers whose last digits count
    columns = read(folder / run["particles"])
    x, y = columns["reference_x (m)"], columns["reference_y (m)"]
    order = np.lexsort((y, x))
    if run["particles"] in sys.argv[2:]:
        i, j = (np.floor(c / run["cell_size_m"]).astype(int) for c in (x, y))
        order = np.lexsort((y, x, j, i))
        cell = i[order] * 100000 + j[order]
        first = np.flatnonzero(np.r_[True, cell[1:] != cell[:-1]])
        count = np.diff(np.append(first, len(cell)))
        order = order[first + (i[order][first] + 2 * j[order][first]) % count]
        order = order[np.lexsort((y[order], x[order]))]
    columns = {name: values[order] for name, values in columns.items()}
    write(folder / run["particles"], columns)
