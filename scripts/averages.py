#!/usr/bin/env python3
"""The chart of docs/averages.md: forms of F̄ by the functions that average, over problems of the bench.

usage: averages.py PROGRAM RESULTS.json [REMEDY...]

Makes the runs that RESULTS.json lacks, two at a time, prints the tables, and draws them to RESULTS.svg: of all remedies, or
of those that are named.
All runs take about 70 minutes on two cores.
Price: CPU time of a particle in a step on one thread, over that of none; the least of three runs, undisturbed.
"""

import concurrent.futures
import json
import math
import pathlib
import subprocess
import sys

SPACES = ["", "-hats", "-cells", "-patches", "-blocks"]
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
    "axis 32": ["mms-axis", "n32"],
    "step": ["critical-step", "n6", "poisson_ratio=0.499"],
    "swirl": ["mms-swirl", "n16"],
    "column": ["column", "h0.25", "duration=5.04"],
    "wave": ["standing-wave", "n8", "duration=24"],
    "cook, ν = 0.499999": ["cook", "h2", "poisson_ratio=0.499999"],
    "price": ["cook", "h2"],
}
PRICE = ["price 1", "price 2", "price 3"]
# Heading in two lines, run, metric, factor, format, the exact value, and the error below which all are alike.
COLUMNS = [
    ("price", "/none", "price", None, 1, ".2f", 0, 0),
    ("Cook h1", "u (%)", "cook", "fem_mid_edge_error", 100, ".2f", 0, 0.1),
    ("", "σ_m mPa", "cook", "mean_stress_rms_error", 1e3, ".1f", 0, 0),
    ("", "noise", "cook", "checkerboard_ratio", 1, ".3f", 0, 0.05),
    ("ν→½", "noise", "cook, ν = 0.499999", "checkerboard_ratio", 1, ".2f", 0, 0.05),
    ("", "u (%)", "cook, ν = 0.499999", "stiffer", 100, ".1f", 0, 1),
    ("footing", "N_c", "footing", "nc_effective", 1, ".2f", 5.14, 0.05),
    ("", "noise", "footing", "checkerboard_ratio", 1, ".3f", 0, 0.05),
    ("dam h¼", "front (m)", "dam", "front_rms_error", 1, ".3f", 0, 0),
    ("", "p (kPa)", "dam", "checkerboard_rms", 1e-3, ".2f", 0, 1),
    ("vortex 32", "u mm", "vortex", "displacement_l2", 1e3, ".3f", 0, 0),
    ("", "σ_m Pa", "vortex", "mean_stress_l2", 1, ".0f", 0, 0),
    ("axis 64", "u (µm)", "axis", "displacement_l2", 1e6, ".2f", 0, 0),
    ("", "order", "axis", "order", 1, ".1f", math.inf, 0),
    ("swirl 16", "u (mm)", "swirl", "displacement_l2", 1e3, ".3f", 0, 0),
    ("", "σ_m Pa", "swirl", "mean_stress_l2", 1, ".1f", 0, 0),
    ("column", "(J/m)", "column", "kinetic_energy_peak", 1, ".0e", 0, 1e-4),
    ("wave 8", "lost (s)", "wave", "end", 1, ".1f", 24, 12),
    ("step", "CFL", "step", "critical_cfl", 1, ".2f", math.inf, 0),
]
# Ratio of an error to the least of its column up to which it is as good.
BEST = 1.2


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


def complete(program, file, remedies):
    results = json.loads(file.read_text()) if file.exists() else {}

    def fill(workers, runs):
        jobs = [(basis, remedy, run) for run in runs for basis in BASES for remedy in remedies]
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
    """The number of a column; NaN without one."""
    run, name, factor = column[2:5]
    if run == "price":
        made = [[results[f"{basis} | {of} | {run}"] for run in PRICE] for of in (remedy, "none")]
        ours, none = [min(r["time"]["cpu_s"] / r["work"]["particle_steps"] for r in runs) for runs in made]
        return ours / none

    def found(run, name):
        record = results[f"{basis} | {remedy} | {run}"]
        return record["metrics"].get(name, {}).get("value", math.nan) if record["status"] == "ok" else math.nan

    if name == "end":
        return (results[f"{basis} | {remedy} | {run}"].get("error") or {}).get("time", 24.0)
    if name == "order":
        return math.log2(found("axis 32", "displacement_l2") / found("axis", "displacement_l2"))
    if name == "stiffer":
        return factor * (found(run, "mid_edge_uy") / found(PRICE[0], "mid_edge_uy") - 1)
    return factor * found(run, name)


