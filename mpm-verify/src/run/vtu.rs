//! Particles for ParaView: a VTK unstructured grid (`.vtu`) of those at one time, and a collection (`.pvd`) of such files
//! with their times.
//!
//! All numbers stand in one appended section, raw and compressed by zlib. Positions and values are of single precision,
//! which is for looking at; what is to be computed with is in the CSV file beside it.

use crate::error::Error;
use crate::files::write_whole;
use crate::job::Column;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, Event};
use std::io::{self, Write};
use std::path::Path;

/// Columns of positions.
const AXES: [&str; 3] = ["x", "y", "z"];
/// VTK's number of a vertex cell.
const VERTEX: u8 = 1;
/// Bytes that are compressed at a time.
const BLOCK: usize = 1 << 20;

/// Writes particles as vertices: the columns `x`, `y`, `z` (those that exist) are the points, all
/// others are point data. A number beyond single precision becomes infinite.
///
/// # Errors
/// The file can't be written.
pub fn write_vtu(path: &Path, columns: &[Column]) -> Result<(), Error> {
    let document = grid(columns).map_err(|e| Error::file(path, e))?;
    write_whole(path, &document)
}

/// Writes a collection of files, each with its time (s) and its path from the folder of the collection.
///
/// # Errors
/// The file can't be written.
pub fn write_pvd(path: &Path, members: &[(f64, String)]) -> Result<(), Error> {
    let document = collection(members).map_err(|e| Error::file(path, e))?;
    write_whole(path, &document)
}

fn collection(members: &[(f64, String)]) -> io::Result<Vec<u8>> {
    let mut w = begin("Collection", &[])?;
    open(&mut w, "Collection", &[])?;
    for (time, file) in members {
        let time = time.to_string();
        let attributes = [("timestep", &*time), ("part", "0"), ("file", file)];
        w.write_event(Event::Empty(element("DataSet", &attributes)))?;
    }
    close(&mut w, "Collection")?;
    close(&mut w, "VTKFile")?;
    Ok(w.into_inner())
}

fn grid(columns: &[Column]) -> io::Result<Vec<u8>> {
    let particles = columns.first().map_or(0, |c| c.values.len());
    let n = particles.to_string();
    let size = [("NumberOfPoints", &*n), ("NumberOfCells", &*n)];
    let compressor = [("header_type", "UInt64"), ("compressor", "vtkZLibDataCompressor")];
    let mut w = begin("UnstructuredGrid", &compressor)?;
    let mut appended = Vec::new();
    open(&mut w, "UnstructuredGrid", &[])?;
    open(&mut w, "Piece", &size)?;
    describe_points(&mut w, columns, particles, &mut appended)?;
    describe_cells(&mut w, particles, &mut appended)?;
    open(&mut w, "PointData", &[])?;
    for c in columns.iter().filter(|c| !AXES.contains(&c.name)) {
        let name = format!("{} ({})", c.name, c.unit);
        let values = singles(c.values.iter().copied());
        array(&mut w, ("Float32", &name, "1"), &values, &mut appended)?;
    }
    for name in ["PointData", "Piece", "UnstructuredGrid"] {
        close(&mut w, name)?;
    }
    open(&mut w, "AppendedData", &[("encoding", "raw")])?;
    w.get_mut().push(b'_');
    w.get_mut().append(&mut appended);
    close(&mut w, "AppendedData")?;
    close(&mut w, "VTKFile")?;
    Ok(w.into_inner())
}

fn describe_points(
    w: &mut Writer<Vec<u8>>,
    columns: &[Column],
    particles: usize,
    appended: &mut Vec<u8>,
) -> io::Result<()> {
    let axes = AXES.map(|name| columns.iter().find(|c| c.name == name));
    let place = |k: usize| axes.map(|axis| axis.map_or(0.0, |c| c.values[k]));
    let places = singles((0..particles).flat_map(place));
    open(w, "Points", &[])?;
    array(w, ("Float32", "position (m)", "3"), &places, appended)?;
    close(w, "Points")
}

