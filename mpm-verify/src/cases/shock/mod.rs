//! A bar that runs into a wall: the front behind which it rests, against Rankine and Hugoniot's conditions.

mod run;

use crate::cases::prelude::*;
use run::WAY;

/// Speed over that of waves up to which only rounding and cells disturb the exact state.
const WEAK: f64 = 0.5;
/// Cell size (m) down to which the filter of FLIP leaves most of the ringing alone.
const COARSE: f64 = 1.0 / 128.0;
const JUMPS: &str = "Rankine and Hugoniot; what is not lost rings, and moves the mean by ½ P″⟨δF²⟩";

parameters! {
    struct Shock {
        mach: f64 = real("-", "0.5", 0.01, 3.0), "speed of the bar over that of its waves";
        linear_viscosity: f64 = common::LINEAR_VISCOSITY;
        quadratic_viscosity: f64 = real("-", "0", 0.0, 10.0), "coefficient c₂ of the quadratic artificial viscosity: 2 makes a front five to ten cells wide";
        cfl: f64 = common::CFL.with_default("0.2");
        flip: f64 = common::FLIP;
        ppc_per_direction: usize = common::PPC_PER_DIRECTION;
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.3");
        wall: common::Wall = common::WALL;
    }
}

metrics! { ALL:
    SHOCK_SPEED_ERROR = "shock_speed_error", "-", "speed of the front through the material, over the last half of the run, over the exact one, less one";
    STRESS_ERROR = "stress_error", "-", "mean stress of the particles from a tenth to eight tenths of the way to the front at the end, over the exact one, less one";
    VELOCITY_ERROR = "velocity_error", "-", "their mean velocity, over that of the bar: exactly zero";
    WALL_FORCE_ERROR = "wall_force_error", "-", "momentum that the wall took in the last half of the run, over the exact one, less one";
    OVERSHOOT = "overshoot", "-", "largest of their stresses over the exact one, less one";
    RINGING = "ringing", "-", "rms of their stresses about the mean, over the exact one";
    ENERGY_LOSS = "energy_loss", "-", "kinetic and stored energy that is lost at the end, over that of the start; 0 if there is more";
    ENERGY_GAIN = "energy_gain", "-", "largest rise of kinetic and stored energy, over their start";
    ENERGY_LOSS_ERROR = "energy_loss_error", "-", "energy lost at the end over what the exact front has taken by then, less one";
    LOSS_RATE_ERROR = "loss_rate_error", "-", "with an artificial viscosity: rate at which energy is lost in the last half of the run, over that of the exact front, less one";
    JUMP_BOUND = "jump_bound", "-", "how far the mean stress can be off as the energy that should be lost rings, over the exact stress";
    FRONT_WIDTH = "front_width", "m", "with an artificial viscosity: how far apart in the undeformed bar a twentieth and nineteen twentieths of the jump are at the end";
    PREDICTED_WIDTH = "predicted_width", "m", "the same of the steady front that the viscosity makes";
    MASS = "mass", "kg/m²", "mass of the bar";
}

