//! Maps of the transfers to the grid and back, each alone.

use mpm_core::basis::{CubicBSpline, Gimp, Linear, QuadraticBSpline, WallTreatment};
use mpm_core::explicit::transfer::*;
use mpm_core::grid::{Axis, Grid, Side};
use mpm_core::lattice::{Lattice, Stencils};
use mpm_core::nodes::NodalState;
use mpm_core::nodes::Node;
use mpm_core::number::Lanes;
use mpm_core::number::{EIGHT, Eight};
use mpm_core::order::{Slabs, stencil_order};
use mpm_core::parallel::scatter;
use mpm_core::stage::{Bound, Prescribed};
use mpm_core::tensor::SymmetricTensor;
use mpm_core::{Basis, Particles};
use nalgebra::SMatrix;
use proptest::prelude::*;
use std::f64::consts::PI;

mod musl;

/// Tolerance of sums of a few dozen products of order one.
const ROUNDING: f64 = 1e-11;
const H: f64 = 0.5;

/// The same vector eight times.
fn eight_times<const D: usize>(vector: &[f64; D]) -> [Eight; D] {
    vector.map(Eight::splat)
}

/// One particle's share of a transfer back: its new velocity and moment; and the velocity that moves it.
fn receive<const D: usize, const S: usize, B: Basis<S>, T: Transfer<D>>(
    transfer: &T,
    lattice: &Lattice<D, S, B>,
    x: &[f64; D],
    half_size: &[f64; D],
    nodes: &[NodalState],
    velocity: &mut [f64; D],
    affine: Option<&mut SMatrix<f64, D, D>>,
) -> [f64; D] {
    let x = eight_times(x);
    let functions = lattice.functions(&x, half_size);
    let mut stencils = Stencils::on(lattice);
    lattice.stencils(&functions, &mut stencils);
    let gives = transfer.give(lattice, &functions, &x, Eight::ZERO, None);
    let (mut received, mut receives) = (Received::default(), T::Receives::default());
    for l in 0..EIGHT {
        transfer.grid_to_particle(stencils.at(l), &gives, nodes, &mut received, &mut receives);
    }
    let mut v = eight_times(velocity);
    let mut b = affine.as_ref().map(|affine| [**affine; EIGHT]);
    let moving = transfer.receive(&received, &receives, &mut v, &mut b);
    *velocity = v.map(|v| v.part(5));
    if let (Some(affine), Some(b)) = (affine, b) {
        *affine = b[5];
    }
    moving.map(|v| v.part(5))
}

/// A transfer on its own: to the grid and back with no forces and nothing moving.
struct Frozen<const D: usize, const S: usize, B> {
    lattice: Lattice<D, S, B>,
    particles: Particles<D>,
    slabs: Slabs,
    nodes: Vec<NodalState>,
}

impl<const D: usize, const S: usize, B: Basis<S>> Frozen<D, S, B> {
    fn new(grid: Grid<D>, wall: WallTreatment, positions: Vec<[f64; D]>) -> Self {
        let mut particles = Particles::new(positions, 0.1, 1.0, [0.25 * H; D]).unwrap();
        let lattice = Lattice::new(grid, wall);
        let (order, slabs) = stencil_order(&lattice, &particles.position, &particles.half_size, false);
        particles.permute(&order);
        Self { nodes: vec![NodalState::default(); lattice.len()], lattice, particles, slabs }
    }

    /// Particles at the given shares of the axes' lengths, with masses between ½ and 1.5.
    fn scattered(wall: WallTreatment, shares: &[[f64; 3]]) -> Self {
        let mut axes = [Axis::bounded(-1.0, 5, (Side::Wall, Side::Open)); D];
        axes[D - 1] = Axis::walls(0.5, 4);
        let grid = Grid::new(H, axes).unwrap();
        let positions =
            shares.iter().map(|s| std::array::from_fn(|a| axes[a].lo + s[a] * (axes[a].hi(H) - axes[a].lo))).collect();
        let mut frozen = Self::new(grid, wall, positions);
        for (m, s) in frozen.particles.mass.iter_mut().zip(shares) {
            *m = 0.5 + s[0];
        }
        frozen
    }

