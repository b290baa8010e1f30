"""Finite-element reference for Cook's membrane at finite strain.

The trapezoid (0,0) (48,44) (48,60) (0,44) is clamped on x = 0 and carries a
dead upward load, uniform over the material line x = load-x (the right side
unless told otherwise).  Plane strain, static, compressible neo-Hookean

    W = mu/2 (I1 - 3 - 2 ln J) + lambda/2 (ln J)^2 .

Two formulations are solved by Newton's method on quadrilaterals graded
geometrically towards all sides (the clamped corner (0,44) is singular):

  mixed         u in Q_k, p = lambda ln J in Q_{k-1}, both continuous
                (Taylor-Hood, which does not lock as nu -> 1/2)
  displacement  u in Q_k alone

The stored values come from the mixed formulation.  Their uncertainty is twice
the largest difference from three other discretisations: mixed of one degree
more, mixed on a coarser mesh (five times coarser at the sides), and
displacement of one degree more on that coarser mesh.  The last one counts for
displacements only, as its lambda ln J oscillates when nu is near 1/2.

cook.json holds the displacement of the tip (48,60), of the middle (48,52) of
the right side and the mean of u_y over that side, the mean Cauchy stress
(trace of the 3D tensor / 3, tension positive) at material points, and how
these displacements change when the whole load acts on x = 48 - h/4 instead.
cook_mean_stress.csv holds the mean stress on a lattice of material points.
cook_loads.json holds these displacements under 10 to 50 N.

    python cook_fem.py --poisson-ratio 0.499      one solution, JSON on stdout
    python cook_fem.py --regenerate               rewrite the two data files
    python cook_fem.py --large-loads              rewrite cook_loads.json
    python cook_fem.py --check                    recompute and compare them
"""

import argparse
import json
import math
import sys
from pathlib import Path

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu
from skfem import Basis, ElementQuad1, ElementQuad2, ElementQuadP, MeshQuad

HERE = Path(__file__).resolve().parent
RESULTS = HERE / "cook.json"
LATTICE = HERE / "cook_mean_stress.csv"
LARGE = HERE / "cook_loads.json"

WIDTH = 48.0
YOUNG_MODULUS, LOAD = 70.0, 1.0
POISSON_RATIOS = (0.3, 0.49, 0.499, 0.4999)
LATTICE_POISSON_RATIO = 0.499
LATTICE_SPACING = 0.5
INSET_SPACINGS = (2.0, 1.0, 0.5, 0.25)  # the load line lies at 48 - h/4
PROBES = ((24, 36), (16, 30), (36, 48), (24, 24), (8, 20), (8, 40), (44, 52))
LARGE_LOADS = (10.0, 20.0, 30.0, 40.0, 50.0)  # N
LARGE_LOADS_SPACING = 1.0  # the load acts on the side and at 48 - h/4
TIP, MID_EDGE = (48.0, 60.0), (48.0, 52.0)

ELEMENTS, DEGREE = 10, 5  # of the stored solutions
LAYERS = 13  # of the geometric grading
RATIO = 0.5


def bottom(x):
    return 44.0 * x / WIDTH


def top(x):
    return 44.0 + 16.0 * x / WIDTH


def graded(start, end, intervals, start_layers, end_layers):
    """Uniform breakpoints, the first and last interval graded to the ends."""
    uniform = np.linspace(start, end, intervals + 1)
    step = (end - start) / intervals
    first = start + step * RATIO ** np.arange(start_layers, 0, -1)
    last = end - step * RATIO ** np.arange(1, end_layers + 1)
    return np.unique(np.concatenate([uniform, first, last]))


