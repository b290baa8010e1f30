//! Documents on the terminal: lines fit 100 columns; colours are for whoever prints to keep or to drop.

use super::{Block, Document, Text};
use crate::table::Sheet;
use crate::verdict::Outcome;
use anstyle::{AnsiColor, Style};

/// Columns of a line.
pub(in crate::report) const WIDTH: usize = 100;
/// Narrowest column of a table, whose titles take several lines.
const NARROW: usize = 9;
/// Blanks before a column.
const GAP: usize = 2;

/// A text in the colour of an outcome.
pub(in crate::report) fn painted(of: Outcome, text: &str) -> String {
    let style = match of {
        Outcome::Right => AnsiColor::Green.on_default(),
        Outcome::WrongAsKnown => AnsiColor::Yellow.on_default(),
        Outcome::NotJudged => Style::new().dimmed(),
        Outcome::Failed => AnsiColor::Red.on_default().bold(),
    };
    format!("{style}{text}{style:#}")
}

/// A text in lines that begin with `indent`.
pub(in crate::report) fn wrapped(text: &str, first: &str, indent: &str) -> String {
    textwrap::fill(text, textwrap::Options::new(WIDTH).initial_indent(first).subsequent_indent(indent)) + "\n"
}

/// The start of a text that fits this number of columns.
pub(in crate::report) fn cut(text: &str, columns: usize) -> String {
    match text.chars().count() > columns {
        true => text.chars().take(columns - 1).collect::<String>() + "…",
        false => text.to_owned(),
    }
}

impl Document {
    /// On the terminal: titles, paragraphs and lists.
    pub(in crate::report) fn terminal(&self) -> String {
        self.blocks.iter().map(Block::terminal).collect()
    }
}

impl Block {
    fn terminal(&self) -> String {
        let item = |text: &Text| {
            let words = text.words();
            let mut lines = words.lines();
            let first = lines.next().map(|line| wrapped(line, "  ", "      "));
            first.into_iter().chain(lines.map(|line| wrapped(line, "      ", "      "))).collect::<String>()
        };
        match self {
            Self::Heading { level: 1, text, .. } => wrapped(&text.words(), "", "  "),
            Self::Heading { text, .. } => format!("\n{}\n", text.words()),
            Self::Paragraph { text, .. } => "\n".to_owned() + &wrapped(&text.words(), "", ""),
            Self::List { items } => items.iter().map(item).collect(),
            _ => String::new(),
        }
    }
}

/// Widths of the columns of a table, whose titles are broken.
fn widths(sheet: &Sheet) -> Vec<usize> {
    let width = |k: usize| sheet.rows.iter().map(|row| row[k].chars().count()).max().unwrap_or(0).max(NARROW);
    (0..sheet.head.len()).map(width).collect()
}

/// As many columns as fit the terminal: of those between the first and the last two, the first ones.
fn fitting(mut sheet: Sheet) -> Sheet {
    let whole = |sheet: &Sheet| widths(sheet).iter().map(|width| width + GAP).sum::<usize>();
    while whole(&sheet) > WIDTH && sheet.head.len() > 4 {
        let last = sheet.head.len() - 3;
        sheet.head.remove(last);
        for row in &mut sheet.rows {
            row.remove(last);
        }
    }
    sheet
}

/// A table in columns of blanks, as many as fit.
pub(in crate::report) fn aligned(sheet: Sheet) -> String {
    let sheet = fitting(sheet);
    let widths = widths(&sheet);
    let titles = sheet.head.iter().zip(&widths);
    let titles: Vec<Vec<String>> =
        titles.map(|(title, width)| textwrap::wrap(title, *width).iter().map(ToString::to_string).collect()).collect();
    let height = titles.iter().map(Vec::len).max().unwrap_or(0);
    let line = |cells: Vec<&str>| {
        let cells = cells.iter().zip(&widths).enumerate().map(|(k, (cell, width))| match k {
            0 => format!("{:GAP$}{cell:<width$}", ""),
            _ => format!("{:GAP$}{cell:>width$}", ""),
        });
        cells.collect::<String>().trim_end().to_owned() + "\n"
    };
    let head = (0..height).map(|k| {
        let cell = |title: &'_ Vec<String>| (k + title.len()).checked_sub(height);
        line(titles.iter().map(|t| cell(t).map_or("", |place| &*t[place])).collect())
    });
    let rows = sheet.rows.iter().map(|row| line(row.iter().map(String::as_str).collect()));
    head.chain(rows).collect()
}
