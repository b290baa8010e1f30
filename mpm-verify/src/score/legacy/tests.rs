//! Files that VTK itself wrote (`scripts/vtk_samples.py`), variants of their text, and what is refused.

use super::*;
use proptest::prelude::*;

const OF_VTK: [(&str, &[u8]); 8] = [
    ("grid, text, 4.2", include_bytes!("grid-ascii-42.vtk")),
    ("grid, text, 5.1", include_bytes!("grid-ascii-51.vtk")),
    ("grid, bytes, 4.2", include_bytes!("grid-binary-42.vtk")),
    ("grid, bytes, 5.1", include_bytes!("grid-binary-51.vtk")),
    ("polygons, text, 4.2", include_bytes!("polygons-ascii-42.vtk")),
    ("polygons, text, 5.1", include_bytes!("polygons-ascii-51.vtk")),
    ("polygons, bytes, 4.2", include_bytes!("polygons-binary-42.vtk")),
    ("polygons, bytes, 5.1", include_bytes!("polygons-binary-51.vtk")),
];

fn columns(bytes: &[u8]) -> Result<Vec<(String, Vec<f64>)>, String> {
    let table = table(bytes)?;
    Ok(table.iter().map(|(n, v)| (n.to_owned(), v.to_vec())).collect())
}

fn column(name: &str, values: [f64; 2]) -> (String, Vec<f64>) {
    (name.to_owned(), values.into())
}

/// A file of two points with sections behind them.
fn file(sections: &str) -> String {
    let head = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 1 2 3 4 5\n";
    format!("{head}{sections}\n")
}

fn places() -> [(String, Vec<f64>); 3] {
    [column("x (m)", [0.0, 3.0]), column("y (m)", [1.0, 4.0]), column("z (m)", [2.0, 5.0])]
}

#[test]
fn what_vtk_writes_is_read() {
    let integers: f64 = 2_f64.powi(40);
    for (layout, bytes) in OF_VTK {
        // Scalars, those of fields too, and vectors and tensors that are known; none of the cells.
        let expected = [
            column("x (m)", [0.5, 1.5]),
            column("y (m)", [0.25, -0.25]),
            column("z (m)", [0.0, 2.0]),
            column("ux (m)", [0.5, -0.5]),
            column("ids", [7.0, 8.0]),
            column("Float64", [-0.1, 1e30]),
            column("Float32", [-7.5, 8.25]),
            column("Int64", [-integers, integers]),
            column("UInt64", [0.0, integers]),
            column("Int32", [-70_000.0, 70_000.0]),
            column("UInt32", [0.0, 3e9]),
            column("Int16", [-300.0, 300.0]),
            column("UInt16", [0.0, 60_000.0]),
            column("Int8", [-100.0, 100.0]),
            column("UInt8", [0.0, 200.0]),
            column("uy (m)", [2.0, 5.0]),
            column("uz (m)", [3.0, 6.0]),
            column("stress_xx (Pa)", [1.0, -1.0]),
            column("stress_yy (Pa)", [2.0, -2.0]),
            column("stress_zz (Pa)", [6.0, -6.0]),
            column("stress_xy (Pa)", [4.0, 7.0]),
            column("mean_stress (Pa)", [3.0, -3.0]),
        ];
        assert_eq!(columns(bytes).unwrap(), expected, "{layout}");
    }
}

/// Cut at any place, it is refused, or all that is read was before the cut.
#[test]
fn what_is_cut_has_no_other_numbers() {
    for (layout, bytes) in OF_VTK {
        // A component of which the scalar is cut off has its name.
        let whole = [columns(bytes).unwrap(), vec![column("ux (m)", [1.0, 4.0])]].concat();
        let mut read = 0;
        for end in 0..bytes.len() {
            if let Ok(cut) = columns(&bytes[..end]) {
                assert!(cut.iter().all(|c| whole.contains(c)), "{layout}, {end} bytes: {cut:?}");
                read += 1;
            }
        }
        assert!(read > 0, "{layout}");
    }
}

