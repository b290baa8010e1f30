//! Two elastic discs that collide: the dynamic case of the implicit paper.
//!
//! Section 3.2 of Wang, Vardon, Hicks & Chen (2016).

mod run;

use crate::cases::prelude::*;
use run::{AT_SPEED, IN_CONTACT};

use RuleName::{Midpoint, Newmark};
use TransferName::{Apic, Flip, Musl, Xpic2};

/// Radius and centres (m) of the discs.
const RADIUS: f64 = 0.2;
const CENTRES: [[f64; 2]; 2] = [[0.2, 0.2], [0.8, 0.8]];
/// Roundings of a step's sum of forces, in shares of the discs' momentum.
const ROUNDINGS: f64 = 16.0;
/// Least gain of a rule that does not conserve energy.
const GAINED: f64 = 1e-3;
/// Rounding after its growth in the collision.
const MIRRORED: f64 = 1e-6;
/// Share of the impulse in a step from which on a collision is not resolved: five steps of the effective contact.
const RESOLVED: f64 = 0.2;
/// Range of the mean stress that is drawn (Pa).
const STRESS_RANGE: f64 = 100.0;

choices! {
    enum StepFactor { One = "1", Ten = "10", Hundred = "100" }
    /// How the discs meet: on the nodes that both see, or as bodies that slide on each other.
    enum Contact { Grid = "grid", Bodies = "bodies" }
}

impl StepFactor {
    fn value(self) -> f64 {
        [1.0, 10.0, 100.0][self as usize]
    }
}

parameters! {
    struct Discs {
        young_modulus: f64 = common::YOUNG_MODULUS.with_default("1e5");
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.3");
        speed: f64 = real("m/s", "0.005", 1e-4, 1.0),
            "each component of the velocities, of opposite signs; the run lasts 37.5 s at 0.005 m/s, less in proportion, and at least until discs part";
        offset: f64 = real("m", "0", 0.0, 0.8), "distance of the lines on which the discs' centres fly; beyond 0.4 the discs don't touch";
        step_factor: StepFactor = StepFactor::One.by_default(), "time step over 2.5 ms at h = 0.05 m, and in proportion to h; explicit: 1";
        contact: Contact = Contact::Grid.by_default(), "how discs meet: on the nodes that both see, or as bodies with a velocity field each, without friction (explicit)";
        flip: f64 = common::FLIP;
        lumped: f64 = common::LUMPED;
        alpha: f64 = common::ALPHA;
        delta: f64 = common::DELTA;
        tolerance: f64 = common::TOLERANCE;
        ppc_per_direction: usize = common::PPC_PER_DIRECTION;
        wall: common::Wall = common::WALL;
    }
}

