//! Checks of the landslide. The tolerances are derived in `docs/landslide.md`.

use super::*;
use crate::cases::slope::ground::{RISE, STABILITY};
use crate::cases::slope::section::GRAVITY;

/// Relative tolerance of the force on the base.
const WEIGHT: f64 = 5e-3;
/// Largest kinetic energy of the nodes at rest over the stored energy.
const AT_REST: f64 = 1e-6;
/// The coarsest level in three dimensions.
const COARSE: &str = "h0.5";
/// Rms error of the vertical stress over γ H, far from the face.
const OVERBURDEN: f64 = 0.02;
/// Cells over the height at which too few carry its modes.
const FEW: f64 = 0.2;
/// Relative rounding after the steps of the gravity stage: a hundredth of the change by F̄.
const GROWN_ROUNDING: f64 = 1e-4;
/// Relative difference of the settlement at rest from plane strain: of F̄, which scales three directions there and two here.
const OTHER_SCALING: f64 = 0.02;
/// Distance of the face's middle from the back wall, over the height, from which on that feels little of the face.
const LONG_CREST: f64 = 2.5;
/// Up to this reduction, the paper's, no band has formed until this time (s).
const PAPERS_REDUCTION: f64 = 1.65;
const EARLY: f64 = 0.5;
/// Duration (s) of a run that ends while the slide is young.
const EARLY_SLIDE: f64 = 1.5;
/// Reduction, and cells (m), from which on `fbar-recursive` with GIMP throws a grain off the grid in plane strain, and when (s).
const THROWN: (f64, f64, f64) = (2.0, 0.2, 5.3);
const THROWS: &str =
    "a grain is thrown off, likely as averages of averages let the true volumes drift: docs/landslide.md";
const FLOWS: &str = "ground whose weight is tens of times its strength flows off the end of the floor, as water would";
const LEAKS: &str =
    "`wall-line` splines do not interpolate at the floor, and a particle creeps through it: docs/method.md";
/// Rms of σ_m − Πσ_m over γ H that locking exceeds.
const CHECKERBOARD: f64 = 0.05;
/// Share of the ground that has moved from which on the slope has failed.
const FAILED: f64 = 0.01;

/// The reason why a run is known to break down before its end.
pub(super) fn breaks_down(record: &Record) -> Option<&'static str> {
    let (reduction, h, time) = THROWN;
    let printed = record.remedy() == FbarRecursive && record.basis() == Gimp;
    let flat = record.discretisation.dim == 2 && record.discretisation.h <= h;
    let far = |c: &Setup<Landslide>| c.reduction >= reduction && c.duration >= time;
    let thrown = (printed && flat && Setup::holds(record, far)).then_some(THROWS);
    let leaks = Setup::holds(record, |c: &Setup<Landslide>| c.wall == common::Wall::WallLine && c.basis() != Gimp);
    let flows = Setup::holds(record, Setup::<Landslide>::flows_away);
    thrown.or(flows.then_some(FLOWS)).or(leaks.then_some(LEAKS))
}

impl Setup<Landslide> {
    /// Most that ground loses when its strength falls at once, over its potential energy: (Δκ)²/(4G) a volume, by which
    /// the work of the last stress on the return misses the mean one's, over ρ g H/3, the least mean of a bank.
    fn lost_at_once(&self) -> f64 {
        let fall = self.peak_strength * (1.0 - 1.0 / self.reduction);
        let shear_modulus = 0.5 * self.young_modulus / (1.0 + self.poisson_ratio);
        let lost = if self.release > 0.0 { 0.0 } else { fall.powi(2) / (4.0 * shear_modulus) };
        lost / (self.density * GRAVITY * self.height / 3.0)
    }

    /// Whether ground that hardly resists reaches the end of the floor as water does, at Ritter's 2 √(g H).
    fn flows_away(&self) -> bool {
        let resists = self.peak_strength / self.reduction / 2f64.sqrt();
        let front = 2.0 * (GRAVITY * self.height).sqrt() * self.duration;
        self.density * GRAVITY * self.height > SPLASHING * resists && front > self.floor
    }

