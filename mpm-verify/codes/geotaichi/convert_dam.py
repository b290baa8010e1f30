"""The dam break in GeoTaichi: python convert_dam.py dam result [alphaPIC] [F-Bar Method] (run in a checkout of GeoTaichi,
as convert.py). The water starts without its compression."""
import glob, json, sys, time
from pathlib import Path
import numpy as np
import taichi as ti
sys.path.insert(0, ".")
from geotaichi import *

source, out = Path(sys.argv[1]).absolute(), Path(sys.argv[2]).absolute()
pic = float(sys.argv[3]) if len(sys.argv) > 3 else 0.0
stabilize = sys.argv[4] if len(sys.argv) > 4 else None
told = json.loads((source / "problem.json").read_text())
h, value = told["cell_size_m"], {p["name"]: p["value"] for p in told["parameters"]}
head = (source / "start.csv").read_text().splitlines()[0].split(",")
start = dict(zip(head, np.loadtxt(source / "start.csv", delimiter=",", skiprows=1).T))
X = np.column_stack([start["reference_x (m)"], start["reference_y (m)"]])
volume, K = start["reference_volume (m²)"], value["bulk_modulus"]
dt, end = 0.2 * h / np.sqrt(K / value["density"]), value["duration"]
side = np.sqrt(volume[0])
out.mkdir(parents=True, exist_ok=True)
np.savetxt(out / "start.txt", np.column_stack([X, volume, np.full((len(X), 2), side / 2)]), "%.10g")
init(dim=2, arch="cpu", cpu_max_num_threads=1, log=False)
mpm = MPM(log=False)
mpm.set_configuration(domain=[6.0, 8.0], background_damping=0.0, gravity=[0.0, -9.81], alphaPIC=pic, mapping="USL",
                      shape_function="QuadBSpline", material_type="Fluid", stabilize=stabilize, visualize=False)
mpm.set_solver({"Timestep": dt, "SimulationTime": end, "SaveInterval": 0.005, "SavePath": str(out / "data")})
mpm.memory_allocate({"max_material_number": 1, "max_particle_number": len(X), "max_constraint_number": {"max_reflection_constraint": 10000}})
mpm.add_material(model="Newtonian", material={"MaterialID": 1, "Density": value["density"], "Modulus": K, "Viscosity": value["viscosity"],
                                              "ElementLength": h, "cL": 0.0, "cQ": 0.0})
mpm.add_element({"ElementType": "Q4N2D", "ElementSize": [h, h]})
mpm.add_region([{"Name": "all", "Type": "Rectangle2D", "BoundingBoxPoint": [0.0, 0.0], "BoundingBoxSize": [6.0, 8.0]}])
mpm.add_body_from_file({"FileType": "TXT", "Template": {"ParticleFile": str(out / "start.txt"), "BodyID": 0, "MaterialID": 1,
    "InitialVelocity": [0.0, 0.0], "FixVelocity": ["Free", "Free"]}})
mpm.add_boundary_condition([
    {"BoundaryType": "ReflectionConstraint", "Norm": [-1.0, 0.0], "StartPoint": [0.0, 0.0], "EndPoint": [0.0, 8.0]},
    {"BoundaryType": "ReflectionConstraint", "Norm": [1.0, 0.0], "StartPoint": [6.0, 0.0], "EndPoint": [6.0, 8.0]},
    {"BoundaryType": "ReflectionConstraint", "Norm": [0.0, -1.0], "StartPoint": [0.0, 0.0], "EndPoint": [6.0, 0.0]}])
mpm.select_save_data()
begun = time.process_time()
mpm.run()
cost, steps = time.process_time() - begun, round(end / mpm.sims.dt[None])
m, rows = value["density"] * volume[0], []
for f in sorted(glob.glob(str(out / "data/particles/*.npz"))):
    d = np.load(f, allow_pickle=True)
    x, v = d["position"], d["velocity"]
    rows.append((float(d["t_current"]), x[:, 0].max() + side / 2, 0.5 * m * (v**2).sum(), 9.81 * m * x[:, 1].sum()))
print(f"{cost:.1f} s CPU with compiling and files, {steps} steps, {1e9 * cost / steps / len(X):.0f} ns per particle and step", len(rows))
np.savetxt(out / "series.csv", rows, "%.9g", ",", header="time (s),front (m),kinetic_energy (J/m),potential_energy (J/m)", comments="")
(out / "score.json").write_text(json.dumps({"cell_size_m": told["cell_size_m"], 
    "schema": 1, "code": {"name": "GeoTaichi", "version": "8e22a64", "url": "https://github.com/Yihao-Shi/GeoTaichi"},
    "scheme": f"QuadBSpline, alphaPIC {pic}, USL, {stabilize or 'standard'}", "case": "dam-break", "level": told["level"], "parameters": {},
    "series": "series.csv", "time_step_s": dt, "cost": {"cpu_s": cost, "threads": 1, "steps": steps}}, indent=1))