    fn transfer<T: Transfer<D>>(&mut self, transfer: &mut T) {
        transfer.attach(&mut self.particles);
        let (lattice, p) = (&self.lattice, &self.particles);
        self.nodes.fill(NodalState::default());
        scatter(&mut self.nodes, lattice.plane(), &self.slabs, |slab, nodes, origin| {
            for k in slab {
                let x = eight_times(&p.position[k]);
                let functions = lattice.functions(&x, &p.half_size);
                let mut stencils = Stencils::on(lattice);
                lattice.stencils(&functions, &mut stencils);
                let (mass, volume) = (Eight::splat(p.mass[k]), Eight::splat(p.volume[k]));
                let mut given = Given::default();
                let stress = SymmetricTensor::pack(|_| p.stress[k]);
                given.set(mass, &eight_times(&p.velocity[k]), volume, &stress, None);
                let affine = p.affine.get(k).map(|affine| [*affine; EIGHT]);
                let gives = transfer.give(lattice, &functions, &x, mass, affine.as_ref());
                transfer.particle_to_grid(stencils.at(3), &given, &gives, nodes, origin);
            }
        });
        lattice.fold(&mut self.nodes);
        for node in &mut self.nodes {
            let mass = node.mass();
            if mass > 0.0 {
                node.motion *= Node::from([1.0 / mass, 1.0 / mass, 1.0 / mass, 1.0]);
            }
        }
        lattice.unfold(&mut self.nodes);
        transfer.prepare(lattice, p, std::slice::from_ref(&self.slabs), &self.nodes, &[]);
        let p = &mut self.particles;
        for k in 0..p.position.len() {
            let (v, b) = (&mut p.velocity[k], p.affine.get_mut(k));
            receive(transfer, lattice, &p.position[k], &p.half_size, &self.nodes, v, b);
        }
    }

    /// The diagonal of D of a particle.
    fn spread_of(&self, k: usize) -> [f64; D] {
        let x = eight_times(&self.particles.position[k]);
        let functions = self.lattice.functions(&x, &self.particles.half_size);
        let arms = self.lattice.arms(&functions, &x);
        second_moment(&functions, &arms).map(|moment| moment.part(0))
    }

    /// Σ ½ m B D⁻¹ : B.
    fn affine_energy(&self) -> f64 {
        let p = &self.particles;
        let energy = |(k, b): (usize, &SMatrix<f64, D, D>)| {
            let d = self.spread_of(k);
            let square = |a| b.column(a).norm_squared();
            let axes = (0..D).filter(|a| d[*a] > 1e-12 * H * H);
            0.5 * p.mass[k] * axes.map(|a| square(a) / d[a]).sum::<f64>()
        };
        p.affine.iter().enumerate().map(energy).sum()
    }

    fn nodal_energy(&self) -> f64 {
        self.nodes.iter().map(NodalState::kinetic_energy).sum()
    }

    /// Σ m v and the components of Σ m (x × v + ε:B), as an antisymmetric matrix.
    fn momenta(&self) -> ([f64; D], SMatrix<f64, D, D>) {
        let p = &self.particles;
        let mut linear = [0.0; D];
        let mut angular = SMatrix::zeros();
        for k in 0..p.len() {
            let affine = p.affine.get(k);
            for a in 0..D {
                linear[a] += p.mass[k] * p.velocity[k][a];
                for b in 0..D {
                    let orbit = p.position[k][a] * p.velocity[k][b] - p.position[k][b] * p.velocity[k][a];
                    let spin = affine.map_or(0.0, |m| m[(b, a)] - m[(a, b)]);
                    angular[(a, b)] += p.mass[k] * (orbit + spin);
                }
            }
        }
        (linear, angular)
    }
}

fn walls() -> impl Strategy<Value = WallTreatment> {
    prop_oneof![Just(WallTreatment::OpenKnot), Just(WallTreatment::WallLine)]
}

/// Shares of axes, ends, nodes and middles of cells among them.
fn clouds() -> impl Strategy<Value = Vec<[f64; 3]>> {
    let place = prop_oneof![
        4 => 0.0..=1.0_f64, 1 => Just(0.0), 1 => Just(1.0), 1 => Just(0.25), 1 => Just(0.5)
    ];
    prop::collection::vec(prop::array::uniform3(place), 1..60)
}

