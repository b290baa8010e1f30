//! The names that nearly every case uses.

pub(super) use super::build::{by_columns, by_rows, clamp, roller};
pub(super) use super::family::{
    BASES, REMEDIES, implicit, levels, main_pairs, other_transfers, pairs, remedy_cost, transfers,
};
pub(super) use super::parameters::{self as common, least_strain, require_quotient};
pub(super) use crate::prelude::*;
