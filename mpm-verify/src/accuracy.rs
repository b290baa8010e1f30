//! Order of accuracy over a family of grids: by least squares where the exact value is known, by
//! Richardson's extrapolation with the grid convergence index (GCI) where it is not.
//!
//! Roache, *Verification and Validation in Computational Science and Engineering* (1998); Celik et al.,
//! J. Fluids Eng. 130 (2008) 078001, doi 10.1115/1.2960953.

use crate::exact::root;
use crate::statistics::fit_line;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};
use std::fmt;

/// Confidence of an uncertainty.
pub(crate) const CONFIDENCE: f64 = 0.95;
/// Factor of safety of the GCI for an order observed on three grids or more (Roache).
const SAFETY: f64 = 1.25;
/// Largest relative difference between the orders of two successive triplets of grids in the asymptotic
/// range.
const ORDERS_AGREE: f64 = 0.2;
/// Highest order that is believed.
const MOST: f64 = 8.0;

/// An order by least squares: the slope of ln |error| against ln h.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Order {
    pub order: f64,
    /// Half the width of its confidence interval (Student's t, 95 %).
    pub uncertainty: f64,
    /// Orders between successive levels, coarsest first.
    pub local: Vec<f64>,
}

impl Order {
    /// The orders between levels, as text.
    pub(crate) fn between(&self) -> String {
        let orders: Vec<String> = self.local.iter().map(|p| format!("{p:.2}")).collect();
        orders.join(", ").replace('-', "−")
    }
}

/// With its uncertainty (95 %).
impl fmt::Display for Order {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let order = format!("{:.2}", self.order).replace('-', "−");
        write!(f, "{order} ± {:.2}", self.uncertainty)
    }
}

/// The order of errors over cells of size h, given as (h, error), coarsest first.
///
/// `None` for fewer than three levels, and where an error is zero, not finite or changes sign: there is
/// no power law then.
pub(crate) fn fit_order(points: &[(f64, f64)]) -> Option<Order> {
    let sign = points.first()?.1.signum();
    let usable = |(h, e): &(f64, f64)| *h > 0.0 && e.is_finite() && e * sign > 0.0;
    if !points.iter().all(usable) {
        return None;
    }
    let logs: Vec<(f64, f64)> = points.iter().map(|(h, e)| (h.ln(), e.abs().ln())).collect();
    let line = fit_line(&logs)?;
    let freedom = points.len() as f64 - 2.0;
    let quantile = StudentsT::new(0.0, 1.0, freedom).ok()?.inverse_cdf(0.5 * (1.0 + CONFIDENCE));
    Some(Order {
        order: line.slope,
        uncertainty: quantile * line.slope_error,
        local: logs.windows(2).map(|pair| (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0)).collect(),
    })
}

/// Richardson's extrapolation from three grids.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Richardson {
    /// Observed order.
    pub order: f64,
    /// Value extrapolated to h = 0.
    pub extrapolated: f64,
    /// Grid convergence index of the finest grid, relative to its value.
    pub gci: f64,
    /// Grid convergence index of the middle grid, relative to its value.
    pub gci_middle: f64,
}

/// Extrapolates from the values on three grids, given as (h, value), coarsest first. The refinement
/// need not be uniform.
///
/// # Errors
/// Why nothing can be extrapolated: the values don't converge monotonically.
pub(crate) fn richardson(points: [(f64, f64); 3]) -> Result<Richardson, String> {
    let [(h3, f3), (h2, f2), (h1, f1)] = points;
    let (r32, r21) = (h3 / h2, h2 / h1);
    let (d32, d21) = (f3 - f2, f2 - f1);
    if !(r32 > 1.0 && r21 > 1.0) {
        return Err("the cells don't shrink".to_owned());
    }
    let ratio = d32 / d21;
    if !ratio.is_finite() || ratio <= 0.0 {
        return Err("the values don't converge monotonically".to_owned());
    }
    // p ln r21 = ln(ratio) + ln((r21^p − 1)/(r32^p − 1)), Eq. (3) of Celik et al., by bisection of the
    // equivalent d32/d21 = r21^p (r32^p − 1)/(r21^p − 1), whose right side grows with p.
    let predicted = |p: f64| r21.powf(p) * (r32.powf(p) - 1.0) / (r21.powf(p) - 1.0);
    let ends = (1e-6, MOST);
    if !(predicted(ends.0)..predicted(ends.1)).contains(&ratio) {
        return Err("the values don't approach a limit as a power of h".to_owned());
    }
    let order = root(ends, |p| ratio - predicted(p));
    let index = |fine: f64, coarse: f64, r: f64| SAFETY * ((fine - coarse) / fine).abs() / (r.powf(order) - 1.0);
    Ok(Richardson {
        order,
        extrapolated: f1 + (f1 - f2) / (r21.powf(order) - 1.0),
        gci: index(f1, f2, r21),
        gci_middle: index(f2, f3, r32),
    })
}

