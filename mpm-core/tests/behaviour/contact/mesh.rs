//! Surfaces of facets: their gaps, and blocks on them.

use super::*;
use mpm_core::Frame;
use mpm_core::contact::{Gap, Surface};
use mpm_core::memory::Memory;
use mpm_surfaces::Mesh;
use nalgebra::{SMatrix, SVector, Vector3};
use std::sync::Arc;

/// A number from −1 to 1 that differs from place to place.
fn noise(seed: usize) -> f64 {
    (12.9898 * seed as f64).sin() * 43_758.545 % 1.0
}

fn place<const D: usize>(seed: usize, size: f64) -> [f64; D] {
    std::array::from_fn(|a| size * noise(D * seed + a + 1))
}

fn chain(corners: &[[f64; 2]]) -> Mesh<2> {
    let sides: Vec<[[f64; 2]; 2]> = corners.windows(2).map(|side| [side[0], side[1]]).collect();
    Mesh::new(&sides).unwrap()
}

/// Two triangles between the corners of a square of half width `half` about the origin, at the heights of `up`.
fn square(half: f64, up: impl Fn(f64, f64) -> f64) -> Mesh<3> {
    let corners = [(-half, -half), (half, -half), (half, half), (-half, half)];
    let [a, b, c, d] = corners.map(|(x, y)| [x, y, up(x, y)]);
    Mesh::new(&[[a, b, c], [c, d, a]]).unwrap()
}

/// A box about the origin with half widths 1, 2, 3.
fn block_mesh() -> Mesh<3> {
    let corner = |k: usize| -> [f64; 3] { std::array::from_fn(|a| [-1.0, 1.0][k >> a & 1] * (a + 1) as f64) };
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*c, *d, *a]]);
    Mesh::new(&triangles.map(|t: [usize; 3]| t.map(corner)).collect::<Vec<_>>()).unwrap()
}

#[test]
fn a_level_mesh_is_a_plane_face() {
    let plane = RigidFace::<2>::half_space(1, End::Lo, 0.0).unwrap();
    let mesh = RigidFace::surface(Arc::new(chain(&[[-3.0, 0.0], [-1.0, 0.0], [0.5, 0.0], [3.0, 0.0]])));
    let in_space = RigidFace::<3>::half_space(2, End::Lo, 0.0).unwrap();
    let square = RigidFace::surface(Arc::new(square(3.0, |_, _| 0.0)));
    for k in 0..1000 {
        let (x, y) = (place(k, 2.9), place(k, 2.9));
        assert_eq!(plane.seen_at(&x, 0.0), mesh.seen_at(&x, 9.0));
        assert_eq!(in_space.seen_at(&y, 0.0), square.seen_at(&y, 9.0));
    }
    // Beside it, and farther than is asked for.
    assert_eq!((mesh.gap(&[-3.01, 0.1]), mesh.gap(&[3.01, -0.1])), (None, None));
    assert_eq!((mesh.gap(&[-3.0, 0.1]), mesh.seen_at(&[0.0, 0.5], 0.4)), (Some(0.1), None));
    assert_eq!(square.gap(&[3.01, 0.0, 0.1]), None);
    assert!(mesh.is_near(&[3.3, 0.4], 0.4) && !mesh.is_near(&[3.3, 0.4], 0.3));
}

/// A body inside another one is farther from what is outside, and less deep: the gap to a disc or ball of radius one lies
/// between that to what the facets are about and that to the disc or ball inside them.
fn is_round<const D: usize>(mesh: &Mesh<D>, sagitta: f64) {
    for k in 0..2000 {
        let x = place::<D>(k, 2.0);
        let exact = SVector::from(x).norm() - 1.0;
        let gap = mesh.gap(&x, f64::INFINITY).unwrap();
        let more = gap.size - exact;
        assert!((-1e-14..=sagitta + 1e-14).contains(&more), "{x:?}: {more}, {sagitta}");
        assert!((gap.normal.norm() - 1.0).abs() < 1e-14);
    }
}

#[test]
fn a_polygon_is_as_far_from_a_disc_as_its_sagitta() {
    for count in [3, 12, 100] {
        let turn = |k: usize| std::f64::consts::TAU * (k % count) as f64 / count as f64;
        let corners: Vec<[f64; 2]> = (0..=count).map(|k| [turn(k).cos(), -turn(k).sin()]).collect();
        is_round(&chain(&corners), 1.0 - (0.5 * turn(1)).cos());
    }
}

