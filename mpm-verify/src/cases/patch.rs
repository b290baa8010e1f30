//! A body that stretches, shears and falls: what a scheme must reproduce exactly, next to walls too.

use crate::cases::build::DENSITY;
use crate::cases::prelude::*;
use crate::exact::transfers::{filtered, second_moment};
use mpm_solvers::stable_cfl;
use std::ops::AddAssign;

/// Steps of a run, and its duration (s).
const STEPS: u64 = 20;
const DURATION: f64 = 1.0;
/// Way of waves in the run, in cells: of a strained body, whose stress is measured and moves next to nothing; and of one that
/// falls, no faster than they.
const WAVES: f64 = 1e-4;
const FALLING_WAVES: f64 = 4.0;
/// Side of the body (m).
const SIDE: f64 = 1.0;
/// Velocity gradient, over the strain and the duration: nine entries, all different, that move every particle away from the walls.
const GRADIENT: [[f64; 3]; 3] = [[0.9, 0.5, 0.8], [0.6, 1.1, 0.7], [1.2, 1.0, 1.3]];
/// Direction of the fall.
const DOWN: [f64; 3] = [0.6, 0.8, 1.0];
/// Cells between a side of the body and the particles that see no node beside which matter is missing.
const MARGIN: f64 = 3.0;
/// Cells of room beyond the body's way.
const ROOM: f64 = 3.0;
/// Last bits of a coordinate that a step may lose.
const LAST_BITS: f64 = 4.0;
/// An error that tells nothing.
const VAGUE: f64 = 0.1;
const VAGUELY: &str = "so small a strain, or so long a way, lets every error pass";

parameters! {
    struct Moved {
        dimension: usize = whole("-", "2", 2, 3), "dimension";
        strain: f64 = real("-", "1e-6", 0.0, 1e-4), "size of the strain at the end";
        fall: f64 = real("h", "0", 0.0, 0.5), "way that gravity and the speed of the start make each, in cells";
        damping: f64 = common::DAMPING, "explicit: local damping factor";
        ppc_per_direction: usize = common::PPC_PER_DIRECTION;
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.3");
        lumped: f64 = common::LUMPED;
        alpha: f64 = common::ALPHA;
        delta: f64 = common::DELTA;
        tolerance: f64 = common::TOLERANCE;
    }
}

metrics! { ALL:
    DISPLACEMENT_ERROR = "displacement_error", "-",
        "rms error of the displacement over its exact rms; with apic and xpic2, or without a strain, of all particles, else of those three cells inside";
    VELOCITY_ERROR = "velocity_error", "-", "relative error of the velocity, half a step before the end of an explicit run; with xpic2 of what its filter leaves";
    STRESS_ERROR = "stress_error", "-", "relative error of the stress, where there is a strain";
    STRAIN_OF_WAVES = "strain_of_waves", "-", "share of the strain that the stress may add or take in the duration, docs/patch.md";
    DAMPED_RATIO = "damped_ratio", "-", "work of damping over the exact one, without a strain";
    MASS = "mass", "kg", "mass of the body, per metre in plane strain";
}

pub(super) fn case() -> Case {
    Case::of::<2, Moving>("patch", "Affine motion and free fall", ALL)
        .planned(plan())
        .described("A soft body beside open-knot walls that don't hold it stretches and shears with a constant gradient of velocity, \
            and falls: every entry of the gradient, APIC at walls, the filter of XPIC, the start of implicit rules and the work of damping, exactly.")
        .reference("Exact: an affine motion without forces, and free fall.")
        .limit("Transfers without an affine part see a gradient in the interior of a regular lattice alone.")
        .limit("Walls that hold nodes are not here: their share in a transfer is judged by drift alone.")
        .wanted("motion", "displacement, velocity and stress at the end against the exact motion, or the share that a filter keeps", "affine filter free-fall")
        .checks(checks())
        .headline(DISPLACEMENT_ERROR, "displacement off by (–)", 1.0, 9)
        .headline(VELOCITY_ERROR, "velocity (–)", 1.0, 9)
        .headline(STRESS_ERROR, "stress (–)", 1.0, 9)
        .headline(DAMPED_RATIO, "work of damping / exact (–)", 1.0, 6)
        .watched(&["displacement_error", "kinetic_energy"])
        .sketch(Sketch::block("A cube that stretches, shears and falls away from the walls of its corner.", [1.0, 1.0])
            .load([0.4, 0.4], [0.7, 0.7])
            .note([0.5, -0.1], "wall that doesn't hold")
            .length([0.0, 1.1], [1.0, 1.1], "1 m"))
        .cost(|_| 0.01)
        .begun(problem::begin_in::<2, 3, Moving>)
}

