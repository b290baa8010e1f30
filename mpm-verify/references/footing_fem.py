"""Finite-element reference for the strip footing on undrained clay.

A rigid strip of width B = 1 m is pushed into the surface of a soil without
weight, linear elastic and perfectly plastic with the yield condition of
von Mises,

    |s| = sqrt(2) s_u     (Frobenius norm of the 3D deviator),

in plane strain and at small strain.  The right half is computed: 0 <= x <= D,
-D <= y <= 0, rollers on both sides, the base fixed, u_y = -settlement on the
surface x <= B/2, where u_x = 0 (rough) or free (smooth).  Everything is given
without units: settlement / B and the mean pressure q / s_u.

The settlement grows in steps with backward Euler (radial return); Newton's
method with the consistent tangent and a line search solves every step.

  mean_dilatation  Q1 quadrilaterals, the dilatation replaced by its mean over
                   the element (B-bar)
  displacement     Q1 quadrilaterals as they are, which lock
  quadratic        Q2 quadrilaterals, the dilatation projected onto linear
                   functions in every element, graded to the footing's edge

Meshes are uniform, or uniform within two widths of the footing's centre and
growing outside.  With mean_dilatation at B/20 and B/40 that leaves the limit
load as it is and raises the slope and the curve by 3e-4 at most, relatively; a
locking displacement mesh it changes more.

footing.json holds the load-settlement curves of the meshes, their initial slope
d(q / s_u) / d(settlement / B), their limit load (q / s_u at settlement / B =
0.01), the mean stress (trace of the 3D tensor / 3 / s_u, tension positive) at
material points, and the initial slope for other Poisson's ratios and domains.

The extrapolated values are the a of a + b h + c h^2 through the three finest
meshes of mean_dilatation, carried on to steps of length zero by twice the
change that halving the steps makes on the graded mesh B/20 (step_correction).
Their uncertainty is twice the larger of two differences: from the same
extrapolation of the quadratic elements, and from that of mean_dilatation with
its finest mesh left out.  The slope is that of the quadratic elements on a
mesh graded to the footing's edge; its uncertainty is twice the difference from
a coarser mesh.

    python footing_fem.py --cells 20              one solution, JSON on stdout
    python footing_fem.py --regenerate            rewrite footing.json
    python footing_fem.py --check                 recompute the coarse meshes
                                                  and compare them
"""

import os

os.environ.setdefault("MKL_NUM_THREADS", "1")  # the solutions run in parallel

import argparse
import json
import math
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
import scipy.sparse as sparse
from pypardiso import PyPardisoSolver
from skfem import Basis, ElementQuad1, ElementQuad2, MeshQuad

HERE = Path(__file__).resolve().parent
RESULTS = HERE / "footing.json"

WIDTH = 1.0
YOUNG_MODULUS, POISSON_RATIO, STRENGTH = 1000.0, 0.49, 0.1
DOMAIN = 6.0
SETTLEMENTS = (1e-4, 3e-4, 5e-4, 7.5e-4, 1e-3, 1.25e-3, 1.5e-3, 2e-3, 2.5e-3, 3e-3, 4e-3, 1e-2)
PROBES = ((0.25, -0.25), (0.25, -0.5), (0.75, -0.25), (1.0, -0.25), (0.25, -1.0))
PROBE_SETTLEMENT = 3e-3

FORMULATIONS = ("mean_dilatation", "displacement", "quadratic")
SLOPE_POISSON_RATIOS = (0.3, 0.45, 0.49, 0.499)
SLOPE_DOMAINS = (4.0, 6.0, 8.0, 10.0)
SLOPE_CELLS = (10, 20)

UNIFORM_WITHIN, GROWTH = 2.0, 1.15  # of the graded meshes
LAYERS = 2  # of the quadratic elements' grading to the edge
TOLERANCE = 1e-9  # of the residual, relative to the load
REPRODUCED = 2e-5  # largest relative difference that --check accepts