/// An octahedron whose triangles are parted in four, and their corners put on the ball.
#[test]
fn a_mesh_is_as_far_from_a_ball_as_its_sagitta() {
    let unit = |a: usize, sign: f64| Vector3::from_fn(|k, _| if k == a { sign } else { 0.0 });
    let mut triangles = Vec::new();
    for signs in 0..8_usize {
        let [a, b, c] = [0, 1, 2].map(|a| unit(a, [1.0, -1.0][signs >> a & 1]));
        triangles.push(if signs.count_ones() % 2 == 0 { [a, b, c] } else { [a, c, b] });
    }
    for parted in 0..5 {
        let nearest = |[a, b, c]: &[Vector3<f64>; 3]| a.dot(&(b - a).cross(&(c - a)).normalize());
        let sagitta = 1.0 - triangles.iter().map(nearest).fold(1.0, f64::min);
        let facets: Vec<[[f64; 3]; 3]> = triangles.iter().map(|t| t.map(Into::into)).collect();
        is_round(&Mesh::new(&facets).unwrap(), sagitta);
        assert!(sagitta < 0.5 * 0.45_f64.powi(parted), "{sagitta}");
        let middle = |a: &Vector3<f64>, b: &Vector3<f64>| (a + b).normalize();
        let parts = triangles.iter().flat_map(|[a, b, c]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[*a, ab, ca], [*b, bc, ab], [*c, ca, bc], [ab, bc, ca]]
        });
        triangles = parts.collect();
    }
}

/// Central differences of step s at the distance r from a corner: relative truncation (s/r)², rounding ε/s.
fn slopes_are_those_of_the_gap<const D: usize>(mesh: &Mesh<D>) -> [usize; 3] {
    let (s, seen) = (1e-5, |x: &SVector<f64, D>| mesh.gap(&(*x).into(), f64::INFINITY).unwrap());
    let mut kinds = [0; 3];
    for k in 0..3000 {
        let x = SVector::from(place::<D>(k, 4.0));
        let Gap { size, normal, bend } = seen(&x);
        let (mut slope, mut turn) = (SVector::<f64, D>::zeros(), SMatrix::<f64, D, D>::zeros());
        let mut smooth = size.abs() > 0.1;
        for a in 0..D {
            let step = SVector::from_fn(|b, _| if a == b { s } else { 0.0 });
            let [lo, hi] = [seen(&(x - step)), seen(&(x + step))];
            slope[a] = (hi.size - lo.size) / (2.0 * s);
            turn.set_column(a, &((hi.normal - lo.normal) / (2.0 * s)));
            // Not where the nearest part is another one within the step.
            let near = |gap: &Gap<D>| (gap.normal - normal).amax() < 1e-2 && (gap.bend - bend).amax() < 1e-2;
            smooth &= near(&lo) && near(&hi);
        }
        if smooth {
            assert!((slope - normal).amax() < 1e-6 && (turn - bend).amax() < 1e-5, "{x:?} {turn} {bend}");
            kinds[(bend.trace() * size).round() as usize] += 1;
        }
    }
    kinds
}

#[test]
fn normals_are_slopes_of_gaps_and_turn_as_they_say() {
    let faces_edges_corners = slopes_are_those_of_the_gap(&block_mesh());
    assert!(faces_edges_corners.iter().all(|count| *count > 100), "{faces_edges_corners:?}");
    let star = [[2.0, 0.0], [0.5, -0.5], [0.0, -2.0], [-1.0, 0.0], [0.0, 2.0], [2.0, 0.0]];
    assert!(slopes_are_those_of_the_gap(&chain(&star))[1] > 100);
    // A hollow corner is the nearest point of what is inside before it.
    let inside = chain(&star).gap(&[0.3, -0.3], 9.0).unwrap();
    assert!((inside.size + 0.08_f64.sqrt()).abs() < 1e-15 && inside.bend[(0, 0)] < 0.0, "{inside:?}");
}

#[test]
fn a_mesh_is_the_same_from_elsewhere() {
    let frames = [[(1, -1.0), (0, 1.0), (2, 1.0)], [(0, -1.0), (1, 1.0), (2, 1.0)]];
    for frame in frames.map(|axes| Frame::along(axes).shifted([5.0, -3.0, 0.25]).in_units(8.0, 0.25)) {
        let mesh = block_mesh();
        let seen = RigidFace::surface(Arc::new(block_mesh())).seen_from(&frame);
        for k in 0..500 {
            let x = place(k, 4.0);
            let [own, there] = [mesh.gap(&x, 9.0), seen.seen_at(&frame.place(&x), 72.0)].map(|gap| gap.unwrap());
            assert!((there.size - 8.0 * own.size).abs() < 1e-12, "{x:?}");
            let turned = SVector::from(frame.vector(&own.normal.into(), 1.0));
            let bend = frame.matrix(&own.bend, 0.125);
            assert!((there.normal - turned).amax() < 1e-12 && (there.bend - bend).amax() < 1e-10);
        }
    }
}

