#!/usr/bin/env python3
"""Numbers of docs/notes/column.md and docs/notes/mms-vortex-box.md that no table is filled with, from the particles of a run.

    mpm-verify run column --scheme gimp-fbar-recursive-flip --out run && scripts/page_numbers.py column run
    mpm-verify run mms-vortex-box --scheme gimp-fbar-consistent-flip --level n64 --out run \
        && scripts/page_numbers.py mms-vortex-box run

Column: how far the layers between a quarter and three quarters of the depth have crept (mm). Vortex: mean
and rms about it of the mean stress less the exact one (Pa).
"""

import csv
import json
import math
import pathlib
import sys


def column(particles, parameters):
    depth = parameters["height"]
    middle = [p["displacement_error (m)"] for p in particles if 0.25 < p["reference_y (m)"] / depth < 0.75]
    print(f"{1e3 * sum(middle) / len(middle):.3f} mm")


def vortex(particles, parameters):
    radius = 0.4
    shear_modulus = parameters["young_modulus"] / (2.0 * (1.0 + parameters["poisson_ratio"]))
    now = math.sin(parameters["angular_frequency"] * parameters["duration"])

    def exact(p):
        r = math.hypot(p["reference_x (m)"] - 0.5, p["reference_y (m)"] - 0.5)
        share = max(0.0, 1.0 - (r / radius) ** 2)
        slope = -8.0 * parameters["angle"] * now * r / radius**2 * share**3
        return shear_modulus * (r * slope) ** 2 / 3.0

    errors = [p["mean_stress (Pa)"] - exact(p) for p in particles]
    mean = sum(errors) / len(errors)
    rms = math.sqrt(sum((e - mean) ** 2 for e in errors) / len(errors))
    print(f"{mean:.0f} ± {rms:.0f} Pa")


def main():
    case, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    with open(folder / "particles.csv", newline="") as file:
        particles = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    parameters = json.loads((folder / "record.json").read_text())["parameters"]
    {"column": column, "mms-vortex-box": vortex}[case](particles, parameters)


main()
