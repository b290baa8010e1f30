"""Solves an exported problem with a code of your own and writes what `mpm-verify score` and `board` read.

    mpm-verify export cook --level h2 --out cook-h2
    python template.py cook-h2 && mpm-verify score cook-h2

Only `run` is yours. No package is needed.
"""
import csv, json, sys, time
from pathlib import Path


def run(problem, start):
    """Places at the start X (m), displacements u (m) and stresses (xx, yy, zz, xy) (Pa, tension positive), a row a particle.

    `problem` is problem.json: problem["problem"] has grid, body, supports, law and loads, problem["parameters"] the numbers
    by name, problem["cell_size_m"] the cells. `start` has the columns of start.csv by name. Here nothing moves.
    """
    X = list(zip(start["reference_x (m)"], start["reference_y (m)"]))
    return X, [(0.0, 0.0) for _ in X], [(0.0, 0.0, 0.0, 0.0) for _ in X]


folder = Path(sys.argv[1])
problem = json.loads((folder / "problem.json").read_text())
problem["parameters"] = {p["name"]: p["value"] for p in problem["parameters"]}
with open(folder / "start.csv") as file:
    rows = list(csv.DictReader(file))
start = {name: [float(row[name]) for row in rows] for name in rows[0]}
begun = time.process_time()
X, u, stress = run(problem, start)
cpu = time.process_time() - begun
head = ["reference_x (m)", "reference_y (m)", "ux (m)", "uy (m)", "mean_stress (Pa)", "stress_xx (Pa)"]
with open(folder / "particles.csv", "w", newline="") as file:
    table = csv.writer(file)
    table.writerow(head)
    for x, d, s in zip(X, u, stress):
        table.writerow([*x, *d, sum(s[:3]) / 3, s[0]])
form = json.loads((folder / "score.json").read_text())
form.pop("series", None)
form |= {"code": {"name": "my code", "version": "0"}, "scheme": "nothing moves", "particles": "particles.csv",
         "cell_size_m": problem["cell_size_m"], "cost": {"cpu_s": max(cpu, 1e-3), "threads": 1}}
(folder / "score.json").write_text(json.dumps(form, indent=2))