pub(super) fn case() -> Case {
    Case::of::<1, run::Bar>("shock", "A bar runs into a wall", ALL)
        .planned(plan())
        .described("A bar runs into a wall at a tenth to twice the speed of its waves and comes to rest behind a front, whose speed, \
            stress and loss of energy are exact.")
        .reference("Exact: Rankine and Hugoniot's conditions in uniaxial strain, exact/src/shock.rs.")
        .limit("Without an artificial viscosity what a front should take rings behind it: none is the default.")
        .wanted("front", "speed of the front", "shock-speed")
        .missed_by("recursion-smears averaged-hats-lose-stress rings weak-viscosity-rings")
        .wanted("stress", "mean stress behind the front, and momentum that the wall takes", "stress wall-force")
        .missed_by("front-missed recursion-smears averaged-hats-lose-stress rings weak-viscosity-rings")
        .checks(checks())
        .headline(SHOCK_SPEED_ERROR, "speed of the front (%)", 100.0, 2)
        .headline(STRESS_ERROR, "mean stress (%)", 100.0, 2)
        .headline(OVERSHOOT, "overshoot (%)", 100.0, 0)
        .headline(RINGING, "rings (%)", 100.0, 1)
        .headline(ENERGY_LOSS_ERROR, "energy lost, over the exact (%)", 100.0, 0)
        .headline(LOSS_RATE_ERROR, "rate of the loss (%)", 100.0, 1)
        .headline(FRONT_WIDTH, "width of the front (m)", 1.0, 4)
        .headline(PREDICTED_WIDTH, "predicted (m)", 1.0, 4)
        .watched(&["front", "kinetic_energy"])
        .sketch(Sketch::of("A bar of 1 m whose end touches a wall and which moves towards it.")
            .held([0.0, -0.1], [0.0, 0.2])
            .body([[0.0, 0.0], [1.0, 0.0], [1.0, 0.1], [0.0, 0.1]])
            .load([0.75, 0.05], [0.45, 0.05])
            .length([0.0, -0.08], [1.0, -0.08], "1 m"))
        .tables(tables())
        .breaks_down(|r| {
            let smeared = r.basis() == Linear && r.remedy() == FbarRecursive;
            let fine = r.discretisation.h < 0.01 && r.is_default();
            (smeared && fine)
                .then_some("under a pressure averaged hats are unstable at any step: docs/critical-step.md")
        })
}

fn plan() -> Plan {
    let none = RemedyName::None;
    let all = pairs(&BASES, &REMEDIES);
    let plain = pairs(&BASES, &[none]);
    let some = pairs(&BASES, &[none, FbarRecursive, FbarConsistent]);
    let sound = pairs(&BASES, &[none, FbarConsistent]);
    // Linear functions are left out: their stress fades as they cross cells.
    let viscous = pairs(&BASES[1..], &[none, FbarConsistent]);
    let weak = pairs(&BASES[1..], &[none]);
    // An artificial viscosity that takes the ringing, at three speeds, and a weak one that does not.
    let damped = "linear_viscosity=0.5 quadratic_viscosity=2";
    let [as_fast, twice] = [format!("mach=1 {damped}"), format!("mach=2 {damped}")];
    let slightly = "linear_viscosity=0.06 quadratic_viscosity=1.5";
    let twice_slightly = format!("mach=2 {slightly}");
    Plan::of(levels(1.0, [("n64", 64.0), ("n128", 128.0), ("n256", 256.0)]))
        .runs(Pr, "n64", &viscous, damped)
        .runs(Pr, "n64 n128", &viscous[..2], &twice)
        .runs(Pr, "n128", &weak[..1], &twice_slightly)
        .each(Nightly, "n64 n128 n256", &viscous, [damped, &as_fast, &twice])
        .each(Nightly, "n128 n256", &weak, [slightly, &twice_slightly])
        .runs(Quick, "n64", &plain[1..2], "")
        .runs(Pr, "n64", &all, "")
        .runs(Pr, "n64 n128", &plain, "")
        .runs(Nightly, "n64 n128 n256", &all, "")
        .runs(Pr, "n64", &plain, "mach=0.1")
        .runs(Pr, "n64", &sound, "mach=1")
        .runs(Nightly, "n64", &some, "mach=1")
        .runs(Pr, "n64", &sound, "mach=2")
        .runs(Nightly, "n64 n128", &some, "mach=0.1")
        .runs(Nightly, "n64 n128", &sound, "mach=1")
        .runs(Nightly, "n64 n128", &sound, "mach=2")
}

