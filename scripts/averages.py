#!/usr/bin/env python3
"""The chart of docs/averages.md: forms of F̄ by the functions that average, over problems of the bench.

usage: averages.py PROGRAM RESULTS.json [PICTURE.svg]

Makes the runs that RESULTS.json lacks, two at a time, prints the tables and draws the picture. All runs take about 40
minutes on two cores. Price: the least of three runs on one thread, which nothing else may disturb.
"""

import concurrent.futures
import json
import math
import pathlib
import subprocess
import sys

SPACES = ["", "-hats", "-cells"]
FORMS = ["fbar-recursive", "fbar-total", "fbar-rate", "bbar", "fbar-consistent"]
REMEDIES = ["none"] + [form + space for form in FORMS for space in SPACES]
BASES = {"gimp": "GIMP", "bspline2": "quadratic splines"}
# Name of a run: case, level and parameters.
RUNS = {
    "cook": ["cook", "h1"],
    "cook, ν = 0.499999": ["cook", "h2", "poisson_ratio=0.499999"],
    "footing": ["footing", "b10"],
    "dam": ["dam-break", "h0.25", "cfl=0.3"],
    "vortex n16": ["mms-vortex-box", "n16"],
    "vortex": ["mms-vortex-box", "n32"],
    "axis": ["mms-axis", "n64"],
    "swirl": ["mms-swirl", "n16"],
    "column": ["column", "h0.25", "duration=5.04"],
    "wave": ["standing-wave", "n8", "duration=24"],
    "price": ["mms-axis", "n64"],
}
PRICE = ["price 1", "price 2", "price 3"]
# Title, run, metric (or "end": the time at which a run breaks down), factor, digits, and what is exact.
COLUMNS = [
    ("price", "price", None, 1, 2, 1),
    ("Cook, h = 1 m: deflection (%)", "cook", "fem_mid_edge_error", 100, 2, 0),
    ("σ_m (mPa)", "cook", "mean_stress_rms_error", 1e3, 1, 0),
    ("noise", "cook", "checkerboard_ratio", 1, 3, 0),
    ("noise, h = 2 m, ν = 0.499999", "cook, ν = 0.499999", "checkerboard_ratio", 1, 2, 0),
    ("footing, B/10: N_c", "footing", "nc_effective", 1, 2, 5.14),
    ("noise", "footing", "checkerboard_ratio", 1, 3, 0),
    ("dam, h = ¼ m: front (m)", "dam", "front_rms_error", 1, 3, 0),
    ("noise (kPa)", "dam", "checkerboard_rms", 1e-3, 2, 0),
    ("vortex, n = 32: u (mm)", "vortex", "displacement_l2", 1e3, 3, 0),
    ("σ_m (Pa)", "vortex", "mean_stress_l2", 1, 0, 0),
    ("order of σ_m", "vortex n16", None, 1, 1, 9),
    ("axis, n = 64: u (µm)", "axis", "displacement_l2", 1e6, 2, 0),
    ("swirl, 3D, n = 16: u (mm)", "swirl", "displacement_l2", 1e3, 3, 0),
    ("σ_m (Pa)", "swirl", "mean_stress_l2", 1, 1, 0),
    ("column, 5 s: energy (µJ/m)", "column", "kinetic_energy_peak", 1e6, 3, 0),
    ("wave, n = 8: order lost (s)", "wave", "end", 1, 1, 24),
]


def make(program, basis, remedy, run):
    case, level, *changed = RUNS[run.split(" ")[0] if run in PRICE else run]
    command = [program, "run", case, "--scheme", f"{basis}-{remedy}-flip", "--level", level, "--threads", "1", "--json"]
    for value in changed:
        command += ["--set", value]
    said = subprocess.run(command, capture_output=True, text=True)
    try:
        return json.loads(said.stdout)
    except json.JSONDecodeError:
        raise SystemExit(f"{' '.join(command)}: {said.stdout}{said.stderr}")


def complete(program, file):
    results = json.loads(file.read_text()) if file.exists() else {}

    def fill(workers, runs):
        jobs = [(basis, remedy, run) for run in runs for basis in BASES for remedy in REMEDIES]
        jobs = [job for job in jobs if " | ".join(job) not in results]
        with concurrent.futures.ThreadPoolExecutor(workers) as pool:
            made = {pool.submit(make, program, *job): job for job in jobs}
            for future in concurrent.futures.as_completed(made):
                results[" | ".join(made[future])] = future.result()
                file.write_text(json.dumps(results))

    fill(2, [run for run in RUNS if run != "price"])
    fill(1, PRICE)
    return results


def value(results, basis, remedy, column):
    """The number of a column, or None where there is none."""
    _, run, name, factor, _, _ = column

    def metric(run, name, of=remedy):
        return results[f"{basis} | {of} | {run}"]["metrics"].get(name, {}).get("value")

    if run == "price":
        cpu = [min(results[f"{basis} | {of} | {run}"]["time"]["cpu_s"] for run in PRICE) for of in (remedy, "none")]
        return cpu[0] / cpu[1]
    if run == "vortex n16":
        errors = [metric(level, "mean_stress_l2") for level in ("vortex n16", "vortex")]
        return math.log2(errors[0] / errors[1]) if all(errors) else None
    record = results[f"{basis} | {remedy} | {run}"]
    if name == "end":
        return record.get("error", {}).get("time", 24.0)
    found = metric(run, name)
    return None if found is None or record["status"] != "ok" else factor * found


def main():
    program, file, *picture = sys.argv[1:]
    results = complete(program, pathlib.Path(file))
    for basis, title in BASES.items():
        print(f"\n{title}:\n\n| average | " + " | ".join(c[0] for c in COLUMNS) + " |\n|---" * 1 + "|---" * len(COLUMNS) + "|")
        for remedy in REMEDIES:
            cells = [value(results, basis, remedy, column) for column in COLUMNS]
            texts = ["–" if cell is None else f"{cell:.{c[4]}f}" for cell, c in zip(cells, COLUMNS)]
            print(f"| `{remedy}` | " + " | ".join(texts) + " |")


if __name__ == "__main__":
    main()
