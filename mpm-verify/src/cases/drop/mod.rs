//! An elastic block that falls on a floor with friction, at an angle, and bounces.

mod run;

use crate::cases::prelude::*;

/// Slant above which a block slips all the time, and share of its impulse until the sticks have given way.
const SLIPS: f64 = 4.0;
const YIELDS: f64 = 0.02;

choices! {
    enum StepFactor { One = "1", Ten = "10", Thirty = "30" }
}

parameters! {
    struct Drop {
        speed: f64 = real("-", "0.02", 1e-4, 0.3), "speed at which the block falls, over that of waves";
        slant: f64 = real("-", "1", -10.0, 10.0), "speed along the floor over that";
        friction: f64 = real("-", "0.3", 0.0, 10.0), "coefficient of friction";
        stiffness: f64 = real("-", "1", 1e-3, 1e4), "stiffness of the barrier over that which carries the stress of the impact, ρ c v, at half of its distance";
        cfl: f64 = common::CFL.with_default("0.2"), "CFL number c Δt / h of pressure waves, explicit; times step_factor of implicit steps";
        step_factor: StepFactor = StepFactor::One.by_default(), "implicit: time step over that of the CFL number; explicit: 1";
        lumped: f64 = common::LUMPED;
        alpha: f64 = common::ALPHA;
        delta: f64 = common::DELTA;
        tolerance: f64 = common::TOLERANCE;
        ppc_per_direction: usize = common::PPC_PER_DIRECTION;
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.3");
    }
}

metrics! { ALL:
    ENERGY_GAIN = "energy_gain", "-", "largest rise of kinetic and stored energy over the kinetic energy at the start, the barrier's left out, which is not negative";
    ENERGY_END = "energy_end", "-", "kinetic and stored energy at the end, over the same";
    STORED_MOST = "stored_most", "-", "most of the stored energy, over the same";
    LEAST_GAP = "least_gap", "-", "least gap of a particle over the distance at which the barrier begins";
    COULOMB_EXCESS = "coulomb_excess", "-", "most by which the force along the floor exceeds μ times the one across it, over the greatest force across it";
    FRICTION_RATIO = "friction_ratio", "-", "impulse along the floor over that across it, over μ";
    MOMENTUM_ERROR = "momentum_error", "-", "largest change of the momentum of body and floor together, over that of the body at the start; 10⁻¹² if it is less";
    RESTITUTION = "restitution", "-", "speed at which the block leaves the floor at the end over that of its fall";
    SPIN = "spin", "-", "speed of turning at the end, of the middle of a side, over that of the fall";
    NEWTON_ITERATIONS = "newton_iterations", "-", "implicit: Newton iterations of all steps";
}

pub(super) fn case() -> Case {
    Case::of::<2, run::Falling>("drop", "A block bounces", ALL)
        .planned(plan())
        .described("An elastic block falls on a floor with a barrier and friction, at an angle, and bounces: no energy is gained, no gap \
            closes, friction is Coulomb's, over the barrier's stiffness and the step.")
        .reference("Conservation of momentum and energy, Coulomb's law.")
        .limit("No exact solution of the bounce: what is kept and bounded is judged.")
        .wanted("friction", "impulse along the floor over that across it", "slides")
        .checks(checks())
        .headline(ENERGY_GAIN, "energy gain (–)", 1.0, 5)
        .headline(ENERGY_END, "at the end (–)", 1.0, 4)
        .headline(LEAST_GAP, "least gap (–)", 1.0, 3)
        .headline(FRICTION_RATIO, "friction over μN (–)", 1.0, 3)
        .headline(RESTITUTION, "restitution (–)", 1.0, 3)
        .headline(SPIN, "spin (–)", 1.0, 3)
        .watched(&["kinetic_energy", "force_across"])
        .sketch(sketch())
        .cost(|spec| 1e-3 * spec.level.h.powi(-2))
        .table(ResultTable::of("drop", |r| {
                let is_of_smooth_functions = matches!(r.basis(), Gimp | Bspline2);
                r.level == "n8" && is_of_smooth_functions && r.remedy() == RemedyName::None
            })
            .by(&[SCHEME, SET])
            .metric("energy gain", ENERGY_GAIN, SHORT)
            .metric("at the end", ENERGY_END, share(1))
            .metric("least gap", LEAST_GAP, fixed(3))
            .metric("impulse along over μ across", FRICTION_RATIO, fixed(3))
            .metric("restitution", RESTITUTION, fixed(3))
            .metric("spin", SPIN, fixed(3)))
        .breaks_down(|r| {
            let soft = Setup::<Drop>::number_of(r, |b| b.stiffness) < 0.1;
            let explicit = r.scheme().rule().is_none();
            (soft && explicit)
                .then_some("a barrier that a step passes: the gap at its end is closed, and the program says so")
        })
}

