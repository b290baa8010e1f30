//! Tables in text as other programs write them: cells between commas, semicolons, tabs or blanks, with blanks and quotes
//! about them and exponents of Fortran.

use super::*;
use crate::foreign::MOST_ROWS;
use csv::{ReaderBuilder, StringRecord, Trim};
use std::collections::HashSet;

/// Most columns of a table.
const MOST_COLUMNS: usize = 1000;
/// Most characters of a cell that a message shows.
const SHOWN: usize = 40;
/// Separators beside runs of blanks.
const SEPARATORS: [(u8, &str); 3] = [(b',', "commas"), (b';', "semicolons"), (b'\t', "tabs")];

/// Reads a table, and the line of each row.
pub(super) fn read(path: &Path) -> Result<(Table, Vec<u64>), Error> {
    table(&read_file(path, TABLE)?).map_err(|said| Error::file(path, said))
}

/// Byte and name of the separator that is most frequent in the head.
fn separator(bytes: &[u8]) -> (u8, &'static str) {
    let mut lines = bytes.split(|b| *b == b'\n').filter(|line| !line.trim_ascii().is_empty());
    let head = lines.next().unwrap_or_default();
    let count = |separator: u8| head.iter().filter(|b| **b == separator).count();
    let all = SEPARATORS.into_iter().rev().filter(|(s, _)| count(*s) > 0);
    all.max_by_key(|(s, _)| count(*s)).unwrap_or((b' ', "blanks"))
}

/// Cells of a record without what is about them; between blanks the empty ones are none.
fn cells(record: &StringRecord, blanks: bool) -> impl Iterator<Item = &str> {
    let bare = |cell: &'_ str| cell.len() > 1 && cell.starts_with('"') && cell.ends_with('"');
    let cells = record.iter().map(move |cell| if bare(cell) { cell[1..cell.len() - 1].trim() } else { cell });
    cells.filter(move |cell| !blanks || !cell.is_empty())
}

/// Heads between blanks: a unit belongs to the name before it, a mark to the name behind it.
fn joined<'a>(parts: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut heads: Vec<String> = Vec::new();
    for part in parts {
        match heads.last_mut() {
            Some(last) if part.starts_with(['(', '[']) || last == "#" => {
                last.push(' ');
                last.push_str(part);
            }
            _ => heads.push(part.to_owned()),
        }
    }
    heads
}

/// A number, whose exponent may be Fortran's.
fn number(cell: &str) -> Option<f64> {
    cell.parse().ok().or_else(|| cell.replace(['D', 'd'], "e").parse().ok())
}

fn table(bytes: &[u8]) -> Result<(Table, Vec<u64>), String> {
    let (separator, named) = separator(bytes);
    let blanks = separator == b' ';
    let mut reader =
        ReaderBuilder::new().delimiter(separator).trim(Trim::All).flexible(true).has_headers(false).from_reader(bytes);
    let mut record = StringRecord::new();
    let mut next = |record: &mut StringRecord| reader.read_record(record).map_err(|e| e.to_string());
    next(&mut record)?;
    let heads: Vec<String> = match blanks {
        true => joined(cells(&record, true)),
        false => cells(&record, false).map(str::to_owned).collect(),
    };
    if !(1..=MOST_COLUMNS).contains(&heads.len()) {
        return Err(format!("line 1: {} columns where 1 to {MOST_COLUMNS} are allowed", heads.len()));
    }
    let mut known = HashSet::new();
    if let Some(twice) = heads.iter().find(|head| !known.insert(head.as_str())) {
        return Err(format!("line 1: column {twice:?} is there twice"));
    }
    let (mut columns, mut lines) = (vec![Vec::new(); heads.len()], Vec::new());
    while next(&mut record)? {
        let line = line_of(&record, bytes);
        let count = cells(&record, blanks).count();
        if count != heads.len() {
            let widths = format!("{count} cells between {named} where the head has {}", heads.len());
            return Err(format!("line {line}: {widths}"));
        }
        if lines.len() == MOST_ROWS {
            return Err(format!("more rows than the {MOST_ROWS} that are allowed"));
        }
        for ((column, head), cell) in columns.iter_mut().zip(&heads).zip(cells(&record, blanks)) {
            column.push(number(cell).filter(|value| value.is_finite()).ok_or_else(|| unread(line, head, cell))?);
        }
        lines.push(line);
    }
    Ok((Table::of_columns(heads.into_iter().zip(columns)), lines))
}

