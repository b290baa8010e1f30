"""Bounds of the collapse load of an undrained slope by finite-element limit analysis.

Plane strain, shear strength c = 1 (Tresca), height H = 1, the face at the given
angle from the toe (0, 0), a level crest, a firm and rough base at the level of
the toe.  A vertical face may cut the toe away up to the height `cut`.  The soil ends at a
rough wall, two faces behind the edge of the crest, out of reach of the mechanism.  The unit weight at collapse, gamma H / c, is bounded by second-order
cone programs on triangles, four per cell of a grid of which the face is a diagonal:

  lower  stresses linear in each triangle, in equilibrium, their tractions
         continuous across sides, none on face and crest, no node beyond yield
         (Lyamin & Sloan 2002, doi:10.1002/nme.511)
  upper  velocities linear in each triangle, without change of volume, jumps
         along sides tangential, dissipation c |jump| there
         (Lyamin & Sloan 2002, doi:10.1002/nag.198)

Both are rigorous up to the residuals of the solver, which are given.  The mesh
has `cells` of them over the height.

    python slope_bounds.py --angle 45 --cells 16     both bounds, JSON on stdout
    python slope_bounds.py --cut 0.2 --cells 20      of a slope whose toe is cut away
    python slope_bounds.py --regenerate              rewrite slope_bounds.json
"""

import argparse
import json
from pathlib import Path

import clarabel
import numpy as np
import scipy.sparse as sp

DATA = Path(__file__).with_name("slope_bounds.json")


class Mesh:
    """Triangles, their areas and gradients, and the sides between them."""

    def __init__(self, angle, cells, cut):
        self.cut = round(cut * cells)
        if abs(self.cut - cut * cells) > 1e-9:
            raise SystemExit(f"a cut of {cut} does not end on a line of {cells} cells")
        corners = []
        for j in range(cells):
            for i in range(max(j, self.cut), 3 * cells):
                a, b, c, d = (i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)
                m = (i + 0.5, j + 0.5)
                corners += [(a, b, m), (b, c, m)]
                if i > j:
                    corners += [(c, d, m), (d, a, m)]
        run = 1 / np.tan(np.radians(angle))
        self.cells, self.count = cells, len(corners)
        self.grid = np.array(corners, float)
        self.x = self.grid * np.array([run, 1.0]) / cells
        p, q = np.roll(self.x, -1, axis=1), np.roll(self.x, -2, axis=1)
        u, v = self.x[:, 1] - self.x[:, 0], self.x[:, 2] - self.x[:, 0]
        self.area = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2
        slope = np.stack([p[..., 1] - q[..., 1], q[..., 0] - p[..., 0]], axis=-1)
        self.gradient = slope / (2 * self.area[:, None, None])
        self.sides = {}
        for e, nodes in enumerate(corners):
            for k in range(3):
                side = frozenset((nodes[k], nodes[(k + 1) % 3]))
                self.sides.setdefault(side, []).append((e, k, (k + 1) % 3))

    def ends(self):
        """Of every side: its unit tangent, length, whether it is free, and its nodes in one or two triangles."""
        for uses in self.sides.values():
            e, k, m = uses[0]
            d = self.x[e, m] - self.x[e, k]
            (i0, j0), (i1, j1) = self.grid[e, k], self.grid[e, m]
            face = i0 == j0 and i1 == j1 or i0 == i1 == self.cut and max(j0, j1) <= self.cut
            free = (face or j0 == j1 == self.cells) and len(uses) == 1
            other = [(uses[1][0], uses[1][n]) for n in (2, 1)] if len(uses) == 2 else [None] * 2
            length = np.hypot(*d)
            yield d / length, length, free, list(zip([(e, k), (e, m)], other))


class Rows:
    """Rows of a sparse matrix and their right-hand sides."""

    def __init__(self):
        self.entries, self.right = [], []

    def add(self, columns, values, right=0.0):
        self.entries += [(len(self.right), c, v) for c, v in zip(columns, values)]
        self.right.append(right)

    def matrix(self, columns):
        if not self.entries:
            return sp.csc_matrix((len(self.right), columns))
        r, c, v = zip(*self.entries)
        return sp.csc_matrix((v, (r, c)), shape=(len(self.right), columns))


