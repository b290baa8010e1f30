//! The names that nearly every case uses.

pub(super) use super::analysis::{Analysis, case_of, visited};
pub(super) use super::build::{REACH, by_columns, by_rows, clamp, lattice, middles, noise, roller, stretched};
pub(super) use super::checks::*;
pub(super) use super::family::{
    BASES, REMEDIES, SMOOTH, implicit, levels, main_pairs, other_transfers, pairs, range, remedy_cost, transfers,
};
pub(super) use super::observe::{displacement, farthest, finds_equilibrium, places};
pub(super) use super::parameters::{self as common, least_strain, require_quotient};
pub(super) use super::pictures::*;
pub(super) use crate::prelude::*;
