//! The gate: drift, blessing, damaged goldens.

use super::scene::{RUN, SHOWN, Scene};
use super::{code, files, json, stderr, stdout};
use serde_json::json;
use std::fs;

/// The cells of the row of a quantity of [`RUN`] changed; of a series, of its first row.
fn row(quantity: &str, change: impl Fn(&mut [String])) -> impl Fn(&str) -> String {
    move |text| {
        let start = format!("{RUN},{quantity}");
        let mut done = false;
        let line = |line: &str| {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            if !done && line.starts_with(&start) {
                change(&mut cells);
                done = true;
            }
            cells.join(",") + "\n"
        };
        text.lines().map(line).collect()
    }
}

/// A file of goldens with the run and the quantity of each row written out.
fn spelt_out(text: &str) -> String {
    let mut above = [String::new(), String::new()];
    changed_rows(text, |cells| {
        for (cell, above) in cells.iter_mut().zip(&mut above) {
            match cell.is_empty() {
                true => cell.clone_from(above),
                false => above.clone_from(cell),
            }
        }
    })
}

/// The same as the program lays it out: without what the row above has, too.
fn laid_out(text: &str) -> String {
    let mut above = Vec::new();
    changed_rows(text, |cells| {
        let own = cells.to_vec();
        if above.first() == own.first() {
            cells[0].clear();
            if above.get(1) == own.get(1) {
                cells[1].clear();
            }
        }
        above = own;
    })
}

fn changed_rows(text: &str, mut change: impl FnMut(&mut [String])) -> String {
    let mut line = |line: &str| {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        if !line.starts_with('#') && cells.len() > 1 {
            change(&mut cells);
        }
        cells.join(",")
    };
    text.split_inclusive('\n').map(&mut line).collect()
}

