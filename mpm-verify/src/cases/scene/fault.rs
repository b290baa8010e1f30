//! Where a scene file is wrong: file, line, key, what is there and what may be.

use crate::error::{Error, nearest};
use serde::Deserialize;
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// A value that remembers where it stands.
pub(super) type Line<T> = Spanned<T>;

/// A scene file's text, to say where something in it is wrong.
pub(super) struct Source {
    pub(super) path: PathBuf,
    pub(super) text: String,
    /// Divisor of all strengths; 1 as a rule.
    pub(super) weaker: f64,
    /// Memory that the scene may have (bytes), if known.
    pub(super) memory: Option<f64>,
}

impl Source {
    /// Reads what the text says.
    pub(super) fn parse<T: for<'a> Deserialize<'a>>(&self) -> Result<T, Error> {
        toml::from_str(&self.text).map_err(|e| {
            let span = e.span().unwrap_or_default();
            let mut said = e.message().replace('\n', "; ");
            // Message for a table that stands for one of several kinds.
            if said.starts_with("wanted exactly 1 element") {
                said = "one kind of it is allowed, and the file names more or none".to_owned();
            }
            // A user doesn't know the names of the program's types.
            if let Some(place) = said.find("expected struct ") {
                said.replace_range(place.., "a table of keys is allowed");
            }
            if let Some(name) = nearest(&said) {
                said.push_str(&format!("; is `{name}` meant?"));
            }
            self.fault(&span, said)
        })
    }

    /// Error in the value of a span.
    pub(super) fn fault(&self, span: &Range<usize>, said: impl std::fmt::Display) -> Error {
        let before = self.text.get(..span.start).unwrap_or_default();
        let line = before.matches('\n').count() + 1;
        let told = match self.key(span) {
            Some(key) => format!("line {line}, {key}: {said}"),
            None => format!("line {line}: {said}"),
        };
        Error::file(&self.path, told)
    }

    /// Error in a value with a known place.
    pub(super) fn at<T>(&self, value: &Line<T>, said: impl std::fmt::Display) -> Error {
        self.fault(&value.span(), said)
    }

    /// The key, or the head of the table, that a span belongs to.
    fn key(&self, span: &Range<usize>) -> Option<&str> {
        let start = self.text.get(..span.start)?.rfind('\n').map_or(0, |k| k + 1);
        let line = self.text.get(start..)?.lines().next()?;
        if line.trim_start().starts_with('[') {
            return Some(line.trim());
        }
        if line.trim_start().starts_with('#') {
            return None;
        }
        let before = line.get(..span.start - start)?;
        let named = match before.rfind('=') {
            Some(end) => &before[..end],
            None => line.split('=').next()?,
        };
        let of_key = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
        let key = named.trim_end().rsplit(|c| !of_key(c)).next()?;
        (!key.is_empty()).then_some(key)
    }

    /// A file beside this one.
    pub(super) fn beside<T>(&self, value: &Line<T>, name: &str) -> Result<PathBuf, Error> {
        let plain = Path::new(name).file_name().is_some_and(|n| n == name);
        match plain {
            true => Ok(self.path.with_file_name(name)),
            false => Err(self.at(value, format!("file {name:?} where the name of a file beside the scene is allowed"))),
        }
    }
}
