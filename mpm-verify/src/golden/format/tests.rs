//! Files of goldens: what is read back, what is refused, how much a number may move.

use super::*;
use crate::record::fixture::record;

fn point(time: Option<f64>, value: f64, response: f64) -> Point {
    Point {
        time,
        value,
        response,
    }
}

fn column(quantity: &str, points: &[Point]) -> Column {
    Column {
        quantity: quantity.to_owned(),
        points: points.to_vec(),
    }
}

fn run(name: &str, columns: Vec<Column>) -> Run {
    Run {
        name: name.to_owned(),
        columns,
    }
}

/// Two runs, with a metric, a series of two columns of two rows, and a count.
fn golden() -> Golden {
    let columns = || {
        vec![
            column("metric/tip (m)", &[point(None, -2.5, 1e-12)]),
            column(
                "series/tip (m)",
                &[point(Some(0.5), 1.0, 0.0), point(Some(1.0), 0.1, 1e-12)],
            ),
            column(
                "series/gap (-)",
                &[point(Some(0.5), 3.0, 0.0), point(Some(1.0), 1e-9, 0.0)],
            ),
            column("work/steps", &[point(None, 195.0, 2.0)]),
        ]
    };
    Golden {
        blessings: vec![
            "2026-01-01: first".to_owned(),
            "2026-01-02: second".to_owned(),
        ],
        runs: vec![run("a/h2", columns()), run("b/h2", columns())],
    }
}

const TEXT: &str = "# format 2, 12 rows
# 2026-01-01: first
# 2026-01-02: second
run,quantity,time,value,response
a/h2,metric/tip (m),,-2.5,1e-12
,series/tip (m),0.5,1,0
,,1,0.1,1e-12
,series/gap (-),0.5,3,0
,,1,1e-9,0
,work/steps,,195,2
b/h2,metric/tip (m),,-2.5,1e-12
,series/tip (m),0.5,1,0
,,1,0.1,1e-12
,series/gap (-),0.5,3,0
,,1,1e-9,0
,work/steps,,195,2
";

#[test]
fn a_file_reads_back_as_it_was() {
    let golden = golden();
    assert_eq!(golden.text().unwrap(), TEXT.as_bytes());
    assert_eq!(Golden::parse(TEXT).unwrap(), golden);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.csv");
    golden.write(&path).unwrap();
    assert_eq!(Golden::read(&path).unwrap(), golden);
    assert_eq!(golden.run("b/h2"), Some(&golden.runs[1]));
    assert_eq!(golden.run("c/h2"), None);
    assert!(
        golden.runs[0].has_series() && !run("c", golden.runs[0].columns[..1].into()).has_series()
    );
}