    /// Particles of the section; NaN where their number is not known: row j from the base holds columns i with
    /// i + j < columns + rows − 1.
    fn in_section(&self) -> f64 {
        let (rows, columns) = (self.height / self.pitch(), self.crest / self.pitch());
        let whole = |count: f64| (count - count.round()).abs() < 1e-6;
        match self.face_angle == 45.0 && whole(rows) && whole(columns) {
            true => rows * (columns + rows - 1.0) - 0.5 * rows * (rows - 1.0),
            false => f64::NAN,
        }
    }

    /// Mass of the ground over its width (kg/m).
    fn mass(&self) -> f64 {
        self.density * self.in_section() * self.pitch() * self.pitch()
    }

    /// Standard MPM with GIMP: every particle's volume is a constraint.
    fn is_locked(&self) -> bool {
        self.remedy() == RemedyName::None && self.basis() == Gimp
    }

    /// Allowed error of the vertical stress over γ H.
    fn overburden(&self) -> f64 {
        OVERBURDEN.max(0.2 * self.h / self.height)
    }

    /// Whether the face is felt at the back wall.
    fn feels_the_face(&self) -> bool {
        let middle = self.crest + 0.5 * self.height / self.face_angle.to_radians().tan();
        middle < (1.0 - 1e-9) * LONG_CREST * self.height
    }

    /// The reason why rest is not judged.
    fn never_rests(&self) -> Option<String> {
        if self.slope().longest_period() > RISE {
            Some("the ground's longest period is longer than the rise of gravity".to_owned())
        } else if self.transfer() == TransferName::Xpic2 {
            Some("what XPIC filters from the velocity every step can only creep: docs/cook.md".to_owned())
        } else {
            None
        }
    }

    /// Least and largest factor of safety of the unreduced slope, where limit analysis knows them.
    fn bounds(&self) -> Option<(f64, f64)> {
        let (_, least, most) = STABILITY;
        let of = |stability| self.slope().factor_of_safety(self.peak_strength, stability);
        let known = self.face_angle == 45.0 && !self.feels_the_face();
        known.then(|| (of(least), of(most)))
    }

    /// Whether the reduction is a tenth and more below the lower bound.
    fn stands(&self) -> bool {
        self.bounds().is_some_and(|(least, _)| self.reduction < 0.9 * least)
    }

    /// Whether the slope must fail: the reduction exceeds the upper bound and what a band of cells bears besides, for long
    /// enough.
    fn must_fail(&self) -> bool {
        let band = 1.0 + self.h / self.height;
        let reduced_for = self.duration - self.release.max(0.0);
        let beyond = self.bounds().is_some_and(|(_, most)| self.reduction > most * band);
        beyond && reduced_for >= 2.5
    }

    /// Whether no band has formed 0.5 s after the reduction.
    fn is_unbroken(&self) -> bool {
        self.duration >= EARLY && self.reduction <= PAPERS_REDUCTION
    }
}

type Slope<'a> = Run<'a, Landslide>;

/// Whether a ground is known to move on slowly under its weight.
fn is_slow(c: &Slope) -> bool {
    let coarse = c.level == COARSE && c.metric(YIELDED_AT_REST) > 0.0;
    (c.remedy(), c.basis()) == (FbarConsistent, Bspline2) && coarse
}

/// The reason why a force is not one of rest, of a ground that never rests: it still moves, and velocities over elastic ones
/// may be of that much.
fn moves_too_fast(c: &Slope, tolerance: f64) -> Option<String> {
    c.never_rests().filter(|_| c.metric(KINETIC_SHARE_AT_REST).sqrt() > 0.5 * tolerance)
}

