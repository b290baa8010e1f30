"""The explicit step of Zhao et al. (2023) in Taichi, for `mpm-verify bench --peers taichi`.

FLIP, forces from the gradients of quadratic B-splines, neo-Hookean law, stress at the end of the step; with --fbar the
recursive F-bar remedy, Eq. (26). The scene is that of the bench's workloads W2 and W3 (`bench/src/workload.rs`).

Two ways to write it: `idiomatic`, with `+=` on the nodes (an atomic, also on one thread) and one field for each quantity;
`tuned`, with plain stores to one grid for each thread and all that belongs to a node side by side.

It reads commands from standard input, one a line, and answers each with one line of JSON:
`steps N` runs N steps and tells wall and processor time; `sums` tells mass, momentum, centre of mass, energies and the
means of J and its average.
"""

import argparse
import itertools
import json
import math
import sys
import time

import numpy as np
import taichi as ti

parser = argparse.ArgumentParser()
parser.add_argument("--dimension", type=int, choices=[2, 3], required=True)
parser.add_argument("--cells", type=int, required=True, help="of the body along each axis")
parser.add_argument("--fbar", action="store_true")
parser.add_argument("--tuned", action="store_true")
parser.add_argument("--threads", type=int, default=1)
args = parser.parse_args()

ti.init(
    arch=ti.cpu,
    default_fp=ti.f64,
    cpu_max_num_threads=args.threads,
    fast_math=True,
    log_level=ti.ERROR,
    offline_cache=False,
)

DIM, FBAR, TUNED = args.dimension, args.fbar, args.tuned
MARGIN = 20
NODES = args.cells + 2 * MARGIN
H = 1.0 / 280.0
N = (2 * args.cells) ** DIM
YOUNG, POISSON, DENSITY = 1e5, 0.3, 1000.0
MU = YOUNG / 2.0 / (1.0 + POISSON)
LAMBDA = YOUNG * POISSON / (1.0 + POISSON) / (1.0 - 2.0 * POISSON)
VOLUME = (0.5 * H) ** DIM
MASS = DENSITY * VOLUME
DT = 0.1 * H / math.sqrt((LAMBDA + 2.0 * MU) / DENSITY)
INVERSE = 1.0 / H

x = ti.Vector.field(DIM, ti.f64, N)
v = ti.Vector.field(DIM, ti.f64, N)
F = ti.Matrix.field(DIM, DIM, ti.f64, N)
J = ti.field(ti.f64, N)
gradient = ti.Matrix.field(DIM, DIM, ti.f64, N if FBAR else 1)
j_bar = ti.field(ti.f64, N if FBAR else 1)
trial = ti.field(ti.f64, N if FBAR else 1)
displacement = ti.Vector.field(DIM, ti.f64, N if FBAR else 1)

# Grids: one for each thread if tuned.
GRIDS = args.threads if TUNED else 1
SHAPE = (GRIDS,) + (NODES,) * DIM
mass = ti.field(ti.f64)
velocity = ti.Vector.field(DIM, ti.f64)
change = ti.Vector.field(DIM, ti.f64)
volume = ti.field(ti.f64)
average = ti.field(ti.f64)
INDEX = {2: ti.ijk, 3: ti.ijkl}[DIM]
if TUNED:
    ti.root.dense(INDEX, SHAPE).place(mass, velocity, change)
    ti.root.dense(INDEX, SHAPE).place(volume, average)
else:
    for field in (mass, velocity, change, volume, average):
        ti.root.dense(INDEX, SHAPE).place(field)
OFFSETS = list(itertools.product(range(3), repeat=DIM))
SHARE = (N + GRIDS - 1) // GRIDS


@ti.func
def add(field: ti.template(), node, value):
    if ti.static(TUNED):
        field[node] = field[node] + value
    else:
        field[node] += value


@ti.func
def stencil(position):
    base = ti.cast(position * INVERSE - 0.5, ti.i32)
    fx = position * INVERSE - ti.cast(base, ti.f64)
    w = [0.5 * (1.5 - fx) ** 2, 0.75 - (fx - 1.0) ** 2, 0.5 * (fx - 0.5) ** 2]
    return base, w, fx