metrics! { ALL:
    ENERGY_GAIN = "energy_gain", "-", "largest rise of kinetic and stored energy over their start, relative to it";
    ENERGY_LOSS = "energy_loss", "-", "largest fall of kinetic and stored energy below their start, relative to it";
    ENERGY_END = "energy_end", "-", "rise of kinetic and stored energy at the end over their start, relative to it";
    ENERGY_ERROR_ACCUMULATED = "energy_error_accumulated", "-",
        "largest distance from the start of kinetic energy and accumulated stress work, the paper's Eqs. (34) to (36), relative to it";
    LUMPING_LOSS = "lumping_loss", "-", "midpoint: what particles don't take of the nodes' kinetic energy as part of the mass is lumped, over the energy at the start";
    NODE_ENERGY_GAP = "node_energy_gap", "-", "largest kinetic energy that particles have beyond their nodes, over the energy at the start";
    MOMENTUM_ERROR = "momentum_error", "-", "largest change of the linear momentum, over the sum of its magnitudes at the start; 10⁻¹² if it is less, which no golden should hold";
    ANGULAR_MOMENTUM_ERROR = "angular_momentum_error", "-",
        "largest change of the angular momentum about the centre, that of affine parts with it, over that sum times 0.4 m; 10⁻¹² if it is less";
    ENERGY_EXCHANGED = "energy_exchanged", "-", "largest change of the stored energy in a step, over the energy at the start";
    RESTITUTION = "restitution", "-", "speed at which the discs' centres of mass move against each other at the end, over that at the start";
    DEFLECTION = "deflection", "-", "change of the velocity at which they do, over its start: 2 of discs that bounce back, 0 of discs that miss each other";
    IMPULSE_OF_A_STEP = "impulse_of_a_step", "-", "largest change of that velocity in a step over the change of the whole run, or its start if more: one over the steps of a contact";
    FREE_UNTIL = "free_until", "s", "last time at which no node would see both discs if they flew freely, or no rims touch (bodies), if they ever meet";
    FLIGHT_ERROR = "flight_error", "-", "until then, or to the end, the largest change of a particle's velocity, over its speed; 10⁻¹² if it is less";
    FLIGHT_STRAIN = "flight_strain", "-", "largest |J − 1| of a particle over the same time; 10⁻¹² if it is less";
    ASYMMETRY = "asymmetry", "-", "largest distance at the end of a particle from where its mirror image about the centre is, over the radius; 10⁻⁹ if it is less";
    CLOSEST = "closest", "m", "least distance of the discs' centres of mass";
    NEWTON_ITERATIONS = "newton_iterations", "-", "Newton iterations of all steps";
    MASS = "mass", "kg/m", "mass of both discs";
}

pub(super) fn case() -> Case {
    Case::of::<2, run::Collision>("discs", "Two discs that collide", ALL)
        .planned(plan())
        .described("Two elastic discs meet in the middle of a square, touch through the grid and fly apart: the case by which the \
            implicit paper shows its dynamics. The midpoint rule keeps energy at a hundred times the explicit step; \
            the paper's Newmark rule gains it. Explicit steps with every transfer, head on, oblique, grazing, and past each other.")
        .reference("Conservation of mass, momentum and energy, and the symmetry of the scene.")
        .reference("Exact: free flight, until a function sees both discs, or, as bodies, until rims touch.")
        .limit("Through the grid discs touch cells before their rims do: they stick, and part when their functions do.")
        .limit("No exact solution of the collision: energy and momentum are judged, not the motion.")
        .wanted("flight", "velocity and volume of every particle before the impact", "free-flight")
        .missed_by("touches-through-the-grid")
        .wanted("rebound", "relative velocity after the impact", "restitution turned")
        .missed_by("unresolved-contact")
        .where_referenced()
        .checks(checks())
        .headline(ENERGY_GAIN, "energy gain (%)", 100.0, 4)
        .headline(ENERGY_LOSS, "loss (%)", 100.0, 4)
        .headline(ENERGY_END, "end (%)", 100.0, 4)
        .headline(ENERGY_ERROR_ACCUMULATED, "accumulated (%)", 100.0, 4)
        .headline(LUMPING_LOSS, "lumped mass took (%)", 100.0, 4)
        .headline(MOMENTUM_ERROR, "momentum error (–)", 1.0, 14)
        .headline(ANGULAR_MOMENTUM_ERROR, "angular momentum error (–)", 1.0, 6)
        .headline(RESTITUTION, "parting over meeting speed (–)", 1.0, 3)
        .headline(DEFLECTION, "velocity changed by (–)", 1.0, 3)
        .headline(FREE_UNTIL, "free until (s)", 1.0, 1)
        .watched(&["energy_change", "distance"])
        .sketch(sketch())
        .cost(|spec| {
            let steps = Pair::of_plan(spec).map_or(0, |setup| setup.timing().1);
            let a_step = if matches!(spec.scheme, Scheme::Explicit(_)) { 1e-5 } else { 1e-3 };
            a_step * steps as f64 * (0.05 / spec.level.h).powi(2)
        })
        .pictures(|gallery| energies(gallery).and_then(|()| contact(gallery)))
        .tables(tables())
        .breaks_down(|r| match r.scheme() {
            Scheme::Explicit(e) if e.basis == Linear && e.transfer == Flip => {
                Some("a particle that enters a cell meets nodes with hardly any mass, which its stress throws ahead")
            }
            Scheme::Implicit(_) if Pair::number_of(r, |d| d.lumped) == 0.0 => {
                Some("a consistent mass is singular where a function sees few particles")
            }
            _ => None,
        })
}

