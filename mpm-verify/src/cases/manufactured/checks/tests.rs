use super::super::metrics::DISPLACEMENT_RATIO;
use super::*;
use crate::parameter::Parameters;
use crate::record::Measured;
use crate::record::fixture::record;
use crate::scheme::RuleName;
use crate::verdict::{Outcome, Verdict};

use Outcome::{Failed, NotJudged, Right, WrongAsKnown};

/// A run at cell size 1/n with an error.
fn run(n: f64, metric: Metric, value: f64) -> Record {
    let mut r = record(&format!("n{n}"), Vec::new());
    r.discretisation.h = 1.0 / n;
    let unit = "m".to_owned();
    let value = value.is_finite().then_some(value);
    r.metrics.insert(metric.into(), Measured { value, unit });
    r
}

/// Runs with errors h^p.
fn of_order(p: f64) -> Vec<Record> {
    let error = |n: f64| run(n, DISPLACEMENT_L2, n.powf(-p));
    [8.0, 16.0, 32.0, 64.0].map(error).to_vec()
}

fn verdicts(checks: &[Check], records: &[Record]) -> Vec<Verdict> {
    checks.iter().flat_map(|c| c.of_study(records)).collect()
}

fn outcomes(checks: &[Check], records: &[Record]) -> Vec<(String, Outcome)> {
    let verdicts = verdicts(checks, records).into_iter();
    verdicts.map(|v| (v.check, v.outcome)).collect()
}

const SECOND: &[(Metric, Claims)] = &[(DISPLACEMENT_L2, |_| Claim::Second)];
const STALLS: &[(Metric, Claims)] = &[(DISPLACEMENT_L2, |_| Claim::Stalls(0.5, ""))];
const BAND: &[(Metric, Claims)] = &[(DISPLACEMENT_L2, |_| Claim::Observed([1.0, 1.5], ""))];
const OPEN: &[(Metric, Claims)] = &[(DISPLACEMENT_L2, |_| Claim::Open(""))];

#[test]
fn an_order_below_the_formal_one_is_red_and_no_order_is_too() {
    let gate = |records: &[Record]| outcomes(&orders(SECOND), records);
    let named = |order, falls| {
        vec![
            ("order-displacement".to_owned(), order),
            ("error-falls".to_owned(), falls),
        ]
    };
    assert_eq!(gate(&of_order(1.9)), named(Right, Right));
    assert_eq!(gate(&of_order(1.8)), named(Failed, Right));
    assert_eq!(gate(&of_order(-0.1)), named(Failed, Failed));
    let mut broken = of_order(2.0);
    broken[2] = run(32.0, DISPLACEMENT_L2, f64::NAN);
    assert_eq!(gate(&broken), named(Failed, Failed));
    assert!(
        gate(&of_order(2.0)[..2]).is_empty(),
        "two levels have no order"
    );
}

#[test]
fn a_known_stall_that_vanishes_is_red() {
    let of = |claims, p| outcomes(&orders(claims), &of_order(p))[0].1;
    assert_eq!(of(STALLS, 0.1), WrongAsKnown);
    assert_eq!(of(STALLS, 1.0), Failed);
    assert_eq!(of(BAND, 1.2), Right);
    assert_eq!(of(BAND, 2.0), Failed);
    assert_eq!(of(OPEN, 0.0), NotJudged);
}

/// A run with a Poisson's ratio.
fn at_ratio(remedy: RemedyName, ratio: &str, error: f64) -> Record {
    let mut r = run(8.0, DISPLACEMENT_L2, error);
    r.scheme = Scheme::flip(BasisName::Gimp, remedy);
    r.set = vec![format!("poisson_ratio={ratio}")];
    r.parameters = Parameters::new(&[POISSON_RATIO], &r.set).unwrap();
    r
}

#[test]
fn locking_is_the_error_over_that_of_the_compressible_body() {
    let judged = |remedy, factor| {
        let pair = [
            at_ratio(remedy, "0.3", 1.0),
            at_ratio(remedy, "0.4999", factor),
        ];
        outcomes(&locking(), &pair)
    };
    let free = |outcome| [("no-locking".to_owned(), outcome)];
    let locks = |outcome| [("locks".to_owned(), outcome)];
    assert_eq!(judged(RemedyName::FbarConsistent, 1.1), free(Right));
    assert_eq!(judged(RemedyName::FbarConsistent, 1.3), free(Failed));
    assert_eq!(judged(RemedyName::None, 8.0), locks(WrongAsKnown));
    assert_eq!(judged(RemedyName::None, 1.0), locks(Failed));
}