#[test]
fn other_forms_of_the_text_are_read() {
    let with = |own: &str, expected: &[(String, Vec<f64>)]| {
        let expected = [&places()[..], expected].concat();
        let text = file(own);
        for text in [text.clone(), text.replace('\n', "\r\n"), text.replace("\nPOINT", "\n\n\nPOINT")] {
            assert_eq!(columns(text.as_bytes()).as_ref(), Ok(&expected), "{text:?}");
        }
    };
    let a = || column("a", [6.0, 7.0]);
    with("POINT_DATA 2\nSCALARS a float\nLOOKUP_TABLE default\n6 7", &[a()]);
    with("POINT_DATA 2\nSCALARS a float 1\nLOOKUP_TABLE t\n6\n7", &[a()]);
    with("Point_Data 2\nscalars a DOUBLE\nLookup_Table default\n6 7", &[a()]);
    with(
        "POINT_DATA 2\nSCALARS a float\nLOOKUP_TABLE t\n6 7\nLOOKUP_TABLE t 1\n0 1 0 1\nSCALARS b int\nLOOKUP_TABLE t\n8 9",
        &[a(), column("b", [8.0, 9.0])],
    );
    with(
        "POINT_DATA 2\nCOLOR_SCALARS c 3\n0 0 1 1 0 0\nFIELD f 2\na 1 2 vtkIdType\n6 7\nv 3 2 float\n1 1 1 1 1 1",
        &[a()],
    );
    with(
        "FIELD f 1\na 1 3 int\n1 2 3\nCELL_DATA 1\nSCALARS a int\nLOOKUP_TABLE t\n1\nPOINT_DATA 2\nSCALARS a int\nLOOKUP_TABLE t\n6 7",
        &[a()],
    );
    with(
        "VERTICES 2 4\n1 0 1 1\nLINES 1 3\n2 0 1\nPOINT_DATA 2\nSCALARS 6%25%20%2x int\nLOOKUP_TABLE t\n6 7",
        &[column("6% %2x", [6.0, 7.0])],
    );
    with("METADATA\nCOMPONENT_NAMES\nPOINT_DATA 9\n\n\n\nPOINT_DATA 2\nSCALARS a int\nLOOKUP_TABLE t\n6 7", &[a()]);
    with(
        "POINT_DATA 2\nTENSORS6 stress float\n1 2 6 4 5 0 -1 -2 -6 7 8 0",
        &[
            column("stress_xx (Pa)", [1.0, -1.0]),
            column("stress_yy (Pa)", [2.0, -2.0]),
            column("stress_zz (Pa)", [6.0, -6.0]),
            column("stress_xy (Pa)", [4.0, 7.0]),
            column("mean_stress (Pa)", [3.0, -3.0]),
        ],
    );
    // Bytes begin behind the line, whatever they are.
    let bytes = [
        file("POINT_DATA 2\nSCALARS a char\nLOOKUP_TABLE t").replace("ASCII", "BINARY").into_bytes(),
        b"\n\x20".to_vec(),
    ]
    .concat();
    let numbers: Vec<u8> = (0..6_u8).flat_map(|k| f32::from(k).to_be_bytes()).collect();
    let text = b"0 1 2 3 4 5";
    let at = bytes.windows(text.len()).position(|w| w == text).unwrap();
    let bytes = [&bytes[..at], &numbers, &bytes[at + text.len()..]].concat();
    assert_eq!(columns(&bytes).unwrap()[3..], [column("a", [10.0, 32.0])]);
}

