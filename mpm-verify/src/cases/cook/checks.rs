//! Checks of Cook's membrane. The tolerances are derived in `docs/cook.md`.

use super::reference::{Measure, Solution, StressField};
use super::run::CREEP;
use super::*;
use Measure::{EdgeMean, MidEdge, Tip};

/// Relative tolerance of mid-edge and edge mean at h ≤ 1 m, per metre of cell size.
const EDGE_TOLERANCE: f64 = 0.01;
/// Relative tolerance of the tip at h ≤ 1 m.
const TIP_TOLERANCE: f64 = 0.02;
/// Relative error of a locking-free bilinear element, per metre of cell size: mid-edge and tip.
const ELEMENT_ERROR: (f64, f64) = (0.0045, 0.0074);
/// Largest oscillation of a locking-free pressure, rms(σ_m − Πσ_m) / rms σ_m.
const SMOOTH: f64 = 0.2;
/// Least oscillation of a locked one.
const LOCKED: f64 = 0.5;
/// Coarsest cell (m) that resolves the field well enough for the two; known limits are judged on it only.
const RESOLVED: f64 = 1.0;
/// Least R² of linear growth.
const LINEAR: f64 = 0.95;
/// Largest relative gain of energy.
const GAIN: f64 = 1e-3;
/// Relative tolerance of the clamp's reaction.
const REACTION: f64 = 0.02;
/// Largest local damping that lets a motion end within the time given.
const MOST_DAMPED: f64 = 0.9;
/// Tolerance of Newton's method, and its iterations beside those that square the error.
const NEWTON: (f64, f64) = (1e-9, 2.0);
/// Coarsest cell (m), on which XPIC(2) creeps longest.
const COARSEST: f64 = 2.0;
/// Poisson's ratios for which F̄ is meant and its tolerances are stated.
const NEARLY_INCOMPRESSIBLE: (f64, f64) = (0.49, 0.499);
/// The probe (m) that is two cells of 1 m away from the free lower side.
const NEAR_FREE_SIDE: [f64; 2] = [24.0, 24.0];
/// Particles at two per direction, by cell size.
const COUNTS: [(f64, f64); 4] = [(2.0, 1448.0), (1.0, 5776.0), (0.5, 23_072.0), (0.25, 92_224.0)];
/// Least ghost penalty, in shares of Young's modulus, that holds a rim: on smooth fields it errs by less than a thousandth
/// of itself, and it outweighs the material only for functions with less of it than this share of a cell.
const HOLDS: f64 = 1e-3;
/// Least gain in creep when the time step is halved: √2, less the scatter of the two fits.
const FASTER: f64 = 1.3;
/// Relative difference in displacement that two runs at rest may have: each is within the
/// out-of-balance virtual work of 1e-3 that rest admits.
const REST_NOISE: f64 = 2e-3;

/// Change of the error by a second extrapolation of momenta in an independent code, and that code's distance from ours without
/// one, per metre of cell size.
const SECOND: (f64, f64) = (-0.0071, 0.0016);

const DIFFUSES: &str = "Π is no projection: Eq. (26) averages the average and so diffuses J̄";
const COMPRESSIBLE: &str = "F̄ is meant for ν ≥ 0.49: see too-soft-when-compressible";
const OSCILLATES: &str = "the oscillation that Π leaves grows with the bulk modulus";

impl Measure {
    fn metric(self) -> Metric {
        self.metrics()[0]
    }

    /// Relative error of a locking-free bilinear element, per metre of cell size.
    fn element_error(self) -> f64 {
        if self == Tip { ELEMENT_ERROR.1 } else { ELEMENT_ERROR.0 }
    }
}

impl Setup<Cook> {
    fn is_free_of_locking(&self) -> bool {
        matches!(self.remedy(), FbarTotal | FbarRate | FbarConsistent)
    }

    fn is_recursive(&self) -> bool {
        self.remedy() == FbarRecursive
    }

