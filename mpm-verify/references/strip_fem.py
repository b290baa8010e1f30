"""Finite-element reference of the elastic strip at small strain.

Half of a strip of half width 1 m on a square of 5 m of linear elastic soil full
of water, E = 1 MPa, nu = 1/4, in plane strain: rollers at the sides, a fixed
base, a drained top, an impermeable rest.  The load grows linearly to its whole
in 2000 s, in 20 steps of backward Euler's rule, at a conductivity of 1e-6 m/s,
water of 9810 N/m3; or at once, where no water flows.  Taylor and Hood's
elements: biquadratic displacements, bilinear pressures, on quadrilaterals
graded to the strip's edge, the top and the axis.  Likewise a quarter of a
square of half side 1 m on a cube of 5 m, on hexahedra.

Stored for cells of size h = 1/2, 1/4 and 1/8 m (1/2 and 1/4 of the square), at
the centres of particles h/2 apart, row by row from the base, of the square
those next to a plane of symmetry: the pressure over the load; and the
settlement of the particle next to the axis at the surface, times G over the
load (m).  The uncertainty is twice the largest difference of settlement and of
the pressure's rms from a mesh of half as many elements along every axis, of the
square of three quarters.

    python strip_fem.py            print settlements and uncertainties
    python strip_fem.py --write    write strip.json
    python strip_fem.py --cost     what a solution of the square takes, by several methods
"""

import json
import os
import resource
import sys
import time
from pathlib import Path

import numpy as np
import scipy.sparse as sparse
from pypardiso import PyPardisoSolver
from skfem import Basis, BilinearForm, ElementHex1, ElementHex2, ElementQuad1, ElementQuad2
from skfem import ElementVector, FacetBasis, LinearForm, MeshHex, MeshQuad
from skfem.helpers import ddot, div, dot, grad, sym_grad

RESULTS = Path(__file__).resolve().parent / "strip.json"
SIDE, HALF_WIDTH, RATIO = 5.0, 1.0, 0.25
SHEAR = 1e6 / (2.0 * (1.0 + RATIO))
LAME = 2.0 * SHEAR * RATIO / (1.0 - 2.0 * RATIO)
KAPPA, TIME, STEPS = 1e-6 / 9810.0, 2000.0, 20
# By dimension: mesh, elements, sizes of cells, and elements of the fine mesh and the coarse one along an axis.
MESH = {2: MeshQuad, 3: MeshHex}
ELEMENTS = {2: (ElementQuad2, ElementQuad1), 3: (ElementHex2, ElementHex1)}
CELLS = {2: [0.5, 0.25, 0.125], 3: [0.5, 0.25]}
FINENESS = {2: (32, 16), 3: (4, 3)}


def graded(start, end, count, power):
    """Breakpoints from start, where they are finest, to end."""
    return start + (end - start) * np.linspace(0.0, 1.0, count + 1) ** power


def system(n, drained, dimension):
    """Spaces, matrices and load of 5 n elements along every axis across and 3 n in the depth."""
    # From the strip's edge: what is small there keeps its digits.
    left = graded(0.0, -HALF_WIDTH, 2 * n, 2.5)[::-1]
    right = graded(0.0, SIDE - HALF_WIDTH, 3 * n, 3.0)
    across = np.concatenate([left, right[1:]])
    depth = graded(0.0, -SIDE, 3 * n, 2.5)[::-1]
    mesh = MESH[dimension].init_tensor(*[across] * (dimension - 1), depth)
    of_solid, of_water = ELEMENTS[dimension]
    solid = Basis(mesh, ElementVector(of_solid()), intorder=5)
    water = solid.with_element(of_water())

    stiffness = BilinearForm(
        lambda u, v, _: 2.0 * SHEAR * ddot(sym_grad(u), sym_grad(v)) + LAME * div(u) * div(v)
    ).assemble(solid)
    coupling = BilinearForm(lambda u, q, _: q * div(u)).assemble(solid, water)
    flow = BilinearForm(lambda p, q, _: KAPPA * dot(grad(p), grad(q))).assemble(water)
    strip = mesh.facets_satisfying(
        lambda x: np.isclose(x[-1], 0.0) & np.all(x[:-1] < 0.0, axis=0), boundaries_only=True
    )
    load = LinearForm(lambda v, _: -v[dimension - 1]).assemble(
        FacetBasis(mesh, ElementVector(of_solid()), facets=strip, intorder=5)
    )

    step = TIME / STEPS if drained else 0.0
    matrix = sparse.bmat([[stiffness, -coupling.T], [-coupling, -step * flow]]).tocsc()
    nu = solid.N
    fixed = solid.get_dofs(lambda x: np.isclose(x[-1], -SIDE)).all()
    for a in range(dimension - 1):
        ends = solid.get_dofs(
            lambda x: np.isclose(x[a], -HALF_WIDTH) | np.isclose(x[a], across[-1])
        )
        fixed = np.union1d(fixed, ends.all(f"u^{a + 1}"))
    if drained:
        top = water.get_dofs(lambda x: np.isclose(x[-1], 0.0)).all()
        fixed = np.union1d(fixed, nu + top)
    free = np.setdiff1d(np.arange(nu + water.N), fixed)
    return solid, water, coupling, load, matrix, free


