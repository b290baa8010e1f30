"""One-dimensional consolidation of a column at finite strain.

A column of height H = 1 m on an impermeable base, full of water that leaves at the top, where a
dead load grows linearly to q until T = 0.05 and then stays; T = c_v t/H^2, c_v = kappa_0 M_0 of
undeformed material.  Grains and water keep their volumes.  With J = dz/dZ of the solid and the
porosity n = 1 - (1 - n_0)/J,

  dJ/dt = d/dZ (kappa(n)/J dp/dZ),   p = q(t) + tau(J)/J,   dp/dZ = 0 at Z = 0,  p = 0 at Z = H,

the improved Hencky law of uniaxial strain v = ln J, tau = K v/n - K v^2 (1 - n)/(2 n^2) + 4/3 G v,
M_0 = K/n_0 + 4/3 G, and kappa(n) = c n^3/(1 - n)^2 after Kozeny and Carman.  Lengths here are
shares of H, stresses of M_0, times of H^2/c_v.

  spectral  Chebyshev collocation, Radau's method
  volumes   finite volumes, the differences of three meshes extrapolated away twice, BDF

Both are of high order, and share the law and nothing else.  `steps` are backward Euler's, exact in
space: the 125 durations FIRST GROWTH^k end at T = 2, each cut into `refine` that grow by the
refine-th root of GROWTH.  Values at the times of the table are those of the cubic through the two
ends of steps before and after.

    python consolidation.py                 both methods and what they differ by, on stdout
    python consolidation.py --regenerate    rewrite consolidation.csv
"""

import argparse
import csv
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.sparse import diags

DATA = Path(__file__).with_name("consolidation.csv")

BULK, SHEAR, POROSITY = 50e3, 300e3, 0.5
MODULUS = BULK / POROSITY + 4 / 3 * SHEAR
RAMP, END, COUNT, FIRST = 0.05, 2.0, 125, 1e-3
GROWTH = brentq(lambda r: FIRST * (r**COUNT - 1) / (r - 1) - END, 1.001, 1.2, xtol=1e-15)
TIMES = np.array([0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0])
LOADS, REFINES = (0.003, 0.3, 1.0), (1, 2, 4, 8)


def stress(e):
    """tau/J over M_0, and its derivative by J, of e = J - 1, which at small loads has more digits."""
    v, j = np.log1p(e), 1 + e
    solid = (1 - POROSITY) / j
    n = 1 - solid
    tau = BULK * (v / n - v**2 * solid / (2 * n**2)) + 4 / 3 * SHEAR * v
    # dn/dv = 1 - n = solid, and d(solid)/dv = -solid.
    slope = BULK * (
        1 / n - v * solid / n**2 - v * solid / n**2 + v**2 * solid / (2 * n**2) + v**2 * solid**2 / n**3
    )
    slope += 4 / 3 * SHEAR
    return tau / j / MODULUS, (slope - tau) / j**2 / MODULUS


def mobility(e):
    """kappa/J over kappa_0, and its derivative by J."""
    j = 1 + e
    solid = (1 - POROSITY) / j
    n = 1 - solid
    unit = POROSITY**3 / (1 - POROSITY) ** 2
    value = n**3 / solid**2 / unit / j
    return value, value * (3 * solid / (j * n) + 2 / j - 1 / j)


def drained(load):
    """J - 1 where p = 0."""
    e = brentq(lambda e: load + stress(e)[0], -POROSITY + 1e-6, 1e-6, xtol=1e-16, rtol=1e-15)
    sigma, slope = stress(e)
    return e - (load + sigma) / slope


def load_at(load, t):
    return load * min(t / RAMP, 1.0)


