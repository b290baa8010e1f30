//! Checks of the clouds. The bounds are derived in `docs/sparse.md`.

use super::*;
use crate::cases::manufactured::checks::VORTEX;

/// Order of a noise of the strain that stays as cells shrink.
const OF_NOISE: f64 = 1.0;
/// Relative error of what is linear in the noise: twice the softening of the cloud that others are held against, which is
/// of the order that is left out.
const LEFT_OUT: f64 = 0.25;
/// Angular frequency (rad/s) of the vortex of a body that moves.
const FREQUENCY: f64 = std::f64::consts::PI;
/// Relative error at which nothing is left of the motion.
const LOST: f64 = 1.0;
/// Above this cell size (m) the vortex has too few cells for a mean over them.
const COARSE: f64 = 0.1;

type Cloud<'a> = Run<'a, Sparse>;

impl Cloud<'_> {
    /// Whether theory applies to the scheme.
    fn is_plain(&self) -> bool {
        let four = self.ppc_per_direction >= 2;
        self.is_static() && four && self.basis() == Bspline2 && self.remedy() == RemedyName::None
    }

    fn is_judged(&self) -> bool {
        self.is_plain() && self.h < COARSE
    }

    /// Error of the motion by the dispersion of functions.
    fn bound(&self) -> f64 {
        let number = VORTEX.number(&self.record.parameters);
        let of_cells = DISPERSION * (number * self.h).powi(2);
        // E/ρ is 1 m²/s².
        let speed = (0.5 / (1.0 + self.poisson_ratio)).sqrt();
        let driven = FREQUENCY / (number * speed);
        if self.is_static() { of_cells } else { of_cells / (1.0 - driven * driven).abs() }
    }

    fn about(&self, name: &str) -> String {
        format!("{name} of {} {} {}", self.scheme, self.level, self.set.join(" ")).trim_end().to_owned()
    }

    /// Twelve times the variance of the centre of mass of a cell, of a judged run.
    fn centre(&self) -> Option<f64> {
        self.is_judged().then(|| centre_of(self.layout, self.ppc_per_direction as f64))?
    }

    /// The run of the same scheme and level with another layout and number of particles, all else the same.
    fn like<'a, 'r>(&self, runs: &'a [Cloud<'r>], layout: Layout, per_direction: usize) -> Option<&'a Cloud<'r>> {
        let of_cloud = ["layout", "ppc_per_direction"];
        runs.iter().find(|other| {
            let [own, others] = [self.record, other.record].map(|r| r.changed_beside(&of_cloud));
            (other.scheme, &other.level) == (self.scheme, &self.level)
                && (other.layout, other.ppc_per_direction) == (layout, per_direction)
                && own.eq(others)
        })
    }

    /// The error of the stress that a lattice with as many particles does not have.
    fn noise(&self, runs: &[Cloud]) -> Option<f64> {
        let lattice = self.like(runs, Layout::Lattice, self.ppc_per_direction)?;
        let [own, floor] = [self, lattice].map(|c| c.metric(STRESS_MEDIAN).powi(2));
        Some((own - floor).sqrt())
    }
}

pub(super) fn checks() -> Vec<Check> {
    type Check = CheckOf<Sparse>;
    let is_random = |c: &Cloud| c.layout == Layout::Random;
    vec![
        Check::truth("lattice-second-order", "quasi-static quadratic splines on a lattice of at least four a cell: error of u over three levels of order at least 2 − 0.15")
            .study(|records| {
                let why = "linear fields are reproduced, and the quadrature error of a lattice is of second order";
                at_least(orders(records, |c| c.is_plain() && c.layout == Layout::Lattice), FORMAL, why)
            }),
        Check::truth("noise", "quasi-static quadratic splines from n16: median stress noise over that of random particles, four a cell, as their centres of mass scatter, within a quarter").study(noise),
        Check::truth("softens", "quasi-static quadratic splines, random, n16 and finer: median displacement along the exact one larger than on a lattice of as many particles").study(softens),
        Check::known_limit("no-second-order", "quasi-static quadratic splines, random, four a cell: median error of u over three levels of order at most 1 + 0.15")
            .study(move |records| {
                let why = "the noise of the strain is that of a cell, whatever its size; what it softens is a share of the motion";
                let four = |c: &Cloud| c.is_plain() && is_random(c) && c.ppc_per_direction == 2;
                let found = orders(records, four).into_iter();
                found.map(|(about, order)| Finding::at_most(about, order, OF_NOISE + SLACK, why)).collect()
            }),
        Check::truth("error-bound", "lattice of at least four a cell: error of u at most 0.8 (kh)², k = 6.5/m, moving over 1 − (ω/kc)², c the shear speed")
            .when(|c| c.ppc_per_direction >= 2 && c.layout == Layout::Lattice)
            .at_most(ERROR_MEDIAN, |c| c.bound())
            .because("the largest dispersion among functions and remedies, docs/manufactured.md"),
        Check::known_limit("beyond-bound", "quasi-static quadratic splines, random, four a cell, n16 and finer: median error of u above that of error-bound")
            .when(move |c| c.is_judged() && c.ppc_per_direction == 2 && is_random(c))
            .above(ERROR_MEDIAN, |c| c.bound())
            .because("noise and softening, which fall with h once or not at all"),
        Check::known_limit("one-a-cell", "quasi-static, random, one a cell, all but linear functions: median error of u above u, or half of the clouds break down")
            .when(move |c| c.is_static() && c.ppc_per_direction == 1 && is_random(c) && c.basis() != Linear)
            .above(
                Quantity::new(ERROR_MEDIAN.name, |c: &Cloud| {
                    let error = c.metric(ERROR_MEDIAN);
                    if error.is_nan() { f64::INFINITY } else { error }
                }),
                |_| LOST,
            )
            .because("more unknowns than a point a cell gives strains: soft patterns answer any force"),
    ]
}

