//! Particles from an unstructured grid or polygonal data of VTK, as other codes and ParaView write them: one piece, whose
//! points and point data become columns; in ASCII, or binary in place or appended, plain or compressed by zlib.

use crate::error::Error;
use crate::files::{TABLE, read as read_file};
use crate::table::Table;
use flate2::read::ZlibDecoder;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::cell::Cell;
use std::collections::HashSet;
use std::io::Read;
use std::path::Path;

/// Most points, and most compressed blocks of an array.
const MOST: usize = 5_000_000;
const MOST_BLOCKS: u64 = 100_000;
/// Most bytes that arrays come to, over those of the file, and more for a small one.
const MOST_PACKED: u64 = 64;
const SMALL: u64 = 1 << 20;
/// The element behind whose mark the numbers of all arrays may stand.
const APPENDED: &[u8] = b"<AppendedData";
const AXES: [&str; 3] = ["x (m)", "y (m)", "z (m)"];
/// A vector or tensor: its name, unit, number of components, and columns of some of these.
type Parts = (&'static str, &'static str, usize, &'static [(usize, &'static str)]);

/// Vectors and tensors with the columns of their components; of a symmetric tensor VTK has xx, yy, zz, xy, yz and xz.
const PARTS: [Parts; 5] = [
    ("reference", "m", 3, &[(0, "reference_x (m)"), (1, "reference_y (m)"), (2, "reference_z (m)")]),
    ("displacement", "m", 3, &[(0, "ux (m)"), (1, "uy (m)"), (2, "uz (m)")]),
    ("plateau_displacement", "m", 3, &[(0, "plateau_ux (m)"), (1, "plateau_uy (m)")]),
    ("stress", "Pa", 6, &[(0, "stress_xx (Pa)"), (1, "stress_yy (Pa)"), (2, "stress_zz (Pa)"), (3, "stress_xy (Pa)")]),
    ("stress", "Pa", 9, &[(0, "stress_xx (Pa)"), (4, "stress_yy (Pa)"), (8, "stress_zz (Pa)"), (1, "stress_xy (Pa)")]),
];

/// Types of numbers: their name, bytes and value.
type Kind = (&'static str, usize, fn([u8; 8]) -> f64);

/// From the first bytes, the lowest first.
const KINDS: [Kind; 10] = [
    ("Float64", 8, f64::from_le_bytes),
    ("Float32", 4, |b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]))),
    ("Int64", 8, |b| i64::from_le_bytes(b) as f64),
    ("UInt64", 8, |b| u64::from_le_bytes(b) as f64),
    ("Int32", 4, |b| f64::from(i32::from_le_bytes([b[0], b[1], b[2], b[3]]))),
    ("UInt32", 4, |b| f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]]))),
    ("Int16", 2, |b| f64::from(i16::from_le_bytes([b[0], b[1]]))),
    ("UInt16", 2, |b| f64::from(u16::from_le_bytes([b[0], b[1]]))),
    ("Int8", 1, |b| f64::from(b[0] as i8)),
    ("UInt8", 1, |b| f64::from(b[0])),
];

/// Layout of all arrays, from the head of a file.
#[derive(Default)]
struct Layout {
    /// Bytes that arrays may still come to.
    left: Cell<u64>,
    points: Option<usize>,
    big_endian: bool,
    long_headers: bool,
    compressed: bool,
    appended_base64: bool,
}

/// An array, as it is described.
struct Array {
    name: String,
    of_points: bool,
    kind: String,
    components: usize,
    format: String,
    offset: usize,
    text: String,
}

/// Reads a table of particles.
///
/// # Errors
/// The file can't be read, or is no such grid: the error names the array.
pub(super) fn read(path: &Path) -> Result<Table, Error> {
    let bytes = read_file(path, TABLE)?;
    table(&bytes).map_err(|said| Error::file(path, said))
}