def solve(cost, equal, below, cone):
    """The least cost subject to equalities, inequalities (row x <= right) and cones of three rows each."""
    n = len(cost)
    a = sp.vstack([rows.matrix(n) for rows in (equal, below, cone)]).tocsc()
    b = np.concatenate([rows.right for rows in (equal, below, cone)])
    cones = [clarabel.ZeroConeT(len(equal.right)), clarabel.NonnegativeConeT(len(below.right))]
    cones += [clarabel.SecondOrderConeT(3)] * (len(cone.right) // 3)
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    x = np.array(clarabel.DefaultSolver(sp.csc_matrix((n, n)), np.array(cost), a, b, cones, settings).solve().x)
    slack = b - a @ x
    m, k = len(equal.right), len(equal.right) + len(below.right)
    s = slack[k:].reshape(-1, 3)
    outside = np.hypot(s[:, 1], s[:, 2]) - s[:, 0]
    residual = max(np.abs(slack[:m]).max(), outside.max(), -slack[m:k].min(initial=0))
    return float(np.dot(cost, x)), float(residual)


def lower(mesh):
    """Stresses xx, yy, xy of every node of every triangle, then the weight."""
    equal, below, cone = Rows(), Rows(), Rows()
    at = lambda e, k: 9 * e + 3 * k
    weight = 9 * mesh.count
    for e in range(mesh.count):
        gx, gy = mesh.gradient[e].T
        n = np.array([at(e, k) for k in range(3)])
        equal.add([*n, *(n + 2)], [*gx, *gy])
        equal.add([*(n + 2), *(n + 1), weight], [*gx, *gy, -1])
        for k in n:
            cone.add([], [], 2.0)
            cone.add([k, k + 1], [-1, 1])
            cone.add([k + 2], [-2])
    for (tx, ty), _, free, ends in mesh.ends():
        nx, ny = ty, -tx
        for node, other in ends:
            both = [(at(*n), sign) for n, sign in ((node, 1), (other, -1)) if n is not None]
            if free or other is not None:
                equal.add([c for n, _ in both for c in (n, n + 2)], [v for _, s in both for v in (s * nx, s * ny)])
                equal.add([c for n, _ in both for c in (n + 2, n + 1)], [v for _, s in both for v in (s * nx, s * ny)])
    cost = np.zeros(weight + 1)
    cost[weight] = -1
    load, residual = solve(cost, equal, below, cone)
    return -load, residual


def upper(mesh):
    """Velocities x, y of every node of every triangle, the shear rate of each, then jumps at ends of sides."""
    equal, below, cone = Rows(), Rows(), Rows()
    at = lambda e, k: 6 * e + 2 * k
    cost = [0.0] * (6 * mesh.count) + list(mesh.area)
    for e in range(mesh.count):
        gx, gy = mesh.gradient[e].T
        n = np.array([at(e, k) for k in range(3)])
        equal.add([*n, *(n + 1)], [*gx, *gy])
        cone.add([6 * mesh.count + e], [-1])
        cone.add([*n, *(n + 1)], [*-gx, *gy])
        cone.add([*n, *(n + 1)], [*-gy, *-gx])
    falling = [(at(e, k) + 1, -mesh.area[e] / 3) for e in range(mesh.count) for k in range(3)]
    equal.add(*zip(*falling), 1.0)
    for t, length, free, ends in mesh.ends():
        for node, other in ends if not free else []:
            both = [(at(*n), sign) for n, sign in ((node, 1), (other, -1)) if n is not None]
            columns = [c for n, _ in both for c in (n, n + 1)]
            along = [s * v for _, s in both for v in t]
            equal.add(columns, [s * v for _, s in both for v in (t[1], -t[0])])
            for sign in (1, -1):
                below.add([*columns, len(cost)], [*(sign * v for v in along), -1])
            cost.append(length / 2)
    return solve(cost, equal, below, cone)


def bounds(angle, cells, cut):
    mesh = Mesh(angle, cells, cut)
    names = ("lower", "upper")
    found = {"angle": angle, "cells": cells, "cut": cut}
    for name, bound in zip(names, (lower, upper)):
        found[name], found[f"{name}_residual"] = bound(mesh)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--angle", type=float, default=45.0, help="angle of the face (degrees)")
    parser.add_argument("--cells", type=int, default=16, help="cells over the height")
    parser.add_argument("--cut", type=float, default=0.0, help="height of the vertical cut over that of the slope")
    parser.add_argument("--regenerate", action="store_true", help="rewrite slope_bounds.json")
    arguments = parser.parse_args()
    if arguments.regenerate:
        meshes = [bounds(45.0, cells, 0.0) for cells in (8, 16, 24)]
        meshes += [bounds(45.0, cells, 0.2) for cells in (10, 15, 20)]
        DATA.write_text(json.dumps(meshes, indent=2) + "\n")
    else:
        print(json.dumps(bounds(arguments.angle, arguments.cells, arguments.cut)))


if __name__ == "__main__":
    main()