    fn is_compressible(&self) -> bool {
        self.poisson_ratio < NEARLY_INCOMPRESSIBLE.0
    }

    /// Whether the body is less compressible than F̄'s tolerances are stated for.
    fn is_beyond(&self) -> bool {
        self.poisson_ratio > NEARLY_INCOMPRESSIBLE.1
    }

    /// Whether the cells are those on which the known limits were established.
    fn is_established(&self) -> bool {
        self.h == RESOLVED
    }

    fn is_noisy(&self) -> bool {
        self.is_free_of_locking() && self.is_beyond() && self.is_established()
    }

    /// Whether two periods are known not to be enough.
    fn rests_late(&self) -> bool {
        self.transfer() == TransferName::Xpic2 && self.basis() == Bspline2 && self.h == COARSEST
    }

    /// Reason why no rest is to be expected within the time given, or no other answer than that of its cells.
    fn swings(&self) -> Option<String> {
        let undamped = !self.kinetic_damping && self.damping == 0.0;
        let why = match self.is_explicit() {
            true if undamped => "nothing damps the motion: the membrane swings about its rest",
            true if self.damping > MOST_DAMPED => {
                "so much local damping slows the motion: rest takes more time than is given"
            }
            _ if self.ppc_per_direction == 1 => "one particle a cell leaves motions without stiffness",
            _ => return None,
        };
        Some(why.to_owned())
    }

    /// Whether the body has more particles than those with which it is known to be stiff enough.
    fn is_too_stiff(&self) -> bool {
        self.is_free_of_locking() && self.basis() == Gimp && self.ppc_per_direction > 2
    }

    /// Whether no function of the rim is soft: all are held, or GIMP takes its only step on the lattice, where domains end at
    /// faces of cells and it is the method with linear functions.
    fn is_held(&self) -> bool {
        (self.basis() == Gimp && self.load_steps == 1) || self.ghost >= HOLDS
    }

    /// Whether the run is a quasi-static one whose place of the load finite elements know: two particles per direction.
    fn is_judged_place(&self) -> bool {
        !self.is_explicit() && self.load_at == LoadAt::Column && self.ppc_per_direction == 2
    }

    /// Whether the rim of a quasi-static run is known to be too soft.
    fn is_soft(&self) -> bool {
        self.is_judged_place() && self.is_free_of_locking() && !self.is_held()
    }

    /// The displacement (m) of the reference, with the load where the particles of a quasi-static run carry it; NaN without one.
    fn exact(&self, of: Measure) -> f64 {
        let shift = self.load_shift().filter(|_| self.is_judged_place()).map_or(0.0, |shift| shift.of(of));
        self.solution().map_or(f64::NAN, |s| s.of(of) + shift)
    }

    /// Largest distance (m) of a run from the reference.
    fn tolerance(&self, of: Measure) -> f64 {
        let exact = self.exact(of);
        let relative = if self.h > RESOLVED && !self.is_judged_place() {
            // The stored shift is for a load at h/4 from the side, two particles per direction.
            let inset = if self.load_at == LoadAt::Column { 2.0 / self.ppc_per_direction as f64 } else { 0.0 };
            let moved = self.load_shift().map_or(0.0, |s| inset * s.of(of).abs());
            moved / exact + of.element_error() * self.h
        } else if of == Tip {
            TIP_TOLERANCE
        } else {
            EDGE_TOLERANCE * self.h
        };
        relative * exact.abs() + self.solution().map_or(f64::NAN, |s| s.uncertainty_displacement)
    }

    /// u_y (m) of the finite elements under the run's own large load, where its particles carry it, and the tolerance (m).
    fn under_large_load(&self, of: Measure) -> Option<(f64, f64)> {
        let held = self.is_judged_place() && self.ghost >= HOLDS;
        let load = self.large_load().filter(|_| held)?;
        let exact = load.deflections.of(of);
        Some((exact, EDGE_TOLERANCE * self.h * exact + load.uncertainty))
    }