class Spectral:
    """Values of J - 1 at Chebyshev's points, from Z = 0 to 1."""

    def __init__(self, n):
        k = np.arange(n + 1)
        x = -np.cos(np.pi * k / n)
        c = np.where((k == 0) | (k == n), 2.0, 1.0) * (-1.0) ** k
        dx = x[:, None] - x[None, :] + np.eye(n + 1)
        d = np.outer(c, 1 / c) / dx
        d -= np.diag(d.sum(axis=1))
        self.d, self.n = 2 * d, n
        # Clenshaw and Curtis' weights on [0, 1].
        theta = np.pi * k / n
        w = np.ones(n + 1)
        for m in range(1, n // 2 + 1):
            b = 1.0 if 2 * m == n else 2.0
            w -= b * np.cos(2 * m * theta) / (4 * m * m - 1)
        w *= 2.0 / n
        w[[0, -1]] /= 2
        self.weights = w / 2

    def rates(self, e):
        """dJ/dt at all points but the top, and the derivatives by J at all."""
        sigma, slope = stress(e)
        permeable, steeper = mobility(e)
        # p less the load, which has no slope.
        gradient = self.d @ sigma
        flux = permeable * gradient
        by = (permeable[:, None] * self.d) * slope[None, :] + np.diag(steeper * gradient)
        flux[0], by[0] = 0.0, 0.0
        return (self.d @ flux)[:-1], (self.d @ by)[:-1]

    def observe(self, e, load):
        """s/H and p/q at the base and in the middle."""
        p = load + stress(e)[0]
        # In the middle by barycentric interpolation: it is a point of an even number.
        return -self.weights @ e, p[0], p[self.n // 2]

    def exact(self, load):
        whole = lambda t, inner: np.append(inner, drained(load_at(load, t)))
        rates = lambda t, inner: self.rates(whole(t, inner))[0]
        slopes = lambda t, inner: self.rates(whole(t, inner))[1][:, :-1]
        rows, start = [], np.zeros(self.n)
        for begin, end in ((0.0, RAMP), (RAMP, END)):
            at = TIMES[(TIMES > begin) & (TIMES <= end)]
            found = solve_ivp(
                rates, (begin, end), start, "Radau", t_eval=at, jac=slopes, rtol=1e-10, atol=1e-11 * load
            )
            assert found.success, found.message
            rows += [self.observe(whole(t, y), load_at(load, t)) for t, y in zip(found.t, found.y.T)]
            start = found.y[:, -1]
        return scaled(rows, load)

    def layer(self, load, t=0.1):
        """Height over which kappa/J changes by the factor e at the top at a time, by steps of 1/1000 of it."""
        e, dt = np.zeros(self.n + 1), t / 1000
        for k in range(1000):
            e = self.step(e, load_at(load, (k + 1) * dt), dt, load)
        value = mobility(e)[0]
        return value[-1] / abs((self.d @ value)[-1])

    def step(self, e, q, dt, load):
        """Backward Euler's."""
        before, e = e[:-1], np.append(e[:-1], drained(q))
        for _ in range(30):
            rate, by = self.rates(e)
            residual = e[:-1] - before - dt * rate
            change = np.linalg.solve(np.eye(self.n) - dt * by[:, :-1], residual)
            e[:-1] -= change
            if abs(change).max() < 1e-12 * load:
                return e
        raise RuntimeError("no solution of a step")

    def steps(self, load, refine):
        ratio = GROWTH ** (1 / refine)
        first = FIRST * (ratio - 1) / (GROWTH - 1)
        t, e, seen = 0.0, np.zeros(self.n + 1), []
        for k in range(COUNT * refine):
            dt = first * ratio**k
            t += dt
            e = self.step(e, load_at(load, t), dt, load)
            seen.append((t, *self.observe(e, load_at(load, t))))
        seen = np.array(seen)
        return scaled([cubic(seen, t) for t in TIMES], load)


def cubic(seen, t):
    """The cubic through the two rows before and the two after a time, which is first in a row."""
    last = len(seen) - 2
    middle = min(max(int(np.searchsorted(seen[:, 0], t)), 2), last)
    rows = seen[middle - 2 : middle + 2]
    at = rows[:, 0]
    weights = [np.prod([(t - b) / (a - b) for b in at if b != a]) for a in at]
    return np.array(weights) @ rows[:, 1:]


def scaled(rows, load):
    return np.array([[s, base / load, middle / load] for s, base, middle in rows])


class Volumes:
    """Means of J - 1 over equal cells; p in their middles, fluxes at their sides."""

    def __init__(self, n):
        self.n = n

    def rates(self, t, e, load):
        q = load_at(load, t)
        sigma, _ = stress(e)
        permeable, _ = mobility(e)
        h = 1 / self.n
        flux = np.zeros(self.n + 1)
        flux[1:-1] = 0.5 * (permeable[1:] + permeable[:-1]) * np.diff(sigma) / h
        # At the top a parabola through the drained side and the two uppermost middles.
        top = mobility(drained(q))[0]
        p = q + sigma
        flux[-1] = top * (-9 * p[-1] + p[-2]) / (3 * h)
        return np.diff(flux) / h

    def exact(self, load):
        n, rows, start = self.n, [], np.zeros(self.n)
        band = diags([np.ones(n - abs(k)) for k in (-2, -1, 0, 1, 2)], [-2, -1, 0, 1, 2])
        for begin, end in ((0.0, RAMP), (RAMP, END)):
            at = TIMES[(TIMES > begin) & (TIMES <= end)]
            found = solve_ivp(
                lambda t, e: self.rates(t, e, load),
                (begin, end),
                start,
                "BDF",
                t_eval=at,
                jac_sparsity=band,
                rtol=1e-10,
                atol=1e-11 * load,
            )
            assert found.success, found.message
            for t, e in zip(found.t, found.y.T):
                p = load_at(load, t) + stress(e)[0]
                # Even about the base; in the middle a cubic.
                base = (150 * p[0] - 25 * p[1] + 3 * p[2]) / 128
                m = n // 2
                middle = (9 * (p[m - 1] + p[m]) - p[m - 2] - p[m + 1]) / 16
                rows.append((-e.mean(), base, middle))
            start = found.y[:, -1]
        return scaled(rows, load)


def extrapolated(load):
    """Of three meshes: h^2 away, then h^3, which the parabola at the top leaves."""
    a, b, c = (Volumes(n).exact(load) for n in (200, 400, 800))
    first, second = b + (b - a) / 3, c + (c - b) / 3
    return second + (second - first) / 7


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--regenerate", action="store_true")
    arguments = parser.parse_args()
    print(f"growth {GROWTH:.15f}")
    lines = []
    for load in LOADS:
        exact = Spectral(96).exact(load)
        coarse = Spectral(64).exact(load)
        other = extrapolated(load)
        print(f"load {load}: 64 and 96 points differ by {abs(exact - coarse).max():.1e}")
        print(f"  spectral and volumes by {abs(exact - other).max():.1e}")
        solutions = [(0, exact)] + [(r, Spectral(96).steps(load, r)) for r in REFINES]
        print(f"  layer at the top at T = 0.1: {Spectral(96).layer(load):.4f}")
        rough = Spectral(64).steps(load, 4)
        print(f"  steps, 64 and 96 points by {abs(rough - solutions[3][1]).max():.1e}")
        for refine, values in solutions:
            error = (values[:, 0] / exact[:, 0] - 1)[TIMES >= 0.1]
            print(f"  refine {refine}: settlement off by {abs(error).max():.2e}")
            lines += [
                [load, refine, t, *(f"{v:.12f}" for v in row)] for t, row in zip(TIMES, values)
            ]
    if arguments.regenerate:
        with DATA.open("w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["load", "refine", "t", "settlement", "base_pressure", "middle_pressure"])
            writer.writerows(lines)


if __name__ == "__main__":
    main()