/// Richardson's extrapolation from the three finest of some levels, given as (h, value), coarsest
/// first, if they lie in the asymptotic range: the three next coarser levels show the same order
/// within 20 %.
///
/// # Errors
/// Why the asymptotic range can't be claimed.
pub(crate) fn extrapolate(points: &[(f64, f64)]) -> Result<Richardson, String> {
    let [.., d, c, b, a] = *points else {
        return Err("fewer than four levels can't confirm each other".to_owned());
    };
    let (finest, coarser) = (richardson([c, b, a])?, richardson([d, c, b])?);
    if (finest.order - coarser.order).abs() > ORDERS_AGREE * coarser.order {
        return Err(format!(
            "not asymptotic: order {:.2} where the next coarser levels show {:.2}",
            finest.order, coarser.order
        ));
    }
    Ok(finest)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative closeness to as many digits as are printed.
    fn printed(value: f64, print: f64, half_unit: f64) {
        assert!((value - print).abs() <= half_unit, "{value} is not {print}");
    }

    #[test]
    fn a_power_law_is_recovered_exactly() {
        let points = [1.0, 0.5, 0.25, 0.125].map(|h: f64| (h, -3.0 * h.powf(1.7)));
        let order = fit_order(&points).unwrap();
        assert!((order.order - 1.7).abs() < 1e-12 && order.uncertainty < 1e-6);
        assert!(order.local.iter().all(|p| (p - 1.7).abs() < 1e-12));
    }

    #[test]
    fn scatter_widens_the_uncertainty_as_the_t_table_says() {
        // ln e = 2 ln h + (0, δ, 0) over h = 1, ½, ¼: slope 2, its standard error by hand:
        // s² = (2/3) δ² / 1, Sxx = 2 ln²2, t(0.975; 1) = 12.706.
        let d: f64 = 0.01;
        let points = [(1.0, 1.0), (0.5, 0.25 * d.exp()), (0.25, 0.0625)];
        let order = fit_order(&points).unwrap();
        assert!((order.order - 2.0).abs() < 1e-12);
        let by_hand = 12.706 * (2.0 / 3.0 * d * d / (2.0 * 2.0f64.ln().powi(2))).sqrt();
        assert!((order.uncertainty / by_hand - 1.0).abs() < 1e-4);
    }

    #[test]
    fn there_is_no_order_without_a_power_law() {
        assert_eq!(fit_order(&[(1.0, 0.1), (0.5, 0.05)]), None);
        assert_eq!(fit_order(&[(1.0, 0.1), (0.5, -0.05), (0.25, 0.02)]), None);
        assert_eq!(fit_order(&[(1.0, 0.1), (0.5, f64::NAN), (0.25, 0.02)]), None);
        assert_eq!(fit_order(&[(1.0, 0.1), (0.5, 0.0), (0.25, 0.02)]), None);
        assert_eq!(fit_order(&[(1.0, 0.1), (0.5, 0.05), (0.0, 0.02)]), None);
    }

    /// NPARC Alliance, "Examining Spatial (Grid) Convergence": pressure recovery of a supersonic inlet.
    #[test]
    fn the_example_of_the_nparc_tutorial_comes_out() {
        let r = richardson([(4.0, 0.96178), (2.0, 0.96854), (1.0, 0.97050)]).unwrap();
        printed(r.order, 1.786170, 1e-5);
        printed(r.extrapolated, 0.97130, 5e-6);
        printed(r.gci, 0.00103083, 5e-7);
        printed(r.gci_middle, 0.00356249, 5e-7);
        // Its ratio of asymptotic range.
        let ratio = r.gci_middle / (2.0f64.powf(r.order) * r.gci);
        printed(ratio, 1.002020, 5e-6);
    }

    /// Celik et al. (2008), Table 1, first column: grids of 18,000, 8,000 and 4,500 cells in the plane.
    #[test]
    fn the_example_of_celik_et_al_with_uneven_refinement_comes_out() {
        let h = |cells: f64| (1.0 / cells).sqrt();
        let r = richardson([(h(4500.0), 5.863), (h(8000.0), 5.972), (h(18000.0), 6.063)]).unwrap();
        printed(r.order, 1.53, 5e-3);
        printed(r.extrapolated, 6.1685, 5e-5);
        printed(r.gci, 0.022, 5e-4);
    }

    #[test]
    fn oscillation_and_divergence_are_refused() {
        let refused = |points, why: &str| {
            let told = richardson(points).unwrap_err();
            assert!(told.contains(why), "{points:?}: {told}");
        };
        let values = |values: [f64; 3]| [4.0, 2.0, 1.0].map(|h| (h, values[2 - h as usize / 2]));
        refused(values([1.0, 1.2, 1.1]), "monotonically");
        refused(values([1.0, 1.0, 1.0]), "monotonically");
        refused(values([1.0, 1.1, 1.1]), "monotonically");
        refused(values([1.0, 1.1, 1.3]), "don't approach a limit");
        for cells in [[1.0, 2.0, 4.0], [2.0, 1.0, 1.0], [2.0, 2.0, 1.0], [2.0, 1.0, 2.0]] {
            let [a, b, c] = cells;
            refused([(a, 1.0), (b, 1.5), (c, 1.7)], "don't shrink");
        }
    }

    #[test]
    fn the_asymptotic_range_is_claimed_only_with_a_witness() {
        let family = |order: f64, spoilt: f64| {
            [2.0, 1.0, 0.5, 0.25].map(|h: f64| {
                let first = if h == 2.0 { spoilt } else { 0.0 };
                (h, 1.0 + 0.1 * h.powf(order) + first)
            })
        };
        let good = extrapolate(&family(2.0, 0.0)).unwrap();
        assert!((good.order - 2.0).abs() < 1e-9 && (good.extrapolated - 1.0).abs() < 1e-12);
        let why = extrapolate(&family(2.0, 1.0)).unwrap_err();
        assert!(why.contains("not asymptotic"), "{why}");
        assert!(extrapolate(&family(2.0, 0.0)[1..]).is_err());
    }
}
