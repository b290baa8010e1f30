//! Checks of the cantilever.

use super::*;

/// Largest relative error of the corner's u_y with quadratic splines, by level: the discretisation error that has been
/// asked for, half of it from one level to the next.
const ERRORS: [(&str, f64); 4] = [("h0.1", 6e-3), ("h0.05", 2.5e-3), ("h0.025", 1e-3), ("h0.0125", 5e-4)];
/// Condition at which a matrix in double precision is useless.
const BOUND: f64 = 12.0;
/// Relative error that serendipity elements have at every level: more than three times what splines may have on the
/// coarsest cells.
const DIVERGED: f64 = 0.02;

type Beam<'a> = Run<'a, Cantilever>;

impl Beam<'_> {
    /// Stiffness along the beam, EA/L, over that of its tip, 3EI/L³, times M/2G; and of a rim with its penalty, γ E a step.
    fn stiffnesses(&self) -> f64 {
        let ghost = if self.stabilisation == Stabilised::Ghost { self.ghost } else { 0.0 };
        let volume = (1.0 - self.poisson_ratio) / (1.0 - 2.0 * self.poisson_ratio);
        4.0 * (run::LENGTH / run::DEPTH).powi(2) * volume * (1.0 + ghost * f64::from(self.load_steps.min(100)))
    }

    fn is_unstable(&self) -> bool {
        self.stabilisation == Stabilised::None
    }

    /// Whether quadratic splines with a ghost penalty have 16 particles a cell.
    fn is_splines(&self) -> bool {
        self.basis() == Bspline2
            && self.stabilisation == Stabilised::Ghost
            && self.points_per_direction == 4
            && self.law != LawName::JaumannLinear
    }

    /// Relative error of the corner's u_y that is asked for at the level.
    fn asked(&self) -> Option<f64> {
        ERRORS.iter().find(|(level, _)| *level == self.level).map(|(_, error)| *error)
    }
}

pub(super) fn checks() -> Vec<Check> {
    type Check = CheckOf<Cantilever>;
    type Demand = crate::demand::Demand<Cantilever>;
    // A converged step has this residual, over the loads.
    let residual = |b: &Beam| b.tolerance.max(b.metric(FORCE_ROUNDING));
    let mass = 1000.0 * run::VOLUME;
    let stress = STRESSES.iter().map(|&(metric, at)| {
        Demand::known(metric, move |b| {
            let stresses = b.stresses().ok()?;
            let exact = stresses.at(at)?;
            Some((exact.value, b.record.discretisation.h * exact.gradient + stresses.uncertainty_stress))
        })
    });
    vec![
        Check::bookkeeping("mass", "mass of the beam 300 kg per metre, to rounding")
            .within(MASS, move |_| mass, move |_| 1e-9 * mass)
            .because("density times the volume of the beam"),
        Check::truth("reaction", "reaction of the clamp equal to the weight within the residual of Newton's method")
            .when(|b| !b.is_unstable())
            // At a stabilised node on the clamp the penalty bears its share.
            .at_most(REACTION_ERROR, move |b| 10.0 * residual(b))
            .because("equilibrium: the residual is at most the tolerance of the loads, or rounding"),
        Check::truth("force-ratio", "out-of-balance force ratio of every step, the paper's Eq. (37), at most the tolerance or the rounding of the stresses")
            .at_most(FORCE_RATIO, residual)
            .because("the criterion of convergence"),
        Check::truth("newton", "stabilised runs of ten steps or more: at most 7 Newton iterations a step, 3 to reach quadratic convergence, 4 from 10⁻¹ to the tolerance")
            .when(|b| b.load_steps >= 10 && !b.is_unstable())
            .except(|b| b.poisson_ratio > 0.49, "nearly incompressible: steps start outside of quadratic convergence")
            .at_most(NEWTON_ITERATIONS, |b| 7.0 * f64::from(b.load_steps))
            .because("quadratic convergence with the exact tangent"),
        quadratic(NEWTON_RATE, |b: &Beam| b.stiffnesses())
            .when(|b| !b.is_unstable())
            .except(|b| b.tolerance < b.metric(FORCE_ROUNDING), "rounding ends the iterations, not the tolerance")
            .because("the exact tangent, and how much stiffer a beam is along itself and to a change of volume: docs/newton.md"),
        Check::truth("corner", "u_y of the corner within 0.6, 0.25, 0.1, 0.05 % of the finite elements at h = 0.1, 0.05, 0.025, 0.0125 m")
            .unless(|b| b.solution().err())
            .except(|b| b.asked().is_some_and(|asked| b.tolerance > 0.1 * asked), "Newton's tolerance hides the error")
            .except(|b| b.asked().is_none(), "no error is asked for at this level")
            .within(
                CORNER_UY,
                |b| b.solution().map_or(f64::NAN, |s| s.bottom_right[1]),
                |b| {
                    let (error, known) = (b.asked().unwrap_or(f64::NAN), b.solution());
                    known.map_or(f64::NAN, |s| error * s.bottom_right[1].abs() + s.uncertainty)
                },
            )
            .because("finite elements of high order; their uncertainty and the error asked for at this cell size"),
        Check::truth("stress", "stabilised quadratic splines, 16 particles a cell: σ_xx at six points near the clamp within h |∇σ_xx| of the finite elements")
            .each([Demand::at_most(STRESS_ERROR, |_| f64::NAN).when(|b| b.stresses().is_err()).unless(|b| b.stresses().err())])
            .each(stress)
            .because("finite elements of degree 5, this project; tolerance: the point moved by a cell"),
        Check::truth("falls", "stabilised quadratic splines, 16 particles a cell: the errors of u_y and of these stresses fall from level to level").study(falls),
        Check::truth("steps", "stabilised quadratic splines at h = 0.05 m: 5 to 160 load steps change u_y of the corner by less than its error").study(steps),
        Check::known_limit("q8-diverges", "serendipity elements: error above 2 % at every level, at the finest no smaller than at the coarsest").study(diverges),
        Check::known_limit("coarse-bending", "all but stabilised quadratic splines with 16 particles a cell: error of u_y of the corner beyond the tolerance of corner, where it is")
            .when(|b| !b.is_splines() && b.asked().is_some_and(|asked| b.metric(CORNER_ERROR) > asked))
            .above(CORNER_ERROR, |b| b.asked().unwrap_or(f64::NAN))
            .because("hats and domains carry bending to lower order; fewer points, or none that are held, integrate it worse"),
        Check::known_limit("no-stabilisation", "completed runs without stabilisation: condition number of the scaled stiffness above 10¹²")
            .when(|b| b.is_unstable())
            .above(LOG10_CONDITION, |_| BOUND)
            .because("functions at the rim see fewer strains than they have unknowns"),
        Check::known_limit("linear-update", "jaumann-linear, quadratic splines: first order, each doubling of 10 and 20 load steps divides the error by more than 1.5").study(linear_update),
    ]
}

