//! The checks turn red when they should.

use super::super::parameters::ALL;
use super::*;
use crate::record::fixture::{self, outcomes};
use crate::verdict::Verdict;

fn judge(record: &Record) -> Vec<Verdict> {
    checks().iter().flat_map(|c| c.of_run(record)).collect()
}

fn judge_study(records: &[Record]) -> Vec<Verdict> {
    checks().iter().flat_map(|c| c.of_study(records)).collect()
}

/// A run of a scheme on cells of size `h` (B), with metrics.
fn run(scheme: (BasisName, RemedyName), h: f64, set: &[&str], metrics: &[(&str, f64)]) -> Record {
    let level = format!("b{}", (1.0 / h).round());
    fixture::run(&ALL, scheme, (&level, h), set, metrics)
}

const OURS: (BasisName, RemedyName) = (BasisName::Gimp, RemedyName::FbarConsistent);

#[test]
fn a_ground_that_rings_is_shown_and_not_judged() {
    let sets: [&[&str]; 4] = [
        &[],
        &["density=1e6"],
        &["young_modulus=1e4"],
        &["penetration=0.0001"],
    ];
    let judged = sets.map(|set| {
        let run = run(OURS, 0.1, set, &[("force_imbalance", 1.0)]);
        outcomes(&judge(&run), "quasi-static")
    });
    let [own, rest @ ..] = judged;
    assert_eq!(own, [Some(false)]);
    for outcomes in rest {
        assert_eq!(outcomes, [None]);
    }
}

#[test]
fn the_order_of_the_pressure_is_that_of_the_width() {
    let at = |scheme, error: fn(f64) -> f64| {
        let levels = [0.1, 0.05, 0.025];
        let runs = levels.map(|h| run(scheme, h, &[], &[("prandtl_error", error(h))]));
        outcomes(&judge_study(&runs), "pressure-order")
    };
    assert_eq!(at(OURS, |h| h), [Some(true)]);
    assert_eq!(at(OURS, |h| h.sqrt()), [Some(false)]);
    assert_eq!(at(OURS, |h| h * h), [Some(false)]);
    assert_eq!(at(OURS, |_| 0.1), [Some(false)]);
    // A footing of quadratic splines is as wide as it acts; standard MPM has no limit load.
    let splines = (BasisName::Bspline2, RemedyName::FbarConsistent);
    assert_eq!(at(splines, |h| h), []);
    assert_eq!(at((BasisName::Gimp, RemedyName::None), |h| h), []);
}

#[test]
fn two_levels_make_no_order() {
    let runs = [0.1, 0.05].map(|h| run(OURS, h, &[], &[("prandtl_error", h)]));
    assert_eq!(outcomes(&judge_study(&runs), "pressure-order"), []);
}

#[test]
fn the_rate_matters_to_one_remedy_alone() {
    let pair = |remedy, change: f64| {
        let scheme = (BasisName::Gimp, remedy);
        let runs = [
            run(scheme, 0.1, &[], &[("nc_b", 5.7)]),
            run(
                scheme,
                0.1,
                &["penetration_rate=1e-3"],
                &[("nc_b", 5.7 * (1.0 - change))],
            ),
        ];
        judge_study(&runs)
    };
    let independent = |change| {
        let verdicts = pair(RemedyName::FbarConsistent, change);
        outcomes(&verdicts, "rate-independent")
    };
    assert_eq!(independent(0.004), [Some(true)]);
    assert_eq!(independent(0.006), [Some(false)]);
    let dependent = |change| {
        let verdicts = pair(RemedyName::FbarRecursive, change);
        outcomes(&verdicts, "rate-dependent")
    };
    assert_eq!(dependent(0.02), [Some(true)]);
    assert_eq!(dependent(0.004), [Some(false)]);
}

#[test]
fn another_yield_convention_misses_prandtl() {
    // ‖s‖ = √2 s_u; as √(3/2)‖s‖ ≤ √2 s_u or as a diameter of Tresca the strength is another.
    for (factor, expected) in [
        (1.0, true),
        (1.009, true),
        (1.5_f64.sqrt().recip(), false),
        (2.0 / 3.0_f64.sqrt(), false),
    ] {
        let metrics = [("nc_effective", factor * EXACT)];
        let verdicts = judge(&run(OURS, 0.05, &[], &metrics));
        assert_eq!(outcomes(&verdicts, "prandtl"), [Some(expected)], "{factor}");
    }
}

#[test]
fn the_number_of_particles_is_the_papers() {
    let count = |particles, ppc| {
        let mut record = run(OURS, 0.05, &[], &[]);
        record.discretisation.ppc = ppc;
        record.work.particles = particles;
        outcomes(&judge(&record), "particle-count")
    };
    assert_eq!(count(230_400, 16), [Some(true)]);
    assert_eq!(count(57_600, 4), [Some(true)]);
    assert_eq!(count(57_601, 4), [Some(false)]);
    assert_eq!(count(57_600, 9), [None]);
}

#[test]
fn a_fast_or_small_penetration_is_not_judged() {
    let fast = run(OURS, 0.1, &["penetration_rate=4e-3"], &[]);
    assert_eq!(outcomes(&judge(&fast), "prandtl"), [None]);
    let short = run(OURS, 0.1, &["penetration=0.001"], &[]);
    assert_eq!(outcomes(&judge(&short), "prandtl"), [None]);
}