type Pair = Setup<Discs>;

fn plan() -> Plan {
    let none = RemedyName::None;
    let plain = |basis, transfer| Scheme::explicit(basis, none, transfer);
    let explicit = [Gimp, Bspline2].map(|b| Scheme::flip(b, none));
    // Linear functions with FLIP break down at once and are left to the night.
    let all: Vec<Scheme> = [
        [Flip, Musl].map(|t| plain(Linear, t)).to_vec(),
        [Flip, Apic, Xpic2, Musl].map(|t| plain(Gimp, t)).to_vec(),
        [Flip, Apic, Xpic2].map(|t| plain(Bspline2, t)).to_vec(),
        vec![Scheme::flip(Gimp, FbarConsistent)],
    ]
    .concat();
    let blended = [Linear, Gimp, Bspline2].map(|b| Scheme::flip(b, none));
    let slow = |rules: &[RuleName]| implicit(rules, &[Gimp, Linear, Bspline2], &[none]);
    let (both, midpoint) = (slow(&[Midpoint, Newmark]), slow(&[Midpoint]));
    let bodies = ["", " offset=0.1", " offset=0.4", " offset=0.5"].map(|set| format!("contact=bodies{set}"));
    // Offsets: oblique 0.1 m; grazing 0.4 m, where rims would just touch; missing 0.65 m, beyond the reach of all functions.
    Plan::of([("h0.05", 0.05), ("h0.025", 0.025)].map(|(name, h)| Level { name, h }))
        .runs(Pr, "h0.05", &explicit, "")
        .runs(Quick, "h0.05", &both[..1], "step_factor=100")
        .runs(Pr, "h0.05", &both, "step_factor=100")
        .runs(Pr, "h0.05", &[plain(Gimp, Apic)], "offset=0.1")
        .each(Pr, "h0.05", &explicit[1..], ["offset=0.4", "contact=bodies offset=0.5 speed=0.1"])
        .runs(Pr, "h0.05", &explicit[..1], "contact=bodies speed=0.1")
        .runs(Pr, "h0.05", &[plain(Linear, Musl)], "offset=0.65")
        .each(Nightly, "h0.05 h0.025", &all, ["", "offset=0.4"])
        .each(Nightly, "h0.05", &both, ["offset=0.1 step_factor=100", "step_factor=10", "offset=0.1 step_factor=10"])
        .runs(Long, "h0.05", &both, "")
        .runs(Nightly, "h0.025", &both, "step_factor=100")
        // The speed of the paper's Figure 5, and steps as long as the contact.
        .runs(Pr, "h0.05", &[plain(Linear, Musl), plain(Gimp, Flip)], "speed=1")
        .runs(Pr, "h0.05", &both[..1], "speed=1 step_factor=10")
        .each(Nightly, "h0.05", &both, ["speed=1", "speed=1 step_factor=10", "speed=0.1 step_factor=100"])
        .each(Nightly, "h0.05", &both, ["speed=0.1", "speed=0.1 step_factor=10", "speed=0.02 step_factor=100"])
        .each(Nightly, "h0.05", &midpoint, ["1", "0.03", "0"].map(|b| format!("lumped={b} step_factor=100")))
        .each(Nightly, "h0.05", &midpoint, ["1", "0.03"].map(|b| format!("lumped={b} offset=0.1 step_factor=100")))
        .each(Nightly, "h0.05", &all, ["offset=0.1", "offset=0.5", "offset=0.65"])
        .each(Nightly, "h0.05", &blended, ["flip=0.99", "flip=0", "flip=0.99 offset=0.1", "flip=0 offset=0.1"])
        .each(Nightly, "h0.05", &explicit, bodies)
}

