//! Particles for ParaView: a VTK unstructured grid (`.vtu`) of those at one time, and a collection (`.pvd`) of such files
//! with their times.
//!
//! All numbers stand in one appended section, raw and compressed by zlib. Positions and values are of single precision,
//! which is for looking at; what is to be computed with is in the CSV file beside it.

use super::*;
use crate::files::write_whole;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use quick_xml::escape::escape;
use std::io::{self, Write};

/// Columns of positions.
const AXES: [&str; 3] = ["x", "y", "z"];
/// Ends of the names of a vector's components, and of a symmetric tensor's, in VTK's order.
const VECTOR: [&str; 3] = ["_x", "_y", "_z"];
const TENSOR: [&str; 6] = ["_xx", "_yy", "_zz", "_xy", "_yz", "_xz"];
/// VTK's number of a vertex cell.
const VERTEX: u8 = 1;
/// Bytes that are compressed at a time.
const BLOCK: usize = 1 << 20;

/// Writes particles as vertices: the columns `x`, `y`, `z` (those that exist) are the points, all others are point data:
/// vectors and symmetric tensors whole, under plain names. A number beyond single precision becomes infinite.
pub(crate) fn write_vtu(path: &Path, columns: &[Column]) -> Result<(), Error> {
    let document = grid(columns).map_err(|e| Error::file(path, e))?;
    write_whole(path, &document)
}

/// Writes a collection of files, each with its time (s) and its path from the folder of the collection.
pub(crate) fn write_pvd(path: &Path, members: &[(f64, String)]) -> Result<(), Error> {
    write_whole(path, collection(members).as_bytes())
}

fn collection(members: &[(f64, String)]) -> String {
    let member = |(time, file): &(f64, String)| {
        format!("  <DataSet timestep=\"{time}\" part=\"0\" file=\"{}\"/>\n", escape(file))
    };
    let members: String = members.iter().map(member).collect();
    format!("{} <Collection>\n{members} </Collection>\n</VTKFile>", begin("Collection", ""))
}

/// The beginning of a VTK file of a kind, with more attributes.
fn begin(kind: &str, more: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\"{more}>\n"
    )
}

fn grid(columns: &[Column]) -> io::Result<Vec<u8>> {
    let n = columns.first().map_or(0, |c| c.values.len());
    let axes = AXES.map(|name| columns.iter().find(|c| c.name == name));
    let place = |k: usize| axes.map(|axis| axis.map_or(0.0, |c| c.values[k]));
    let counted = |from: usize| (from..from + n).flat_map(|k| (k as u64).to_le_bytes()).collect::<Vec<u8>>();
    let mut numbers = Vec::new();
    let points = array(("Float32", "position", 3), &singles((0..n).flat_map(place)), &mut numbers)?;
    let mut cells = array(("Int64", "connectivity", 1), &counted(0), &mut numbers)?;
    cells += &array(("Int64", "offsets", 1), &counted(1), &mut numbers)?;
    cells += &array(("UInt8", "types", 1), &vec![VERTEX; n], &mut numbers)?;
    let mut fields = String::new();
    for c in columns.iter().filter(|c| !AXES.contains(&c.name)) {
        let (name, parts) = whole(columns, c, axes.iter().flatten().count()).unwrap_or((c.name, vec![Some(c)]));
        // The first component stands for all.
        if parts.iter().flatten().next().is_some_and(|first| first.name == c.name) {
            let values = (0..n).flat_map(|k| parts.iter().map(move |part| part.map_or(0.0, |c| c.values[k])));
            fields += &array(("Float32", name, parts.len()), &singles(values), &mut numbers)?;
        }
    }
    let compressor = " header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\"";
    let head = format!(
        "{} <UnstructuredGrid>\n  <Piece NumberOfPoints=\"{n}\" NumberOfCells=\"{n}\">\n   <Points>\n{points}   \
         </Points>\n   <Cells>\n{cells}   </Cells>\n   <PointData>\n{fields}   </PointData>\n  </Piece>\n \
         </UnstructuredGrid>\n <AppendedData encoding=\"raw\">_",
        begin("UnstructuredGrid", compressor)
    );
    Ok([head.as_bytes(), &numbers, b"\n </AppendedData>\n</VTKFile>"].concat())
}

