#!/usr/bin/env python3
"""Run-out of sand columns over their aspect ratio, from the shipped scene, on two sizes of cells.

usage: columns.py PROGRAM

Lube et al. (2005, doi:10.1103/PhysRevE.72.041301): a column between walls, L wide to one side and a L high, runs
1.2 a L (a < 1.8) or 1.9 a^(2/3) L (a > 2.8) beyond its edge.
"""

import csv
import pathlib
import re
import subprocess
import sys
import tempfile

WIDTH = 0.1
SIZES = [0.01, 0.005]
RATIOS = [0.5, 1, 1.5, 4]
# Share of the particles behind the front: single grains run ahead.
BULK = 0.99


def known(ratio):
    return 1.2 * ratio if ratio < 1.8 else 1.9 * ratio ** (2 / 3)


def scene(text, size, ratio):
    height = WIDTH * ratio
    cells = [round((1.2 if ratio > 2 else 0.6) / size), round((height + 0.06) / size)]
    text = re.sub(r"cell_size_m = .*", f"cell_size_m = {size:g}", text)
    text = re.sub(r"cells = .*", f"cells = {cells}", text)
    text = re.sub(r"duration_s = .*", "duration_s = 1.2", text)
    return text.replace("to_m = [0.1, 0.1]", f"to_m = [{WIDTH}, {height:g}]")


def main():
    shipped = pathlib.Path(__file__).parent.parent / "mpm-verify" / "scenes" / "sand-column.toml"
    print("| a | experiments | " + " | ".join(f"h = {size:g} m: bulk, front, height left" for size in SIZES) + " |")
    print("|---|---|" + "---|" * len(SIZES))
    for ratio in RATIOS:
        row = []
        for size in SIZES:
            with tempfile.TemporaryDirectory() as own:
                folder = pathlib.Path(own)
                (folder / "column.toml").write_text(scene(shipped.read_text(), size, ratio))
                run = [sys.argv[1], "scene", str(folder / "column.toml"), "--out", str(folder / "out"), "--quiet"]
                subprocess.run(run, check=True, capture_output=True)
                with open(folder / "out" / "particles.csv") as file:
                    places = [(float(p["x (m)"]), float(p["y (m)"])) for p in csv.DictReader(file)]
            x = sorted(x for x, _ in places)
            ways = [(front - WIDTH) / WIDTH for front in (x[int(BULK * len(x))], x[-1])]
            left = max(y for _, y in places) / (WIDTH * ratio)
            row.append(f"{ways[0]:.2f}, {ways[1]:.2f}, {left:.2f}")
        print(f"| {ratio:g} | {known(ratio):.2f} | {' | '.join(row)} |", flush=True)


if __name__ == "__main__":
    main()