fn sketch() -> Sketch {
    let [a, b] = CENTRES;
    Sketch::of("Two discs of 0.4 m in diameter on a diagonal of a square of 1 m fly towards each other.")
        .disc(a, RADIUS)
        .disc(b, RADIUS)
        .load(a, a.map(|x| x + 0.12))
        .load(b, b.map(|x| x - 0.12))
        .note([0.62, 0.2], "0.005 m/s")
        .length([0.0, -0.08], [2.0 * RADIUS, -0.08], "0.4 m")
}

impl Run<'_, Discs> {
    fn rounding(&self) -> f64 {
        (self.steps() * ROUNDINGS * f64::EPSILON).max(1e-12)
    }

    fn steps(&self) -> f64 {
        self.record.work.steps as f64
    }

    /// Whether the collision takes at least five steps.
    fn is_resolved(&self) -> bool {
        self.metric(IMPULSE_OF_A_STEP).max(0.0) <= RESOLVED
    }

    fn is_head_on(&self) -> bool {
        self.offset == 0.0
    }

    /// Whether linear functions cross faces under stress, on fine cells or fast: each face is a jump.
    fn jumps(&self) -> bool {
        self.basis() == Linear && (self.level == "h0.025" || self.speed > AT_SPEED)
    }

    fn is_of(&self, rule: RuleName) -> bool {
        self.rule() == Some(rule)
    }
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Discs>;
    type Demand = crate::demand::Demand<Discs>;
    vec![
        Check::bookkeeping("mass", "mass of every particle that of its share of a cell, to rounding")
            .within(MASS, |d| d.mass_of(d.record.work.particles, d.record.discretisation.ppc), |d| d.record.work.particles as f64 * f64::EPSILON * d.mass_of(d.record.work.particles, d.record.discretisation.ppc))
            .because("density times the volume that is seeded; each of n sums rounds once"),
        Check::truth("momentum", "all: linear momentum constant within the rounding of every step, with newmark within Newton's residual")
            .at_most(MOMENTUM_ERROR, |d| {
                let left = if d.is_of(Newmark) { d.tolerance } else { 0.0 };
                (d.steps() * (ROUNDINGS * f64::EPSILON + left)).max(1e-12)
            })
            .because("internal forces sum to zero, as the functions sum to one"),
        Check::truth("no-energy-gain", "midpoint, β above 0, head on, contact of five steps, not fast or fine linear functions: energy exceeds its start by at most 10⁻⁴")
            .when(|d| d.is_of(Midpoint) && d.is_head_on() && d.lumped > 0.0 && !d.jumps())
            .except(|d| !d.is_resolved(), "a step takes more than a fifth of the impulse")
            .at_most(ENERGY_GAIN, |_| NO_GAIN)
            .because("a lumped share takes energy, the rule gives none: docs/implicit.md"),
        Check::known_limit("linear-gains", "midpoint with linear functions at h = 0.025 m, 0.005 m/s and 100 times the explicit step, head on: energy exceeds its start by more than 10⁻⁴")
            .when(|d| d.is_of(Midpoint) && d.step_factor == StepFactor::Hundred && d.is_head_on() && d.jumps() && d.speed == AT_SPEED)
            .above(ENERGY_GAIN, |_| NO_GAIN)
            .because("gradients that jump at faces, where a step ends by chance"),
        Check::known_limit("newmark-gains", "newmark head on at 0.005 m/s and 100 steps (not linear, h = 0.025 m), linear and GIMP at 10: energy exceeds its start by more than 10⁻³")
            .when(|d| {
                let long = match d.step_factor {
                    StepFactor::One => false,
                    StepFactor::Ten => d.basis() != Bspline2,
                    StepFactor::Hundred => true,
                };
                d.is_of(Newmark) && !d.jumps() && long && d.is_head_on() && d.speed == AT_SPEED
            })
            .above(ENERGY_GAIN, |_| GAINED)
            .because("equilibrium at the end of the step with velocities of another place"),
        Check::truth("mirror", "all but linear functions, whose gradients jump at random by rounding: particles stay mirror images about the centre")
            .when(|d| d.basis() != Linear)
            .at_most(ASYMMETRY, |_| MIRRORED)
            .because("the scene and the lattice are; rounding grows in the collision"),
        Check::truth("free-flight", "explicit: velocity (to rounding) and volume of every particle constant until a function sees both discs")
            .when(|d| d.is_explicit())
            .each([FLIGHT_ERROR, FLIGHT_STRAIN].map(|metric| Demand::at_most(metric, |d| d.rounding())))
            .because("functions sum to one and their slopes to zero: a uniform motion has no strain and no force"),
        Check::truth("exchange", "explicit, not musl: kinetic and stored energy exceed their start by at most half the change of the stored one in a step")
            .when(|d| d.is_explicit() && d.transfer() != Musl)
            .at_most(ENERGY_GAIN, |d| 0.5 * d.metric(ENERGY_EXCHANGED) + d.rounding())
            .because("velocities live half a step before places, and transfers only take"),
        Check::truth("restitution", "explicit: the discs part no faster than they met, within the energy exchanged in a step")
            .when(|d| d.is_explicit())
            .at_most(RESTITUTION, |d| 1.0 + 0.5 * d.metric(ENERGY_EXCHANGED) + d.rounding())
            .because("the motion of the centres of mass is part of the energy"),
        Check::truth("turned", "head on: each disc turns back, the relative velocity changes by more than its start")
            .when(|d| d.is_head_on())
            .above(DEFLECTION, |_| 1.0)
            .because("neither disc can pass through the other"),
        Check::known_limit("unresolved-contact", "midpoint, and newmark where it is, over a fifth of the impulse in a step: discs part below 0.96 of their closing speed")
            .when(|d| d.is_of(Midpoint) || d.is_of(Newmark) && d.metric(RESTITUTION) < 1.0 - RESOLVED.powi(2))
            .when(|d| !d.is_resolved())
            .at_most(RESTITUTION, |_| 1.0 - RESOLVED.powi(2))
            .because("of a contact of half a sine the last step misses a share κ² of the impulse, with κ that of the largest step"),
        Check::truth("affine-keeps-angular-momentum", "apic: angular momentum, with that of the affine parts, constant to rounding")
            .when(|d| d.transfer() == Apic)
            .at_most(ANGULAR_MOMENTUM_ERROR, |d| d.rounding())
            .because("the affine part carries what a node's arm has, and stresses are symmetric: docs/spin.md"),
        Check::truth("no-spin", "explicit, head on, all but linear functions: angular momentum zero")
            .when(|d| d.is_explicit() && d.is_head_on() && d.basis() != Linear)
            .at_most(ANGULAR_MOMENTUM_ERROR, |_| MIRRORED)
            .because("the scene is its own image in the line of motion, which turns angular momentum round"),
        Check::truth("past-each-other", "explicit, discs that never meet: velocity against each other constant to rounding")
            .when(|d| d.is_explicit() && d.offset > 0.0 && !d.metric(FREE_UNTIL).is_finite())
            .at_most(DEFLECTION, |d| d.rounding())
            .because("nothing acts on discs that fly freely"),
        Check::known_limit("touches-through-the-grid", "explicit, discs that pass within reach of the functions without touching: a hundredth or more of their velocity turned or lost")
            .when(|d| d.is_explicit() && d.contact == Contact::Grid && d.offset >= 2.0 * RADIUS && d.metric(FREE_UNTIL).is_finite())
            .above(DEFLECTION, |_| 0.01)
            .because("nodes that see both have one velocity"),
        Check::truth("newton", "implicit: at most 7 Newton iterations a step, 3 to reach quadratic convergence, 4 from 10⁻¹ to the tolerance")
            .when(|d| d.is_implicit())
            .at_most(NEWTON_ITERATIONS, |d| 7.0 * d.steps())
            .because("quadratic convergence with the exact tangent"),
    ]
}