#[test]
fn a_bad_mesh_is_refused() {
    let refused = |facets: &[[[f64; 3]; 3]]| Mesh::new(facets).err().unwrap().to_string();
    let [a, b, c, d] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for (facets, said) in [
        (vec![], "facets of a mesh"),
        (vec![[a, b, [0.0, f64::NAN, 0.0]]], "finite"),
        (vec![[a, b, c], [a, d, [2.0, 0.0, 0.0]], [a, b, [0.5, 1e-9, 0.0]]], "2 is not allowed: one with an area"),
        (vec![[a, b, c], [a, b, d]], "1 is not allowed: one with at most one other"),
        (vec![[a, b, c], [b, a, d], [a, b, [0.0, -1.0, 0.0]]], "2 is not allowed: one with at most one other"),
        (vec![[a, b, c], [a, c, b]], "1 is not allowed: one with at most one other"),
    ] {
        assert!(refused(&facets).contains(said), "{said} in: {}", refused(&facets));
    }
    assert!(Mesh::new(&[[a, b, c], [b, a, d]]).is_ok());
    assert!(Mesh::new(&[[[0.0, 0.0], [1.0, 0.0]], [[0.0, 0.0], [0.0, 1.0]]]).is_err());
    assert!(Mesh::new(&[[[0.0]]]).is_err());
}

/// A mesh along a slope of `tangent` through a place, downwards along the first axis.
fn slope<const D: usize>(foot: &SVector<f64, D>, tangent: f64) -> RigidFace<D> {
    let corner = |x: f64, y: f64| {
        let off = [x, y];
        std::array::from_fn(|a| foot[a] + if a == D - 1 { -x * tangent } else { off[a] })
    };
    let half = 40.0;
    let ends = [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, y)| corner(x, y));
    let facets: Vec<[[f64; D]; D]> = match D {
        2 => vec![std::array::from_fn(|k| ends[k])],
        _ => [[0, 1, 2], [2, 3, 0]].iter().map(|t| std::array::from_fn(|k| ends[t[k]])).collect(),
    };
    RigidFace::surface(Arc::new(Mesh::new(&facets).unwrap()))
}

/// Directions along a slope and out of it.
fn directions<const D: usize>(tangent: f64) -> [SVector<f64, D>; 2] {
    let [mut along, mut out] = [SVector::<f64, D>::zeros(); 2];
    (along[0], along[D - 1]) = (1.0, -tangent);
    (out[0], out[D - 1]) = (tangent, 1.0);
    [along.normalize(), out.normalize()]
}

/// A barrier that carries a block, whose lowest particles have an area each, at the gap of rest.
fn carrying<const D: usize>() -> Barrier {
    Barrier::carrying_at(LOAD * SPACING.powi(D as i32 - 2), REST_GAP, DISTANCE).unwrap()
}

/// A block with its layers along a slope of a mesh, at the gap of rest, which moves along it with `speed` under GRAVITY
/// across the slope.
fn inclined<const D: usize>(tangent: f64, speed: f64, friction: impl Fn(f64) -> Friction) -> Setting<D> {
    let mut particles = block::<D>(if D == 2 { 16 } else { 6 });
    let [along, out] = directions::<D>(tangent);
    let foot = SVector::from_fn(|a, _| if a == D - 1 { 8.3 } else { 2.1 });
    for x in &mut particles.position {
        let up = x[D - 1] - 2.0 * H - 0.5 * SPACING + REST_GAP;
        let mut place = foot + along * (x[0] - 2.0 * H) + out * up;
        (1..D - 1).for_each(|a| place[a] = x[a]);
        *x = place.into();
    }
    particles.reference.clone_from(&particles.position);
    particles.velocity.fill((along * speed).into());
    let friction = friction(carrying::<D>().stiffness(REST_GAP));
    let contact = RigidContact::new(slope(&foot, tangent), carrying::<D>()).with_friction(friction);
    let weight = GRAVITY * tangent.hypot(1.0);
    under(scene(particles, vec![contact]), move |_| std::array::from_fn(|a| if a == D - 1 { -weight } else { 0.0 }))
}

