"""Cook's membrane, cantilever and vibrating bar in Kratos MPM, from what `mpm-verify export` writes to what `mpm-verify score` reads.
    pip install KratosMultiphysics==10.4.4 KratosMPMApplication==10.4.4 KratosLinearSolversApplication==10.4.4
    python convert.py cook-h1 result [--tri] [--up] [--steps 4]           (--up with --tri only)
    python convert.py cantilever-h0.1 result --hencky [--tri] [--up] --steps 20
    python convert.py vibrating-bar-n16 result [--tri] --steps 4160 (8320 on n32: score takes no step beyond its own CFL limit)
Hencky elasticity is Kratos' Mohr-Coulomb law of Hencky strains with a cohesion that is never reached. Loads are accelerations of
particles. Kratos gives no stress_zz in plane strain: here from J (displacements alone) or nu (xx + yy) (u-p)."""
import argparse, json, os, time
from pathlib import Path
import numpy as np
a = argparse.ArgumentParser()
a.add_argument("source", type=Path); a.add_argument("out", type=Path); a.add_argument("--steps", type=int, default=4)
for flag in ("--up", "--tri", "--hencky"): a.add_argument(flag, action="store_true")
a = a.parse_args()
os.environ["OMP_NUM_THREADS"] = "1"
import KratosMultiphysics as K, KratosMultiphysics.LinearSolversApplication
import KratosMultiphysics.MPMApplication as M
from KratosMultiphysics.MPMApplication.mpm_analysis import MpmAnalysis
K.Logger.GetDefaultOutput().SetSeverity(K.Logger.Severity.WARNING)
told = json.loads((a.source / "problem.json").read_text())
case, h, value = told["case"], told["cell_size_m"], {p["name"]: p["value"] for p in told["parameters"]}
head = (a.source / "start.csv").read_text().splitlines()[0].split(",")
s = dict(zip(head, np.loadtxt(a.source / "start.csv", delimiter=",", skiprows=1).T))
if BAR := case == "vibrating-bar":  # a strip one cell wide between rollers
    X = np.column_stack([np.tile(s["x (m)"], 2), np.repeat([h / 4, 3 * h / 4], len(s["x (m)"]))])
    side, density, load = h / 2, value["density"], np.zeros(len(X))
else:
    X, volume, mass = np.column_stack([s["x (m)"], s["y (m)"]]), s["reference_volume (m²)"], s["mass (kg/m)"]
    side, density = np.sqrt(volume[0]), mass[0] / volume[0]
    load = (s["load_y (N/m)"] if case == "cook" else -value["weight"] * volume) / mass
a.out.mkdir(parents=True, exist_ok=True); E, nu = value["young_modulus"], value["poisson_ratio"]
mu, lam = E / 2 / (1 + nu), E * nu / (1 + nu) / (1 - 2 * nu)
def mdpa(name, properties, nodes, cells, element, first, parts):
    text = [f"Begin Properties {properties}\nEnd Properties\nBegin Nodes", *("%d %.12g %.12g 0" % (i, *p) for i, p in nodes.items()), "End Nodes",
            f"Begin Elements {element}", *(f"{i + first} {properties} " + " ".join(map(str, c)) for i, c in enumerate(cells)), "End Elements"]
    for part, (points, elements) in parts.items():
        text += [f"Begin SubModelPart {part}\nBegin SubModelPartNodes", *map(str, points), "End SubModelPartNodes\nBegin SubModelPartElements", *map(str, elements), "End SubModelPartElements\nEnd SubModelPart"]
    (a.out / name).write_text("\n".join(text) + "\n")
