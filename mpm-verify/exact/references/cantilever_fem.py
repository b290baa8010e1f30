"""Finite-element reference for the stresses of the cantilever at finite strain.

A beam 1 m x 0.3 m in plane strain, nu = 0, clamped at x = 0, under a dead body
force of 4 kN/m3 of initial volume, E = 100 kPa; Hencky's law, W = mu sum (ln
lambda_i)^2, or the neo-Hookean W = mu/2 (I1 - 3 - 2 ln J), mu = E/2.  The load
is raised in steps, each solved by Newton's method on quadrilaterals graded
geometrically to the clamp and to both long sides: its corners are singular.

Of Cauchy's stress sigma_xx is stored at material points near the clamp and away
from its corners, with its gradient over them (Pa/m), and the corner's
displacement, by which this solution is seen to be that of cantilever.json.  The
uncertainty is twice the difference from a coarser mesh of one degree less.

    python cantilever_fem.py            print what cantilever_stress.json holds
    python cantilever_fem.py --write    rewrite it
"""

import json
import math
import sys
from pathlib import Path

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu
from skfem import Basis, ElementQuadP, MeshQuad

RESULTS = Path(__file__).resolve().parent / "cantilever_stress.json"
LENGTH, DEPTH, WEIGHT, MU = 1.0, 0.3, 4000.0, 5e4
POINTS = [(x, y) for x in (0.1, 0.2) for y in (0.05, 0.15, 0.25)]
STEPS, RATIO = 10, 0.5
DISTANCE = 1e-3  # of the points that a gradient is taken from (m)


def graded(end, intervals, layers_start, layers_end):
    """Uniform breakpoints, the first and last interval graded to the ends."""
    step = end / intervals
    first = step * RATIO ** np.arange(layers_start, 0, -1)
    last = end - step * RATIO ** np.arange(1, layers_end + 1)
    return np.unique(np.concatenate([np.linspace(0.0, end, intervals + 1), first, last]))


def hencky(F):
    """First Piola-Kirchhoff stress: F S, S coaxial with C = F^T F."""
    squares, axes = np.linalg.eigh(np.swapaxes(F, -1, -2) @ F)
    S = (axes * (MU * np.log(squares) / squares)[..., None, :]) @ np.swapaxes(axes, -1, -2)
    return F @ S


def neo_hookean(F):
    return MU * (F - np.swapaxes(np.linalg.inv(F), -1, -2))


