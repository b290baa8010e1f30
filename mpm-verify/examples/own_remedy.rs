//! A remedy of one's own, judged by the bench: J̄ⁿ⁺¹ = J̄ⁿ Π(ΔJ), where only the increment is averaged. `fbar-rate` has the
//! same formula, so that the two runs of Cook's membrane below agree to the last bit.

use mpm_core::Memoryless;
use mpm_core::explicit::remedy::{Columns, Filled, Known, Mean, Remedy};
use mpm_verify::case::find_level;
use mpm_verify::record::Record;
use mpm_verify::scheme::{Scheme, set_own_remedy};
use mpm_verify::spec::RunSpec;
use mpm_verify::study::judge::judged_run;
use mpm_verify::{cases, error::Error};
use std::io::{Write, stdout};

struct Own;

impl Memoryless for Own {}

impl<const D: usize> Remedy<D> for Own {
    fn columns(&self, n: usize) -> Columns {
        Columns { next: vec![0.0; n], ..Columns::default() }
    }

    fn next_j_bar(&self, known: Known<'_>, filled: &mut Filled<'_>, average: Mean<'_>) {
        filled.next.copy_from_slice(known.volume_change);
        average(filled.next);
        for (next, j_bar) in filled.next.iter_mut().zip(known.j_bar) {
            *next *= j_bar;
        }
    }
}

fn judged(case: &str, scheme: &str, level: &str) -> Result<Record, Error> {
    let case = cases::find(case)?;
    let (scheme, level) = (Scheme::parse(scheme)?, find_level(case, level)?);
    let spec = RunSpec { scheme, level, set: Vec::new(), perturbed: false };
    judged_run(case, &spec, None, 1, &|_| ())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    set_own_remedy::<2>(|| Box::new(Own))?;
    let [own, rate] = [judged("cook", "gimp-own-flip", "h2")?, judged("cook", "gimp-fbar-rate-flip", "h2")?];
    for verdict in &own.verdicts {
        writeln!(stdout(), "{:?}  {}", verdict.outcome, verdict.check)?;
    }
    assert!(!own.metrics.is_empty(), "the run broke down");
    assert_eq!(own.metrics, rate.metrics);
    Ok(())
}

#[test]
fn it_agrees_with_the_same_remedy_of_the_bench_and_is_refused_where_it_is_not_set() {
    assert!(judged("cook", "gimp-own-flip", "h2").is_err());
    main().unwrap();
    for (case, scheme, level) in [("mms-swirl", "gimp-own-flip", "n8"), ("cook", "quasi-static-gimp-own", "h2")] {
        assert!(judged(case, scheme, level).is_err(), "{case} {scheme}");
    }
    assert!(set_own_remedy::<2>(|| Box::new(Own)).is_err());
}
