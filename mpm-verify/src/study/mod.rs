//! Many runs: what is planned, how runs are made side by side, how their records are gathered and judged.

pub mod complete;
pub mod convergence;
pub mod found;
pub mod gather;
pub mod judge;
pub mod plan;
pub mod schedule;
pub mod summary;

use crate::case::{Case, Tier, find_level};
use crate::error::Error;
use crate::files::{read_versioned, require_inside};
use crate::parameter::Parameters;
use crate::record::{Record, Status, Version};
use crate::run::RECORD;
use crate::run::checkpoint::Saving;
use crate::scheme::Scheme;
use crate::spec::RunSpec;
use crate::verdict::{Kind, Outcome, Verdict};
use crate::{cases, distinct};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};
