#!/usr/bin/env python3
"""Runs random quasi-static scenes in 1 to 200 load steps and counts how they end.

usage: static_scenes.py PROGRAM [--scenes N] [--seed K] [--seconds S] [--keep FOLDER]

A membrane, slopes, vertical cuts, footings, columns and beams, with GIMP and quadratic splines, with F-bar and without. A
scene reaches its load, or its error names the cause. Any other end is listed, and the script ends with 1. Runs that take
longer than S seconds are counted.
"""

import argparse
import collections
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

CAUSES = {
    "loose": "raise the ghost penalty",
    "nothing holds it": "add a support",
    "has come off": "has come off",
    "limit load": "at its limit",
    "shorter steps": "take shorter load steps",
    "left the grid": "lies off the grid",
}


def scene(title, h, lower, cells, ends, shape, density, law, acting, steps, scheme):
    return f"""format = 1
title = "{title}"
[grid]
cell_size_m = {h}
lower_m = {lower}
cells = {cells}
ends = {json.dumps(ends)}
[body]
density_kg_m3 = {density}
particles_per_direction = 2
{shape}
{law}
{acting}
[solver]
scheme = "quasi-static-{scheme}"
time_step_s = {1 / steps}
tolerance = 1e-7
[[phases]]
name = "load"
duration_s = 1.0
[output]
row_s = {1 / steps}
"""


def polygon(corners):
    return f"[[body.shapes]]\npolygon = {{ corners_m = {[list(map(float, c)) for c in corners]} }}"


def wall(name, axis, end, kind):
    return f'[[supports]]\nwall = {{ name = "{name}", axis = "{axis}", end = "{end}", kind = "{kind}" }}'


def gravity(x, y):
    return f"[[loads]]\ngravity = {{ acceleration_m_s2 = [{x}, {y}], rise_s = 1.0 }}"


def elastic(young, ratio, name="neo-hookean"):
    return f"[law.{name}]\nyoung_modulus_pa = {young}\npoisson_ratio = {ratio}"


def clay(young, ratio, strength):
    strength = f"strength.undrained = {{ shear_strength_pa = {strength} }}"
    return f"{elastic(young, ratio, 'hencky-j2')}\n{strength}"


BASE, BACK = wall("base", "y", "lo", "fixed"), wall("back", "x", "lo", "roller")


def membrane(rng, steps, scheme):
    load, ratio = 10 ** rng.uniform(0, 1.7), rng.choice([0.3, 0.49, 0.499, 0.4999])
    shape = polygon([(0, 0), (48, 44), (48, 60), (0, 44)])
    on = f"[[loads]]\nforce = {{ total_n = [0, {load}], on = {{ x_m = [47.25, 47.75] }}, rise_s = 1.0 }}"
    acting = on + "\n" + wall("clamp", "x", "lo", "fixed")
    return scene("membrane", 2.0, [0, -2], [28, 38], ["wall-open", "open"], shape, 1.0, elastic(70.0, ratio), acting, steps, scheme)


def ground(rng, steps, scheme, title, angle):
    height, floor = rng.uniform(2, 8), rng.choice([0.0, 0.5, 1.0])
    h = height / rng.choice([6, 8, 10])
    run = height / math.tan(math.radians(angle)) if angle < 90 else 0.0
    crest, toe = 2 * height, 3 * height if floor else 0.0
    floor = floor * math.ceil(height / 4 / h) * h
    top = floor + height
    corners = [(0, 0), (crest + run + toe, 0), (crest + run + toe, floor), (crest + run, floor), (crest, top), (0, top)]
    corners = corners if floor else [(0, 0), (crest + run, 0), (crest, top), (0, top)]
    weight = 1800 * 9.81 * height
    law = clay(weight * 10 ** rng.uniform(1.5, 3), rng.choice([0.3, 0.45, 0.49, 0.499]), weight / rng.uniform(2.5, 9))
    cells = [math.ceil((crest + run + toe) / h) + 8, math.ceil(top / h) + 3]
    acting = "\n".join([gravity(0, -9.81), BASE, BACK])
    return scene(title, h, [0, 0], cells, ["wall-open", "wall-open"], polygon(corners), 1800.0, law, acting, steps, scheme)


