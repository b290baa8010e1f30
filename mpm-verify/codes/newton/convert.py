"""The dam break in Newton's implicit MPM (pip install newton), a slab one cell thick between walls without friction.

    newton 1.8.0, warp-lang 1.19.0, on the CPU, one thread of OpenMP
    mpm-verify export dam-break --out dam && python convert.py dam result && mpm-verify score result
"""
import json, sys, time
from pathlib import Path
import numpy as np
import warp as wp
import newton
from newton.solvers import SolverImplicitMPM

source, out = Path(sys.argv[1]), Path(sys.argv[2])
told = json.loads((source / "problem.json").read_text())
h, value = told["cell_size_m"], {p["name"]: p["value"] for p in told["parameters"]}
head = (source / "start.csv").read_text().splitlines()[0].split(",")
start = dict(zip(head, np.loadtxt(source / "start.csv", delimiter=",", skiprows=1).T))
X = np.column_stack([start["x (m)"], start["y (m)"]])
side, ROW, END = float(np.sqrt(start["reference_volume (m²)"][0])), 0.005, value["duration"]
layers = round(h / side)
wp.init(); wp.set_device("cpu")
builder = newton.ModelBuilder(gravity=(0.0, 0.0, -9.81))
SolverImplicitMPM.register_custom_attributes(builder)
m = float(start["mass (kg/m)"][0]) * h / layers
for k in range(layers):
    for x, z in X:
        builder.add_particle(pos=wp.vec3(x, (k + 0.5) * h / layers, z), vel=wp.vec3(0.0), mass=m, radius=side / 2)
cfg = newton.ModelBuilder.ShapeConfig(density=0.0, mu=0.0)
for plane in ((0.0, 0.0, 1.0, 0.0), (1.0, 0.0, 0.0, 0.0), (-1.0, 0.0, 0.0, 6.0), (0.0, 1.0, 0.0, 0.0), (0.0, -1.0, 0.0, h)):
    builder.add_shape_plane(plane=plane, width=0.0, length=0.0, body=-1, cfg=cfg)
model = builder.finalize()
model.mpm.friction.fill_(0.0); model.mpm.tensile_yield_ratio.fill_(1.0 if "--tension" in sys.argv else 0.0); model.mpm.viscosity.fill_(value["viscosity"])
config = SolverImplicitMPM.Config()
config.voxel_size, config.max_iterations, config.tolerance = h, 200, 1e-6
if "--gs" in sys.argv: config.solver = "gauss-seidel"
solver = SolverImplicitMPM(model, config=config)
a, b = model.state(), model.state()
series = []


def row(t):
    q, v = a.particle_q.numpy(), a.particle_qd.numpy()
    series.append((t, q[:, 0].max() + side / 2, 0.5 * m / h * (v**2).sum(), 9.81 * m / h * q[:, 2].sum()))


row(0.0)
solver.step(a, b, None, None, ROW)  # compiles
a, b = model.state(), model.state()
begun = time.process_time()
for i in range(round(END / ROW)):
    solver.step(a, b, None, None, ROW)
    solver.project_outside(b, b, ROW)
    a, b = b, a
    row((i + 1) * ROW)
cost = time.process_time() - begun
steps = len(series) - 1
print(f"{cost:.1f} s CPU, {steps} steps, {1e9 * cost / steps / len(X) / layers:.0f} ns per particle and step; y {a.particle_q.numpy().min(0)} {a.particle_q.numpy().max(0)}")
out.mkdir(parents=True, exist_ok=True)
np.savetxt(out / "series.csv", series, "%.9g", ",", header="time (s),front (m),kinetic_energy (J/m),potential_energy (J/m)", comments="")
(out / "score.json").write_text(json.dumps({"cell_size_m": told["cell_size_m"], 
    "schema": 1, "code": {"name": "Newton (Warp), CPU", "version": newton.__version__, "url": "https://github.com/newton-physics/newton"},
    "scheme": "implicit, incompressible, trilinear, slab of one cell", "case": "dam-break", "level": told["level"], "parameters": {},
    "series": "series.csv", "time_step_s": ROW, "cost": {"cpu_s": cost, "threads": 1, "steps": steps}}, indent=1))
