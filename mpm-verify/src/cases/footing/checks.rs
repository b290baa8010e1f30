//! Checks of the strip footing. The tolerances are derived in `docs/footing.md`.

use super::curve::mechanism_extent;
use super::*;

/// Relative tolerance of the limit load against Prandtl's at h ≤ B/20, by the width that the footing acts with.
const PRANDTL: f64 = 0.01;
/// Relative tolerance against finite elements at h ≤ B/20.
const FEM: f64 = 0.02;
/// d ln slope / d ln width of an elastic footing: the elements' 10,430 at B/10, where they act 1.1 B wide, over the
/// 10,290 of vanishing ones.
const WIDTH_TO_SLOPE: f64 = 0.142;
/// The cell size (m) that resolves the footing: on coarser cells both grow with h.
const RESOLVED: f64 = 0.05;
/// Largest fall (relative) of a limit load per 10⁻³ of s/B, and largest growth.
const FLAT: (f64, f64) = (0.01, 0.005);
/// Largest relative difference of the forces on base and footing.
const INERTIA: f64 = 0.005;
/// Least relative excess of a locked load over Prandtl's, over the tolerance of one without locking.
const LOCKED: f64 = 2.0;
/// Largest oscillation of a locking-free pressure, rms(σ_m − Πσ_m) / rms σ_m; least one of a locked pressure;
/// largest one in squares of two cells, of which the edge of the footing makes 0.17 at B/20 and 0.26 at B/10, locking 0.8.
const BOARD: (f64, f64, f64) = (0.2, 0.5, 0.3);
/// Largest gradient of the mean normal stress (s_u/B) between the points where it is known: from 4.14 s_u under the
/// footing to 1.02 s_u beside it, half a width away.
const GRADIENT: f64 = 6.24;
/// Cells within which the end of the mechanism is seen.
const SMEARED: f64 = 2.0;
/// Penetration over B, over s_u/E, from which on the load of the finite elements is within ½ % of its limit on a
/// ground of 6B × 6B at ν = 0.49; a smaller one is stiffer and gets there sooner.
const PLASTIC: f64 = 18.5;
/// Poisson's ratio of the finite elements, for which the tolerances of F̄ are stated.
const STATED: f64 = 0.49;
/// Largest penetration over B at which the ground has kept its shape.
const SMALL: f64 = 0.01;
/// The fastest rate (m/s) that halving proves slow enough, and Young's modulus over the density (m²/s²) of the ground that
/// proves it: where waves are slower, so must the footing be.
const SLOW: f64 = 2e-3;
const STIFF: f64 = 1000.0;
/// Most damping that is known to hold nothing up: the paper's. Its share of the forces out of balance resists the footing.
const DAMPED: f64 = 0.002;
/// Strength over Young's modulus and penetration beyond which nothing yields.
const ELASTIC: f64 = 10.0;
/// Largest relative change of the limit load when the rate is halved.
const RATE: f64 = 0.005;
/// Order of the error of the contact pressure, from and to: that of its leading part, the width of the footing, less how the
/// elements' own error lowers it.
const ORDER: (f64, f64) = (0.85, 1.1);

const DIFFUSES: &str = "Eq. (26) averages the average and so diffuses J̄ in time: pressures relax";
const LOCKS: &str = "standard MPM locks: Zhao et al. 2023, Figure 8";

impl Setup<Footing> {
    /// Growth of tolerances on coarse cells, whose errors are of first order.
    fn coarseness(&self) -> f64 {
        (self.h / RESOLVED).max(1.0)
    }

    fn is_elastic(&self) -> bool {
        self.undrained_strength > ELASTIC * self.penetration * self.young_modulus
    }

    fn is_free_of_locking(&self) -> bool {
        matches!(self.remedy(), FbarRate | FbarConsistent)
    }

    /// Why a soft or heavy ground rings, if it does.
    fn rings(&self) -> Option<String> {
        let slowness = (STIFF * self.density / self.young_modulus).sqrt();
        let rings =
            !self.is_implicit() && slowness > 1.0 && self.penetration_rate * slowness > SLOW * (1.0 + f64::EPSILON);
        rings.then(|| format!("waves are {slowness:.1} times slower than where {SLOW} m/s is known to be slow"))
    }