#[test]
fn the_mechanism_ends_within_two_cells_of_prandtls() {
    let at = |scheme, width| {
        let metrics = [("mechanism_width", width)];
        outcomes(&judge(&run(scheme, 0.05, &[], &metrics)), "mechanism")
    };
    assert_eq!(at(OURS, 1.575 + 0.09), [Some(true)]);
    assert_eq!(at(OURS, 1.575 - 0.11), [Some(false)]);
    let cubic = (BasisName::Bspline3, RemedyName::FbarConsistent);
    assert_eq!(at(cubic, 1.45), [Some(true)]);
    assert_eq!(at(cubic, 1.35), [Some(false)]);
}

#[test]
fn the_finite_elements_agree_with_prandtl_and_are_found() {
    let splines = (BasisName::Bspline2, RemedyName::FbarConsistent);
    let vanishing = curve(&run(splines, 0.05, &[], &[])).unwrap();
    assert!((vanishing.limit - EXACT).abs() < 0.003);
    let elements = curve(&run(OURS, 0.05, &[], &[])).unwrap();
    assert!((elements.limit / 1.05 - EXACT).abs() < 0.01 * EXACT);
    for curve in [vanishing, elements] {
        assert!(CURVE.iter().all(|(_, s)| curve.at(*s).is_some()));
        assert_eq!(curve.at(0.0123), None);
    }
    assert!(
        MEAN_STRESSES
            .iter()
            .all(|(_, x)| mean_stress_at(*x).is_some())
    );
    assert!(curve(&run(OURS, 0.03, &[], &[])).is_err());
    assert!(has_the_curve_of(&run(OURS, 0.05, &["poisson_ratio=0.3"], &[]).parameters).is_err());
}

const STANDARD: (BasisName, RemedyName) = (BasisName::Gimp, RemedyName::None);

/// Outcomes of a check for a value that is just good and for one that is just not.
fn edge(scheme: (BasisName, RemedyName), check: &str, metric: &str, good: f64, bad: f64) {
    let of = |value| outcomes(&judge(&run(scheme, 0.05, &[], &[(metric, value)])), check);
    let judged = (of(good), of(bad));
    let expected = (vec![Some(true)], vec![Some(false)]);
    assert_eq!(judged, expected, "{check} {metric}");
}

#[test]
fn every_verdict_on_one_run_has_an_edge() {
    edge(OURS, "quasi-static", "force_imbalance", -0.0049, 0.0051);
    edge(OURS, "limit-load", "plateau_rise", 0.0049, 0.0051);
    edge(OURS, "limit-load", "plateau_rise", -0.0099, -0.0101);
    edge(OURS, "smooth-pressure", "checkerboard_ratio", 0.19, 0.21);
    let elements = 5.37651;
    edge(
        OURS,
        "fem-plateau",
        "nc_b",
        1.019 * elements,
        0.979 * elements,
    );
    edge(STANDARD, "no-limit-load", "plateau_rise", 0.0051, 0.0049);
    edge(STANDARD, "checkerboard", "checkerboard_ratio", 0.51, 0.49);
    edge(
        STANDARD,
        "locked",
        "nc_effective",
        1.021 * EXACT,
        1.019 * EXACT,
    );
}

#[test]
fn the_curve_is_that_of_the_elements() {
    let reference = curve(&run(OURS, 0.05, &[], &[])).unwrap();
    let outcome = |factor: f64| {
        let at = |(metric, s): &(Metric, f64)| (metric.name, factor * reference.at(*s).unwrap());
        let metrics: Vec<(&str, f64)> = CURVE.iter().map(at).collect();
        outcomes(&judge(&run(OURS, 0.05, &[], &metrics)), "curve")
    };
    assert_eq!(outcome(1.019), vec![Some(true); CURVE.len()]);
    assert_eq!(outcome(0.979), vec![Some(false); CURVE.len()]);
}

#[test]
fn the_mean_stress_is_that_of_the_elements_to_a_cells_gradient() {
    let outcome = |cells: f64| {
        let mut record = run(OURS, 0.05, &[], &[]);
        for &(metric, x) in MEAN_STRESSES {
            let point = mean_stress_at(x).unwrap();
            let value = point.value + point.uncertainty + cells * 0.05 * GRADIENT;
            let measured = crate::record::Measured {
                value: Some(value),
                unit: "-".to_owned(),
            };
            record.metrics.insert(metric.into(), measured);
        }
        outcomes(&judge(&record), "mean-stress")
    };
    assert_eq!(outcome(0.99), [Some(true); 5]);
    assert_eq!(outcome(1.01), [Some(false); 5]);
}

#[test]
fn the_elastic_slope_is_that_of_the_elements() {
    let strong = ["undrained_strength=1e6"];
    let slope = elastic_slope(&run(OURS, 0.05, &strong, &[])).unwrap();
    let outcome = |factor: f64| {
        // E = 10⁶ Pa, as the strength.
        let metrics = [("elastic_slope", factor * slope)];
        outcomes(&judge(&run(OURS, 0.05, &strong, &metrics)), "elastic-slope")
    };
    assert_eq!(outcome(1.019), [Some(true)]);
    assert_eq!(outcome(1.021), [Some(false)]);
}

#[test]
fn contacts_agree_within_two_cells() {
    let outcome = |ratio: f64| {
        let runs = [
            run(OURS, 0.05, &[], &[("nc_b", 5.4)]),
            run(OURS, 0.05, &["contact=barrier"], &[("nc_b", 5.4 * ratio)]),
        ];
        outcomes(&judge_study(&runs), "contacts-agree")
    };
    assert_eq!(outcome(1.09), [Some(true)]);
    assert_eq!(outcome(0.89), [Some(false)]);
}
