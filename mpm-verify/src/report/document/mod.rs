//! A document as a tree of sections, paragraphs, tables and figures, which is written in Markdown, in HTML and on the terminal.

mod markdown;
mod page;
pub(super) mod terminal;

use crate::report::prelude::*;

/// A part of a text: its kind, words, and target of a link or class of a mark.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Span {
    kind: &'static str,
    text: String,
    to: String,
}

/// Words on one line.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct Text(Vec<Span>);

impl<T: Into<String>> From<T> for Text {
    fn from(text: T) -> Self {
        Self::default().span("plain", text, "")
    }
}

impl Text {
    fn span(mut self, kind: &'static str, text: impl Into<String>, to: impl Into<String>) -> Self {
        let (text, to) = (text.into(), to.into());
        if !text.is_empty() {
            self.0.push(Span { kind, text, to });
        }
        self
    }

    /// Words with `code`, **strong** ones and links in them.
    pub(super) fn marked(words: &str) -> Self {
        let marks = [("`", "`", "code"), ("**", "**", "strong"), ("[", ")", "link")];
        let (mut text, mut rest) = (Self::default(), words);
        loop {
            let found = marks.iter().filter_map(|mark| Some((rest.find(mark.0)?, mark)));
            let parts = found.min_by_key(|(place, _)| *place).and_then(|(place, (open, close, kind))| {
                let (inner, after) = rest[place + open.len()..].split_once(close)?;
                Some((&rest[..place], inner, *kind, after))
            });
            let Some((before, inner, kind, after)) = parts else { return text.span("plain", rest, "") };
            let (inner, to) = inner.split_once("](").unwrap_or((inner, ""));
            text = text.span("plain", before, "").span(kind, inner, to);
            rest = after;
        }
    }

    pub(super) fn code(text: impl Into<String>) -> Self {
        Self::default().span("code", text, "")
    }

    pub(super) fn link(text: impl Into<String>, to: impl Into<String>) -> Self {
        Self::default().span("link", text, to)
    }

    /// A mark with a class that gives its colour.
    pub(super) fn mark(text: impl Into<String>, class: &str) -> Self {
        Self::default().span("mark", text, class)
    }

    /// A small picture.
    pub(super) fn thumb(caption: impl Into<String>, file: impl Into<String>) -> Self {
        Self::default().span("image", caption, file)
    }

    fn words(&self) -> String {
        self.0.iter().map(|span| &*span.text).collect()
    }

    /// An outcome in words, with a symbol.
    pub(super) fn badge(outcome: Outcome) -> Self {
        let [symbol, words, class] = words::shown(outcome);
        Self::mark(format!("{symbol} {words}"), class)
    }

    /// Appends a text.
    pub(super) fn then(mut self, next: impl Into<Self>) -> Self {
        self.0.extend(next.into().0);
        self
    }

    /// Appends a text in a new line.
    pub(super) fn then_below(self, next: impl Into<Self>) -> Self {
        self.span("break", "\n", "").then(next)
    }

    /// Several with something between them.
    pub(super) fn joined(texts: impl IntoIterator<Item = Self>, between: &str) -> Self {
        texts.into_iter().reduce(|all, next| all.then(between).then(next)).unwrap_or_default()
    }
}

/// Texts of pages, by section; paragraphs are apart by an empty line.
const PROSE: &str = include_str!("../../../assets/prose.md");

/// The paragraphs of a section of the pages' texts, each on one line.
pub(super) fn prose(section: &str) -> impl Iterator<Item = Text> {
    let sections = PROSE.split("## ").filter_map(|part| part.split_once('\n'));
    let own = sections.filter(move |(name, _)| *name == section);
    let paragraphs = own.flat_map(|(_, text)| text.trim_end().split("\n\n"));
    paragraphs.map(|paragraph| Text::marked(&paragraph.replace('\n', " ")))
}

#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct Cell {
    text: Text,
    class: String,
    /// Text shown by a page when the pointer is on the cell.
    title: String,
    /// Text behind the cell in Markdown, which has no pointer.
    aside: String,
    is_head: bool,
}

impl<T: Into<Text>> From<T> for Cell {
    fn from(text: T) -> Self {
        Self { text: text.into(), ..Self::default() }
    }
}

impl Cell {
    pub(super) fn of(text: impl Into<Text>, class: &str) -> Self {
        Self { class: class.to_owned(), ..Self::from(text) }
    }

    pub(super) fn head(text: impl Into<Text>) -> Self {
        Self { is_head: true, ..Self::from(text) }
    }

    pub(super) fn titled(self, title: impl Into<String>) -> Self {
        Self { title: title.into(), ..self }
    }

    pub(super) fn aside(self, aside: impl Into<String>) -> Self {
        Self { aside: aside.into(), ..self }
    }
}

/// A row of a table; links lead to its id.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct Row {
    pub(super) id: String,
    pub(super) cells: Vec<Cell>,
}

