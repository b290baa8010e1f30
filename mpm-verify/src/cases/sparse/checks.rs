//! What is checked of the clouds. The bounds are derived in `docs/sparse.md`.

use super::metrics as m;
use super::parameters::{
    HOLES, JITTERED, LATTICE, LAYOUT, POISSON_RATIO, PPC_PER_DIRECTION, RANDOM,
};
use crate::accuracy::fit_order;
use crate::cases::manufactured::checks::VORTEX;
use crate::check::{Check, Finding, judge, run, study};
use crate::record::Record;
use crate::scheme::{BasisName, RemedyName, RuleName};

/// Formal order of functions that reproduce linear fields, and what an observed one may lack of it.
const FORMAL: f64 = 2.0;
const SLACK: f64 = 0.15;
/// Order of a noise of the strain that stays as cells shrink.
const OF_NOISE: f64 = 1.0;
/// Relative error of what is linear in the noise: twice the softening of the cloud that others are held against, which is
/// of the order that is left out.
const LEFT_OUT: f64 = 0.25;
/// Largest relative error over (kh)²: `docs/manufactured.md`.
const DISPERSION: f64 = 0.8;
/// Angular frequency (rad/s) of the vortex of a body that moves.
const FREQUENCY: f64 = std::f64::consts::PI;
/// Relative error at which nothing is left of the motion.
const LOST: f64 = 1.0;
/// Above this cell size (m) the vortex has too few cells for a mean over them.
const COARSE: f64 = 0.1;

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check::truth(
            "lattice-second-order",
            "quadratic splines in equilibrium on a lattice of at least four a cell: order of the error of u over the three levels at least 2 − 0.15",
            study(|records| {
                let judged = |r: &Record| is_plain(r) && r.parameters.is(LAYOUT, LATTICE);
                orders(records, judged)
                    .map(|(about, order)| {
                        let why = "linear fields are reproduced, and the quadrature error of a lattice is of second order";
                        Finding::above(about, order, FORMAL - SLACK, why)
                    })
                    .collect()
            }),
        ),
        Check::truth(
            "noise",
            "quadratic splines in equilibrium, n16 and finer: the median noise of the stress of each layout is to that of random, four a cell, as the root of the variances of a cell's centre of mass, within a quarter",
            study(|records| {
                let found = records.iter().filter_map(|r| {
                    let ratio = (centre(r)? / centre_of(RANDOM, 2.0)?).sqrt();
                    let own = noise(r, records)? / noise(like(r, records, RANDOM, 2.0)?, records)?;
                    let why = "a force on nodes is off by the stress times how far the centre of a cell's particles is from its own";
                    Some(Finding::within(about("noise", r), own, ratio, LEFT_OUT * ratio, why))
                });
                found.collect()
            }),
        ),
        Check::truth(
            "softens",
            "quadratic splines in equilibrium, random, n16 and finer: the median displacement along the exact one is larger than on a lattice with as many",
            study(|records| {
                let judged = records
                    .iter()
                    .filter(|r| is_judged(r) && r.parameters.is(LAYOUT, RANDOM));
                let found = judged.filter_map(|r| {
                    let n = r.parameters.number(PPC_PER_DIRECTION);
                    let lattice = like(r, records, LATTICE, n)?;
                    let why = "strains that answer the noise store less than none: the mean stiffness is that of exact quadrature less their energy";
                    let bound = lattice.metric(m::SOFTENING);
                    Some(Finding::above(about(m::SOFTENING.name, r), r.metric(m::SOFTENING), bound, why))
                });
                found.collect()
            }),
        ),
        Check::known_limit(
            "no-second-order",
            "quadratic splines in equilibrium, random, four a cell: order of the median error of u over the three levels at most 1 + 0.15",
            study(|records| {
                let four = |r: &Record| {
                    let random = r.parameters.is(LAYOUT, RANDOM);
                    is_plain(r) && random && r.parameters.number(PPC_PER_DIRECTION) == 2.0
                };
                orders(records, four)
                    .map(|(about, order)| {
                        let why = "the noise of the strain is that of a cell, whatever its size; what it softens is a share of the motion";
                        Finding::at_most(about, order, OF_NOISE + SLACK, why)
                    })
                    .collect()
            }),
        ),
        Check::truth(
            "error-bound",
            "on a lattice of at least four a cell: the error of u is at most 0.8 (kh)², k = 6.5/m the wave number of the vortex; of a body that moves 1/(1 − (ω/kc)²) times that, c the speed of shear waves",
            run(|r| {
                let four = r.parameters.number(PPC_PER_DIRECTION) >= 2.0;
                let why =
                    "the largest dispersion among functions and remedies, docs/manufactured.md";
                (four && r.parameters.is(LAYOUT, LATTICE))
                    .then(|| judge(r, m::ERROR_MEDIAN).at_most(bound(r), why))
            }),
        ),
        Check::known_limit(
            "beyond-bound",
            "quadratic splines in equilibrium, random, four a cell, n16 and finer: the median error of u is above that",
            run(|r| {
                let four = r.parameters.number(PPC_PER_DIRECTION) == 2.0;
                let why = "noise and softening, which fall with h once or not at all";
                (is_judged(r) && four && r.parameters.is(LAYOUT, RANDOM))
                    .then(|| judge(r, m::ERROR_MEDIAN).above(bound(r), why))
            }),
        ),
        Check::known_limit(
            "one-a-cell",
            "in equilibrium, random, one a cell, all but linear functions: the median error of u is larger than u, or half of the clouds break down",
            run(|r| {
                let one = r.parameters.number(PPC_PER_DIRECTION) == 1.0;
                let judged = is_static(r) && one && r.parameters.is(LAYOUT, RANDOM);
                let why = "more unknowns than a point a cell gives strains: soft patterns answer any force";
                let error = r.metric(m::ERROR_MEDIAN);
                let error = if error.is_nan() { f64::INFINITY } else { error };
                (judged && r.basis() != BasisName::Linear)
                    .then(|| Finding::above(m::ERROR_MEDIAN.name, error, LOST, why))
            }),
        ),
    ]
}

