"""Cook's membrane or the cantilever (Hencky) in CB-Geo MPM (geomechanics/mpm), from what `export` writes to what `score` reads. Needs h5py.

    commit 4044dbe, cmake Release, g++ 12, Boost 1.74, Eigen 3.4, HDF5 1.10; without MPI, for which an empty mpi.h had to stand in the
    include path, as krylov_petsc.h includes it always; cook in 4, cantilever in 20 load steps
    python convert.py cook-h2 result PATH/mpm [ED2Q4|ED2Q16G|ED2Q4P2B] [P2DFS|P2DBBAR|P2D] [HenckyHyperElastic2D|LinearElastic2D] [steps]
"""
import json, os, resource, subprocess, sys
from pathlib import Path
import h5py, numpy as np

source, out, program = Path(sys.argv[1]), Path(sys.argv[2]).absolute(), str(Path(sys.argv[3]).absolute())
cell, kind, law, steps = (sys.argv[4:] + ["ED2Q4", "P2DFS", "HenckyHyperElastic2D", "4"][len(sys.argv) - 4:])[:4]
steps = int(steps)
told = json.loads((source / "problem.json").read_text())
h, value = told["cell_size_m"], {p["name"]: p["value"] for p in told["parameters"]}
head = (source / "start.csv").read_text().splitlines()[0].split(",")
start = dict(zip(head, np.loadtxt(source / "start.csv", delimiter=",", skiprows=1).T))
X = np.column_stack([start["x (m)"], start["y (m)"]])
volume = start["reference_volume (m²)"]
COOK = told["case"] == "cook"
load = start["load_y (N/m)"] if COOK else np.zeros(len(X))
density = start["mass (kg/m)"][0] / volume[0]
out.mkdir(parents=True, exist_ok=True)
left = 2 if cell != "ED2Q4" else 0
i0, j0, nx, ny = (-left, -round(4 / h), round(54 / h), round(68 / h)) if COOK else (-left, -round(1.2 / h), round(1.2 / h), round(0.5 / h))
width = nx - i0 + 1
number = lambda i, j: (j - j0) * width + i - i0
nodes = [(i * h, j * h) for j in range(j0, ny + 1) for i in range(i0, nx + 1)]
cells = [(number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)) for j in range(j0, ny) for i in range(i0, nx)]
lines = [f"{len(nodes)} {len(cells)}"] + ["%.12g %.12g" % n for n in nodes] + ["%d %d %d %d" % c for c in cells]
(out / "mesh.txt").write_text("\n".join(lines) + "\n")
(out / "particles.txt").write_text("\n".join([str(len(X))] + ["%.12g %.12g" % tuple(x) for x in X]) + "\n")
(out / "volumes.txt").write_text("\n".join("%d %.12g" % p for p in enumerate(volume)) + "\n")
held = [number(i, j) for i in range(i0, 1) for j in range(j0, ny + 1)]
(out / "fixed.txt").write_text("".join(f"{n} {d} 0\n" for n in held for d in (0, 1)))
(out / "sets.json").write_text(json.dumps({"cell_size_m": told["cell_size_m"], "particle_sets": [{"id": 1, "set": np.flatnonzero(load).tolist() if COOK else [0]}], "node_sets": [{"id": 1, "set": held}]}))
mesh = {"mesh": "mesh.txt", "entity_sets": "sets.json", "io_type": "Ascii2D", "check_duplicates": True, "isoparametric": False, "node_type": "N2D",
        "particles_volumes": "volumes.txt", "boundary_conditions": {"displacement_constraints": [{"file": "fixed.txt"}]}, "cell_type": cell}
if cell.endswith("B"):
    mesh["nonlocal_mesh_properties"] = {"type": "BSPLINE", "kernel_correction": False, "node_types": []}
if cell.endswith("G"):
    mesh["nonlocal_mesh_properties"] = {"type": "GIMP"}
side = np.sqrt(volume[0])
deck = {
    "title": "cook", "mesh": mesh,
    "particles": [{"generator": {"type": "file", "material_id": [0], "pset_id": 0, "io_type": "Ascii2D", "particle_type": kind,
                                 "check_duplicates": True, "location": "particles.txt"}}],
    "materials": [{"id": 0, "type": law, "density": density, "youngs_modulus": value["young_modulus"], "poisson_ratio": value["poisson_ratio"]}],
    "external_loading_conditions": {"gravity": [0.0, 0.0] if COOK else {"gravity": [0.0, -value["weight"] / density], "ramping_time": float(steps)}, "particle_surface_traction": [
        {"math_function_id": 0, "pset_id": 1, "dir": 1, "traction": load.max() / side}]},
    "math_functions": [{"id": 0, "type": "Linear", "xvalues": [0.0, steps - 0.999, 1e9], "fxvalues": [1.0 / steps, 1.0, 1.0]}],
    "analysis": {"type": "MPMImplicit2D", "mpm_scheme": "newmark", "scheme_settings": {
        "nonlinear": True, "quasi_static": True, "beta": 0.25, "gamma": 0.5, "max_iteration": 50, "displacement_tolerance": 1e-12,
        "residual_tolerance": 1e-12, "relative_residual_tolerance": 1e-9, "verbosity": 1},
        "locate_particles": True, "pressure_smoothing": False, "dt": 1.0, "uuid": "cook", "nsteps": steps + 1,
        "resume": {"resume": False, "uuid": "cook", "step": 0}, "damping": {"type": "Cundall", "damping_factor": 0.0},
        "linear_solver": {"assembler_type": "EigenImplicit2D", "solver_settings": [
            {"dof": "displacement", "solver_type": "DirectEigen", "sub_solver_type": "lu", "preconditioner_type": "none",
             "max_iter": 100, "tolerance": 1e-12, "verbosity": 0}]}},
    "post_processing": {"path": "results/", "vtk": [], "output_steps": steps}}
(out / "mpm.json").write_text(json.dumps(deck, indent=1))
begun = resource.getrusage(resource.RUSAGE_CHILDREN)
with open(out / "log.txt", "w") as log:
    done = subprocess.run([program, "-p", "1", "-f", str(out) + "/", "-i", "mpm.json"], stdout=log, stderr=log)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
cost = used.ru_utime + used.ru_stime - begun.ru_utime - begun.ru_stime
files = sorted((out / "results").rglob("*.h5"))
print(done.returncode, f"{cost:.2f} s CPU", files[-1:])
with h5py.File(files[-1]) as f:
    t = f["table"][()]
i = t["id"].astype(int)
u = np.column_stack([t["displacement_x"], t["displacement_y"]])
mean = (t["stress_xx"] + t["stress_yy"] + t["stress_zz"]) / 3
np.savetxt(out / "particles.csv", np.column_stack([X[i], u, mean if COOK else t["stress_xx"]]), "%.9g", ",",
           header="reference_x (m),reference_y (m),ux (m),uy (m)," + ("mean_stress (Pa)" if COOK else "stress_xx (Pa)"), comments="")
(out / "score.json").write_text(json.dumps({"cell_size_m": told["cell_size_m"], 
    "schema": 1, "code": {"name": "CB-Geo MPM", "version": "4044dbe", "url": "https://github.com/geomechanics/mpm"},
    "scheme": f"quasi-static, {cell}, {kind}, {law}", "case": told["case"], "level": told["level"], "parameters": {},
    "particles": "particles.csv", "cost": {"cpu_s": cost, "threads": 1, "steps": steps}}, indent=1))