impl Run<'_, Shock> {
    /// Whether energy is to be kept.
    fn keeps(&self) -> bool {
        matches!(self.remedy(), RemedyName::None | FbarConsistent)
    }

    /// Whether the front is to be the exact one.
    fn is_sound(&self) -> bool {
        self.keeps() && self.basis() != Linear
    }

    /// Whether the front is slow and has no viscosity.
    fn is_weak(&self) -> bool {
        !self.is_viscous() && self.mach <= WEAK
    }

    /// Whether loss and width are to be those of the viscosity: four widths and more of the way are behind the front at the end,
    /// and functions resolve it.
    fn is_steady(&self) -> bool {
        let width = self.metric(PREDICTED_WIDTH);
        self.is_sound() && self.takes_ringing() && (self.support()..0.25 * WAY).contains(&width)
    }

    /// Largest error of the front over its tolerance.
    fn worst_miss(&self) -> f64 {
        let errors = [SHOCK_SPEED_ERROR, STRESS_ERROR, WALL_FORCE_ERROR].map(|metric| self.metric(metric).abs());
        errors.into_iter().fold(0.0, f64::max) / (2.0 * self.bound())
    }

    /// A cell over the way on which the front is measured, and the effect of ringing on the mean stress.
    fn bound(&self) -> f64 {
        let rings = if self.takes_ringing() { 0.0 } else { self.metric(JUMP_BOUND) };
        self.h / (0.5 * WAY) + rings
    }
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Shock>;
    // Half of the viscosity's front stays clear of the particles that are looked at behind it.
    let is_wide = |r: &Run<Shock>| r.metric(PREDICTED_WIDTH) > 2.0 * (1.0 - run::BEHIND[1]) * WAY;
    let wide = "the front is as wide as what is behind it";
    let narrow = |check: Check| check.except(is_wide, wide);
    let exact = |check: Check, metric| {
        narrow(check).within(metric, |_| 0.0, |r| 2.0 * r.bound()).of_scale(|_| 1.0).because(JUMPS)
    };
    vec![
        exact(
            Check::truth("shock-speed", "the front's speed is exact within two cells over the measured way and twice the effect of ringing on the stress"),
            SHOCK_SPEED_ERROR,
        ),
        exact(
            Check::truth("stress", "the mean stress behind the front is exact within the tolerance of shock-speed"),
            STRESS_ERROR,
        ),
        exact(
            Check::truth("wall-force", "the wall takes the exact momentum within the tolerance of shock-speed"),
            WALL_FORCE_ERROR,
        ),
        narrow(Check::truth("velocity", "mean velocity behind the front zero within a cell over the measured way and half the effect of ringing on the stress"))
            .when(|r| r.is_sound())
            .within(VELOCITY_ERROR, |_| 0.0, |r| r.bound())
            .of_scale(|_| 1.0)
            .because("the wall stops what comes"),
        Check::truth("no-energy-gain", "none and fbar-consistent: energy above its start by at most the CFL number times a cell of the bar")
            .when(|r| r.keeps())
            .at_most(ENERGY_GAIN, |r| r.cfl * r.h)
            .because("velocities live half a step before places, in the front alone"),
        exact(
            Check::truth("energy-loss", "as shock-speed, steady front, a linear artificial viscosity that damps the ringing: dissipated power exact within two cells over the measured way")
                .when(|r| r.is_steady()),
            LOSS_RATE_ERROR,
        ),
        Check::truth("front-width", "as energy-loss: the front has the width of the steady one within as many cells as functions have nodes")
            .when(|r| r.is_steady())
            .within(FRONT_WIDTH, |r| r.metric(PREDICTED_WIDTH), |r| r.support())
            .because("q bears what line and law leave; a function's support is the least that is seen of a jump"),
        Check::known_limit("weak-viscosity-rings", "artificial viscosity with a small linear part, no remedy, Mach 0.5 and more: stress above the exact one by more than a tenth")
            .when(|r| r.is_viscous() && !r.takes_ringing() && r.remedy() == RemedyName::None && r.mach >= WEAK)
            .above(OVERSHOOT, |_| 0.1)
            .because("quadratic in the rate, it acts in the front and not on what is left behind it"),
        Check::known_limit("rings", "no viscosity, no remedy, Mach 0.5 and more, up to 128 cells: a tenth or more of the energy due for dissipation rings instead")
            .when(|r| !r.is_viscous() && r.mach >= WEAK && r.remedy() == RemedyName::None && r.h >= COARSE)
            .at_most(ENERGY_LOSS_ERROR, |_| -0.1)
            .because("no viscosity: a step of a stress leaves waves of a few cells behind it, which carry the energy"),
        Check::known_limit("recursion-smears", "fbar-recursive, up to Mach 0.5: energy loss above the exact one by more than a quarter")
            .when(|r| r.is_weak() && r.remedy() == FbarRecursive)
            .above(ENERGY_LOSS_ERROR, |_| 0.25)
            .because("Eq. (26) diffuses J: a front is smeared, and what it takes is not its own"),
        Check::known_limit("front-missed", "fbar-recursive, fbar-total, fbar-rate and linear functions: worst of shock-speed, stress and wall-force over their tolerance, where it exceeds one")
            .when(|r| !r.is_sound() && r.worst_miss() > 1.0)
            .above(Quantity::new(STRESS_ERROR.name, |r: &Run<Shock>| r.worst_miss()), |_| 1.0)
            .because("averages that differ between force and rate, or that diffuse, and hats whose stress fades as particles cross cells: docs/shock.md"),
        Check::known_limit("averaged-hats-lose-stress", "linear functions with an average, up to Mach 0.5: mean stress a tenth or more below the exact one")
            .when(|r| r.is_weak() && r.basis() == Linear && r.remedy() != RemedyName::None)
            .at_most(STRESS_ERROR, |_| -0.1)
            .because("a pressure feeds what an average can't see, at any step: docs/critical-step.md"),
    ]
}

