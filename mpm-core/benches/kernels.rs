//! Kernels on one thread: time per particle of P2G, G2P, a sweep of XPIC, the volume average Π and
//! the law.
//!
//! Plane strain, two particles per cell and direction, sorted by cell.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use mpm_core::basis::{CubicBSpline, Gimp, QuadraticBSpline, WallTreatment};
use mpm_core::eights::{Eights, block, blocks, components, store_vectors};
use mpm_core::explicit::Transfer;
use mpm_core::explicit::transfer::{Apic, Flip, Given, Received, Xpic};
use mpm_core::lattice::Stencils;
use mpm_core::material::{HenckyJ2, Law, NeoHookean, Strength, shared};
use mpm_core::nodes::NodalState;
use mpm_core::number::{EIGHT, Eight};
use mpm_core::order::stencil_order;
use mpm_core::projection::{Average, Averaging, Space};
use mpm_core::space::embed;
use mpm_core::{Axis, Basis, Bodies, Grid, Lattice, Particles, SymmetricTensor};
use nalgebra::{Matrix2, SMatrix};
use std::hint::black_box;

const CELLS: usize = 40;

/// A lattice, particles and their slabs.
type Parts<const S: usize, B> = (Lattice<2, S, B>, Particles<2>, Vec<std::ops::Range<usize>>);

fn body<const S: usize, B: Basis<S>>() -> Parts<S, B> {
    let grid = Grid::new(1.0, [Axis::open(0.0, CELLS); 2]);
    let n = 2 * (CELLS - 8);
    let positions = (0..n * n).map(|k| [4.25 + 0.5 * (k / n) as f64, 4.25 + 0.5 * (k % n) as f64]).collect();
    let particles = Particles::new(positions, 0.25, 1.0, [0.25; 2]);
    let (Ok(grid), Ok(mut particles)) = (grid, particles) else { unreachable!("the scene is fixed and valid") };
    let lattice = Lattice::new(grid, WallTreatment::OpenKnot);
    let (order, slabs) = stencil_order(&lattice, &particles.position, &particles.half_size, false);
    particles.permute(&order);
    (lattice, particles, slabs)
}

fn transfers<const S: usize, B: Basis<S>, T: Transfer<2>>(c: &mut Criterion, name: &str, mut transfer: T) {
    let (lattice, mut p, slabs) = body::<S, B>();
    transfer.attach(&mut p);
    let mut nodes = vec![NodalState::default(); lattice.len()];
    let mut group = c.benchmark_group(name);
    group.throughput(Throughput::Elements(p.len() as u64));
    group.bench_function("p2g", |b| {
        b.iter(|| {
            let mut stencils = Stencils::on(&lattice);
            let (x, v) = (Eights::of(&p.position), Eights::of(&p.velocity));
            let (mass, volume) = (Eights::of(&p.mass), Eights::of(&p.volume));
            let mut given = Given::default();
            for k in 0..blocks(p.len()) {
                let (x, mass) = (components(x.at(k)), Eight::new(*mass.at(k)));
                let functions = lattice.functions(&x, &p.half_size);
                lattice.stencils(&functions, &mut stencils);
                let stress = SymmetricTensor::pack(|l| p.stress[k * EIGHT + l]);
                let volume = Eight::new(*volume.at(k));
                given.set(mass, &components(v.at(k)), volume, &stress, None);
                let affine = (!p.affine.is_empty()).then(|| Eights::of(&p.affine));
                let affine = affine.as_ref().map(|affine| affine.at(k));
                let gives = transfer.give(&lattice, &functions, &x, mass, affine);
                for l in 0..EIGHT {
                    transfer.particle_to_grid(stencils.at(l), &given, &gives, &mut nodes, 0);
                }
            }
        });
    });
    group.bench_function("prepare", |b| {
        b.iter(|| black_box(transfer.prepare(&lattice, &p, std::slice::from_ref(&slabs), &nodes, &[])));
    });
    let mut velocity = p.velocity.clone();
    let mut affine = (!p.affine.is_empty()).then_some([SMatrix::zeros(); EIGHT]);
    group.bench_function("g2p", |b| {
        b.iter(|| {
            let mut stencils = Stencils::on(&lattice);
            let (mut received, mut receives) = (Received::default(), T::Receives::default());
            let x = Eights::of(&p.position);
            for k in 0..blocks(p.len()) {
                let x = components(x.at(k));
                let functions = lattice.functions(&x, &p.half_size);
                lattice.stencils(&functions, &mut stencils);
                let gives = transfer.give(&lattice, &functions, &x, Eight::ZERO, None);
                for l in 0..EIGHT {
                    let stencil = stencils.at(l);
                    transfer.grid_to_particle(stencil, &gives, &nodes, &mut received, &mut receives);
                }
                let mut v = components(block(&velocity, k, &mut None));
                black_box(transfer.receive(&received, &receives, &mut v, &mut affine));
                store_vectors(&mut velocity, k, &v);
            }
        });
    });
    group.finish();
}

