use super::*;
use crate::cases::manufactured::metrics::DISPLACEMENT_RATIO;
use crate::problem::measured;
use crate::record::fixture::{changed, record};
use crate::verdict::Verdict;

/// A run of a scheme at cell size 1/n with a value of a metric and some changed parameters.
fn run(scheme: Scheme, n: f64, (metric, value): (Metric, f64), set: &[&str]) -> Record {
    let known = [POISSON_RATIO, crate::cases::parameters::LUMPED];
    let mut r = record(&format!("n{n}"), Vec::new());
    r.set = changed(set);
    r.scheme = scheme;
    r.discretisation.h = 1.0 / n;
    let own: Vec<String> = r.set.iter().filter(|s| !s.starts_with("cfl=")).cloned().collect();
    r.parameters = Parameters::new(&known, &own).unwrap();
    r.metrics.extend([measured((metric, value))]);
    r
}

fn verdicts(checks: &[Check], records: &[Record]) -> Vec<Verdict> {
    checks.iter().flat_map(|c| c.of_study(records)).collect()
}

const SECOND: &[(Metric, Claims)] = &[(DISPLACEMENT_L2, |_| Claim::Second)];

#[test]
fn an_order_is_that_of_the_errors_and_a_run_without_one_leaves_none() {
    let scheme = Scheme::flip(Gimp, FbarConsistent);
    let ladder = |p: f64| {
        let error = |n: f64| run(scheme, n, (DISPLACEMENT_L2, n.powf(-p)), &[]);
        [8.0, 16.0, 32.0, 64.0].map(error)
    };
    for (p, fails) in [(1.9, [false, false]), (1.8, [true, false]), (-0.1, [true, true])] {
        let found = verdicts(&orders(SECOND), &ladder(p));
        assert!((found[0].value.unwrap() - p).abs() < 1e-9, "{p}");
        assert!((found[1].value.unwrap() - 2f64.powf(-p)).abs() < 1e-9, "{p}");
        assert_eq!([found[0].failed(), found[1].failed()], fails, "{p}");
    }
    let mut broken = ladder(2.0);
    broken[2] = run(scheme, 32.0, (DISPLACEMENT_L2, f64::NAN), &[]);
    assert!(verdicts(&orders(SECOND), &broken).iter().all(Verdict::failed));
    assert!(verdicts(&orders(SECOND), &broken[..2]).is_empty());
}

#[test]
fn locking_is_the_error_over_that_of_the_compressible_body() {
    for (remedy, check) in [(FbarConsistent, "no-locking"), (RemedyName::None, "locks")] {
        let at = |ratio: &str, error: f64| {
            let set = format!("poisson_ratio={ratio}");
            run(Scheme::flip(Gimp, remedy), 8.0, (DISPLACEMENT_L2, error), &[&set])
        };
        let found = verdicts(&locking(), &[at("0.3", 2.0), at("0.499", 7.0)]);
        let found: Vec<_> = found.iter().map(|v| (&*v.check, v.value)).collect();
        assert_eq!(found, [(check, Some(3.5))]);
    }
}

#[test]
fn the_order_in_time_comes_from_successive_differences() {
    let explicit = Scheme::flip(Gimp, RemedyName::None);
    let [midpoint, newmark] =
        [RuleName::Midpoint, RuleName::Newmark].map(|rule| Scheme::implicit(rule, Bspline2, RemedyName::None));
    for (scheme, lumped, check) in [
        (explicit, "lumped=0.1", "order-time"),
        (midpoint, "lumped=0", "order-time"),
        (midpoint, "lumped=1", "order-time-lost"),
        (newmark, "lumped=0.1", "order-time-lost"),
    ] {
        let at = |cfl: f64| {
            let ratio = (DISPLACEMENT_RATIO, 1.0 + 0.1 * cfl.powf(1.5));
            let mut r = run(scheme, 16.0, ratio, &[&format!("cfl={cfl}"), lumped]);
            r.discretisation.dt = cfl;
            r
        };
        let found = verdicts(&order_in_time(), &[0.4, 0.2, 0.1].map(at)).remove(0);
        assert_eq!(found.check, check);
        assert!((found.value.unwrap() - 1.5).abs() < 1e-9, "{found:?}");
    }
}
