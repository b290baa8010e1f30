//! Strains of MUSL.

use super::*;

/// A number in (−1, 1), the same every time.
fn noise(k: usize) -> f64 {
    (12.9898 * k as f64 + 1.0).sin()
}

/// Values gathered by eight copies of a particle at `x` (m).
fn gathered<const D: usize, const S: usize, B: Basis<S>, T: Transfer<D>>(
    transfer: &T,
    frozen: &Frozen<D, S, B>,
    nodes: &[NodalState],
    x: &[f64; D],
) -> Received<D> {
    let (lattice, half_size) = (&frozen.lattice, &frozen.particles.half_size);
    let functions = lattice.functions(&eight_times(x), half_size);
    let mut stencils = Stencils::on(lattice);
    lattice.stencils(&functions, &mut stencils);
    let gives = transfer.give(lattice, &functions, &eight_times(x), Eight::ZERO, None);
    let (mut received, mut receives) = (Received::default(), T::Receives::default());
    for l in 0..EIGHT {
        transfer.grid_to_particle(stencils.at(l), &gives, nodes, &mut received, &mut receives);
    }
    received
}

/// Velocities and places are FLIP's, and gradients those of the velocities that the particles then have, mapped to the
/// nodes as P2G does.
fn strains_are_of_the_new_velocities<const D: usize, const S: usize, B: Basis<S>>(
    wall: WallTreatment,
    shares: &[[f64; 3]],
) {
    let mut frozen = Frozen::<D, S, B>::scattered(wall, shares);
    for (k, v) in frozen.particles.velocity.iter_mut().enumerate() {
        *v = std::array::from_fn(|a| noise(D * k + a));
    }
    frozen.transfer(&mut Flip::default());
    let mut nodes = frozen.nodes.clone();
    for (k, node) in nodes.iter_mut().enumerate() {
        if node.mass() > 0.0 {
            let change = std::array::from_fn(|a| if a < D { noise(k + 7 * a) } else { 0.0 });
            node.change = Node::from(change);
            node.motion += node.change;
        }
    }
    frozen.lattice.unfold(&mut nodes);
    let mut musl = Musl::default();
    let sweeps = musl.prepare(&frozen.lattice, &frozen.particles, std::slice::from_ref(&frozen.slabs), &nodes, &[]);
    assert_eq!(sweeps, 1);
    let flip = Flip::default();
    let places = frozen.particles.position.clone();
    let found = places.iter().map(|x| gathered(&musl, &frozen, &nodes, x));
    let found: Vec<Received<D>> = found.collect();
    for (k, x) in places.iter().enumerate() {
        let half_size = frozen.particles.half_size;
        let before = frozen.particles.velocity[k];
        let after = |v: &mut [f64; D], musl: Option<&Musl>| match musl {
            Some(musl) => receive(musl, &frozen.lattice, x, &half_size, &nodes, v, None),
            None => receive(&flip, &frozen.lattice, x, &half_size, &nodes, v, None),
        };
        let (mut of_musl, mut of_flip) = (before, before);
        assert_eq!(after(&mut of_musl, Some(&musl)), after(&mut of_flip, None));
        assert_eq!(of_musl, of_flip);
        frozen.particles.velocity[k] = of_flip;
    }
    // To the grid and back without forces, FLIP changes nothing and leaves the mapped velocities on the nodes.
    frozen.transfer(&mut Flip::default());
    for (found, x) in found.iter().zip(&places) {
        let exact = gathered(&flip, &frozen, &frozen.nodes, x);
        for a in 0..D {
            for b in 0..D {
                let gap = (found.gradient(a, b) - exact.gradient(a, b)).part(3);
                assert!(gap.abs() < ROUNDING, "{gap}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn musl_strains_by_the_velocities_that_particles_then_have(
        wall in walls(), shares in clouds()
    ) {
        strains_are_of_the_new_velocities::<1, 2, Linear>(wall, &shares);
        strains_are_of_the_new_velocities::<2, 2, Linear>(wall, &shares);
        strains_are_of_the_new_velocities::<2, 3, Gimp>(wall, &shares);
        strains_are_of_the_new_velocities::<3, 3, QuadraticBSpline>(wall, &shares);
    }
}

#[test]
fn what_is_held_has_no_other_velocity_in_strains() {
    let grid = Grid::new(H, [Axis::walls(0.0, 8)]).unwrap();
    let positions = (0..16).map(|p| [(f64::from(p) + 0.5) * 0.5 * H]).collect();
    let mut frozen = Frozen::<1, 2, Linear>::new(grid, WallTreatment::OpenKnot, positions);
    frozen.transfer(&mut Flip::default());
    let wall = frozen.lattice.stencil(&[0.1 * H], &[0.25 * H]).first();
    let mut nodes = frozen.nodes.clone();
    // All fall on the wall, whose node is held.
    for node in &mut nodes {
        node.motion += Node::from([-1.0, 0.0, 0.0, 0.0]);
        node.change = Node::from([-1.0, 0.0, 0.0, 0.0]);
    }
    nodes[wall].motion = Node::from([0.0, 0.0, 0.0, nodes[wall].mass()]);
    nodes[wall].change = Node::ZERO;
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
    let slope = |held: &[Prescribed]| {
        let mut musl = Musl::default();
        let (particles, slabs) = (&frozen.particles, &frozen.slabs);
        musl.prepare(&frozen.lattice, particles, std::slice::from_ref(slabs), &nodes, held);
        let received = gathered(&musl, &frozen, &nodes, &[0.1 * H]);
        received.gradient(0, 0).part(0)
    };
    // Two particles a cell: w = ¼, ¾ beside the wall's node, and S⁺S shares 5/16 of a neighbour's mass each.
    let first = -1.0 + 3.0 / 16.0;
    assert!((slope(&held) - first / H).abs() < ROUNDING);
    assert!((slope(&[]) - (first + 3.0 / 8.0) / H).abs() < ROUNDING);
}
