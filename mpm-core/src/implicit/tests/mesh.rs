//! Surfaces of facets: the tangent before facets, edges and corners, and blocks on a slope across the grid.

use super::contact::{DISTANCE, rubber};
use super::friction::{MASS, MIDPOINT, MU, TOLERANCE, coulomb, settle, stick};
use super::stiffness::{REMEDIES, slope_of_the_forces, strained};
use super::*;
use crate::contact::{Barrier, Friction, Mesh, RigidContact, RigidFace};
use crate::simulation::Part;
use crate::stage::Gravity;
use std::sync::Arc;

/// A roof of four triangles, or two sides, with slopes of `tangents` along the first axis and ±1 along others, below
/// `top`: a slope where they are opposite.
fn roof<const D: usize>(top: &SVector<f64, D>, tangents: [f64; 2], beside: f64) -> RigidFace<D> {
    let far = 40.0;
    let corner = |x: f64, y: f64| -> [f64; D] {
        let down = far * tangents[usize::from(x > 0.0)] * x.abs() + far * beside * y.abs();
        std::array::from_fn(|a| top[a] + if a == D - 1 { -down } else { far * [x, y][a] })
    };
    let ends = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| corner(x, y));
    let apex = <[f64; D]>::from(*top);
    let facets: Vec<[[f64; D]; D]> = match D {
        2 => [[corner(-1.0, 0.0), apex], [apex, corner(1.0, 0.0)]].map(|s| std::array::from_fn(|k| s[k])).into(),
        _ => (0..4).map(|k| [ends[k], ends[(k + 1) % 4], apex]).map(|t| std::array::from_fn(|k| t[k])).collect(),
    };
    RigidFace::mesh(Arc::new(Mesh::new(&facets).unwrap()))
}

/// Directions along a slope of `tangent`, and out of it.
fn directions<const D: usize>(tangent: f64) -> [SVector<f64, D>; 2] {
    let [mut along, mut out] = [SVector::zeros(); 2];
    (along[0], along[D - 1]) = (1.0, -tangent);
    (out[0], out[D - 1]) = (tangent, 1.0);
    [along.normalize(), out.normalize()]
}

/// K is the slope of the forces before a slope or, where it is `sharp`, near its top.
fn tangent_before_facets<const D: usize, I: Interpolation<D>>(sharp: bool, friction: Option<Friction>) {
    let mut solver = strained::<D, I, _>(rubber(), REMEDIES[0]);
    let particles = &solver.scene.bodies.particles;
    let [along, out] = directions::<D>(0.3);
    let places = particles.position.iter().map(|x| SVector::from(*x));
    let (face, reach) = if sharp {
        let middle = SVector::from_fn(|a, _| if a == D - 1 { 0.0 } else { 0.6 });
        let from = |x: &SVector<f64, D>| (x - middle).norm();
        let lowest = places.min_by(|x, y| from(x).total_cmp(&from(y))).unwrap();
        (roof(&(lowest - (out * 0.2 + along * 0.1) * H), [1.0; 2], 1.0), H)
    } else {
        let least = places.map(|x| out.dot(&x)).fold(f64::INFINITY, f64::min);
        (roof(&(out * (least - 0.2 * H)), [-0.3, 0.3], 0.0), 0.5 * H)
    };
    let mut contact = RigidContact::new(face, Barrier::carrying(1e3, reach).unwrap());
    if let Some(friction) = friction {
        contact = contact.with_friction(friction);
        contact.attach(particles.len());
        let mut before = along * (0.2 * H);
        before[D - 2] -= 0.1 * H;
        contact.stick(particles.id.iter().map(|id| (*id, before.into())));
    }
    let seen = particles.position.iter().filter_map(|x| contact.face().seen_at(x, reach));
    let touching = seen.clone().filter(|gap| gap.size < reach).count();
    assert!(touching > 0 && touching < particles.len());
    let turning = seen.filter(|gap| gap.size < reach && gap.bend.amax() > 0.0).count();
    assert_eq!(turning > 0, sharp, "{turning} of {touching}");
    solver.scene.contacts.push(contact);
    let setting = solver.setting(1.0);
    let trial =
        setting.step(&solver.scene.bodies, 1.0).trial(&vec![0.0; setting.unknowns.len()], solver.functions.len());
    for push in trial.unwrap().pushes {
        let slips = SVector::from(push.stretch).norm() < 0.1 * H;
        assert_eq!(slips, friction.is_none_or(|friction| friction.coefficient().is_some()));
    }
    slope_of_the_forces(&solver);
}

