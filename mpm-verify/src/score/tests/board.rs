//! The board: what a submission must be, and how methods stand.

use super::together::levels;
use super::*;
use crate::score::board::{Method, Standing, read};

/// The board of a submission.
fn board(result: &Answer) -> Result<Vec<Method>, Error> {
    read(&[result.folder.path().to_owned()])
}

/// Cells of the levels of the beam.
const SIZES: [f64; 3] = [0.1, 0.05, 0.025];

/// The beam at three levels, of which each run says more.
fn beam(errors: [f64; 3], more: impl Fn(usize, &mut Value)) -> Answer {
    levels(errors, |manifest| {
        for (k, run) in manifest["runs"].as_array_mut().unwrap().iter_mut().enumerate() {
            run["cell_size_m"] = json!(SIZES[k]);
            more(k, run);
        }
    })
}

#[test]
fn a_method_is_right_only_where_all_its_levels_are() {
    use Standing::{BrokeDown, NotJudged, NotPossible, Right, RightOnAll, Wrong};
    for (runs, together, standing) in [
        (&[Right, Right][..], false, RightOnAll),
        // Right by themselves, and their errors do not fall.
        (&[Right, Right], true, Right),
        (&[Right], false, Right),
        (&[Right, Wrong], false, Right),
        (&[Right, NotJudged], false, Right),
        (&[Wrong, BrokeDown], false, Wrong),
        (&[BrokeDown, NotJudged], false, BrokeDown),
        (&[NotPossible], false, NotPossible),
        (&[], false, NotJudged),
    ] {
        assert_eq!(Standing::over(runs, together), standing, "{runs:?} {together}");
    }
}

/// Only the deflection of the corner is given: the stress stays open.
#[test]
fn a_method_shows_its_errors_over_tolerance_and_its_orders() {
    let method = |errors| board(&beam(errors, |_, _| ())).unwrap().remove(0);
    let right = method([4e-3, 1e-3, 2.5e-4]);
    assert_eq!((right.standing, &*right.runs[0].why), (Standing::NotJudged, "stress"));
    assert_eq!(right.runs.iter().map(|run| &*run.level).collect::<Vec<_>>(), ["h0.1", "h0.05", "h0.025"]);
    let order = right.orders.iter().find(|(name, _)| name == "corner_error").unwrap().1;
    assert!((order - 2.0).abs() < 1e-6, "{order}");
    // On both sides of one.
    let used = |errors| method(errors).runs[2].worst.clone().unwrap();
    assert!(used([4e-3, 1e-3, 2.5e-4]).0 < 1.0 && used([4e-3, 1e-3, 0.5]).0 > 1.0);
    // The error is 2000 times as large, and so is its share of the tolerance.
    let ratio = used([4e-3, 1e-3, 0.5]).0 / used([4e-3, 1e-3, 2.5e-4]).0;
    assert!((ratio / 2000.0 - 1.0).abs() < 1e-3, "{ratio}");
    assert_eq!(used([4e-3, 1e-3, 0.5]).1, "corner");
    let wrong = method([0.5; 3]);
    assert_eq!((wrong.standing, &*wrong.runs[2].why), (Standing::Wrong, "corner"));
}

#[test]
fn what_did_not_finish_is_told_apart_from_what_is_wrong() {
    let ended = |status: &'static str| {
        let result = beam([4e-3, 1e-3, 2.5e-4], |k, run| {
            if k == 2 {
                (run["status"], run["said"]) = (json!(status), json!("an element was inverted"));
                run.as_object_mut().unwrap().remove("particles");
            }
        });
        board(&result).unwrap().remove(0)
    };
    for (status, standing) in [("broke down", Standing::BrokeDown), ("not possible", Standing::NotPossible)] {
        let method = ended(status);
        assert_eq!((method.runs[0].standing, method.runs[2].standing), (Standing::NotJudged, standing));
        assert_eq!(method.runs[2].why, "an element was inverted");
        assert!(method.runs[2].worst.is_none());
    }
    let unknown = beam([4e-3; 3], |_, run| run["status"] = json!("crashed"));
    assert!(unknown.refusal().contains("unknown variant `crashed`, expected one of `finished`, `broke down`"));
    // The gate of a single result fails as well.
    let result = beam([4e-3; 3], |_, run| run["status"] = json!("broke down"));
    let scores = result.scores().unwrap();
    assert_eq!(gate::gate(false, &[]).exit_code(&scores), crate::error::ExitCode::TruthFailed);
}