    fn shown_only(&self) -> Option<String> {
        let starts = !self.is_implicit() && self.penetration * WIDTH <= 0.5 * self.penetration_rate * self.ramp;
        let dissipates = ![TransferName::Flip, TransferName::None].contains(&self.transfer()) || self.flip < 1.0;
        (self.penetration_rate > SLOW)
            .then(|| format!("pressed faster than {SLOW} m/s, the ground rings"))
            .or_else(|| self.rings())
            .or_else(|| starts.then(|| "the footing still gets under way".to_owned()))
            .or_else(|| {
                dissipates.then(|| {
                    "what this transfer takes from the motion every step resists the footing as a viscosity does"
                        .to_owned()
                })
            })
            .or_else(|| (self.damping > DAMPED).then(|| format!("damping beyond {DAMPED} holds what would move")))
    }

    /// Reason for the lack of a limit load to compare with, if it is lacking.
    fn no_limit(&self) -> Option<String> {
        // The limit pressure over K compresses a depth of B by so much more than at the ratio of the finite elements.
        let compressed = 6.0 * (STATED - self.poisson_ratio).max(0.0) * EXACT;
        let plastic = (PLASTIC + compressed) * self.strength_ratio();
        (0.75 * self.penetration < plastic).then(|| format!("the ground is fully plastic from s/B = {plastic} on only"))
    }

    /// Why stresses at points are not those of the references, if they are not.
    fn other_points(&self) -> Option<String> {
        let why = "a barrier's width is known to a cell only, and beyond s/B = 0.01 the ground changes its shape";
        (self.presses_by_barrier() || self.penetration > SMALL).then(|| why.to_owned())
    }

    /// Relative change of the limit load as a footing digs itself in, at most: Skempton's 1 + 0.2 D/B of the depth D, which
    /// heave as high as the penetration doubles, and as much for the changed surface.
    fn embedded(&self) -> f64 {
        if self.penetration > SMALL { self.penetration } else { 0.0 }
    }

    /// Tolerance of the limit load by the width that the footing acts with, over s_u.
    fn load_tolerance(&self) -> f64 {
        let (width, uncertainty) = self.effective_width();
        (PRANDTL * self.coarseness() + uncertainty / width + self.embedded()) * EXACT
    }

    /// Whether the ground yields, in a run that is judged.
    fn yields(&self) -> bool {
        !self.is_elastic() && self.shown_only().is_none()
    }

    /// Whether a limit load is demanded of the plateau too.
    fn has_limit(&self) -> bool {
        self.is_free_of_locking() && self.yields()
    }

    fn locks(&self) -> bool {
        self.remedy() == RemedyName::None && self.yields()
    }

    /// Relative softness of an elastic footing against one of its width. Splines are exactly rigid up to a cell inside of its
    /// edge only. To a plastic jump of velocity that matters little, but elastic pressures peak at the edge.
    fn soft_edge(&self) -> f64 {
        match self.basis() {
            Linear | Gimp | BasisName::Q8 => 0.0,
            Bspline2 | Bspline3 => WIDTH_TO_SLOPE * 2.0 * self.h / WIDTH,
        }
    }

    /// d(q/s_u)/d(s/B) of the finite elements; NaN where there are none.
    fn elastic_slope(&self) -> f64 {
        let slope = self.reference_slope().unwrap_or(f64::NAN);
        slope * self.young_modulus / self.undrained_strength
    }

    fn reference_limit(&self) -> f64 {
        self.reference_curve().map_or(f64::NAN, |c| c.limit)
    }

    /// Extent of the mechanism over the width that the footing acts with.
    fn extent(&self) -> f64 {
        mechanism_extent(self.rough) / WIDTH
    }
}

impl Run<'_, Footing> {
    /// Load over s_u above which standard MPM counts as locked.
    fn locked_load(&self) -> f64 {
        let tolerances = if self.other_points().is_some() { 1.0 } else { LOCKED };
        EXACT + tolerances * self.load_tolerance()
    }

    /// Width (B) to which the surface rises, zero where it nowhere does.
    fn risen(&self) -> f64 {
        self.metric(MECHANISM_WIDTH).max(0.0)
    }

    /// Tolerance (B) of the end of the mechanism.
    fn smeared(&self) -> f64 {
        SMEARED * self.h + self.extent() * self.effective_width().1
    }

    /// The larger miss of the plateau and the mechanism, over their tolerances.
    fn worst_miss(&self) -> f64 {
        let plateau = (self.metric(PLATEAU_RISE) - 0.5 * (FLAT.1 - FLAT.0)) / (0.5 * (FLAT.1 + FLAT.0));
        let mechanism = (self.risen() - self.extent() * self.effective_width().0) / self.smeared();
        plateau.abs().max(mechanism.abs())
    }
}

