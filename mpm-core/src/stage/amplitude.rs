//! A factor over time of what acts: of a load, or of a prescribed velocity.

use crate::error::{Error, require};
use std::sync::Arc;

/// The factor over time (s) by which a load or a prescribed velocity acts.
#[derive(Debug, Clone, PartialEq)]
pub enum Amplitude {
    /// Rises from zero at time zero to one at this time (s) as 3 s² − 2 s³; one after it, and always where it is zero.
    Rise(f64),
    /// Linear between the knots of a table, see [`Amplitude::table`].
    Table(Knots),
}

/// Knots of a table: time (s), factor, and integral of the factor since time zero (s).
#[derive(Debug, Clone, PartialEq)]
pub struct Knots(Arc<[[f64; 3]]>);

impl Amplitude {
    /// Linear between `knots` of time (s) and factor; before the first and after the last knot the factor is theirs.
    ///
    /// # Errors
    /// No knot, a time that is negative or not after the one before it, a number that is not finite.
    pub fn table(knots: &[[f64; 2]]) -> Result<Self, Error> {
        require(!knots.is_empty(), "knots of an amplitude", 0.0, "1 or more")?;
        let mut all: Vec<[f64; 3]> = Vec::with_capacity(knots.len());
        for &[time, factor] in knots {
            let last = all.last().copied();
            require(
                last.is_none_or(|[t, ..]| time > t) && time >= 0.0,
                "time of an amplitude",
                time,
                "rising from 0 (s)",
            )?;
            require(true, "factor of an amplitude", factor, "finite")?;
            let integral = last.map_or(time * factor, |[t, f, sum]| sum + 0.5 * (time - t) * (f + factor));
            all.push([time, factor, integral]);
        }
        Ok(Self::Table(Knots(all.into())))
    }

    /// The factor at `time` (s).
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Self::Rise(rise) if time >= *rise => 1.0,
            Self::Rise(rise) => {
                let s = time / rise;
                s * s * (3.0 - 2.0 * s)
            }
            Self::Table(knots) => knots.at(time)[0],
        }
    }

    /// The exact integral (s) of the factor since time zero, of a velocity its stroke; zero before.
    pub fn integral(&self, time: f64) -> f64 {
        if time <= 0.0 {
            return 0.0;
        }
        match self {
            Self::Rise(rise) if time >= *rise => time - 0.5 * rise,
            Self::Rise(rise) => {
                let s = time / rise;
                rise * s * s * s * (1.0 - 0.5 * s)
            }
            Self::Table(knots) => knots.at(time)[1],
        }
    }

    /// The greatest size (s) of the [`integral`](Self::integral) until `time` (s).
    pub fn farthest(&self, time: f64) -> f64 {
        let turns = match self {
            Self::Rise(_) => &[][..],
            Self::Table(Knots(knots)) => knots,
        };
        let zeros = turns.windows(2).filter(|pair| pair[0][1] * pair[1][1] < 0.0).map(|pair| {
            let [[t, f, _], [next, g, _]] = [pair[0], pair[1]];
            t + (next - t) * f / (f - g)
        });
        let ends = turns.iter().map(|[t, ..]| *t).chain(zeros).filter(|t| *t < time).chain([time]);
        ends.map(|t| self.integral(t).abs()).fold(0.0, f64::max)
    }
}

impl Knots {
    /// Factor and its integral (s) at `time` (s).
    fn at(&self, time: f64) -> [f64; 2] {
        let after = self.0.partition_point(|[t, ..]| *t <= time);
        let Some([t, f, sum]) = self.0.get(after.saturating_sub(1)).copied() else { return [0.0; 2] };
        let slope = match self.0.get(after) {
            Some([next, g, _]) if after > 0 => (g - f) / (next - t),
            _ => 0.0,
        };
        let since = time - t;
        [f + slope * since, sum + since * (f + 0.5 * slope * since)]
    }
}