class Beam:
    def __init__(self, law, elements, degree, layers):
        self.law = law
        self.xs = graded(LENGTH, elements, layers, 0)
        self.ys = graded(DEPTH, elements // 3, layers, layers)
        mesh = MeshQuad.init_tensor(self.xs, self.ys)
        self.basis = basis = Basis(mesh, ElementQuadP(degree), intorder=2 * degree + 2)
        n = self.n = basis.N
        self.grad = np.stack([f[0].grad for f in basis.basis]).transpose(2, 3, 1, 0).copy()
        shape = np.stack([f[0].value * np.ones_like(basis.dx) for f in basis.basis])
        self.dofs = np.concatenate([basis.element_dofs, n + basis.element_dofs]).T
        self.load = np.zeros(2 * n)
        weights = np.einsum("feq,eq->fe", shape, basis.dx)
        np.add.at(self.load, n + basis.element_dofs, -WEIGHT * weights)
        clamped = basis.get_dofs(lambda x: np.isclose(x[0], 0.0)).all()
        self.free = np.setdiff1d(np.arange(2 * n), np.concatenate([clamped, n + clamped]))
        self.values = np.zeros(2 * n)
        for k in range(1, STEPS + 1):
            self.solve(k / STEPS * self.load)

    def deformation(self):
        functions = self.grad.shape[-1]
        u = self.values[self.dofs].reshape(-1, 1, 2, functions)
        return np.eye(2) + u @ self.grad.transpose(0, 1, 3, 2)

    def solve(self, load):
        for _ in range(20):
            force, stiffness = self.assemble()
            residual = (load - force)[self.free]
            if np.linalg.norm(residual) < 1e-9 * np.linalg.norm(load):
                return
            factor = splu(stiffness[self.free][:, self.free].tocsc())
            self.values[self.free] += factor.solve(residual)
        raise RuntimeError("no convergence")

    def assemble(self):
        F, G, dx = self.deformation(), self.grad, self.basis.dx
        elements, points, _, functions = G.shape
        P, tangent = self.law(F), np.empty((*F.shape, 2, 2))
        for k in range(2):
            for l in range(2):
                step = np.zeros((2, 2))
                step[k, l] = 1e-6
                tangent[..., k, l] = (self.law(F + step) - self.law(F - step)) / 2e-6
        force = np.einsum("eqij,eqjf,eq->eif", P, G, dx, optimize=True)
        matrix = np.einsum("eqijkl,eqjf,eqlg,eq->eifkg", tangent, G, G, dx, optimize=True)
        size = 2 * functions
        matrix = matrix.reshape(elements, size, size)
        rows = np.broadcast_to(self.dofs[:, :, None], matrix.shape)
        columns = np.broadcast_to(self.dofs[:, None, :], matrix.shape)
        stiffness = sparse.coo_matrix((matrix.ravel(), (rows.ravel(), columns.ravel())))
        vector = np.bincount(self.dofs.ravel(), force.reshape(elements, size).ravel(), 2 * self.n)
        return vector, stiffness.tocsr()

    def at(self, points):
        """Displacement and sigma_xx at material points."""
        x, y = np.asarray(points, dtype=float).T
        i = np.clip(np.searchsorted(self.xs, x, side="right") - 1, 0, len(self.xs) - 2)
        j = np.clip(np.searchsorted(self.ys, y, side="right") - 1, 0, len(self.ys) - 2)
        cells = j + i * (len(self.ys) - 1)
        where = self.basis.mapping.invF(np.stack([x, y])[:, :, None], tind=cells)
        u, F = np.zeros((len(x), 2)), np.tile(np.eye(2), (len(x), 1, 1))
        for a, dofs in enumerate(self.basis.element_dofs):
            function = self.basis.elem.gbasis(self.basis.mapping, where, a, tind=cells)[0]
            value = np.broadcast_to(function.value, where.shape[1:])[:, 0]
            for c in range(2):
                of = self.values[c * self.n + dofs[cells]]
                u[:, c] += of * value
                F[:, c] += (of * function.grad[..., 0]).T
        sigma = self.law(F) @ np.swapaxes(F, -1, -2) / np.linalg.det(F)[:, None, None]
        return u, sigma[:, 0, 0]

    def results(self):
        points = np.array(POINTS)
        _, stress = self.at(points)
        shifted = [self.at(points + d * np.eye(2)[a])[1] for a in (0, 1) for d in (DISTANCE, -DISTANCE)]
        slopes = [(shifted[2 * a] - shifted[2 * a + 1]) / (2 * DISTANCE) for a in (0, 1)]
        return self.at([(LENGTH, 0.0)])[0][0], stress, np.hypot(*slopes)


def uncertainty(differences):
    """Twice the largest difference, rounded up to one digit."""
    bound = 2 * float(np.abs(differences).max())
    unit = 10.0 ** math.floor(math.log10(bound))
    return float(f"{math.ceil(bound / unit) * unit:.0e}")


def main():
    document = {
        "problem": "as cantilever.json",
        "method": "finite elements of degree 5 and 4 graded to the clamp and the long sides (scikit-fem)",
    }
    for name, law in (("hencky", hencky), ("neo_hookean", neo_hookean)):
        fine, coarse = Beam(law, 12, 5, 6).results(), Beam(law, 9, 4, 4).results()
        document[name] = {
            "corner": [round(float(u), 7) for u in fine[0]],
            "stress_xx": [
                {"x": x, "y": y, "value": round(float(s), 2), "gradient": round(float(g), 1)}
                for (x, y), s, g in zip(POINTS, fine[1], fine[2])
            ],
            "uncertainty_stress": uncertainty(fine[1] - coarse[1]),
        }
    text = json.dumps(document, indent=1) + "\n"
    RESULTS.write_text(text) if "--write" in sys.argv[1:] else print(text)


if __name__ == "__main__":
    main()
