//! How a run came out: its outcome, and whether what it leaves is noise or it broke down.

use super::prelude::*;
use crate::study::judge::broke_as_known;
use std::f64::consts::FRAC_1_SQRT_2;

/// Case, metric of the noise in its stress or pressure (rms), and metric of the reference rms, unless the first is a
/// ratio already.
const NOISE: [(&str, &str, Option<&str>); 6] = [
    ("cook", "checkerboard_ratio", None),
    ("footing", "checkerboard_ratio", None),
    ("dam-break", "checkerboard_rms", Some("pressure_rms")),
    ("undrained", "checkerboard_ratio", None),
    ("translate", "stress_noise", None),
    ("shock", "ringing", None),
];
/// The same share of noise in the mean square is a half.
const NOISY: f64 = FRAC_1_SQRT_2;

/// How a run came out, in words and with a symbol; of a cell the last is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Fate {
    NotJudged,
    Right,
    WrongAsKnown,
    /// Be it right or wrong as known.
    Noisy,
    /// As it is known to.
    BreaksDown,
    Failed,
}

impl Fate {
    /// As a legend has them.
    pub(super) const ALL: [Self; 6] =
        [Self::Right, Self::WrongAsKnown, Self::Noisy, Self::BreaksDown, Self::NotJudged, Self::Failed];

    /// Fate of a run with its verdicts.
    pub(super) fn of(record: &Record) -> Self {
        match outcome_of_run(record) {
            Outcome::Failed => Self::Failed,
            _ if broke_as_known(record) => Self::BreaksDown,
            _ if noise(record).is_some_and(|share| share > NOISY) => Self::Noisy,
            Outcome::WrongAsKnown => Self::WrongAsKnown,
            Outcome::Right => Self::Right,
            Outcome::NotJudged => Self::NotJudged,
        }
    }

    /// Symbol, words, and the class that gives its colour.
    pub(super) fn shown(self) -> [&'static str; 3] {
        match self {
            Self::NotJudged => words::shown(Outcome::NotJudged),
            Self::Right => words::shown(Outcome::Right),
            Self::WrongAsKnown => words::shown(Outcome::WrongAsKnown),
            Self::Noisy => ["∿", "noisy", "noisy"],
            Self::BreaksDown => ["↯", "breaks down as known", "broken"],
            Self::Failed => words::shown(Outcome::Failed),
        }
    }
}

/// The noise of a run over what it is the noise of, if it is measured.
fn noise(record: &Record) -> Option<f64> {
    let (_, noise, whole) = NOISE.iter().find(|(case, ..)| *case == record.case)?;
    let whole = whole.map_or(1.0, |name| record.value(name));
    Some(record.value(noise) / whole)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;

    #[test]
    fn noise_is_what_its_case_measures() {
        for (case, noise, whole) in NOISE {
            let case = cases::find(case).unwrap();
            for name in [noise].into_iter().chain(whole) {
                let metric = case.metrics.iter().find(|m| m.name == name);
                assert!(metric.is_some(), "{} {name}", case.name);
            }
        }
    }
}