fn plan() -> Plan {
    let none = [RemedyName::None];
    let plain = pairs(&[Gimp, Bspline2], &none);
    let affine = [Gimp, Bspline2].map(|basis| Scheme::explicit(basis, none[0], TransferName::Apic));
    let filters = [Gimp, Bspline2].map(|basis| Scheme::explicit(basis, none[0], TransferName::Xpic2));
    let moved = implicit(&[RuleName::Midpoint, RuleName::Newmark], &[Gimp, Bspline2], &none);
    Plan::of(levels(SIDE, [("n8", 8.0)]))
        .runs(Quick, "n8", &affine[1..], "")
        .runs(Pr, "n8", &affine, "")
        .runs(Pr, "n8", &[Scheme::flip(Gimp, FbarConsistent)], "")
        .runs(Pr, "n8", &filters, "")
        .each(Pr, "n8", &plain, ["dimension=3", "strain=0 fall=0.2 damping=0.5"])
        .runs(Pr, "n8", &moved, "strain=0 fall=0.2")
}

impl Setup<Moved> {
    fn gradient<const D: usize>(&self) -> SMatrix<f64, D, D> {
        SMatrix::from_fn(|i, j| self.strain * GRADIENT[i][j])
    }

    /// Largest way of a particle, in cells.
    fn way(&self) -> f64 {
        let largest = GRADIENT.iter().map(|row| row.iter().sum::<f64>()).fold(0.0, f64::max);
        self.strain * largest * SIDE / self.h + 2.0 * self.fall
    }

    /// Displacement (m) of the start's speed at the end, and of the acceleration that damping leaves.
    fn ways<const D: usize>(&self) -> [[f64; D]; 2] {
        let way = std::array::from_fn(|a| self.fall * self.h * DOWN[a]);
        [way, way.map(|way| way * (1.0 - self.damping))]
    }
}

impl Run<'_, Moved> {
    /// Largest relative error of an affine motion: docs/patch.md.
    fn affine_bound(&self) -> f64 {
        let nearest = 0.5 / self.ppc_per_direction as f64;
        let moved = match self.transfer() {
            TransferName::Flip => self.way(),
            TransferName::Xpic2 => STEPS as f64 * self.way() / nearest,
            _ => self.way() / nearest,
        };
        let rounding = LAST_BITS * f64::EPSILON * STEPS as f64 / self.strain;
        self.metric(STRAIN_OF_WAVES) + moved + rounding
    }
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Moved>;
    type Demand = crate::demand::Demand<Moved>;
    let left = |b: &Run<Moved>| if b.is_implicit() { b.tolerance * STEPS as f64 } else { 0.0 };
    vec![
        Check::truth("affine", "apic, and flip three cells inside: motion and stress of a constant ∇v exact within what stress moves, moments change and (flip) the lattice strains")
            .when(|b| b.strain > 0.0 && b.damping == 0.0)
            .when(|b| b.transfer() == TransferName::Apic || b.scheme == Scheme::flip(b.basis(), b.remedy()))
            .except(|b| b.affine_bound() > VAGUE, VAGUELY)
            .except(|b| b.remedy() != RemedyName::None, "an average reaches from the sides to all particles")
            .each([DISPLACEMENT_ERROR, VELOCITY_ERROR, STRESS_ERROR].map(|of| Demand::at_most(of, |b: &Run<Moved>| b.affine_bound())))
            .because("APIC keeps an affine field wherever particles lie (Jiang et al. 2015); nodes amid a regular lattice have their mass' centre"),
        Check::truth("filter", "xpic2: of a constant ∇v it keeps what (1 − S S⁺)² leaves to lines of particles, within twenty times what functions change in motion")
            .when(|b| b.strain > 0.0 && b.fall == 0.0 && b.transfer() == TransferName::Xpic2)
            .except(|b| b.affine_bound() > VAGUE, VAGUELY)
            .at_most(VELOCITY_ERROR, |b| b.affine_bound())
            .because("Hammerquist & Nairn 2017: (1 − S S⁺)^m is taken in every step; functions in closed form, docs/patch.md"),
        Check::truth("free-fall", "without a strain: displacement and velocity are those of a constant acceleration to rounding, implicit to what Newton's method leaves")
            .when(|b| b.strain == 0.0 && b.fall > 0.0)
            .each([DISPLACEMENT_ERROR, VELOCITY_ERROR].map(|of| Demand::at_most(of, move |b: &Run<Moved>| ROUNDING + left(b))))
            .because("central differences, the midpoint rule and Newmark's are exact where the acceleration is constant, if it is there at the start"),
        Check::truth("damping-is-booked", "local damping in free fall: booked work is α of gravity's on the way that nodes have before each step, to rounding")
            .when(|b| b.strain == 0.0 && b.fall > 0.0 && b.damping > 0.0)
            .within(DAMPED_RATIO, |_| 1.0, |_| ROUNDING)
            .because("docs/patch.md"),
    ]
}