class Membrane:
    """Mesh, bases and load vector; independent of the material."""

    def __init__(
        self, load_x=WIDTH, elements=ELEMENTS, degree=DEGREE, mixed=True, layers=LAYERS
    ):
        self.mixed = mixed
        # The bottom has no strong singularity, the strip beside the load line
        # is narrow already: they need fewer layers.
        self.xs = graded(0.0, load_x, elements, layers, layers)
        if load_x < WIDTH:
            self.xs = np.union1d(self.xs, graded(load_x, WIDTH, 2, layers // 2, layers // 2))
        self.ts = graded(0.0, 1.0, elements, layers - 5, layers)
        tensor = MeshQuad.init_tensor(self.xs, self.ts)
        x, t = tensor.p
        # Every facet has the same direction in its two elements, as the
        # hierarchical functions of ElementQuadP need.
        self.mesh = mesh = MeshQuad(np.array([x, (1 - t) * bottom(x) + t * top(x)]), tensor.t)

        order = 2 * degree + 2
        self.u = Basis(mesh, lagrange(degree), intorder=order)
        self.p = Basis(mesh, lagrange(degree - 1), intorder=order)
        n = self.u.N
        self.size = int(2 * n + (self.p.N if mixed else 0))

        # [element, point, direction, function] and [element, point, function]
        self.grad = np.stack([f[0].grad for f in self.u.basis]).transpose(2, 3, 1, 0).copy()
        self.shape = np.stack([f[0].value * np.ones_like(self.u.dx) for f in self.p.basis])
        self.shape = self.shape.transpose(1, 2, 0).copy()

        dofs = [self.u.element_dofs, n + self.u.element_dofs]
        if mixed:
            dofs.append(2 * n + self.p.element_dofs)
        self.dofs = np.concatenate(dofs).T.astype(np.int64)  # [element, unknown]

        clamped = self.u.get_dofs(lambda x: np.isclose(x[0], 0.0, atol=1e-9)).all()
        self.clamped = np.concatenate([clamped, n + clamped])
        self.free = np.setdiff1d(np.arange(self.size), self.clamped)

        self.load = np.zeros(self.size)
        self.load[n : 2 * n] = self.line_mean(load_x, degree)
        self.right = self.line_mean(WIDTH, degree)

    def line_mean(self, at, degree):
        """Weights w such that w . v is the mean of v over the line x = at."""
        gauss, gauss_weights = np.polynomial.legendre.leggauss(degree + 1)
        lengths = np.diff(self.ts)[:, None]
        t = (self.ts[:-1, None] + lengths * (gauss + 1) / 2).ravel()
        weights = np.zeros(self.u.N)
        for dofs, value, _ in self.functions(self.u, *self.locate(np.full_like(t, at), t)):
            np.add.at(weights, dofs, value * (lengths * gauss_weights / 2).ravel())
        return weights

    def locate(self, x, t):
        """Elements and reference coordinates of points given by x and the
        fraction t of the height at x."""
        i = np.clip(np.searchsorted(self.xs, x, side="right") - 1, 0, len(self.xs) - 2)
        j = np.clip(np.searchsorted(self.ts, t, side="right") - 1, 0, len(self.ts) - 2)
        local_t = (t - self.ts[j]) / np.diff(self.ts)[j]
        local_x = (x - self.xs[i]) / np.diff(self.xs)[i]
        return j + i * (len(self.ts) - 1), np.stack([local_t, local_x])[:, :, None]

    @staticmethod
    def functions(basis, cells, X):
        """Unknowns, values and gradients of the basis functions at points."""
        for a, dofs in enumerate(basis.element_dofs):
            function = basis.elem.gbasis(basis.mapping, X, a, tind=cells)[0]
            value = np.broadcast_to(function.value, X.shape[1:])[:, 0]
            yield dofs[cells], value, function.grad[..., 0]


def lagrange(degree):
    return {1: ElementQuad1, 2: ElementQuad2}.get(degree, lambda: ElementQuadP(degree))()


def inverse_transpose(F):
    J = F[..., 0, 0] * F[..., 1, 1] - F[..., 0, 1] * F[..., 1, 0]
    cofactor = np.empty_like(F)
    cofactor[..., 0, 0], cofactor[..., 1, 1] = F[..., 1, 1], F[..., 0, 0]
    cofactor[..., 0, 1], cofactor[..., 1, 0] = -F[..., 1, 0], -F[..., 0, 1]
    return J, cofactor / J[..., None, None]


class Solution:
    """Static equilibrium by Newton's method from the undeformed state, by a load that is
    raised once or further."""

    def __init__(self, membrane, poisson_ratio, young_modulus=YOUNG_MODULUS, load=LOAD):
        self.membrane = membrane
        self.mu = young_modulus / (2 * (1 + poisson_ratio))
        self.lam = 2 * self.mu * poisson_ratio / (1 - 2 * poisson_ratio)
        self.values = np.zeros(membrane.size)
        self.linearised_pressure = 0.0
        self.raise_to(load)

    def raise_to(self, load):
        """The equilibrium under another load, from the present one."""
        m = self.membrane
        self.residuals = []  # relative to the load
        scale = np.linalg.norm(load * m.load)
        for _ in range(25):
            force, stiffness = self.assemble()
            residual = load * m.load - force
            self.residuals.append(float(np.linalg.norm(residual[m.free]) / scale))
            # The first residual is 1; rounding stalls the last ones.
            if self.residuals[-1] < 1e-9 or (
                self.residuals[-1] < 1e-5 and self.residuals[-1] > 0.1 * self.residuals[-2]
            ):
                break
            factor = splu(
                stiffness[m.free][:, m.free].tocsc(),
                permc_spec="MMD_AT_PLUS_A",  # far less fill than with pivoting
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
            step = np.zeros(m.size)
            step[m.free] = factor.solve(residual[m.free])
            self.advance(step)
        else:
            raise RuntimeError(f"Newton's method did not converge: {self.residuals}")
        # The vertex functions sum to one, the others vanish in that sum.
        vertices = m.u.nodal_dofs[0]
        self.clamp_reaction = [
            float(force[np.intersect1d(m.clamped, part)].sum())
            for part in (vertices, m.u.N + vertices)
        ]

    def advance(self, step):
        """Add a Newton step.  The displacement formulation takes the pressure
        of its tangent from the linearised ln J, as a mixed one with a pressure
        at every quadrature point would; lambda ln J itself, with an error of
        lambda times the square of the step, ruins convergence as nu -> 1/2."""
        m = self.membrane
        if not m.mixed:
            J, H = inverse_transpose(self.deformation(self.values))
            change = self.deformation(step) - np.eye(2)
            self.linearised_pressure = self.lam * (np.log(J) + (H * change).sum(axis=(2, 3)))
        self.values += step

    def deformation(self, values):
        """Deformation gradient [element, point, 2, 2]."""
        m = self.membrane
        elements, _, _, functions = m.grad.shape
        u = values[m.dofs[:, : 2 * functions]].reshape(elements, 1, 2, functions)
        return np.eye(2) + u @ m.grad.transpose(0, 1, 3, 2)

    def assemble(self):
        m, mu, lam = self.membrane, self.mu, self.lam
        G, N, dx = m.grad, m.shape, m.u.dx
        elements, points, _, functions = G.shape
        F = self.deformation(self.values)
        J, H = inverse_transpose(F)  # H = F^-T
        if not (J > 0).all():
            raise RuntimeError("an element turned inside out: the load is too large")
        if m.mixed:
            pressure = (N @ self.values[m.dofs[:, 2 * functions :], None])[..., 0]
            tangent_pressure = pressure
        else:
            pressure, tangent_pressure = lam * np.log(J), self.linearised_pressure * np.ones_like(J)

        P = mu * F + (pressure - mu)[..., None, None] * H
        tangent = (mu - tangent_pressure)[..., None, None, None, None] * np.einsum(
            "eqil,eqkj->eqikjl", H, H
        )
        for i in range(2):
            tangent[:, :, i, i] += mu * np.eye(2)
        if not m.mixed:
            tangent += lam * np.einsum("eqij,eqkl->eqikjl", H, H)
        tangent *= dx[..., None, None, None, None]

        Gt = G.reshape(elements, points * 2, functions).transpose(0, 2, 1)
        wP = (P * dx[..., None, None]).transpose(0, 2, 1, 3).reshape(elements, 2, points * 2)
        force = [(wP @ Gt.transpose(0, 2, 1)).reshape(elements, 2 * functions)]
        blocks = [
            [Gt @ (tangent[:, :, i, k] @ G).reshape(elements, -1, functions) for k in range(2)]
            for i in range(2)
        ]
        if m.mixed:
            constraint = (np.log(J) - pressure / lam) * dx
            force.append((constraint[:, None] @ N)[:, 0])
            for i in range(2):
                HG = (H[:, :, None, i] @ G)[:, :, 0] * dx[..., None]
                blocks[i].append(HG.transpose(0, 2, 1) @ N)
            mass = N.transpose(0, 2, 1) @ (N * dx[..., None])
            blocks.append([row[2].transpose(0, 2, 1) for row in blocks] + [-mass / lam])

        matrix = np.block(blocks)
        rows = np.broadcast_to(m.dofs[:, :, None], matrix.shape)
        columns = np.broadcast_to(m.dofs[:, None, :], matrix.shape)
        stiffness = sparse.coo_matrix(
            (matrix.ravel(), (rows.ravel(), columns.ravel())), shape=(m.size, m.size)
        ).tocsr()
        vector = np.bincount(m.dofs.ravel(), np.concatenate(force, axis=1).ravel(), m.size)
        return vector, stiffness

    def at(self, points):
        """Displacement [point, 2] and 3D mean Cauchy stress at material points."""
        m, n = self.membrane, self.membrane.u.N
        x, y = np.asarray(points, dtype=float).T
        where = m.locate(x, (y - bottom(x)) / (top(x) - bottom(x)))
        u = np.zeros((len(x), 2))
        F = np.tile(np.eye(2), (len(x), 1, 1))
        for dofs, value, grad in m.functions(m.u, *where):
            for i in range(2):
                u[:, i] += self.values[i * n + dofs] * value
                F[:, i] += (self.values[i * n + dofs] * grad).T
        J, _ = inverse_transpose(F)
        if m.mixed:
            pressure = sum(self.values[2 * n + d] * v for d, v, _ in m.functions(m.p, *where))
        else:
            pressure = self.lam * np.log(J)
        mean_stress = (self.mu * ((F**2).sum(axis=(1, 2)) - 2) + 3 * pressure) / (3 * J)
        return u, mean_stress

    def displacements(self):
        """Tip (ux, uy), mid-edge (ux, uy), mean uy of the right side."""
        u, _ = self.at([TIP, MID_EDGE])
        n = self.membrane.u.N
        return np.array([*u[0], *u[1], self.membrane.right @ self.values[n : 2 * n]])


def describe(poisson_ratio, displacements, mean_stress):
    ux, uy, mid_ux, mid_uy, mean_uy = (round(float(v), 9) for v in displacements)
    return {
        "poisson_ratio": poisson_ratio,
        "tip": {"ux": ux, "uy": uy},
        "mid_edge": {"ux": mid_ux, "uy": mid_uy},
        "edge_mean_uy": mean_uy,
        "mean_stress": [
            {"x": x, "y": y, "value": round(float(value), 8)}
            for (x, y), value in zip(PROBES, mean_stress)
        ],
    }


def lattice_points():
    centres = np.arange(LATTICE_SPACING / 2, 60.0, LATTICE_SPACING)
    x, y = (a.ravel() for a in np.meshgrid(centres, centres, indexing="ij"))
    inside = (x <= WIDTH + 1e-9) & (y >= bottom(x) - 1e-9) & (y <= top(x) + 1e-9)
    return np.stack([x, y], axis=1)[inside]


class Family:
    """All stored quantities by one discretisation."""

    def __init__(self, **discretisation):
        self.discretisation = discretisation
        membrane = Membrane(**discretisation)
        self.displacements, self.mean_stress, self.inset = {}, {}, {}
        for nu in POISSON_RATIOS:
            solution = self.solve(membrane, nu, f"nu={nu}")
            self.displacements[nu] = solution.displacements()
            self.mean_stress[nu] = solution.at(PROBES)[1]
            if nu == LATTICE_POISSON_RATIO:
                self.lattice = solution.at(lattice_points())[1]
        for h in INSET_SPACINGS:
            inset = Membrane(load_x=WIDTH - h / 4, **discretisation)
            for nu in POISSON_RATIOS:
                solution = self.solve(inset, nu, f"nu={nu} inset h={h}")
                change = solution.displacements() - self.displacements[nu]
                self.inset[nu, h] = change[[1, 3, 4]]

    def solve(self, membrane, nu, case):
        solution = Solution(membrane, nu)
        residuals = " ".join(f"{r:.0e}" for r in solution.residuals)
        print(self.discretisation, case, "residuals", residuals, file=sys.stderr, flush=True)
        return solution

    def results(self):
        return {
            "schema": 1,
            "method": "Static finite-strain finite elements (scikit-fem): mixed displacement-"
            f"pressure Q{DEGREE}/Q{DEGREE - 1} quadrilaterals graded to the sides, Newton's "
            "method; uncertainty from degree, mesh and a pure displacement formulation.",
            "load_over_young_modulus": LOAD / YOUNG_MODULUS,
            "geometry": "Trapezoid (0,0) (48,44) (48,60) (0,44) m in plane strain, x = 0 clamped, "
            "1 N upward dead load uniform over x = 48 (over x = 48 - h/4 in load_inset), "
            "Young's modulus 70 Pa.",
            "solutions": [
                describe(nu, self.displacements[nu], self.mean_stress[nu])
                for nu in POISSON_RATIOS
            ],
            "load_inset": [
                {
                    "poisson_ratio": nu,
                    "h": h,
                    "tip_uy_change": round(float(tip), 9),
                    "mid_edge_uy_change": round(float(mid), 9),
                    "edge_mean_uy_change": round(float(mean), 9),
                }
                for (nu, h), (tip, mid, mean) in self.inset.items()
            ],
            "mean_stress_lattice": {
                "file": LATTICE.name,
                "poisson_ratio": LATTICE_POISSON_RATIO,
                "spacing": LATTICE_SPACING,
            },
        }


def under_large_loads(**discretisation):
    """Tip, mid-edge and mean u_y over the loads, for each line that the load acts on."""
    found = {}
    for inset in (0.0, LARGE_LOADS_SPACING / 4):
        membrane = Membrane(load_x=WIDTH - inset, **discretisation)
        step = LARGE_LOADS[0] / 4
        solution = Solution(membrane, LATTICE_POISSON_RATIO, load=step)
        for k in range(2, 1 + round(LARGE_LOADS[-1] / step)):
            solution.raise_to(k * step)
            if k * step in LARGE_LOADS:
                found[inset, k * step] = solution.displacements()[[1, 3, 4]]
                print(inset, k * step, found[inset, k * step], file=sys.stderr, flush=True)
    return found


def large_loads():
    fine = under_large_loads(elements=ELEMENTS - 4, layers=LAYERS - 6, degree=DEGREE - 1)
    coarse = under_large_loads(elements=ELEMENTS - 4, layers=LAYERS - 7, degree=DEGREE - 2)
    results = {
        "schema": 1,
        "method": "As cook.json, the load raised in steps; uncertainty from a coarser mesh of one degree less.",
        "poisson_ratio": LATTICE_POISSON_RATIO,
        "h": LARGE_LOADS_SPACING,
        "solutions": [
            {
                "load_over_young_modulus": load / YOUNG_MODULUS,
                "load_inset": inset,
                **dict(zip(("tip_uy", "mid_edge_uy", "edge_mean_uy"), (round(float(v), 6) for v in values))),
                "uncertainty": uncertainty([difference(values, coarse[inset, load])]),
            }
            for (inset, load), values in fine.items()
        ],
    }
    LARGE.write_text(json.dumps(results, indent=1) + "\n")


def difference(a, b):
    return float(np.abs(np.asarray(a) - np.asarray(b)).max())


def uncertainty(differences):
    """Twice the largest difference, rounded up to one digit."""
    bound = 2 * max(differences)
    unit = 10.0 ** math.floor(math.log10(bound))
    return float(f"{math.ceil(bound / unit) * unit:.0e}")


def regenerate():
    stored = Family()
    coarser = {"elements": ELEMENTS - 2, "layers": LAYERS - 2}
    mixed = [Family(degree=DEGREE + 1), Family(**coarser)]
    others = [*mixed, Family(degree=DEGREE + 1, mixed=False, **coarser)]
    results = stored.results()
    for solution in results["solutions"]:
        nu = solution["poisson_ratio"]
        displacement = [difference(stored.displacements[nu], o.displacements[nu]) for o in others]
        displacement += [
            difference(stored.inset[nu, h], o.inset[nu, h]) for o in others for h in INSET_SPACINGS
        ]
        stress = [difference(stored.mean_stress[nu], o.mean_stress[nu]) for o in mixed]
        solution["uncertainty_displacement"] = uncertainty(displacement)
        solution["uncertainty_mean_stress"] = uncertainty(stress)
    lattice = [difference(stored.lattice, o.lattice) for o in mixed]
    results["mean_stress_lattice"]["uncertainty"] = uncertainty(lattice)
    RESULTS.write_text(json.dumps(results, indent=1) + "\n")
    rows = (f"{x:g},{y:g},{s:.7e}\n" for (x, y), s in zip(lattice_points(), stored.lattice))
    LATTICE.write_text("x,y,mean_stress\n" + "".join(rows))


def check():
    """Recompute the stored values; True when all lie within their uncertainty."""
    stored, family = json.loads(RESULTS.read_text()), Family()
    computed = family.results()
    ok = True

    def compare(name, old, new, bound):
        nonlocal ok
        old, new = np.asarray(old, dtype=float), np.asarray(new, dtype=float)
        same = old.shape == new.shape
        worst = difference(old, new) if same else math.inf
        ok &= worst <= bound
        print(f"{name}: largest difference {worst:.1e}, uncertainty {bound:.0e}")

    def displacements(s):
        return [*s["tip"].values(), *s["mid_edge"].values(), s["edge_mean_uy"]]

    compare(
        "Poisson ratios", [s["poisson_ratio"] for s in stored["solutions"]], POISSON_RATIOS, 0.0
    )
    for old, new in zip(stored["solutions"], computed["solutions"]):
        name, bound = f"nu = {old['poisson_ratio']}", old["uncertainty_displacement"]
        compare(f"{name}, displacement", displacements(old), displacements(new), bound)
        old_inset, new_inset = (
            [list(e.values()) for e in r["load_inset"] if e["poisson_ratio"] == old["poisson_ratio"]]
            for r in (stored, computed)
        )
        compare(f"{name}, load inset, displacement", old_inset, new_inset, bound)
        old_stress, new_stress = (
            [list(probe.values()) for probe in s["mean_stress"]] for s in (old, new)
        )
        compare(f"{name}, mean stress", old_stress, new_stress, old["uncertainty_mean_stress"])
    rows = np.loadtxt(LATTICE, delimiter=",", skiprows=1)
    compare(
        "mean stress on the lattice",
        rows,
        np.column_stack([lattice_points(), family.lattice]),
        stored["mean_stress_lattice"]["uncertainty"],
    )
    return ok


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--poisson-ratio", type=float, default=LATTICE_POISSON_RATIO)
    parser.add_argument("--young-modulus", type=float, default=YOUNG_MODULUS, help="Pa")
    parser.add_argument("--load", type=float, default=LOAD, help="total upward load, N")
    parser.add_argument("--load-x", type=float, default=WIDTH, help="where the load acts, m")
    parser.add_argument(
        "--elements", type=int, default=ELEMENTS, help="per direction, before grading"
    )
    parser.add_argument("--degree", type=int, default=DEGREE, help="of the displacement, 2 or more")
    parser.add_argument("--displacement-only", action="store_true", help="no pressure unknowns")
    parser.add_argument("--out", type=Path, help="write the JSON here instead of to stdout")
    action = parser.add_mutually_exclusive_group()
    action.add_argument("--regenerate", action="store_true", help="rewrite the two data files")
    action.add_argument("--large-loads", action="store_true", help="rewrite cook_loads.json")
    action.add_argument("--check", action="store_true", help="exit 1 unless they are reproduced")
    arguments = parser.parse_args()

    if arguments.regenerate:
        return regenerate()
    if arguments.large_loads:
        return large_loads()
    if arguments.check:
        return sys.exit(0 if check() else 1)

    membrane = Membrane(
        arguments.load_x, arguments.elements, arguments.degree, not arguments.displacement_only
    )
    solution = Solution(
        membrane, arguments.poisson_ratio, arguments.young_modulus, arguments.load
    )
    result = {
        "young_modulus": arguments.young_modulus,
        "load": arguments.load,
        "load_x": arguments.load_x,
        "elements": arguments.elements,
        "degree": arguments.degree,
        "unknowns": membrane.size,
        "newton_residuals": solution.residuals,
        "clamp_reaction": solution.clamp_reaction,
        **describe(arguments.poisson_ratio, solution.displacements(), solution.at(PROBES)[1]),
    }
    text = json.dumps(result, indent=1) + "\n"
    if arguments.out:
        arguments.out.write_text(text)
    else:
        sys.stdout.write(text)


if __name__ == "__main__":
    main()
