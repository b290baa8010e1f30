//! Particles from files of VTK's old format, `.vtk`: an unstructured grid or polygonal data of versions 2.0 to 5.1, in ASCII
//! or in bytes, the highest first. <https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html>

use super::vtk::{Array, Columns, KINDS, MOST, number, numbers};
use crate::table::Table;

/// Types of numbers, in lower case, as those of the other formats; an index takes four bytes.
const TYPES: [(&str, &str); 14] = [
    ("double", "Float64"),
    ("float", "Float32"),
    ("long", "Int64"),
    ("vtktypeint64", "Int64"),
    ("unsigned_long", "UInt64"),
    ("vtktypeuint64", "UInt64"),
    ("int", "Int32"),
    ("vtkidtype", "Int32"),
    ("unsigned_int", "UInt32"),
    ("short", "Int16"),
    ("unsigned_short", "UInt16"),
    ("char", "Int8"),
    ("signed_char", "Int8"),
    ("unsigned_char", "UInt8"),
];
/// Attributes whose line has a name and a type, with their components.
const ATTRIBUTES: [(&str, usize); 6] =
    [("VECTORS", 3), ("NORMALS", 3), ("TENSORS", 9), ("TENSORS6", 6), ("GLOBAL_IDS", 1), ("PEDIGREE_IDS", 1)];
/// Mark before the version.
const HEAD: &str = "# vtk DataFile Version ";

/// Reads a table of particles.
///
/// # Errors
/// It is no such grid, or is cut: the error names the array or has the line.
pub(super) fn table(bytes: &[u8]) -> Result<Table, String> {
    let mut file = File { rest: bytes, ..File::default() };
    let version = file.raw_line();
    let version = version.strip_prefix(HEAD).and_then(|v| v.trim().parse().ok());
    if !version.is_some_and(|v: f64| (2.0..=5.1).contains(&v)) {
        return Err(format!("line 1: \"{HEAD}\" and 2.0 to 5.1 are allowed"));
    }
    file.raw_line();
    file.binary = match &*file.raw_line().trim().to_ascii_uppercase() {
        "ASCII" => false,
        "BINARY" => true,
        _ => return Err("line 3: ASCII and BINARY are allowed".to_owned()),
    };
    while let Some(line) = file.line() {
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        let read = file.section(&words[0].to_ascii_uppercase(), &words[1..]);
        read.ok_or_else(|| format!("line {line:?}: sections of UNSTRUCTURED_GRID and POLYDATA are allowed"))??;
    }
    file.columns.table()
}

/// A file, read up to `rest`.
#[derive(Default)]
struct File<'a> {
    rest: &'a [u8],
    binary: bool,
    columns: Columns,
    points: usize,
    /// Tuples of the data that follow, and whether they are of points.
    tuples: usize,
    of_points: bool,
    /// Components of the last array.
    components: usize,
}

