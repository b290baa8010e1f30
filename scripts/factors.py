#!/usr/bin/env python3
"""Factors of safety of shipped scenes, and of steeper slopes, on several sizes of cells, against limit analysis.

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
# Scene, angle of its slope if it is not the shipped one (degrees), known factor, and the range that is searched.
SCENES = [
    ("slope-quasi-static", None, "1.646 to 1.664", (1.2, 2.4)),
    ("slope-quasi-static", 60, f"{5.24 * STRENGTH:.3f} to {5.25 * STRENGTH:.3f}", (1.0, 2.2)),
    ("slope-quasi-static", 75, f"{4.56 * STRENGTH:.3f} to {4.57 * STRENGTH:.3f}", (0.9, 2.0)),
    ("vertical-cut", None, "0.801 to 0.805", (0.5, 1.5)),
]


def changed(text, angle, ratio):
    """The scene with a slope of another angle (degrees), and cells larger by a ratio."""
    if angle:
        assert "[10, 5]" in text
        text = text.replace("[10, 5]", f"[{15 - 5 / math.tan(math.radians(angle)):.6f}, 5]")
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
        for name, angle, known, (least, most) in SCENES:
            for ratio in ratios:
                text, h = changed((folder / f"{name}.toml").read_text(), angle, ratio)
                file = pathlib.Path(own) / f"{name}.toml"
                file.write_text(text)
                command = [program, "factor", str(file), "--least", str(least), "--most", str(most), "--quiet"]
                begun = time.monotonic()
                said = subprocess.run(command, capture_output=True, text=True).stdout
                took = time.monotonic() - begun
                found = re.search(r"stands at ([0-9]+[.][0-9]+), fails at ([0-9]+[.][0-9]+)", said)
                stands, fails = found.groups() if found else ("–", "–")
                title = name if not angle else f"{name}, {angle}°"
                print(f"| {title} | {known} | {h:g} | {stands} | {fails} | {took:.0f} |", flush=True)


if __name__ == "__main__":
    main()
