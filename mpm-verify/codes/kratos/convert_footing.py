"""The strip footing in Kratos MPM 10.4.4, from what `mpm-verify export` writes to what `mpm-verify score` reads.

    mpm-verify export footing --level b10 --out footing-b10
    python convert_footing.py footing-b10 result [--tri] [--up] [--steps 20]

Plasticity is Kratos' Mohr-Coulomb law of Hencky strains without friction: Tresca of cohesion s_u (0.01 degrees, as zero gives a singular matrix), which in plane strain has the limit
load of J2 with ||s|| = sqrt(2) s_u. Base fixed, rollers at both sides, the nodes 0 <= x <= B/2 of y = 0 move down with the footing.
Forces are the reactions of these nodes and of the base. Packages as for convert.py.
"""
import argparse, json, os, time
from pathlib import Path
import numpy as np

a = argparse.ArgumentParser()
a.add_argument("source", type=Path); a.add_argument("out", type=Path); a.add_argument("--steps", type=int, default=20)
for flag in ("--up", "--tri"): a.add_argument(flag, action="store_true")
a = a.parse_args()
os.environ["OMP_NUM_THREADS"] = "1"
import KratosMultiphysics as K
import KratosMultiphysics.LinearSolversApplication
import KratosMultiphysics.MPMApplication as M
from KratosMultiphysics.MPMApplication.mpm_analysis import MpmAnalysis
K.Logger.GetDefaultOutput().SetSeverity(K.Logger.Severity.WARNING)

told = json.loads((a.source / "problem.json").read_text())
h, value = told["cell_size_m"], {p["name"]: p["value"] for p in told["parameters"]}
head = (a.source / "start.csv").read_text().splitlines()[0].split(",")
s = dict(zip(head, np.loadtxt(a.source / "start.csv", delimiter=",", skiprows=1).T))
X, side = np.column_stack([s["x (m)"], s["y (m)"]]), np.sqrt(s["reference_volume (m²)"][0])
E, nu, su = value["young_modulus"], value["poisson_ratio"], value["undrained_strength"]
nx, low = round(value["domain_width"] / h), -round(value["domain_depth"] / h)
a.out.mkdir(parents=True, exist_ok=True)

def mdpa(name, properties, nodes, cells, element, first, parts):
    text = [f"Begin Properties {properties}\nEnd Properties\nBegin Nodes", *("%d %.12g %.12g 0" % (i, *p) for i, p in nodes.items()), "End Nodes",
            f"Begin Elements {element}", *(f"{i + first} {properties} " + " ".join(map(str, c)) for i, c in enumerate(cells)), "End Elements"]
    for part, (points, elements) in parts.items():
        text += [f"Begin SubModelPart {part}\nBegin SubModelPartNodes", *map(str, points), "End SubModelPartNodes\nBegin SubModelPartElements",
                 *map(str, elements), "End SubModelPartElements\nEnd SubModelPart"]
    (a.out / name).write_text("\n".join(text) + "\n")

number = lambda i, j: 1 + i * (1 - low) + (j - low)
nodes = {number(i, j): (i * h, j * h) for i in range(nx + 1) for j in range(low, 1)}
cells = [(number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)) for i in range(nx) for j in range(low, 0)]
if a.tri:
    cells = [t for q in cells for t in ((q[0], q[1], q[2]), (q[0], q[2], q[3]))]
footing = [number(i, 0) for i in range(round(0.5 / h) + 1)]
base = [number(i, low) for i in range(nx + 1)]
sides = [number(i, j) for i in (0, nx) for j in range(low, 1)]
mdpa("grid.mdpa", 0, nodes, cells, "Element2D3N" if a.tri else "Element2D4N", 1, {"Footing": (footing, []), "Base": (base, []), "Sides": (sides, [])})
keys = np.round(np.concatenate([X + side / 2 * np.array(c) for c in ((-1, -1), (1, -1), (1, 1), (-1, 1))]) / side * 2).astype(int)
unique, inverse = np.unique(keys, axis=0, return_inverse=True)
body, first = {len(nodes) + 1 + i: u * side / 2 for i, u in enumerate(unique)}, len(cells) + 1
mdpa("body.mdpa", 1, body, [tuple(q) for q in inverse.reshape(4, len(X)).T + len(nodes) + 1], "MPMUpdatedLagrangian2D4N", first, {"Body": (list(body), range(first, first + len(X)))})
(a.out / "materials.json").write_text(json.dumps({"cell_size_m": told["cell_size_m"], "properties": [{"model_part_name": "Initial_MPM_Material.Body", "properties_id": 1, "Material": {
    "constitutive_law": {"name": f"HenckyMCPlasticPlaneStrain{'UP' if a.up else ''}2DLaw"}, "Tables": {}, "Variables": {"THICKNESS": 1.0, "MATERIAL_POINTS_PER_ELEMENT": 1,
    "DENSITY": value["density"], "YOUNG_MODULUS": E, "POISSON_RATIO": nu, "COHESION": su, "INTERNAL_FRICTION_ANGLE": 0.01, "INTERNAL_DILATANCY_ANGLE": 0.01}}}]}))