    /// Mean normal stress (Pa) of the reference at a point (m), and its tolerance: the point moved by a cell.
    fn probed(&self, point: [f64; 2]) -> Option<(f64, f64)> {
        let reference = self.solution().ok()?;
        let gradient = StressField::stored().gradient(point, 1.0).unwrap_or(0.0);
        let scale = self.stress_scale();
        let value = scale * reference.mean_stress_at(point)?;
        Some((value, scale * (self.h * gradient + reference.uncertainty_mean_stress)))
    }

    /// Where the pressure of GIMP with F̄ is known to be off by more than a cell would explain.
    fn is_off_near_free_side(&self, point: [f64; 2]) -> bool {
        let soft = self.is_explicit() || self.is_soft();
        soft && self.basis() == Gimp && self.is_established() && self.is_beyond() && point == NEAR_FREE_SIDE
    }

    /// Largest rms error of the mean stress (Pa).
    fn stress_bound(&self) -> f64 {
        let (gradient, stress) = StressField::stored().rms_of_gradient_and_value();
        self.stress_scale() * (self.h * gradient).hypot(SMOOTH * stress)
    }

    fn source(&self) -> String {
        let words = |s: &Solution| {
            let (ratio, uncertainty) = (s.poisson_ratio, s.uncertainty_displacement);
            format!("independent high-order FEM, this project, ν = {ratio}, ± {uncertainty:.0e} m")
        };
        self.solution().map_or_else(|why| why, words)
    }
}

impl Run<'_, Cook> {
    /// Error that the first Newton iteration leaves of the largest step, in the norm of the energy: docs/cook.md.
    fn contraction(&self) -> f64 {
        let turn = 2.25 * self.metric(MID_EDGE_UY) / (LENGTH * f64::from(self.load_steps));
        let bulk = 2.0 * (1.0 + self.poisson_ratio) / (3.0 * (1.0 - 2.0 * self.poisson_ratio));
        0.5 * turn * bulk.sqrt()
    }

    fn most_iterations(&self) -> f64 {
        let (tolerance, more) = NEWTON;
        let squarings = (1.0 + tolerance.ln() / self.contraction().ln()).log2().ceil();
        f64::from(self.load_steps) * (squarings + more)
    }

    /// Reason why the state at the end is not one of rest, if it should be.
    fn still_moves(&self) -> Option<String> {
        let moves = self.metric(AT_REST) == 0.0 && !self.is_recursive();
        self.swings().or_else(|| moves.then(|| "the body still moves at the end: see at-rest".to_owned()))
    }

    fn count(&self) -> Option<f64> {
        let counted = COUNTS.iter().find(|(size, _)| *size == self.h && self.record.discretisation.ppc == 4);
        counted.map(|(_, count)| *count)
    }

    /// The relative error of the mid-edge deflection; of a quasi-static run against the finite elements with the load where
    /// its particles carry it, as far as they know it.
    fn mid_edge_error(&self) -> f64 {
        match self.solution() {
            Ok(_) if self.is_judged_place() => self.metric(MID_EDGE_UY) / self.exact(MidEdge) - 1.0,
            _ => self.metric(FEM_MID_EDGE_ERROR),
        }
    }
}

pub(super) fn mid_edge_error(r: &Record) -> f64 {
    Run::<Cook>::of(r).map_or(f64::NAN, |run| run.mid_edge_error())
}

type Check = CheckOf<Cook>;
type Demand = crate::demand::Demand<Cook>;

/// A quantity of a displacement: by how much it falls short of the reference.
fn shortfall(of: Measure) -> Quantity<Cook> {
    let name = format!("shortfall of {}", of.metric().name);
    Quantity::new(name, move |c: &Run<Cook>| c.exact(of) - c.metric(of.metric()))
}

