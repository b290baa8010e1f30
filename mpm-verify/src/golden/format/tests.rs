//! Files of goldens: what is read back, what is refused, how much a number may move.

use super::*;
use crate::record::fixture::record;

fn point(time: Option<f64>, value: f64, response: f64) -> Point {
    (time, value, response).into()
}

fn column(quantity: &str, points: &[Point]) -> Column {
    let (quantity, points) = (quantity.to_owned(), points.to_vec());
    Column { quantity, points }
}

fn run(name: &str, columns: Vec<Column>) -> Run {
    let name = name.to_owned();
    Run { name, columns }
}

/// Two runs, with a metric, a series of two columns of two rows, and a count.
fn golden() -> Golden {
    let series = |quantity, values: [f64; 2], response| {
        let [first, last] = values;
        let points = [point(Some(0.5), first, 0.0), point(Some(1.0), last, response)];
        column(quantity, &points)
    };
    let columns = vec![
        Column::single("metric/tip (m)".to_owned(), -2.5, 1e-12),
        series("series/tip (m)", [1.0, 0.1], 1e-12),
        series("series/gap (-)", [3.0, 1e-9], 0.0),
        Column::single("work/steps".to_owned(), 195.0, 2.0),
    ];
    let blessings = ["2026-01-01: first", "2026-01-02: second"];
    Golden {
        blessings: blessings.map(str::to_owned).into(),
        runs: vec![run("a/h2", columns.clone()), run("b/h2", columns)],
    }
}

const TEXT: &str = r#"{"schema":3,"blessings":[
"2026-01-01: first",
"2026-01-02: second"
],"runs":[
{"name":"a/h2","columns":[
{"quantity":"metric/tip (m)","points":[[null,-2.5,1e-12]]},
{"quantity":"series/tip (m)","points":[[0.5,1.0,0.0],[1.0,0.1,1e-12]]},
{"quantity":"series/gap (-)","points":[[0.5,3.0,0.0],[1.0,1e-9,0.0]]},
{"quantity":"work/steps","points":[[null,195.0,2.0]]}
]},
{"name":"b/h2","columns":[
{"quantity":"metric/tip (m)","points":[[null,-2.5,1e-12]]},
{"quantity":"series/tip (m)","points":[[0.5,1.0,0.0],[1.0,0.1,1e-12]]},
{"quantity":"series/gap (-)","points":[[0.5,3.0,0.0],[1.0,1e-9,0.0]]},
{"quantity":"work/steps","points":[[null,195.0,2.0]]}
]}
]}
"#;

#[test]
fn a_file_reads_back_as_it_was() {
    let golden = golden();
    assert_eq!(golden.text().unwrap(), TEXT);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.json");
    golden.write(&path).unwrap();
    assert_eq!(Golden::read(&path).unwrap(), golden);
    assert_eq!(golden.run("b/h2"), Some(&golden.runs[1]));
    assert_eq!(golden.run("c/h2"), None);
    assert!(golden.runs[0].has_series() && !run("c", golden.runs[0].columns[..1].into()).has_series());
}

#[test]
fn damaged_files_of_goldens_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.json");
    let refused = |text: &str, named: &str| {
        std::fs::write(&path, text).unwrap();
        let error = Golden::read(&path).unwrap_err().to_string();
        assert!(error.contains("case.json") && error.contains(named), "{error}\n{text}");
    };
    for (old, new, named) in [
        ("first", "fi\\trst", "control characters"),
        ("first", "fi\trst", "control character"),
        ("\"schema\":3,", "", "no schema"),
        ("schema\":3", "schema\":2", "schema 2 where 3 is expected"),
        ("quantity", "name", "missing field `quantity` at line 6"),
        ("-2.5", "null", "invalid type: null, expected f64 at line 6"),
        ("-2.5", "NaN", "expected value at line 6"),
        ("-2.5", "1e999", "number out of range at line 6"),
        ("195.0", "\"x\"", "expected f64 at line 9"),
        (",195.0,2.0", ",195.0", "invalid length 2"),
        ("[[null,-2.5,1e-12]]", "[]", "tip (m): no number"),
        ("b/h2", "a/h2", "a/h2 metric/tip (m) is there twice"),
        ("0.5,1.0,0.0", "1.0,1.0,0.0", "series/tip (m) is there"),
        ("0.5,3.0,0.0", "0.5,3.0,1e-10", "not in order"),
        ("195.0,2.0", "195.0,20.0", "count responds by 0 to 19.5"),
        ("195.0,2.0", "195.0,-1.0", "golden responds by 0 to"),
        ("1e-12", "2.6e-9", "0 to 1e-9 of its scale, 2.5e0"),
        ("-2.5,1e-12", "-2.5,-1e-12", "golden responds by 0"),
        ("1e-9", "0.000000001", "not laid out"),
        ("\"name\"", "\"more\":1,\"name\"", "not laid out"),
        ("\n]}\n]}\n", "\n]}\n]}\n\n", "not laid out"),
        ("\n]}\n", "\n]}\r\n", "not laid out"),
        ("{\"s", "\u{feff}{\"s", "expected value at line 1"),
    ] {
        assert!(TEXT.contains(old), "{old}");
        refused(&TEXT.replacen(old, new, 1), named);
    }
    refused(&TEXT[..TEXT.len() - 9], "EOF while parsing");
    refused("", "EOF while parsing");
    let none = Golden { blessings: Vec::new(), ..golden() };
    none.write(&path).unwrap();
    let error = Golden::read(&path).unwrap_err().to_string();
    assert!(error.contains("no line of a blessing"), "{error}");
}