fn tables() -> Vec<ResultTable> {
    const SHARE: Label = ("η", |r| Pair::number_of(r, |d| d.flip).to_string());
    const CONTACT: Label = ("contact", |r| word(r, "contact", "grid"));
    const OFFSET: Label = ("offset (m)", |r| Pair::number_of(r, |d| d.offset).to_string());
    const LUMPED: Label = ("β", |r| Pair::number_of(r, |d| d.lumped).to_string());
    const SPEED: Label = ("speed (m/s)", |r| Pair::number_of(r, |d| d.speed).to_string());
    const STEP: Label = ("Δt / 2.5 ms", |r| Pair::number_of(r, |d| d.step_factor.value()).to_string());
    let at = |offset: f64| move |r: &Record| Pair::number_of(r, |d| d.offset) == offset;
    let is_explicit = |r: &Record| matches!(r.scheme(), Scheme::Explicit(_)) && r.changes_none_but(&["offset", "flip"]);
    // Energy over the time step.
    let over_steps = |name: &str, offset: f64| {
        let columns = [1.0, 10.0, 100.0].into_iter().flat_map(|factor| {
            let of = move |r: &Record| Pair::number_of(r, |d| d.step_factor.value()) == factor;
            [
                Column::metric(format!("gain, {factor} Δt"), ENERGY_GAIN, percent(3)).of(of),
                Column::metric("loss", ENERGY_LOSS, percent(3)).of(of),
            ]
        });
        let shows = move |r: &Record| at(offset)(r) && r.changes_none_but(&["step_factor", "offset"]);
        ResultTable::new(name, shows, &[SCHEME], columns)
    };
    let long = |r: &Record| {
        Pair::number_of(r, |d| d.step_factor.value()) == 100.0
            && r.changes_none_but(&["step_factor", "offset", "lumped"])
    };
    let explicit = [0.0, 0.1].into_iter().flat_map(|offset| {
        [
            Column::metric(format!("energy, {offset} m"), ENERGY_END, percent(2)).of(at(offset)),
            Column::metric("speed", RESTITUTION, fixed(3)).of(at(offset)),
        ]
    });
    let passing = [0.4, 0.5, 0.65].into_iter().flat_map(|offset| {
        [
            Column::metric(format!("free until, {offset} m"), FREE_UNTIL, fixed(1)).of(at(offset)),
            Column::metric("velocity changed by", DEFLECTION, SHORT).of(at(offset)),
        ]
    });
    vec![
        over_steps("discs-head-on", 0.0),
        over_steps("discs-offset", 0.1),
        ResultTable::of("discs-balance", long)
            .by(&[SCHEME, OFFSET, LUMPED])
            .metric("energy at the end", ENERGY_END, percent(3))
            .metric("lumped mass took", LUMPING_LOSS, percent(3))
            .metric("accumulated energy off by", ENERGY_ERROR_ACCUMULATED, percent(3))
            .metric("angular momentum off by", ANGULAR_MOMENTUM_ERROR, SHORT)
            .metric("linear momentum off by", MOMENTUM_ERROR, SHORT),
        ResultTable::of("discs-speeds", |r| {
            let fast =
                Pair::number_of(r, |d| d.speed) > AT_SPEED || Pair::number_of(r, |d| d.step_factor.value()) == 100.0;
            fast && r.level == "h0.05" && r.changes_none_but(&["speed", "step_factor"])
        })
        .by(&[SCHEME, SPEED, STEP])
        .metric("largest share of the impulse in a step", IMPULSE_OF_A_STEP, fixed(3))
        .metric("gain", ENERGY_GAIN, percent(3))
        .metric("loss", ENERGY_LOSS, percent(3))
        .metric("parting over meeting speed", RESTITUTION, fixed(3))
        .metric("velocity changed by", DEFLECTION, fixed(3)),
        ResultTable::of("discs-explicit", move |r| is_explicit(r) && r.level == "h0.05")
            .by(&[SCHEME, SHARE])
            .columns(explicit)
            .column(Column::metric("angular momentum off by, 0.1 m", ANGULAR_MOMENTUM_ERROR, SHORT).of(at(0.1))),
        ResultTable::of("discs-passing", |r| {
            Pair::number_of(r, |d| d.offset) >= 0.4 && r.changes_none_but(&["offset", "contact"])
        })
        .by(&[SCHEME, CONTACT, LEVEL])
        .columns(passing),
    ]
}