# Grid: nodes on lines of cells, as ours; clamped at x = 0. Body: a square for each of our particles, one material point in its middle.
nx, ny, low = {"cook": (round(52 / h), round(64 / h), -round(4 / h)), "cantilever": (round(1.2 / h), round(0.5 / h), -round(1.2 / h)), "vibrating-bar": (round(1 / h), 1, 0)}[case]
number = lambda i, j: 1 + i * (ny - low + 1) + (j - low)
nodes = {number(i, j): (i * h, j * h) for i in range(nx + 1) for j in range(low, ny + 1)}
cells = [(number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)) for i in range(nx) for j in range(low, ny)]
if a.tri: cells = [t for q in cells for t in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))]
clamp = [number(i, j) for j in range(low, ny + 1) for i in ([0, nx] if BAR else [0])]
mdpa("grid.mdpa", 0, nodes, cells, "Element2D3N" if a.tri else "Element2D4N", 1, {"Clamp": (clamp, []), "All": (list(nodes), [])})
keys = np.round(np.concatenate([X + side / 2 * np.array(c) for c in ((-1, -1), (1, -1), (1, 1), (-1, 1))]) / side * 2).astype(int)
unique, inverse = np.unique(keys, axis=0, return_inverse=True)
body, first = {len(nodes) + 1 + i: u * side / 2 for i, u in enumerate(unique)}, len(cells) + 1
mdpa("body.mdpa", 1, body, [tuple(q) for q in inverse.reshape(4, len(X)).T + len(nodes) + 1], "MPMUpdatedLagrangian2D4N", first, {"Body": (list(body), range(first, first + len(X)))})
dt = value["duration"] / a.steps if BAR else 1.0
law = ("HenckyMCPlastic" if a.hencky else "HyperElasticNeoHookean") + ("PlaneStrainUP2DLaw" if a.up else "PlaneStrain2DLaw")
(a.out / "materials.json").write_text(json.dumps({"cell_size_m": told["cell_size_m"], "properties": [{"model_part_name": "Initial_MPM_Material.Body", "properties_id": 1, "Material": {
    "constitutive_law": {"name": law}, "Tables": {}, "Variables": {"THICKNESS": 1.0, "MATERIAL_POINTS_PER_ELEMENT": 1, "DENSITY": density, "YOUNG_MODULUS": E,
    "POISSON_RATIO": nu, "COHESION": 1e12, "INTERNAL_FRICTION_ANGLE": 0.0, "INTERNAL_DILATANCY_ANGLE": 0.0}}}]}))
fix = lambda part, held: {"python_module": "assign_vector_variable_process", "kratos_module": "KratosMultiphysics", "process_name": "AssignVectorVariableProcess", "Parameters": {
    "model_part_name": f"Background_Grid.{part}", "variable_name": "DISPLACEMENT", "constrained": held, "value": [0.0 if c else None for c in held], "interval": [0.0, "End"]}}
solver = {"solver_type": "dynamic" if BAR else "static", "model_part_name": "MPM_Material", "domain_size": 2, "echo_level": 0, "analysis_type": "non_linear",
    "time_stepping": {"time_step": dt}, "model_import_settings": {"input_type": "mdpa", "input_filename": str(a.out / "body")},
    "grid_model_import_settings": {"input_type": "mdpa", "input_filename": str(a.out / "grid")},
    "material_import_settings": {"materials_filename": str(a.out / "materials.json")}, "convergence_criterion": "residual_criterion", "residual_relative_tolerance": 1e-8,
    "residual_absolute_tolerance": 1e-10, "max_iteration": 30, "pressure_dofs": a.up, "linear_solver_settings": {"solver_type": "LinearSolversApplication.sparse_lu"}}
if BAR: solver |= {"time_integration_method": "implicit", "scheme_type": "newmark", "newmark_beta": 0.25}
parameters = {"problem_data": {"problem_name": "run", "parallel_type": "OpenMP", "echo_level": 0, "start_time": 0.0, "end_time": (a.steps - 0.5) * dt},
    "solver_settings": solver, "output_processes": {}, "processes": {"constraints_process_list": [fix("Clamp", [True, not BAR, True])] + ([fix("All", [False, True, True])] if BAR else [])}}
