//! Tables without a run, and the columns that are read of them.

use super::*;
use crate::case::Tier;
use crate::cases;

const X: Asked = Asked::particle("x0", "m", "");
const Y: Asked = Asked::particle("y0", "m", "");
const TIME: Asked = Asked::series("time", "s", "");
const FORCE: Asked = Asked::series("force", "N", "");

/// Two particles, and a series of three rows, with these heads.
fn given(heads: [&str; 2]) -> Given {
    let case = cases::find("cook").unwrap();
    let spec = case.runs(Tier::Pr).remove(0);
    let particles = [("x0 (m)", vec![0.75, 0.25]), ("y0 (m)", vec![0.25, -0.25])];
    let series = [(heads[0], vec![0.0, 1.0, 2.0]), (heads[1], vec![0.0, 3.0, 5.0])];
    let tables = [(Part::Particles, particles), (Part::Series, series)];
    let table = |(part, columns): (Part, _)| {
        let path = PathBuf::from(part.name()).with_extension("csv");
        (part, path, Table::of_columns(columns))
    };
    Given {
        parameters: Parameters::new(&case.parameters, &[]).unwrap(),
        discretisation: Discretisation { dim: 2, h: spec.level.h, ppc: 4, dt: 1.0, wall: String::new() },
        spec,
        steps: None,
        tables: tables.map(table).into(),
    }
}

#[test]
fn columns_are_those_of_their_own_table() {
    let given = given(["time (s)", "force (kN)"]);
    assert_eq!(given.column(&X), [0.75, 0.25]);
    assert_eq!(given.column(&TIME), [0.0, 1.0, 2.0]);
    let elsewhere = Asked { part: Part::Series, ..X };
    for missing in [elsewhere, FORCE] {
        assert!(!given.has(&missing) && given.column(&missing).is_empty());
    }
    assert!(given.has(&X) && given.has(&TIME));
    assert_eq!([Part::Particles, Part::Series].map(|p| given.rows(p)), [2, 3]);
    assert_eq!(given.points([&X, &Y]), [[0.75, 0.25], [0.25, -0.25]]);
    let none = Given { tables: Vec::new(), ..given };
    assert_eq!(none.rows(Part::Series), 0);
}

#[test]
fn columns_and_tables_are_asked_for_once() {
    fn nothing(_: &Given) -> Measured {
        Ok(Vec::new())
    }
    let group = |columns| Group { columns, metrics: Vec::new(), measure: nothing };
    let (_, own) = cases::find_scored("cook").unwrap();
    let foreign = Foreign { groups: vec![group(&[X, TIME]), group(&[X, Y, FORCE])], ..*own };
    assert_eq!(foreign.columns(), [X, TIME, Y, FORCE]);
    assert_eq!(foreign.parts(), [Part::Particles, Part::Series]);
    let names: Vec<&str> = foreign.parts().into_iter().map(Part::name).collect();
    assert_eq!(names, ["particles", "series"]);
}

#[test]
fn particles_are_known_by_where_they_start_in_any_order() {
    let given = given(["time (s)", "force (N)"]);
    // Anywhere in their parts, half a metre wide.
    let order = |seeded: &[[f64; 2]]| given.in_order([&X, &Y], seeded, 0.5);
    assert_eq!(order(&[[0.1, -0.4], [0.9, 0.1]]).unwrap(), [1, 0]);
    assert_eq!(order(&[[0.9, 0.1], [0.1, -0.4]]).unwrap(), [0, 1]);
    for (seeded, why) in [
        (&[[0.25, -0.25]][..], "2 particles where 1 start"),
        (&[[0.25, -0.25], [0.75, 0.75]], "no particle starts at (0.75, 0.75) m"),
    ] {
        let told = order(seeded).unwrap_err().to_string();
        assert!(told.contains("particles.csv") && told.contains(why), "{told}");
    }
}

#[test]
fn heads_have_the_unit_that_is_asked_for() {
    let asked = [X, Y, TIME, FORCE];
    let heads = |heads| given(heads).require_heads(&asked);
    assert!(heads(["time (s)", "force (N)"]).unwrap().is_empty());
    assert_eq!(heads(["time (s)", "work (J)"]).unwrap(), ["work (J)"]);
    // Columns of the other table don't count here.
    assert_eq!(heads(["time (s)", "x0 (m)"]).unwrap(), ["x0 (m)"]);
    let told = heads(["time (s)", "force (kN)"]).unwrap_err().to_string();
    let said = "column \"force (kN)\"; allowed: \"force (N)\"";
    assert!(told.contains("series.csv") && told.contains(said), "{told}");
}

#[test]
fn a_head_that_misses_a_name_by_its_form_is_refused_with_the_name() {
    let asked = [X, Y, TIME, FORCE];
    for head in [
        "# force (N)",
        "#force (N)",
        "force",
        "force [N]",
        "force(N)",
        "FORCE (N)",
        " force (N)",
        "force  (N)",
        "force ( N )",
        "force_(N)",
        "force N",
        "force, N",
        "force (n)",
        "\"force (N)\"",
        "(force)",
        "Force {kN}",
        "force <N>",
    ] {
        let told = given(["time (s)", head]).require_heads(&asked).unwrap_err().to_string();
        let said = format!("column \"{}\"; allowed: \"force (N)\"", crate::error::one_line(head));
        assert!(told.contains(&said), "{told}");
    }
    for other in ["forces (N)", "force_x (N)", "Force on base (N)", "#", "", "(N)"] {
        assert_eq!(given(["time (s)", other]).require_heads(&asked).unwrap(), [other]);
    }
}

#[test]
fn a_table_has_a_row_and_not_too_many() {
    let rows = |count: usize| {
        let mut given = given(["time (s)", "force (N)"]);
        let table = Table::of_columns([("time (s)", vec![0.0; count])]);
        given.tables = vec![(Part::Series, "a.csv".into(), table)];
        given.require_heads(&[TIME]).map_err(|e| e.to_string())
    };
    for count in [1, MOST_ROWS] {
        assert!(rows(count).is_ok());
    }
    for count in [0, MOST_ROWS + 1] {
        let told = rows(count).unwrap_err();
        assert!(told.contains(&format!("{count} rows where 1 to {MOST_ROWS}")), "{told}");
    }
}
