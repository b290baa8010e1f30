//! The names that nearly every part of a report uses.

pub(super) use super::words::{
    self, bless_commands, demand, kind, list, local_orders, number, order, outcome, sentence,
};
pub(super) use crate::case::{Case, Tier};
pub(super) use crate::draw::triptych::triptych;
pub(super) use crate::draw::{Chart, Dash, Marker, Series, write_small_png};
pub(super) use crate::error::{Error, ExitCode};
pub(super) use crate::figure::{Figure, Panel};
pub(super) use crate::files::{
    DOCUMENT, SNAPSHOTS, discard, files_in, make_folder, read_text, read_versioned, require_inside, write_csv,
    write_json, write_whole,
};
pub(super) use crate::gallery::{Gallery, Picture};
pub(super) use crate::metric::Quantity;
pub(super) use crate::night::Night;
pub(super) use crate::parameter::Parameters;
pub(super) use crate::record::{Record, Status};
pub(super) use crate::results::{Column, Format, Label, ResultTable, SHORT, fixed, is_flip};
pub(super) use crate::run::series;
pub(super) use crate::scheme::{BasisName, RemedyName, RuleName, Scheme, TransferName};
pub(super) use crate::spec::RunSpec;
pub(super) use crate::study::convergence::{Convergence, Point, convergence, precision};
pub(super) use crate::study::gather::Gathered;
pub(super) use crate::study::judge::outcome_of_run;
pub(super) use crate::study::summary::{CaseStudy, SCHEMA, Summary};
pub(super) use crate::table::Sheet;
pub(super) use crate::verdict::{Kind, Outcome, Verdict};
pub(super) use crate::{cases, distinct};
pub(super) use image::RgbImage;
pub(super) use jiff::civil::Date;
pub(super) use serde::{Deserialize, Serialize};
pub(super) use serde_json::{Value, json};
pub(super) use std::collections::{BTreeMap, BTreeSet};
pub(super) use std::fmt::Write;
pub(super) use std::path::{Path, PathBuf};
