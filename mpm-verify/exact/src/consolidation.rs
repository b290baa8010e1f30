//! The reference: `references/consolidation.py`, at stated loads and steps.

use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

const TABLE: &str = include_str!("../references/consolidation.csv");

/// T from which on errors are taken.
const FROM: f64 = 0.1;

/// A solution at a time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct At {
    /// T = c_v t/H².
    pub t: f64,
    /// Settlement over H.
    pub settlement: f64,
    /// Pressure at the base over the load.
    pub base: f64,
}

struct Row {
    load: f64,
    refine: f64,
    at: At,
}

static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| {
    let row = |line: &str| {
        let numbers = line.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>();
        let [load, refine, t, settlement, base, _] = numbers.ok()?[..] else {
            return None;
        };
        let at = At { t, settlement, base };
        Some(Row { load, refine, at })
    };
    TABLE.lines().skip(1).filter_map(row).collect()
});

/// The solution of a load (over M₀) at its tabulated times from T = 0.1 on: the exact one, or exact in space alone for
/// backward Euler's steps, `steps` to each of the 125. Empty for a load without a reference.
pub fn solution(load: f64, steps: Option<f64>) -> Vec<At> {
    let refine = steps.unwrap_or(0.0);
    let own = |r: &&Row| r.load == load && r.refine == refine && r.at.t >= FROM;
    ROWS.iter().filter(own).map(|r| r.at).collect()
}

/// Heights (m) over which κ/J changes by the factor e at the drained top at T = 0.1, from the reference's program.
const LAYERS: [(f64, f64); 3] = [(0.003, 39.76), (0.3, 0.2986), (1.0, 0.0634)];

/// The layer of a load, if it is known.
pub fn layer(load: f64) -> Option<f64> {
    let known = LAYERS.iter().find(|(of, _)| *of == load);
    known.map(|(_, height)| *height)
}

/// The value of `seen` at the time `t`: the cubic through the two before and the two after it.
pub fn between(seen: &[At], t: f64) -> Option<At> {
    let next = seen.partition_point(|at| at.t < t);
    let middle = next.clamp(2, seen.len().checked_sub(2)?.max(2));
    let near = seen.get(middle - 2..middle + 2)?;
    let mut sum = At { t, settlement: 0.0, base: 0.0 };
    for a in near {
        let others = near.iter().filter(|b| b.t != a.t);
        let weight: f64 = others.map(|b| (t - b.t) / (a.t - b.t)).product();
        sum.settlement += weight * a.settlement;
        sum.base += weight * a.base;
    }
    Some(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of another program, with other methods, at 0.3 M₀.
    const OTHER: [(f64, f64, f64); 8] = [
        (0.1, 0.058_816_822_224, 0.984_287_135_4),
        (0.2, 0.088_710_585_872, 0.880_538_425_8),
        (0.3, 0.110_276_798_814, 0.756_768_188_0),
        (0.5, 0.140_431_911_886, 0.541_955_979_7),
        (0.75, 0.163_154_196_433, 0.346_328_464_7),
        (1.0, 0.176_294_819_895, 0.216_285_131_2),
        (1.5, 0.188_554_262_289, 0.080_999_972_6),
        (2.0, 0.192_877_668_473, 0.029_552_332_6),
    ];

    #[test]
    fn the_table_has_every_load_and_agrees_with_another_program() {
        for load in [0.003, 0.3, 1.0] {
            for steps in [None, Some(1.0), Some(2.0), Some(4.0), Some(8.0)] {
                assert_eq!(solution(load, steps).len(), OTHER.len(), "{load} {steps:?}");
            }
        }
        for (own, (t, settlement, base)) in solution(0.3, None).iter().zip(OTHER) {
            assert_eq!(own.t, t);
            assert!((own.settlement - settlement).abs() < 1e-8, "{own:?}");
            assert!((own.base - base).abs() < 1e-7, "{own:?}");
        }
        assert!(solution(0.2, None).is_empty() && solution(0.3, Some(3.0)).is_empty());
    }

    /// Backward Euler's error is of first order: a half as many steps, a half of it.
    #[test]
    fn the_steps_tend_to_the_exact_solution() {
        for load in [0.003, 0.3, 1.0] {
            let error = |steps| {
                let own = solution(load, Some(steps));
                let exact = solution(load, None);
                (own.iter().zip(exact))
                    .fold(0.0_f64, |most, (own, exact)| most.max((own.settlement / exact.settlement - 1.0).abs()))
            };
            let ratio = error(4.0) / error(8.0);
            assert!((ratio - 2.0).abs() < 0.05, "{load}: {ratio}");
        }
    }

    /// At a small load it is the linear theory's: q H/M₀ times the degree of consolidation under a load that grows
    /// until T = 0.05, less the finite part of a load of 0.003.
    #[test]
    fn a_small_load_settles_as_the_linear_theory_says() {
        let (ramp, parts) = (0.05, 2000);
        for at in solution(0.003, None) {
            let of_part = |k: u32| {
                let begun = ramp * (f64::from(k) + 0.5) / f64::from(parts);
                crate::terzaghi::settlement(at.t - begun) / f64::from(parts)
            };
            let linear = 0.003 * (0..parts).map(of_part).sum::<f64>();
            assert!((at.settlement / linear - 1.0).abs() < 0.02, "{at:?} {linear}");
        }
    }

    #[test]
    fn a_cubic_is_met_between_its_values() {
        let of = |t: f64| At { t, settlement: t.powi(3) - t, base: 2.0 - t * t };
        let seen: Vec<At> = [0.1, 0.25, 0.4, 0.7, 1.1, 2.0].map(of).into();
        for t in [0.12, 0.4, 0.5, 1.9, 2.0] {
            let found = between(&seen, t).unwrap();
            assert!((found.settlement - of(t).settlement).abs() < 1e-14);
            assert!((found.base - of(t).base).abs() < 1e-14);
        }
        assert!(between(&seen[..3], 0.2).is_none());
    }
}