#[test]
fn what_is_no_grid_is_refused() {
    let data = |own: &str| file(&format!("POINT_DATA 2\n{own}"));
    let with = |old: &str, new: &str| {
        let sound = data("SCALARS a int\nLOOKUP_TABLE t\n6 7");
        assert!(sound.contains(old), "{old}");
        sound.replace(old, new)
    };
    let most = usize::MAX;
    for (text, named) in [
        (String::new(), "lines 1 and 3; allowed: \"# vtk DataFile Version\" 2.0 to 5.1, ASCII or BINARY"),
        (with("3.0", "1.0"), "lines 1 and 3"),
        (with("3.0", "5.2"), "lines 1 and 3"),
        (with("ASCII", "TEXT"), "lines 1 and 3"),
        (
            with("DATASET POLYDATA", "DATASET STRUCTURED_GRID"),
            "line \"DATASET STRUCTURED_GRID\\n\"; allowed: sections of UNSTRUCTURED_GRID and POLYDATA with 1 to 5000000",
        ),
        (with("POINTS 2", "POINTS 0"), "line \"POINTS 0 float\\n\"; allowed"),
        (with("POINTS 2", "POINTS 5000001"), "line \"POINTS 5000001 float\\n\"; allowed"),
        (with("POINTS 2", "POINTS -2"), "line \"POINTS -2 float\\n\"; allowed"),
        (with("POINTS 2 float", "POINTS 2 half"), "array \"POINTS\": type \"half\""),
        (with("POINTS 2 float", "POINTS 3 float"), "array \"POINTS\": \"POINT_DATA\" is no number"),
        (with("POINT_DATA", "POINTS 2 float\n0 1 2 3 4 5\nPOINT_DATA"), "array \"x (m)\" is there twice"),
        (with("POINT_DATA 2", "POINT_DATA 1"), "array \"a\": of 1 points, where 2 are"),
        (with("LOOKUP_TABLE t\n", ""), "line \"SCALARS a int\\n\"; allowed"),
        (with("6 7", "6 x"), "array \"a\": \"x\" is no number"),
        (with("6 7", "6 nan"), "array \"a\", point 2: NaN"),
        (with("6 7", "6"), "array \"a\": not 2 numbers"),
        (with("6 7", "6 7 8"), "line \"8\\n\"; allowed"),
        (with("SCALARS a", "SCALARS x%20(m)"), "array \"x (m)\" is there twice"),
        (data("SCALARS a string\nLOOKUP_TABLE t\nb c"), "array \"a\": type \"string\""),
        (data("FIELD f 2\na 1 2 int\n6 7"), "line \"\"; allowed: name, components, tuples and type of an array"),
        (data("FIELD f 1\na 1 3 int\n6 7 8"), "array \"a\": of 3 points, where 2 are"),
        (data("FIELD f 1\na x 2 int\n6 7"), "line \"a x 2 int\\n\"; allowed: name"),
        (data(&format!("FIELD f {most}\n")), "line \"\"; allowed: name"),
        (data(&format!("FIELD f 1\na {most} 2 int\n6 7")), "array \"a\": not 18446744073709551615 numbers"),
        (file(&format!("CELLS 2 {most}\n1 0")), "not 18446744073709551615 numbers"),
        (file("CELLS 3 2\nOFFSETS\n0 1 2\n"), "line \"OFFSETS\\n\"; allowed"),
        (data(&format!("FIELD f 1\na {most} 0 int\n")), "of 0 points, where 2 are"),
        (
            file(&format!("FIELD f 2\na {most} 0 int\nMETADATA\nCOMPONENT_NAMES\na\n\nb 1 1 int\n6")),
            "line \"\"; allowed: name",
        ),
    ] {
        let said = table(text.as_bytes()).unwrap_err();
        assert!(said.contains(named), "{text}\n{said}");
    }
    let bytes = file("").replace("ASCII", "BINARY").replace("POINTS 2", "POINTS 5000000");
    assert_eq!(table(bytes.as_bytes()).unwrap_err(), "array \"POINTS\": not 15000000 numbers");
    let none = "# vtk DataFile Version 2.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\n";
    assert_eq!(table(none.as_bytes()).unwrap_err(), "no points and no scalar point data");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever is changed, nothing panics, and no more than 64 times the bytes of the file are held.
    #[test]
    fn what_is_damaged_is_refused_or_read_within_its_size(
        which in 0..OF_VTK.len(),
        changes in proptest::collection::vec((0.0..1.0, 0..3, prop_oneof![
            any::<u8>().prop_map(|b| vec![b]),
            proptest::sample::select(vec!["99999999999999999999", "4294967295", "-1", "\n", " ", "METADATA\n", "POINTS 9 ", "%"])
                .prop_map(|t| t.as_bytes().to_vec()),
        ]), 1..5),
    ) {
        let mut bytes = OF_VTK[which].1.to_vec();
        for (share, kind, with) in changes {
            let at = (share * bytes.len() as f64) as usize;
            match kind {
                0 => bytes.truncate(at),
                1 => drop(bytes.splice(at..(at + with.len()).min(bytes.len()), with)),
                _ => drop(bytes.splice(at..at, with)),
            }
        }
        let held = allocation_counter::measure(|| drop(table(&bytes))).bytes_max;
        prop_assert!(held <= 64 * bytes.len() as u64 + 10_000, "{held} of {} bytes", bytes.len());
    }
}
