//! The references: Prandtl's limit load and an independent finite-element solution.

/// Prandtl's bearing capacity factor of a strip footing.
pub(super) const EXACT: f64 = 2.0 + std::f64::consts::PI;

/// Metrics of the curve and the penetrations over B at which they are measured.
pub(super) const CURVE: &[(&str, f64)] = &[
    ("nc_0.0003", 3e-4),
    ("nc_0.0005", 5e-4),
    ("nc_0.001", 1e-3),
    ("nc_0.0015", 1.5e-3),
    ("nc_0.002", 2e-3),
    ("nc_0.003", 3e-3),
];

/// The references in words.
pub(super) fn describe() -> Vec<String> {
    Vec::new()
}