fn affine_field_survives<const D: usize, const S: usize, B: Basis<S>>(
    wall: WallTreatment,
    shares: &[[f64; 3]],
    numbers: &[f64; 12],
) {
    let mut frozen = Frozen::<D, S, B>::scattered(wall, shares);
    let gradient = SMatrix::<f64, D, D>::from_fn(|a, b| numbers[3 * a + b]);
    let field = |x: &[f64; D]| -> [f64; D] {
        std::array::from_fn(|a| numbers[9 + a] + (0..D).map(|b| gradient[(a, b)] * x[b]).sum::<f64>())
    };
    let moments: Vec<SMatrix<f64, D, D>> = (0..shares.len())
        .map(|k| {
            let d = frozen.spread_of(k);
            SMatrix::from_fn(|a, b| gradient[(a, b)] * d[b])
        })
        .collect();
    let p = &mut frozen.particles;
    p.velocity = p.position.iter().map(field).collect();
    p.affine = moments.clone();
    let exact = p.velocity.clone();
    for _ in 0..3 {
        frozen.transfer(&mut Apic);
    }
    for k in 0..shares.len() {
        let (v, b) = (frozen.particles.velocity[k], frozen.particles.affine[k]);
        let exact = exact[k];
        for a in 0..D {
            assert!((v[a] - exact[a]).abs() < ROUNDING, "{v:?} {exact:?}");
        }
        assert!((b - moments[k]).norm() < ROUNDING, "{b} {}", moments[k]);
    }
}

/// Any velocities and moments B = C D, decided by the shares.
fn stir<const D: usize, const S: usize, B: Basis<S>>(frozen: &mut Frozen<D, S, B>, shares: &[[f64; 3]]) {
    for (k, s) in shares.iter().enumerate() {
        let d = frozen.spread_of(k);
        let p = &mut frozen.particles;
        p.velocity[k] = std::array::from_fn(|a| (9.0 * s[a] + 40.0 * s[2 - a]).sin());
        p.affine.push(SMatrix::from_fn(|a, b| d[b] * (7.0 * s[a] - 30.0 * s[b] + a as f64).cos()));
    }
}

fn transfers_conserve<const D: usize, const S: usize, B: Basis<S>>(wall: WallTreatment, shares: &[[f64; 3]]) {
    let scale = shares.len() as f64;
    // APIC: linear and angular momentum to the grid and back; total energy falls on either way.
    let mut frozen = Frozen::<D, S, B>::scattered(wall, shares);
    stir(&mut frozen, shares);
    let (linear, angular) = frozen.momenta();
    let energy = frozen.particles.kinetic_energy() + frozen.affine_energy();
    frozen.transfer(&mut Apic);
    let (linear_after, angular_after) = frozen.momenta();
    for a in 0..D {
        assert!((linear[a] - linear_after[a]).abs() < ROUNDING * scale);
    }
    assert!((angular - angular_after).norm() < ROUNDING * scale);
    let after = frozen.particles.kinetic_energy() + frozen.affine_energy();
    let nodal = frozen.nodal_energy();
    assert!(nodal <= energy * (1.0 + ROUNDING), "{nodal} of {energy}");
    assert!(after <= nodal * (1.0 + ROUNDING), "{after} of {nodal}");

    // From velocities alone: PIC ≤ XPIC(2) ≤ … ≤ FLIP, which changes nothing, and PIC ≤ APIC with its
    // affine part ≤ the nodes' energy.
    let after = |transfer: &mut dyn FnMut(&mut Frozen<D, S, B>)| {
        let mut frozen = Frozen::<D, S, B>::scattered(wall, shares);
        stir(&mut frozen, shares);
        frozen.particles.affine.clear();
        let (linear, _) = frozen.momenta();
        transfer(&mut frozen);
        for (p, q) in linear.iter().zip(frozen.momenta().0) {
            assert!((p - q).abs() < ROUNDING * scale, "momentum");
        }
        (frozen.particles.kinetic_energy() + frozen.affine_energy(), frozen.nodal_energy())
    };
    let (flip, nodal) = after(&mut |f| f.transfer(&mut Flip::default()));
    let (pic, _) = after(&mut |f| f.transfer(&mut Flip::new(0.0).unwrap()));
    let (apic, _) = after(&mut |f| f.transfer(&mut Apic));
    let mut least = pic - ROUNDING * scale;
    for order in 1..=5 {
        let (xpic, _) = after(&mut |f| f.transfer(&mut Xpic::new(order).unwrap()));
        assert!(xpic >= least, "{order}: {xpic} after {least}");
        least = xpic - ROUNDING * scale;
        assert!(order > 1 || (xpic - pic).abs() < ROUNDING * scale, "PIC");
    }
    assert!(least <= flip);
    assert!(pic <= apic + ROUNDING * scale && apic <= nodal + ROUNDING * scale);
    assert!(nodal <= flip + ROUNDING * scale);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn affine_fields_survive_apic_everywhere(
        wall in walls(), shares in clouds(), numbers in prop::array::uniform12(-1.0..1.0_f64)
    ) {
        affine_field_survives::<1, 2, Linear>(wall, &shares, &numbers);
        affine_field_survives::<1, 4, CubicBSpline>(wall, &shares, &numbers);
        affine_field_survives::<2, 2, Linear>(wall, &shares, &numbers);
        affine_field_survives::<2, 3, Gimp>(wall, &shares, &numbers);
        affine_field_survives::<2, 3, QuadraticBSpline>(wall, &shares, &numbers);
        affine_field_survives::<2, 4, CubicBSpline>(wall, &shares, &numbers);
        affine_field_survives::<3, 2, Linear>(wall, &shares, &numbers);
        affine_field_survives::<3, 3, Gimp>(wall, &shares, &numbers);
        affine_field_survives::<3, 3, QuadraticBSpline>(wall, &shares, &numbers);
        affine_field_survives::<3, 4, CubicBSpline>(wall, &shares, &numbers);
    }

    #[test]
    fn momenta_are_conserved_and_energies_ordered(wall in walls(), shares in clouds()) {
        transfers_conserve::<1, 3, QuadraticBSpline>(wall, &shares);
        transfers_conserve::<2, 2, Linear>(wall, &shares);
        transfers_conserve::<2, 3, Gimp>(wall, &shares);
        transfers_conserve::<2, 3, QuadraticBSpline>(wall, &shares);
        transfers_conserve::<3, 4, CubicBSpline>(wall, &shares);
    }
}

