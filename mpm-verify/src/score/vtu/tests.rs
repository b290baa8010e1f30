//! Grids that VTK itself wrote (`scripts/vtk_samples.py`), and what is refused.

use super::*;

const OF_VTK: [(&str, &[u8]); 6] = [
    ("ascii", include_bytes!("ascii-little-32.vtu")),
    ("base64-zlib", include_bytes!("base64-zlib-little-32.vtu")),
    ("binary", include_bytes!("binary-little-32.vtu")),
    ("binary-zlib-big", include_bytes!("binary-zlib-big-64.vtu")),
    ("raw-big", include_bytes!("raw-big-64.vtu")),
    ("raw-zlib", include_bytes!("raw-zlib-little-32.vtu")),
];

/// Two points in the plane with `inside` for their data.
fn grid(inside: &str) -> String {
    format!(
        r#"<VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece NumberOfPoints="2"><PointData>{inside}</PointData>
        </Piece></UnstructuredGrid></VTKFile>"#
    )
}

/// An array of numbers in text.
fn array(name: &str, rest: &str) -> String {
    format!(r#"<DataArray type="Float64" Name="{name}" format="ascii"{rest}</DataArray>"#)
}

fn columns(text: &str) -> Vec<(String, Vec<f64>)> {
    let table = table(text.as_bytes()).unwrap();
    table.iter().map(|(n, v)| (n.to_owned(), v.into())).collect()
}

fn column(name: &str, values: [f64; 2]) -> (String, Vec<f64>) {
    (name.to_owned(), values.into())
}

#[test]
fn what_vtk_writes_is_read() {
    let integers: f64 = 2_f64.powi(40);
    for (layout, bytes) in OF_VTK {
        let table = table(bytes).map_err(|said| format!("{layout}: {said}")).unwrap();
        let found: Vec<_> = table.iter().map(|(n, v)| (n.to_owned(), v.to_vec())).collect();
        // The scalars behind a vector, none of the cells, and the points, which VTK puts behind.
        let expected = [
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
            column("x (m)", [0.5, 1.5]),
            column("y (m)", [0.25, -0.25]),
            column("z (m)", [0.0, 2.0]),
        ];
        assert_eq!(found, expected, "{layout}");
    }
}

/// Cut at any place, it is refused, or all that is read was before the cut.
#[test]
fn what_is_cut_is_no_other_grid() {
    for (layout, bytes) in OF_VTK {
        let whole = table(bytes).unwrap();
        for end in 0..bytes.len() {
            if let Ok(cut) = table(&bytes[..end]) {
                assert_eq!(cut, whole, "{layout}, {end} bytes");
            }
        }
    }
}

#[test]
fn an_arrays_numbers_are_its_own_text() {
    let [own, others] = [array("a", ">1 2"), array("b", ">3 4")];
    let both = [column("a", [1.0, 2.0]), column("b", [3.0, 4.0])];
    let vector = array("v", r#" NumberOfComponents="3">9 9 9 9 9 9"#);
    let within = array("a", ">1 <Range>9</Range> 2<Range><Least>9</Least></Range>");
    for inside in [
        format!("{own} 9 {others} 9"),
        format!("{own}{vector}{others}"),
        format!("{own}<Note>9</Note>{others}"),
        format!("{within}{others}"),
        format!("{own}{others}</PointData><CellData>{own}</CellData><PointData>"),
        format!("{own}</PointData><FieldData>{vector}{own}</FieldData><PointData>{others}"),
    ] {
        assert_eq!(columns(&grid(&inside)), both, "{inside}");
    }
    let points = array("p", r#" NumberOfComponents="3">1 2 3 4 5 6"#);
    let flat = array("q", r#" NumberOfComponents="1">1 2"#);
    let behind = format!("{own}</PointData><Points>{flat}{points}</Points><PointData>");
    let expected = [
        column("a", [1.0, 2.0]),
        column("x (m)", [1.0, 4.0]),
        column("y (m)", [2.0, 5.0]),
        column("z (m)", [3.0, 6.0]),
    ];
    assert_eq!(columns(&grid(&behind)), expected);
    // Names of attributes may begin with a capital.
    let capital = grid(&own.replace("type=", "Type=").replace("Name=", "name="));
    assert_eq!(columns(&capital), both[..1]);
}

#[test]
fn what_is_no_grid_is_refused() {
    let sound = grid(&array("a", ">1 2"));
    let with = |old: &str, new: &str| {
        assert!(sound.contains(old), "{old}");
        sound.replace(old, new)
    };
    let piece = |n: &str| with("\"2\"", &format!("\"{n}\""));
    for (text, named) in [
        (with("UnstructuredGrid\"", "ImageData\""), "no VTKFile of type UnstructuredGrid"),
        (
            with("<VTKFile ", "<VTKFile compressor=\"vtkLZ4DataCompressor\" "),
            "a compressor other than vtkZLibDataCompressor",
        ),
        (with("<PointData>", "<Piece NumberOfPoints=\"2\"/><PointData>"), "more than one piece"),
        (piece("0"), "NumberOfPoints: 1 to 5000000 are allowed"),
        (piece("5000001"), "NumberOfPoints: 1 to 5000000 are allowed"),
        (piece("two"), "NumberOfPoints: 1 to 5000000 are allowed"),
        (with(">1 2", "/>1 2<DataArray>"), "array \"a\": not 2 numbers"),
        (with("1 2", "1"), "array \"a\": not 2 numbers"),
        (with("1 2", "1 2 3"), "array \"a\": not 2 numbers"),
        (with("1 2", "1 two"), "array \"a\": \"two\" is no number"),
        (with("1 2", "1 nan"), "array \"a\", point 2: NaN"),
        (with("1 2", "inf 2"), "array \"a\", point 1: inf"),
        (with("ascii", "text"), "format \"text\"; allowed: ascii, binary, appended"),
        (with("ascii", "appended"), "no header"),
        (with("ascii\"", "appended\" offset=\"1\""), "an offset behind the data"),
        (with("ascii\"", "appended\" offset=\"-1\""), "an offset behind the data"),
        (with("Float64", "Float16").replace("ascii", "binary"), "type \"Float16\""),
        (with("</PointData>", &(array("a", ">1 2") + "</PointData>")), "array \"a\" is there twice"),
        (with("PointData", "CellData"), "no points and no scalar point data"),
        (with("\"a\"", "\"a\" NumberOfComponents=\"x\""), "no points and no scalar point data"),
        ("<VTKFile type=\"UnstructuredGrid\"/>".to_owned(), "no piece with NumberOfPoints"),
        (String::new(), "no piece with NumberOfPoints"),
        (with("</Piece>", "</Part>"), "Piece"),
    ] {
        let said = table(text.as_bytes()).unwrap_err();
        assert!(said.contains(named), "{text}\n{said}");
    }
    assert_eq!(columns(&with("<VTKFile ", "<VTKFile compressor=\"\" ")), [column("a", [1.0, 2.0])]);
    assert!(table(b"<VTKFile type=\"\xff\"/>").unwrap_err().contains("UTF-8"));
    let most = piece("5000000");
    assert!(table(most.as_bytes()).unwrap_err().contains("not 5000000 numbers"));
}

/// Bytes in base64, its digits in their order and back from its first padding.
#[test]
fn base64_is_decoded() {
    let decoded = |text: &str| {
        let mut bytes = Vec::new();
        Base64::new(text.as_bytes()).read_to_end(&mut bytes).unwrap();
        bytes
    };
    let digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let bits: Vec<u8> = (0..64_u8).flat_map(|d| (0..6).rev().map(move |k| d >> k & 1)).collect();
    let bytes = bits.chunks(8).map(|byte| byte.iter().fold(0, |b, bit| b << 1 | bit));
    assert_eq!(decoded(digits), bytes.collect::<Vec<u8>>());
    // Examples of RFC 4648, section 10; pieces that are filled up each; blanks between; what is no digit ends it.
    for (text, plain) in [
        ("", ""),
        ("Zg==", "f"),
        ("Zm8=", "fo"),
        ("Zm9v", "foo"),
        ("Zm9vYg==", "foob"),
        ("Zg==Zm8=Zm9v", "ffofoo"),
        (" Zm\n9v Y\tg==\n", "foob"),
        ("Zm9v.Zm9v", "foo"),
        ("Zm9vZm", "foo"),
    ] {
        assert_eq!(decoded(text), plain.as_bytes(), "{text}");
    }
}

#[test]
fn packed_numbers_are_as_many_as_they_say() {
    let layout = |compressed| Layout { compressed, left: Cell::new(SMALL), ..Layout::default() };
    let of = |kind: &str| {
        let element = BytesStart::new("DataArray");
        Array { kind: kind.to_owned(), ..Array::of(&element, false) }
    };
    let unpack = |compressed, count, bytes: &[u8]| of("UInt16").unpack(&layout(compressed), count, &mut &bytes[..]);
    let said = |compressed, bytes: &[u8]| unpack(compressed, 2, bytes).unwrap_err();
    assert_eq!(unpack(false, 2, &[4, 0, 0, 0, 1, 1, 2, 0, 9]).unwrap(), [257.0, 2.0]);
    assert_eq!(said(false, &[5, 0, 0, 0, 1, 0, 2, 0, 9]), "5 bytes, where 4 bytes are described");
    assert_eq!(said(false, &[4, 0, 0, 0, 1, 0, 2]), "3 bytes, where 4 bytes are described");
    assert_eq!(said(false, &[4, 0, 0]), "no header");
    let header = |blocks: u32, sizes: &[u32]| -> Vec<u8> {
        let all = [blocks, 0, 0].into_iter().chain(sizes.iter().copied());
        all.flat_map(u32::to_le_bytes).collect()
    };
    let packed = |bytes: &[u8]| {
        let mut packed = Vec::new();
        flate2::read::ZlibEncoder::new(bytes, flate2::Compression::fast()).read_to_end(&mut packed).unwrap();
        packed
    };
    let blocks = |blocks: &[&[u8]]| {
        let blocks: Vec<Vec<u8>> = blocks.iter().map(|b| packed(b)).collect();
        let sizes: Vec<u32> = blocks.iter().map(|b| b.len() as u32).collect();
        [header(sizes.len() as u32, &sizes), blocks.concat()].concat()
    };
    for whole in [&[&[1, 1, 2, 0][..]][..], &[&[1, 1], &[2, 0]], &[&[1], &[], &[1, 2, 0]]] {
        assert_eq!(unpack(true, 2, &blocks(whole)).unwrap(), [257.0, 2.0]);
    }
    assert_eq!(said(true, &blocks(&[&[1, 1], &[2]])), "3 bytes, where 4 bytes are described");
    assert_eq!(said(true, &blocks(&[&[1, 1], &[2, 0, 3]])), "5 bytes, where 4 bytes are described");
    // What inflates to more is not inflated: one byte too many is enough to see it.
    let bomb = blocks(&[&[0; 1 << 20], &[0; 1 << 20]]);
    assert_eq!(said(true, &bomb), "5 bytes, where 4 bytes are described");
    // A block may be followed by bytes of its own.
    let mut loose = packed(&[1, 1, 2, 0]);
    loose.extend([7; 5]);
    let mut second = packed(&[3, 0]);
    let sizes = [loose.len() as u32, second.len() as u32];
    loose.append(&mut second);
    let all = [header(2, &sizes), loose].concat();
    assert_eq!(unpack(true, 3, &all).unwrap(), [257.0, 2.0, 3.0]);
    assert_eq!(said(true, &header(100_001, &[])), "too many blocks, where 4 bytes are described");
    assert_eq!(said(true, &header(100_000, &[])), "no header");
    assert_eq!(said(true, &header(1, &[])), "no header");
    let broken = said(true, &[header(1, &[4]), vec![1, 2, 3, 4]].concat());
    assert!(broken.ends_with(", where 4 bytes are described"), "{broken}");
}

/// Constant numbers pack to a thousandth, and an array may be described as often as one likes.
#[test]
fn a_small_file_does_not_come_to_large_arrays() {
    let points = 1_000_000;
    let part = |k: usize| format!(r#"<DataArray type="Int8" Name="a{k}" format="appended" offset="0"/>"#);
    let with = |arrays: usize| {
        let arrays: String = (0..arrays).map(part).collect();
        let mut file = format!(
            r#"<VTKFile type="UnstructuredGrid" compressor="vtkZLibDataCompressor"><UnstructuredGrid><Piece NumberOfPoints="{points}">
            <PointData>{arrays}</PointData></Piece></UnstructuredGrid><AppendedData encoding="raw">_"#
        )
        .into_bytes();
        let mut packed = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
        std::io::Write::write_all(&mut packed, &vec![1; points]).unwrap();
        let packed = packed.finish().unwrap();
        for header in [1, points, 0, packed.len()] {
            file.extend((header as u32).to_le_bytes());
        }
        file.extend(packed);
        file.extend(b"</AppendedData></VTKFile>");
        file.resize(200_000, b' ');
        table(&file).map(|table| table.rows())
    };
    assert_eq!(with(1), Ok(points));
    let said = with(2).unwrap_err();
    assert!(said.contains("more than 64 times as large as the file"), "{said}");
}

#[test]
fn polygonal_data_vectors_and_tensors_become_columns() {
    let parts =
        |name: &str, count: usize, numbers: &str| array(name, &format!(r#" NumberOfComponents="{count}">{numbers}"#));
    let (vector, tensor) = ("1 2 3 4 5 6", "1 2 6 4 5 0 -1 -2 -6 7 8 0");
    let inside = parts("displacement", 3, vector) + &parts("stress (Pa)", 6, tensor) + &parts("velocity", 3, vector);
    let text = grid(&inside).replace("UnstructuredGrid", "PolyData");
    assert_eq!(
        columns(&text),
        [
            column("ux (m)", [1.0, 4.0]),
            column("uy (m)", [2.0, 5.0]),
            column("uz (m)", [3.0, 6.0]),
            column("stress_xx (Pa)", [1.0, -1.0]),
            column("stress_yy (Pa)", [2.0, -2.0]),
            column("stress_zz (Pa)", [6.0, -6.0]),
            column("stress_xy (Pa)", [4.0, 7.0]),
            column("mean_stress (Pa)", [3.0, -3.0]),
        ]
    );
    let full = parts("stress", 9, "1 4 0 4 2 0 0 0 6 -1 7 0 7 -2 0 0 0 -6") + &array("mean_stress (Pa)", ">8 9");
    let found = columns(&grid(&full));
    assert_eq!(found[0], column("mean_stress (Pa)", [8.0, 9.0]));
    assert_eq!(found[1..], columns(&text)[3..7]);
}