#[test]
fn the_order_in_time_comes_from_successive_differences() {
    let at = |cfl: f64, order: i32| {
        let mut r = run(16.0, DISPLACEMENT_RATIO, 1.0 + 0.1 * cfl.powi(order));
        r.discretisation.dt = cfl;
        r.set = vec![format!("cfl={cfl}")];
        r
    };
    let judged = |order| {
        let runs = [0.4, 0.2, 0.1].map(|cfl| at(cfl, order));
        verdicts(&order_in_time(), &runs).remove(0)
    };
    for order in [1, 2] {
        let verdict = judged(order);
        assert_eq!(verdict.outcome, Right);
        assert!((verdict.value.unwrap() - f64::from(order)).abs() < 1e-9);
    }
    assert!(judged(0).failed());
}

#[test]
fn an_implicit_order_in_time_hangs_on_the_mass() {
    use crate::cases::parameters::{CFL, LUMPED};
    let judged = |rule, set: &[&str], order: f64| {
        let at = |cfl: f64| {
            let value = 1.0 + 0.1 * cfl.powf(order);
            let mut r = run(16.0, DISPLACEMENT_RATIO, value);
            r.scheme = Scheme::implicit(rule, BasisName::Bspline2, RemedyName::None);
            r.discretisation.dt = cfl;
            let own = set.iter().map(|s| (*s).to_owned());
            r.set = own.chain([format!("cfl={cfl}")]).collect();
            r.parameters = Parameters::new(&[CFL, LUMPED], &r.set).unwrap();
            r
        };
        outcomes(&order_in_time(), &[0.4, 0.2, 0.1].map(at))
    };
    let truth = |outcome| vec![("order-time".to_owned(), outcome)];
    let limit = |outcome| vec![("order-time-lost".to_owned(), outcome)];
    let (midpoint, newmark) = (RuleName::Midpoint, RuleName::Newmark);
    let [consistent, lumped]: [&[&str]; 2] = [&["lumped=0"], &["lumped=1"]];
    assert_eq!(judged(midpoint, consistent, 2.0), truth(Right));
    assert_eq!(judged(midpoint, consistent, 1.9), truth(Failed));
    assert_eq!(judged(midpoint, consistent, 2.1), truth(Failed));
    assert_eq!(judged(midpoint, &[], 1.9), truth(NotJudged));
    assert_eq!(judged(midpoint, lumped, 1.5), limit(WrongAsKnown));
    assert_eq!(judged(midpoint, lumped, 2.0), limit(Failed));
    assert_eq!(judged(newmark, &[], 1.5), limit(WrongAsKnown));
}

/// Outcomes of the checks of a motion on a run whose error is so many times the motion.
fn of_error(claims: &'static [(Metric, Claims)], share: f64) -> Vec<(String, Outcome)> {
    let mut r = at_ratio(RemedyName::None, "0.3", share);
    let all = [POISSON_RATIO, YOUNG_MODULUS, DENSITY, ANGULAR_FREQUENCY];
    r.parameters = Parameters::new(&all, &r.set).unwrap();
    r.metrics.insert(
        DISPLACEMENT_SCALE.into(),
        Measured {
            value: Some(1.0),
            unit: "m".to_owned(),
        },
    );
    let wave = Wave {
        number: |_| 16.0,
        shear: true,
    };
    let checks = of_motion(claims, wave);
    let judged = checks
        .iter()
        .filter(|c| c.kind != crate::verdict::Kind::Bookkeeping);
    let verdicts = judged.flat_map(|c| c.of_run(&r));
    verdicts.map(|v| (v.check, v.outcome)).collect()
}

#[test]
fn an_error_above_the_motion_is_wrong_as_known_or_failed() {
    let bound = |outcome| ("error-bound".to_owned(), outcome);
    let lost = ("motion-lost".to_owned(), WrongAsKnown);
    assert_eq!(of_error(SECOND, 0.9), [bound(Right)]);
    assert_eq!(of_error(SECOND, 1.1), [bound(Failed)]);
    assert_eq!(of_error(OPEN, 0.9), [bound(NotJudged)]);
    assert_eq!(of_error(OPEN, 1.1), [bound(NotJudged), lost]);
}
