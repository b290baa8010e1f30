//! The factor by which the strength of a scene can be divided before it fails, by bisection.
//!
//! Ground that has failed slumps to another equilibrium: its displacement over the factor has a kink. docs/how-to/factor.md

use crate::draw::{Chart, Dash, Marker, ReferenceLine, Series, draw_charts};
use crate::error::Error;
use crate::files::write_csv;
use crate::record::{Failure, LIMIT_LOAD, Record, Status};
use std::path::Path;

/// Growth of the displacement by which a body fails: in heights of the body, and in displacements at the least factor.
const GROWS: [f64; 2] = [1.0 / 200.0, 2.0];
/// Displacement in heights of the body from which it fails in any case.
const SLUMPS: f64 = 1.0 / 50.0;

struct Trial {
    factor: f64,
    /// Largest displacement (m) of a particle; NaN without an equilibrium.
    moved: f64,
    stands: bool,
    /// Error of a run that ended without a sign of failure.
    unclear: Option<String>,
}

/// A search for the factor.
pub struct Search {
    range: [f64; 2],
    /// Height of the body (m).
    height: f64,
    most: usize,
    trials: Vec<Trial>,
}

impl Search {
    /// A search in a range of factors, of a body of a height (m), in `most` trials.
    ///
    /// # Errors
    /// The range is empty, or not of positive numbers.
    pub fn new(range: [f64; 2], height: f64, most: usize) -> Result<Self, Error> {
        let [least, largest] = range;
        match least > 0.0 && least < largest && largest.is_finite() {
            true => Ok(Self { range, height, most, trials: Vec::new() }),
            false => Err(Error::Input(format!("--least {least}, --most {largest}: 0 < least < most is allowed"))),
        }
    }

    /// The factors between which the body fails, of those tried; NaN where it always stands or fails.
    fn bracket(&self) -> [f64; 2] {
        let of = |stands: bool| self.trials.iter().filter(move |t| t.stands == stands).map(|t| t.factor);
        [of(true).next_back().unwrap_or(f64::NAN), of(false).next().unwrap_or(f64::NAN)]
    }

    /// The factor to try next: the least, the largest, then the geometric middle of the bracket.
    pub fn next(&self) -> Option<f64> {
        let [stands, fails] = self.bracket();
        match self.trials.len() {
            n if n == self.most => None,
            n @ (0 | 1) => Some(self.range[n]).filter(|_| fails.is_nan()),
            _ => Some((stands * fails).sqrt()).filter(|middle| middle.is_finite()),
        }
    }

    /// Displacement (m) from which a trial fails, once there is one at the least factor.
    fn limit(&self) -> f64 {
        let first = self.trials.first().map_or(f64::NAN, |first| first.moved);
        (SLUMPS * self.height).min(first + (GROWS[0] * self.height).max(GROWS[1] * first))
    }

    /// Adds the trial of a run, and tells how it came out.
    pub fn add(&mut self, factor: f64, run: &Record) -> String {
        let moved = if run.status == Status::Ok { run.value("displacement_max") } else { f64::NAN };
        let limit = if self.trials.is_empty() { SLUMPS * self.height } else { self.limit() };
        let stands = moved < limit;
        // A slump can leave the grid; a step that finds no equilibrium for another reason is no failure of the ground.
        let told = |e: &&Failure| e.kind != LIMIT_LOAD && e.kind != "off-grid";
        let unclear = run.error.as_ref().filter(told).map(|e| e.message.clone());
        self.trials.push(Trial { factor, moved, stands, unclear });
        self.trials.sort_by(|a, b| a.factor.total_cmp(&b.factor));
        let why = run.error.as_ref().map_or_else(|| format!("moved {moved:.4} m"), |e| e.message.clone());
        format!("{factor:.4}  {}  {why}", if stands { "stands" } else { "fails" })
    }

