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

    /// Pages of formulas and rules, whose numbers follow from the text beside them.
    const DERIVED: &str = "remedy method implicit bodies drucker-prager cam-clay exact poromechanics contact manufactured \
                           reliability verification continuous metamorphic mutants README";

    /// A page as it is read, without what fills its numbers: citations, tables, code, pictures, links, lines with a source.
    fn prose(page: &str) -> String {
        fn without(mut text: String, open: &str, close: &str) -> String {
            while let Some((before, (_, after))) =
                text.split_once(open).and_then(|(b, a)| Some((b, a.split_once(close)?)))
            {
                text = format!("{before}{after}");
            }
            text
        }
        let lines: Vec<&str> = page.lines().filter(|line| !line.contains("<!--from ")).collect();
        let mut text = lines.join("\n");
        for (open, close) in [(BEGIN, END), ("<!-- table", "<!-- end -->"), ("```", "```"), ("`", "`"), ("](", ")")] {
            text = without(text, open, close);
        }
        text
    }

    /// Numbers of two digits and more, and the text before and after each.
    fn numbers(line: &str) -> Vec<(&str, &str, &str)> {
        let (mut found, mut from) = (Vec::new(), 0);
        while let Some(begin) = line[from..].find(|c: char| c.is_ascii_digit()).map(|k| from + k) {
            let is_part = |c: char| c.is_ascii_digit() || ".,".contains(c);
            let end = line[begin..].find(|c| !is_part(c)).map_or(line.len(), |k| begin + k);
            let number = line[begin..end].trim_end_matches(['.', ',']);
            let (before, after) = (&line[..begin], &line[begin + number.len()..]);
            if number.len() > 1 && !before.ends_with(|c: char| c.is_alphanumeric() || c == '-') {
                found.push((before, number, after));
            }
            from = end;
        }
        found
    }

    /// Whether a number stands for a label, a bound or a value that is set, and is no result.
    fn is_given(before: &str, number: &str, after: &str) -> bool {
        let is_label = !number.contains('.') && (before.ends_with('(') && after.starts_with(')') || before == "| ");
        let named = ["Figure", "Figures", "Section", "section", "Eq.", "Mach", "CFL", "Rust", "Apache", "Night of"];
        let before = before.trim_end();
        is_label || before.ends_with(['=', '≤', '≥', '<', '>', '/']) || named.iter().any(|name| before.ends_with(name))
    }

    /// A number of a page is filled from a row, stands in what `explain` prints, or on a line that names its source:
    /// `<!--from scripts/soils.py-->`, `<!--from the paper-->`.
    #[test]
    fn every_result_on_a_page_has_a_source() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let explained = |case: &Case| crate::report::describe::explain(case);
        let digits = |text: &str| -> BTreeSet<String> {
            let parts = text.split(|c: char| !c.is_ascii_digit() && c != '.');
            parts.map(|n| n.trim_matches('.').to_owned()).collect()
        };
        let all = digits(&cases::all().iter().map(explained).collect::<String>());
        let mut typed = Vec::new();
        for file in crate::files::entries(&root.join("docs")).unwrap().into_iter().chain([root.join("README.md")]) {
            let name = file.file_stem().unwrap().to_str().unwrap();
            let in_docs = file.parent() != Some(&root);
            if file.extension().is_none_or(|e| e != "md") || in_docs && DERIVED.split(' ').any(|d| d.trim() == name) {
                continue;
            }
            let text = read_text(&file).unwrap();
            for script in text.split("<!--from scripts/").skip(1).filter_map(|rest| rest.split("-->").next()) {
                assert!(root.join("scripts").join(script).exists(), "{name}: {script}");
            }
            let known = cases::find(name).map_or_else(|_| all.clone(), |case| digits(&explained(case)));
            let mut is_set = false;
            for line in prose(&text).lines() {
                is_set = if line.starts_with('#') { ["## Set-up", "## Tolerances"].contains(&line) } else { is_set };
                let results = numbers(line).into_iter().filter(|(before, n, after)| {
                    !is_set && !line.starts_with('#') && !known.contains(*n) && !is_given(before, n, after)
                });
                typed.extend(results.map(|(_, n, _)| format!("{name}: {n} in \"{line}\"")));
            }
        }
        assert!(typed.is_empty(), "{} numbers without a source:\n{}", typed.len(), typed.join("\n"));
    }

    #[test]
    fn a_typed_result_is_seen_and_a_given_number_is_not() {
        let seen = |line: &str| numbers(&prose(line)).iter().filter(|(b, n, a)| !is_given(b, n, a)).count();
        for line in ["errs by 5.8 %.", "N_c is 12 and 5.143 B."] {
            assert!(seen(line) > 0, "{line}");
        }
        for line in
            ["ν = 0.499, Eq. (18), B/20", "<!--= a b 2-->5.14<!--/--> `n64` [a](b.md#c12)", "0.9<!--from the paper-->"]
        {
            assert_eq!(seen(line), 0, "{line}");
        }
    }
}
