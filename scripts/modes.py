#!/usr/bin/env python3
"""Linear analysis of the averages: the numbers of docs/remedy.md that it calls those of the script. Needs numpy.

Largest stable CFL numbers at rest, and the largest growth of a wave per crossed cell, from the step matrices of one Bloch
wave on a periodic lattice of n particles per cell (FLIP, no mean stress, epsilon = 0).
"""

import numpy as np

BASES = ["linear", "uGIMP", "quadratic", "cubic"]
KINDS = ["none", "rate", "consistent", "recursive"]


def hat(x):
    return np.maximum(0.0, 1.0 - np.abs(x))


def weight(basis, n, x):
    """A function of a basis at the distance x from its node, in cells."""
    x = np.abs(x)
    if basis == "linear":
        return hat(x)
    if basis == "uGIMP":
        half = 0.5 / n
        integral = lambda y: np.sign(y) * np.where(abs(y) < 1.0, abs(y) - 0.5 * y * y, 0.5)
        return (integral(x + half) - integral(x - half)) / (2.0 * half)
    if basis == "quadratic":
        return np.where(x < 0.5, 0.75 - x * x, np.where(x < 1.5, 0.5 * (1.5 - x) ** 2, 0.0))
    near = 2.0 / 3.0 - x * x + 0.5 * x**3
    return np.where(x < 1.0, near, np.where(x < 2.0, (2.0 - x) ** 3 / 6.0, 0.0))


def slope(basis, n, x):
    """Its derivative; of hats on one side."""
    if basis == "linear":
        return np.where((x > -1.0) & (x <= 0.0), 1.0, np.where((x > 0.0) & (x < 1.0), -1.0, 0.0))
    if basis == "uGIMP":
        half = 0.5 / n
        return (hat(x + half) - hat(x - half)) / (2.0 * half)
    sign, y = np.sign(x), np.abs(x)
    if basis == "quadratic":
        return sign * np.where(y < 0.5, -2.0 * y, np.where(y < 1.5, y - 1.5, 0.0))
    return sign * np.where(y < 1.0, -2.0 * y + 1.5 * y * y, np.where(y < 2.0, -0.5 * (2.0 - y) ** 2, 0.0))


def wave(basis, n, theta, shift):
    """phi and psi of the particles of a cell shifted by `shift` cells."""
    x = (np.arange(n) + 0.5) / n + shift
    m = np.arange(np.floor(shift) - 3, np.floor(shift) + 6)
    # Quadratic splines have their nodes in the middle of cells.
    nodes = m + 0.5 if basis == "quadratic" else m
    distance = x[:, None] - nodes[None, :]
    phase = np.exp(1j * theta * m)
    return weight(basis, n, distance) @ phase, slope(basis, n, distance) @ phase


def step(kind, tau, phi, psi):
    """Matrix of a step for (v, c jbar), with (a, b) = mean of a* b."""
    n = len(phi)
    average = np.outer(phi, phi.conj()) / n
    one = np.eye(n)
    smooth = {"rate": average, "consistent": 2.0 * average - average @ average}.get(kind, one)
    of_force = one if kind != "consistent" else smooth
    push = -tau * (psi.conj() @ of_force) / n
    to_nodes = phi.conj() / n
    matrix = np.zeros((2 * n, 2 * n), complex)
    matrix[:n, :n] = one
    matrix[:n, n:] = np.outer(phi, push)
    matrix[n:, :n] = tau * np.outer(smooth @ psi, to_nodes)
    matrix[n:, n:] = one + tau * np.outer(smooth @ psi, push)
    if kind == "recursive":
        matrix[n:] = average @ matrix[n:]
    return matrix


def largest_cfl(basis, kind, n):
    angles = np.linspace(np.pi / 64, np.pi, 64)

    def stable(tau):
        waves = (wave(basis, n, theta, 0.0) for theta in angles)
        return all(max(abs(np.linalg.eigvals(step(kind, tau, *w)))) < 1.0 + 1e-4 for w in waves)

    low, high = 0.05, 4.0
    while high - low > 1e-4:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stable(middle) else (low, middle)
    return 0.5 * (low + high)


def growth(basis, kind, n, cfl, speed=0.1):
    """Largest Floquet multiplier per crossed cell, of particles that move with `speed` times c."""
    steps = max(1, round(1.0 / (speed * cfl)))
    found = 0.0
    for theta in np.pi * np.arange(1, 9) / 8:
        product = np.eye(2 * n)
        for k in range(steps):
            product = step(kind, cfl, *wave(basis, n, theta, k / steps)) @ product
        found = max(found, max(abs(np.linalg.eigvals(product))))
    return found


def main():
    print("Largest CFL number at rest, n = 1, 2, 3, 5")
    for basis in BASES:
        for kind in KINDS:
            found = [f"{largest_cfl(basis, kind, n):.2f}" for n in (1, 2, 3, 5)]
            print(f"  {basis:10} {kind:11}", ", ".join(found))
    print("Largest growth per crossed cell at U = 0.1 c, n = 1 to 5, CFL 0.3 and 0.05")
    for basis in BASES:
        for kind in KINDS[:3]:
            for cfl in (0.3, 0.05):
                found = [f"{growth(basis, kind, n, cfl):.2f}" for n in range(1, 6)]
                print(f"  {basis:10} {kind:11} CFL {cfl:4}", ", ".join(found))
    print("Growth rate over c/h of rate, n = 2, CFL 0.3, U = 0.02, 0.05, 0.1, 0.2, 0.5 c")
    for basis in BASES:
        speeds = (0.02, 0.05, 0.1, 0.2, 0.5)
        found = [u * np.log(growth(basis, "rate", 2, 0.3, u)) for u in speeds]
        print(f"  {basis:10}", ", ".join(f"{rate:.3f}" for rate in found))


if __name__ == "__main__":
    main()