struct Moving {
    setup: Setup<Moved>,
    law: NeoHookean,
    dt: f64,
}

impl Moving {
    /// Exact displacement (m) of a material point, and the velocity (m/s) of the time `lag` (s) earlier.
    fn exact<const D: usize>(&self, x: &[f64; D], t: f64, lag: f64) -> [[f64; D]; 2] {
        let (gradient, [speed, pull]) = (self.setup.gradient::<D>(), self.setup.ways::<D>());
        let (s, earlier) = (t / DURATION, (t - lag) / DURATION);
        let strained: [f64; D] = std::array::from_fn(|a| (0..D).map(|b| gradient[(a, b)] * x[b]).sum());
        let displacement = |a: usize| (strained[a] + speed[a]) * s + pull[a] * s * s;
        let velocity = |a: usize| (strained[a] + speed[a] + 2.0 * pull[a] * earlier) / DURATION;
        [std::array::from_fn(displacement), std::array::from_fn(velocity)]
    }

    fn lag(&self) -> f64 {
        if self.setup.is_implicit() { 0.0 } else { 0.5 * self.dt }
    }

    /// Errors of displacement, velocity and stress over the exact ones.
    fn errors<const D: usize>(&self, run: &mut dyn Simulation<D>) -> [f64; 3] {
        let (t, stress) = (run.time(), run.force_stress());
        let mut f = Matrix3::identity();
        f.fixed_view_mut::<D, D>(0, 0).add_assign(self.setup.gradient::<D>() * (t / DURATION));
        let (exact_stress, _) = self.law.at_rest(&f);
        let inside = MARGIN * self.setup.h..=SIDE - MARGIN * self.setup.h;
        let transfers = [TransferName::Apic, TransferName::Xpic2];
        let everywhere = transfers.contains(&self.setup.transfer()) || self.setup.strain == 0.0;
        let filters = self.setup.transfer() == TransferName::Xpic2;
        let (h, per_direction) = (self.setup.h, self.setup.ppc_per_direction as f64);
        let line = filters.then(|| filtered(self.setup.basis(), [SIDE / h, per_direction, h], run.work().steps));
        let size = h / per_direction;
        let p = run.particles();
        let mut pairs: [Vec<(f64, f64)>; 3] = Default::default();
        let mut put = |which: usize, found: f64, exact: f64| pairs[which].push((found - exact, exact));
        for k in 0..p.len() {
            if !everywhere && !p.reference[k].iter().all(|x| inside.contains(x)) {
                continue;
            }
            let [u, mut v] = self.exact(&p.reference[k], t, self.lag());
            if let Some(line) = &line {
                let place = p.reference[k].map(|x| line[(x / size) as usize]);
                v = self.exact(&place, t, self.lag())[1];
            }
            for a in 0..D {
                put(0, p.position[k][a] - p.reference[k][a], u[a]);
                put(1, p.velocity[k][a], v[a]);
                (0..D).for_each(|b| put(2, stress[k].get(a, b), exact_stress.get(a, b)));
            }
        }
        pairs.map(|pairs| rms(pairs.iter().map(|(off, _)| *off)) / rms(pairs.iter().map(|(_, exact)| *exact)))
    }
}

impl<const D: usize> Problem<D> for Moving {
    type Parameters = Moved;
    type Seen = Rows;