def slope(rng, steps, scheme):
    return ground(rng, steps, scheme, "slope", rng.uniform(25, 70))


def cut(rng, steps, scheme):
    return ground(rng, steps, scheme, "cut", 90)


def footing(rng, steps, scheme):
    h, depth = 0.125, 2.0
    sunk = 10 ** rng.uniform(-3, -1.5)
    shape = "[[body.shapes]]\nbox = { from_m = [0, 0], to_m = [3, -2] }"
    law = clay(1e6, rng.choice([0.3, 0.49, 0.499]), 10 ** rng.uniform(2, 3.5))
    strip = f"nodes = {{ name = \"strip\", within = {{ x_m = [-inf, 0.5], y_m = [-0.07, inf] }}, velocity_m_s = {{ x = 0, y = {-sunk} }} }}"
    acting = "\n".join([BASE, BACK, wall("side", "x", "hi", "roller"), "[[supports]]\n" + strip])
    return scene("footing", h, [0, -depth], [24, 19], ["walls", "wall-open"], shape, 1000.0, law, acting, steps, scheme)


def column(rng, steps, scheme):
    law = rng.choice([elastic, lambda e, n: elastic(e, n, "hencky"), lambda e, n: clay(e, n, e / 10 ** rng.uniform(1, 3))])
    young = 1000 * 9.81 * 4 * 10 ** rng.uniform(0.3, 2.5)
    shape = "[[body.shapes]]\nbox = { from_m = [0, 0], to_m = [1, 4] }"
    acting = "\n".join([gravity(0, -9.81), BASE, BACK, wall("side", "x", "hi", "roller")])
    law = law(young, rng.choice([0.0, 0.3, 0.49]))
    return scene("column", 0.25, [0, 0], [4, 18], ["walls", "wall-open"], shape, 1000.0, law, acting, steps, scheme)


def beam(rng, steps, scheme):
    young = 1000 * 9.81 * 10 ** rng.uniform(2.3, 4)
    shape = "[[body.shapes]]\nbox = { from_m = [0, 0], to_m = [4, 0.5] }"
    acting = gravity(0, -9.81) + "\n" + wall("clamp", "x", "lo", "fixed")
    law = elastic(young, rng.choice([0.0, 0.3, 0.49, 0.499]), rng.choice(["hencky", "neo-hookean"]))
    return scene("beam", 0.125, [0, -4.5], [36, 42], ["wall-open", "open"], shape, 1000.0, law, acting, steps, scheme)


def ending(command, seconds):
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return "longer", ""
    said = done.stdout + done.stderr
    if done.returncode == 0:
        return "reaches its load", ""
    for cause, words in CAUSES.items():
        if done.returncode == 4 and words in said:
            return cause, ""
    return "other", said.strip()[-300:]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=120.0)
    parser.add_argument("--keep", type=pathlib.Path)
    given = parser.parse_args()
    rng = random.Random(given.seed)
    kinds = [membrane, slope, cut, footing, column, beam]
    counts, bad = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as folder:
        folder = given.keep or pathlib.Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        for k in range(given.scenes):
            kind, steps = kinds[k % len(kinds)], round(200 ** rng.random())
            basis, remedy = rng.choice(["gimp", "bspline2"]), rng.choice(["none", "fbar-consistent"])
            file = folder / f"{k:03}-{kind.__name__}.toml"
            file.write_text(kind(rng, steps, f"{basis}-{remedy}"))
            end, said = ending([given.program, "scene", str(file), "--json", "--threads", "1"], given.seconds)
            counts[kind.__name__, end] += 1
            if end in ("other", "shorter steps"):
                print(f"{file.name}: {basis}-{remedy}, {steps} steps: {end} {said}", flush=True)
            bad += end == "other"
    ends = ["reaches its load", *CAUSES, "longer", "other"]
    print("| scenes | " + " | ".join(ends) + " |\n|---|" + "---|" * len(ends))
    for kind in kinds:
        print(f"| {kind.__name__} | " + " | ".join(str(counts[kind.__name__, end] or "–") for end in ends) + " |")
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
