#!/usr/bin/env python3
"""Factors of safety of shipped scenes on three sizes of cells, against limit analysis.

usage: factors.py PROGRAM
"""

import pathlib
import re
import subprocess
import sys
import tempfile

# Scene, its known factor, and the range that is searched.
SCENES = [("slope-quasi-static", "1.646 to 1.664", (1.2, 2.4)), ("vertical-cut", "0.801 to 0.805", (0.5, 1.5))]


def refined(text, ratio):
    """The scene with cells larger by a ratio."""
    size = float(re.search(r"cell_size_m = (\S+)", text).group(1))
    cells = [int(n) for n in re.search(r"cells = \[(\d+), (\d+)\]", text).groups()]
    text = text.replace(f"cell_size_m = {size:g}", f"cell_size_m = {size * ratio:g}")
    return re.sub(r"cells = \[.*\]", f"cells = {[round(n / ratio) for n in cells]}", text), size * ratio


def main():
    program = sys.argv[1]
    folder = pathlib.Path(__file__).parent.parent / "mpm-verify" / "scenes"
    print("| scene | limit analysis | h (m) | stands at | fails at |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as own:
        for name, known, (least, most) in SCENES:
            for ratio in [2, 1, 0.5]:
                text, h = refined((folder / f"{name}.toml").read_text(), ratio)
                file = pathlib.Path(own) / f"{name}.toml"
                file.write_text(text)
                command = [program, "factor", str(file), "--least", str(least), "--most", str(most), "--quiet"]
                said = subprocess.run(command, capture_output=True, text=True).stdout
                found = re.search(r"stands at ([0-9]+[.][0-9]+), fails at ([0-9]+[.][0-9]+)", said)
                stands, fails = found.groups() if found else ("–", "–")
                print(f"| {name} | {known} | {h:g} | {stands} | {fails} |", flush=True)


if __name__ == "__main__":
    main()
