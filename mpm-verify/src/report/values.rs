//! Numbers in the sentences of README and docs, filled from the rows that are kept.
//!
//! `<!--= CASE SCHEME LEVEL [PARAMETER=VALUE…] METRIC FORMAT-->5.14<!--/-->`, on one line. The metric is one that the row keeps,
//! `cpu_s`, `steps` or `breakdown`, the time of it (s). Over a number that a second run has, which stands after a `/`, it
//! is a ratio. The format is a number of decimals, `e` with one for a power of ten, and a `%` after it for a share
//! in per cent, with its sign if a `+` is before it.

use super::prelude::*;
use super::rows::Row;
use crate::results::{percent, scientific, share};

const BEGIN: &str = "<!--=";
const CLOSE: &str = "-->";
const END: &str = "<!--/-->";

/// Source of the numbers on pages: the kept rows, as records.
pub(super) struct Values(Vec<(String, Record)>);

impl Values {
    pub(super) fn new(rows: &[Row]) -> Self {
        let named = rows.iter().filter_map(|row| Some((row.run().join(" "), row.record()?)));
        Self(named.map(|(name, record)| (name.trim_end().to_owned(), record)).collect())
    }

    /// A line with its numbers as they should be, and what those that are not are of.
    pub(super) fn fill(&self, line: &str) -> Result<(String, Vec<String>), Error> {
        let (mut text, mut stale, mut rest) = (String::new(), Vec::new(), line);
        while let Some((before, after)) = rest.split_once(BEGIN) {
            let parts = after.split_once(CLOSE);
            let parts = parts.and_then(|(of, after)| Some((of, after.split_once(END)?)));
            let Some((of, (former, after))) = parts else {
                return Err(Error::Input(format!("the number{after} does not end")));
            };
            let number = self.number(of.trim())?;
            if number != former {
                stale.push(of.trim().to_owned());
            }
            text += &format!("{before}{BEGIN}{of}{CLOSE}{number}{END}");
            rest = after;
        }
        Ok((text + rest, stale))
    }

    fn number(&self, of: &str) -> Result<String, Error> {
        let refuse = |cause: &str| Error::Input(format!("the number \"{of}\": {cause}"));
        let parts = of.rsplit_once(' ');
        let (of_what, format) = parts.ok_or_else(|| refuse("a run, a metric and a format are wanted"))?;
        let format = read_format(format).ok_or_else(|| refuse("a format is 2, e1, 1% or +1%"))?;
        let value = |of: &str| self.value(of).map_err(refuse);
        let value = match of_what.split_once(" / ") {
            Some((over, under)) => value(over)? / value(under)?,
            None => value(of_what)?,
        };
        Ok(format.text(value))
    }

    /// A number of a run, or the reason for its absence.
    fn value(&self, of: &str) -> Result<f64, &'static str> {
        let (run, metric) = of.rsplit_once(' ').ok_or("a run and a metric are wanted")?;
        let (_, record) = self.0.iter().find(|(known, _)| known == run).ok_or("no such run is kept")?;
        Some(quantity(record, metric)).filter(|v| v.is_finite()).ok_or("its row keeps no such metric")
    }
}

/// A metric of a run, its processor time (s), its number of steps, or the time (s) of its breakdown; NaN without one.
pub(super) fn quantity(record: &Record, name: &str) -> f64 {
    match name {
        "cpu_s" => record.time.cpu_s,
        "steps" => record.work.steps as f64,
        "breakdown" => record.error.as_ref().map_or(f64::NAN, |e| e.time),
        metric => record.value(metric),
    }
}

/// A format of a number, if it is one.
pub(super) fn read_format(format: &str) -> Option<Format> {
    let of: fn(usize) -> Format = match (format.strip_prefix('+'), format.strip_suffix('%')) {
        (Some(_), Some(_)) => percent,
        (None, Some(_)) => share,
        (None, None) if format.starts_with('e') => scientific,
        (None, None) => fixed,
        (Some(_), None) => return None,
    };
    Some(of(format.trim_matches(|c| matches!(c, '+' | '%' | 'e')).parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use crate::record::fixture::run;
    use crate::scheme::{BasisName, RemedyName};

    fn values() -> Values {
        let cook = cases::find("cook").unwrap();
        let scheme = (BasisName::Gimp, RemedyName::None);
        let metrics = [("mid_edge_uy", -0.012_34)];
        let run = run(&cook.parameters, scheme, ("h1", 1.0), &["load=2"], &metrics);
        Values(vec![("cook gimp-none-flip h1 load=2".to_owned(), run)])
    }

    #[test]
    fn a_number_in_a_sentence_is_filled_and_a_changed_one_is_stale() {
        let line = |first: &str, second: &str| {
            let run = "cook gimp-none-flip h1 load=2 mid_edge_uy";
            format!("Off by <!--= {run} +1%-->{first}<!--/--> or <!--= {run} 4-->{second}<!--/-->.\n")
        };
        let (filled, stale) = values().fill(&line("+9 %", "−0.0123")).unwrap();
        assert_eq!(filled, line("−1.2 %", "−0.0123"));
        assert_eq!(stale, ["cook gimp-none-flip h1 load=2 mid_edge_uy +1%"]);
        assert!(values().fill(&filled).unwrap().1.is_empty());
    }

    #[test]
    fn a_ratio_is_of_two_runs() {
        let run = "cook gimp-none-flip h1 load=2";
        let line = format!("<!--= {run} steps / {run} cpu_s 1-->3.0<!--/-->");
        assert_eq!(values().fill(&line).unwrap(), (line, Vec::new()));
    }

    #[test]
    fn what_nothing_fills_is_refused() {
        for (of, cause) in [
            ("cook gimp-none-flip h1 mid_edge_uy 2", "no such run"),
            ("cook gimp-none-flip h1 load=2 tip 2", "no such metric"),
            ("cook gimp-none-flip h1 load=2 mid_edge_uy +2", "a format is"),
            ("2", "are wanted"),
        ] {
            let error = values().fill(&format!("<!--= {of}-->1<!--/-->")).unwrap_err();
            assert!(error.to_string().contains(cause), "{error}");
        }
        let endless = values().fill("<!--= cook 2-->1").unwrap_err().to_string();
        assert!(endless.contains("does not end"), "{endless}");
    }
}