#[test]
fn the_tangent_before_facets_edges_and_corners_is_the_slope_of_the_forces() {
    let frictions = [Friction::rough(3e3), Friction::new(MU, 1e6)].map(|friction| Some(friction.unwrap()));
    for sharp in [false, true] {
        for friction in frictions.into_iter().chain([None]) {
            tangent_before_facets::<2, Quadratics<2>>(sharp, friction);
            tangent_before_facets::<2, Means<2>>(sharp, friction);
            tangent_before_facets::<3, Means<3>>(sharp, friction);
        }
    }
}

/// A block whose layers lie along a slope of `tangent`, with 1 m/s² across it, and along it from the time one (s) on.
fn inclined(tangent: f64, settings: Settings) -> Solver<2> {
    let mut scene = filled([Axis::open(0.0, 8 * CELLS); 2], CELLS, rubber());
    let [along, out] = directions::<2>(tangent);
    let foot = SVector::from([2.03, 4.91]);
    for x in &mut scene.bodies.particles.position {
        *x = (foot + along * x[0] + out * (x[1] - 0.25 * H + 0.5 * DISTANCE)).into();
    }
    let barrier = Barrier::carrying(MASS / (2 * CELLS) as f64, DISTANCE).unwrap();
    let contact =
        RigidContact::new(roof(&foot, [-tangent, tangent], 0.0), barrier).with_friction(coulomb(stick(barrier)));
    let load = move |t: f64| (along * if t > 1.0 { tangent } else { 0.0 } - out).into();
    let settings = Settings { tolerance: TOLERANCE, ..settings.stabilised(Stabilisation::Ghost(1e-3)) };
    let scene = scene.contact(contact).load(Gravity(Box::new(load)));
    Solver::new::<Quadratics<2>>(scene, settings).unwrap()
}

/// The highest order of the residuals of a step: two, less what the rounding of the last one takes.
fn order(solver: &Solver<2>) -> f64 {
    let order = |r: &[f64]| (r[2] / r[1]).ln() / (r[1] / r[0]).ln();
    solver.convergence().unwrap().residuals.windows(3).map(order).fold(0.0, f64::max)
}

fn parts(vector: [f64; 3], tangent: f64) -> [f64; 2] {
    directions::<2>(tangent).map(|direction| direction.dot(&SVector::from([vector[0], vector[1]])))
}

#[test]
fn below_the_angle_of_friction_a_block_rests_on_a_slope_across_the_grid() {
    let tangent = 0.9 * MU;
    let mut solver = inclined(tangent, Settings::new(1.0));
    solver.step().unwrap();
    println!("order at rest {}: {:?}", order(&solver), solver.convergence().unwrap().residuals);
    assert!(order(&solver) > 1.6);
    settle(&mut solver);
    let [along, across] = parts(solver.on(Part::Contact(0)).force, tangent);
    assert!((along - tangent * MASS).abs() < 1e-9 * MASS, "{along}");
    assert!((across + MASS).abs() < 1e-9 * MASS, "{across}");
}