series, every, wave = [], max(1, a.steps // 1040), np.sin(np.pi * X[:, 0]) if BAR else None
class Run(MpmAnalysis):
    def each(self, variable, vectors):
        part = self._GetSolver().GetComputingModelPart()
        for e, v in zip(part.Elements, vectors): e.SetValuesOnIntegrationPoints(variable, [K.Array3([*map(float, v), 0.0])], part.ProcessInfo)
    def of(self, variable):
        part = self._GetSolver().GetComputingModelPart()
        return np.array([list(v) if hasattr(v, "__len__") else v for e in part.Elements for v in e.CalculateOnIntegrationPoints(variable, part.ProcessInfo)])
    def InitializeSolutionStep(self):
        share = min(1.0, self._GetSolver().GetComputingModelPart().ProcessInfo[K.TIME] / dt / a.steps)
        if not BAR: self.each(M.MP_VOLUME_ACCELERATION, np.column_stack([0 * load, share * load]))
        super().InitializeSolutionStep()
    def FinalizeSolutionStep(self):
        super().FinalizeSolutionStep()
        now = round(self._GetSolver().GetComputingModelPart().ProcessInfo[K.TIME] / dt)
        if BAR and now % every == 0:
            j, kinetic = self.of(M.MP_VOLUME).ravel() / side**2, density * side**2 / h / 2 * (self.of(M.MP_VELOCITY) ** 2).sum()
            stored = side**2 / h * (mu / 2 * (j**2 - 1 - 2 * np.log(j)) + lam / 2 * np.log(j) ** 2).sum()
            series.append((now * dt, kinetic, kinetic + stored, (self.of(M.MP_DISPLACEMENT)[:, 0] * wave).sum() / (value["amplitude"] * wave**2).sum()))
begun, run = time.process_time(), Run(K.Model(), K.Parameters(json.dumps(parameters))); run.Initialize()
assert np.allclose(run.of(M.MP_COORD)[:, :2], X)  # particles of Kratos have our order
if BAR: run.each(M.MP_VELOCITY, np.column_stack([value["amplitude"] * np.pi * np.sqrt((lam + 2 * mu) / density) * wave, 0 * wave]))
run.RunSolutionLoop(); cost = time.process_time() - begun
words = f"{'Newmark' if BAR else 'quasi-static'}, {'linear triangles' if a.tri else 'bilinear'}, {'mixed u-p, ppp' if a.up else 'standard'}{', Hencky' if a.hencky else ''}"
manifest = {"schema": 1, "code": {"name": "Kratos MPM", "version": "10.4.4"}, "scheme": words, "case": case, "level": told["level"], "cost": {"cpu_s": cost, "threads": 1, "steps": a.steps}}
if BAR:
    manifest |= {"series": "series.csv", "time_step_s": dt}
    np.savetxt(a.out / "series.csv", series, "%.6g", ",", header="time (s),kinetic_energy (J),energy (J),mode (-)", comments="")
else:
    u, sigma, J = run.of(M.MP_DISPLACEMENT), run.of(M.MP_CAUCHY_STRESS_VECTOR), run.of(M.MP_VOLUME).ravel() / side**2
    zz = nu * (sigma[:, 0] + sigma[:, 1]) if a.up else lam * np.log(J) / J
    last, name = ((sigma[:, 0] + sigma[:, 1] + zz) / 3, "mean_stress (Pa)") if case == "cook" else (sigma[:, 0], "stress_xx (Pa)")
    manifest |= {"particles": "particles.csv"}
    np.savetxt(a.out / "particles.csv", np.column_stack([X, u[:, :2], last]), "%.9g", ",", header="reference_x (m),reference_y (m),ux (m),uy (m)," + name, comments="")
manifest["cell_size_m"] = told["cell_size_m"]
(a.out / "score.json").write_text(json.dumps(manifest, indent=1))