/// Name and components of the vector or symmetric tensor that a column belongs to, on a grid with these `axes`; components
/// that a plane or a line lacks are none. A vector has all of the axes, a tensor what a plane has.
fn whole<'a>(columns: &'a [Column], own: &'a Column, axes: usize) -> Option<(&'a str, Vec<Option<&'a Column>>)> {
    [(&VECTOR[..], axes), (&TENSOR, 4)].into_iter().find_map(|(ends, least)| {
        let stem = ends.iter().find_map(|end| own.name.strip_suffix(end))?;
        let of = |end: &&str| columns.iter().find(|c| c.unit == own.unit && c.name.strip_suffix(*end) == Some(stem));
        let parts: Vec<_> = ends.iter().map(of).collect();
        parts[..least].iter().all(Option::is_some).then_some((stem, parts))
    })
}

fn singles(values: impl Iterator<Item = f64>) -> Vec<u8> {
    values.flat_map(|v| (v as f32).to_le_bytes()).collect()
}

/// The element of an array of a type, name and number of components, whose `bytes` are appended to the `numbers`: compressed
/// blocks behind their number, their size, that of the last if it is shorter (else 0), and what each is compressed to.
fn array((kind, name, components): (&str, &str, usize), bytes: &[u8], numbers: &mut Vec<u8>) -> io::Result<String> {
    let offset = numbers.len();
    let blocks = bytes.chunks(BLOCK).map(|block| {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(block)?;
        encoder.finish()
    });
    let blocks = blocks.collect::<io::Result<Vec<_>>>()?;
    let header = [blocks.len(), BLOCK, bytes.len() % BLOCK].into_iter().chain(blocks.iter().map(Vec::len));
    numbers.extend(header.flat_map(|n| (n as u64).to_le_bytes()));
    numbers.extend(blocks.concat());
    Ok(format!(
        "    <DataArray type=\"{kind}\" Name=\"{}\" NumberOfComponents=\"{components}\" format=\"appended\" \
         offset=\"{offset}\"/>\n",
        escape(name)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use quick_xml::Reader;
    use quick_xml::events::Event;
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
            ("mean_stress", &[-1.0, 0.25]),
            ("offsets", &[1.0, 2.0]),
            ("position", &[0.0, 2.0, 0.0, 1.0, 3.5, 0.0]),
            ("types", &[1.0, 1.0]),
        ];
        let found = arrays.iter().map(|(name, values)| (&**name, &**values));
        assert!(found.eq(expected), "{arrays:?}");
        assert!(document.ends_with(b"</VTKFile>"));
    }

    #[test]
    fn vectors_and_tensors_are_whole_and_parts_of_them_scalars() {
        let of =
            |name: &'static str, value: f64| column(name, if name.contains("st") { "Pa" } else { "m" }, vec![value]);
        let columns = [of("x", 0.0), of("y", 0.0), of("u_x", 1.0), of("u_y", 2.0), of("force_x", 3.0)];
        let stress = ["xx", "yy", "zz", "xy"].map(|k| format!("stress_{k}").leak() as &'static str);
        let tensor = stress.into_iter().zip([4.0, 5.0, 6.0, 7.0]).map(|(name, value)| of(name, value));
        let lone = of("effective_stress_yy", 8.0);
        let columns: Vec<Column> = columns.into_iter().chain(tensor).chain([lone]).collect();
        let arrays = arrays(&grid(&columns).unwrap());
        assert_eq!(arrays["u"], [1.0, 2.0, 0.0]);
        assert_eq!(arrays["stress"], [4.0, 5.0, 6.0, 7.0, 0.0, 0.0]);
        assert_eq!((&*arrays["force_x"], &*arrays["effective_stress_yy"]), (&[3.0][..], &[8.0][..]));
    }

    #[test]
    fn many_blocks_none_and_a_whole_one_read_back() {
        let exact = BLOCK / 4;
        for count in [0, 1, exact, 2 * exact + 7] {
            let values: Vec<f64> = (0..count).map(|k| (k % 1000) as f64 - 0.5).collect();
            let document = grid(&[column("x", "m", values.clone())]).unwrap();
            let arrays = arrays(&document);
            let x = arrays["position"].iter().step_by(3);
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
        let (elements, _) = parse(collection(&members).as_bytes());
        let sets = elements.iter().filter(|(name, _)| name == "DataSet");
        let sets: Vec<_> = sets.map(|(_, a)| (&*a["timestep"], &*a["file"])).collect();
        assert_eq!(sets, [("0.025", "snapshots/000.025.vtu"), ("1", "snapshots/001.000.vtu")]);
    }
}