/// Twelve times the variance of the centre of mass of a cell's particles along an axis, in cells; none where numbers
/// differ from cell to cell, or where it is fixed.
fn centre_of(layout: Layout, per_direction: f64) -> Option<f64> {
    let n = per_direction * per_direction;
    match layout {
        Layout::Random => Some(1.0 / n),
        Layout::Jittered => Some(1.0 / (n * n)),
        Layout::Holes => Some(1.0 / (n * (n - 1.0))),
        Layout::Lattice | Layout::Scattered => None,
    }
}

fn noise(records: &[Record]) -> Vec<Finding> {
    let runs: Vec<Cloud> = Run::all(records).collect();
    let found = runs.iter().filter_map(|run| {
        let ratio = (run.centre()? / centre_of(Layout::Random, 2.0)?).sqrt();
        let own = run.noise(&runs)? / run.like(&runs, Layout::Random, 2)?.noise(&runs)?;
        let why =
            "a force on nodes is off by the stress times how far the centre of a cell's particles is from its own";
        Some(Finding::within(run.about("noise"), own, ratio, LEFT_OUT * ratio, why))
    });
    found.collect()
}

fn softens(records: &[Record]) -> Vec<Finding> {
    let runs: Vec<Cloud> = Run::all(records).collect();
    let found = runs.iter().filter(|c| c.is_judged() && c.layout == Layout::Random).filter_map(|run| {
        let lattice = run.like(&runs, Layout::Lattice, run.ppc_per_direction)?;
        let why = "strains that answer the noise store less than none: the mean stiffness is that of exact quadrature less their energy";
        Some(Finding::above(run.about(SOFTENING.name), run.metric(SOFTENING), lattice.metric(SOFTENING), why))
    });
    found.collect()
}

/// The orders of the error over the levels of runs that are alike, by name.
fn orders(records: &[Record], judged: impl Fn(&Cloud) -> bool) -> Vec<(String, f64)> {
    let runs: Vec<Cloud> = Run::all(records).collect();
    let orders = orders_from(&runs, judged, "n8", ERROR_MEDIAN);
    orders.map(|(first, order)| (first.about("order"), order.unwrap_or(f64::NAN))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::build::noise;

    /// Twelve times the variance of the mean of `n` numbers of a cell, of many cells.
    fn tried(n: usize, place: impl Fn(usize, usize) -> Option<f64>) -> f64 {
        let cells = 20_000;
        let centre = |c: usize| {
            let of: Vec<f64> = (0..n).filter_map(|k| place(c, k)).collect();
            of.iter().sum::<f64>() / of.len() as f64
        };
        12.0 * (0..cells).map(|c| centre(c).powi(2)).sum::<f64>() / f64::from(cells as u32)
    }

    #[test]
    fn the_centre_of_a_cell_varies_as_theory_says() {
        let chance = |k: usize| 0.5 * noise(k);
        let near = |found: f64, layout, n| {
            let exact = centre_of(layout, n).unwrap();
            assert!((found / exact - 1.0).abs() < 0.05, "{layout:?}: {found} {exact}");
        };
        near(tried(4, |c, k| Some(chance(4 * c + k))), Layout::Random, 2.0);
        // A line of two parts stands for the square: along an axis each part has two of the four.
        let part = |k: usize| 0.5 * (k % 2) as f64 - 0.25;
        near(tried(4, |c, k| Some(part(k) + 0.5 * chance(4 * c + k))), Layout::Jittered, 2.0);
        let lacks = |c: usize| ((chance(c) + 0.5) * 4.0) as usize;
        near(tried(4, |c, k| (k != lacks(c)).then(|| part(k))), Layout::Holes, 2.0);
    }
}
