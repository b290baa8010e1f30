//! The names that nearly every part of a report uses.

pub(super) use crate::case::Case;
pub(super) use crate::draw::{Chart, Series};
pub(super) use crate::error::Error;
pub(super) use crate::files::{write_csv, write_whole};
pub(super) use crate::gallery::{Gallery, Picture};
pub(super) use crate::metric::Quantity;
pub(super) use crate::night::Night;
pub(super) use crate::record::Record;
pub(super) use crate::scheme::{BasisName, RemedyName, Scheme};
pub(super) use crate::study::convergence::Convergence;
pub(super) use crate::study::gather::Gathered;
pub(super) use crate::study::judge::outcome_of_run;
pub(super) use crate::study::summary::{CaseStudy, Summary};
pub(super) use crate::table::Sheet;
pub(super) use crate::verdict::{Kind, Outcome, Verdict};
pub(super) use crate::{cases, distinct};
pub(super) use std::collections::{BTreeMap, BTreeSet};
pub(super) use std::path::{Path, PathBuf};