/// A displacement against the reference, where another check does not say why it is off.
fn displacement(of: Measure) -> Demand {
    let demand = Demand::within(of.metric(), move |c| c.exact(of), move |c| c.tolerance(of))
        .except(move |c| c.is_compressible() && c.is_free_of_locking() && of != Tip, COMPRESSIBLE)
        .unless(|c| c.solution().err())
        .unless(|c| c.still_moves())
        .except(move |c| c.is_soft(), "see soft-rim");
    match of {
        Tip => demand.except(|c| c.is_too_stiff(), "see too-stiff-with-more-particles"),
        _ => demand.when(|c| !c.is_too_stiff()),
    }
}

pub(super) fn checks() -> Vec<crate::check::Check> {
    vec![
        Check::bookkeeping("particle-count", "1,448, 5,776, 23,072 and 92,224 particles at h = 2, 1, ½ and ¼ with two per direction; the second and third are the paper's")
            .except(|c| c.count().is_none(), "counted for two particles per direction only")
            .within(Quantity::new("particles", |c| c.record.work.particles as f64), |c| c.count().unwrap_or(f64::NAN), |_| 0.0)
            .because("Zhao et al. 2023, section 4.1 (h = 1 and ½); the same rule elsewhere"),
        Check::truth("no-energy-gain", "kinetic energy, stress work and losses exceed the load's work by at most 0.1 % of it, as symplectic Euler oscillates at CFL 0.3")
            .when(|c| c.is_explicit())
            .at_most(ENERGY_GAIN, |_| GAIN)
            .because("energy balance; symplectic Euler oscillates by ½ Δt times the power"),
        Check::known_limit("never-at-rest", "fbar-recursive: rest is not reached within a period, by which the others are there")
            .when(|c| c.is_recursive())
            .at_most(AT_REST, |_| 0.0)
            .because(DIFFUSES),
        Check::known_limit("creep", "fbar-recursive: rms ln(J/J̄) grows by more than 1e-4 per period")
            .when(|c| c.is_recursive())
            .above(CREEP_RATE, |c| CREEP / c.metric(PERIOD))
            .because(DIFFUSES),
        Check::known_limit("creep-is-linear", "fbar-recursive: that growth is a straight line in time, R² above 0.95")
            .when(|c| c.is_recursive())
            .above(CREEP_LINEARITY, |_| LINEAR)
            .because(DIFFUSES),
        Check::truth("at-rest", "none, fbar-total, fbar-rate, fbar-consistent: rest is reached in the time given")
            .when(|c| c.is_explicit() && !c.is_recursive() && !c.rests_late())
            .unless(|c| c.swings())
            .unless(|c| {
                let filters = c.transfer() == TransferName::Xpic2 && !c.is_default();
                let open = c.metric(AT_REST) == 0.0 && (c.damping > 0.0 || c.flip < 1.0 || filters);
                open.then(|| "damping or the transfer slows the motion: rest takes more time than is given".to_owned())
            })
            .within(AT_REST, |_| 1.0, |_| 0.0)
            .because("a statically loaded elastic body has an equilibrium"),
        Check::known_limit("rests-late", "none, fbar-consistent with XPIC(2) and quadratic splines at h = 2 m: rest is not reached within two periods (within three it is)")
            .when(|c| !c.is_recursive() && c.rests_late())
            .at_most(AT_REST, |_| 0.0)
            .because("what XPIC filters from the velocity in every step creeps"),
        Check::truth("reaction", "none, fbar-total, fbar-rate, fbar-consistent: at rest the clamp's reaction balances the load within 2 % (linear momentum)")
            .when(|c| !c.is_recursive())
            .unless(|c| c.still_moves())
            .within(REACTION_UY, |c| -c.load, |c| REACTION * c.load.abs())
            .because("linear momentum at rest"),
        Check::truth("static-reaction", "quasi-static: the clamp's reaction balances the load to a hundred times the tolerance of Newton's method")
            .when(|c| !c.is_explicit())
            .at_most(REACTION_ERROR, |_| 1e-7)
            .because("equilibrium"),
        Check::truth("newton", "quasi-static, rim held: at most as many Newton iterations as square the turn of a step to the tolerance, and two more a step")
            .when(|c| !c.is_explicit() && c.is_held())
            .except(|c| c.contraction() >= 1.0, "a step turns the body farther than the first iteration can follow")
            .at_most(NEWTON_ITERATIONS, |c| c.most_iterations())
            .because("quadratic convergence with the exact tangent"),
        Check::known_limit("locked", "none with GIMP: rms(σ_m − Πσ_m) above 0.5 rms σ_m")
            .when(|c| c.remedy() == RemedyName::None && c.basis() == Gimp && !c.is_compressible())
            .above(CHECKERBOARD_RATIO, |_| LOCKED)
            .because("standard MPM locks: Zhao et al. 2023, Figure 3"),
        Check::known_limit("locks", "none: mid-edge or mean u_y of the right side short, σ_m off or rms(σ_m − Πσ_m) high, by more than their tolerances, where they are")
            .when(|c| c.remedy() == RemedyName::None)
            .each([MidEdge, EdgeMean].map(|of| {
                Demand::above(shortfall(of), move |c| c.tolerance(of)).when(move |c| c.exact(of) - c.metric(of.metric()) > c.tolerance(of))
            }))
            .each([
                Demand::above(MEAN_STRESS_RMS_ERROR, |c| c.stress_bound())
                    .when(|c| c.solution().is_ok() && c.metric(MEAN_STRESS_RMS_ERROR) > c.stress_bound()),
                Demand::above(CHECKERBOARD_RATIO, |_| SMOOTH).when(|c| c.metric(CHECKERBOARD_RATIO) > SMOOTH),
            ])
            .because("a volume that is held at every particle leaves too few motions: Zhao et al. 2023, Figure 3"),
        Check::truth("mid-edge", "u_y at (48, 52) m within 1 % · h/(1 m) of the FEM reference; above 1 m, the load's place and a locking-free element's error")
            .each([displacement(MidEdge)])
            .because_of(|c| c.source()),
        Check::truth("edge-mean", "mean u_y of the right side within the tolerance of mid-edge")
            .each([displacement(EdgeMean)])
            .because_of(|c| c.source()),
        Check::known_limit("soft-rim", "quasi-static fbar-consistent, ghost penalty below 10⁻³, GIMP in several steps, h = 1 m: right side exceeds the FEM reference by more than a locking-free element's error")
            .when(|c| c.is_soft() && c.is_established())
            .each(Measure::ALL.map(|of| {
                let excess = Quantity::new(format!("excess of {}", of.metric().name), move |c: &Run<Cook>| c.metric(of.metric()) - c.exact(of));
                Demand::above(excess, move |c| of.element_error() * c.h * c.exact(of)).when(|c| c.solution().is_ok())
            }))
            .because("functions of the rim that see hardly any material bear hardly any load; the explicit case has them too"),
        Check::truth("large-loads", "quasi-static, rim held, 10 to 50 N, h = 1 m, except GIMP without a remedy: right side within 1 % of FEM with the load on the same line of material")
            .each([MidEdge, EdgeMean].map(|of| {
                Demand::known(of.metric(), move |c| c.under_large_load(of)).except(|c| c.basis() == Gimp && !c.is_free_of_locking(), "see locked")
            }))
            .because("finite elements of degree 4 under the same load on the same line, this project"),
        Check::truth("tip", "u_y at (48, 60) m within 2 % of the FEM reference; above h = 1 m as for mid-edge")
            .each([displacement(Tip)])
            .because_of(|c| c.source()),
        Check::known_limit("too-stiff-with-more-particles", "F̄ except fbar-recursive, GIMP, more than two particles per direction: mid-edge and mean u_y of the right side short by more than the tolerances")
            .when(|c| c.is_free_of_locking() && c.is_too_stiff() && c.solution().is_ok())
            .each([MidEdge, EdgeMean].map(|of| Demand::above(shortfall(of), move |c| c.tolerance(of))))
            .because("with two per direction the soft boundary of a GIMP body makes up for the load's place and its stiffness; with more it doesn't"),
        Check::truth("mean-stress-probe", "σ_m at seven points within h |∇σ_m| of the FEM reference")
            .unless(|c| c.solution().err())
            .unless(|c| c.still_moves())
            .each(MEAN_STRESSES.iter().map(|&(metric, point)| {
                Demand::known(metric, move |c| c.probed(point)).when(move |c| !c.is_off_near_free_side(point))
            }))
            .because_of(|c| format!("{}; tolerance: the point moved by a cell", c.source())),
        Check::known_limit("pressure-near-free-side", "F̄ except fbar-recursive, GIMP, explicit or ghost penalty below 10⁻³, ν > 0.499, h = 1: σ_m two cells from the free side is off by more than h |∇σ_m|")
            .when(|c| c.is_free_of_locking())
            .each(MEAN_STRESSES.iter().map(|&(metric, point)| {
                let known = move |c: &Run<Cook>| c.probed(point).unwrap_or((f64::NAN, f64::NAN));
                let error = format!("|error| of {}", metric.name);
                let error = Quantity::new(error, move |c: &Run<Cook>| (c.metric(metric) - known(c).0).abs());
                Demand::above(error, move |c| known(c).1)
                    .when(move |c| c.probed(point).is_some() && c.is_off_near_free_side(point))
            }))
            .because_of(|_| format!("{OSCILLATES}, most of all at a free side")),
        Check::truth("mean-stress-rms", "rms of σ_m − reference at most √((h rms|∇σ_m|)² + (0.2 rms σ_m)²)")
            .unless(|c| c.solution().err())
            .unless(|c| c.still_moves())
            .except(|c| !c.solution().is_ok_and(Solution::has_field), "the reference field is stored for ν = 0.499")
            .at_most(MEAN_STRESS_RMS_ERROR, |c| c.stress_bound())
            .because_of(|c| {
                let what = "every point moved by a cell, and the oscillation that smooth-pressure admits";
                format!("{}; {what}", c.source())
            }),
        Check::truth("smooth-pressure", "h ≤ 1 m: rms(σ_m − Πσ_m) below 0.2 rms σ_m")
            .when(|c| !c.is_noisy())
            .except(|c| c.is_beyond(), "beyond ν = 0.499 only noisy-pressure is judged, at h = 1 m")
            .except(|c| c.h > RESOLVED, "cells above 1 m don't resolve the field: Π changes the exact field too")
            .at_most(CHECKERBOARD_RATIO, |_| SMOOTH)
            .because("a locking-free pressure is smooth on the scale of a cell"),
        Check::known_limit("noisy-pressure", "fbar-total, fbar-rate, fbar-consistent at ν > 0.499 and h = 1: rms(σ_m − Πσ_m) above 0.2 rms σ_m; smooth-pressure is not judged there")
            .when(|c| c.is_noisy())
            .above(CHECKERBOARD_RATIO, |_| SMOOTH)
            .because(OSCILLATES),
        Check::known_limit("too-soft-when-compressible", "F̄ except fbar-recursive, splines or explicit, ν < 0.49, h = 1: mid-edge u_y exceeds the reference by more than 1 % · h/(1 m)")
            .when(|c| c.is_free_of_locking() && c.is_compressible() && c.is_established() && c.solution().is_ok())
            .when(|c| c.is_explicit() || c.basis() != Gimp)
            .above(FEM_MID_EDGE_ERROR, |c| EDGE_TOLERANCE * c.h)
            .because("averaging a pressure that needs none softens"),
        Check::truth("no-creep", "fbar-total, fbar-rate, fbar-consistent: rms ln(J/J̄) changes by less than 1e-4 per period")
            .when(|c| c.is_explicit() && c.is_free_of_locking())
            .except(|c| c.is_compressible(), COMPRESSIBLE)
            .at_most(Quantity::abs(CREEP_RATE), |c| CREEP / c.metric(PERIOD))
            .because("an equilibrium does not move"),
        Check::known_limit("creep-grows-as-dt-falls", "fbar-recursive: with half the time step it is at least 1.3 times as fast (diffusion: 2 in the bulk, √2 from a boundary)")
            .when(|c| c.is_default())
            .pairs(
                |c, other| other.set == ["cfl=0.15"] && other.scheme == c.scheme && other.level == c.level,
                |c, _| format!("creep_rate of {} {}", c.scheme, c.level),
                |c, halved| halved.metric(CREEP_RATE) / c.metric(CREEP_RATE),
            )
            .above(|_| FASTER)
            .because("the diffusivity of Eq. (26) is ½ s² h²/Δt: twice as fast in the bulk, √2 times where it enters at a boundary"),
        Check::truth("second-extrapolation", "GIMP without a remedy: MUSL's mid-edge error less that of FLIP is −0.71 % · h/(1 m), within 0.16 % · h/(1 m)")
            .when(|c| c.is_default() && c.basis() == Gimp && c.remedy() == RemedyName::None && c.transfer() == TransferName::Musl)
            .pairs(
                |c, usl| usl.is_default() && usl.scheme == Scheme::flip(Gimp, RemedyName::None) && usl.level == c.level,
                |c, _| format!("fem_mid_edge_error of {} less that of FLIP", c.level),
                |c, usl| c.metric(FEM_MID_EDGE_ERROR) - usl.metric(FEM_MID_EDGE_ERROR),
            )
            .within(|c| SECOND.0 * c.h, |c| SECOND.1 * c.h)
            .because("NairnMPM 7f47b02 with the second extrapolation of momenta and without, on 2 m and 1 m; its distance from ours without"),
        Check::truth("error-falls", "all but fbar-recursive: |error| of mid-edge u_y falls from level to level or stays below 0.2 %, quasi-static F̄ with the load in its place")
            .study(error_falls),
    ]
}