/// A number as goldens have it.
fn written(number: f64) -> String {
    let text = format!("{number:?}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

fn scaled(cell: &mut String, factor: f64) {
    *cell = written(cell.parse::<f64>().unwrap() * factor);
}

/// With the number of rows that there are.
fn counted(text: &str) -> String {
    let rows = text.lines().filter(|l| !l.starts_with('#')).count() - 1;
    let (_, rest) = text.split_once('\n').unwrap();
    format!("# format 2, {rows} rows\n{rest}")
}

#[test]
fn a_sound_report_holds_against_its_goldens() {
    let scene = Scene::new();
    assert_eq!(code(&scene.report()), 0);
    assert_eq!(scene.drift(), [""; 0]);
}

#[test]
fn every_defect_of_a_golden_is_a_clear_line_of_drift() {
    type Damage = (&'static str, Box<dyn Fn(&str) -> String>, &'static str);
    let without = |keep: fn(&&str) -> bool| {
        move |t: &str| {
            t.lines()
                .filter(keep)
                .map(|l| l.to_owned() + "\n")
                .collect::<String>()
        }
    };
    let first = |t: &str| t.lines().find(|l| l.starts_with(RUN)).unwrap().to_owned() + "\n";
    let value = |text: &'static str| row("metric/tip_uy", move |c| c[3] = text.to_owned());
    let response = |text: &'static str| row("metric/tip_uy", move |c| c[4] = text.to_owned());
    let damages: [Damage; 29] = [
        (
            "byte order mark",
            Box::new(|t| format!("\u{feff}{t}")),
            "control characters",
        ),
        (
            "carriage returns",
            Box::new(|t| t.replace('\n', "\r\n")),
            "control characters",
        ),
        (
            "empty line at the end",
            Box::new(|t| t.to_owned() + "\n"),
            "not laid out",
        ),
        (
            "number written otherwise",
            Box::new(row("metric/tip_uy", |c| c[3].push('0'))),
            "not laid out",
        ),
        (
            "quotes",
            Box::new(row("metric/tip_uy", |c| c[3] = format!("\"{}\"", c[3]))),
            "not laid out",
        ),
        (
            "a count that says nothing",
            Box::new(row("work/steps", |c| c[4] = "1e9".to_owned())),
            "a count responds by",
        ),
        ("empty", Box::new(|_| String::new()), "no line \"# format"),
        (
            "other format",
            Box::new(|t| t.replacen("format 2", "format 7", 1)),
            "format 7 where 2",
        ),
        (
            "no blessing",
            Box::new(without(|l| !l.starts_with("# 20"))),
            "no line of a blessing",
        ),
        (
            "other columns",
            Box::new(|t| t.replacen("value", "reference", 1)),
            "columns other than",
        ),
        (
            "run missing",
            Box::new(move |t| counted(&without(|l| !l.starts_with(RUN))(t))),
            "new: not yet blessed",
        ),
        (
            "rows cut",
            Box::new(without(|l| !l.contains("tip_uy (m)"))),
            "rows where",
        ),
        (
            "number cut",
            Box::new(|t| t[..t.len() - 9].to_owned()),
            "cook.csv",
        ),
        (
            "cell missing",
            Box::new(row("metric/tip_uy", |c| c[4].clear())),
            "row",
        ),
        ("NaN", Box::new(value("NaN")), ": NaN"),
        ("infinite", Box::new(value("inf")), ": inf"),
        ("not a number", Box::new(value("x")), ": x"),
        (
            "time not a number",
            Box::new(row("series/tip_uy", |c| c[2] = "soon".to_owned())),
            ": soon",
        ),
        (
            "another time",
            Box::new(row("series/tip_uy", |c| scaled(&mut c[2], 1.001))),
            "no such number",
        ),
        (
            "other unit",
            Box::new(row("metric/tip_uy", |c| {
                c[1] = "metric/tip_uy (mm)".to_owned()
            })),
            "tip_uy (mm): the run has no such",
        ),
        (
            "other column",
            Box::new(row("series/tip_uy", |c| c[1] = "series/tip (m)".to_owned())),
            "series tip (m)",
        ),
        (
            "twice",
            Box::new(move |t| counted(&(t.to_owned() + &first(t)))),
            "is there twice",
        ),
        (
            "rows not in order",
            Box::new(row("series/tip_uy", |c| c[2] = "1e9".to_owned())),
            "not in order",
        ),
        ("too loose", Box::new(response("0.1")), "responds by 0 to"),
        (
            "below nothing",
            Box::new(response("-1e-20")),
            "responds by 0 to",
        ),
        (
            "a millionth",
            Box::new(row("metric/tip_uy", |c| scaled(&mut c[3], 1.000_001))),
            "tip_uy (m): golden",
        ),
        (
            "a millionth in a row",
            Box::new(row("series/log_jacobian", |c| {
                let scale = 1e-3;
                c[3] = written(c[3].parse::<f64>().unwrap() + scale);
            })),
            "series log_jacobian",
        ),
        (
            "a count more",
            Box::new(row("work/steps", |c| {
                c[3] = (c[3].parse::<u64>().unwrap() + 1).to_string();
            })),
            "count of steps: golden",
        ),
        (
            "a pair more",
            Box::new(row("work/particle_node_pairs", |c| {
                c[3] = (c[3].parse::<u64>().unwrap() + 1).to_string();
            })),
            "count of particle_node_pairs: golden",
        ),
    ];
    let scene = Scene::new();
    let file = scene.golden.join("cook.csv");
    let sound = fs::read_to_string(&file).unwrap();
    let all = spelt_out(&sound);
    assert_eq!(laid_out(&all), sound);
    for (name, damage, needle) in damages {
        let damaged = damage(&all);
        assert_ne!(damaged, all, "{name}: nothing to change");
        fs::write(&file, laid_out(&damaged)).unwrap();
        let drift = scene.drift();
        assert!(
            drift.iter().any(|line| line.contains(needle)),
            "{name}: {drift:?}"
        );
    }
    let (head, rows) = sound.split_once("response\n").unwrap();
    let first = &rows[rows.find(',').unwrap()..];
    for (text, needle) in [
        (format!("{head}response\n{first}"), "row 1: no run"),
        (all, "not laid out"),
    ] {
        fs::write(&file, text).unwrap();
        assert!(scene.drift()[0].contains(needle), "{:?}", scene.drift());
    }
    fs::write(&file, b"run,\xff\n").unwrap();
    assert!(scene.drift()[0].contains("UTF-8"));
    fs::remove_file(&file).unwrap();
    assert!(scene.drift()[0].contains("new: not yet blessed"));
    let output = scene.report();
    assert_eq!(code(&output), 3, "{}{}", stdout(&output), stderr(&output));
    assert!(stdout(&output).contains("FAILED [DRIFT] cook gimp-none-flip/h2"));

    fs::remove_dir_all(&scene.golden).unwrap();
    for output in [scene.report(), scene.bless("no folder")] {
        assert_eq!(code(&output), 2);
        assert!(
            stderr(&output).contains("no folder of goldens"),
            "{}",
            stderr(&output)
        );
    }
}

/// The picture is compared pixel by pixel, and rounding changes none.
#[test]
fn a_picture_drifts_with_its_drawing_or_its_numbers_but_not_with_rounding() {
    let scene = Scene::new();
    let (file, series) = (
        scene.golden.join("cook.png"),
        scene.report.join("cook").join(SHOWN).join("series.csv"),
    );
    let (sound, rows) = (
        fs::read(&file).unwrap(),
        fs::read_to_string(&series).unwrap(),
    );
    let pixels = "different pixels of the picture: golden 0, now ";
    for damage in [&b"\x89PNG broken"[..], b""] {
        fs::write(&file, damage).unwrap();
        assert!(scene.drift()[0].contains("cook.png"));
    }
    fs::write(&file, [&sound[..], b"more"].concat()).unwrap();
    assert!(scene.drift()[0].contains("cook.png: not laid out"));
    let mut other = image::load_from_memory(&sound).unwrap().to_rgb8();
    other.put_pixel(5, 5, image::Rgb([9; 3]));
    other.save(&file).unwrap();
    assert!(scene.drift()[0].contains(&format!("{pixels}1,")));
    fs::remove_file(&file).unwrap();
    assert!(scene.drift()[0].contains("cook.png"));
    fs::write(&file, sound).unwrap();
    for (factor, drifts) in [(1.0 + 1e-9, false), (1.01, true)] {
        let line = |(k, line): (usize, &str)| {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            if k > 0 {
                scaled(&mut cells[1], factor);
            }
            cells.join(",") + "\n"
        };
        fs::write(
            &series,
            rows.lines().enumerate().map(line).collect::<String>(),
        )
        .unwrap();
        let drift = scene.drift();
        assert_eq!(
            drift.iter().any(|line| line.contains(pixels)),
            drifts,
            "{drift:?}"
        );
        assert_eq!(drift.is_empty(), !drifts);
    }
}

/// A particle of the field may move by half a pixel.
#[test]
fn a_field_drifts_where_the_eye_sees_it() {
    let scene = Scene::new();
    let run = scene.report.join("cook").join(SHOWN).join("particles.csv");
    let sound = fs::read_to_string(&run).unwrap();
    let change = |column: usize, by: f64| {
        let line = |(k, line): (usize, &str)| {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            if k == 9 {
                cells[column] = (cells[column].parse::<f64>().unwrap() + by).to_string();
            }
            cells.join(",") + "\n"
        };
        let changed: String = sound.lines().enumerate().map(line).collect();
        fs::write(&run, changed).unwrap();
        scene.drift()
    };
    let header = sound.lines().next().unwrap();
    let stress = header.split(',').position(|c| c.starts_with("mean_stress"));
    for (column, by) in [(0, 1.0), (1, -1.0), (stress.unwrap(), 0.5)] {
        assert_eq!(change(column, 0.01 * by), [""; 0]);
        let drift = change(column, by);
        let tells = |what: &str| drift.iter().any(|line| line.contains(what));
        assert!(
            tells("particles of the field that differ: golden 0, now 1,"),
            "{drift:?}"
        );
        assert!(tells("different pixels of the field"), "{drift:?}");
    }
    fs::write(&run, &sound).unwrap();
    for file in ["cook-field.csv", "cook-field.png"] {
        let path = scene.golden.join(file);
        let kept = fs::read(&path).unwrap();
        fs::write(&path, &kept[..20]).unwrap();
        assert!(scene.drift()[0].contains(file));
        fs::remove_file(&path).unwrap();
        assert!(scene.drift()[0].contains(file));
        fs::write(&path, kept).unwrap();
    }
    assert_eq!(scene.drift(), [""; 0]);
}

#[test]
fn drift_is_shown_named_and_accepted_with_a_reason() {
    let scene = Scene::new();
    // A golden of other numbers, as if the solver had changed since.
    let file = scene.golden.join("cook.csv");
    let old = row("metric/tip_uy", |c| c[3] = "0.27".to_owned());
    let sound = fs::read_to_string(&file).unwrap();
    fs::write(&file, laid_out(&old(&spelt_out(&sound)))).unwrap();
    let output = scene.report();
    assert_eq!(code(&output), 3);
    let said = stdout(&output);
    let words: Vec<&str> = said.split_whitespace().collect();
    let line = words.join(" ");
    assert!(line.contains("tip_uy (m): golden 0.27, now "), "{said}");
    assert!(said.contains("bless cook --reason"), "{said}");
    let summary = fs::read_to_string(scene.report.join("summary.md")).unwrap();
    assert!(summary.contains("## Drift") && summary.contains("bless cook --reason"));
    let shown = scene.report.join(format!("cook/drift/{RUN}.png"));
    let picture = image::open(&shown).unwrap().to_rgb8();
    assert!(
        picture.width() > 3 * 480,
        "old, new and difference side by side"
    );

    assert_eq!(code(&scene.bless("  ")), 2);
    let output = scene.bless("the load's place\nhas changed");
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    let said = stdout(&output);
    assert!(
        said.contains("golden 0.27") && said.contains("1 goldens blessed"),
        "{said}"
    );
    // The numbers are what they were, to the last digit that is kept; the blessing has a line.
    let blessed = fs::read_to_string(&file).unwrap();
    let numbers = |t: &str| {
        t.lines()
            .filter(|l| !l.starts_with('#'))
            .collect::<Vec<_>>()
            .join("\n")
    };
    assert_eq!(numbers(&blessed), numbers(&sound));
    let last = blessed.lines().nth(2).unwrap();
    assert!(
        last.starts_with("# 20") && last.contains(": the load's place has changed (source "),
        "{last}"
    );
    assert_eq!(code(&scene.report()), 0);
    assert!(!shown.exists(), "what no longer drifts is no longer shown");
    assert!(stdout(&scene.bless("again")).contains("0 goldens blessed"));
    assert_eq!(fs::read_to_string(&file).unwrap(), blessed);
}

/// One step more is drift; the pairs of a case are the sum over its runs.
#[test]
fn work_is_compared_exactly_and_summed() {
    let scene = Scene::new();
    let mut record = json(&scene.record());
    let steps = record["work"]["steps"].as_u64().unwrap();
    record["work"]["steps"] = json!(steps + 1);
    fs::write(scene.record(), record.to_string()).unwrap();
    let drift = scene.drift();
    assert!(
        drift.len() == 1 && drift[0].contains("count of steps"),
        "{drift:?}"
    );

    // Of the pr tier's runs only those of the quick tier are blessed here.
    let error = mpm_verify::golden::pairs(&scene.golden, "cook")
        .unwrap_err()
        .to_string();
    assert!(error.contains("cook.csv: no golden of "), "{error}");
}

#[test]
fn a_result_that_misses_the_truth_cannot_be_blessed() {
    let scene = Scene::new();
    scene.falsify("mid_edge_uy", 1.05);
    let before = files(&scene.golden);
    let output = scene.bless("it is what the code gives");
    assert_eq!(code(&output), 1);
    let said = stdout(&output);
    assert!(
        said.contains("refused") && said.contains("mid-edge"),
        "{said}"
    );
    assert!(files(&scene.golden) == before);
    // Both are red: the truth decides.
    assert_eq!(code(&scene.report()), 1);
}

#[test]
fn results_of_another_program_cannot_be_blessed() {
    let scene = Scene::new();
    let records = files(&scene.report).into_keys();
    for record in records.filter(|f| f.ends_with("record.json")) {
        let path = scene.report.join(record);
        let old = fs::read_to_string(&path).unwrap();
        let new = old.replace("\"source\": \"", "\"source\": \"0");
        assert_ne!(old, new);
        fs::write(path, new).unwrap();
    }
    let output = scene.bless("why not");
    assert_eq!(code(&output), 2);
    assert!(
        stderr(&output).contains("run `verify` first"),
        "{}",
        stderr(&output)
    );
}