pub(super) fn checks() -> Vec<Check> {
    type Check = CheckOf<Landslide>;
    type Demand = crate::demand::Demand<Landslide>;
    const LIMIT: &str = "limit analysis: docs/exact.md";
    let alike = |metric| Demand::at_most(metric, |_| GROWN_ROUNDING);
    let off = |metric, tolerance: fn(&Slope) -> f64| Demand::within(metric, |_| 0.0, tolerance).of_scale(|_| 1.0);
    vec![
        // Rest under the weight.
        Check::bookkeeping("particle-count", "number of particles that of centres strictly inside the face: the paper's 311,250 at h = 0.2 m")
            .when(|c| !c.in_section().is_nan())
            .within(PARTICLES, |c| (c.in_section() * c.metric(PARTICLES_ACROSS)).round(), |_| 0.0)
            .because("Zhao et al. 2023, section 4.4: 311,250 at h = 0.2 m"),
        Check::bookkeeping("mass", "all: final mass that of the particles, to rounding")
            .when(|c| !c.in_section().is_nan())
            .within(MASS, |c| c.mass(), |c| ROUNDING * c.mass())
            .because("conservation of mass"),
        Check::truth("base-reaction", "all: force on the base after the gravity stage the weight within 0.5 %")
            .unless(|c| moves_too_fast(c, WEIGHT))
            .within(BASE_REACTION_RATIO, |_| 1.0, |_| WEIGHT)
            .because("weight of the ground"),
        Check::truth("at-rest", "none and fbar-consistent with FLIP and APIC, except slow-motion: kinetic energy of the nodes after the gravity stage below 10⁻⁶ of the stored energy")
            .unless(|c| c.never_rests())
            .except(|c| c.h > FEW * c.height, "fewer than five cells over the height")
            .when(|c| c.remedy() != FbarRecursive && !is_slow(c))
            .at_most(KINETIC_SHARE_AT_REST, |_| AT_REST)
            .because("velocities a thousandth of elastic ones"),
        Check::known_limit("creeps", "fbar-recursive: kinetic energy above the bound of at-rest, as averages of averages diffuse the volume")
            .when(|c| c.never_rests().is_none() && c.remedy() == FbarRecursive)
            .above(KINETIC_SHARE_AT_REST, |_| AT_REST)
            .because("averages of averages diffuse the volume: docs/column.md"),
        Check::known_limit("slow-motion", "fbar-consistent with quadratic splines at h = 0.5 m, toe yielded: kinetic energy above the bound of at-rest")
            .when(|c| c.never_rests().is_none() && is_slow(c))
            .above(KINETIC_SHARE_AT_REST, |_| AT_REST)
            .because("seen where the toe has yielded"),
        Check::truth("overburden", "vertical stress far from the face the weight above, rms within 2 % of γ H, or a fifth of a cell's weight")
            .unless(|c| moves_too_fast(c, c.overburden()))
            .except(|c| c.h > FEW * c.height, "fewer than five cells over the height")
            .except(|c| c.feels_the_face(), "the face is felt at the back wall")
            .at_most(OVERBURDEN_ERROR, |c| c.overburden())
            .because("level ground"),
        Check::known_limit("locked-stress", "none with GIMP: vertical stress beyond overburden's bound, and mean stress alternates between particles by more than 5 % of γ H")
            .when(|c| !c.feels_the_face() && c.is_locked())
            .above(OVERBURDEN_ERROR, |c| c.overburden())
            .above(CHECKERBOARD_AT_REST, |_| CHECKERBOARD)
            .because("standard MPM locks: Zhao et al. 2023, Figure 15"),
        // Energy.
        Check::truth("energy-not-gained", "all with FLIP: kinetic and potential energy and stress work never grow")
            .except(|c| c.transfer() != TransferName::Flip, "FLIP alone: APIC's affine motion holds energy that isn't counted, and XPIC moves particles by another velocity than the nodes'")
            .at_most(ENERGY_GAIN, |_| ROUNDING)
            .because("explicit steps with lumped masses take energy from the motion, never give it: docs/dam-break.md"),
        Check::truth("energy-not-made", "fbar-consistent: final kinetic, potential and stored energy and dissipation at most those at the reduction")
            .when(|c| c.remedy() == FbarConsistent)
            .at_most(UNACCOUNTED_ENERGY, |_| ROUNDING)
            .because("what is stored and dissipated has fallen before"),
        Check::truth("energy-closure", "failing slopes, runs of 1.5 s and less: kinetic, potential and stored energy and dissipation those at the reduction within h/H of the fallen energy")
            .except(|c| c.duration > EARLY_SLIDE, "the ground flows: steps lose on the grid, and the share is reported")
            .except(|c| c.stands(), "the slope stands: next to nothing falls")
            .except(|c| c.metric(FALLEN_ENERGY) < c.lost_at_once(), "less has fallen than a strength that falls at once may lose")
            .within(
                Quantity::new(UNACCOUNTED_ENERGY.name, |c: &Slope| c.metric(UNACCOUNTED_ENERGY) / c.metric(FALLEN_ENERGY)),
                |_| 0.0,
                |c| c.h / c.height,
            )
            .of_scale(|_| 1.0)
            .because("a band of cells smears what it shears over its width"),
        // The slide.
        Check::truth("stands", "all, reduction a tenth below the lower bound of limit analysis: less than a hundredth of the ground moves by H/20")
            .except(|c| c.bounds().is_none(), "the bounds of limit analysis are those of a face at 45° under a long crest")
            .when(|c| c.stands())
            .at_most(FAILED_SHARE_END, |_| FAILED)
            .because(LIMIT),
        Check::truth("fails", "strength reduced beyond the upper bound of limit analysis and h/H for a band of cells: over a hundredth of the ground moves by H/20")
            .when(|c| c.must_fail())
            .above(FAILED_SHARE_END, |_| FAILED)
            .because(LIMIT),
        Check::known_limit("locked", "none with GIMP, reduction beyond the bound of fails: less than a hundredth of the ground moves by H/20")
            .when(|c| c.must_fail() && c.is_locked())
            .at_most(FAILED_SHARE_END, |_| FAILED)
            .because("standard MPM locks: Zhao et al. 2023, Figure 14"),
        // Independence of the width until shear bands form.
        Check::truth("uniform", "three dimensions: displacement uniform over the width at rest and 0.5 s after the reduction, within 10⁻⁴")
            .when(|c| c.record.discretisation.dim == 3)
            .each([alike(WIDTH_SPREAD_AT_REST), alike(WIDTH_SPREAD_0_5S).when(|c| c.is_unbroken())])
            .because("the problem is that of its section"),
        Check::truth("plane-strain", "three dimensions: crest's settlement at rest that of plane strain within 10⁻⁴ without F̄ (and 0.5 s after the reduction), 2 % with fbar-consistent")
            .when(|c| c.record.discretisation.dim == 3)
            .each([
                off(OFF_PLANE_STRAIN_AT_REST, |c| match c.remedy() {
                    RemedyName::None => GROWN_ROUNDING,
                    _ => OTHER_SCALING,
                })
                .except(|c| c.remedy() == FbarRecursive, "it creeps, with either scaling at a pace of its own"),
                off(OFF_PLANE_STRAIN_0_5S, |_| GROWN_ROUNDING)
                    .when(|c| c.is_unbroken() && c.remedy() == RemedyName::None),
            ])
            .because("the same section in plane strain"),
        // Influence of the width and of the time step.
        Check::truth(
            "slice",
            "three dimensions: settlement of the crest of a slice at rest that of the full width, within 10⁻⁴",
        )
        .study(|records| {
            let like = |(slice, whole): (&Slope, &Slope)| {
                let expected = whole.metric(SETTLEMENT_AT_REST);
                let why = format!("{} {}: the full width", slice.scheme, slice.record.folder());
                let value = slice.metric(SETTLEMENT_AT_REST);
                Finding::within(SETTLEMENT_AT_REST, value, expected, GROWN_ROUNDING * expected, why)
            };
            changed(&Slope::ended(records), "width").map(like).collect()
        }),
        // Where the slope fails at once: at the paper's reduction the onset itself is at stake.
        Check::truth("time-step", "fbar-consistent: half the time step moves the toe at 2.5 s by less than a cell")
            .study(|records| {
                let halved = |(run, _): &(&Slope, &Slope)| run.remedy() == FbarConsistent && run.cfl < 0.2;
                let like = |(run, own): (&Slope, &Slope)| {
                    let why = format!("{} {}: twice the step", run.scheme, run.record.folder());
                    Finding::within(RUNOUT_2_5S, run.metric(RUNOUT_2_5S), own.metric(RUNOUT_2_5S), run.h, why)
                };
                changed(&Slope::ended(records), "cfl").filter(halved).map(like).collect()
            }),
    ]
}