/// Describes a cell for every particle.
fn describe_cells(w: &mut Writer<Vec<u8>>, particles: usize, appended: &mut Vec<u8>) -> io::Result<()> {
    let counted = |from: usize| (from..from + particles).flat_map(|k| (k as u64).to_le_bytes());
    let [points, ends] = [0, 1].map(|from| counted(from).collect::<Vec<u8>>());
    open(w, "Cells", &[])?;
    for (kind, name, bytes) in
        [("Int64", "connectivity", points), ("Int64", "offsets", ends), ("UInt8", "types", vec![VERTEX; particles])]
    {
        array(w, (kind, name, "1"), &bytes, appended)?;
    }
    close(w, "Cells")
}

fn singles(values: impl Iterator<Item = f64>) -> Vec<u8> {
    values.flat_map(|v| (v as f32).to_le_bytes()).collect()
}

/// Describes an array of a type, name and number of components, and appends what it holds.
fn array(
    w: &mut Writer<Vec<u8>>,
    (kind, name, components): (&str, &str, &str),
    bytes: &[u8],
    appended: &mut Vec<u8>,
) -> io::Result<()> {
    let offset = appended.len().to_string();
    let attributes = [
        ("type", kind),
        ("Name", name),
        ("NumberOfComponents", components),
        ("format", "appended"),
        ("offset", &offset),
    ];
    w.write_event(Event::Empty(element("DataArray", &attributes)))?;
    compress(bytes, appended)
}

/// Appends compressed blocks behind their number, their size, that of the last if it is shorter (else 0), and what each
/// is compressed to.
fn compress(bytes: &[u8], appended: &mut Vec<u8>) -> io::Result<()> {
    let blocks = bytes.chunks(BLOCK).map(|block| {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(block)?;
        encoder.finish()
    });
    let blocks = blocks.collect::<io::Result<Vec<_>>>()?;
    let sizes = blocks.iter().map(Vec::len);
    let header = [blocks.len(), BLOCK, bytes.len() % BLOCK].into_iter();
    appended.extend(header.chain(sizes).flat_map(|n| (n as u64).to_le_bytes()));
    appended.extend(blocks.concat());
    Ok(())
}

/// A VTK file of a type, with more attributes.
fn begin(kind: &str, more: &[(&str, &str)]) -> io::Result<Writer<Vec<u8>>> {
    let mut w = Writer::new_with_indent(Vec::new(), b' ', 1);
    w.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let common = [("type", kind), ("version", "1.0"), ("byte_order", "LittleEndian")];
    open(&mut w, "VTKFile", &[&common, more].concat())?;
    Ok(w)
}

fn element<'a>(name: &'a str, attributes: &[(&str, &str)]) -> BytesStart<'a> {
    BytesStart::new(name).with_attributes(attributes.iter().copied())
}

fn open(w: &mut Writer<Vec<u8>>, name: &str, attributes: &[(&str, &str)]) -> io::Result<()> {
    w.write_event(Event::Start(element(name, attributes)))
}