#[test]
fn cells_of_another_size_are_refused_and_the_board_asks_for_them() {
    let finer = beam([4e-3, 1e-3, 2.5e-4], |k, run| {
        if k == 0 {
            run["cell_size_m"] = json!(0.05);
        }
    });
    assert!(finer.refusal().contains("run 1: cell_size_m: 0.05; allowed: 0.1, that of the level h0.1"));
    let silent = levels([4e-3, 1e-3, 2.5e-4], |_| ());
    assert!(silent.scores().is_ok());
    assert!(board(&silent).unwrap_err().to_string().contains("cell_size_m: it is missing"));
    let nothing = tempfile::tempdir().unwrap();
    assert!(read(&[nothing.path().to_owned()]).unwrap_err().to_string().contains("no score.json in it"));
}

/// A table without the particles that are bad, with those of smaller cells, or with some elsewhere.
#[test]
fn particles_cover_the_body_as_those_of_the_level_do() {
    let result = Answer::exported("cook", "h2", &[]);
    let given = |places: &[[f64; 2]]| {
        let column = |a: usize| places.iter().map(|x| x[a]).collect::<Vec<f64>>();
        let none = vec![0.0; places.len()];
        let columns = [
            ("reference_x (m)", column(0)),
            ("reference_y (m)", column(1)),
            ("ux (m)", none.clone()),
            ("uy (m)", none),
        ];
        Table::of_columns(columns).write(&result.path("particles.csv")).unwrap();
        result.edit(|manifest| {
            manifest.as_object_mut().unwrap().remove("series");
        });
        result.score().map(|_| ()).map_err(|e| e.to_string())
    };
    let start = Table::read(&result.path("start.csv")).unwrap();
    let places: Vec<[f64; 2]> = start.points("x", "y").into_iter().map(|(x, y)| [x, y]).collect();
    assert!(given(&places).is_ok());
    let holed: Vec<[f64; 2]> = places.iter().copied().filter(|[x, y]| (x - 20.0).hypot(y - 35.0) > 4.0).collect();
    assert!(given(&holed).unwrap_err().contains("no particle starts within a cell (2 m) of ("));
    let beyond = [&places[..], &[[60.0, 50.0]]].concat();
    assert!(given(&beyond).unwrap_err().contains("a particle starts at (60, 50) m, where no body is"));
    let apart = |n: u32| {
        let parts = (0..n * n).map(move |k| [k % n, k / n].map(|k| (f64::from(k) + 0.5) / f64::from(n) - 0.5));
        places.iter().flat_map(|[x, y]| parts.clone().map(move |[a, b]| [x + a, y + b])).collect::<Vec<_>>()
    };
    assert!(given(&apart(2)).is_ok());
    assert!(given(&apart(3)).unwrap_err().contains("particles; allowed: up to 5792 on cells of 2 m"));
}

/// Known limits excuse our own runs no more than those of others.
#[test]
fn ours_are_judged_by_the_same_rule() {
    let (case, foreign) = find_scored("cook").unwrap();
    let parameters = Parameters::new(&case.parameters, &[]).unwrap();
    let ours = |remedy, error: f64| {
        let scheme = crate::scheme::Scheme::flip(BasisName::Gimp, remedy);
        let spec = spec(scheme, find_level(case, "h1").unwrap(), &[]);
        let discretisation = (foreign.discretisation)(&spec, &parameters).unwrap();
        let mut record = Record::blank("cook", &spec, &parameters, discretisation, 1);
        record.work.steps = 20_000;
        let metrics = foreign.groups.iter().flat_map(|g| &g.metrics);
        record.metrics = metrics.map(|m| measured((*m, if m.name.contains("error") { error } else { 0.0 }))).collect();
        Method::of_ours("cook", &[&record]).unwrap()
    };
    let locked = ours(crate::scheme::RemedyName::None, -0.06);
    assert_eq!((locked.standing, locked.code.as_str()), (Standing::Wrong, "this program"));
    assert!(locked.runs[0].why.contains("mid-edge"), "{:?}", locked.runs);
    // One that broke down says so, as that of a stranger.
    let scheme = crate::scheme::Scheme::flip(BasisName::Gimp, crate::scheme::RemedyName::None);
    let spec = spec(scheme, find_level(case, "h1").unwrap(), &[]);
    let discretisation = (foreign.discretisation)(&spec, &parameters).unwrap();
    let mut record = Record::blank("cook", &spec, &parameters, discretisation, 1);
    record.status = crate::record::Status::Failed;
    record.error = Some(crate::record::Failure::told("off the grid".to_owned()));
    let method = Method::of_ours("cook", &[&record]).unwrap();
    assert_eq!((method.standing, &*method.runs[0].why), (Standing::BrokeDown, "off the grid"));
}