    fn new(setup: Setup<Moved>) -> Result<Self, Error> {
        setup.check_rule()?;
        if setup.is_implicit() {
            setup.forbid(&["damping"])?;
        }
        let ratio = setup.poisson_ratio;
        let waves = if setup.strain > 0.0 { WAVES } else { FALLING_WAVES };
        let speed = waves * setup.h / DURATION;
        let unit = NeoHookean::new(1.0, ratio)?.wave_speed(DENSITY);
        Ok(Self { law: NeoHookean::new((speed / unit).powi(2), ratio)?, dt: DURATION / STEPS as f64, setup })
    }

    fn discretisation(&self) -> Discretisation {
        self.setup.regular(D, self.dt)
    }

    fn begin(&self, _: &Rows) -> Begun<D> {
        let h = self.setup.h;
        let cells = (SIDE / h).round();
        let ways = self.exact(&[SIDE; D], DURATION, 0.0)[0];
        let axis = |way: f64| {
            let count = (cells + way / h + ROOM).ceil() as usize;
            Axis::bounded(0.0, count, (Side::Wall, Side::Open))
        };
        let size = self.setup.pitch();
        let along = cells as usize * self.setup.ppc_per_direction;
        let mut particles = self.setup.particles_at(by_rows([along; D], size), size, DENSITY)?;
        for (v, x) in particles.velocity.iter_mut().zip(&particles.reference) {
            *v = self.exact(x, 0.0, self.lag())[1];
        }
        if self.setup.transfer() == TransferName::Apic {
            let rate = self.setup.gradient::<D>() / DURATION;
            let moment = |x: &[f64; D]| {
                SMatrix::from_fn(|i, j| rate[(i, j)] * second_moment(self.setup.basis(), x[j] / h) * h * h)
            };
            particles.affine = particles.position.iter().map(moment).collect();
        }
        let pull = self.setup.ways::<D>()[0].map(|way| 2.0 * way / DURATION.powi(2));
        let scene = Scene::new(Grid::new(h, ways.map(axis))?, Bodies::new(self.law, particles)?);
        self.setup.moving(scene.load(Gravity(Box::new(move |_| pull))), self.dt, self.setup.damping)
    }

    fn row(&self, seen: &mut Rows, phase: &mut Phase<D>) -> Result<Row, Fault> {
        seen.sample(phase, [STEPS, STEPS], |run| {
            let [displacement, _, _] = self.errors(run);
            row! {
                "time (s)": run.time(),
                "displacement_error (-)": if run.time() > 0.0 { displacement } else { 0.0 },
                "kinetic_energy (J)": run.totals().kinetic_energy,
            }
        })
    }

    fn progress(&self, _: &Rows, phase: &Phase<D>) -> f64 {
        phase.share_of(STEPS)
    }

    fn particles<'a>(&self, _: &Rows, columns: Columns<'a, D>) -> Columns<'a, D> {
        columns.velocities().each("mean_stress", "Pa", |p, k| p.stress[k].mean()).jacobian()
    }

    fn metrics(&self, _: &Rows, phase: &mut Phase<D>) -> Vec<(Metric, f64)> {
        let [displacement, velocity, stress] = self.errors(phase.run.as_mut());
        let totals = phase.run.totals();
        let half_size = 0.5 / self.setup.ppc_per_direction as f64;
        let stable = stable_cfl(self.setup.basis(), D, half_size).unwrap_or(f64::NAN);
        let mut values = vec![(DISPLACEMENT_ERROR, displacement), (VELOCITY_ERROR, velocity), (MASS, totals.mass)];
        if self.setup.strain > 0.0 {
            values.extend([(STRESS_ERROR, stress), (STRAIN_OF_WAVES, 2.0 * (WAVES / stable).powi(2))]);
        } else if self.setup.damping > 0.0 {
            // The work of damping (J), exactly: α ρ V g of the way that the velocities before each step make.
            let [speed, pull] = self.setup.ways::<D>();
            let lag = 2.0 * self.dt / DURATION;
            let work = |a: usize| 2.0 * speed[a] / DURATION.powi(2) * (speed[a] + pull[a] - lag * pull[a]);
            let exact = self.setup.damping * totals.mass * (0..D).map(work).sum::<f64>();
            values.push((DAMPED_RATIO, totals.accumulated.damping / exact));
        }
        values
    }
}
