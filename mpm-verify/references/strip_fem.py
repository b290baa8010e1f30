"""Finite-element reference of the elastic strip at small strain.

Half of a strip of half width 1 m on a square of 5 m of linear elastic soil full
of water, E = 1 MPa, nu = 1/4, in plane strain: rollers at the sides, a fixed
base, a drained top, an impermeable rest.  The load grows linearly to its whole
in 2000 s, in 20 steps of backward Euler's rule, at a conductivity of 1e-6 m/s,
water of 9810 N/m3; or at once, where no water flows.  Taylor and Hood's
elements: biquadratic displacements, bilinear pressures, on quadrilaterals
graded to the strip's edge, the top and the axis.

Stored for cells of size h = 1/2, 1/4 and 1/8 m, at the centres of 2 x 2
particles a cell, row by row from the base: the pressure over the load; and the
settlement of the particle next to the axis at the surface, times G over the
load (m).  The uncertainty is twice the largest difference of settlement and of
the pressure's rms from a mesh of half as many elements along every axis.

    python strip_fem.py            print settlements and uncertainties
    python strip_fem.py --write    write strip.json
"""

import json
import sys
from pathlib import Path

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm, ElementQuad1, ElementQuad2, ElementVector, FacetBasis
from skfem import LinearForm, MeshQuad
from skfem.helpers import ddot, div, dot, grad, sym_grad

RESULTS = Path(__file__).resolve().parent / "strip.json"
SIDE, HALF_WIDTH, RATIO = 5.0, 1.0, 0.25
SHEAR = 1e6 / (2.0 * (1.0 + RATIO))
LAME = 2.0 * SHEAR * RATIO / (1.0 - 2.0 * RATIO)
KAPPA, TIME, STEPS = 1e-6 / 9810.0, 2000.0, 20
CELLS = [0.5, 0.25, 0.125]


def graded(start, end, count, power):
    """Breakpoints from start, where they are finest, to end."""
    return start + (end - start) * np.linspace(0.0, 1.0, count + 1) ** power


def solve(n, drained):
    """Settlements and pressures on 5 n by 3 n elements, of a load of one."""
    # From the strip's edge: what is small there keeps its digits.
    left = graded(0.0, -HALF_WIDTH, 2 * n, 2.5)[::-1]
    right = graded(0.0, SIDE - HALF_WIDTH, 3 * n, 3.0)
    xs = np.concatenate([left, right[1:]])
    ys = graded(0.0, -SIDE, 3 * n, 2.5)[::-1]
    mesh = MeshQuad.init_tensor(xs, ys)
    solid = Basis(mesh, ElementVector(ElementQuad2()), intorder=5)
    water = solid.with_element(ElementQuad1())

    stiffness = BilinearForm(
        lambda u, v, _: 2.0 * SHEAR * ddot(sym_grad(u), sym_grad(v)) + LAME * div(u) * div(v)
    ).assemble(solid)
    coupling = BilinearForm(lambda u, q, _: q * div(u)).assemble(solid, water)
    flow = BilinearForm(lambda p, q, _: KAPPA * dot(grad(p), grad(q))).assemble(water)
    strip = mesh.facets_satisfying(
        lambda x: np.isclose(x[1], 0.0) & (x[0] < 0.0), boundaries_only=True
    )
    load = LinearForm(lambda v, _: -v[1]).assemble(
        FacetBasis(mesh, ElementVector(ElementQuad2()), facets=strip, intorder=5)
    )

    step = TIME / STEPS if drained else 0.0
    matrix = sparse.bmat([[stiffness, -coupling.T], [-coupling, -step * flow]]).tocsc()
    nu = solid.N
    base = solid.get_dofs(lambda x: np.isclose(x[1], -SIDE)).all()
    sides = solid.get_dofs(lambda x: np.isclose(x[0], -HALF_WIDTH) | np.isclose(x[0], xs[-1])).all("u^1")
    fixed = np.union1d(base, sides)
    if drained:
        top = water.get_dofs(lambda x: np.isclose(x[1], 0.0)).all()
        fixed = np.union1d(fixed, nu + top)
    free = np.setdiff1d(np.arange(nu + water.N), fixed)
    factor = splu(matrix[free][:, free].tocsc())
    values = np.zeros(nu + water.N)
    steps = STEPS if drained else 1
    for k in range(1, steps + 1):
        right_side = np.concatenate([k / steps * load, -coupling @ values[:nu]])
        values = np.zeros_like(values)
        values[free] = factor.solve(right_side[free])

    found = {}
    for h in CELLS:
        place = (np.arange(round(2 * SIDE / h)) + 0.5) * h / 2
        x, y = np.meshgrid(place, place)
        points = np.array([x.ravel() - HALF_WIDTH, y.ravel() - SIDE])
        pressure = water.probes(points) @ values[nu:]
        corner = np.array([[h / 4 - HALF_WIDTH], [-h / 4]])
        # Components of probes of a vector stand one after the other.
        settlement = -(solid.probes(corner) @ values[:nu]).reshape(2, -1)[1, 0] * SHEAR
        found[h] = (settlement, pressure)
    return found


def reference(drained, n):
    fine, coarse = solve(n, drained), solve(n // 2, drained)
    cells = []
    for h in CELLS:
        (settlement, pressure), (other, rough) = fine[h], coarse[h]
        cells.append(
            {
                "h": h,
                "settlement": round(settlement, 7),
                "settlement_uncertainty": float(f"{2 * abs(settlement - other):.1e}"),
                "pressure_uncertainty": float(
                    f"{2 * np.sqrt(np.mean((pressure - rough) ** 2)):.1e}"
                ),
                "pressure": [round(1e5 * p) for p in pressure],
            }
        )
    return cells


def main():
    n = 32
    results = {
        "problem": "Flexible strip of half width 1 m on 5 m x 5 m of elastic soil full of water,"
        " small strain; settlement times G over the load (m), 1e5 times the pressure over the load.",
        "drained": reference(True, n),
        "undrained": reference(False, n),
    }
    for key in ("drained", "undrained"):
        for row in results[key]:
            print(key, {k: v for k, v in row.items() if k != "pressure"})
    if "--write" in sys.argv:
        RESULTS.write_text(json.dumps(results, separators=(",", ":")) + "\n")


if __name__ == "__main__":
    main()