    /// The result in a sentence.
    pub fn result(&self) -> String {
        let unclear = self.trials.iter().find(|t| !t.stands).and_then(|t| t.unclear.as_ref());
        match (self.bracket(), unclear) {
            ([stands, fails], Some(why)) => {
                let stands = if stands.is_nan() { String::new() } else { format!("Stands at {stands:.3}. ") };
                format!("{stands}At {fails:.3} the run ends without a sign of failure: {why}")
            }
            ([stands, _], _) if stands.is_nan() => {
                format!("Fails at the least factor, {}: try less (--least).", self.range[0])
            }
            ([_, fails], _) if fails.is_nan() => {
                format!("Stands at the largest factor, {}: try more (--most).", self.range[1])
            }
            ([stands, fails], _) => {
                format!("Factor of safety {:.3}: stands at {stands:.3}, fails at {fails:.3}.", (stands * fails).sqrt())
            }
        }
    }

    /// Writes the trials as a picture and a table into a folder.
    ///
    /// # Errors
    /// A file can't be written.
    pub fn write(&self, folder: &Path) -> Result<(), Error> {
        draw_charts(&folder.join("factor.png"), &[self.chart()], 1)?;
        let header = ["factor", "displacement_max_m", "stands"].map(str::to_owned);
        let row = |t: &Trial| vec![t.factor.to_string(), t.moved.to_string(), t.stands.to_string()];
        write_csv(&folder.join("factor.csv"), &header, self.trials.iter().map(row))
    }

    /// Displacement over the factor.
    fn chart(&self) -> Chart {
        let series =
            [("stands", true, Marker::Circle), ("fails", false, Marker::Square)].map(|(name, stands, marker)| {
                let own = self.trials.iter().filter(|t| t.stands == stands);
                let points = own.map(|t| (t.factor, t.moved)).collect();
                Series { marker, dash: Dash::Dotted, ..Series::line(name, points, usize::from(stands)) }
            });
        let (name, value) = ("fails above".to_owned(), self.limit());
        Chart {
            reference_lines: vec![ReferenceLine { name, value, band: None }],
            ..Chart::new(self.result(), ["strength divided by (-)", "largest displacement (m)"], series.into())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::fixture::record;

    /// The search of a body 10 m high that fails at `limit` and finds equilibrium up to `lost`.
    fn found(limit: f64, lost: f64) -> Search {
        let mut search = Search::new([1.0, 3.0], 10.0, 12).unwrap();
        while let Some(factor) = search.next() {
            let mut run = record("h1", Vec::new());
            let moved = 0.002 * factor + 5.0 * (factor / limit).ln().max(0.0);
            run.measure(&[("displacement_max", moved)]);
            if factor > lost {
                run.status = Status::Failed;
            }
            search.add(factor, &run);
        }
        search
    }

    #[test]
    fn a_kink_is_found_from_both_sides_though_all_trials_find_equilibrium() {
        for lost in [f64::INFINITY, 1.7] {
            let search = found(1.65, lost);
            let [stands, fails] = search.bracket();
            // 0.05 m at half a height per ln(factor): a hundredth too late.
            assert!(stands < fails && stands > 1.65 && fails < 1.67, "{stands} {fails}");
            assert!(search.result().contains("safety 1.66"), "{}", search.result());
            assert_eq!(search.trials.len(), 12);
            assert!(search.chart().shows_something());
        }
    }

    #[test]
    fn a_run_that_ends_for_another_reason_is_no_failure() {
        for (kind, clear) in [(LIMIT_LOAD, true), ("off-grid", true), ("no-convergence", false), ("singular", false)] {
            let mut search = Search::new([1.0, 3.0], 10.0, 3).unwrap();
            while let Some(factor) = search.next() {
                let mut run = record("h1", Vec::new());
                run.measure(&[("displacement_max", 0.01)]);
                if factor > 1.0 {
                    run.break_down(kind, 0.5, "take shorter steps");
                }
                search.add(factor, &run);
            }
            assert_eq!(search.result().contains("without a sign of failure: take shorter steps"), !clear);
            assert_eq!(search.result().contains("Factor of safety 1.3"), clear, "{}", search.result());
        }
    }

    #[test]
    fn a_range_without_the_limit_is_told() {
        let [strong, weak] = [found(5.0, 9.0), found(0.5, 0.9)];
        assert!(strong.trials.len() == 2 && strong.result().contains("--most"));
        assert!(weak.trials.len() == 1 && weak.result().contains("--least"));
        assert!(Search::new([2.0, 1.0], 1.0, 5).is_err() && Search::new([0.0, f64::NAN], 1.0, 5).is_err());
    }
}