/// Line of a record: the reader has the place before the empty lines in front of it.
fn line_of(record: &StringRecord, bytes: &[u8]) -> u64 {
    let Some(place) = record.position() else { return 0 };
    let rest = bytes.get(place.byte() as usize..).unwrap_or_default();
    let empty = rest.iter().take_while(|b| b"\r\n".contains(b)).filter(|b| **b == b'\n');
    place.line() + empty.count() as u64
}

/// The message for a cell that is no finite number.
fn unread(line: u64, head: &str, cell: &str) -> String {
    let shown: String = cell.chars().take(SHOWN).collect();
    let comma = if cell.replacen(',', ".", 1).parse::<f64>().is_ok() { " with a decimal point" } else { "" };
    format!("line {line}, column {head:?}: {shown:?}; allowed: finite numbers{comma}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(text: &str) -> Vec<(String, Vec<f64>)> {
        let (table, _) = table(text.as_bytes()).unwrap_or_else(|said| panic!("{text:?}: {said}"));
        table.iter().map(|(head, values)| (head.to_owned(), values.to_vec())).collect()
    }

    #[test]
    fn tables_of_other_programs_are_read() {
        for text in [
            "ux (m),t (s)\n0.5,1500\n-2,0.25\n",
            "ux (m), t (s)\n0.5, 1500\n-2, 0.25\n",
            "ux (m);t (s)\n0.5;1500\n-2;0.25\n",
            "ux (m)\tt (s)\r\n0.5\t1500\r\n-2\t0.25\r\n",
            "ux (m) t (s)\n0.5 1500\n-2 0.25\n",
            "  ux (m)    t (s)\n  5.0D-01  1.5E+03\n -2.0d+00  2.5D-01\n",
            "\"ux (m)\",\"t (s)\"\n\"0.5\",\"1500\"\n\"-2\",\"0.25\"\n",
            "\"ux (m)\", \"t (s)\"\n0.5, 1500\n\"-2\", \"0.25\"\n",
            "\"ux (m)\" \"t (s)\"\n0.5 1500\n-2 0.25\n",
            "\u{feff}ux (m),t (s)\n0.5,1500\n\n-2,0.25",
            " ux (m) ,t (s)\n  5.0000000E-01,  1.5000000E+03\n -2.,  .25\n",
        ] {
            let expected = [("ux (m)".to_owned(), vec![0.5, -2.0]), ("t (s)".to_owned(), vec![1500.0, 0.25])];
            assert_eq!(columns(text), expected, "{text:?}");
        }
        assert_eq!(columns("t (s)\n1\n2\n"), [("t (s)".to_owned(), vec![1.0, 2.0])]);
        // A mark before a name stays, for which the head is refused.
        assert_eq!(columns("# ux (m) t (s)\n1 2\n")[0].0, "# ux (m)");
    }

    #[test]
    fn what_is_not_read_is_named_by_line_column_and_cell() {
        let many = (0..=MOST_COLUMNS).map(|k| k.to_string()).collect::<Vec<_>>().join(",");
        for (text, named) in [
            ("a;b\n0,5;1\n", "line 2, column \"a\": \"0,5\"; allowed: finite numbers with a decimal point"),
            ("a,b\n1,2\n1,x\n", "line 3, column \"b\": \"x\"; allowed: finite numbers"),
            ("a,b\n\n\n1,NaN\n", "line 4, column \"b\": \"NaN\"; allowed: finite numbers"),
            ("a,b\n1,-inf\n", "line 2, column \"b\": \"-inf\""),
            ("a,b\n1,\n", "line 2, column \"b\": \"\""),
            ("a,b\n1,****\n", "line 2, column \"b\": \"****\""),
            ("a,b\n1,1.5-103\n", "line 2, column \"b\": \"1.5-103\""),
            ("a,b\n1,2\n1\n", "line 3: 1 cells between commas where the head has 2"),
            ("a,b\n1 2\n", "line 2: 1 cells between commas where the head has 2"),
            ("a b\n1,2\n", "line 2: 1 cells between blanks where the head has 2"),
            ("a,b,a\n1,2,3\n", "line 1: column \"a\" is there twice"),
            ("", "line 1: 0 columns where 1 to 1000 are allowed"),
            (&many, "line 1: 1001 columns where 1 to 1000 are allowed"),
        ] {
            let said = table(text.as_bytes()).unwrap_err();
            assert!(said.starts_with(named), "{text:?}: {said}");
        }
        assert!(table(b"a,\xff\n1,2\n").unwrap_err().to_lowercase().contains("utf-8"));
        let (_, lines) = table(b"a\n\n1\n\n\n2\n3").unwrap();
        assert_eq!(lines, [3, 6, 7]);
    }
}