fn close(w: &mut Writer<Vec<u8>>, name: &str) -> io::Result<()> {
    w.write_event(Event::End(BytesEnd::new(name)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use quick_xml::Reader;
    use std::collections::BTreeMap;
    use std::io::Read;

    type Attributes = BTreeMap<String, String>;

    /// The elements of a document with their attributes, and where its appended numbers begin.
    fn parse(document: &[u8]) -> (Vec<(String, Attributes)>, usize) {
        let mut reader = Reader::from_reader(document);
        let mut elements = Vec::new();
        loop {
            let start = match reader.read_event().unwrap() {
                Event::Start(start) | Event::Empty(start) => start,
                Event::Eof => return (elements, document.len()),
                _ => continue,
            };
            let name = start.name().as_ref().to_owned();
            let attributes = start.attributes().map(Result::unwrap);
            let attributes = attributes.map(|a| (a.key.as_ref().to_owned(), a.value.into_owned()));
            let appended = name == "AppendedData";
            elements.push((name, attributes.collect()));
            if appended {
                let place = reader.buffer_position() as usize;
                let mark = document[place..].iter().position(|b| *b == b'_').unwrap();
                return (elements, place + mark + 1);
            }
        }
    }

    fn inflate(from: &[u8]) -> Vec<u8> {
        let number = |k: usize| u64::from_le_bytes(from[8 * k..][..8].try_into().unwrap()) as usize;
        let (blocks, block, last) = (number(0), number(1), number(2));
        let (mut all, mut at) = (Vec::new(), 8 * (3 + blocks));
        for k in 0..blocks {
            let mut decoder = flate2::read::ZlibDecoder::new(&from[at..at + number(3 + k)]);
            let before = all.len();
            decoder.read_to_end(&mut all).unwrap();
            let short = k + 1 == blocks && last > 0;
            assert_eq!(all.len() - before, if short { last } else { block });
            at += number(3 + k);
        }
        all
    }

    /// The arrays of a grid by name, of whatever type, as numbers.
    fn arrays(document: &[u8]) -> BTreeMap<String, Vec<f64>> {
        let (elements, data) = parse(document);
        let of_array = |(_, a): &(String, Attributes)| {
            let bytes = inflate(&document[data + a["offset"].parse::<usize>().unwrap()..]);
            let numbers = match &*a["type"] {
                "Float32" => (bytes.chunks(4)).map(|b| f64::from(f32::from_le_bytes(b.try_into().unwrap()))).collect(),
                "Int64" => (bytes.chunks(8)).map(|b| i64::from_le_bytes(b.try_into().unwrap()) as f64).collect(),
                _ => bytes.into_iter().map(f64::from).collect(),
            };
            (a["Name"].clone(), numbers)
        };
        let arrays = elements.iter().filter(|(name, _)| name == "DataArray");
        arrays.map(of_array).collect()
    }

    fn column(name: &'static str, unit: &'static str, values: Vec<f64>) -> Column {
        Column { name, unit, values }
    }

    #[test]
    fn two_particles_make_two_vertices_with_data() {
        let columns = [
            column("x", "m", vec![0.0, 1.0]),
            column("y", "m", vec![2.0, 3.5]),
            column("mean_stress", "Pa", vec![-1.0, 0.25]),
        ];
        let document = grid(&columns).unwrap();
        let (elements, _) = parse(&document);
        let piece = &elements.iter().find(|e| e.0 == "Piece").unwrap().1;
        assert_eq!(piece["NumberOfPoints"], "2");
        assert_eq!(piece["NumberOfCells"], "2");
        let file = &elements[0].1;
        assert_eq!(file["compressor"], "vtkZLibDataCompressor");
        let arrays = arrays(&document);
        let expected: [(&str, &[f64]); 5] = [
            ("connectivity", &[0.0, 1.0]),
            ("mean_stress (Pa)", &[-1.0, 0.25]),
            ("offsets", &[1.0, 2.0]),
            ("position (m)", &[0.0, 2.0, 0.0, 1.0, 3.5, 0.0]),
            ("types", &[1.0, 1.0]),
        ];
        let found = arrays.iter().map(|(name, values)| (&**name, &**values));
        assert!(found.eq(expected), "{arrays:?}");
        assert!(document.ends_with(b"</VTKFile>"));
    }

    #[test]
    fn many_blocks_none_and_a_whole_one_read_back() {
        let exact = BLOCK / 4;
        for count in [0, 1, exact, 2 * exact + 7] {
            let values: Vec<f64> = (0..count).map(|k| (k % 1000) as f64 - 0.5).collect();
            let document = grid(&[column("x", "m", values.clone())]).unwrap();
            let arrays = arrays(&document);
            let x = arrays["position (m)"].iter().step_by(3);
            assert!(x.eq(&values), "{count}");
            assert_eq!(arrays["offsets"].len(), count);
            // Those in three dimensions are compressed to less than a number each.
            assert!(count < exact || document.len() < 8 * count);
        }
    }

    #[test]
    fn a_collection_names_its_members_with_their_times() {
        let file = |name: &str| format!("snapshots/{name}.vtu");
        let members = [(0.025, file("000.025")), (1.0, file("001.000"))];
        let (elements, _) = parse(&collection(&members).unwrap());
        let sets = elements.iter().filter(|(name, _)| name == "DataSet");
        let sets: Vec<_> = sets.map(|(_, a)| (&*a["timestep"], &*a["file"])).collect();
        assert_eq!(sets, [("0.025", "snapshots/000.025.vtu"), ("1", "snapshots/001.000.vtu")]);
    }
}
