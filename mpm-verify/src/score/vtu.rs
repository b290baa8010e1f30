//! Particles from an unstructured grid or polygonal data of VTK, as other codes and ParaView write them: one piece, whose
//! points and point data become columns; in ASCII, or binary in place or appended, plain or compressed by zlib.

use super::vtk::{self, MOST, lowest_first};
use crate::table::Table;
use flate2::read::ZlibDecoder;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::cell::Cell;
use std::io::Read;

/// Most compressed blocks of an array.
const MOST_BLOCKS: u64 = 100_000;
/// Most bytes that arrays come to, over those of the file, and more for a small one.
const MOST_PACKED: u64 = 64;
const SMALL: u64 = 1 << 20;
/// The element behind whose mark the numbers of all arrays may stand.
const APPENDED: &[u8] = b"<AppendedData";
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
    own: vtk::Array,
    kind: String,
    format: String,
    offset: usize,
    text: String,
}

/// Reads a table of particles.
pub(super) fn table(bytes: &[u8]) -> Result<Table, String> {
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
    vtk::table(arrays.into_iter().map(|array| match array.numbers(&layout, points, data) {
        Ok(numbers) => Ok((array.own, numbers)),
        Err(said) => Err(format!("array {:?}: {said}", array.own.name)),
    }))
}

/// An attribute of an element, whose name some programs begin with a capital.
fn attribute(element: &BytesStart<'_>, name: &str) -> Option<String> {
    let mut all = element.attributes().flatten();
    Some(all.find(|a| a.key.as_ref().eq_ignore_ascii_case(name))?.value.into_owned())
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
                        is_read = ["Points", "PointData"].contains(&inside) && array.own.is_read();
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
        let whole = |text: String| text.trim().parse().unwrap_or(usize::MAX);
        let number = |name: &str, or: usize| attribute(element, name).map_or(or, whole);
        let own = vtk::Array { name: text("Name"), of_points, components: number("NumberOfComponents", 1) };
        Self { own, kind: text("type"), format: text("format"), offset: number("offset", 0), text: String::new() }
    }

    fn numbers(&self, layout: &Layout, points: usize, data: &[u8]) -> Result<Vec<f64>, String> {
        let count = points * self.own.components;
        let short = || format!("not {count} numbers");
        let numbers: Vec<f64> = match &*self.format {
            "ascii" => self.text.split_ascii_whitespace().take(count + 1).map(vtk::number).collect::<Result<_, _>>()?,
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
        if numbers.len() == count { Ok(numbers) } else { Err(short()) }
    }

    /// Unpacks `count` numbers of packed bytes: their length, or the sizes of compressed blocks, goes before them.
    fn unpack(&self, layout: &Layout, count: usize, from: &mut impl Read) -> Result<Vec<f64>, String> {
        let kind = vtk::kind(&self.kind)?;
        let (_, size, _) = kind;
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
            from.take(whole).read_to_end(&mut bytes).map_err(|e| e.to_string())?;
        }
        if bytes.len() as u64 != whole {
            return Err(wrong(&format!("{} bytes", bytes.len())));
        }
        Ok(vtk::numbers(kind, &bytes, layout.big_endian))
    }
}

impl Layout {
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

    fn read_piece(&mut self, element: &BytesStart<'_>) -> Result<(), String> {
        if self.points.is_some() {
            return Err("more than one piece".to_owned());
        }
        let points = attribute(element, "NumberOfPoints").and_then(|n| n.trim().parse().ok());
        self.points = points.filter(|n| (1..=MOST).contains(n));
        self.points.map(drop).ok_or_else(|| format!("NumberOfPoints: 1 to {MOST} are allowed"))
    }

    /// Takes bytes from what arrays may come to: a small file must not take much time or memory.
    fn spend(&self, bytes: u64) -> Result<(), String> {
        let left = self.left.get().checked_sub(bytes);
        let said =
            || format!("{bytes} bytes, with which the arrays are more than {MOST_PACKED} times as large as the file");
        self.left.set(left.ok_or_else(said)?);
        Ok(())
    }

    fn header(&self, from: &mut impl Read) -> Result<u64, String> {
        let mut bytes = [0; 8];
        let own = &mut bytes[..if self.long_headers { 8 } else { 4 }];
        from.read_exact(own).map_err(|_| "no header".to_owned())?;
        let own = own.to_vec();
        Ok(u64::from_le_bytes(lowest_first(&own, self.big_endian)))
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
        let (mut group, mut bits) = (0_u32, 0);
        for _ in 0..4 {
            let digit = match self.text.find(|c| !c.is_ascii_whitespace()).copied() {
                Some(c @ b'A'..=b'Z') => c - b'A',
                Some(c @ b'a'..=b'z') => c - b'a' + 26,
                Some(c @ b'0'..=b'9') => c - b'0' + 52,
                Some(b'+') => 62,
                Some(b'/') => 63,
                Some(b'=') => {
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