/// The largest ratio of one level's error to that of the level before, for each scheme.
fn error_falls(records: &[Record]) -> Vec<Finding> {
    let own = own_runs(records).into_iter().filter(|r| r.remedy() != FbarRecursive);
    let mut ladders = ladders_by(own, Record::scheme);
    ladders.retain(|_, ladder| ladder.len() >= 2);
    // With F̄ the error of the load at its place. Without a remedy locking outweighs the rim on coarse cells and the rim locking
    // on fine ones, so that the error there passes through zero; it stays that of the load on the side.
    let error = |run: Run<Cook>| match run.is_free_of_locking() {
        true => run.mid_edge_error().abs(),
        false => run.metric(FEM_MID_EDGE_ERROR).abs(),
    };
    let worst = |(scheme, ladder): (Scheme, Vec<&Record>)| {
        let errors: Vec<f64> = Run::<Cook>::all(ladder).map(error).collect();
        let ratios = errors.windows(2).map(|pair| pair[1] / pair[0].max(REST_NOISE));
        // A run that broke down has no error, and must not be lost among the others.
        let worst = if errors.iter().any(|e| e.is_nan()) { f64::NAN } else { ratios.fold(f64::NEG_INFINITY, f64::max) };
        let about = format!("mid-edge error of {scheme} over {} levels, largest ratio", errors.len());
        let why =
            "a consistent scheme converges; errors below 0.2 % count as that, since rest admits 0.1 % of either run";
        Finding::at_most(about, worst, 1.0, why)
    };
    ladders.into_iter().map(worst).collect()
}
