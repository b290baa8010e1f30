//! Particles as a VTK unstructured grid (`.vtu`), which ParaView opens.

use crate::case::Column;
use crate::error::Error;
use crate::files::write_whole;
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, BytesText, Event};
use std::io;
use std::path::Path;

/// VTK's number of a vertex cell.
const VERTEX: &str = "1";

/// Writes particles as vertices: the columns `x`, `y`, `z` (those that exist) are the points, all
/// others are point data.
///
/// # Errors
/// The file can't be written.
pub fn write_vtu(path: &Path, columns: &[Column]) -> Result<(), Error> {
    let document = document(columns).map_err(|e| Error::file(path, e))?;
    write_whole(path, &document)
}

fn document(columns: &[Column]) -> io::Result<Vec<u8>> {
    let count = columns.first().map_or(0, |c| c.values.len());
    let coordinate = |name: &str| columns.iter().find(|c| c.name == name);
    let axes = ["x", "y", "z"].map(coordinate);
    let mut points = String::new();
    for k in 0..count {
        for axis in axes {
            let value = axis.map_or(0.0, |c| c.values[k]);
            points.push_str(&format!("{value} "));
        }
    }
    let join = |values: &mut dyn Iterator<Item = String>| values.collect::<Vec<_>>().join(" ");

    let mut w = Writer::new_with_indent(Vec::new(), b' ', 1);
    w.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    open(
        &mut w,
        "VTKFile",
        &[("type", "UnstructuredGrid"), ("version", "1.0")],
    )?;
    open(&mut w, "UnstructuredGrid", &[])?;
    let n = count.to_string();
    open(
        &mut w,
        "Piece",
        &[("NumberOfPoints", &n), ("NumberOfCells", &n)],
    )?;
    open(&mut w, "Points", &[])?;
    data(&mut w, "Float64", "position (m)", "3", &points)?;
    close(&mut w, "Points")?;
    open(&mut w, "Cells", &[])?;
    data(
        &mut w,
        "Int64",
        "connectivity",
        "1",
        &join(&mut (0..count).map(|k| k.to_string())),
    )?;
    data(
        &mut w,
        "Int64",
        "offsets",
        "1",
        &join(&mut (1..=count).map(|k| k.to_string())),
    )?;
    data(
        &mut w,
        "UInt8",
        "types",
        "1",
        &join(&mut (0..count).map(|_| VERTEX.to_owned())),
    )?;
    close(&mut w, "Cells")?;
    open(&mut w, "PointData", &[])?;
    for c in columns
        .iter()
        .filter(|c| !["x", "y", "z"].contains(&c.name))
    {
        let name = format!("{} ({})", c.name, c.unit);
        data(
            &mut w,
            "Float64",
            &name,
            "1",
            &join(&mut c.values.iter().map(f64::to_string)),
        )?;
    }
    close(&mut w, "PointData")?;
    close(&mut w, "Piece")?;
    close(&mut w, "UnstructuredGrid")?;
    close(&mut w, "VTKFile")?;
    Ok(w.into_inner())
}

fn open(w: &mut Writer<Vec<u8>>, name: &str, attributes: &[(&str, &str)]) -> io::Result<()> {
    let mut start = BytesStart::new(name);
    start.extend_attributes(attributes.iter().copied());
    w.write_event(Event::Start(start))
}

fn close(w: &mut Writer<Vec<u8>>, name: &str) -> io::Result<()> {
    w.write_event(Event::End(BytesEnd::new(name)))
}

fn data(
    w: &mut Writer<Vec<u8>>,
    kind: &str,
    name: &str,
    components: &str,
    text: &str,
) -> io::Result<()> {
    let attributes = [
        ("type", kind),
        ("Name", name),
        ("NumberOfComponents", components),
        ("format", "ascii"),
    ];
    open(w, "DataArray", &attributes)?;
    w.write_event(Event::Text(BytesText::new(text.trim_end())))?;
    close(w, "DataArray")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_particles_make_two_vertices_with_data() {
        let column = |name, unit, values: [f64; 2]| Column {
            name,
            unit,
            values: values.to_vec(),
        };
        let columns = [
            column("x", "m", [0.0, 1.0]),
            column("y", "m", [2.0, 3.5]),
            column("mean_stress", "Pa", [-1.0, 0.25]),
        ];
        let text = String::from_utf8(document(&columns).unwrap()).unwrap();
        for part in [
            "NumberOfPoints=\"2\"",
            ">0 2 0 1 3.5 0<",
            ">0 1<",
            ">1 2<",
            ">1 1<",
            "Name=\"mean_stress (Pa)\"",
            ">-1 0.25<",
        ] {
            assert!(text.contains(part), "{part} in {text}");
        }
    }
}
