//! The table of its results.

use super::metrics::{CRITICAL_CFL, PREDICTED_CFL};
use crate::results::{Column, ResultTable, SCHEME, fixed};

/// Settings by the title of their column.
const SETTINGS: [(&str, &[&str]); 9] = [
    ("1D", &["dimension=1"]),
    ("1D, jittered", &["dimension=1", "layout=jittered"]),
    ("1D, cut", &["dimension=1", "layout=cut"]),
    ("1D, J = 0.7", &["dimension=1", "stretch=0.7"]),
    ("1D, J = 1.4", &["dimension=1", "stretch=1.4"]),
    ("1D, c₁ = 0.5", &["dimension=1", "linear_viscosity=0.5"]),
    ("1D, c₁ = 1", &["dimension=1", "linear_viscosity=1"]),
    ("2D", &[]),
    ("3D", &["dimension=3"]),
];

pub(super) fn all() -> Vec<ResultTable> {
    let columns = SETTINGS.into_iter().flat_map(|(title, set)| {
        let at = move |r: &crate::record::Record| r.set == set;
        [
            Column::metric(title, CRITICAL_CFL, fixed(3)).of(at),
            Column::metric("predicted", PREDICTED_CFL, fixed(3)).of(at),
        ]
    });
    let shows = |r: &crate::record::Record| SETTINGS.iter().any(|(_, set)| r.set == *set);
    vec![ResultTable::new("critical-step", shows, &[SCHEME], columns)]
}