@ti.func
def slopes(fx):
    return [(fx - 1.5) * INVERSE, -2.0 * (fx - 1.0) * INVERSE, (fx - 0.5) * INVERSE]


@ti.func
def place(grid, base, offset: ti.template()):
    return ti.Vector([grid] + [base[d] + offset[d] for d in range(DIM)])


@ti.func
def weight(w, offset: ti.template()):
    product = ti.cast(1.0, ti.f64)
    for d in ti.static(range(DIM)):
        product *= w[offset[d]][d]
    return product


@ti.func
def weight_gradient(w, dw, offset: ti.template()):
    slope = ti.Vector.one(ti.f64, DIM)
    for a in ti.static(range(DIM)):
        for d in ti.static(range(DIM)):
            slope[a] *= dw[offset[d]][d] if ti.static(a == d) else w[offset[d]][d]
    return slope


@ti.func
def particle_to_grid(p, grid):
    base, w, fx = stencil(x[p])
    dw = slopes(fx)
    determinant = F[p].determinant()
    b = F[p] @ F[p].transpose()
    identity = ti.Matrix.identity(ti.f64, DIM)
    kirchhoff = MU * b + identity * (LAMBDA * ti.log(determinant) - MU)
    flux = (-VOLUME * J[p] / determinant) * kirchhoff
    momentum = MASS * v[p]
    for offset in ti.static(OFFSETS):
        node = place(grid, base, offset)
        wp = weight(w, offset)
        add(mass, node, wp * MASS)
        add(velocity, node, wp * momentum)
        add(change, node, flux @ weight_gradient(w, dw, offset))