/// Sums of a vector of the body or of the reaction along and across a slope.
fn parts<const D: usize>(vector: [f64; 3], tangent: f64) -> [f64; 2] {
    let vector = SVector::<f64, D>::from_fn(|a, _| vector[a]);
    directions::<D>(tangent).map(|direction| direction.dot(&vector))
}

/// Friction is μN at most, and so in all steps but few of all particles: the momentum along the slope is that of gravity
/// less what friction took.
fn slides_as_coulomb_has_it<const D: usize>() {
    let (mu, tangent, speed) = (0.3, 0.5, 0.3);
    let (scene, settings) = inclined::<D>(tangent, speed, |k| Friction::new(mu, k).unwrap());
    let dt = settings.dt;
    let mut solver = started((scene, settings)).unwrap();
    let [mut taken, mut spared] = [0.0; 2];
    while solver.time() < 4.0 {
        solver.step().unwrap();
        let [along, across] = parts::<D>(solver.on(Part::Contact(0)).force, tangent);
        assert!(along >= 0.0 && along <= -mu * across * (1.0 + ROUNDING));
        taken += dt * along;
        spared += dt * (-mu * across - along);
    }
    let (totals, time) = (solver.totals(), solver.time());
    let [u, v] = parts::<D>(totals.momentum, tangent).map(|p| p / totals.mass);
    let steps = time / dt;
    assert!((u - speed - tangent * GRAVITY * time + taken / totals.mass).abs() < steps * ROUNDING);
    let exact = speed + (tangent - mu) * GRAVITY * time;
    let share = spared / (mu * totals.mass * GRAVITY * time);
    assert!((0.0..0.01).contains(&share), "{share}");
    assert!((u - exact - mu * (share * GRAVITY * time - v)).abs() < steps * ROUNDING);
    assert!(v.abs() < 0.02 * u && solver.work().sorts > 1);
}

#[test]
fn beyond_the_angle_of_friction_a_block_slides_down_a_mesh() {
    slides_as_coulomb_has_it::<2>();
    slides_as_coulomb_has_it::<3>();
}

/// Below it the reaction is the weight, to what is out of balance, and nothing creeps.
fn rests_on_a_slope<const D: usize>() {
    let (mu, tangent) = (0.6, 0.5);
    let mut solver = started(damped(inclined::<D>(tangent, 0.0, |k| Friction::new(mu, k).unwrap()))).unwrap();
    run(&mut solver, 200.0);
    let weight = solver.totals().mass * GRAVITY;
    let [along, across] = parts::<D>(solver.on(Part::Contact(0)).force, tangent);
    let left = out_of_balance(&solver);
    assert!(left < 5.0 * AT_REST * weight, "{left}");
    assert!((along - tangent * weight).abs() <= left + ROUNDING * weight, "{along} {left}");
    assert!((across + weight).abs() <= left + ROUNDING * weight);
    let place = |solver: &Block<D>| solver.particles().position[0][0];
    let before = place(&solver);
    run(&mut solver, 220.0);
    assert!((place(&solver) - before).abs() < 1e-5 * tangent * LOAD / stick());
}

#[test]
fn below_the_angle_of_friction_a_block_rests_on_a_mesh() {
    rests_on_a_slope::<2>();
    rests_on_a_slope::<3>();
}

