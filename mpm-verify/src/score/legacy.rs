//! Particles from VTK's old format, `.vtk`: unstructured grids and polygonal data of versions 2.0 to 5.1, in text or in
//! bytes, the highest first. <https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html>

use super::vtk::{self, Array, MOST, kind, numbers};
use crate::table::Table;

/// Reads a table of particles.
pub(super) fn table(bytes: &[u8]) -> Result<Table, String> {
    let mut file = File { rest: bytes, ..File::default() };
    let [version, _, format] = [(); 3].map(|()| file.raw_line());
    let version = version.strip_prefix("# vtk DataFile Version ").and_then(|v| v.trim().parse().ok()).unwrap_or(0.0);
    file.binary = format.trim().eq_ignore_ascii_case("BINARY");
    if !(2.0..=5.1).contains(&version) || !file.binary && !format.trim().eq_ignore_ascii_case("ASCII") {
        return Err("lines 1 and 3; allowed: \"# vtk DataFile Version\" 2.0 to 5.1, ASCII or BINARY".to_owned());
    }
    while let Some(line) = file.line() {
        let mut words = line.split_ascii_whitespace();
        let keyword = words.next().unwrap_or_default().to_ascii_uppercase();
        let read = file.section(&keyword, &words.collect::<Vec<_>>());
        let allowed = format_args!("sections of UNSTRUCTURED_GRID and POLYDATA with 1 to {MOST} points");
        read.ok_or_else(|| format!("line {line:?}; allowed: {allowed}"))??;
    }
    vtk::table(file.arrays.into_iter().map(Ok))
}

/// A file, read up to `rest`.
#[derive(Default)]
struct File<'a> {
    rest: &'a [u8],
    binary: bool,
    arrays: Vec<(Array, Vec<f64>)>,
    points: usize,
    /// Cells, and numbers that list them.
    cells: [usize; 2],
    /// Tuples of the data that follow, and whether they are of points.
    tuples: usize,
    of_points: bool,
    /// Components of the last array.
    components: usize,
}

impl File<'_> {
    fn raw_line(&mut self) -> String {
        let end = self.rest.iter().position(|b| *b == b'\n').map_or(self.rest.len(), |end| end + 1);
        String::from_utf8_lossy(self.rest.split_off(..end).unwrap_or_default()).into_owned()
    }

    /// The next line that is not blank, behind blocks of metadata, which end with a blank line.
    fn line(&mut self) -> Option<String> {
        loop {
            self.rest = self.rest.trim_ascii_start();
            let line = self.raw_line();
            if !line.trim().eq_ignore_ascii_case("METADATA") {
                return (!line.is_empty()).then_some(line);
            }
            let mut about = self.raw_line();
            while !about.trim().is_empty() {
                let names = if about.trim() == "COMPONENT_NAMES" { self.components } else { 0 };
                about = (0..=names.min(self.rest.len())).map(|_| self.raw_line()).last().unwrap_or_default();
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
            ("DATASET", [of]) if ["POLYDATA", "UNSTRUCTURED_GRID"].contains(&&*of.to_ascii_uppercase()) => Ok(()),
            ("POINTS", [count, kind]) => {
                self.points = whole(count).filter(|n| (1..=MOST).contains(n))?;
                self.array(keyword, kind, [3, self.points], true)
            }
            ("CELLS" | "VERTICES" | "LINES" | "POLYGONS" | "TRIANGLE_STRIPS", [cells, size]) => {
                self.cells = [whole(cells)?, whole(size)?];
                // Offsets and points have lines of their own since 5.1.
                if self.begins("OFFSETS") { Ok(()) } else { self.numbers("int", self.cells[1]).map(drop) }
            }
            ("OFFSETS", [kind]) => self.numbers(kind, self.cells[0]).map(drop),
            ("CONNECTIVITY", [kind]) => self.numbers(kind, self.cells[1]).map(drop),
            ("CELL_TYPES", [count]) => self.numbers("int", whole(count)?).map(drop),
            ("POINT_DATA" | "CELL_DATA", [count]) => {
                (self.tuples, self.of_points) = (whole(count)?, keyword == "POINT_DATA");
                Ok(())
            }
            ("SCALARS", [name, kind, n @ ..]) if n.len() < 2 => {
                self.begins("LOOKUP_TABLE").then(|| self.line())?;
                self.array(name, kind, [n.first().map_or(Some(1), |n| whole(n))?, tuples], false)
            }
            ("VECTORS" | "NORMALS", [name, kind]) => self.array(name, kind, [3, tuples], false),
            ("TENSORS", [name, kind]) => self.array(name, kind, [9, tuples], false),
            ("TENSORS6", [name, kind]) => self.array(name, kind, [6, tuples], false),
            ("GLOBAL_IDS" | "PEDIGREE_IDS", [name, kind]) => self.array(name, kind, [1, tuples], false),
            ("TEXTURE_COORDINATES", [name, n, kind]) => self.array(name, kind, [whole(n)?, tuples], false),
            ("COLOR_SCALARS", [_, n]) => self.numbers("unsigned_char", whole(n)?.checked_mul(tuples)?).map(drop),
            ("LOOKUP_TABLE", [_, n]) => self.numbers("unsigned_char", whole(n)?.checked_mul(4)?).map(drop),
            ("FIELD", [_, arrays]) => (0..whole(arrays)?).try_for_each(|_| {
                let line = self.line().unwrap_or_default();
                let words: Vec<&str> = line.split_ascii_whitespace().collect();
                let sizes = words.get(1..3).and_then(|sizes| Some([whole(sizes[0])?, whole(sizes[1])?]));
                match (&words[..], sizes) {
                    ([name, _, _, kind], Some(sizes)) => self.array(name, kind, sizes, false),
                    _ => Err(format!("line {line:?}; allowed: name, components, tuples and type of an array")),
                }
            }),
            _ => return None,
        })
    }

    fn array(&mut self, name: &str, kind: &str, [components, tuples]: [usize; 2], places: bool) -> Result<(), String> {
        self.components = components;
        let name = name.replace("%20", " ").replace("%25", "%");
        let array = Array { name, of_points: places, components };
        let wrong = |said: String| format!("array {:?}: {said}", array.name);
        if self.of_points && tuples != self.points {
            return Err(wrong(format!("of {tuples} points, where {} are", self.points)));
        }
        let numbers = self.numbers(kind, components.saturating_mul(tuples)).map_err(wrong)?;
        if array.is_read() && (places || self.of_points) {
            self.arrays.push((array, numbers));
        }
        Ok(())
    }

    fn numbers(&mut self, name: &str, count: usize) -> Result<Vec<f64>, String> {
        let kind = kind(name)?;
        let short = || format!("not {count} numbers");
        if self.binary {
            let bytes = self.rest.split_off(..count.saturating_mul(kind.1)).ok_or_else(short)?;
            return Ok(numbers(kind, bytes, true));
        }
        // A blank ends a number, or it may be cut.
        let next = |_| {
            self.rest = self.rest.trim_ascii_start();
            let end = self.rest.iter().position(u8::is_ascii_whitespace).ok_or_else(short)?;
            vtk::number(&String::from_utf8_lossy(self.rest.split_off(..end).unwrap_or_default()))
        };
        (0..count).map(next).collect()
    }
}

#[cfg(test)]
mod tests;