impl File<'_> {
    fn raw_line(&mut self) -> String {
        let end = self.rest.iter().position(|b| *b == b'\n').map_or(self.rest.len(), |end| end + 1);
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest;
        String::from_utf8_lossy(line).into_owned()
    }

    /// The next line that is not blank, behind blocks of metadata, which end with a blank line.
    fn line(&mut self) -> Option<String> {
        loop {
            self.rest = self.rest.trim_ascii_start();
            let line = self.raw_line();
            if !line.trim().eq_ignore_ascii_case("METADATA") {
                return (!line.is_empty()).then_some(line);
            }
            loop {
                match self.raw_line().trim() {
                    "" => break,
                    "COMPONENT_NAMES" => (0..self.components).for_each(|_| drop(self.raw_line())),
                    _ => {}
                }
            }
        }
    }

    fn begins(&self, with: &str) -> bool {
        let text = self.rest.trim_ascii_start().get(..with.len());
        text.is_some_and(|text| text.eq_ignore_ascii_case(with.as_bytes()))
    }

    /// Reads a section by its first word and those behind it; nothing if there is no such section.
    fn section(&mut self, keyword: &str, words: &[&str]) -> Option<Result<(), String>> {
        let whole = |word: &str| word.parse::<usize>().ok();
        let tuples = self.tuples;
        Some(match (keyword, words) {
            ("DATASET", [of]) => return ["UNSTRUCTURED_GRID", "POLYDATA"].contains(of).then_some(Ok(())),
            ("POINTS", [count, kind]) => {
                let again = std::mem::replace(&mut self.points, whole(count)?) > 0;
                if again || !(1..=MOST).contains(&self.points) {
                    return Some(Err(format!("POINTS {count}: 1 to {MOST} are allowed, once")));
                }
                let places = Array { name: keyword.to_owned(), of_points: true, components: 3 };
                self.array(places, kind, self.points)
            }
            ("CELLS" | "VERTICES" | "LINES" | "POLYGONS" | "TRIANGLE_STRIPS", [cells, size]) => {
                match self.begins("OFFSETS") {
                    true => self.listed([whole(cells)?, whole(size)?]),
                    false => self.skip("int", whole(size)?),
                }
            }
            ("CELL_TYPES", [count]) => self.skip("int", whole(count)?),
            ("POINT_DATA" | "CELL_DATA", [count]) => {
                (self.tuples, self.of_points) = (whole(count)?, keyword == "POINT_DATA");
                Ok(())
            }
            ("SCALARS", [name, kind, components @ ..]) if components.len() < 2 => {
                if self.begins("LOOKUP_TABLE") {
                    self.line();
                }
                let components = components.first().map_or(Some(1), |n| whole(n))?;
                self.data(name, kind, [components, tuples])
            }
            ("TEXTURE_COORDINATES", [name, components, kind]) => self.data(name, kind, [whole(components)?, tuples]),
            ("COLOR_SCALARS", [_, components]) => self.skip("unsigned_char", whole(components)?.checked_mul(tuples)?),
            ("LOOKUP_TABLE", [_, colours]) => self.skip("unsigned_char", whole(colours)?.checked_mul(4)?),
            ("FIELD", [_, arrays]) => (0..whole(arrays)?).try_for_each(|_| self.field()),
            (attribute, [name, kind]) => {
                let (_, components) = ATTRIBUTES.iter().find(|(name, _)| *name == attribute)?;
                self.data(name, kind, [*components, tuples])
            }
            _ => return None,
        })
    }

    /// Passes cells as offsets and points.
    fn listed(&mut self, counts: [usize; 2]) -> Result<(), String> {
        for count in counts {
            let line = self.line().unwrap_or_default();
            self.skip(line.split_ascii_whitespace().nth(1).unwrap_or_default(), count)?;
        }
        Ok(())
    }

    /// An array of a field.
    fn field(&mut self) -> Result<(), String> {
        let line = self.line().unwrap_or_default();
        let wrong = || format!("line {line:?}: name, components, tuples and type of an array are allowed");
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        let [name, components, tuples, kind] = words[..] else { return Err(wrong()) };
        let whole = |word: &str| word.parse().map_err(|_| wrong());
        self.data(name, kind, [whole(components)?, whole(tuples)?])
    }

    fn data(&mut self, name: &str, kind: &str, [components, tuples]: [usize; 2]) -> Result<(), String> {
        self.array(Array { name: decoded(name), of_points: false, components }, kind, tuples)
    }

    fn array(&mut self, array: Array, kind: &str, tuples: usize) -> Result<(), String> {
        self.components = array.components;
        let wrong = |said: String| format!("array {:?}: {said}", array.name);
        if self.of_points && tuples != self.points {
            return Err(wrong(format!("of {tuples} points, where {} are", self.points)));
        }
        let count = array.components.saturating_mul(tuples);
        let numbers = self.numbers(kind, count).map_err(wrong)?;
        if array.of_points || self.of_points && array.is_read() {
            self.columns.add(array, numbers);
        }
        Ok(())
    }

    fn skip(&mut self, kind: &str, count: usize) -> Result<(), String> {
        self.numbers(kind, count).map(drop)
    }

    fn numbers(&mut self, kind: &str, count: usize) -> Result<Vec<f64>, String> {
        let known = TYPES.iter().find(|(name, _)| name.eq_ignore_ascii_case(kind));
        let known = known.and_then(|(_, own)| KINDS.iter().find(|(name, ..)| name == own));
        let known = known.ok_or_else(|| format!("type {kind:?}"))?;
        let short = || format!("not {count} numbers");
        if self.binary {
            let bytes = count.saturating_mul(known.1);
            let (own, rest) = self.rest.split_at_checked(bytes).ok_or_else(short)?;
            self.rest = rest;
            return Ok(numbers(known, own, true));
        }
        // A blank ends a number, or it may be cut.
        let next = |_| {
            let text = self.rest.trim_ascii_start();
            let end = text.iter().position(u8::is_ascii_whitespace).ok_or_else(short)?;
            let (word, rest) = text.split_at(end);
            self.rest = rest;
            number(&String::from_utf8_lossy(word))
        };
        (0..count).map(next).collect()
    }
}

/// A name whose blanks and marks are written as `%20`.
fn decoded(name: &str) -> String {
    let mut parts = name.split('%');
    let mut bytes = parts.next().unwrap_or_default().as_bytes().to_vec();
    for part in parts {
        let code = part.get(..2).and_then(|hex| u8::from_str_radix(hex, 16).ok());
        bytes.push(code.unwrap_or(b'%'));
        bytes.extend(&part.as_bytes()[if code.is_some() { 2 } else { 0 }..]);
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests;