fn table(bytes: &[u8]) -> Result<Table, String> {
    let end = bytes.windows(APPENDED.len()).position(|w| w == APPENDED);
    let (head, tail) = bytes.split_at(end.unwrap_or(bytes.len()));
    let head = std::str::from_utf8(head).map_err(|_| "not UTF-8")?;
    let (mut layout, arrays) = described(head, usize::from(end.is_some()))?;
    let tag = tail.iter().position(|b| *b == b'>').unwrap_or(tail.len());
    let (tag, data) = tail.split_at(tag);
    layout.left.set(MOST_PACKED * bytes.len() as u64 + SMALL);
    layout.appended_base64 = tag.windows(6).any(|w| w == b"base64");
    let mark = data.iter().position(|b| *b == b'_');
    let data = mark.map_or(&[][..], |mark| &data[mark + 1..]);
    let points = layout.points.ok_or("no piece with NumberOfPoints")?;
    let (mut columns, mut parts) = (Vec::<(String, Vec<f64>)>::new(), Vec::new());
    for array in arrays {
        let numbers = array.numbers(&layout, points, data).map_err(|said| format!("array {:?}: {said}", array.name))?;
        if array.of_points {
            for (axis, name) in AXES.iter().enumerate() {
                let along = numbers.iter().skip(axis).step_by(3).copied();
                columns.push(((*name).to_owned(), along.collect()));
            }
        } else if array.components == 1 {
            columns.push((array.name, numbers));
        } else {
            parts.extend(array.parts(&numbers));
        }
    }
    // A column that is there as a scalar is that one.
    parts.retain(|(name, _)| !columns.iter().any(|(own, _)| own == name));
    columns.append(&mut parts);
    let mut known = HashSet::new();
    for (name, values) in &columns {
        if !known.insert(name) {
            return Err(format!("array {name:?} is there twice"));
        }
        if let Some(row) = values.iter().position(|v| !v.is_finite()) {
            return Err(format!("array {name:?}, point {}: {}", row + 1, values[row]));
        }
    }
    match columns.is_empty() {
        true => Err("no points and no scalar point data".to_owned()),
        false => Ok(Table::of_columns(columns)),
    }
}

/// An attribute of an element, whose name some programs begin with a capital.
fn attribute(element: &BytesStart<'_>, name: &str) -> Option<String> {
    let mut all = element.attributes().flatten();
    let found = all.find(|a| a.key.as_ref().eq_ignore_ascii_case(name))?;
    Some(found.value.into_owned())
}

/// Points and scalar point data of a grid. An array's numbers are its own text: elements inside it, such as VTK's
/// ranges of vectors, have text of theirs. `open` elements are open at its end, or it was cut.
fn described(head: &str, open: usize) -> Result<(Layout, Vec<Array>), String> {
    let mut reader = Reader::from_str(head);
    let (mut layout, mut arrays) = (Layout::default(), Vec::<Array>::new());
    // Names of the elements around, the innermost last, and whether the last array is read.
    let (mut around, mut is_read) = (Vec::<String>::new(), false);
    loop {
        let event = reader.read_event().map_err(|e| e.to_string())?;
        let empty = matches!(event, Event::Empty(_));
        let inside = around.last().map_or("", String::as_str);
        match event {
            Event::Eof if around.len() != open => return Err(format!("cut in {inside:?}")),
            Event::Eof => return Ok((layout, arrays)),
            Event::Start(e) | Event::Empty(e) => {
                match e.name().as_ref() {
                    "VTKFile" => layout.read_file(&e)?,
                    "Piece" => layout.read_piece(&e)?,
                    "DataArray" => {
                        let array = Array::of(&e, inside == "Points");
                        is_read = ["Points", "PointData"].contains(&inside) && array.is_read();
                        if is_read {
                            arrays.push(array);
                        }
                    }
                    _ => {}
                }
                if !empty {
                    around.push(e.name().as_ref().to_owned());
                }
            }
            Event::End(_) => {
                around.pop();
            }
            Event::Text(text) if is_read && inside == "DataArray" => {
                if let Some(array) = arrays.last_mut() {
                    array.text.push_str(&text);
                }
            }
            _ => {}
        }
    }
}

impl Array {
    fn of(element: &BytesStart<'_>, of_points: bool) -> Self {
        let text = |name: &str| attribute(element, name).unwrap_or_default();
        let number = |name: &str, or: usize| match attribute(element, name) {
            Some(text) => text.trim().parse().unwrap_or(usize::MAX),
            None => or,
        };
        Self {
            name: text("Name"),
            of_points,
            kind: text("type"),
            components: number("NumberOfComponents", 1),
            format: text("format"),
            offset: number("offset", 0),
            text: String::new(),
        }
    }

