"""Cook's membrane and the dam break in Taichi, from what `mpm-verify export` writes to what `mpm-verify score` reads.

    mpm-verify export cook --level h2 --out cook
    python solve.py cook result
    mpm-verify score result

The step is that of the bench's peer (`../../benches/peers/taichi_mpm.py`) without F-bar: quadratic B-splines with nodes on
grid lines, FLIP, stress at the end of the step. Nodes on and beyond a wall are held.
"""

import json
import math
import sys
import time
from pathlib import Path

import numpy as np
import taichi as ti

source, out = map(Path, sys.argv[1:3])
told = json.loads((source / "problem.json").read_text())
case, h = told["case"], told["cell_size_m"]
value = {p["name"]: p["value"] for p in told["parameters"]}
head = (source / "start.csv").read_text().splitlines()[0].split(",")
start = dict(zip(head, np.loadtxt(source / "start.csv", delimiter=",", skiprows=1).T))
N = len(start["x (m)"])
COOK = case == "cook"
MARGIN, CELLS = 3, (54, 72) if COOK else (6, 16)
SHAPE = tuple(2 * MARGIN + math.ceil(length / h) + 1 for length in CELLS)
GRAVITY, RATIO = (0.0 if COOK else -9.81), 0.3
if COOK:
    E, NU = value["young_modulus"], value["poisson_ratio"]
    MU, LAMBDA = E / 2 / (1 + NU), E * NU / (1 + NU) / (1 - 2 * NU)
    MODULUS, PERIOD = LAMBDA + 2 * MU, 60.0 * math.sqrt(70.0 * value["density"] / E)
    END, ROW, DAMPING = 2 * PERIOD, PERIOD / 240, 8.0 / PERIOD
else:
    MU, LAMBDA, MODULUS = value["viscosity"], value["bulk_modulus"], value["bulk_modulus"]
    END, ROW, DAMPING = value["duration"], 0.005, 0.0
STEPS = math.ceil(ROW / (RATIO * h / math.sqrt(MODULUS / value["density"])))
DT = ROW / STEPS

ti.init(arch=ti.cpu, default_fp=ti.f64, cpu_max_num_threads=1, log_level=ti.ERROR, offline_cache=False)
x, v, load = (ti.Vector.field(2, ti.f64, N) for _ in range(3))
F, stress = (ti.Matrix.field(2, 2, ti.f64, N) for _ in range(2))
J, mean, mass, volume = (ti.field(ti.f64, N) for _ in range(4))
weight_of = ti.field(ti.f64, SHAPE)
momentum, force = (ti.Vector.field(2, ti.f64, SHAPE) for _ in range(2))
reaction, work = ti.field(ti.f64, ()), ti.field(ti.f64, ())


@ti.func
def stencil(position):
    base = ti.cast(ti.floor(position / h - 0.5), ti.i32)
    fx = position / h - ti.cast(base, ti.f64)
    w = [0.5 * (1.5 - fx) ** 2, 0.75 - (fx - 1.0) ** 2, 0.5 * (fx - 0.5) ** 2]
    return base + MARGIN, w, [(fx - 1.5) / h, -2.0 * (fx - 1.0) / h, (fx - 0.5) / h]


@ti.kernel
def step(share: ti.f64):
    for node in ti.grouped(weight_of):
        weight_of[node], momentum[node], force[node] = 0.0, ti.Vector([0.0, 0.0]), ti.Vector([0.0, 0.0])
    for p in range(N):
        base, w, dw = stencil(x[p])
        for i, j in ti.static(ti.ndrange(3, 3)):
            node, weight = base + ti.Vector([i, j]), w[i][0] * w[j][1]
            slope = ti.Vector([dw[i][0] * w[j][1], w[i][0] * dw[j][1]])
            weight_of[node] += weight * mass[p]
            momentum[node] += weight * mass[p] * v[p]
            pull = weight * (share * load[p] + mass[p] * ti.Vector([0.0, GRAVITY]))
            force[node] += pull - J[p] * volume[p] * (stress[p] @ slope)
    reaction[None] = 0.0
    for node in ti.grouped(weight_of):
        if weight_of[node] > 0.0:
            old = momentum[node] / weight_of[node]
            new = old + DT * force[node] / weight_of[node]
            place = node - MARGIN
            if ti.static(COOK):
                if place[0] <= 0:
                    reaction[None] += -force[node][1]
                    new = ti.Vector([0.0, 0.0])
            else:
                # What leaves a wall may leave it.
                if place[0] * h <= 0.0:
                    new[0] = ti.max(new[0], 0.0)
                if place[0] * h >= 6.0:
                    new[0] = ti.min(new[0], 0.0)
                if place[1] <= 0:
                    new[1] = ti.max(new[1], 0.0)
            momentum[node], force[node] = new, new - old
    for p in range(N):
        base, w, dw = stencil(x[p])
        moving, change, L = ti.Vector([0.0, 0.0]), ti.Vector([0.0, 0.0]), ti.Matrix.zero(ti.f64, 2, 2)
        for i, j in ti.static(ti.ndrange(3, 3)):
            node, weight = base + ti.Vector([i, j]), w[i][0] * w[j][1]
            slope = ti.Vector([dw[i][0] * w[j][1], w[i][0] * dw[j][1]])
            moving += weight * momentum[node]
            change += weight * force[node]
            L += momentum[node].outer_product(slope)
        work[None] += DT * J[p] * volume[p] * (stress[p] @ L).trace()
        v[p] = (v[p] + change) * (1.0 - DAMPING * DT)
        x[p] += DT * moving
        step_ = ti.Matrix.identity(ti.f64, 2) + DT * L
        F[p], J[p] = step_ @ F[p], J[p] * step_.determinant()
        respond(p, L)


