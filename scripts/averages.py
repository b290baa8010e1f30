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
    "footing": ["footing", "b10"],
    "dam": ["dam-break", "h0.25", "cfl=0.3"],
    "vortex": ["mms-vortex-box", "n32"],
    "axis": ["mms-axis", "n64"],
    "swirl": ["mms-swirl", "n16"],
    "column": ["column", "h0.25", "duration=5.04"],
    "wave": ["standing-wave", "n8", "duration=24"],
    "cook, ν = 0.499999": ["cook", "h2", "poisson_ratio=0.499999"],
    "price": ["mms-axis", "n64"],
}
PRICE = ["price 1", "price 2", "price 3"]
# Heading in two lines, run, metric, factor, digits, the exact value, and the error below which all are alike.
COLUMNS = [
    ("price", "/none", "price", None, 1, 2, 0, 0),
    ("Cook h1", "u (%)", "cook", "fem_mid_edge_error", 100, 2, 0, 0.1),
    ("", "σ_m (mPa)", "cook", "mean_stress_rms_error", 1e3, 1, 0, 0),
    ("", "noise", "cook", "checkerboard_ratio", 1, 3, 0, 0),
    ("ν→½", "noise", "cook, ν = 0.499999", "checkerboard_ratio", 1, 2, 0, 0),
    ("footing", "N_c", "footing", "nc_effective", 1, 2, 5.14, 0.05),
    ("", "noise", "footing", "checkerboard_ratio", 1, 3, 0, 0),
    ("dam h¼", "front (m)", "dam", "front_rms_error", 1, 3, 0, 0),
    ("", "(kPa)", "dam", "checkerboard_rms", 1e-3, 2, 0, 0),
    ("vortex 32", "u (mm)", "vortex", "displacement_l2", 1e3, 3, 0, 0),
    ("", "σ_m (Pa)", "vortex", "mean_stress_l2", 1, 0, 0, 0),
    ("axis 64", "u (µm)", "axis", "displacement_l2", 1e6, 2, 0, 0),
    ("swirl 16", "u (mm)", "swirl", "displacement_l2", 1e3, 3, 0, 0),
    ("", "σ_m (Pa)", "swirl", "mean_stress_l2", 1, 1, 0, 0),
    ("column", "(µJ/m)", "column", "kinetic_energy_peak", 1e6, 3, 0, 0.01),
    ("wave 8", "lost (s)", "wave", "end", 1, 1, 24, 0),
]
# Colours of a cell, from the ratio of its error to the least of the column up.
COLOURS = [(1.2, "#fff"), (2, "#fee8c8"), (4, "#fdbb84"), (16, "#ef6548"), (math.inf, "#b30000")]
WIDTH, HEIGHT, NAME = 58, 15, 140


def make(program, basis, remedy, run):
    case, level, *changed = RUNS[run.split(" ")[0] if run in PRICE else run]
    command = [program, "run", case, "--scheme", f"{basis}-{remedy}-flip", "--level", level, "--threads", "1", "--json"]
    for value in changed:
        command += ["--set", value]
    said = subprocess.run(command, capture_output=True, text=True)
    try:
        return json.loads(said.stdout)
    except json.JSONDecodeError:
        print(f"{' '.join(command)}: {said.stdout}{said.stderr}", file=sys.stderr, flush=True)
        return {"status": "refused", "metrics": {}, "error": {"time": 0.0}}


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
    run, name, factor = column[2:5]
    if run == "price":
        cpu = [min(results[f"{basis} | {of} | {run}"]["time"]["cpu_s"] for run in PRICE) for of in (remedy, "none")]
        return cpu[0] / cpu[1]
    record = results[f"{basis} | {remedy} | {run}"]
    if name == "end":
        return record.get("error", {}).get("time", 24.0)
    found = record["metrics"].get(name, {}).get("value")
    return None if found is None or record["status"] != "ok" else factor * found


def table(results, basis):
    """Texts of the cells with their colours, by remedy."""
    rows = {remedy: [value(results, basis, remedy, column) for column in COLUMNS] for remedy in REMEDIES}
    cells = {remedy: [] for remedy in REMEDIES}
    for k, (*_, digits, exact, alike) in enumerate(COLUMNS):
        errors = {remedy: abs(row[k] - exact) + alike for remedy, row in rows.items() if row[k] is not None}
        least = max(min(errors.values()), 1e-9)
        for remedy, row in rows.items():
            text = "–" if row[k] is None else f"{row[k]:.{digits}f}"
            ratio = errors.get(remedy, math.inf) / least
            cells[remedy].append((text, next(colour for most, colour in COLOURS if ratio <= most)))
    return cells


def draw(results):
    """The tables as a picture: paths of one colour, and a line of text a row."""
    height = HEIGHT * (len(BASES) * (len(REMEDIES) + 3) + 1)
    paths, texts, y = {}, [], HEIGHT

    def line(name, cells, y, weight="normal"):
        xs = [NAME + WIDTH * (k + 1) - 6 for k in range(len(cells))]
        spans = "".join(f'<tspan x="{x}" text-anchor="end">{cell}</tspan>' for x, cell in zip(xs, cells) if cell)
        texts.append(f'<text y="{y}" font-weight="{weight}"><tspan x="4">{name}</tspan>{spans}</text>')

    for basis, title in BASES.items():
        line(title, [column[0] for column in COLUMNS], y, "bold")
        line("", [column[1] for column in COLUMNS], y + HEIGHT, "bold")
        y += 2 * HEIGHT
        for remedy, cells in table(results, basis).items():
            for k, (_, colour) in enumerate(cells):
                box = f"M{NAME + WIDTH * k} {y - 11}h{WIDTH}v{HEIGHT}h-{WIDTH}z"
                paths.setdefault(colour, []).append(box)
            line(remedy, [text for text, _ in cells], y)
            y += HEIGHT
        y += HEIGHT
    size = f"{NAME + WIDTH * len(COLUMNS) + 4} {height}"
    boxes = "".join(f'<path fill="{colour}" d="{"".join(boxes)}"/>' for colour, boxes in paths.items())
    style = 'font-family="DejaVu Sans, Arial, sans-serif" font-size="10"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size}" {style}>{boxes}{"".join(texts)}</svg>'


def main():
    program, file, *picture = sys.argv[1:]
    results = complete(program, pathlib.Path(file))
    for basis, title in BASES.items():
        heads = [" ".join(column[:2]).strip() for column in COLUMNS]
        print(f"\n{title}:\n\n| average | {' | '.join(heads)} |\n|---{'|---' * len(COLUMNS)}|")
        for remedy, cells in table(results, basis).items():
            print(f"| `{remedy}` | {' | '.join(text for text, _ in cells)} |")
    for path in picture:
        pathlib.Path(path).write_text(draw(results))


if __name__ == "__main__":
    main()
