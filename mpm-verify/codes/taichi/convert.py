"""The hydrostatic column and the vibrating bar in Taichi, from what `mpm-verify export` writes to what `mpm-verify score` reads.
    pip install taichi==1.7.4 numpy
    mpm-verify export column --level h0.25 --out column
    python convert.py column result mirror 100000      # wall: held | mirror; steps
Standard MPM, quadratic B-splines with nodes on lines of cells, FLIP, stress at the end of the step, one thread, doubles. Walls: nodes on
and beyond a wall have no velocity along its normal (held); or what falls on nodes beyond it goes to their images with its sign (mirror),
as if mirrored particles were there. The bar is a strip one cell wide between rollers. Cook's membrane and the dam break were run with
the bench's own codes/taichi/solve.py of commit 8a00dbf1, unchanged."""
import json, sys, time
from pathlib import Path
import numpy as np
import taichi as ti
source, out, wall, steps = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3], int(sys.argv[4])
told = json.loads((source / "problem.json").read_text())
h, value = told["cell_size_m"], {p["name"]: p["value"] for p in told["parameters"]}
head = (source / "start.csv").read_text().splitlines()[0].split(",")
s = dict(zip(head, np.loadtxt(source / "start.csv", delimiter=",", skiprows=1).T))
BAR = told["case"] == "vibrating-bar"
if BAR:  # two rows of its particles
    rows, y = lambda a: np.concatenate([a, a]), np.repeat([0.25 * h, 0.75 * h], len(s["x (m)"]))
    reference = place = np.column_stack([rows(s["x (m)"]), y])
    mass, volume, jacobian = rows(s["mass (kg/m²)"]) * h / 2, rows(s["reference_volume (m)"]) * h / 2, np.ones(len(y))
    nu = value["poisson_ratio"]; MU = value["young_modulus"] / 2 / (1 + nu); LAM = 2 * MU * nu / (1 - 2 * nu)
    k, G, HI = np.pi / value["length"], 0.0, (round(value["length"] / h), 1)
    omega, A, ROWS = k * np.sqrt((LAM + 2 * MU) / value["density"]), value["amplitude"], 1040
else:
    reference, place = (np.column_stack([s[f"{a}{d} (m)"] for d in "xy"]) for a in ("reference_", ""))
    mass, volume, jacobian = s["mass (kg/m)"], s["reference_volume (m²)"], s["jacobian (-)"]
    MU, LAM, G, HI, ROWS = 0.0, value["bulk_modulus"], -value["gravity"], (round(value["width"] / h), 10**6), 100
N, EACH = len(place), round(steps / ROWS)
DT = value["duration"] / (EACH * ROWS)
SHAPE, MIRROR = (HI[0] + 7, 9 if BAR else round(value["height"] / h) + 7), wall == "mirror"
ti.init(arch=ti.cpu, default_fp=ti.f64, cpu_max_num_threads=1, log_level=ti.ERROR, offline_cache=False)
x, v = (ti.Vector.field(2, ti.f64, N) for _ in range(2))
J, m, V = (ti.field(ti.f64, N) for _ in range(3))
gm = ti.field(ti.f64, SHAPE)
gp, gf = (ti.Vector.field(2, ti.f64, SHAPE) for _ in range(2))
@ti.func
def stencil(q):
    b = ti.cast(ti.floor(q / h - 0.5), ti.i32); f = q / h - b
    return b, [0.5 * (1.5 - f) ** 2, 0.75 - (f - 1.0) ** 2, 0.5 * (f - 0.5) ** 2], [(f - 1.5) / h, -2.0 * (f - 1.0) / h, (f - 0.5) / h]
@ti.func
def image(n):  # the node that acts for n, and the signs of vectors
    r, sign = n, ti.Vector([1.0, 1.0])
    if ti.static(MIRROR):
        for d in ti.static(range(2)):
            if n[d] < 0 or n[d] > HI[d]:
                r[d], sign[d] = -n[d] if n[d] < 0 else 2 * HI[d] - n[d], -1.0
    return r + 3, sign