/// The same block on a plane face and on level facets.
fn follows_a_plane<const D: usize>() {
    let positions = |on_mesh: bool| {
        let mut particles = block::<D>(6);
        particles.velocity.fill(std::array::from_fn(|a| if a == 0 { 0.3 } else { 0.0 }));
        let plane = floor(&particles, REST_GAP);
        let level = 2.0 * H + 0.5 * SPACING - REST_GAP;
        let foot = SVector::from_fn(|a, _| if a == D - 1 { level } else { 0.0 });
        let face = if on_mesh { slope(&foot, 0.0) } else { plane };
        let friction = Friction::new(0.3, carrying::<D>().stiffness(REST_GAP)).unwrap();
        let contact = RigidContact::new(face, carrying::<D>()).with_friction(friction);
        let scene = scene(particles, vec![contact]);
        let mut solver =
            started(under(scene, |_| std::array::from_fn(|a| if a == D - 1 { -GRAVITY } else { 0.0 }))).unwrap();
        solver.advance(200).unwrap();
        assert!(solver.on(Part::Contact(0)).force[0] > 0.0);
        solver.particles().position.clone()
    };
    let [plane, mesh] = [false, true].map(positions);
    let most = plane.as_flattened().iter().zip(mesh.as_flattened()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    assert!(most < 200.0 * ROUNDING);
}

#[test]
fn a_block_on_a_level_mesh_moves_as_on_a_plane() {
    follows_a_plane::<2>();
    follows_a_plane::<3>();
}

#[test]
fn action_is_reaction_on_a_mesh() {
    let tilted = |particles: &Particles<3>| {
        let level = floor(particles, 0.95 * DISTANCE);
        let below = -level.gap(&[0.0; 3]).unwrap();
        slope(&[2.0 * H + 3.0 * SPACING, 0.0, below].into(), 0.02)
    };
    momentum_balances::<3>(tilted, Some(Friction::new(0.2, stick()).unwrap()));
    momentum_balances::<3>(tilted, None);
}

/// A bed with a kink that stands out and one that does not, below a block.
fn kinked(particles: &Particles<2>) -> RigidContact<2> {
    let low = 2.0 * H + 0.5 * SPACING - REST_GAP - 0.02;
    let corners = [[0.0, low - 0.06], [1.5, low], [4.0, low - 0.05], [7.0, low - 0.05], [30.0, low + 0.04]];
    let friction = Friction::new(0.3, stick()).unwrap();
    assert!(particles.len() > 1);
    RigidContact::new(RigidFace::surface(Arc::new(chain(&corners))), barrier()).with_friction(friction)
}

#[test]
fn threads_change_no_bit_on_a_mesh() {
    let contacts = |particles: &Particles<2>| vec![kinked(particles)];
    let one = bits(1, contacts);
    assert_eq!(one, bits(2, contacts));
    assert_ne!(one, bits(1, |_| Vec::new()));
}

#[test]
fn contact_with_a_mesh_allocates_nothing() {
    with_threads(1, || {
        let mut solver = started(inclined::<3>(0.5, 0.5, |k| Friction::new(0.3, k).unwrap())).unwrap();
        solver.step().unwrap();
        let info = allocation_counter::measure(|| {
            solver.advance(10).unwrap();
        });
        assert_eq!(info.count_total, 0);
    });
}

#[test]
fn a_run_on_a_mesh_goes_on_where_it_was() {
    let fresh = || started(inclined::<2>(0.5, 0.3, |k| Friction::new(0.3, k).unwrap())).unwrap();
    let [mut straight, mut resumed] = [fresh(), fresh()];
    straight.advance(30).unwrap();
    let saved = straight.save().unwrap();
    resumed.restore(&saved).unwrap();
    for solver in [&mut straight, &mut resumed] {
        solver.advance(30).unwrap();
    }
    assert_eq!(straight.particles().position, resumed.particles().position);
    assert_eq!(straight.on(Part::Contact(0)), resumed.on(Part::Contact(0)));
}

/// Seen from a frame whose units are powers of two and whose axes have changed places.
#[test]
fn a_run_on_a_mesh_is_the_same_from_elsewhere() {
    let frame = Frame::along([(1, -1.0), (0, 1.0)]).in_units(8.0, 0.25);
    let (scene, settings) = inclined::<2>(0.5, 0.3, |k| Friction::new(0.3, k).unwrap());
    let mut own = started((scene, settings)).unwrap();
    let (scene, settings) = inclined::<2>(0.5, 0.3, |k| Friction::new(0.3, k).unwrap());
    let mut seen = started((scene.seen_from(&frame).unwrap(), settings)).unwrap();
    own.advance(100).unwrap();
    seen.advance(100).unwrap();
    let places = |solver: &Block<2>, of: &dyn Fn(&[f64; 2]) -> [f64; 2]| {
        let p = solver.particles();
        let mut places = vec![[0.0; 2]; p.len()];
        p.id.iter().zip(&p.position).for_each(|(id, x)| places[*id as usize] = of(x));
        places
    };
    let [own, seen] = [places(&own, &|x| *x), places(&seen, &|x| frame.place_of_scene(x))];
    let most = own.as_flattened().iter().zip(seen.as_flattened()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    assert!(most < 100.0 * ROUNDING);
}

#[test]
fn what_begins_deep_in_a_body_is_refused() {
    let particles = block::<2>(16);
    // Clockwise about all of the block, by more than it is looked for in a step.
    let corners = [[-9.0, -9.0], [-9.0, 12.0], [12.0, 12.0], [12.0, -9.0], [-9.0, -9.0]];
    let contact = RigidContact::new(RigidFace::surface(Arc::new(chain(&corners))), barrier());
    let error = started(scene(particles, vec![contact])).err().unwrap();
    let closed = matches!(error, Error::Breakdown { fault: Fault::GapClosed(gap), .. } if gap < -5.0);
    assert!(closed, "{error}");
}
