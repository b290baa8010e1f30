//! Surfaces of any shape: the tangent before slopes and balls, and a block on a ball.

use super::contact::{DISTANCE, rubber};
use super::friction::{MASS, MU, TOLERANCE};
use super::stiffness::{REMEDIES, slope_of_the_forces, strained};
use super::*;
use crate::contact::{Barrier, Friction, Gap, RigidContact, RigidFace, Surface};
use crate::simulation::Part;
use crate::stage::Gravity;
use std::sync::Arc;

/// A ball about a middle, or a plane through a foot with this normal.
#[derive(Debug)]
enum Shape<const D: usize> {
    Ball(SVector<f64, D>, f64),
    Slope(SVector<f64, D>, SVector<f64, D>),
}

impl<const D: usize> Surface<D> for Shape<D> {
    fn gap(&self, x: &[f64; D], within: f64) -> Option<Gap<D>> {
        let x = SVector::from(*x);
        let gap = match self {
            Self::Slope(foot, out) => Gap { size: out.dot(&(x - foot)), normal: *out, bend: SMatrix::zeros() },
            Self::Ball(middle, radius) => {
                let (far, normal) = ((x - middle).norm(), (x - middle).normalize());
                let across = SMatrix::<f64, D, D>::identity() - normal * normal.transpose();
                Gap { size: far - radius, normal, bend: across / far }
            }
        };
        Some(gap).filter(|gap| gap.size <= within)
    }

    fn is_near(&self, x: &[f64; D], distance: f64) -> bool {
        self.gap(x, distance).is_some()
    }

    fn crosses(&self, _: usize) -> bool {
        true
    }
}

/// Directions along a slope of `tangent`, and out of it.
fn directions<const D: usize>(tangent: f64) -> [SVector<f64, D>; 2] {
    let [mut along, mut out] = [SVector::<f64, D>::zeros(); 2];
    (along[0], along[D - 1]) = (1.0, -tangent);
    (out[0], out[D - 1]) = (tangent, 1.0);
    [along.normalize(), out.normalize()]
}

/// K is the slope of the forces before a slope or, where it is `round`, a ball.
fn tangent_before<const D: usize, I: Interpolation<D>>(round: bool, friction: Option<Friction>) {
    let mut solver = strained::<D, I, _>(rubber(), REMEDIES[0]);
    let particles = &solver.scene.bodies.particles;
    let [along, out] = directions::<D>(0.3);
    let places = particles.position.iter().map(|x| SVector::from(*x));
    let (face, reach) = if round {
        let middle = SVector::from_fn(|a, _| if a == D - 1 { 0.0 } else { 0.6 });
        let from = |x: &SVector<f64, D>| (x - middle).norm();
        let lowest = places.min_by(|x, y| from(x).total_cmp(&from(y))).unwrap();
        (Shape::Ball(lowest - (out * 0.4 + along * 0.1) * H, 0.2 * H), H)
    } else {
        let least = places.map(|x| out.dot(&x)).fold(f64::INFINITY, f64::min);
        (Shape::Slope(out * (least - 0.2 * H), out), 0.5 * H)
    };
    let face = RigidFace::surface(Arc::new(face));
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
    assert_eq!(turning > 0, round, "{turning} of {touching}");
    solver.scene.contacts.push(contact);
    let setting = solver.setting(1.0);
    let trial =
        setting.step(&solver.scene.bodies, 1.0).trial(&vec![0.0; setting.unknowns.len()], solver.functions.len());
    let longest = trial.unwrap().pushes.iter().map(|push| SVector::from(push.stretch).norm()).fold(0.0, f64::max);
    assert_eq!(longest < 0.1 * H, friction.is_none_or(|friction| friction.coefficient().is_some()));
    slope_of_the_forces(&solver);
}

#[test]
fn the_tangent_before_slopes_and_balls_is_the_slope_of_the_forces() {
    let frictions = [Friction::rough(3e3), Friction::new(MU, 1e6)].map(|friction| Some(friction.unwrap()));
    for round in [false, true] {
        for friction in frictions.into_iter().chain([None]) {
            tangent_before::<2, Quadratics<2>>(round, friction);
            tangent_before::<2, Means<2>>(round, friction);
            tangent_before::<3, Means<3>>(round, friction);
        }
    }
}

/// The highest order of the residuals of a step: two, less what the rounding of the last one takes.
fn order(solver: &Solver<2>) -> f64 {
    let order = |r: &[f64]| (r[2] / r[1]).ln() / (r[1] / r[0]).ln();
    solver.convergence().unwrap().residuals.windows(3).map(order).fold(0.0, f64::max)
}

/// A block between rollers on a small ball below one of its particles, beside it by a part of the gap.
#[test]
fn newtons_order_is_two_on_a_ball() {
    for friction in [None, Some(Friction::rough(1e3).unwrap()), Some(Friction::new(0.1, 1e3).unwrap())] {
        let axes = [Axis::walls(0.0, CELLS), Axis::open(0.0, CELLS + 4)];
        let mut scene = filled(axes, CELLS, rubber());
        for x in &mut scene.bodies.particles.position {
            x[1] += 2.0 * H;
        }
        let weight = 0.05 * MASS;
        let barrier = Barrier::carrying(weight, DISTANCE).unwrap();
        let top = SVector::from([4.5 * 0.5 * H + 0.3 * DISTANCE, 2.25 * H - 0.6 * DISTANCE]);
        let ball = RigidFace::surface(Arc::new(Shape::Ball(top, 1e-3 * DISTANCE)));
        let mut contact = RigidContact::new(ball, barrier);
        if let Some(friction) = friction {
            contact = contact.with_friction(friction);
        }
        let rollers = [End::Lo, End::Hi].map(|end| Wall::new(0, end, WallKind::Roller));
        let scene = scene.constrain_all(rollers).contact(contact).load(Gravity(Box::new(|_| [0.0, -0.05])));
        let settings = Settings { tolerance: TOLERANCE, ..Settings::new(1.0).stabilised(Stabilisation::Ghost(0.01)) };
        let mut solver = Solver::<2>::new::<Quadratics<2>>(scene, settings).unwrap();
        solver.step().unwrap();
        let [beside, force, _] = solver.on(Part::Contact(0)).force;
        assert!(order(&solver) > 1.7);
        assert!((force + weight).abs() < 1e-9 * weight && beside.abs() > 0.1 * weight, "{force} {beside}");
    }
}

/// Friction on a surface that turns has no potential, rough or not.
#[test]
fn friction_on_a_surface_that_turns_is_refused_with_f_bar() {
    let settings = Settings::new(1.0).remedy(Remedy::FbarConsistent);
    let top = SVector::from([0.5, -1.0]);
    let with = |friction: Option<Friction>| {
        let ball = RigidFace::surface(Arc::new(Shape::Ball(top, 0.1)));
        let contact = RigidContact::new(ball, Barrier::new(1.0, 0.1).unwrap());
        let contact = friction.map_or(contact.clone(), |friction| contact.with_friction(friction));
        Solver::<2>::new::<Quadratics<2>>(full(CELLS, rubber()).contact(contact), settings).err()
    };
    assert!(with(None).is_none());
    assert!(with(Some(Friction::rough(1.0).unwrap())).unwrap().to_string().contains("plane face"));
}