type Check = CheckOf<Footing>;
type Demand = crate::demand::Demand<Footing>;

pub(super) fn checks() -> Vec<crate::check::Check> {
    vec![
        Check::bookkeeping("particle-count", "57,600 · (h/(B/20))⁻² particles at two per direction, four times as many at four: the paper's 230,400 at B/20")
            .except(
                |c| c.domain_width != 6 || c.domain_depth != 6 || ![4, 16].contains(&c.record.discretisation.ppc),
                "counted for two or four particles per direction in a domain of 6B × 6B only",
            )
            .within(
                Quantity::new("particles", |c| c.record.work.particles as f64),
                |c| {
                    let cells = 6.0 / c.h;
                    (f64::from(c.record.discretisation.ppc) * cells * cells).round()
                },
                |_| 0.0,
            )
            .because("Zhao et al. 2023, section 4.2: 230,400 at B/20 with 4 × 4; 57,600 with 2 × 2"),
        Check::truth("elastic-slope", "all, unreachable strength: d(q/s_u)/d(s/B) that of the finite elements within 2 % at h ≤ B/20, within 4 % at B/10")
            .except(|c| !c.is_elastic(), "the ground yields: see the runs of great strength")
            .unless(|c| c.rings().or_else(|| c.reference_slope().err()))
            .within(ELASTIC_SLOPE, |c| c.elastic_slope(), |c| (FEM * c.coarseness() + c.soft_edge()) * c.elastic_slope())
            .because("finite elements that act as wide"),
        Check::truth("quasi-static", "FLIP and quasi-static runs, also below: mean force on the base that on the footing within 0.5 % over the last quarter of the penetration")
            .unless(|c| c.shown_only())
            .at_most(Quantity::abs(FORCE_IMBALANCE), |_| INERTIA)
            .because("linear momentum of a body that is pressed slowly"),
        Check::truth("prandtl", "limit load over the effective width of the footing 2 + π within 1 % at h ≤ B/20, within 2 % at B/10")
            .unless(|c| c.shown_only())
            .when(|c| c.yields())
            .unless(|c| c.no_limit())
            .within(NC_EFFECTIVE, |_| EXACT, |c| c.load_tolerance())
            .because("Prandtl 1920"),
        Check::truth("limit-load", "all: load grows by less than 0.5 % and falls by less than 1 % per 10⁻³ of s/B over the last quarter")
            .when(|c| c.yields())
            .unless(|c| c.no_limit())
            .within(PLATEAU_RISE, |_| 0.5 * (FLAT.1 - FLAT.0), |_| 0.5 * (FLAT.1 + FLAT.0))
            // The growth of a load in proportion to the penetration.
            .of_scale(|c| 1e-3 / c.penetration)
            .because("a perfectly plastic body has a limit load"),
        Check::truth("smooth-pressure", "h ≤ B/20: rms(σ_m − Πσ_m) below 0.2 rms σ_m")
            .when(|c| c.yields() && c.no_limit().is_none())
            .except(|c| c.coarseness() > 1.0, "five cells under half of the footing don't resolve the pressure's edge")
            .at_most(CHECKERBOARD_RATIO, |_| BOARD.0)
            .because("a pressure that is resolved is close to its average"),
        Check::truth("smooth-squares", "rms of σ_m less its plane of best fit in squares of 2h below 0.3 rms σ_m at h ≤ B/20, below 0.5 at B/10")
            .when(|c| c.yields() && c.no_limit().is_none() && c.metric(OSCILLATION_RATIO) >= 0.0)
            .at_most(OSCILLATION_RATIO, |c| (BOARD.2 * c.coarseness()).min(BOARD.1))
            .because("a pressure that is resolved is nearly a plane within two cells, but at the edge of the footing"),
        Check::truth("mechanism", "all: surface rises out to 1.5 times the effective width of the footing, once the width if it is smooth, within 2h")
            .when(|c| c.yields())
            .unless(|c| c.no_limit())
            .within(Quantity::new(MECHANISM_WIDTH.name, |c: &Run<Footing>| c.risen()), |c| c.extent() * c.effective_width().0, |c| c.smeared())
            .because_of(|c| {
                let whose = if c.rough { "Prandtl's" } else { "Hill's" };
                format!("{whose} mechanism; a jump of velocity is smeared over a cell on either side")
            }),
        Check::truth("mean-stress", "σ_m at five points that of finite elements of vanishing size within h |∇σ_m|")
            .when(|c| c.yields() && c.no_limit().is_none())
            .except(|c| !c.rough, "the reference is that of a rough footing")
            .unless(|c| c.other_points())
            .unless(|c| c.has_room().err())
            .each(MEAN_STRESSES.iter().map(|&(metric, point)| {
                Demand::known(metric, move |c| {
                    mean_stress_at(point).map(|known| (known.value, GRADIENT * c.h + known.uncertainty))
                })
            }))
            .because("finite elements of vanishing size"),
        Check::truth("fem-plateau", "limit load over B that of the finite elements within 2 % at h ≤ B/20, within 4 % at B/10")
            .when(|c| c.yields())
            .unless(|c| c.no_limit())
            .unless(|c| c.reference_curve().err())
            .within(NC_B, |c| c.reference_limit(), |c| (FEM * c.coarseness() + c.embedded()) * c.reference_limit())
            .because_of(|c| c.reference_curve().map_or(String::new(), |curve| curve.name)),
        Check::truth("curve", "fbar-rate, fbar-consistent: q/s_u at the tabulated s/B that of the finite elements within 2 % at h ≤ B/20, within 4 % at B/10")
            .when(|c| c.has_limit() && c.no_limit().is_none())
            .unless(|c| c.other_points())
            .own(load_curve),
        Check::known_limit("no-limit-load", "none: final growth of the load above 0.5 % per 10⁻³ of s/B")
            .when(|c| c.locks() && c.no_limit().or_else(|| c.other_points()).is_none())
            .above(PLATEAU_RISE, |_| FLAT.1)
            .because(LOCKS),
        Check::known_limit("no-mechanism", "none, fbar-recursive: worst of limit-load and mechanism over their tolerance, where it exceeds one")
            .when(|c| c.yields() && !c.has_limit() && c.no_limit().is_none() && c.worst_miss() > 1.0)
            .above(Quantity::new("worst miss", |c: &Run<Footing>| c.worst_miss()), |_| 1.0)
            .because_of(|c| if c.locks() { LOCKS } else { DIFFUSES }.to_owned()),
        Check::known_limit("rises-near-one-half", "fbar-rate, fbar-consistent at ν > 0.49: final growth of the load above 0.5 % per 10⁻³ of s/B")
            .when(|c| c.has_limit() && c.no_limit().is_none() && c.poisson_ratio > STATED)
            .above(PLATEAU_RISE, |_| FLAT.1)
            .because("Π is no projection: a change of volume that it sees in part keeps a share of a bulk modulus that grows without bound"),
        Check::known_limit("stiff-with-more-particles", "quasi-static GIMP with F̄, more than two particles per direction: load over the effective width above prandtl's tolerance")
            .when(|c| c.has_limit() && c.is_implicit() && c.basis() == Gimp && c.ppc_per_direction > 2 && c.no_limit().is_none())
            .above(NC_EFFECTIVE, |c| EXACT + c.load_tolerance())
            .because("seen at B/10 and B/20, by a tenth of the tolerance and more; not traced to a cause"),
        Check::known_limit("locked", "none: load over the effective width above 2 + π by more than twice prandtl's tolerance; by a barrier or deep, once, where it is")
            .when(|c| c.locks() && (c.other_points().is_none() || c.metric(NC_EFFECTIVE) > c.locked_load()))
            .unless(|c| c.no_limit())
            .above(NC_EFFECTIVE, |c| c.locked_load())
            .because(LOCKS),
        Check::known_limit("soft-by-diffusion", "fbar-recursive: limit load over the effective width short of 2 + π by more than the tolerance of prandtl")
            .when(|c| c.remedy() == FbarRecursive && c.yields())
            .unless(|c| c.no_limit().or_else(|| c.other_points()))
            .above(Quantity::new(NC_EFFECTIVE.name, |c: &Run<Footing>| 1.0 - c.metric(NC_EFFECTIVE) / EXACT), |c| c.load_tolerance() / EXACT)
            .because(DIFFUSES),
        Check::known_limit("checkerboard", "none: rms(σ_m − Πσ_m) above 0.5 rms σ_m")
            .when(|c| c.locks() && c.no_limit().is_none())
            .above(CHECKERBOARD_RATIO, |_| BOARD.1)
            .because(LOCKS),
        // Faster runs than the case's own ring: they are there to show it.
        Check::truth("rate-independent", "fbar-consistent: the limit load changes by less than 0.5 % when the rate is halved")
            .when(|c| c.is_default() && c.remedy() == FbarConsistent && !c.is_elastic())
            .pairs(has_half_the_rate, |_, _| NC_B.name.to_owned(), change_of_load)
            .at_most(|_| RATE)
            .because_of(|c| format!("a rate-independent law, pressed slowly: {}", halving(c))),
        Check::known_limit("rate-dependent", "fbar-recursive: the load changes by more than 0.5 % when the rate is halved")
            .when(|c| c.is_default() && c.remedy() == FbarRecursive && !c.is_elastic())
            .pairs(has_half_the_rate, |_, _| NC_B.name.to_owned(), change_of_load)
            .above(|_| RATE)
            .because_of(|c| format!("Eq. (26) averages the average and so diffuses J̄ in time: {}", halving(c))),
        Check::truth("contacts-agree", "all: the load through the barrier is that of held nodes within 2h/B")
            .study(contacts),
        Check::truth("pressure-order", "fbar-rate, fbar-consistent, nodes on grid lines, three levels: error of the contact pressure by B of order 0.85 to 1.1 (the paper's Figure 9)")
            .study(orders),
    ]
}