fn falls(records: &[Record]) -> Vec<Finding> {
    let runs = Beam::ended(records);
    let own = |b: &&Beam| b.is_splines() && b.is_default();
    let mut own: Vec<&Beam> = runs.iter().filter(own).collect();
    own.sort_by(|a, b| b.h.total_cmp(&a.h));
    let fall = |metric: Metric, pair: &[&Beam]| {
        let (coarse, fine) = (pair[0].metric(metric), pair[1].metric(metric));
        let what = format!("{} at {} over that at {}", metric.name, pair[1].level, pair[0].level);
        Finding::at_most(what, fine / coarse, 1.0, "convergence under refinement")
    };
    own.windows(2).flat_map(|pair| [CORNER_ERROR, STRESS_ERROR].map(|metric| fall(metric, pair))).collect()
}

fn steps(records: &[Record]) -> Vec<Finding> {
    let runs = Beam::ended(records);
    let at = |steps: i32| {
        let own = |b: &&Beam| b.record.changes_none_but(&["load_steps"]) && b.is_splines() && b.level == "h0.05";
        runs.iter().filter(own).find(|b| b.load_steps == steps)
    };
    let (Some(few), Some(own), Some(many)) = (at(5), at(20), at(160)) else { return Vec::new() };
    let change = (few.metric(CORNER_UY) - many.metric(CORNER_UY)).abs();
    let error = own.metric(CORNER_ERROR) * own.metric(CORNER_UY).abs();
    let why = "the path doesn't matter to an elastic law; only the grid is reset more often";
    vec![Finding::at_most("change of corner_uy (m) by 5 to 160 steps", change, error, why)]
}

fn diverges(records: &[Record]) -> Vec<Finding> {
    let runs = Beam::ended(records);
    let of_q8 = |b: &&Beam| b.basis() == Q8 && b.set == ["stabilisation=soft"];
    let mut own: Vec<&Beam> = runs.iter().filter(of_q8).collect();
    own.sort_by(|a, b| b.h.total_cmp(&a.h));
    let why = "functions of serendipity elements have kinks at all faces, which particles cross: integration errs by a share that cells don't lessen";
    let error =
        |b: &&Beam| Finding::above(format!("corner_error at {}", b.level), b.metric(CORNER_ERROR), DIVERGED, why);
    let mut found: Vec<Finding> = own.iter().map(error).collect();
    if let [coarsest, .., finest] = own[..] {
        let ratio = finest.metric(CORNER_ERROR) / coarsest.metric(CORNER_ERROR);
        found.push(Finding::above("error at the finest over that at the coarsest", ratio, 1.0, why));
    }
    found
}

fn linear_update(records: &[Record]) -> Vec<Finding> {
    let runs = Beam::ended(records);
    let at = |steps: i32| {
        let own = |b: &&Beam| b.law == LawName::JaumannLinear && b.basis() == Bspline2 && b.level == "h0.05";
        runs.iter().filter(own).find(|b| b.load_steps == steps)
    };
    let errors = [10, 20, 40].map(|steps| at(steps).map(|b| b.metric(CORNER_ERROR)));
    let [Some(ten), Some(twenty), Some(forty)] = errors else { return Vec::new() };
    let why = "the paper's Eqs. (9) and (10) are linear in the step";
    vec![
        Finding::above("error at 10 steps over that at 20", ten / twenty, 1.5, why),
        Finding::above("error at 20 steps over that at 40", twenty / forty, 1.5, why),
    ]
}
