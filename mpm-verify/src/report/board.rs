//! The board as a table a case, a summary, JSON, and the picture of error over cost.

use super::document::{Document, Shown, terminal::cut};
use super::prelude::*;
use super::rows::{self, RESULTS};
use crate::draw::{ReferenceLine, Scale, draw_charts};
use crate::score::board::{Line, Method, OWN, Standing, read};

/// Longest name of a code beside a score.
const LONGEST_BRIEF: usize = 36;
/// Colours of other codes, and their markers once the colours are used up.
const COLOURS: [usize; 5] = [0, 2, 4, 5, 7];
const MARKERS: [Marker; 3] = [Marker::Square, Marker::Triangle, Marker::Diamond];
/// Schemes of ours beside the others: standard MPM, the published F̄, and what we recommend.
const OURS: [RemedyName; 3] = [RemedyName::None, RemedyName::FbarRecursive, RemedyName::FbarConsistent];

/// The runs that are kept: in the working directory, or else in the checkout that the program was built from; none in
/// neither.
pub(super) fn kept() -> Result<Vec<Record>, Error> {
    let built = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(RESULTS);
    let file = [PathBuf::from(RESULTS), built].into_iter().find(|file| file.exists());
    file.map_or(Ok(Vec::new()), |file| Ok(rows::read(&file)?.iter().filter_map(rows::Row::record).collect()))
}

/// Our methods on a case by kept runs, those that stand for its own or any, as far as `which` takes them.
pub(super) fn ours(
    case: &Case,
    kept: &[Record],
    own: bool,
    which: impl Fn(&Record) -> bool,
) -> Result<Vec<Method>, Error> {
    let records: Vec<Record> = kept.iter().filter(|r| r.case == case.name).cloned().collect();
    let of_case = if own { (case.own_runs)(&records) } else { records.iter().collect() };
    let told: Vec<&Record> = of_case.into_iter().filter(|r| which(r)).collect();
    let of = |scheme| {
        let runs: Vec<&Record> = told.iter().copied().filter(|r| r.scheme() == scheme).collect();
        Method::of_ours(case.name, &runs)
    };
    distinct(told.iter().map(|r| r.scheme())).into_iter().map(of).collect()
}

/// The methods in some folders, and ours on the same cases, from the rows that are kept.
///
/// # Errors
/// As [`read`]; the file of rows is damaged.
pub fn gather(folders: &[PathBuf]) -> Result<Vec<Method>, Error> {
    among(folders, &kept()?)
}

/// The same with these kept runs.
pub(super) fn among(folders: &[PathBuf], kept: &[Record]) -> Result<Vec<Method>, Error> {
    let mut all = read(folders)?;
    let is_told = |r: &Record| {
        let usual = [BasisName::Gimp, BasisName::Bspline2].contains(&r.basis()) && OURS.contains(&r.remedy());
        usual && [TransferName::Flip, TransferName::None].contains(&r.transfer())
    };
    for case in distinct(all.iter().map(|m| m.case)) {
        all.extend(ours(cases::find(case)?, kept, true, is_told)?);
    }
    all.sort_by_key(|m| (m.case, m.standing, m.code.clone(), m.words.clone()));
    Ok(all)
}

/// A row a run of the methods of a case: in full, or what tells runs of one level apart.
pub(super) fn lines(methods: &[Method], full: bool) -> Sheet {
    let runs = || methods.iter().flat_map(|m| m.runs.iter().map(move |line| (m, line)));
    let told = distinct(runs().flat_map(|(_, line)| &line.told).map(|(title, _)| &**title));
    let cells = |(m, line): (&Method, &Line)| {
        let of = |name: &str| line.told.iter().find(|told| told.0 == name).map_or(String::new(), |told| told.1.clone());
        let standing = if line.standing == Standing::Right { "right" } else { line.standing.name() };
        let why = if line.why.is_empty() || !full { String::new() } else { format!(": {}", line.why) };
        let level = [std::slice::from_ref(&line.level), &line.set[..]].concat().join(" ");
        let worst = line.worst.as_ref().map_or(String::new(), |(used, _)| fixed(2).text(*used));
        let ns = line.ns.map_or(String::new(), |ns| fixed(0).text(ns));
        let words = if full || m.code == OWN { &m.words } else { "" };
        let code = if full { m.code.clone() } else { cut(&m.code, LONGEST_BRIEF) };
        let before = [(true, "code", inert(&code)), (true, "scheme", inert(words)), (full, "level", inert(&level))];
        let errors = told.iter().map(|title| (true, *title, of(title)));
        let cost = [(true, "CPU (s)", seconds(line.cpu_s)), (full, "ns", ns)];
        let behind = [(true, "verdict", inert(&format!("{standing}{why}")))];
        let all = before.into_iter().chain(errors).chain([(true, "error/tolerance", worst)]).chain(cost).chain(behind);
        all.filter(|(shown, ..)| *shown).map(|(_, title, text)| (title.to_owned(), text)).unzip()
    };
    let rows: Vec<(Vec<String>, Vec<String>)> = runs().map(cells).collect();
    let head = rows.first().map_or(Vec::new(), |(head, _)| head.clone());
    Sheet::new(head).with(rows.into_iter().map(|(_, row)| row))
}