/// The load on the way against finite elements that act as wide.
fn load_curve(run: &Run<Footing>) -> Vec<Finding> {
    let reference = match run.whole_reference_curve() {
        Err(why) => return vec![Finding::not_applicable(CURVE[2].0, why)],
        Ok(reference) => reference,
    };
    let judged = |&(metric, penetration): &(Metric, f64)| {
        let (expected, value) = (reference.at(penetration)?, run.metric(metric));
        if value.is_nan() {
            return Some(Finding::not_applicable(metric, "no row of the series is there"));
        }
        let tolerance = FEM * run.coarseness() * expected;
        Some(Finding::within(metric, value, expected, tolerance, &*reference.name))
    };
    CURVE.iter().filter_map(judged).collect()
}

fn has_half_the_rate(run: &Run<Footing>, other: &Run<Footing>) -> bool {
    let ratio = other.penetration_rate / run.penetration_rate;
    same_but("penetration_rate", run, other) && (ratio - 0.5).abs() < 1e-9
}

fn change_of_load(run: &Run<Footing>, slower: &Run<Footing>) -> f64 {
    (slower.metric(NC_B) / run.metric(NC_B) - 1.0).abs()
}

fn halving(run: &Run<Footing>) -> String {
    let (scheme, level, rate) = (run.scheme, &run.level, run.penetration_rate);
    format!("{scheme} {level} from {rate} m/s to half of it")
}