@ti.kernel
def step():
    for n in ti.grouped(gm): gm[n], gp[n], gf[n] = 0.0, ti.Vector([0.0, 0.0]), ti.Vector([0.0, 0.0])
    for p in range(N):
        b, w, g = stencil(x[p])
        stress = (MU * (J[p] ** 2 - 1.0) + LAM * ti.log(J[p])) / J[p] if ti.static(BAR) else LAM * (J[p] - 1.0)
        for i, j in ti.static(ti.ndrange(3, 3)):
            n, sign = image(b + ti.Vector([i, j]))
            weight, slope = w[i][0] * w[j][1], ti.Vector([g[i][0] * w[j][1], w[i][0] * g[j][1]])
            gm[n] += weight * m[p]; gp[n] += weight * m[p] * sign * v[p]
            gf[n] += sign * (weight * m[p] * ti.Vector([0.0, G]) - J[p] * V[p] * stress * slope)
    for n in ti.grouped(gm):
        if gm[n] > 0.0:
            old = gp[n] / gm[n]; new = old + DT * gf[n] / gm[n]
            for d in ti.static(range(2)):
                if n[d] - 3 <= 0 or n[d] - 3 >= HI[d]:
                    new[d] = 0.0
            gp[n], gf[n] = new, new - old
    for p in range(N):
        b, w, g = stencil(x[p])
        moving, change, L = ti.Vector([0.0, 0.0]), ti.Vector([0.0, 0.0]), ti.Matrix.zero(ti.f64, 2, 2)
        for i, j in ti.static(ti.ndrange(3, 3)):
            n, sign = image(b + ti.Vector([i, j]))
            weight, slope = w[i][0] * w[j][1], ti.Vector([g[i][0] * w[j][1], w[i][0] * g[j][1]])
            moving += weight * sign * gp[n]; change += weight * sign * gf[n]; L += (sign * gp[n]).outer_product(slope)
        v[p] += change; x[p] += DT * moving
        J[p] *= (1.0 + DT * L[0, 0]) * (1.0 + DT * L[1, 1]) - DT * DT * L[0, 1] * L[1, 0]
x.from_numpy(place); m.from_numpy(mass); V.from_numpy(volume); J.from_numpy(jacobian)
wave = np.sin(k * reference[:, 0]) if BAR else None
if BAR: v.from_numpy(np.column_stack([A * omega * wave, 0 * wave]))
series, begun = [], time.process_time()
for row in range(ROWS):
    for _ in range(EACH): step()
    j, kinetic = J.to_numpy(), 0.5 * (mass * (v.to_numpy() ** 2).sum(1)).sum()
    if BAR:  # per area of the section
        stored = (volume * (MU / 2 * (j**2 - 1 - 2 * np.log(j)) + LAM / 2 * np.log(j) ** 2)).sum()
        mode = ((x.to_numpy() - reference)[:, 0] * wave).sum() / (A * wave**2).sum()
        series.append(((row + 1) * EACH * DT, kinetic / h, (kinetic + stored) / h, mode))
    else: series.append(((row + 1) * EACH * DT, kinetic))
cost = time.process_time() - begun
out.mkdir(parents=True, exist_ok=True)
told_ = "time (s),kinetic_energy (J),energy (J),mode (-)" if BAR else "time (s),kinetic_energy (J)"
np.savetxt(out / "series.csv", series, "%.6g", ",", header=told_, comments="")
run = {"schema": 1, "code": {"name": "Taichi", "version": "1.7.4", "url": "https://taichi-lang.org"}, "case": told["case"], "level": told["level"],
       "scheme": f"quadratic B-splines on grid lines, FLIP, standard MPM, walls {wall}", "series": "series.csv", "time_step_s": DT,
       "cost": {"cpu_s": cost, "steps": EACH * ROWS, "threads": 1}}
if not BAR:
    run["particles"] = "particles.csv"
    np.savetxt(out / "particles.csv", np.column_stack([reference, LAM * (j - 1), j]), "%.9g", ",",
               header="reference_x (m),reference_y (m),mean_stress (Pa),averaged_jacobian (-)", comments="")
run["cell_size_m"] = told["cell_size_m"]
(out / "score.json").write_text(json.dumps(run, indent=1))