/// A number by the floor of its column's scale, a count by ten responses.
#[test]
fn numbers_may_move_as_far_as_rounding_takes_them() {
    let scale = column("metric/tip (m)", &[point(None, -2.5, 0.0)]);
    assert_eq!((scale.scale(), scale.tolerance(&scale.points[0])), (2.5, 2.5e-7));
    let series = &golden().runs[0].columns[1];
    // Scale of the column, not of the row.
    assert_eq!((series.scale(), series.tolerance(&series.points[1])), (1.0, 1e-7));
    assert_eq!((series.response(), series.is_blunt()), (1e-12, false));
    assert!(!series.is_count() && series.is_loose().is_none());
    let count = column("work/steps", &[point(None, 195.0, 2.0)]);
    assert_eq!((count.is_count(), count.tolerance(&count.points[0])), (true, 20.0));
    let still = column("work/steps", &[point(None, 195.0, 0.0)]);
    assert_eq!(still.tolerance(&still.points[0]), 0.0);
    let blunt = |response| column("metric/tip (m)", &[point(None, 10.0, response)]).is_blunt();
    assert_eq!([0.0, 0.9e-8, 1.1e-8].map(blunt), [false, false, true]);
    let nothing = |response| column("metric/tip (m)", &[point(None, 0.0, response)]).is_blunt();
    assert_eq!([0.0, 1e-300].map(nothing), [false, true]);
    let loose = |count, response| column("work/steps", &[point(None, count, response)]).is_loose();
    assert_eq!([10.0, 10.5].map(|r| loose(20.0, r)), [None, Some(10.0)]);
    assert_eq!([50.0, 50.5].map(|r| loose(500.0, r)), [None, Some(50.0)]);
    assert!(!column("work/steps", &[point(None, 20.0, 10.5)]).is_blunt());
}

#[test]
fn a_blessing_replaces_what_it_blesses() {
    let mut golden = golden();
    golden.runs.push(run("dropped/h2", Vec::new()));
    let new = run("a/h2", vec![column("metric/tip (m)", &[point(None, 7.0, 0.0)])]);
    let first = run("new/h2", Vec::new());
    let unplanned = run("unplanned/h2", Vec::new());
    let planned = ["new/h2", "b/h2", "a/h2"].map(str::to_owned);
    let of = record("h2", Vec::new());
    let others = golden.runs[1].clone();
    golden.bless(vec![new.clone(), first.clone(), unplanned], &planned, &of, "  it is\nright ");
    assert_eq!(golden.runs, [first, others, new]);
    assert_eq!(golden.blessings.len(), 3);
    let (day, said) = golden.blessings[2].split_once(": ").unwrap();
    assert_eq!(day.len(), 10);
    assert_eq!(said, "it is right (source 0123456789ab, linux x86_64)");
    for k in 0..4 {
        golden.bless(Vec::new(), &planned, &of, &k.to_string());
    }
    let kept: Vec<&str> = golden.blessings.iter().map(|b| &b[12..14]).collect();
    assert_eq!(kept, ["it", "0 ", "1 ", "2 ", "3 "]);
}

/// A curve a scheme, at the setting that most of those with a series have.
#[test]
fn a_picture_shows_schemes_beside_each_other() {
    let mut golden = golden();
    let columns = golden.runs[0].columns.clone();
    let names = |golden: &Golden| -> Vec<String> { golden.shown().into_iter().map(|run| run.name).collect() };
    assert_eq!(names(&golden), ["a/h2", "b/h2"]);
    // The first among equally frequent levels; the more frequent level otherwise.
    golden.runs.push(run("a/h1", columns.clone()));
    golden.runs.push(run("b/h1", columns.clone()));
    assert_eq!(names(&golden), ["a/h2", "b/h2"]);
    golden.runs.push(run("c/h1", columns.clone()));
    assert_eq!(names(&golden), ["a/h1", "b/h1", "c/h1"]);
    // Without a series there is nothing to show.
    golden.runs[3].columns.truncate(1);
    assert_eq!(names(&golden), ["a/h2", "b/h2"]);
    let many = (0..SHOWN + 1).map(|k| run(&format!("{k}/h4"), columns.clone()));
    golden.runs.extend(many);
    assert_eq!((golden.shown().len(), &*golden.shown()[0].name), (SHOWN, "0/h4"));
    golden.runs.clear();
    assert!(golden.shown().is_empty());
}
