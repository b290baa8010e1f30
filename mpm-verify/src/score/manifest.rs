//! The manifest of a result: which code gave it, of which case, and where its tables are.

use crate::error::{Error, is_unfit, nearest};
use crate::files::read_text;
use crate::scheme::BasisName;
use serde::de::{Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::{Value, value::RawValue};
use std::fmt;
use std::path::Path;

/// Name of its file.
pub(super) const FILE: &str = "score.json";
/// The version of the format that this program reads: `docs/reference/score.schema.json`.
pub(super) const SCHEMA: u32 = 1;
/// Most characters of a text.
const LONGEST: usize = 200;
/// Most parameters, and most runs.
const MOST: usize = 100;

/// A line of text of the user's.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub(crate) struct Line(pub(crate) String);

impl TryFrom<String> for Line {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let count = text.chars().count();
        let fits = (1..=LONGEST).contains(&count) && !text.chars().any(is_unfit);
        match fits && !text.trim().is_empty() {
            true => Ok(Self(text)),
            false => Err(format!("a text of {count} characters where a line of 1 to {LONGEST} is allowed")),
        }
    }
}

/// The name of a file beside the manifest, or in a folder beside it.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub(crate) struct FileName(pub String);

impl TryFrom<String> for FileName {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        let plain = |part: &str| Path::new(part).file_name().is_some_and(|n| *n == *part);
        let short = name.chars().count() <= LONGEST && !name.chars().any(|c| is_unfit(c) || c == '\\');
        match short && name.split('/').count() <= 2 && name.split('/').all(plain) {
            true => Ok(Self(name)),
            false => {
                Err(format!("file {name:?} where the name of a file beside {FILE}, or in a folder there, is allowed"))
            }
        }
    }
}

/// A positive, finite number.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(try_from = "f64")]
pub(crate) struct Positive(pub f64);

impl TryFrom<f64> for Positive {
    type Error = String;

    fn try_from(value: f64) -> Result<Self, String> {
        match value.is_finite() && value > 0.0 {
            true => Ok(Self(value)),
            false => Err(format!("{value} where a positive, finite number is allowed")),
        }
    }
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Code {
    pub name: Line,
    /// Its version or commit.
    pub version: Option<Line>,
    /// Where it is found.
    pub url: Option<Line>,
}

/// Cost of a run, as far as it is known.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Cost {
    /// Processor time (s).
    pub cpu_s: Option<Positive>,
    /// Time by the clock (s).
    pub wall_s: Option<Positive>,
    pub steps: Option<u64>,
    pub threads: Option<u32>,
    pub machine: Option<Line>,
}

/// Names and values, in their order. A map of serde's own would hide a name that is there twice.
struct Pairs<V>(Vec<(String, V)>);

impl<'de, V: Deserialize<'de>> Deserialize<'de> for Pairs<V> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Pairs(Vec::new()))
    }
}

impl<'de, V: Deserialize<'de>> Visitor<'de> for Pairs<V> {
    type Value = Self;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("names with values")
    }

    fn visit_map<M: MapAccess<'de>>(mut self, mut map: M) -> Result<Self, M::Error> {
        while let Some((Line(name), value)) = map.next_entry()? {
            if self.0.len() == MOST {
                return Err(M::Error::custom(format!("more names than the {MOST} that are allowed")));
            }
            self.0.push((name, value));
        }
        Ok(self)
    }
}