    /// Whether it becomes a column, or those of places.
    fn is_read(&self) -> bool {
        match self.of_points {
            true => self.components == 3,
            false => self.components == 1 || self.kind_of_parts().is_some(),
        }
    }

    /// Columns of a vector or tensor that is known by its name, with its unit or without.
    fn kind_of_parts(&self) -> Option<&'static [(usize, &'static str)]> {
        let is = |name: &str, unit: &str| self.name == name || self.name == format!("{name} ({unit})");
        let known = PARTS.iter().find(|(name, unit, count, _)| *count == self.components && is(name, unit));
        known.map(|(.., columns)| *columns)
    }

    /// Columns of a vector or tensor; of a stress its mean too.
    fn parts(&self, numbers: &[f64]) -> Vec<(String, Vec<f64>)> {
        let part = |k: usize| numbers.iter().skip(k).step_by(self.components).copied();
        let known = self.kind_of_parts().unwrap_or_default();
        let mut parts: Vec<_> = known.iter().map(|(k, name)| ((*name).to_owned(), part(*k).collect())).collect();
        if let [(x, _), (y, _), (z, _), _] = known {
            let mean = part(*x).zip(part(*y)).zip(part(*z)).map(|((x, y), z)| (x + y + z) / 3.0);
            parts.push(("mean_stress (Pa)".to_owned(), mean.collect()));
        }
        parts
    }

    fn numbers(&self, layout: &Layout, points: usize, data: &[u8]) -> Result<Vec<f64>, String> {
        let count = points * self.components;
        let short = || format!("not {count} numbers");
        let numbers: Vec<f64> = match &*self.format {
            "ascii" => {
                let words = self.text.split_ascii_whitespace().take(count + 1);
                let numbers = words.map(|w| w.parse().map_err(|_| format!("{w:?} is no number")));
                numbers.collect::<Result<_, _>>()?
            }
            "binary" => self.unpack(layout, count, &mut Base64::new(self.text.as_bytes()))?,
            "appended" => {
                let own = data.get(self.offset..).ok_or("an offset behind the data")?;
                match layout.appended_base64 {
                    true => self.unpack(layout, count, &mut Base64::new(own))?,
                    false => self.unpack(layout, count, &mut &own[..])?,
                }
            }
            other => {
                return Err(format!("format {other:?}; allowed: ascii, binary, appended"));
            }
        };
        match numbers.len() == count {
            true => Ok(numbers),
            false => Err(short()),
        }
    }

    /// Unpacks `count` numbers of packed bytes: their length, or the sizes of compressed blocks, goes before them.
    fn unpack(&self, layout: &Layout, count: usize, from: &mut impl Read) -> Result<Vec<f64>, String> {
        let known = KINDS.iter().find(|(name, ..)| *name == self.kind);
        let (_, size, value) = known.ok_or_else(|| format!("type {:?}", self.kind))?;
        let whole = (count * size) as u64;
        layout.spend(8 * count as u64)?;
        let wrong = |what: &str| format!("{what}, where {whole} bytes are described");
        let mut bytes = Vec::new();
        if layout.compressed {
            let mut header = || layout.header(from);
            let [blocks, _, _] = [header()?, header()?, header()?];
            if blocks > MOST_BLOCKS {
                return Err(wrong("too many blocks"));
            }
            layout.spend(8 * blocks)?;
            let sizes = (0..blocks).map(|_| header()).collect::<Result<Vec<_>, _>>()?;
            for size in sizes {
                layout.spend(size)?;
                let mut packed = from.by_ref().take(size);
                let left = (whole + 1).saturating_sub(bytes.len() as u64);
                let inflated = ZlibDecoder::new(&mut packed).take(left).read_to_end(&mut bytes);
                inflated.map_err(|e| wrong(&e.to_string()))?;
                std::io::copy(&mut packed, &mut std::io::sink()).map_err(|e| e.to_string())?;
            }
        } else {
            let said = layout.header(from)?;
            if said != whole {
                return Err(wrong(&format!("{said} bytes")));
            }
            let taken = from.take(whole).read_to_end(&mut bytes);
            taken.map_err(|e| e.to_string())?;
        }
        if bytes.len() as u64 != whole {
            return Err(wrong(&format!("{} bytes", bytes.len())));
        }
        let numbers = bytes.chunks_exact(*size).map(|bytes| value(layout.lowest_first(bytes)));
        Ok(numbers.collect())
    }
}