@ti.func
def respond(p, L):
    one = ti.Matrix.identity(ti.f64, 2)
    if ti.static(COOK):
        stress[p] = (MU * (F[p] @ F[p].transpose() - one) + LAMBDA * ti.log(J[p]) * one) / J[p]
        mean[p] = (stress[p].trace() + LAMBDA * ti.log(J[p]) / J[p]) / 3.0
    else:
        rate = 0.5 * (L + L.transpose())
        stress[p] = LAMBDA * (J[p] - 1.0) * one + 2.0 * MU * (rate - one * L.trace() / 3.0)
        mean[p] = LAMBDA * (J[p] - 1.0)


@ti.kernel
def respond_at_start():
    for p in range(N):
        respond(p, ti.Matrix.zero(ti.f64, 2, 2))


def columns(*names):
    return np.stack([start.get(name, np.zeros(N)) for name in names], axis=1)


x.from_numpy(columns("x (m)", "y (m)"))
load.from_numpy(columns("load_x (N/m)", "load_y (N/m)"))
mass.from_numpy(start["mass (kg/m)"])
volume.from_numpy(start["reference_volume (m²)"])
jacobian = start.get("jacobian (-)", np.ones(N))
J.from_numpy(jacobian)
F.from_numpy(np.stack([np.diag([1.0, j]) for j in jacobian]))
respond_at_start()
spacing = math.sqrt(start["reference_volume (m²)"][0])
series, begun, now = [], time.process_time(), 0.0
while now < END - 0.5 * ROW:
    for _ in range(STEPS):
        now += DT
        step(min(1.0, now / (0.08 * PERIOD)) if COOK else 1.0)
    places, speeds, masses = x.to_numpy(), v.to_numpy(), mass.to_numpy()
    kinetic = 0.5 * (masses * (speeds**2).sum(axis=1)).sum()
    if COOK:
        series.append((now, kinetic, reaction[None]))
    else:
        potential = 9.81 * (masses * places[:, 1]).sum()
        front = places[:, 0].max() + 0.5 * spacing
        series.append((now, front, kinetic, potential, work[None]))
cost = time.process_time() - begun

out.mkdir(parents=True, exist_ok=True)
named = {
    "cook": "time (s),kinetic_energy (J/m),reaction_y (N/m)",
    "dam-break": "time (s),front (m),kinetic_energy (J/m),potential_energy (J/m),stress_work (J/m)",
}
np.savetxt(out / "series.csv", series, "%.9g", ",", header=named[case], comments="")
manifest = {
    "schema": 1,
    "code": {"name": "Taichi", "version": ".".join(map(str, ti.__version__)), "url": "https://taichi-lang.org"},
    "scheme": "quadratic B-splines on grid lines, FLIP, standard MPM",
    "case": case,
    "level": told["level"],
    "parameters": json.loads((source / "score.json").read_text())["parameters"],
    "series": "series.csv",
    "time_step_s": DT,
    "cost": {"cpu_s": cost, "steps": STEPS * len(series), "threads": 1},
}
if COOK:
    moved = x.to_numpy() - columns("reference_x (m)", "reference_y (m)")
    table = np.column_stack([columns("reference_x (m)", "reference_y (m)"), moved, mean.to_numpy()])
    head = "reference_x (m),reference_y (m),ux (m),uy (m),mean_stress (Pa)"
    np.savetxt(out / "particles.csv", table, "%.9g", ",", header=head, comments="")
    manifest["particles"] = "particles.csv"
(out / "score.json").write_text(json.dumps(manifest, indent=2) + "\n")