@ti.kernel
def particles_to_grid():
    if ti.static(TUNED):
        for p in range(N):
            particle_to_grid(p, p // SHARE)
    else:
        for p in range(N):
            particle_to_grid(p, 0)


@ti.kernel
def clear():
    for node in ti.grouped(mass):
        mass[node] = 0.0
        velocity[node] = ti.Vector.zero(ti.f64, DIM)
        change[node] = ti.Vector.zero(ti.f64, DIM)
    if ti.static(FBAR):
        for node in ti.grouped(volume):
            volume[node] = 0.0
            average[node] = 0.0


@ti.kernel
def update_grid():
    for place_ in ti.grouped(ti.ndrange(*SHAPE[1:])):
        node = ti.Vector([0] + [place_[d] for d in range(DIM)])
        m, momentum, force = mass[node], velocity[node], change[node]
        for grid in ti.static(range(1, GRIDS)):
            other = ti.Vector([grid] + [place_[d] for d in range(DIM)])
            m += mass[other]
            momentum += velocity[other]
            force += change[other]
        if m > 0.0:
            change[node] = DT * force / m
            velocity[node] = momentum / m + change[node]


@ti.kernel
def grid_to_particles():
    for p in range(N):
        base, w, fx = stencil(x[p])
        dw = slopes(fx)
        moving = ti.Vector.zero(ti.f64, DIM)
        increment = ti.Vector.zero(ti.f64, DIM)
        L = ti.Matrix.zero(ti.f64, DIM, DIM)
        for offset in ti.static(OFFSETS):
            node = place(0, base, offset)
            wp = weight(w, offset)
            moving += wp * velocity[node]
            increment += wp * change[node]
            L += velocity[node].outer_product(weight_gradient(w, dw, offset))
        v[p] += increment
        delta = ti.Matrix.identity(ti.f64, DIM) + DT * L
        if ti.static(FBAR):
            # Positions and volumes stay those of the step's start until the average is taken.
            gradient[p] = L
            displacement[p] = DT * moving
            trial[p] = j_bar[p] * delta.determinant()
        else:
            F[p] = delta @ F[p]
            J[p] *= delta.determinant()
            x[p] += DT * moving


@ti.func
def average_to_grid(p, grid):
    base, w, _ = stencil(x[p])
    weighted = VOLUME * J[p]
    value = weighted * trial[p]
    for offset in ti.static(OFFSETS):
        node = place(grid, base, offset)
        wp = weight(w, offset)
        add(volume, node, wp * weighted)
        add(average, node, wp * value)


@ti.kernel
def averages_to_grid():
    if ti.static(TUNED):
        for p in range(N):
            average_to_grid(p, p // SHARE)
    else:
        for p in range(N):
            average_to_grid(p, 0)


@ti.kernel
def update_averages():
    for place_ in ti.grouped(ti.ndrange(*SHAPE[1:])):
        node = ti.Vector([0] + [place_[d] for d in range(DIM)])
        total, value = volume[node], average[node]
        for grid in ti.static(range(1, GRIDS)):
            other = ti.Vector([grid] + [place_[d] for d in range(DIM)])
            total += volume[other]
            value += average[other]
        if total > 0.0:
            average[node] = value / total


@ti.kernel
def averages_to_particles():
    for p in range(N):
        base, w, _ = stencil(x[p])
        mean = ti.cast(0.0, ti.f64)
        for offset in ti.static(OFFSETS):
            mean += weight(w, offset) * average[place(0, base, offset)]
        delta = ti.Matrix.identity(ti.f64, DIM) + DT * gradient[p]
        ratio = mean / trial[p]
        stretch = ti.sqrt(ratio) if ti.static(DIM == 2) else ti.pow(ratio, 1.0 / 3.0)
        F[p] = stretch * (delta @ F[p])
        J[p] *= delta.determinant()
        j_bar[p] = mean
        x[p] += displacement[p]


def step():
    clear()
    particles_to_grid()
    update_grid()
    grid_to_particles()
    if FBAR:
        averages_to_grid()
        update_averages()
        averages_to_particles()


def start():
    line = (MARGIN + (np.arange(2 * args.cells) + 0.5) / 2.0) * H
    at = np.stack(np.meshgrid(*[line] * DIM, indexing="ij"), axis=-1).reshape(-1, DIM)
    k = 2.0 * np.pi
    moves = np.empty_like(at)
    moves[:, 0] = 0.3 + np.sin(k * at[:, 0]) * np.cos(k * at[:, 1])
    moves[:, 1] = 0.1 - 0.5 * np.cos(k * at[:, 0]) * np.sin(k * at[:, 1])
    if DIM == 3:
        moves[:, 2] = 0.2 + 0.4 * np.sin(k * at[:, 2]) * np.cos(k * at[:, 0])
    x.from_numpy(at)
    v.from_numpy(moves)
    F.from_numpy(np.tile(np.eye(DIM), (N, 1, 1)))
    J.fill(1.0)
    j_bar.fill(1.0)


def sums():
    at, moves, gradients = x.to_numpy(), v.to_numpy(), F.to_numpy()
    log_j = np.log(np.linalg.det(gradients))
    b = np.einsum("pij,pij->p", gradients, gradients) + (3 - DIM)
    energy = 0.5 * MU * (b - 3.0 - 2.0 * log_j) + 0.5 * LAMBDA * log_j**2
    axes = list(enumerate("xyz"[:DIM]))
    return {
        "mass": MASS * N,
        **{f"momentum_{axis}": MASS * moves[:, a].sum() for a, axis in axes},
        **{f"centre_{axis}": at[:, a].mean() for a, axis in axes},
        "kinetic_energy": 0.5 * MASS * (moves**2).sum(),
        "stored_energy": VOLUME * energy.sum(),
        "mean_jacobian": J.to_numpy().mean(),
        "mean_averaged_jacobian": j_bar.to_numpy().mean() if FBAR else J.to_numpy().mean(),
    }


def main():
    # Compile everything, then begin anew.
    start()
    step()
    ti.sync()
    start()
    print(json.dumps({"ready": f"Taichi {ti.__version__[0]}.{ti.__version__[1]}.{ti.__version__[2]}"}), flush=True)
    for line in sys.stdin:
        command, *rest = line.split()
        if command == "steps":
            wall, processor = time.perf_counter(), time.process_time()
            for _ in range(int(rest[0])):
                step()
            ti.sync()
            answer = {
                "wall_s": time.perf_counter() - wall,
                "cpu_s": time.process_time() - processor,
            }
        elif command == "sums":
            answer = sums()
        else:
            raise SystemExit(f"unknown command {command!r}; allowed: steps N, sums")
        print(json.dumps(answer), flush=True)


main()