impl<T: IntoIterator<Item = Cell>> From<T> for Row {
    fn from(cells: T) -> Self {
        let (id, cells) = (String::new(), cells.into_iter().collect());
        Self { id, cells }
    }
}

#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct Table {
    pub(super) class: &'static str,
    pub(super) head: Vec<Cell>,
    pub(super) rows: Vec<Row>,
}

impl From<Sheet> for Table {
    fn from(sheet: Sheet) -> Self {
        // Numbers stand to the right.
        let is_number = |text: &str| text.starts_with(|c| "0123456789-−–≤≥~".contains(c)) || text == "never";
        let row = |row: &Vec<String>| {
            let rest = row.iter().skip(1).map(|text| Cell::of(&**text, if is_number(text) { "num" } else { "" }));
            row.first().map(|cell| Cell::head(cell.as_str())).into_iter().chain(rest).into()
        };
        let head = sheet.head.iter().map(|title| title.as_str().into());
        Self { class: "", head: head.collect(), rows: sheet.rows.iter().map(row).collect() }
    }
}

/// A picture with its caption and, if they are there, its SVG and the still of an animation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Shown {
    pub(super) file: String,
    pub(super) caption: String,
    pub(super) svg: String,
    pub(super) still: String,
}

impl Shown {
    /// Figure of a report in `out`.
    pub(super) fn of(picture: &Picture, out: &Path) -> Self {
        let Picture { file, caption } = picture.clone();
        let stem = file.rsplit_once('.').map_or(&*file, |(stem, _)| stem);
        let [svg, still] = ["svg", "still.png"].map(|ending| {
            let beside = format!("{stem}.{ending}");
            if out.join(&beside).exists() { beside } else { String::new() }
        });
        Self { file, caption, svg, still }
    }
}

#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "is", rename_all = "kebab-case")]
enum Block {
    Heading {
        level: usize,
        id: String,
        text: Text,
    },
    Paragraph {
        class: &'static str,
        text: Text,
    },
    Table {
        caption: String,
        table: Table,
    },
    Picture {
        picture: Shown,
    },
    /// A drawing as SVG.
    Drawing {
        svg: String,
        caption: String,
    },
    List {
        items: Vec<Text>,
    },
    Facts {
        facts: Vec<[String; 2]>,
    },
    /// Part that a page shows when its summary is clicked on.
    Folded {
        id: String,
        open: bool,
        summary: String,
        blocks: Vec<Block>,
    },
}

#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct Document {
    blocks: Vec<Block>,
}

impl Document {
    /// Without anything below its title.
    pub(super) fn new(title: impl Into<Text>) -> Self {
        let mut document = Self::default();
        document.heading(1, "", title);
        document
    }

    pub(super) fn heading(&mut self, level: usize, id: &str, text: impl Into<Text>) {
        let (id, text) = (id.to_owned(), text.into());
        self.blocks.push(Block::Heading { level, id, text });
    }

    pub(super) fn section(&mut self, id: &str, title: impl Into<Text>) {
        self.heading(2, id, title);
    }

    pub(super) fn paragraph(&mut self, text: impl Into<Text>) {
        self.classed("", text);
    }

    /// Adds a paragraph in small print.
    pub(super) fn note(&mut self, text: impl Into<Text>) {
        self.classed("note", text);
    }

    pub(super) fn classed(&mut self, class: &'static str, text: impl Into<Text>) {
        self.blocks.push(Block::Paragraph { class, text: text.into() });
    }

    pub(super) fn table(&mut self, caption: impl Into<String>, table: impl Into<Table>) {
        let (caption, table) = (caption.into(), table.into());
        self.blocks.push(Block::Table { caption, table });
    }

    pub(super) fn picture(&mut self, picture: Shown) {
        self.blocks.push(Block::Picture { picture });
    }

    pub(super) fn drawing(&mut self, svg: String, caption: &str) {
        self.blocks.push(Block::Drawing { svg, caption: caption.to_owned() });
    }

    pub(super) fn list(&mut self, items: impl IntoIterator<Item = impl Into<Text>>) {
        self.blocks.push(Block::List { items: items.into_iter().map(Into::into).collect() });
    }

    pub(super) fn facts(&mut self, facts: impl IntoIterator<Item = (&'static str, String)>) {
        let facts = facts.into_iter().map(|(name, value)| [name.to_owned(), value]).collect();
        self.blocks.push(Block::Facts { facts });
    }

    pub(super) fn folded(&mut self, id: &str, summary: impl Into<String>, fill: impl FnOnce(&mut Self)) {
        let mut inner = Self::default();
        fill(&mut inner);
        let (id, summary) = (id.to_owned(), summary.into());
        self.blocks.push(Block::Folded { id, open: false, summary, blocks: inner.blocks });
    }

    /// Shows what was folded last.
    pub(super) fn unfold(&mut self) {
        if let Some(Block::Folded { open, .. }) = self.blocks.last_mut() {
            *open = true;
        }
    }
}