/// Every stick holds μN at most; particles that come to the slope take a step to hold as much.
#[test]
fn beyond_the_angle_of_friction_a_block_slides_down_a_slope_across_the_grid() {
    let tangent = 2.0 * MU;
    let mut solver = inclined(tangent, Settings::new(1.0));
    solver.step().unwrap();
    solver.settings = Settings { dt: 0.02, ..solver.settings.rule(MIDPOINT) };
    let particles = &mut solver.scene.bodies.particles;
    particles.velocity = vec![[0.0; 2]; particles.len()];
    solver.advance(20).unwrap();
    let (early, start) = (solver.totals().momentum, solver.time());
    let impulse = solver.on(Part::Contact(0)).impulse;
    let mut orders = Vec::new();
    for _ in 0..150 {
        solver.step().unwrap();
        orders.push(order(&solver));
    }
    let time = solver.time() - start;
    let [given, gained] = [(solver.on(Part::Contact(0)).impulse, impulse), (solver.totals().momentum, early)]
        .map(|(after, before)| parts(std::array::from_fn(|a| after[a] - before[a]), tangent));
    let spared = (-MU * given[1] - given[0]) / (MU * MASS * time);
    orders.sort_by(f64::total_cmp);
    println!("not rubbed {spared:.2e}, gained {gained:?}, orders {} {} {}", orders[0], orders[15], orders[75]);
    assert!((-1e-12..0.01).contains(&spared), "{spared}");
    assert!((gained[0] + given[0] - tangent * MASS * time).abs() < 1e-9 * MASS * time);
    assert!(orders[15] > 1.6);
}

/// A block between rollers on a top below one of its particles, beside it by a part of the gap.
#[test]
fn newtons_order_is_two_on_a_corner() {
    for friction in [None, Some(Friction::rough(1e3).unwrap()), Some(Friction::new(0.1, 1e3).unwrap())] {
        let axes = [Axis::walls(0.0, CELLS), Axis::open(0.0, CELLS + 4)];
        let mut scene = filled(axes, CELLS, rubber());
        for x in &mut scene.bodies.particles.position {
            x[1] += 2.0 * H;
        }
        let weight = 0.05 * MASS;
        let barrier = Barrier::carrying(weight, DISTANCE).unwrap();
        let top = SVector::from([4.5 * 0.5 * H + 0.3 * DISTANCE, 2.25 * H - 0.6 * DISTANCE]);
        let mut contact = RigidContact::new(roof(&top, [1.0; 2], 0.0), barrier);
        if let Some(friction) = friction {
            contact = contact.with_friction(friction);
        }
        let rollers = [End::Lo, End::Hi].map(|end| Wall::new(0, end, WallKind::Roller));
        let scene = scene.constrain_all(rollers).contact(contact).load(Gravity(Box::new(|_| [0.0, -0.05])));
        let settings = Settings { tolerance: TOLERANCE, ..Settings::new(1.0).stabilised(Stabilisation::Ghost(0.01)) };
        let mut solver = Solver::<2>::new::<Quadratics<2>>(scene, settings).unwrap();
        solver.step().unwrap();
        let [beside, force, _] = solver.on(Part::Contact(0)).force;
        println!("{} {:?}", order(&solver), solver.convergence().unwrap().residuals);
        assert!(order(&solver) > 1.7);
        assert!((force + weight).abs() < 1e-9 * weight && beside.abs() > 0.1 * weight, "{force} {beside}");
    }
}

/// Friction on facets has no potential, rough or not.
#[test]
fn friction_on_facets_is_refused_with_f_bar() {
    let settings = Settings::new(1.0).remedy(Remedy::FbarConsistent);
    let top = SVector::from([0.5, -1.0]);
    let with = |friction: Option<Friction>| {
        let contact = RigidContact::new(roof(&top, [1.0; 2], 0.0), Barrier::new(1.0, 0.1).unwrap());
        let contact = friction.map_or(contact.clone(), |friction| contact.with_friction(friction));
        Solver::<2>::new::<Quadratics<2>>(full(CELLS, rubber()).contact(contact), settings).err()
    };
    assert!(with(None).is_none());
    assert!(with(Some(Friction::rough(1.0).unwrap())).unwrap().to_string().contains("plane face"));
}