/// Change of the load by the barrier against held nodes.
fn contacts(records: &[Record]) -> Vec<Finding> {
    let runs: Vec<Run<Footing>> = Run::all(records).collect();
    let found = |run: &Run<Footing>| {
        let (scheme, level) = (run.scheme, &run.level);
        let held = runs.iter().find(|r| r.is_default() && r.scheme == scheme && r.level == *level)?.metric(NC_B);
        let why = format!(
            "{scheme} {level}: a barrier on particles and held nodes; the edges of either are known to half a cell"
        );
        Some(Finding::within(NC_B, run.metric(NC_B), held, 2.0 * run.h / WIDTH * held, why))
    };
    runs.iter().filter(|r| r.record.changes_only("contact")).filter_map(found).collect()
}

/// The order of the error of the contact pressure by B, over runs of the case's own parameters up to any penetration.
fn orders(records: &[Record]) -> Vec<Finding> {
    let runs: Vec<Run<Footing>> = Run::all(records).collect();
    let judged = |r: &&Run<Footing>| {
        r.is_free_of_locking()
            && (r.is_default() || r.record.changes_only("penetration"))
            && r.effective_width().0 > WIDTH
    };
    let order = |scheme: Scheme| {
        let own = runs.iter().filter(|r| r.scheme == scheme).filter(judged);
        let mut points: Vec<_> = own.map(|r| (r.h, r.metric(PRANDTL_ERROR))).collect();
        points.sort_by(|a, b| b.0.total_cmp(&a.0));
        let (least, most) = ORDER;
        (points.len() >= 3).then(|| {
            Finding::within(
                PRANDTL_ERROR,
                fit_order(&points).map_or(f64::NAN, |o| o.order),
                0.5 * (least + most),
                0.5 * (most - least),
                format!("{scheme}: the error is the footing's excess width h/B, to first order"),
            )
        })
    };
    crate::distinct(runs.iter().map(|r| r.scheme)).into_iter().filter_map(order).collect()
}