#[test]
fn what_is_no_file_of_goldens_is_refused() {
    let with = |old: &str, new: &str| {
        assert!(TEXT.contains(old), "{old}");
        TEXT.replacen(old, new, 1)
    };
    for (text, named) in [
        (with("first", "fi\trst"), "control characters"),
        (with("# format 2, ", "# format 2 "), "no line \"# format"),
        (with(" rows", ""), "no line \"# format"),
        (with("12 rows", "many rows"), "no line \"# format"),
        (with("format 2", "format 1"), "format 1 where 2 is expected"),
        (with("12 rows", "13 rows"), "12 rows where 13 are expected"),
        (with("12 rows", "11 rows"), "12 rows where 11 are expected"),
        (
            with("time", "at"),
            "columns other than run, quantity, time, value, response",
        ),
        (with("a/h2,", ","), "row 1: no run"),
        (with(",195,2", ",195"), "found record with 4 fields"),
        (with("-2.5", "NaN"), "a/h2 metric/tip (m), row 1: NaN"),
        (with("0.1", "inf"), "a/h2 series/tip (m), row 3: inf"),
        (
            with("0.5,3,0", "-inf,3,0"),
            "a/h2 series/gap (-), row 4: -inf",
        ),
        (with("195", "x"), "a/h2 work/steps, row 6: x"),
        (with(",2\n", ",NaN\n"), "a/h2 work/steps, row 6: NaN"),
        (
            with("b/h2", "a/h2"),
            "a/h2 metric/tip (m) is there twice or not in order",
        ),
        (
            with("0.5,1,0", "1,1,0"),
            "a/h2 series/tip (m) is there twice or not in order",
        ),
        (
            with("0.5,3,0", "0.5,3,1e-10"),
            "a/h2 series/gap (-) is there twice or not in order",
        ),
        (
            with("195,2", "195,20"),
            "a/h2 work/steps: a count responds by 0 to 19.5",
        ),
        (
            with("195,2", "195,-1"),
            "a/h2 work/steps: a golden responds by 0 to",
        ),
        (
            with("-2.5,1e-12", "-2.5,2.6e-9"),
            "a/h2 metric/tip (m): a golden responds by 0 to 1e-9 of its scale, 2.5e0",
        ),
        (
            with("-2.5,1e-12", "-2.5,-1e-12"),
            "a/h2 metric/tip (m): a golden responds by 0 to",
        ),
    ] {
        let said = Golden::parse(&text).unwrap_err();
        assert!(said.contains(named), "{said}\n{text}");
    }
    let rows: String = TEXT
        .split_inclusive('\n')
        .filter(|l| !l.starts_with("# 2026"))
        .collect();
    assert_eq!(Golden::parse(&rows).unwrap_err(), "no line of a blessing");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.csv");
    let said = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        Golden::read(&path).unwrap_err().to_string()
    };
    for (text, named) in [
        (with("1e-9", "0.000000001"), "not laid out"),
        (with("-2.5", "\"-2.5\""), "not laid out"),
        (with("\n,series/tip", "\na/h2,series/tip"), "not laid out"),
        (TEXT.to_owned() + "\n", "not laid out"),
        (TEXT.replace('\n', "\r\n"), "control characters"),
        (format!("\u{feff}{TEXT}"), "control characters"),
        (
            TEXT[..TEXT.len() - 9].to_owned(),
            "found record with 2 fields",
        ),
        (String::new(), "no line \"# format"),
    ] {
        let said = said(text.as_bytes());
        assert!(
            said.contains("case.csv") && said.contains(named),
            "{said}\n{text}"
        );
    }
    assert!(said(b"run,\xff\n").contains("UTF-8"));
}

/// A number by the floor of its column's scale, a count by ten responses.
#[test]
fn numbers_may_move_as_far_as_rounding_takes_them() {
    let scale = column("metric/tip (m)", &[point(None, -2.5, 0.0)]);
    assert_eq!(
        (scale.scale(), scale.tolerance(&scale.points[0])),
        (2.5, 2.5e-7)
    );
    let series = &golden().runs[0].columns[1];
    // Of the column, not of the row.
    assert_eq!(
        (series.scale(), series.tolerance(&series.points[1])),
        (1.0, 1e-7)
    );
    assert_eq!((series.response(), series.is_blunt()), (1e-12, false));
    assert!(!series.is_count() && series.is_loose().is_none());
    let count = column("work/steps", &[point(None, 195.0, 2.0)]);
    assert_eq!(
        (count.is_count(), count.tolerance(&count.points[0])),
        (true, 20.0)
    );
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
    let new = run(
        "a/h2",
        vec![column("metric/tip (m)", &[point(None, 7.0, 0.0)])],
    );
    let first = run("new/h2", Vec::new());
    let unplanned = run("unplanned/h2", Vec::new());
    let planned = ["new/h2", "b/h2", "a/h2"].map(str::to_owned);
    let of = record("h2", Vec::new());
    let others = golden.runs[1].clone();
    golden.bless(
        vec![new.clone(), first.clone(), unplanned],
        &planned,
        &of,
        "  it is\nright ",
    );
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
    let names = |golden: &Golden| -> Vec<String> {
        golden.shown().into_iter().map(|run| run.name).collect()
    };
    assert_eq!(names(&golden), ["a/h2", "b/h2"]);
    // Of as many the first; of more, those.
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
    assert_eq!(
        (golden.shown().len(), &*golden.shown()[0].name),
        (SHOWN, "0/h4")
    );
    golden.runs.clear();
    assert!(golden.shown().is_empty());
}