/// Parameters as `name=value`.
fn assignments<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<String>, D::Error> {
    let assigned = |(name, value): (String, Value)| {
        let text = match value {
            Value::Bool(_) | Value::Number(_) => Ok(value.to_string()),
            Value::String(word) => Line::try_from(word).map(|word| word.0),
            _ => Err("a number, boolean or word is allowed".to_owned()),
        };
        text.map(|text| format!("{name}={text}")).map_err(|e| D::Error::custom(format!("{name}: {e}")))
    };
    Pairs::deserialize(deserializer)?.0.into_iter().map(assigned).collect()
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
pub(crate) enum Ending {
    #[default]
    #[serde(rename = "finished")]
    Finished,
    #[serde(rename = "broke down")]
    BrokeDown,
    #[serde(rename = "not possible")]
    NotPossible,
}

/// Statements of a code on a run.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Manifest {
    /// [`SCHEMA`].
    pub schema: u32,
    pub code: Code,
    /// Its scheme, in its own words.
    pub scheme: Line,
    /// Its functions, where a case asks for them; quadratic splines by default.
    #[serde(default = "bspline2")]
    pub basis: BasisName,
    pub case: Line,
    /// The level: the size of its cells.
    pub level: Line,
    /// Parameters that are not the case's own, as `name=value`; a name that is there twice stays so.
    #[serde(default, deserialize_with = "assignments")]
    pub parameters: Vec<String>,
    /// Tells it from others of the same scheme, basis, level and parameters.
    pub repeat: Option<Line>,
    /// File of the particles at the end.
    pub particles: Option<FileName>,
    /// File of the series.
    pub series: Option<FileName>,
    /// Size of its cells (m).
    pub cell_size_m: Option<Positive>,
    /// How it ended; one that did not finish has no tables.
    #[serde(default)]
    pub status: Ending,
    /// Why it did not finish, and what of the set-up is not the code's own.
    pub said: Option<Line>,
    pub note: Option<Line>,
    /// Time step (s), if it has one.
    pub time_step_s: Option<Positive>,
    /// Cost of the run.
    #[serde(default)]
    pub cost: Cost,
    /// Its number in the list of runs, from one; zero without a list.
    #[serde(default, rename = "runs")]
    pub run: usize,
}

fn bspline2() -> BasisName {
    BasisName::Bspline2
}