down = -value["penetration"] / a.steps  # a step's displacement: the grid is new in every step
fix = lambda part, held, to: {"python_module": "assign_vector_variable_process", "kratos_module": "KratosMultiphysics", "process_name": "AssignVectorVariableProcess", "Parameters": {
    "model_part_name": f"Background_Grid.{part}", "variable_name": "DISPLACEMENT", "constrained": held, "value": to, "interval": [0.0, "End"]}}
parameters = {"problem_data": {"problem_name": "run", "parallel_type": "OpenMP", "echo_level": 0, "start_time": 0.0, "end_time": a.steps - 0.5}, "output_processes": {},
    "solver_settings": {"solver_type": "static", "model_part_name": "MPM_Material", "domain_size": 2, "echo_level": 0, "analysis_type": "non_linear", "time_stepping": {"time_step": 1.0},
        "model_import_settings": {"input_type": "mdpa", "input_filename": str(a.out / "body")}, "grid_model_import_settings": {"input_type": "mdpa", "input_filename": str(a.out / "grid")},
        "material_import_settings": {"materials_filename": str(a.out / "materials.json")}, "convergence_criterion": "residual_criterion", "residual_relative_tolerance": 1e-5,
        "residual_absolute_tolerance": 1e-7, "max_iteration": 30, "pressure_dofs": a.up, "compute_reactions": True, "linear_solver_settings": {"solver_type": "LinearSolversApplication.sparse_lu"}},
    "processes": {"constraints_process_list": [fix("Sides", [True, False, True], [0.0, None, 0.0]), fix("Base", [True, True, True], [0.0, 0.0, 0.0]), fix("Footing", [True, True, True], [0.0, down, 0.0])]}}
series, plateau = [], []

class Run(MpmAnalysis):
    def of(self, variable):
        part = self._GetSolver().GetComputingModelPart()
        return np.array([list(v) if hasattr(v, "__len__") else v for e in part.Elements for v in e.CalculateOnIntegrationPoints(variable, part.ProcessInfo)])
    def FinalizeSolutionStep(self):
        grid, step = self._GetSolver().GetGridModelPart(), len(series) + 1
        force = [sum(grid.GetNode(n).GetSolutionStepValue(K.REACTION_Y) for n in part) for part in (footing, base)]
        super().FinalizeSolutionStep()
        series.append((step * value["penetration"] / a.steps, -force[0], force[1]))
        print(step, *("%.5g" % f for f in force), "N_c", -force[0] / su / (0.5 + h / 2), flush=True)
        if step == round(0.75 * a.steps): plateau.append(self.of(M.MP_DISPLACEMENT))

begun = time.process_time()
run = Run(K.Model(), K.Parameters(json.dumps(parameters)))
run.Initialize()
assert np.allclose(run.of(M.MP_COORD)[:, :2], X)  # particles of Kratos have our order
run.RunSolutionLoop()
cost = time.process_time() - begun
u, sigma = run.of(M.MP_DISPLACEMENT), run.of(M.MP_CAUCHY_STRESS_VECTOR)
late = (u - plateau[0])[:, :2]
mean = (sigma[:, 0] + sigma[:, 1]) / 2  # where it flows, stress_zz is their mean
np.savetxt(a.out / "particles.csv", np.column_stack([X, late, mean]), "%.9g", ",", header="reference_x (m),reference_y (m),plateau_ux (m),plateau_uy (m),mean_stress (Pa)", comments="")
np.savetxt(a.out / "series.csv", series, "%.6g", ",", header="penetration (-),footing_force (N/m),base_force (N/m)", comments="")
(a.out / "score.json").write_text(json.dumps({"cell_size_m": told["cell_size_m"], "schema": 1, "code": {"name": "Kratos MPM", "version": "10.4.4"}, "case": "footing", "level": told["level"], "basis": "linear",
    "scheme": f"quasi-static, {'linear triangles' if a.tri else 'bilinear'}, {'mixed u-p, ppp' if a.up else 'standard'}, Hencky, Tresca",
    "parameters": json.loads((a.source / "score.json").read_text())["parameters"], "particles": "particles.csv", "series": "series.csv", "cost": {"cpu_s": cost, "threads": 1, "steps": a.steps}}, indent=1))