#[test]
fn the_second_moment_is_that_of_the_textbook_away_from_walls_alone() {
    let at = |wall, x: f64| {
        let grid = Grid::new(H, [Axis::walls(0.0, 8)]).unwrap();
        let quadratic = Frozen::<1, 3, QuadraticBSpline>::new(grid, wall, vec![[x]]);
        let cubic = Frozen::<1, 4, CubicBSpline>::new(grid, wall, vec![[x]]);
        [quadratic.spread_of(0)[0], cubic.spread_of(0)[0]].map(|d| d / (H * H))
    };
    for wall in [WallTreatment::OpenKnot, WallTreatment::WallLine] {
        for x in [1.5, 1.7, 2.0, 2.3] {
            let [quadratic, cubic] = at(wall, x);
            assert!((quadratic - 0.25).abs() < ROUNDING && (cubic - 1.0 / 3.0).abs() < ROUNDING);
        }
    }
    // Where the first function interpolates there is one node, and D = 0.
    assert_eq!(at(WallTreatment::OpenKnot, 0.0), [0.0; 2]);
    assert!(at(WallTreatment::OpenKnot, 0.1).iter().all(|d| *d < 0.2));
    assert!((at(WallTreatment::WallLine, 0.1)[0] - 0.25).abs() < ROUNDING);
}

/// On a periodic lattice with `n` equally spaced particles per cell, S S⁺ multiplies the particle field
/// S e^{ikj} by λ; the particle field after one transfer, over that before.
fn factor<const S: usize, B: Basis<S>>(n: usize, k: f64, transfer: &mut impl Transfer<1>) -> f64 {
    let cells = 12;
    let grid = Grid::new(H, [Axis::periodic(0.0, cells)]).unwrap();
    let spacing = H / n as f64;
    let positions = (0..cells * n).map(|p| [(p as f64 + 0.5) * spacing]).collect();
    let mut frozen = Frozen::<1, S, B>::new(grid, WallTreatment::OpenKnot, positions);
    let mut wave = vec![0.0; frozen.lattice.len()];
    let lattice = &frozen.lattice;
    lattice.for_each_node(|node, index| wave[node] = (k * lattice.position(index)[0] / H).cos());
    for p in 0..cells * n {
        let particles = &mut frozen.particles;
        let stencil = lattice.stencil(&particles.position[p], &particles.half_size);
        let begin = stencil.first();
        let sum = wave[begin..begin + S].iter().zip(stencil.last().w);
        particles.velocity[p] = [sum.map(|(u, w)| u * w).sum()];
    }
    let before = frozen.particles.velocity.clone();
    frozen.transfer(transfer);
    let after = &frozen.particles.velocity;
    let product = |a: &[[f64; 1]], b: &[[f64; 1]]| -> f64 { a.iter().zip(b).map(|(a, b)| a[0] * b[0]).sum() };
    let factor = product(after, &before) / product(&before, &before);
    for (a, b) in after.iter().zip(&before) {
        assert!((a[0] - factor * b[0]).abs() < ROUNDING, "not a mode");
    }
    factor
}

