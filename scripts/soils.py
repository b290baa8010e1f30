#!/usr/bin/env python3
"""The size of the box of a strip load, and factors of slopes: what docs/notes/soils.md has beside its case.

usage: soils.py PROGRAM
"""

import csv
import math
import pathlib
import re
import subprocess
import sys
import tempfile

SCENES = pathlib.Path(__file__).parent.parent / "mpm-verify" / "scenes"
GIMP, SPLINES = "quasi-static-gimp-none", "quasi-static-bspline2-none"


def changed(name, ratio=1.0, **keys):
    """A shipped scene with cells larger by a ratio, and other values of keys."""
    text = (SCENES / f"{name}.toml").read_text()
    size = float(re.search(r"cell_size_m = (\S+)", text).group(1))
    cells = [int(n) for n in re.search(r"cells = \[(\d+), (\d+)\]", text).groups()]
    text = text.replace(f"cell_size_m = {size:g}", f"cell_size_m = {size * ratio:g}")
    text = re.sub(r"cells = \[.*\]", f"cells = {[round(n / ratio) for n in cells]}", text)
    for key, value in keys.items():
        text = re.sub(rf"(?m)^{key} = .*$", f"{key} = {value}", text)
    return text


def run(text, command="scene", *options):
    """Folder of a run, and the last line that it said."""
    folder = pathlib.Path(tempfile.mkdtemp())
    (folder / "own.toml").write_text(text)
    words = [sys.argv[1], command, str(folder / "own.toml"), "--out", str(folder / "out"), *options]
    said = subprocess.run(words, capture_output=True, text=True).stdout.strip()
    return folder / "out", said.splitlines()[-1] if said else ""


def columns(path):
    with open(path) as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def strip_load():
    """Greatest errors of the stresses over the load, from the depth b to 4b, by the solution of a half-space, in two boxes."""
    print("| box | σ_yy | σ_xy | σ_xx |\n|---|---|---|---|")
    for box in [16, 32]:
        text = changed("strip-load")
        if box == 32:
            text = text.replace("[16, 16]", "[32, 32]").replace("cells = [64, 66]", "cells = [128, 130]")
        p = columns(run(text)[0] / "particles.csv")
        worst = [0.0, 0.0, 0.0]
        for k in range(len(p["x (m)"])):
            x = p["x (m)"][k] - p["displacement_x (m)"][k]
            z = box - p["y (m)"][k] + p["displacement_y (m)"][k]
            if not (1 < z < 4 and x < 3):
                continue
            left, right = math.atan2(x + 1, z), math.atan2(x - 1, z)
            angle, turn = left - right, left + right
            exact = [
                -(angle + math.sin(angle) * math.cos(turn)) / math.pi,
                math.sin(angle) * math.sin(turn) / math.pi,
                -(angle - math.sin(angle) * math.cos(turn)) / math.pi,
            ]
            for a, part in enumerate(["yy", "xy", "xx"]):
                worst[a] = max(worst[a], abs(p[f"stress_{part} (Pa)"][k] / 1000 - exact[a]))
        print(f"| {box} m | {' | '.join(f'{100 * error:.1f} %' for error in worst)} |", flush=True)


def infinite_slope():
    """Factors at which the slope stands and fails."""
    print("\n| cells over the height | functions | ψ = φ | ψ = 0 |\n|---|---|---|---|")
    for scheme, name in [(GIMP, "GIMP"), (SPLINES, "quadratic splines")]:
        for ratio in [1, 0.5]:
            found = []
            for dilation in [25, 0]:
                text = changed("infinite-slope", ratio, scheme=f'"{scheme}"', dilation_deg=dilation)
                _, said = run(text, "factor", "--least", "1.1", "--most", "1.8", "--trials", "12")
                found.append(re.search(r"Factor of safety ([\d.]+)", said).group(1))
            print(f"| {10 / ratio:g} | {name} | {' | '.join(found)} |", flush=True)


def slope_with_water():
    """Factors at which the slope has moved by a fiftieth of its height, wet and dry, by cells over the height."""

    def moves(text, factor):
        """Whether it moves so far at a factor, or breaks down."""
        friction = math.degrees(math.atan(math.tan(math.radians(25)) / factor))
        text = text.replace("cohesion_pa = 5000", f"cohesion_pa = {5000 / factor}")
        text = re.sub(r"(friction|dilation)_deg = 25", rf"\1_deg = {friction}", text)
        out, _ = run(text)
        file = out / "series.csv"
        path = columns(file)["displacement_max (m)"] if file.exists() and file.read_text().count("\n") > 1 else []
        return len(path) < 10 or max(path) > 5 / 50

    print("| cells | wet | dry |\n|---|---|---|")
    for ratio in [1, 0.5]:
        found = []
        for wet in [True, False]:
            text = changed("slope-with-water", ratio)
            if not wet:
                text = re.sub(r"(?s)\[water\].*?(?=\[\[loads)", "", text).replace("poro-gimp-two-grid", "quasi-static-gimp-none")
            low, high = 1.0, 2.5
            while high - low > 0.02:
                middle = 0.5 * (low + high)
                low, high = (low, middle) if moves(text, middle) else (middle, high)
            found.append(f"{low:.2f} … {high:.2f}")
        print(f"| {10 / ratio:g} | {' | '.join(found)} |", flush=True)


if __name__ == "__main__":
    strip_load()
    infinite_slope()
    slope_with_water()