def solve(n, drained, dimension):
    """Settlements and pressures of a load of one."""
    solid, water, coupling, load, matrix, free = system(n, drained, dimension)
    nu = solid.N
    inner = matrix[free][:, free].tocsr()
    direct = PyPardisoSolver()
    direct.factorize(inner)
    values = np.zeros(nu + water.N)
    steps = STEPS if drained else 1
    for k in range(1, steps + 1):
        right_side = np.concatenate([k / steps * load, -coupling @ values[:nu]])
        values = np.zeros_like(values)
        values[free] = direct.solve(inner, right_side[free])
    direct.free_memory(everything=True)

    found = {}
    for h in CELLS[dimension]:
        place = (np.arange(round(2 * SIDE / h)) + 0.5) * h / 2
        x, z = np.meshgrid(place - HALF_WIDTH, place - SIDE)
        next_to = np.full(x.size, h / 4 - HALF_WIDTH)
        points = np.array([x.ravel(), *[next_to] * (dimension - 2), z.ravel()])
        pressure = water.probes(points) @ values[nu:]
        corner = np.array([[h / 4 - HALF_WIDTH]] * (dimension - 1) + [[-h / 4]])
        # Components of probes of a vector stand one after the other.
        settlement = -(solid.probes(corner) @ values[:nu]).reshape(dimension, -1)[-1, 0] * SHEAR
        found[h] = (settlement, pressure)
    return found


def reference(drained, dimension):
    fine, coarse = (solve(n, drained, dimension) for n in FINENESS[dimension])
    cells = []
    for h in CELLS[dimension]:
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


def measured(work):
    """What a call returns in a process of its own, its processor time (s) and its peak memory (GB)."""
    reader, writer = os.pipe()
    if os.fork() == 0:
        before = time.process_time()
        value = work()
        taken = time.process_time() - before
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
        os.write(writer, json.dumps([value, taken, peak]).encode())
        os._exit(0)
    os.close(writer)
    with os.fdopen(reader, "rb") as told:
        text = told.read()
    os.wait()
    return json.loads(text) if text else [None, float("nan"), float("nan")]


def iterative(solid, water, matrix, load, free):
    """Iterations of MINRES to 1e-9: algebraic multigrid for displacements, a diagonal for pressures."""
    import pyamg
    from scipy.sparse.linalg import LinearOperator, minres

    inner = matrix[free][:, free].tocsr()
    count = int(np.sum(free < solid.N))
    places, component = solid.doflocs[:, free[:count]], free[:count] % 3
    modes = np.zeros((count, 6))
    for a, b in [(0, 1), (1, 2), (2, 0)]:
        modes[component == a, a] = 1.0
        modes[component == a, 3 + a] = -places[b, component == a]
        modes[component == b, 3 + a] = places[a, component == b]
    blocks = inner[:count, :count].tocsr()
    grids = pyamg.smoothed_aggregation_solver(blocks, B=modes, max_coarse=500).aspreconditioner()
    mass = BilinearForm(lambda p, q, _: p * q / (2.0 * SHEAR)).assemble(water)
    flow = -inner[count:, count:].diagonal()
    pressures = mass.diagonal()[free[count:] - solid.N] + flow
    apply = lambda r: np.concatenate([grids @ r[:count], r[count:] / pressures])
    taken = [0]

    def one_more(_):
        taken[0] += 1

    right_side = np.concatenate([load, np.zeros(water.N)])[free]
    preconditioner = LinearOperator(inner.shape, matvec=apply)
    minres(inner, right_side, rtol=1e-9, maxiter=2000, M=preconditioner, callback=one_more)
    return taken[0]


def cost():
    """A solution of the square by factors and by iteration, over the mesh."""
    print("n unknowns entries | factors: CPU (s), memory (GB) | MINRES: iterations, CPU (s), memory (GB)")
    for n in (1, 2, 3, 4):
        solid, water, _, load, matrix, free = system(n, True, 3)
        inner = matrix[free][:, free].tocsr()
        right_side = np.concatenate([load, np.zeros(water.N)])[free]

        def factors():
            PyPardisoSolver().solve(inner, right_side)

        by_factors = measured(factors)
        by_steps = measured(lambda: iterative(solid, water, matrix, load, free))
        print(n, free.size, inner.nnz, by_factors[1:], by_steps, flush=True)


def main():
    if "--cost" in sys.argv:
        return cost()
    results = {
        "problem": "Flexible strip of half width 1 m on 5 m x 5 m of elastic soil full of water,"
        " and a quarter of a square on a cube, small strain; settlement times G over the load (m),"
        " 1e5 times the pressure over the load.",
    }
    for kind, dimension in [("strip", 2), ("square", 3)]:
        results[kind] = {}
        for key, drained in [("drained", True), ("undrained", False)]:
            results[kind][key] = reference(drained, dimension)
            for row in results[kind][key]:
                print(kind, key, {k: v for k, v in row.items() if k != "pressure"}, flush=True)
    if "--write" in sys.argv:
        RESULTS.write_text(json.dumps(results, separators=(",", ":")) + "\n")


if __name__ == "__main__":
    main()
