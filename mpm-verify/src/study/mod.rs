//! Many runs: what is planned, how runs are made side by side, how their records are gathered and judged.

pub mod complete;
pub(crate) mod convergence;
pub mod found;
pub mod gather;
pub mod judge;
pub mod plan;
pub mod schedule;
pub(crate) mod summary;

use crate::case::{Case, Tier, find_level};
use crate::error::{Error, ExitCode};
use crate::files::{read_rows, read_versioned, require_inside, write_json};
use crate::parameter::Parameters;
use crate::record::{self, Record, Status, Version};
use crate::run::checkpoint::{Identity, Refusal, Saving};
use crate::run::{Progress, RECORD, discard_run, execute, require_tables};
use crate::scheme::Scheme;
use crate::spec::RunSpec;
use crate::verdict::{Kind, Outcome, Verdict};
use crate::{cases, distinct};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};