SECOND_IMPLEMENTATION = {
    "source": "A second implementation of this project: mean dilatation on uniform meshes"
    " (displacement: plain Q1).",
    "meshes": [
        {"cells": 10, "limit": 5.5809, "slope": 10432, "settlement_at_99_percent": 0.00185},
        {"cells": 20, "limit": 5.3765, "slope": 10362, "settlement_at_99_percent": 0.00176},
        {"cells": 40, "limit": 5.2651, "slope": 10326, "settlement_at_99_percent": 0.00171},
        {"cells": 80, "limit": 5.2058, "slope": 10309, "settlement_at_99_percent": 0.00168},
    ],
    "curve": {
        "cells": 80,
        "settlements": [1e-4, 3e-4, 5e-4, 1e-3, 1.5e-3, 2e-3, 3e-3],
        "pressures": [1.029, 2.951, 3.902, 4.699, 5.069, 5.203, 5.206],
    },
    "displacement": {
        "cells": 20,
        "settlements": [1e-3, 2e-3, 1e-2],
        "pressures": [5.70, 6.96, 9.65],
    },
    "extrapolated": {
        "limit": 5.142,
        "limit_uncertainty": 0.005,
        "slope": 10290,
        "slope_uncertainty": 6,
        "settlement_at_99_percent": 0.00166,
    },
}


def uniform(size, cells):
    return np.linspace(0.0, size, round(size / WIDTH * cells) + 1)


def growing(size, cells, growth=GROWTH):
    """Uniform breakpoints near the footing, then intervals that grow."""
    near = uniform(UNIFORM_WITHIN, cells)
    far = np.cumsum(growth ** np.arange(1, 100)) * WIDTH / cells
    far = far[: np.searchsorted(far, size - UNIFORM_WITHIN) + 1]
    return np.concatenate([near, UNIFORM_WITHIN + far * (size - UNIFORM_WITHIN) / far[-1]])


def refined(points, at, layers):
    """Halve the intervals beside the breakpoint `at` again and again."""
    k = int(np.argmin(np.abs(points - at)))
    halves = 0.5 ** np.arange(1, layers + 1)
    beside = [points[k] + (points[i] - points[k]) * halves for i in (k - 1, k + 1) if i >= 0]
    return np.unique(np.concatenate([points, *beside]))