/// A text of the user's as it is in Markdown: no link, picture or mark comes of it.
pub(super) fn inert(text: &str) -> String {
    text.chars().flat_map(|c| if "\\`*[]!".contains(c) { vec!['\\', c] } else { vec![c] }).collect()
}

fn seconds(cpu_s: Option<f64>) -> String {
    cpu_s.map_or(String::new(), |s| SHORT.text(s))
}

/// How every method stands, cases side by side.
fn summary(methods: &[Method]) -> Sheet {
    let row = |m: &Method| {
        let dearest = m.runs.iter().filter_map(|line| line.cpu_s).max_by(f64::total_cmp);
        let orders = m.orders.iter().map(|(metric, order)| format!("{metric} {}", fixed(1).text(*order)));
        vec![
            m.case.to_owned(),
            inert(format!("{} {}", m.code, m.version).trim_end()),
            inert(&m.words),
            m.standing.name().to_owned(),
            m.runs.iter().map(|line| &*line.level).collect::<Vec<_>>().join(", "),
            orders.collect::<Vec<_>>().join(", "),
            seconds(dearest),
            inert(&m.note),
        ]
    };
    Sheet::new(["case", "code", "scheme", "stands", "levels", "orders", "dearest, CPU (s)", "set-up"])
        .with(methods.iter().map(row))
}

/// The summary, and the runs of every case, as tables by name.
pub(super) fn tables(methods: &[Method]) -> Vec<(String, Sheet)> {
    let mut all = vec![("board".to_owned(), summary(methods))];
    for case in distinct(methods.iter().map(|m| m.case)) {
        let own: Vec<Method> = methods.iter().filter(|m| m.case == case).cloned().collect();
        all.push((format!("board-{case}"), lines(&own, true)));
    }
    all
}

/// As Markdown.
#[must_use]
pub fn markdown(methods: &[Method]) -> String {
    tables(methods).into_iter().map(|(name, table)| format!("## {name}\n\n{}\n", table.markdown())).collect()
}

/// Writes `board.html`, `board.json` and `board.png`.
///
/// # Errors
/// A file can't be written or drawn.
pub fn write(methods: &[Method], folder: &Path) -> Result<(), Error> {
    make_folder(folder)?;
    write_json(&folder.join("board.json"), &json!({"schema": 1, "methods": methods}))?;
    let others = distinct(methods.iter().filter(|m| m.code != OWN).map(|m| &*m.code));
    let chart = |case: &str| {
        let mut chart = Chart::new(case, ["processor time (s)", "error over tolerance (–)"], Vec::new());
        (chart.x_scale, chart.y_scale) = (Scale::Log10, Scale::Log10);
        chart.reference_lines.push(ReferenceLine { name: "tolerance".to_owned(), value: 1.0, band: None });
        let mut show = |name: &str, (colour, marker), is_shown: &dyn Fn(&Method) -> bool| {
            let own = methods.iter().filter(|m| m.case == case && is_shown(m)).flat_map(|m| &m.runs);
            let points = own.filter_map(|line| Some((line.cpu_s?, line.worst.as_ref()?.0))).collect();
            chart.series.push(Series { name: name.to_owned(), points, colour, marker, dash: Dash::None });
        };
        for (colour, remedy) in [6, 1, 3].into_iter().zip(OURS) {
            let is_of = |m: &Method| m.code == OWN && m.words.split(' ').any(|word| word == remedy.text());
            let name = if remedy == RemedyName::None { "standard" } else { remedy.text() };
            show(&format!("{OWN}, {name}"), (colour, Marker::Circle), &is_of);
        }
        for (k, code) in others.iter().enumerate() {
            show(code, (COLOURS[k % COLOURS.len()], MARKERS[k / COLOURS.len() % MARKERS.len()]), &|m| m.code == *code);
        }
        chart
    };
    let mut charts: Vec<Chart> = distinct(methods.iter().map(|m| m.case)).into_iter().map(chart).collect();
    charts.retain(|chart| chart.series.iter().any(|curve| !curve.points.is_empty()));
    let mut page = Document::new("MPM codes side by side");
    if !charts.is_empty() {
        let [file, caption] = ["board.png", "Error over its tolerance, over processor time."].map(str::to_owned);
        draw_charts(&folder.join(&file), &charts, 3)?;
        page.picture(Shown::of(&Picture { file, caption }, folder));
    }
    for (name, sheet) in tables(methods) {
        page.section(&name, &*name);
        page.table("", sheet);
    }
    page.write_page("MPM codes side by side", Vec::new(), &folder.join("board.html"))
}