fn passes<const S: usize, B: Basis<S>>(c: &mut Criterion, name: &str) {
    let (lattice, p, slabs) = body::<S, B>();
    let mut group = c.benchmark_group(name);
    group.throughput(Throughput::Elements(p.len() as u64));
    group.bench_function("stencil", |b| {
        b.iter(|| {
            for k in 0..p.len() {
                black_box(lattice.stencil(&p.position[k], &p.half_size).row(0, S - 1));
            }
        });
    });
    let mut field = vec![1.0; p.len()];
    let mut averaging = Averaging::new(lattice);
    averaging.find_reach(&p, &slabs);
    let mut average = |again: bool| {
        if !again {
            averaging.expire();
        }
        averaging.average(&p, &mut field);
    };
    group.bench_function("first average of a step", |b| {
        b.iter(|| average(false));
    });
    group.bench_function("further average", |b| {
        b.iter(|| average(true));
    });
    group.finish();
}

fn law<M: Law + Copy + 'static>(c: &mut Criterion, name: &str, law: &M, delta_f: &Matrix2<f64>) {
    let n = 4096;
    let mut states = vec![law.initial_state(); n];
    let mut group = c.benchmark_group("law");
    group.throughput(Throughput::Elements(n as u64));
    group.bench_function(name, |b| {
        b.iter(|| {
            for state in &mut states {
                let (stress, next) = law.response(&embed(black_box(delta_f)), 1e-3, state);
                black_box(stress);
                *state = next;
            }
        });
    });
    let particles = Particles::new(vec![[0.0; 2]; n], 1.0, 1.0, [0.5; 2]);
    if let Ok(mut body) = particles.and_then(|particles| Bodies::new(shared(*law), particles)) {
        body.particles.delta_f.fill(*delta_f);
        group.bench_function(format!("{name}, side by side"), |b| b.iter(|| body.update_stress(1e-3)));
    }
    group.finish();
}

fn laws(c: &mut Criterion) {
    let solid = NeoHookean { lambda: 1e4, mu: 20.0 };
    law(c, "neo-hookean", &solid, &Matrix2::new(1.0, 1e-6, -1e-6, 1.0));
    let strengths = [
        ("hencky-j2 elastic", Strength::perfect(1e9)),
        ("hencky-j2 perfect", Strength::undrained(100.0)),
        ("hencky-j2 softening", Strength::softening(40.82e3, 2.45e3, 5.0)),
    ];
    for (name, strength) in strengths {
        if let Ok(strength) = strength
            && let Ok(soil) = HenckyJ2::new(1e6, 0.49, strength)
        {
            // Small enough that elastic strains stay small; once yielding, every step flows.
            let shear = if name.ends_with("elastic") { 1e-9 } else { 1e-5 };
            law(c, name, &soil, &Matrix2::new(1.0, shear, 0.0, 1.0));
        }
    }
}

fn kernels(c: &mut Criterion) {
    transfers::<3, Gimp, _>(c, "gimp", Flip::default());
    transfers::<3, QuadraticBSpline, _>(c, "bspline2", Flip::default());
    transfers::<4, CubicBSpline, _>(c, "bspline3", Flip::default());
    transfers::<3, QuadraticBSpline, _>(c, "bspline2-apic", Apic);
    if let Ok(xpic) = Xpic::new(2) {
        transfers::<3, QuadraticBSpline, _>(c, "bspline2-xpic2", xpic);
    }
    passes::<3, Gimp>(c, "gimp");
    passes::<3, QuadraticBSpline>(c, "bspline2");
    passes::<4, CubicBSpline>(c, "bspline3");
    laws(c);
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(std::time::Duration::from_millis(300))
        .measurement_time(std::time::Duration::from_secs(1));
    targets = kernels
}
criterion_main!(benches);