impl Manifest {
    /// Reads the manifests of the runs in a folder.
    ///
    /// # Errors
    /// The file is missing, no plain file, too large, no JSON, of another schema, or not of this form.
    pub(crate) fn read(folder: &Path) -> Result<Vec<Self>, Error> {
        #[derive(Deserialize)]
        struct Versioned<'a> {
            schema: u32,
            #[serde(borrow)]
            runs: Option<Vec<Pairs<&'a RawValue>>>,
        }
        let path = folder.join(FILE);
        let text = read_text(&path)?;
        let refused = |run: usize, e: serde_json::Error| {
            let whole = e.to_string();
            let near = nearest(&whole).map_or(String::new(), |name| format!("; is `{name}` meant?"));
            let said = match run {
                0 => &whole,
                // The place is one in its own keys and those above.
                _ => whole.split(" at line ").next().unwrap_or_default(),
            };
            let run = if run > 0 { format!("run {run}: ") } else { String::new() };
            Error::file(&path, run + said + &near)
        };
        let of_file = |e| refused(0, e);
        let Versioned { schema, runs } = serde_json::from_str(&text).map_err(of_file)?;
        if schema != SCHEMA {
            return Err(Error::file(&path, format!("schema {schema} where {SCHEMA} is read")));
        }
        let Some(runs) = runs else { return Ok(vec![serde_json::from_str(&text).map_err(of_file)?]) };
        if !(1..=MOST).contains(&runs.len()) {
            return Err(Error::file(&path, format!("runs: {} where 1 to {MOST} are allowed", runs.len())));
        }
        let Pairs(above) = serde_json::from_str::<Pairs<&RawValue>>(&text).map_err(of_file)?;
        // As if it were alone: with the keys above that it lacks. One that stands once is there twice if it has it.
        let alone = |(k, Pairs(own)): (usize, &Pairs<&RawValue>)| {
            let lacks =
                |key: &str| ["schema", "code", "case"].contains(&key) || !own.iter().any(|(name, _)| name == key);
            let above = above.iter().filter(|(key, _)| key != "runs" && lacks(key));
            let pairs = own.iter().chain(above).map(|(key, value)| format!(",{}:{value}", Value::from(&**key)));
            let text = format!("{{\"runs\":{}{}}}", k + 1, pairs.collect::<String>());
            serde_json::from_str(&text).map_err(|e| refused(k + 1, e))
        };
        runs.iter().enumerate().map(alone).collect()
    }

    /// The error that a value of a key is not allowed.
    pub(super) fn refuse(&self, folder: &Path, key: &str, cause: impl fmt::Display) -> Error {
        let run = if self.run > 0 { format!("run {}: ", self.run) } else { String::new() };
        Error::file(&folder.join(FILE), format!("{run}{key}: {cause}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn texts_files_and_numbers_are_checked() {
        let longest = "é".repeat(LONGEST);
        let longer = longest.clone() + "e";
        for fit in ["a", " a", &longest] {
            assert_eq!(Line::try_from(fit.to_owned()), Ok(Line(fit.to_owned())));
        }
        for unfit in ["", " ", "a\nb", "a\u{1b}", &longer] {
            let said = Line::try_from(unfit.to_owned()).unwrap_err();
            let count = format!("a text of {} characters", unfit.chars().count());
            assert!(said.contains(&count), "{said}");
        }
        for fit in ["a.csv", "a b", ".a", "a/b.csv", &longest] {
            let name = FileName::try_from(fit.to_owned());
            assert_eq!(name, Ok(FileName(fit.to_owned())));
        }
        for unfit in
            ["", ".", "..", "/", "/a", "../a", "a/../b", "a/b/c", "./a", "a//b", "a/", "a/..", "a\\b", "a\nb", &longer]
        {
            let said = FileName::try_from(unfit.to_owned()).unwrap_err();
            assert!(said.starts_with(&format!("file {unfit:?} where")), "{said}");
        }
        assert_eq!(Positive::try_from(1e-300), Ok(Positive(1e-300)));
        for unfit in [0.0, -1.0, f64::INFINITY, f64::NAN] {
            let said = Positive::try_from(unfit).unwrap_err();
            assert!(said.starts_with(&unfit.to_string()), "{said}");
        }
    }

    #[test]
    fn parameters_are_numbers_booleans_or_words() {
        let read_text = |text: &str| assignments(&mut serde_json::Deserializer::from_str(text));
        let read = |value: &Value| read_text(&value.to_string());
        let sound = json!({"b": 0.5, "a": true, "c": "word", "d": 3});
        assert_eq!(read(&sound).unwrap(), ["a=true", "b=0.5", "c=word", "d=3"]);
        let twice = read_text("{\"b\": 1, \"b\": 2}").unwrap();
        assert_eq!(twice, ["b=1", "b=2"]);
        let many = |count: usize| Value::Object((0..count).map(|k| (k.to_string(), json!(k))).collect());
        assert_eq!(read(&many(MOST)).unwrap().len(), MOST);
        for (unfit, named) in [
            (many(MOST + 1), "more names than the 100"),
            (json!({"a": [1]}), "a: a number, boolean or word"),
            (json!({"a": null}), "a: a number, boolean or word"),
            (json!({"a": ""}), "a: a text of 0 characters"),
            (json!({"": 1}), "a text of 0 characters"),
            (json!([1]), "names with values"),
        ] {
            let said = read(&unfit).unwrap_err().to_string();
            assert!(said.contains(named), "{said}");
        }
    }

    #[test]
    fn a_manifest_is_of_this_version_and_form() {
        let folder = tempfile::tempdir().unwrap();
        let read = |text: &str| {
            std::fs::write(folder.path().join(FILE), text).unwrap();
            Manifest::read(folder.path()).map(|mut runs| runs.remove(0))
        };
        let sound = json!({
            "schema": 1, "code": {"name": "a"}, "scheme": "s", "case": "cook", "level": "h2",
        });
        let manifest = read(&sound.to_string()).unwrap();
        assert_eq!(manifest.basis, BasisName::Bspline2);
        assert!(manifest.parameters.is_empty() && manifest.cost == Cost::default());
        let with = |key: &str, value: Value| {
            let mut changed = sound.clone();
            changed[key] = value;
            read(&changed.to_string()).map_err(|e| e.to_string())
        };
        let linear = with("basis", json!("linear")).unwrap();
        assert_eq!(linear.basis, BasisName::Linear);
        let cost = json!({"cpu_s": 2.5, "wall_s": 3.5, "steps": 4, "threads": 5, "machine": "m"});
        let costly = with("cost", cost).unwrap().cost;
        assert_eq!((costly.cpu_s, costly.wall_s), (Some(Positive(2.5)), Some(Positive(3.5))));
        assert_eq!((costly.steps, costly.threads), (Some(4), Some(5)));
        for (key, value, named) in [
            ("schema", json!(2), "schema 2 where 1 is read"),
            ("levle", json!("h2"), "is `level` meant?"),
            ("level", json!(2), "expected a string"),
        ] {
            let said = with(key, value).unwrap_err();
            assert!(said.contains(named) && said.contains(FILE), "{said}");
        }
        assert!(read("{").is_err() && read("{}").is_err());
        std::fs::remove_file(folder.path().join(FILE)).unwrap();
        assert!(Manifest::read(folder.path()).is_err());
    }
}