#[test]
fn xpic_reduces_a_mode_of_a_lattice_as_the_closed_form_says() {
    for waves in 0..6 {
        let k = 2.0 * PI * f64::from(waves) / 12.0;
        for order in 1..=5 {
            let close = |factor: f64, lambda: f64| {
                let exact = 1.0 - (1.0 - lambda).powi(order);
                assert!((factor - exact).abs() < ROUNDING, "{factor} {exact}");
            };
            let xpic = &mut Xpic::new(order as u32).unwrap();
            // Hats: neighbours share the mean of t (1 − t), which is 1/6 + 1/(12 n²).
            for n in [1, 2, 3] {
                let n2 = (n * n) as f64;
                let lambda = 1.0 - (1.0 / 3.0 + 1.0 / (6.0 * n2)) * (1.0 - k.cos());
                close(factor::<2, Linear>(n, k, xpic), lambda);
            }
            // GIMP particles of two per cell lie within a cell, where they see hats.
            let lambda = 1.0 - (1.0 / 3.0 + 1.0 / 24.0) * (1.0 - k.cos());
            close(factor::<3, Gimp>(2, k, xpic), lambda);
            // Splines, one particle in the middle of each cell: λ = |Σ_d w_d e^{ikd}|².
            let quadratic = (0.75 + 0.25 * k.cos()).powi(2);
            close(factor::<3, QuadraticBSpline>(1, k, xpic), quadratic);
            let cubic = (23.0 * (0.5 * k).cos() + (1.5 * k).cos()).powi(2) / 576.0;
            close(factor::<4, CubicBSpline>(1, k, xpic), cubic);
        }
        let flip = factor::<2, Linear>(2, k, &mut Flip::default());
        assert!((flip - 1.0).abs() < ROUNDING);
    }
}

#[test]
fn what_no_node_sees_flip_keeps_and_every_other_transfer_removes() {
    // Hats with two particles per cell: opposite velocities in every cell have no momentum at any node.
    let after = |transfer: &mut dyn FnMut(&mut Frozen<1, 2, Linear>)| {
        let grid = Grid::new(H, [Axis::periodic(0.0, 8)]).unwrap();
        let positions = (0..16).map(|p| [(f64::from(p) + 0.5) * 0.5 * H]).collect();
        let mut frozen = Frozen::new(grid, WallTreatment::OpenKnot, positions);
        for (p, v) in frozen.particles.velocity.iter_mut().enumerate() {
            v[0] = if p % 2 == 0 { 1.0 } else { -1.0 };
        }
        transfer(&mut frozen);
        let speeds = frozen.particles.velocity.iter().map(|v| v[0].abs());
        speeds.fold(0.0, f64::max)
    };
    assert!((after(&mut |f| f.transfer(&mut Flip::default())) - 1.0).abs() < ROUNDING);
    assert!(after(&mut |f| f.transfer(&mut Apic)) < ROUNDING);
    for order in 1..=5 {
        assert!(after(&mut |f| f.transfer(&mut Xpic::new(order).unwrap())) < ROUNDING);
    }
}

#[test]
fn xpic_moves_a_particle_with_the_mean_of_its_velocities_and_not_through_a_wall() {
    let grid = Grid::new(H, [Axis::walls(0.0, 8)]).unwrap();
    let mut frozen = Frozen::<1, 3, QuadraticBSpline>::new(grid, WallTreatment::OpenKnot, vec![[0.0]]);
    frozen.particles.velocity[0] = [-1.0];
    let lattice = &frozen.lattice;
    let stencil = lattice.stencil(&[0.0], &[0.25 * H]);
    let wall = stencil.first();
    // The node on the wall as mapped, −1, then held: velocity 0, change 1.
    frozen.nodes[wall].motion = Node::from([0.0, 0.0, 0.0, 0.1]);
    frozen.nodes[wall].change = Node::from([1.0, 0.0, 0.0, 0.0]);
    let held = [Prescribed {
        node: wall,
        axis: 0,
        velocity: 0.0,
        full_velocity: 0.0,
        bound: Bound::Equal,
        friction: 0.0,
        force: 0.0,
        by: 0,
    }];
    let mut xpic = Xpic::new(1).unwrap();
    let (particles, slabs, nodes) = (&frozen.particles, &frozen.slabs, &frozen.nodes);
    assert_eq!(xpic.prepare(lattice, particles, std::slice::from_ref(slabs), nodes, &held), 0);
    let mut v = [-1.0];
    let half_size = &frozen.particles.half_size;
    let moving = receive(&xpic, lattice, &[0.0], half_size, nodes, &mut v, None);
    assert_eq!(v, [0.0]);
    // S v = 0, as held, and half the change of the particle's velocity.
    assert_eq!(moving, [0.5]);
}