def table(results, basis, remedies):
    """(text, ratio to the least error) of every cell by remedy; a dash breaks down, what no case offers is empty."""
    cells = {remedy: [] for remedy in remedies}
    for column in COLUMNS:
        *_, form, exact, alike = column
        of = {remedy: value(results, basis, remedy, column) for remedy in remedies}
        errors = {remedy: abs(number - exact) + alike for remedy, number in of.items() if not math.isnan(number)}
        least = max(min(errors.values()), 1e-9)
        for remedy, number in of.items():
            offered = column[2] == "price" or results[f"{basis} | {remedy} | {column[2]}"]["status"] != "refused"
            text = "–" if offered else ""
            if remedy in errors:
                text = format(number, form).replace("-", "−")
            cells[remedy].append((text, errors.get(remedy, math.nan) / least if exact < math.inf else math.nan))
    return cells


# Up to which ratio to the least error of a column a cell has which colour.
COLOURS = {BEST: "#08519c", 2: "#6baed6", 5: "#c6dbef", 20: "#fdd0a2", math.inf: "#e6550d"}
BROKEN = "#bdbdbd"
WIDTH, HEIGHT, LEFT, TOP = 46, 15, 150, 46


def picture(tables):
    """The tables as an SVG of colours, by the ratio to the least error of the column."""
    texts, boxes, top = [], {}, 0
    coloured = [k for k, column in enumerate(COLUMNS) if column[6] < math.inf]

    def text(x, y, content, anchor="middle"):
        texts.append(f'<text x="{x:g}" y="{y:g}" text-anchor="{anchor}">{content}</text>')

    for title, cells in tables.items():
        text(LEFT - 6, top + 12, title, "end")
        for k, column in enumerate(COLUMNS[k] for k in coloured):
            for line, head in enumerate(column[:2]):
                text(LEFT + (k + 0.5) * WIDTH, top + 26 + 13 * line, head)
        for row, (remedy, told) in enumerate(cells.items()):
            y = top + TOP + row * HEIGHT
            text(LEFT - 6, y + 11, remedy, "end")
            for k, (content, ratio) in enumerate(told[k] for k in coloured):
                found = [colour for most, colour in COLOURS.items() if ratio <= most]
                fill = found[0] if found else BROKEN if content == "–" else None
                boxes.setdefault(fill, []).append(f"M{LEFT + k * WIDTH} {y}h{WIDTH - 1}v{HEIGHT - 1}h{1 - WIDTH}z")
        top += TOP + HEIGHT * len(cells) + 14
    names = [f"up to {most:g} times the least error" for most in COLOURS if most < math.inf] + ["more", "breaks down"]
    for k, (name, fill) in enumerate(zip(names, [*COLOURS.values(), BROKEN])):
        text(26 + 186 * k, top + 11, name, "start")
        boxes.setdefault(fill, []).append(f"M{6 + 186 * k} {top}h14v14h-14z")
    boxes.pop(None, None)
    paths = [f'<path fill="{fill}" d="{"".join(path)}"/>' for fill, path in boxes.items()]
    size = f"0 0 {LEFT + WIDTH * len(coloured) + 150} {top + 20}"
    start = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{size}" font-family="sans-serif" font-size="11">'
    return "\n".join([start, '<rect width="100%" height="100%" fill="white"/>', *paths, *texts, "</svg>\n"])


def main():
    program, file, *named = sys.argv[1:]
    remedies = ["none"] + (named or REMEDIES[1:])
    results = complete(program, pathlib.Path(file), remedies)
    tables = {title: table(results, basis, remedies) for basis, title in BASES.items()}
    for cells in tables.values():
        heads = [" ".join(column[:2]).strip() for column in COLUMNS]
        print(f"\n| average | {' | '.join(heads)} |\n|---{'|---' * len(COLUMNS)}|")
        for remedy, texts in cells.items():
            bold = [f"**{text}**" if ratio <= BEST else text for text, ratio in texts]
            print(f"| `{remedy}` | {' | '.join(bold)} |")
    pathlib.Path(file).with_suffix(".svg").write_text(picture(tables))


if __name__ == "__main__":
    main()
