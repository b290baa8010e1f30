//! Ends of ranges: zero, where it is allowed, gives what is right for it, or the parameter is named.

use super::progress::so_far;
use mpm_verify::cases;
use mpm_verify::parameter::{Domain, Parameters};
use mpm_verify::run::checkpoint::Saving;
use mpm_verify::run::{Progress, series};
use mpm_verify::spec::RunSpec;
use mpm_verify::study::judge::judged_run;
use mpm_verify::table::Table;
use std::time::Duration;

/// Cases that take hundredths of a second; the last one of a short duration.
const CASES: &str = "mms-axis mms-wall-pressure mms-vortex-ring mms-vortex-box mms-vortex-pressure mms-double-shear \
                     mms-static vibrating-bar standing-wave translate shock column";

#[test]
fn zero_where_it_is_allowed_is_right_or_refused_by_name() {
    let mut tried = 0;
    for name in CASES.split(' ') {
        let short = (name == "column").then(|| "duration=0.005".to_owned());
        let case = cases::find(name).unwrap();
        for p in &case.parameters {
            let Domain::Number { least, .. } = p.domain else {
                continue;
            };
            if least > 0.0 || p.parse("0").is_err() {
                continue;
            }
            tried += 1;
            let set = short.iter().cloned().chain([format!("{}=0", p.name)]).collect();
            let spec = RunSpec { scheme: case.default_scheme(None), level: case.levels[0], set, perturbed: false };
            let folder = tempfile::tempdir().unwrap();
            let every = Duration::from_secs(3600);
            let saving = Saving { every, resume: false };
            let place = Some((folder.path(), saving));
            let record = match judged_run(case, &spec, place, 1, &|_| {}) {
                Ok(record) => record,
                Err(refusal) => {
                    assert!(refusal.to_string().contains(p.name), "{name}: {refusal}");
                    continue;
                }
            };
            let failed = record.verdicts.iter().find(|v| v.failed());
            assert!(failed.is_none(), "{name} {}: {failed:?}", p.name);
            let rows = Table::read(&folder.path().join(series::FILE)).unwrap();
            for (header, column) in rows.iter() {
                let finite = column.iter().all(|x| x.is_finite());
                assert!(finite, "{name} {}: {header}", p.name);
            }
        }
    }
    assert!(tried > 40, "{tried}");
}

/// Expected result at the end of a range.
enum End {
    /// All that is judged holds.
    Right,
    /// A refusal that names the parameter.
    Refused,
    /// All that is judged holds, and this check is not judged.
    NotJudged(&'static str),
}

/// Ends of ranges at which a run once failed.
const ENDS: [(&str, &str, End); 20] = [
    ("cantilever", "young_modulus=1e-3", End::Refused),
    ("cantilever", "young_modulus=1e12", End::Right),
    ("cantilever", "weight=1", End::Right),
    ("cantilever", "weight=1e6", End::Refused),
    ("cantilever", "tolerance=1e-13", End::Right),
    ("cantilever", "points_per_direction=1", End::Refused),
    ("terzaghi", "young_modulus=1e-3", End::Refused),
    ("terzaghi", "young_modulus=1e12", End::Right),
    ("terzaghi", "load=1e6", End::Refused),
    ("mandel", "young_modulus=1e-3", End::Refused),
    ("mandel", "load=0.001", End::Right),
    ("mandel", "load=1e6", End::Refused),
    ("slope-stability", "young_modulus=1000", End::Refused),
    ("strip", "young_modulus=1e-3", End::Refused),
    ("footing", "young_modulus=1e-3", End::Refused),
    ("dam-break", "bulk_modulus=1e5", End::Refused),
    ("excavation", "lumped=0", End::Refused),
    ("mms-static", "ppc_per_direction=1", End::Refused),
    ("mms-axis", "half_waves=7", End::Right),
    ("mms-axis", "half_waves=16", End::NotJudged("error-bound")),
];

#[test]
fn the_ends_of_ranges_are_right_or_told() {
    for (name, set, end) in ENDS {
        let case = cases::find(name).unwrap();
        let spec = RunSpec {
            scheme: case.default_scheme(None),
            level: case.levels[0],
            set: vec![set.to_owned()],
            perturbed: false,
        };
        let made = judged_run(case, &spec, None, 1, &|_| {});
        let record = match (made, &end) {
            (Err(refusal), End::Refused) => {
                let parameter = set.split('=').next().unwrap();
                assert!(refusal.to_string().contains(parameter), "{name}: {refusal}");
                continue;
            }
            (Ok(record), End::Right | End::NotJudged(_)) => record,
            (other, _) => panic!("{name} {set}: {other:?}"),
        };
        let failed = record.verdicts.iter().find(|v| v.failed());
        assert!(failed.is_none(), "{name} {set}: {failed:?}");
        if let End::NotJudged(check) = end {
            let mut of = record.verdicts.iter().filter(|v| v.check == check);
            assert!(of.all(|v| v.holds().is_none()), "{name} {set}");
        }
    }
}

/// Messages and checkpoints come with rows: the steps of a row are bounded, however long the run.
#[test]
fn a_row_of_a_long_run_has_so_many_steps_at_most() {
    let case = cases::find("vibrating-bar").unwrap();
    let spec = RunSpec {
        scheme: case.default_scheme(None),
        level: case.levels[0],
        set: vec!["amplitude=0".to_owned(), "duration=1e5".to_owned()],
        perturbed: false,
    };
    let parameters = Parameters::new(&case.parameters, &spec.set).unwrap();
    let mut job = (case.begin)(&spec, &parameters).unwrap();
    job.advance().unwrap();
    assert_eq!(job.work().steps, 100_000);
    assert_eq!(job.pulse().steps(), 100_000);
    assert!(job.pulse().time() > 0.0 && job.progress() < 1e-3);
}

/// Progress lines of a run without a terminal.
#[test]
fn a_run_tells_how_far_it_has_come() {
    let (share, steps, time) = (0.0, 2000, 0.25);
    let mut now = Progress { share, steps, time };
    let early = so_far(now, 10.0);
    assert_eq!(early, "step 2000, t = 2.5000e-1 s, 200 steps/s");
    now.share = 0.001;
    assert!(so_far(now, 10.0).ends_with(", 0 %, at most 2.8 h left"));
}