fn tables() -> Vec<ResultTable> {
    const SPEED: Label = ("Mach", |r| Setup::<Shock>::number_of(r, |s| s.mach).to_string());
    const COEFFICIENTS: Label = ("c₁, c₂", |r| {
        let number = |of: fn(&Setup<Shock>) -> f64| Setup::number_of(r, of);
        format!("{}, {}", number(|s| s.linear_viscosity), number(|s| s.quadratic_viscosity))
    });
    let columns = [
        Column::metric("speed of the front", SHOCK_SPEED_ERROR, percent(2)),
        Column::metric("mean stress", STRESS_ERROR, percent(2)),
        Column::metric("force on the wall", WALL_FORCE_ERROR, percent(2)),
        Column::metric("overshoot", OVERSHOOT, percent(0)),
        Column::metric("rings", RINGING, share(1)),
        Column::metric("energy lost, over the exact", ENERGY_LOSS_ERROR, percent(0)),
    ];
    let of_viscous = [
        ("n128", "speed of the front", SHOCK_SPEED_ERROR, percent(2)),
        ("n64", "mean stress, 64 cells", STRESS_ERROR, percent(2)),
        ("n128", "128 cells", STRESS_ERROR, percent(2)),
        ("n256", "256 cells", STRESS_ERROR, percent(2)),
        ("n128", "overshoot", OVERSHOOT, percent(1)),
        ("n128", "rings", RINGING, share(1)),
        ("n128", "width (m)", FRONT_WIDTH, fixed(3)),
        ("n128", "predicted", PREDICTED_WIDTH, fixed(3)),
        ("n128", "rate of loss", LOSS_RATE_ERROR, percent(1)),
        ("n256", "256 cells", LOSS_RATE_ERROR, percent(1)),
    ];
    let of_viscous = of_viscous.map(|(level, title, metric, format)| Column::metric(title, metric, format).at(level));
    let is_viscous = |r: &Record| {
        r.changes_none_but(&["mach", "linear_viscosity", "quadratic_viscosity"])
            && Setup::<Shock>::number_of(r, |s| s.quadratic_viscosity) > 0.0
    };
    vec![
        // One grid keeps the page readable.
        ResultTable::new("shock", |r| r.changes_none_but(&["mach"]) && r.level == "n128", &[SCHEME, SPEED], columns),
        ResultTable::new("shock-viscous", is_viscous, &[COEFFICIENTS, SCHEME, SPEED], of_viscous),
    ]
}