/// Where none of ours is kept a score says so, and a long name of a code does not widen its table.
#[test]
fn a_score_says_where_no_run_of_ours_stands_beside_it() {
    let result = Answer::exported("cook", "h2", &["load=0.9"]);
    let start = Table::read(&result.path("start.csv")).unwrap();
    let none = vec![0.0; start.rows()];
    let columns = ["reference_x (m)", "reference_y (m)"].map(|name| (name, start.get(name).unwrap().to_vec()));
    let columns = columns.into_iter().chain(["ux (m)", "uy (m)"].map(|name| (name, none.clone())));
    Table::of_columns(columns).write(&result.path("particles.csv")).unwrap();
    result.edit(|manifest| {
        manifest.as_object_mut().unwrap().remove("series");
        manifest["code"]["name"] = json!("n".repeat(200));
    });
    let scores = result.scores().unwrap();
    let told = crate::report::scored::text(&scores, &crate::report::scored::beside(&scores).unwrap());
    assert!(told.contains("Our runs: none is kept of this level and these parameters."), "{told}");
    assert!(told.lines().filter(|line| line.contains("nnn")).skip(1).all(|line| line.chars().count() <= 100), "{told}");
}

/// Templates with nothing of a code in them: their results are read, and wrong.
#[test]
fn the_templates_give_results_that_are_read() {
    let templates = Path::new(env!("CARGO_MANIFEST_DIR")).join("codes/template");
    let result = Answer::exported("cook", "h2", &[]);
    let out = result.path("");
    let ran = |program: &str, arguments: &[&Path]| {
        std::process::Command::new(program).args(arguments).status().ok().map(|status| status.success())
    };
    let binary = result.folder.path().join("template");
    let compiled = ran("g++", &["-std=c++17".as_ref(), &templates.join("template.cpp"), "-o".as_ref(), &binary]);
    let runs = [
        ran("python3", &[&templates.join("template.py"), &out]),
        compiled.and_then(|_| ran(&binary.to_string_lossy(), &[&out, "2.0".as_ref()])),
    ];
    for (k, _) in runs.iter().enumerate().filter(|(_, ran)| ran.is_some()) {
        assert_eq!(runs[k], Some(true), "template {k}");
    }
    if runs.iter().any(Option::is_some) {
        let methods = board(&result).unwrap();
        assert_eq!((methods[0].code.as_str(), methods[0].standing), ("my code", Standing::Wrong));
    }
}

/// A text that stands for a number is the name of a parameter, with a sign or a factor.
#[test]
fn problems_as_data_name_parameters_of_their_case() {
    let all: BTreeMap<String, Value> = serde_json::from_str(include_str!("../../../assets/problems.json")).unwrap();
    assert!(all.len() > 5);
    for (name, problem) in all {
        let (case, foreign) = find_scored(&name).unwrap();
        let result = Answer::exported(&name, case.levels[0].name, &[]);
        assert_eq!(result.json("problem.json")["problem"], problem);
        let is_known = |text: &str| {
            let word = text.trim_start_matches(|c: char| c == '-' || c.is_ascii_digit() || ". ".contains(c));
            case.parameters.iter().any(|p| p.name == word)
        };
        let texts = |value: &Value| {
            let mut open = vec![value.clone()];
            let mut found = Vec::new();
            while let Some(value) = open.pop() {
                match value {
                    Value::String(text) => found.push(text),
                    Value::Array(all) => open.extend(all),
                    Value::Object(all) => open.extend(all.into_iter().map(|(_, value)| value)),
                    _ => {}
                }
            }
            found
        };
        let body = &problem["body"];
        let numbers = [&problem["grid"], &body["polygon_m"], &body["segment_m"], &problem["law"]["parameters"]];
        for text in numbers.into_iter().flat_map(texts) {
            assert!(is_known(&text), "{name}: {text}");
        }
        let demanded = texts(&problem["demanded"]);
        assert!(foreign.parts().iter().any(|part| demanded.iter().any(|d| d == part.name())), "{name}");
    }
}
