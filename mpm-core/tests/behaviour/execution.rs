//! Threads, the order of the particles, allocation and counters.

use crate::scenes::{block, open_grid, remedies, scene, scene_with, swirl, with_threads};
use mpm_core::basis::{CubicBSpline, Gimp, Linear, QuadraticBSpline};
use mpm_core::explicit::remedy::{Fbar, Form, Onto};
use mpm_core::explicit::transfer::{Apic, Flip, Musl, Xpic};
use mpm_core::explicit::{Solver, Transfer};
use mpm_core::stage::{BodyForce, End, LocalDamping, Wall, WallKind};
use mpm_core::{Axis, Basis, Grid, Side, Simulation};

fn bits<const D: usize, const S: usize, B: Basis<S> + 'static>(threads: usize) -> Vec<u64> {
    bits_of::<D, S, B, _>(threads, Flip::default(), Onto::Basis)
}

fn bits_of<const D: usize, const S: usize, B: Basis<S> + 'static, T: Transfer<D>>(
    threads: usize,
    transfer: T,
    onto: Onto,
) -> Vec<u64> {
    with_threads(threads, || {
        let mut lo = [4; D];
        let mut hi = [8; D];
        lo[0] = 2;
        hi[0] = 40;
        let mut particles = block(0.5, 2, lo, hi);
        swirl(&mut particles, 0.5);
        for v in &mut particles.velocity {
            v[0] += 2.0;
        }
        let mut axes = [Axis::open(0.0, 12); D];
        axes[0] = Axis::periodic(0.0, 48);
        let (scene, mut settings) = scene_with(Grid::new(0.5, axes).unwrap(), particles, transfer);
        settings.remedy = Box::new(Fbar::new(Form::Bbar).onto(onto));
        let mut solver = Solver::<D, S, B, T>::new(scene, settings).unwrap();
        solver.advance(60).unwrap();
        assert!(solver.work().sorts > 1, "the test must cover sorting");
        let p = solver.particles();
        let t = solver.totals();
        let moved = p.position.iter().flatten().chain(p.velocity.iter().flatten());
        let columns = moved.chain(p.affine.iter().flatten());
        let stress = p.stress.iter().map(|s| s.xx.to_bits());
        let sums = [t.kinetic_energy, t.accumulated.stress_work, solver.residual().free_force];
        columns.map(|v| v.to_bits()).chain(stress).chain(sums.map(f64::to_bits)).collect()
    })
}

#[test]
fn results_are_bitwise_the_same_for_any_number_of_threads() {
    let one = bits::<2, 3, Gimp>(1);
    for threads in [2, 3, 7] {
        assert_eq!(one, bits::<2, 3, Gimp>(threads), "{threads} threads");
    }
    assert_eq!(bits::<2, 4, CubicBSpline>(1), bits::<2, 4, CubicBSpline>(4));
    assert_eq!(bits::<3, 3, QuadraticBSpline>(1), bits::<3, 3, QuadraticBSpline>(4));
    assert_eq!(bits::<1, 2, Linear>(1), bits::<1, 2, Linear>(4));
    let apic = |threads| bits_of::<2, 3, QuadraticBSpline, _>(threads, Apic, Onto::Hats);
    assert_eq!(apic(1), apic(4));
    let xpic = |threads| bits_of::<2, 3, Gimp, _>(threads, Xpic::new(3).unwrap(), Onto::Cells);
    assert_eq!(xpic(1), xpic(4));
    let musl = |threads| bits_of::<2, 2, Linear, _>(threads, Musl::default(), Onto::Cells);
    assert_eq!(musl(1), musl(4));
}

#[test]
fn the_order_of_the_particles_changes_rounding_only() {
    let run = |reverse: bool| {
        let mut particles = block(0.5, 2, [4, 4], [8, 8]);
        swirl(&mut particles, 0.3);
        if reverse {
            let order: Vec<u32> = (0..particles.len() as u32).rev().collect();
            particles.permute(&order);
        }
        let (scene, settings) = scene(open_grid::<2>(0.5, 12), particles);
        let mut solver = Solver::<2, 3, Gimp>::new(scene, settings).unwrap();
        solver.advance(40).unwrap();
        let p = solver.particles();
        p.seeded(|k| p.position[k])
    };
    for (a, b) in run(false).iter().zip(run(true)) {
        assert!((a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12);
    }
}

#[test]
fn a_step_allocates_nothing_but_to_sort() {
    with_threads(1, || {
        allocates_nothing::<2, 3, Gimp, _>(&Flip::default());
        allocates_nothing::<2, 3, Gimp, _>(&Apic);
        allocates_nothing::<2, 3, Gimp, _>(&Xpic::new(3).unwrap());
        allocates_nothing::<2, 2, Linear, _>(&Musl::default());
        allocates_nothing::<3, 3, QuadraticBSpline, _>(&Flip::default());
    });
}

/// A moving body allocates nothing, beyond steps that sort its particles and give back what they take.
fn allocates_nothing<const D: usize, const S: usize, B, T>(transfer: &T)
where
    B: Basis<S> + 'static,
    T: Transfer<D> + Clone,
{
    for remedy in remedies::<D>() {
        let mut particles = block(0.5, 2, [4; D], [8; D]);
        swirl(&mut particles, 0.01);
        for v in &mut particles.velocity {
            v[0] += 2.0;
        }
        let mut axes = [Axis::open(0.0, 12); D];
        axes[0] = Axis::bounded(0.0, 48, (Side::Wall, Side::Open));
        let grid = Grid::new(0.5, axes).unwrap();
        let (mut scene, mut settings) = scene_with(grid, particles, transfer.clone());
        settings.remedy = remedy;
        scene = scene.constrain(Wall::new(0, End::Lo, WallKind::Roller));
        scene.loads.push(Box::new(BodyForce(Box::new(|_, _| [1e-3; D]))));
        settings.force_filters.push(Box::new(LocalDamping::new(0.1).unwrap()));
        let mut solver = Solver::<D, S, B, T>::new(scene, settings).unwrap();
        solver.step().unwrap();
        let sorts = solver.work().sorts;
        for _ in 0..60 {
            let before = solver.work().sorts;
            let info = allocation_counter::measure(|| solver.step().unwrap());
            if solver.work().sorts == before {
                assert_eq!(info.count_total, 0);
            }
            assert_eq!(info.count_current, 0);
        }
        assert!(solver.work().sorts > sorts, "the test must cover sorting");
    }
}

#[test]
fn work_is_counted_exactly() {
    let (scene, mut settings) = scene(open_grid::<2>(0.5, 12), block(0.5, 2, [4, 4], [8, 8]));
    settings.remedy = Box::new(Fbar::new(Form::Rate));
    let mut solver = Solver::<2, 3, Gimp>::new(scene, settings).unwrap();
    solver.advance(10).unwrap();
    let w = solver.work();
    assert_eq!((w.particles, w.steps, w.particle_steps), (64, 10, 640));
    assert_eq!((w.projections, w.sorts), (10, 1));
    // Two transfers and two halves of Π, nine nodes each.
    assert_eq!(w.particle_node_pairs, 640 * 9 * 4);

    // XPIC(3) goes twice more to the particles and back.
    let particles = block(0.5, 2, [4, 4], [8, 8]);
    let (scene, settings) = scene_with(open_grid::<2>(0.5, 12), particles, Xpic::new(3).unwrap());
    let mut solver = Solver::<2, 3, Gimp, Xpic>::new(scene, settings).unwrap();
    solver.step().unwrap();
    assert_eq!(solver.work().particle_node_pairs, 64 * 9 * (2 + 4));
}
