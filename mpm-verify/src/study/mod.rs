//! Many runs: what is planned, how runs are made side by side, how their records are gathered and judged.

pub mod complete;
pub mod convergence;
pub mod found;
pub mod gather;
pub mod judge;
pub mod plan;
pub mod schedule;
pub mod summary;
