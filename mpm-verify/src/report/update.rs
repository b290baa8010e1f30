//! What a report says of its cases, kept where a case was not run again.

use super::SUMMARY;
use crate::case::Case;
use crate::cases;
use crate::error::Error;
use crate::files::read_versioned;
use crate::gallery::Picture;
use crate::study::gather::of_one_program;
use crate::study::judge::judge;
use crate::study::summary::{CaseStudy, SCHEMA, Summary};
use crate::verdict::Kind;
use std::path::Path;

/// Reads what the report in `out` says.
///
/// # Errors
/// There is none, or it is damaged, of another schema or tier, or mixes programs within a case.
pub(super) fn read(out: &Path, tier: &str) -> Result<Summary, Error> {
    let path = out.join(SUMMARY);
    if !path.exists() {
        return Err(Error::file(&path, "missing: no report to update"));
    }
    let summary: Summary = read_versioned(&path, SCHEMA)?;
    if summary.tier != tier {
        let cause = format!("of tier {} where {tier} is expected", summary.tier);
        return Err(Error::file(&path, cause));
    }
    for study in &summary.cases {
        of_one_program(study.records.iter()).map_err(|e| Error::file(&path, e))?;
    }
    Ok(summary)
}

/// The cases that were run again, and of the former ones those that were not and are still known.
pub(super) fn merge(former: Summary, again: Summary) -> Summary {
    let mut studies = again.cases;
    for study in former.cases {
        let replaced = studies.iter().any(|s| s.case == study.case);
        if let Ok(case) = cases::find(&study.case)
            && !replaced
        {
            studies.push(judged_again(case, study));
        }
    }
    Summary::new(&again.tier, studies)
}

/// Puts pictures that have been drawn again in the place of the former ones, and new ones at the end.
pub(super) fn replace(pictures: &mut Vec<Picture>, drawn: Vec<Picture>) {
    for picture in drawn {
        match pictures.iter_mut().find(|p| p.file == picture.file) {
            Some(former) => *former = picture,
            None => pictures.push(picture),
        }
    }
}

/// A study with the verdicts of the checks as they are now; those on drift, which need more than the
/// records, stay.
fn judged_again(case: &Case, mut study: CaseStudy) -> CaseStudy {
    for record in &mut study.records {
        let mut verdicts = judge(case, record);
        record.verdicts.retain(|v| v.kind == Kind::Drift);
        verdicts.append(&mut record.verdicts);
        record.verdicts = verdicts;
    }
    study.verdicts = case.judge_study(&study.records);
    study
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::night::Night;
    use crate::record::fixture::record;
    use crate::verdict::Verdict;

    fn study(case: &str, commit: &str) -> CaseStudy {
        let mut run = record("h2", Vec::new());
        run.case = case.to_owned();
        CaseStudy {
            night: Some(Night::new("2026-01-02", commit).unwrap()),
            pictures: vec![Picture {
                file: format!("{case}/{commit}.png"),
                caption: String::new(),
            }],
            ..CaseStudy::new(case, vec![run])
        }
    }

    #[test]
    fn what_ran_again_is_replaced_the_rest_stays_and_the_unknown_goes() {
        let former = ["standing-wave", "bridge", "cook"].map(|case| study(case, "old"));
        let again = ["column", "cook"].map(|case| study(case, "new"));
        let [former, again] = [former.to_vec(), again.to_vec()].map(|s| Summary::new("pr", s));
        let merged = merge(former, again);
        let told = |s: &CaseStudy| (s.case.clone(), s.pictures[0].file.clone());
        let told: Vec<_> = merged.cases.iter().map(told).collect();
        let expected = [
            ("cook", "cook/new.png"),
            ("column", "column/new.png"),
            ("standing-wave", "standing-wave/old.png"),
        ];
        assert_eq!(told, expected.map(|(a, b)| (a.to_owned(), b.to_owned())));
        let commits = merged
            .cases
            .iter()
            .map(|s| &s.night.as_ref().unwrap().commit);
        assert_eq!(commits.collect::<Vec<_>>(), ["new", "new", "old"]);
        assert_eq!((merged.tier.as_str(), merged.counts.runs), ("pr", 3));
    }

    #[test]
    fn what_is_drawn_again_keeps_its_place() {
        let picture = |file: &str, caption: &str| Picture {
            file: file.to_owned(),
            caption: caption.to_owned(),
        };
        let mut pictures = vec![picture("slide.png", "old"), picture("orders.png", "old")];
        replace(
            &mut pictures,
            vec![picture("orders.png", "new"), picture("price.png", "new")],
        );
        let told: Vec<_> = pictures.iter().map(|p| (&*p.file, &*p.caption)).collect();
        let expected = [
            ("slide.png", "old"),
            ("orders.png", "new"),
            ("price.png", "new"),
        ];
        assert_eq!(told, expected);
    }

    #[test]
    fn the_truth_is_judged_again_and_drift_stays() {
        let drift = Verdict {
            kind: Kind::Drift,
            ..Verdict::close("golden", "tip_uy (m)", 1.0, 2.0, 0.0, "")
        };
        let gone = Verdict::close("gone", "tip_uy", 1.0, 2.0, 0.0, "");
        let run = record("h2", vec![gone.clone(), drift.clone()]);
        let former = CaseStudy {
            verdicts: vec![gone],
            ..CaseStudy::new("cook", vec![run])
        };
        let merged = merge(
            Summary::new("pr", vec![former]),
            Summary::new("pr", vec![study("column", "new")]),
        );
        let cook = &merged.cases[0];
        let verdicts = &cook.records[0].verdicts;
        assert_eq!(verdicts[0].check, "completes");
        assert!(verdicts.iter().any(|v| v.check == "particle-count"));
        assert_eq!(verdicts.iter().filter(|v| **v == drift).count(), 1);
        let all = verdicts.iter().chain(&cook.verdicts);
        assert!(all.into_iter().all(|v| v.check != "gone"));
        assert_eq!(merged.counts.drifted, 1);
    }
}