/// Energy over time: the paper's Figure 6, a panel a time step.
fn energies(gallery: &mut Gallery) -> Result<(), Error> {
    // Explicit runs are drawn with FLIP, and with MUSL where that breaks down.
    let is_drawn = |r: &Record| match r.transfer() {
        Flip | TransferName::None => true,
        Musl => r.basis() == Linear,
        Apic | Xpic2 => false,
    };
    let panel = |factor: f64| {
        let own = move |r: &&Record| {
            let plain = r.status == Status::Ok && r.level == "h0.05" && r.remedy() == RemedyName::None;
            let steps = Pair::number_of(r, |d| d.step_factor.value()) == factor && r.changes_none_but(&["step_factor"]);
            plain && steps && is_drawn(r)
        };
        let panel =
            Panel::new(format!("{factor} × 2.5 ms"), ["time (s)", "change of the energy (%)"]).x_range(20.0, 37.5);
        let panel = panel.histories(gallery, gallery.records.iter().filter(own), |_, t| {
            t.pairs(["time", "energy_change"], |t, e| (t, 100.0 * e))
        })?;
        Ok(panel.by_run(|r, curve| Series {
            name: format!("{} {}", r.scheme().solver(), r.basis()),
            colour: r.basis() as usize,
            dash: match r.scheme().solver() {
                "midpoint" => Dash::Solid,
                "newmark" => Dash::Dashed,
                _ => Dash::Dotted,
            },
            ..curve
        }))
    };
    let panels = [1.0, 10.0, 100.0].map(panel).into_iter().collect::<Result<Vec<_>, Error>>()?;
    let caption = "Kinetic and stored energy over the start; the paper's Figure 6 shows its accumulated one. Newmark's rule gains while the discs touch.";
    Figure::new("energy", caption, panels).draw(gallery)
}

/// The discs pressed together: the paper's Figure 5.
fn contact(gallery: &mut Gallery) -> Result<(), Error> {
    /// Time between rows at the paper's speed (s).
    const ROW: f64 = 0.25;
    let mut panels = Vec::new();
    for basis in [Linear, Gimp, Bspline2] {
        let own = |r: &&Record| {
            let plain = r.status == Status::Ok && r.changes_none_but(&["step_factor"]);
            plain && r.basis() == basis && r.scheme().solver() == "midpoint"
        };
        let Some(record) = gallery.records.iter().find(own) else { continue };
        let Some(table) = gallery.snapshot(record, IN_CONTACT as f64 * ROW)? else { continue };
        panels.push(field_panel(record, &table, basis.to_string(), "mean_stress"));
    }
    let [[lo, _], [hi, _]] = CENTRES;
    let window = (lo - 1.05 * RADIUS, hi + 1.05 * RADIUS);
    Fields::new(panels, "mean stress (Pa)", (-STRESS_RANGE, STRESS_RANGE))
        .columns(3)
        .within((window, window))
        .draw(gallery, "contact", "The discs at 23.75 s, when they have come to rest against each other, with the midpoint rule; the paper's Figure 5.")
}
