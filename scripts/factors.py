#!/usr/bin/env python3
"""Factors of safety of shipped scenes, and of other slopes, on several sizes of cells, against limit analysis.

usage: factors.py PROGRAM [RATIO...]

RATIO: size of the cells over that of the shipped scene; 2, 1 and 0.5 without any. Stability numbers of slopes of 60 and 75
degrees, N = γ H/c at failure: 5.25 and 4.57 by rotation about an upper bound, 5.24 and 4.56 by Taylor's chart (Chen 1975,
Limit Analysis and Soil Plasticity, table 9.1).
"""

import math
import pathlib
import re
import subprocess
import sys
import tempfile
import time

# c/(γ H) of the shipped slope, 5 m high.
STRENGTH = 28.87e3 / (2150 * 9.81 * 5)
# The same of the clay over sand, 6 m high; circles down to the sand have N = 6.527 (mpm-verify/exact/src/slope.rs).
LAYER = 25e3 / (1750 * 9.81 * 6)


def face(angle):
    """Foot and crest of a face of an angle (degrees)."""
    return f"[15, 0], [{15 - 5 / math.tan(math.radians(angle)):.6f}, 5]"


def known(least, most):
    """Factors of the shipped slope's strength by stability numbers."""
    return f"{least * STRENGTH:.3f} to {most * STRENGTH:.3f}"


# Title, scene, its face if it is not the shipped one, known factor, and the range that is searched.
SCENES = [
    ("slope, 45°", "slope-quasi-static", None, known(6.015, 6.078), (1.2, 2.4)),
    ("slope, 45°, its toe cut away", "slope-quasi-static", "[14, 0], [14, 1], [10, 5]", known(5.474, 5.551), (1.1, 2.2)),
    ("slope, 60°", "slope-quasi-static", face(60), known(5.24, 5.25), (1.0, 2.2)),
    ("slope, 75°", "slope-quasi-static", face(75), known(4.56, 4.57), (0.9, 2.0)),
    ("slope, 2:1, with friction", "slope-with-friction", None, "1.380 (Bishop & Morgenstern 1960)", (1.0, 2.0)),
    ("soft clay over sand, 2:1", "layered-slope", None, f"below {6.527 * LAYER:.3f} (circle)", (1.4, 1.8)),
    ("vertical cut", "vertical-cut", None, "0.801 to 0.805", (0.5, 1.5)),
]


def changed(text, corners, ratio):
    """The scene with another face, and cells larger by a ratio."""
    if corners:
        assert "[15, 0], [10, 5]" in text
        text = text.replace("[15, 0], [10, 5]", corners)
    size = float(re.search(r"cell_size_m = (\S+)", text).group(1))
    cells = [int(n) for n in re.search(r"cells = \[(\d+), (\d+)\]", text).groups()]
    text = text.replace(f"cell_size_m = {size:g}", f"cell_size_m = {size * ratio:g}")
    return re.sub(r"cells = \[.*\]", f"cells = {[round(n / ratio) for n in cells]}", text), size * ratio


def main():
    program = sys.argv[1]
    ratios = [float(ratio) for ratio in sys.argv[2:]] or [2, 1, 0.5]
    folder = pathlib.Path(__file__).parent.parent / "mpm-verify" / "scenes"
    print("| scene | limit analysis | h (m) | stands at | fails at | s |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as own:
        for title, name, corners, limit, (least, most) in SCENES:
            for ratio in ratios:
                text, h = changed((folder / f"{name}.toml").read_text(), corners, ratio)
                file = pathlib.Path(own) / f"{name}.toml"
                file.write_text(text)
                command = [program, "factor", str(file), "--least", str(least), "--most", str(most), "--quiet"]
                begun = time.monotonic()
                said = subprocess.run(command, capture_output=True, text=True).stdout
                took = time.monotonic() - begun
                found = re.search(r"stands at ([0-9]+[.][0-9]+), fails at ([0-9]+[.][0-9]+)", said)
                stands, fails = found.groups() if found else ("–", "–")
                print(f"| {title} | {limit} | {h:g} | {stands} | {fails} | {took:.0f} |", flush=True)


if __name__ == "__main__":
    main()
