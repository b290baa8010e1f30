//! The difference of two report folders.

use super::convergence::CPU_PICTURE;
use super::prelude::*;
use crate::draw::triptych::different_pixels;
use crate::files;

/// An entry of two tables that is not the same.
#[derive(Serialize)]
struct Change<T> {
    what: String,
    old: T,
    new: T,
}

/// Differences between two report folders.
pub struct Difference {
    names: [String; 2],
    /// Values, by run and metric.
    numbers: Vec<Change<Option<f64>>>,
    /// Outcomes, by run, check and metric.
    verdicts: Vec<Change<&'static str>>,
    /// Pictures, by file.
    pictures: Vec<Change<Option<RgbImage>>>,
}

impl Difference {
    /// Compares the summaries and pictures of two report folders. Times taken are not compared.
    ///
    /// # Errors
    /// A summary is missing, damaged or of another schema, or a picture can't be read.
    pub fn between(old: &Path, new: &Path) -> Result<Self, Error> {
        let summary =
            |folder: &Path| -> Result<Summary, Error> { read_versioned(&folder.join("summary.json"), SCHEMA) };
        let (a, b) = (summary(old)?, summary(new)?);
        let mut pictures = Vec::new();
        let mut files = BTreeSet::new();
        for folder in [old, new] {
            list_pictures(folder, folder, &mut files)?;
        }
        for file in files {
            let [old, new] = [old, new].map(|folder| read_picture(&folder.join(&file)));
            let change = Change { what: file.display().to_string(), old: old?, new: new? };
            if change.old != change.new {
                pictures.push(change);
            }
        }
        Ok(Self {
            names: [old, new].map(|folder| folder.display().to_string()),
            numbers: changes(numbers(&a), numbers(&b), None),
            verdicts: changes(outcomes(&a), outcomes(&b), "absent"),
            pictures,
        })
    }

    /// [`ExitCode::Drift`] if anything differs.
    #[must_use]
    pub fn exit_code(&self) -> ExitCode {
        match self.numbers.len() + self.verdicts.len() + self.pictures.len() {
            0 => ExitCode::Good,
            _ => ExitCode::Drift,
        }
    }

    /// How much differs.
    #[must_use]
    pub fn counts(&self) -> String {
        let [numbers, verdicts, pictures] = [self.numbers.len(), self.verdicts.len(), self.pictures.len()];
        format!("{numbers} numbers, {verdicts} verdicts and {pictures} pictures differ.")
    }

    /// The difference as JSON; of pictures the names of the files.
    #[must_use]
    pub fn json(&self) -> Value {
        json!({
            "old": self.names[0],
            "new": self.names[1],
            "numbers": self.numbers,
            "verdicts": self.verdicts,
            "pictures": self.pictures.iter().map(|p| json!(p.what)).collect::<Value>(),
        })
    }

    /// The difference in Markdown.
    #[must_use]
    pub fn text(&self) -> String {
        let [old, new] = &self.names;
        let mut t = format!("# {old} against {new}\n\n{}\n", self.counts());
        let verdicts = self.verdicts.iter().map(|c| [&*c.what, c.old, c.new].map(str::to_owned).into());
        let numbers = self.numbers.iter().map(|c| {
            let numbers = [c.old, c.new, c.old.zip(c.new).map(|(a, b)| b - a)].map(number);
            [std::slice::from_ref(&c.what), &numbers].concat()
        });
        for sheet in [
            Sheet::new(["verdict", "old", "new"]).with(verdicts),
            Sheet::new(["number", "old", "new", "difference"]).with(numbers),
        ] {
            if !sheet.rows.is_empty() {
                let _ = write!(t, "\n{}", sheet.markdown());
            }
        }
        for change in &self.pictures {
            let file = &change.what;
            let _ = match (&change.old, &change.new) {
                (Some(a), Some(b)) => writeln!(
                    t,
                    "\n![{file}: old, new, difference]({file})\n\n{file}: {} pixels differ",
                    different_pixels(a, b)
                ),
                (Some(_), None) => writeln!(t, "\n{file}: only in {old}"),
                _ => writeln!(t, "\n{file}: only in {new}"),
            };
        }
        t
    }

    /// Writes `diff.md` and, for each picture that differs, old | new | difference.
    ///
    /// # Errors
    /// A file can't be written.
    pub fn write(&self, out: &Path) -> Result<(), Error> {
        make_folder(out)?;
        for change in &self.pictures {
            if let (Some(old), Some(new)) = (&change.old, &change.new) {
                write_small_png(&out.join(&change.what), &triptych(old, new))?;
            }
        }
        write_whole(&out.join("diff.md"), self.text().as_bytes())
    }
}

/// Entries of two tables that are not the same; `absent` stands for one that is not there.
fn changes<T: Copy + PartialEq>(old: BTreeMap<String, T>, new: BTreeMap<String, T>, absent: T) -> Vec<Change<T>> {
    let names: BTreeSet<&String> = old.keys().chain(new.keys()).collect();
    let value = |table: &BTreeMap<String, T>, name: &String| *table.get(name).unwrap_or(&absent);
    let change = |what: &String| Change { what: what.clone(), old: value(&old, what), new: value(&new, what) };
    names.into_iter().map(change).filter(|c| c.old != c.new).collect()
}

fn numbers(summary: &Summary) -> BTreeMap<String, Option<f64>> {
    let mut numbers = BTreeMap::new();
    for record in summary.records() {
        let run = format!("{} {}", record.case, record.folder());
        for (name, m) in &record.metrics {
            numbers.insert(format!("{run} {name} ({})", m.unit), m.value);
        }
        for (name, count) in record.work.counts() {
            numbers.insert(format!("{run} {name}"), Some(count as f64));
        }
    }
    for study in &summary.cases {
        for entry in &study.convergence {
            if let Some(order) = &entry.order {
                let run = [&[entry.scheme.to_string()], &entry.set[..]].concat();
                let run = run.join(" ");
                numbers.insert(format!("{} {run} order of {}", study.case, entry.metric), Some(order.order));
            }
        }
    }
    numbers
}

fn outcomes(summary: &Summary) -> BTreeMap<String, &'static str> {
    let entry = |(study, record, v): (&CaseStudy, Option<&Record>, &Verdict)| {
        let run = record.map_or_else(String::new, Record::folder);
        (format!("{} {run} {}: {}", study.case, v.check, v.metric), outcome(v.outcome))
    };
    summary.verdicts().map(entry).collect()
}

/// Collects the PNG files below `folder`, as paths relative to `root`, without those of times taken, which no two runs share; links
/// to folders are not followed.
fn list_pictures(root: &Path, folder: &Path, found: &mut BTreeSet<PathBuf>) -> Result<(), Error> {
    let pictures = files::files_in(folder, &["png"])?;
    let shown = pictures.iter().filter(|path| !path.ends_with(CPU_PICTURE));
    found.extend(shown.filter_map(|path| path.strip_prefix(root).map(Path::to_path_buf).ok()));
    files::folders_in(folder)?.iter().try_for_each(|inner| list_pictures(root, inner, found))
}

fn read_picture(path: &Path) -> Result<Option<RgbImage>, Error> {
    path.exists().then(|| files::read_picture(path)).transpose()
}