/// What the dispersion of functions leaves of the motion.
fn bound(r: &Record) -> f64 {
    let number = (VORTEX.number)(&r.parameters);
    let of_cells = DISPERSION * (number * r.discretisation.h).powi(2);
    // E/ρ is 1 m²/s².
    let speed = (0.5 / (1.0 + r.parameters.number(POISSON_RATIO))).sqrt();
    let driven = FREQUENCY / (number * speed);
    match is_static(r) {
        true => of_cells,
        false => of_cells / (1.0 - driven * driven).abs(),
    }
}

fn is_static(r: &Record) -> bool {
    r.scheme().rule() == Some(RuleName::QuasiStatic)
}

/// Runs of the scheme that theory speaks of.
fn is_plain(r: &Record) -> bool {
    let four = r.parameters.number(PPC_PER_DIRECTION) >= 2.0;
    is_static(r) && four && r.basis() == BasisName::Bspline2 && r.remedy() == RemedyName::None
}

fn is_judged(r: &Record) -> bool {
    is_plain(r) && r.discretisation.h < COARSE
}

fn about(what: &str, r: &Record) -> String {
    let text = format!("{what} of {} {} {}", r.scheme(), r.level, r.set.join(" "));
    text.trim_end().to_owned()
}

/// Twelve times the variance of the centre of mass of a cell's particles along an axis, in cells; none where numbers
/// differ from cell to cell, or where it is fixed.
fn centre_of(layout: &str, per_direction: f64) -> Option<f64> {
    let n = per_direction * per_direction;
    match layout {
        RANDOM => Some(1.0 / n),
        JITTERED => Some(1.0 / (n * n)),
        HOLES => Some(1.0 / (n * (n - 1.0))),
        _ => None,
    }
}

/// That of a judged run.
fn centre(r: &Record) -> Option<f64> {
    let layout = r.parameters.text(LAYOUT);
    let judged = is_judged(r).then(|| r.parameters.number(PPC_PER_DIRECTION))?;
    centre_of(&layout, judged)
}

/// The run of the same scheme and level with another layout and number of particles, all else the same.
fn like<'a>(
    r: &Record,
    records: &'a [Record],
    layout: &str,
    per_direction: f64,
) -> Option<&'a Record> {
    let others = |r: &Record| -> Vec<String> {
        let changed =
            |s: &&String| !s.starts_with("layout=") && !s.starts_with("ppc_per_direction=");
        r.set.iter().filter(changed).cloned().collect()
    };
    records.iter().find(|o| {
        o.scheme() == r.scheme()
            && o.level == r.level
            && o.parameters.is(LAYOUT, layout)
            && o.parameters.number(PPC_PER_DIRECTION) == per_direction
            && others(o) == others(r)
    })
}

/// The error of the stress that a lattice with as many particles doesn't have.
fn noise(r: &Record, records: &[Record]) -> Option<f64> {
    let lattice = like(r, records, LATTICE, r.parameters.number(PPC_PER_DIRECTION))?;
    let [own, floor] = [r, lattice].map(|r| r.metric(m::STRESS_MEDIAN).powi(2));
    Some((own - floor).sqrt())
}

/// The orders of the error over the levels of runs that are alike.
fn orders<'a>(
    records: &'a [Record],
    judged: impl Fn(&Record) -> bool + 'a,
) -> impl Iterator<Item = (String, f64)> + 'a {
    let firsts = records.iter().filter(move |r| judged(r) && r.level == "n8");
    firsts.filter_map(|first| {
        let same = |r: &&Record| r.scheme() == first.scheme() && r.set == first.set;
        let runs: Vec<&Record> = records.iter().filter(same).collect();
        let points = runs
            .iter()
            .map(|r| (r.discretisation.h, r.metric(m::ERROR_MEDIAN)));
        let order = fit_order(&points.collect::<Vec<_>>())?.order;
        (runs.len() >= 3).then(|| (about("order", first), order))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::noise::noise;

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
            assert!(
                (found / exact - 1.0).abs() < 0.05,
                "{layout}: {found} {exact}"
            );
        };
        near(tried(4, |c, k| Some(chance(4 * c + k))), RANDOM, 2.0);
        // A line of two parts stands for the square: along an axis each part has two of the four.
        let part = |k: usize| 0.5 * (k % 2) as f64 - 0.25;
        near(
            tried(4, |c, k| Some(part(k) + 0.5 * chance(4 * c + k))),
            JITTERED,
            2.0,
        );
        let lacks = |c: usize| ((chance(c) + 0.5) * 4.0) as usize;
        near(
            tried(4, |c, k| (k != lacks(c)).then(|| part(k))),
            HOLES,
            2.0,
        );
    }
}
