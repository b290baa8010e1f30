"""Cook's membrane in GeoTaichi, from what `export` writes to what `score` reads. Run it in a checkout of GeoTaichi
(commit 8e22a64; taichi 1.7.4, numpy 2.4, trimesh 3.23.5; empty modules stand for open3d and skimage, which are not used here).

    python convert.py cook-h2 result [GIMP|QuadBSpline] ["F-Bar Method"] [LinearElastic] [USL|MUSL]
"""
import json, sys, time
from pathlib import Path
import numpy as np
import taichi as ti
sys.path.insert(0, ".")
from geotaichi import *

source, out = Path(sys.argv[1]).absolute(), Path(sys.argv[2]).absolute()
shape = sys.argv[3] if len(sys.argv) > 3 else "GIMP"
MODEL = sys.argv[5] if len(sys.argv) > 5 else "LinearElastic"
stabilize = sys.argv[4] if len(sys.argv) > 4 and sys.argv[4] else None
MAPPING = sys.argv[6] if len(sys.argv) > 6 else "USL"
told = json.loads((source / "problem.json").read_text())
h, value = told["cell_size_m"], {p["name"]: p["value"] for p in told["parameters"]}
head = (source / "start.csv").read_text().splitlines()[0].split(",")
start = dict(zip(head, np.loadtxt(source / "start.csv", delimiter=",", skiprows=1).T))
X = np.column_stack([start["x (m)"], start["y (m)"]])
load, volume = start["load_y (N/m)"], start["reference_volume (m²)"]
E, nu = value["young_modulus"], value["poisson_ratio"]
mu, lam = E / 2 / (1 + nu), E * nu / (1 + nu) / (1 - 2 * nu)
period = 60 * np.sqrt(70 * value["density"] / E)
dt = 0.3 * h / np.sqrt((lam + 2 * mu) / value["density"])
alpha, seconds = 12 / period, 1.5 * period
shift, half = 4 * h, np.sqrt(volume[0]) / 2
out.mkdir(parents=True, exist_ok=True)
size = [60 + 2 * shift, 68 + 2 * shift]
np.savetxt(out / "start.txt", np.column_stack([X + shift, volume, np.full((len(X), 2), half)]), "%.10g")

init(dim=2, arch="cpu", cpu_max_num_threads=1, log=False)
mpm = MPM(log=False)
mpm.set_configuration(domain=size, background_damping=0.0, gravity=[0.0, 0.0], alphaPIC=0.0, mapping=MAPPING,
                      shape_function=shape, stabilize=stabilize, visualize=False)
mpm.set_solver({"Timestep": dt, "SimulationTime": seconds, "SaveInterval": seconds, "SavePath": str(out / "data")})
mpm.memory_allocate({"max_material_number": 1, "max_particle_number": len(X),
                     "max_constraint_number": {"max_velocity_constraint": 100000, "max_particle_traction_constraint": int((load > 0).sum())}})
mpm.add_material(model=MODEL, material={"MaterialID": 1, "Density": value["density"], "YoungModulus": E, "PoissonRatio": nu})
mpm.add_element({"ElementType": "Q4N2D", "ElementSize": [h, h]})
edge = X[load > 0].min(0) + shift - half, X[load > 0].max(0) + shift + half
mpm.add_region([{"Name": "edge", "Type": "Rectangle2D", "BoundingBoxPoint": list(edge[0]), "BoundingBoxSize": list(edge[1] - edge[0])}])
mpm.add_body_from_file({"FileType": "TXT", "Template": {
    "ParticleFile": str(out / "start.txt"), "BodyID": 0, "MaterialID": 1, "InitialVelocity": [0.0, 0.0], "FixVelocity": ["Free", "Free"],
    "Traction": {"Pressure": ti.Vector([0.0, load.max() / (2 * half)]), "RegionName": "edge"}}})
mpm.add_boundary_condition([{"BoundaryType": "VelocityConstraint", "Velocity": [0.0, 0.0], "StartPoint": [0.0, 0.0], "EndPoint": [shift, size[1]]}])
mpm.select_save_data()


factor = 1.0 - alpha * dt


def brake():  # GeoTaichi makes a kernel of it
    for p in range(mpm.scene.particle.shape[0]):
        mpm.scene.particle[p].v *= factor


begun = time.process_time()
mpm.run(function=brake)
cost, steps = time.process_time() - begun, round(seconds / mpm.sims.dt[None])
x, s = mpm.scene.particle.x.to_numpy()[: len(X)], mpm.scene.particle.stress.to_numpy()[: len(X)]
print("dt", dt, mpm.sims.dt[None], "stress", s.shape, "|v|", abs(mpm.scene.particle.v.to_numpy()).max())
print(f"{cost:.2f} s CPU with compiling, {steps} steps, {1e9 * cost / steps / len(X):.0f} ns per particle and step")
np.savetxt(out / "particles.csv", np.column_stack([X, x - shift - X, s[:, :3].sum(1) / 3]), "%.9g", ",",
           header="reference_x (m),reference_y (m),ux (m),uy (m),mean_stress (Pa)", comments="")
(out / "score.json").write_text(json.dumps({"cell_size_m": told["cell_size_m"], 
    "schema": 1, "code": {"name": "GeoTaichi", "version": "8e22a64", "url": "https://github.com/Yihao-Shi/GeoTaichi"},
    "scheme": f"{shape}, FLIP, {MAPPING}, {stabilize or 'standard'}, {MODEL}", "case": "cook", "level": told["level"], "parameters": {},
    "particles": "particles.csv", "time_step_s": dt, "cost": {"cpu_s": cost, "threads": 1, "steps": steps}}, indent=1))