class Footing:
    """Mesh, constraints and elastic stiffness."""

    def __init__(
        self,
        xs,
        depths,
        formulation="mean_dilatation",
        rough=True,
        poisson_ratio=POISSON_RATIO,
    ):
        self.mu = YOUNG_MODULUS / (2 * (1 + poisson_ratio))
        self.bulk = YOUNG_MODULUS / (3 * (1 - 2 * poisson_ratio))
        self.xs, self.ys = xs, -depths[::-1]
        self.degree = 2 if formulation == "quadratic" else 1
        mesh = MeshQuad.init_tensor(self.xs, self.ys)
        element = ElementQuad2() if self.degree == 2 else ElementQuad1()
        basis = Basis(mesh, element, intorder=2 * self.degree + 1)
        n = basis.N
        self.size = 2 * n
        self.weights = basis.dx
        self.dofs = np.concatenate([basis.element_dofs, n + basis.element_dofs]).T.astype(np.int64)

        # Strain from displacement, [element, point, (component,) unknown]; the
        # deviator by its components on an orthonormal basis of deviators.
        grad = np.stack([f[0].grad * np.ones_like(basis.dx) for f in basis.basis])
        x, y = grad.transpose(1, 2, 3, 0)
        self.dilatation = np.concatenate([x, y], axis=2)
        self.deviator = np.stack(
            [
                np.concatenate([x, -y], axis=2) / math.sqrt(2),
                self.dilatation / math.sqrt(6),
                np.concatenate([y, x], axis=2) / math.sqrt(2),
            ],
            axis=2,
        )
        corners = mesh.p[:, mesh.t]
        low, high = corners.min(axis=1), corners.max(axis=1)
        self.centre, self.half_size = (low + high) / 2, (high - low) / 2
        phi = self.monomials(np.asarray(basis.global_coordinates()))
        moments = (phi * self.weights[..., None]).transpose(0, 2, 1)
        # Coefficients of the projected dilatation.
        self.projection = np.linalg.solve(moments @ phi, moments @ self.dilatation)
        if formulation != "displacement":
            self.dilatation = phi @ self.projection

        px, py = basis.doflocs
        base = np.isclose(py, self.ys[0])
        sides = np.isclose(px, 0.0) | np.isclose(px, self.xs[-1])
        under = np.isclose(py, 0.0) & (px < WIDTH / 2 + 1e-9)
        fixed = np.concatenate([base | sides | (under & rough), base | under])
        self.footing = n + np.flatnonzero(under)
        self.free = np.flatnonzero(~fixed)
        self.prepare()

    def monomials(self, points, elements=slice(None)):
        """1 (x, y in the element) at points [direction, element, point]."""
        if self.degree == 1:
            return np.ones((*points.shape[1:], 1))
        centre, half = self.centre[:, elements, None], self.half_size[:, elements, None]
        return np.stack([np.ones(points.shape[1:]), *((points - centre) / half)], axis=-1)

    def prepare(self):
        """Sparsity of the stiffness of the free unknowns (upper triangle), the
        elastic stiffness, the solver."""
        n = len(self.free)
        number = np.full(self.size, -1)
        number[self.free] = np.arange(n)
        unknown = number[self.dofs]
        rows, columns = np.broadcast_arrays(unknown[:, :, None], unknown[:, None, :])
        keep = (rows >= 0) & (columns >= rows)
        keys, slots = np.unique(rows[keep] * n + columns[keep], return_inverse=True)
        self.columns = (keys % n).astype(np.int32)
        self.starts = np.searchsorted(keys // n, np.arange(n + 1)).astype(np.int32)
        self.slots = np.full(keep.shape, len(keys))
        self.slots[keep] = slots

        elements, points, _, functions = self.deviator.shape
        self.flat_deviator = self.deviator.reshape(elements, points * 3, functions)
        dilatation = self.bulk * self.weights[..., None] * self.dilatation
        deviator = 2 * self.mu * np.repeat(self.weights, 3, axis=1)[..., None] * self.flat_deviator
        self.elastic = self.scatter(
            slice(None),
            self.dilatation.transpose(0, 2, 1) @ dilatation
            + self.flat_deviator.transpose(0, 2, 1) @ deviator,
        )
        self.solver = PyPardisoSolver(mtype=-2)
        self.solver.factorize(self.matrix(self.elastic))
        self.solver.set_phase(23)  # keeps the ordering of the unknowns

    def scatter(self, elements, matrices):
        entries = len(self.columns)
        slots = self.slots[elements]
        return np.bincount(slots.ravel(), matrices.ravel(), entries + 1)[:entries]

    def matrix(self, entries):
        n = len(self.free)
        return sparse.csr_matrix((entries, self.columns, self.starts), shape=(n, n))

    def solve(self, entries, right):
        solution = np.zeros(self.size)
        right = right[self.free, None]
        solution[self.free] = self.solver._call_pardiso(self.matrix(entries), right)[:, 0]
        return solution

    def pressure(self, force):
        """q / s_u"""
        return -float(force[self.footing].sum()) / (WIDTH / 2) / STRENGTH

    def elastic_response(self):
        """Displacements per settlement, initial slope."""
        scale = 1e-6 * STRENGTH / YOUNG_MODULUS  # nothing yields
        u = np.zeros(self.size)
        u[self.footing] = -scale
        u += self.solve(self.elastic, -State(self, u).force)
        return u / scale, self.pressure(State(self, u).force) / (scale / WIDTH)

    def mean_stress(self, u, points):
        """Mean stress / s_u, the mean over the elements that hold the point."""
        values = []
        for x, y in points:
            x_cells = np.unique([np.searchsorted(self.xs, x + e) - 1 for e in (-1e-9, 1e-9)])
            y_cells = np.unique([np.searchsorted(self.ys, y + e) - 1 for e in (-1e-9, 1e-9)])
            holding = (x_cells[:, None] * (len(self.ys) - 1) + y_cells).ravel()
            at = np.tile(np.array([x, y])[:, None, None], (1, len(holding), 1))
            coefficients = self.projection[holding] @ u[self.dofs[holding]][..., None]
            theta = self.monomials(at, holding) @ coefficients
            values.append(self.bulk * float(theta.mean()) / STRENGTH)
        return values


class State:
    """Backward Euler from a plastic strain to displacements."""

    def __init__(self, footing, u, plastic=0.0):
        self.footing = f = footing
        w, limit = f.weights, math.sqrt(2) * STRENGTH
        local = u[f.dofs][..., None]
        self.strain = (f.flat_deviator @ local).reshape(*w.shape, 3)
        self.trial = 2 * f.mu * (self.strain - plastic)
        self.size = np.linalg.norm(self.trial, axis=2)
        self.factor = limit / np.maximum(self.size, limit)
        self.stress = self.factor[..., None] * self.trial
        pressure = f.bulk * (f.dilatation @ local)[..., 0]
        deviatoric = (w[..., None] * self.stress).reshape(len(w), 1, -1) @ f.flat_deviator
        volumetric = (w * pressure)[:, None] @ f.dilatation
        self.force = np.bincount(f.dofs.ravel(), (deviatoric + volumetric).ravel(), f.size)

    def plastic_strain(self):
        return self.strain - self.stress / (2 * self.footing.mu)

    def residual(self):
        """Norm of the out-of-balance forces, relative to the load."""
        f = self.footing
        return float(np.linalg.norm(self.force[f.free]) / abs(self.force[f.footing].sum()))

    def tangent(self):
        """Entries of the consistent tangent: elastic where nothing yields."""
        f = self.footing
        which = np.flatnonzero((self.factor < 1).any(axis=1))
        if not len(which):
            return f.elastic
        factor, B = self.factor[which], f.flat_deviator[which]
        normal = self.trial[which] / np.maximum(self.size[which], 1e-300)[..., None]
        along = np.where(factor < 1, factor, 0.0)[..., None, None]
        loss = (1 - factor)[..., None, None] * np.eye(3)
        loss = loss + along * normal[..., :, None] * normal[..., None, :]
        loss *= -2 * f.mu * f.weights[which][..., None, None]
        loss_B = (loss @ B.reshape(*factor.shape, 3, -1)).reshape(B.shape)
        return f.elastic + f.scatter(which, B.transpose(0, 2, 1) @ loss_B)


def newton(footing, u, plastic):
    """Equilibrium near u; the number of Newton steps."""
    state = State(footing, u, plastic)
    for count in range(60):
        if state.residual() < TOLERANCE:
            return u, state, count
        direction = footing.solve(state.tangent(), -state.force)
        # The work is convex: its derivative along the direction grows from a
        # negative value.  The step is halved where it is well past zero.
        start, length = state.force @ direction, 1.0
        for _ in range(20):
            trial = State(footing, u + length * direction, plastic)
            if trial.force @ direction <= 0.5 * abs(start) or trial.residual() < TOLERANCE:
                break
            length /= 2
        u, state = u + length * direction, trial
    raise RuntimeError(f"Newton's method did not converge: residual {state.residual()}")


def steps(refinement):
    """Settlements of the load steps."""
    ends = ((2e-3, 5e-5), (4e-3, 2.5e-4), (1e-2, 1e-3))
    settlements, last = [0.0], 0.0
    for end, step in ends:
        count = round((end - last) / step) * refinement
        settlements.extend(last + (end - last) * np.arange(1, count + 1) / count)
        last = end
    return np.array(settlements[1:]) * WIDTH


def axes(cells, mesh, formulation, domain=DOMAIN, layers=LAYERS):
    """Breakpoints of x and of the depth."""
    if formulation == "quadratic":
        axis = growing(domain, cells, growth=1.3)
        return refined(axis, WIDTH / 2, layers), refined(axis, 0.0, layers)
    axis = uniform(domain, cells) if mesh == "uniform" else growing(domain, cells)
    return axis, axis


def solution(cells, mesh="uniform", formulation="mean_dilatation", contact="rough", refinement=1):
    """Curve, slope, limit load and mean stress by one discretisation."""
    started = time.monotonic()
    footing = Footing(
        *axes(cells, mesh, formulation), formulation=formulation, rough=contact == "rough"
    )
    rate, slope = footing.elastic_response()
    u, before, plastic = np.zeros(footing.size), 0.0, 0.0
    curve, mean_stress, newton_steps = [(0.0, 0.0)], None, 0
    for settlement in steps(refinement):
        end, state, count = newton(footing, u + rate * (settlement - before), plastic)
        newton_steps += count
        rate = (end - u) / (settlement - before)
        u, before, plastic = end, settlement, state.plastic_strain()
        curve.append((settlement / WIDTH, footing.pressure(state.force)))
        if np.isclose(settlement, PROBE_SETTLEMENT * WIDTH):
            mean_stress = footing.mean_stress(u, PROBES)
    s, q = np.array(curve).T
    result = {
        "cells": cells,
        "mesh": mesh,
        "formulation": formulation,
        "contact": contact,
        "unknowns": len(footing.free),
        "slope": round(slope, 3),
        "pressures": [round(float(q[np.argmin(np.abs(s - x))]), 5) for x in SETTLEMENTS],
        "mean_stress": [round(v, 5) for v in mean_stress],
    }
    if formulation != "displacement":
        rising = q <= 0.995 * q[-1]
        rising[np.argmin(rising)] = True
        result["limit"] = round(float(q[-1]), 5)
        result["settlement_at_99_percent"] = round(
            float(np.interp(0.99 * q[-1], q[rising], s[rising])), 7
        )
    if formulation == "mean_dilatation":
        h = WIDTH / cells
        result["limit_by_width_plus_h"] = round(float(q[-1]) * WIDTH / (WIDTH + h), 5)
    print(
        f"{contact} {formulation} B/{cells} {mesh}: {newton_steps} Newton steps,"
        f" {time.monotonic() - started:.0f} s",
        file=sys.stderr,
        flush=True,
    )
    return result


def slope(poisson_ratio, domain, cells, formulation="mean_dilatation", layers=LAYERS):
    x_and_depth = axes(cells, "uniform", formulation, domain, layers)
    footing = Footing(*x_and_depth, formulation=formulation, poisson_ratio=poisson_ratio)
    return footing.elastic_response()[1]


def slopes(poisson_ratio, domain):
    coarse = [slope(poisson_ratio, domain, cells) for cells in SLOPE_CELLS]
    coarser, fine = (slope(poisson_ratio, domain, c, "quadratic", n) for c, n in ((6, 10), (8, 16)))
    return {
        "poisson_ratio": poisson_ratio,
        "domain": domain,
        "meshes": [{"cells": c, "slope": round(v, 3)} for c, v in zip(SLOPE_CELLS, coarse)],
        "slope": round(fine, 3),
        "uncertainty": uncertainty([fine - coarser]),
    }


def uncertainty(differences):
    """Twice the largest difference, rounded up to one digit."""
    bound = 2 * max(abs(d) for d in differences)
    unit = 10.0 ** math.floor(math.log10(bound))
    return float(f"{math.ceil(bound / unit) * unit:.0e}")


COARSE = [
    *(dict(cells=c) for c in (10, 20)),
    *(dict(cells=c, formulation="displacement") for c in (10, 20)),
    *(dict(cells=c, contact="smooth") for c in (10, 20)),
]
FINE = [
    dict(cells=160, mesh="graded"),
    dict(cells=24, mesh="graded", formulation="quadratic"),
    dict(cells=40),
    dict(cells=40, formulation="displacement"),
    dict(cells=80, mesh="graded"),
    dict(cells=12, mesh="graded", formulation="quadratic"),
    dict(cells=40, mesh="graded"),
    dict(cells=40, mesh="graded", contact="smooth"),
    dict(cells=20, mesh="graded"),
    dict(cells=6, mesh="graded", formulation="quadratic"),
]
HALF_STEPS = dict(cells=20, mesh="graded", refinement=2)


def vector(result):
    """All that is extrapolated."""
    values = [*result["pressures"], result["settlement_at_99_percent"], *result["mean_stress"]]
    return np.array(values)


def extrapolate(coarse, middle, fine):
    """To h = 0, with h, h/2 and h/4."""
    return (vector(coarse) - 6 * vector(middle) + 8 * vector(fine)) / 3


def extrapolated(results, half_steps, exact_slope):
    def find(cells, formulation="mean_dilatation"):
        wanted = dict(cells=cells, mesh="graded", formulation=formulation, contact="rough")
        return next(r for r in results if wanted.items() <= r.items())

    linear = [find(cells) for cells in (20, 40, 80, 160)]
    quadratic = [find(cells, "quadratic") for cells in (6, 12, 24)]
    step = 2 * (vector(half_steps) - vector(linear[0]))
    best, without_finest = extrapolate(*linear[1:]), extrapolate(*linear[:-1])
    other = extrapolate(*quadratic)
    bounds = [uncertainty(d) for d in zip(best - other, best - without_finest)]
    values, n = best + step, len(SETTLEMENTS)
    return {
        "slope": exact_slope["slope"],
        "slope_uncertainty": exact_slope["uncertainty"],
        "limit": round(values[n - 1], 5),
        "limit_uncertainty": bounds[n - 1],
        "settlement_at_99_percent": round(values[n], 7),
        "settlement_at_99_percent_uncertainty": bounds[n],
        "curve": [
            {
                "settlement": s,
                "pressure": round(v, 5),
                "uncertainty": b,
                "quadratic": round(o, 5),
                "step_correction": round(d, 5),
            }
            for s, v, b, o, d in zip(SETTLEMENTS, values, bounds, other + step, step)
        ],
        "mean_stress": [
            {"x": x, "y": y, "value": round(v, 5), "uncertainty": b, "quadratic": round(o, 5)}
            for (x, y), v, b, o in zip(
                PROBES, values[n + 1 :], bounds[n + 1 :], (other + step)[n + 1 :]
            )
        ],
    }


def regenerate():
    with ProcessPoolExecutor() as pool:
        fine = [pool.submit(solution, **case) for case in [*FINE, HALF_STEPS]]
        uniform_slopes = {c: pool.submit(slope, POISSON_RATIO, DOMAIN, c) for c in (10, 20, 40, 80)}
        elastic = [
            pool.submit(slopes, nu, domain)
            for nu in SLOPE_POISSON_RATIOS
            for domain in SLOPE_DOMAINS
        ]
        coarse = [pool.submit(solution, **case) for case in COARSE]
        *fine, half_steps = (f.result() for f in fine)
        elastic = [f.result() for f in elastic]
        uniform_slopes = [
            {"cells": c, "slope": round(f.result(), 3)} for c, f in uniform_slopes.items()
        ]
        coarse = [f.result() for f in coarse]
    key = {"poisson_ratio": POISSON_RATIO, "domain": DOMAIN}
    exact_slope = next(e for e in elastic if key.items() <= e.items())
    results = coarse + fine
    results.sort(
        key=lambda r: (
            r["contact"],
            FORMULATIONS.index(r["formulation"]),
            r["mesh"] != "uniform",
            r["cells"],
        )
    )
    stored = {
        "schema": 1,
        "method": "Static small-strain finite elements (scikit-fem), elastic and perfectly plastic"
        " (von Mises, backward Euler), Newton's method with the consistent tangent. cells: per"
        " width B of the footing. graded: uniform within 2 B, growing outside.",
        "geometry": "Right half of a strip footing of width B = 1 on a square domain of edge 6 B"
        " in plane strain: rollers on the sides, base fixed, u_y = -settlement under x <= B/2.",
        "young_modulus": YOUNG_MODULUS,
        "poisson_ratio": POISSON_RATIO,
        "strength": STRENGTH,
        "domain": DOMAIN,
        "units": "settlement / B, mean pressure under the footing / s_u, mean stress / s_u",
        "exact_limit": round(2 + math.pi, 7),
        "settlements": SETTLEMENTS,
        "mean_stress_points": PROBES,
        "mean_stress_settlement": PROBE_SETTLEMENT,
        "extrapolated": extrapolated(results, half_steps, exact_slope),
        "meshes": results,
        "uniform_slopes": uniform_slopes,
        "slopes": elastic,
        "second_implementation": SECOND_IMPLEMENTATION,
    }
    RESULTS.write_text(json.dumps(stored, indent=1) + "\n")


def check():
    """Recompute the coarse meshes and the slopes; True when all are the same."""
    stored = json.loads(RESULTS.read_text())
    with ProcessPoolExecutor() as pool:
        solutions = [pool.submit(solution, **case) for case in COARSE]
        elastic = [pool.submit(slopes, e["poisson_ratio"], e["domain"]) for e in stored["slopes"]]
        solutions = [f.result() for f in solutions]
        elastic = [f.result() for f in elastic]
    ok = True

    def compare(name, old, new):
        nonlocal ok
        old, new = (np.array(a, dtype=float).ravel() for a in (old, new))
        same = old.shape == new.shape
        worst = float((np.abs(old - new) / np.abs(new).max()).max()) if same else math.inf
        ok &= worst <= REPRODUCED
        print(f"{name}: largest relative difference {worst:.1e}")

    identity = ("cells", "mesh", "formulation", "contact")
    numbers = ("slope", "pressures", "mean_stress", "limit", "settlement_at_99_percent")
    for new in solutions:
        old = next((r for r in stored["meshes"] if all(r[k] == new[k] for k in identity)), {})
        for key in numbers:
            if key in new:
                name = " ".join(str(new[k]) for k in identity)
                compare(f"{name}, {key}", old.get(key, ()), new[key])
    for old, new in zip(stored["slopes"], elastic):
        name = f"slope, nu = {new['poisson_ratio']}, domain = {new['domain']}"
        values = ([s["slope"], *(m["slope"] for m in s["meshes"])] for s in (old, new))
        compare(name, *values)
    return ok


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--cells", type=int, default=20, help="elements per footing width, even")
    parser.add_argument("--mesh", choices=("uniform", "graded"), default="uniform")
    parser.add_argument("--formulation", choices=FORMULATIONS, default=FORMULATIONS[0])
    parser.add_argument("--contact", choices=("rough", "smooth"), default="rough")
    parser.add_argument("--out", type=Path, help="write the JSON here instead of to stdout")
    action = parser.add_mutually_exclusive_group()
    action.add_argument("--regenerate", action="store_true", help="rewrite the data file")
    action.add_argument("--check", action="store_true", help="exit 1 unless it is reproduced")
    arguments = parser.parse_args()

    if arguments.regenerate:
        return regenerate()
    if arguments.check:
        return sys.exit(0 if check() else 1)

    mesh = "graded" if arguments.formulation == "quadratic" else arguments.mesh
    result = solution(arguments.cells, mesh, arguments.formulation, arguments.contact)
    text = json.dumps(result, indent=1) + "\n"
    if arguments.out:
        arguments.out.write_text(text)
    else:
        sys.stdout.write(text)


if __name__ == "__main__":
    main()