fn plan() -> Plan {
    use TransferName::{Apic, Xpic2};
    let none = RemedyName::None;
    let mut explicit = pairs(&[Gimp, Bspline2, Bspline3], &[none, FbarConsistent]);
    explicit.extend([Apic, Xpic2].map(|t| Scheme::explicit(Gimp, none, t)));
    let slow = implicit(&[RuleName::Midpoint, RuleName::Newmark], &[Gimp, Bspline2], &[none]);
    let mut plan = Plan::of(levels(1.0, [("n8", 8.0), ("n16", 16.0)]))
        .runs(Quick, "n8", &explicit[..1], "")
        .each(Pr, "n8", &explicit, ["", "slant=5", "stiffness=10"])
        .each(Pr, "n8", &slow, ["step_factor=10", "step_factor=10 stiffness=100"])
        .each(Nightly, "n8", &explicit, ["stiffness=0.01", "slant=0", "speed=0.1"]);
    for set in ["", "slant=5", "stiffness=10"] {
        plan = plan.runs(Nightly, "n16", &explicit, set).runs(Nightly, "n8", &slow, set);
    }
    plan.runs(Nightly, "n8", &slow, "step_factor=30").runs(Nightly, "n16", &slow, "step_factor=10")
}

fn sketch() -> Sketch {
    let (side, up) = (0.5, 0.25);
    Sketch::of("A block of 0.5 m that moves towards a floor at an angle.")
        .body([[0.0, up], [side, up], [side, up + side], [0.0, up + side]])
        .load([0.25, up + 0.3], [0.45, up + 0.1])
        .held([-0.2, 0.0], [1.0, 0.0])
        .length([0.0, up + side + 0.08], [side, up + side + 0.08], "0.5 m")
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Drop>;
    vec![
        Check::truth("open", "gap of every particle positive at all times")
            .above(LEAST_GAP, |_| 0.0)
            .because("the barrier's energy is infinite at a closed gap"),
        Check::truth("coulomb", "tangential force of the floor at most μ times the normal one, in every step, to rounding")
            .at_most(COULOMB_EXCESS, |_| ROUNDING)
            .because("every stick is returned to μN"),
        Check::truth("momentum", "explicit and midpoint: momentum lost by the block gained by the floor, to rounding, in implicit steps within Newton's residual")
            .when(|b| b.rule() != Some(RuleName::Newmark))
            .at_most(MOMENTUM_ERROR, |b| {
                let left = if b.is_implicit() { b.tolerance * b.record.work.steps as f64 } else { 0.0 };
                ROUNDING + left
            })
            .because("weights sum to one and their gradients to zero"),
        Check::truth("no-energy-gain", "midpoint, and explicit without musl: kinetic and stored energy never exceed their start, explicit by more than the stored energy times the CFL number")
            .when(|b| b.rule() != Some(RuleName::Newmark) && b.transfer() != TransferName::Musl)
            .at_most(ENERGY_GAIN, |b| {
                let offset = if b.is_implicit() { ROUNDING } else { b.cfl * b.metric(STORED_MOST) };
                offset + ROUNDING
            })
            .because("barrier and sticks give what they were given, and sliding takes; velocities live half a step before places"),
        Check::truth("slides", "tangential velocity four times the normal one: tangential impulse μ times the normal one, within a fiftieth for sticks before slip")
            .when(|b| b.slant.abs() >= SLIPS)
            .within(FRICTION_RATIO, |_| 1.0, |_| YIELDS)
            .because("Coulomb: a block that slips all the time"),
    ]
}