impl Layout {
    /// Reads the outermost element.
    fn read_file(&mut self, element: &BytesStart<'_>) -> Result<(), String> {
        let is = |name: &str, value: &str| attribute(element, name).is_some_and(|v| v == value);
        if !["UnstructuredGrid", "PolyData"].iter().any(|kind| is("type", kind)) {
            return Err("no VTKFile of type UnstructuredGrid or PolyData".to_owned());
        }
        self.big_endian = is("byte_order", "BigEndian");
        self.long_headers = is("header_type", "UInt64");
        let compressor = attribute(element, "compressor").filter(|c| !c.is_empty());
        self.compressed = compressor.is_some();
        match compressor.is_some_and(|c| c != "vtkZLibDataCompressor") {
            true => Err("a compressor other than vtkZLibDataCompressor".to_owned()),
            false => Ok(()),
        }
    }

    /// Reads the only piece.
    fn read_piece(&mut self, element: &BytesStart<'_>) -> Result<(), String> {
        if self.points.is_some() {
            return Err("more than one piece".to_owned());
        }
        let points = attribute(element, "NumberOfPoints").and_then(|n| n.trim().parse().ok());
        self.points = points.filter(|n| (1..=MOST).contains(n));
        match self.points {
            Some(_) => Ok(()),
            None => Err(format!("NumberOfPoints: 1 to {MOST} are allowed")),
        }
    }

    /// Takes bytes from what arrays may come to: a small file must not take much time or memory.
    fn spend(&self, bytes: u64) -> Result<(), String> {
        let left = self.left.get().checked_sub(bytes);
        let said =
            || format!("{bytes} bytes, with which the arrays are more than {MOST_PACKED} times as large as the file");
        self.left.set(left.ok_or_else(said)?);
        Ok(())
    }

    /// Up to eight bytes, the lowest first.
    fn lowest_first(&self, bytes: &[u8]) -> [u8; 8] {
        let mut all = [0; 8];
        all[..bytes.len()].copy_from_slice(bytes);
        if self.big_endian {
            all[..bytes.len()].reverse();
        }
        all
    }

    /// A number of a header.
    fn header(&self, from: &mut impl Read) -> Result<u64, String> {
        let mut bytes = [0; 8];
        let own = &mut bytes[..if self.long_headers { 8 } else { 4 }];
        from.read_exact(own).map_err(|_| "no header".to_owned())?;
        let own = own.to_vec();
        Ok(u64::from_le_bytes(self.lowest_first(&own)))
    }
}

/// Bytes written in base64, in pieces that are each padded; ends at the first other byte.
struct Base64<'a> {
    text: std::slice::Iter<'a, u8>,
    /// Bytes that are decoded and not taken, the next one last.
    ready: Vec<u8>,
}

impl<'a> Base64<'a> {
    fn new(text: &'a [u8]) -> Self {
        Self { text: text.iter(), ready: Vec::new() }
    }

    /// Decodes the next four characters.
    fn fill(&mut self) {
        let mut group = 0_u32;
        let mut bits = 0;
        for _ in 0..4 {
            let Some(c) = self.text.find(|c| !c.is_ascii_whitespace()) else {
                return;
            };
            let digit = match c {
                b'A'..=b'Z' => c - b'A',
                b'a'..=b'z' => c - b'a' + 26,
                b'0'..=b'9' => c - b'0' + 52,
                b'+' => 62,
                b'/' => 63,
                b'=' => {
                    group <<= 6;
                    continue;
                }
                _ => {
                    self.text = [].iter();
                    return;
                }
            };
            group = group << 6 | u32::from(digit);
            bits += 6;
        }
        let [_, bytes @ ..] = group.to_be_bytes();
        self.ready.extend(bytes[..bits / 8].iter().rev());
    }
}

impl Read for Base64<'_> {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        let mut count = 0;
        for place in into {
            if self.ready.is_empty() {
                self.fill();
            }
            let Some(byte) = self.ready.pop() else { break };
            *place = byte;
            count += 1;
        }
        Ok(count)
    }
}

#[cfg(test)]
mod tests;
