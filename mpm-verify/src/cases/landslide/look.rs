//! Observations of a slide, and the metrics that follow from them.

use super::*;
use crate::cases::slope::section::Section;

/// Ground that has moved by this share of the height since the release has failed.
const MOVED: f64 = 0.05;
/// Share of the section that must have moved before the slope counts as failed.
const FAILED: f64 = 0.01;
/// Share of the ground beyond the toe of its bulk: single grains run ahead.
const AHEAD: f64 = 0.01;
/// Equivalent plastic strain of a shear band, and how far it falls between two of them.
const BAND: (f64, f64) = (0.5, 0.5);

/// One observation: sums per metre of width; forces are means since the one before.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct State {
    /// Time (s) since the strength was reduced.
    pub(super) time: f64,
    /// The outermost particle and half its spacing (m).
    pub(super) toe: f64,
    /// Beyond here (m) lies a hundredth of the ground.
    pub(super) bulk_toe: f64,
    /// Settlement (m) of the particle at the crest's edge.
    pub(super) settlement: f64,
    /// Energies (J/m).
    pub(super) kinetic: f64,
    pub(super) potential: f64,
    pub(super) stress_work: f64,
    pub(super) stored: f64,
    pub(super) dissipated: f64,
    /// Force on the base, downward (N/m).
    pub(super) base_force: f64,
    /// Share of the section that has failed.
    pub(super) failed: f64,
    /// Distance (m) behind the crest's edge to which the surface has failed.
    pub(super) retrogression: f64,
    /// Number of shear bands at half the height.
    pub(super) bands: f64,
    /// Least and greatest J.
    pub(super) jacobian: (f64, f64),
    /// Rms ln(J/J̄).
    pub(super) log_jacobian_gap: f64,
}

impl State {
    pub(super) fn row(&self) -> Row {
        row! {
            "time (s)": self.time,
            "toe (m)": self.toe,
            "bulk_toe (m)": self.bulk_toe,
            "settlement (m)": self.settlement,
            "kinetic_energy (J/m)": self.kinetic,
            "potential_energy (J/m)": self.potential,
            "stress_work (J/m)": self.stress_work,
            "stored_energy (J/m)": self.stored,
            "plastic_dissipation (J/m)": self.dissipated,
            "base_force (N/m)": self.base_force,
            "failed_share (-)": self.failed,
            "retrogression (m)": self.retrogression,
            "shear_bands (-)": self.bands,
            "jacobian_min (-)": self.jacobian.0,
            "jacobian_max (-)": self.jacobian.1,
            "log_jacobian_gap_rms (-)": self.log_jacobian_gap,
            "energy (J/m)": self.energy(),
            "accounted_energy (J/m)": self.accounted(),
        }
    }

    /// Kinetic and potential energy and the work of the stress (J/m), which a step may lose and never gain.
    fn energy(&self) -> f64 {
        self.kinetic + self.potential + self.stress_work
    }

    /// Kinetic, potential and stored energy and what flow has dissipated (J/m).
    fn accounted(&self) -> f64 {
        self.kinetic + self.potential + self.stored + self.dissipated
    }
}

/// Distance (m) of every particle, now at `positions` (m), from its place at the release.
fn moved_since(released: &[[f64; 2]], positions: &[[f64; 2]]) -> Vec<f64> {
    let distance = |(x, before): (&[f64; 2], &[f64; 2])| (x[0] - before[0]).hypot(x[1] - before[1]);
    positions.iter().zip(released).map(distance).collect()
}

/// The slope at one time: places (m) in the section and equivalent plastic strains in seeding order,
/// columns from x = 0 and in each from the base up, `across` particles at every place.
pub(super) struct Look<'a> {
    pub(super) section: &'a Section,
    pub(super) spacing: f64,
    pub(super) across: usize,
    pub(super) reference: &'a [[f64; 2]],
    pub(super) positions: &'a [[f64; 2]],
    pub(super) plastic_strain: &'a [f64],
}

impl Look<'_> {
    /// Outermost particle and half its spacing (m).
    pub(super) fn toe(&self) -> f64 {
        let outermost = self.positions.iter().map(|x| x[0]).fold(0.0, f64::max);
        outermost + 0.5 * self.spacing
    }

    /// Place (m) beyond which a hundredth of the particles lie.
    pub(super) fn bulk_toe(&self) -> f64 {
        let mut places: Vec<f64> = self.positions.iter().map(|x| x[0]).collect();
        places.sort_by(|a, b| b.total_cmp(a));
        places.get((AHEAD * places.len() as f64) as usize).copied().unwrap_or(f64::NAN)
    }

    /// Places in the columns of the particles in the middle of the width whose reference passes.
    fn in_the_middle(&self, keep: impl Fn(&[f64; 2]) -> bool) -> Vec<usize> {
        let middle = self.across / 2;
        (0..self.reference.len()).filter(|k| k % self.across == middle && keep(&self.reference[*k])).collect()
    }

    /// Settlement (m) of the particle nearest to the crest's edge.
    pub(super) fn settlement(&self) -> f64 {
        let edge = [self.section.crest, self.section.height];
        let distance = |k: &usize| {
            let x = self.reference[*k];
            (x[0] - edge[0]).hypot(x[1] - edge[1])
        };
        let nearest = self.in_the_middle(|_| true).into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.map_or(f64::NAN, |k| self.reference[k][1] - self.positions[k][1])
    }

    /// Share of the particles that have failed since the release.
    pub(super) fn failed(&self, released: &[[f64; 2]]) -> f64 {
        let moved = moved_since(released, self.positions);
        let failed = moved.iter().filter(|d| **d > MOVED * self.section.height);
        failed.count() as f64 / self.positions.len().max(1) as f64
    }

    /// Distance (m) behind the crest's edge to which the surface of the crest has failed.
    pub(super) fn retrogression(&self, released: &[[f64; 2]]) -> f64 {
        let moved = moved_since(released, self.positions);
        let top = self.section.height - 0.75 * self.spacing;
        let surface = self.in_the_middle(|x| x[1] > top && x[0] < self.section.crest);
        let failed = surface.iter().filter(|k| moved.get(**k) > Some(&(MOVED * self.section.height)));
        let rearmost = failed.map(|k| self.reference[*k][0]).fold(f64::INFINITY, f64::min);
        (self.section.crest - rearmost + 0.5 * self.spacing).max(0.0)
    }

    /// Distances (m) behind the crest's edge at which shear bands pass through the ground that was at half the height, from
    /// the rear: peaks of the plastic strain.
    pub(super) fn bands(&self) -> Vec<f64> {
        let half = 0.5 * self.section.height;
        let row = self.in_the_middle(|x| {
            let above = (x[1] - half) / self.spacing;
            above > -0.75 && above <= 0.25
        });
        let strains: Vec<f64> = row.iter().map(|k| self.plastic_strain[*k]).collect();
        let place = |peak: usize| self.section.crest - self.reference[row[peak]][0];
        peaks(&strains).into_iter().map(place).collect()
    }
}

/// Where values have peaks above that of a band, between which they fall to a share of the lower one.
fn peaks(values: &[f64]) -> Vec<usize> {
    let (least, dip) = BAND;
    let mut peaks: Vec<usize> = Vec::new();
    let (mut top, mut bottom) = (f64::INFINITY, 0.0_f64);
    for (k, &value) in values.iter().enumerate() {
        bottom = bottom.min(value);
        if value > least && bottom < dip * value.min(top) {
            // Up from a valley: another peak, of which the height is yet to be seen.
            peaks.push(k);
            (top, bottom) = (value, value);
        } else if let Some(peak) = peaks.last_mut()
            && value > top
        {
            *peak = k;
            (top, bottom) = (value, value);
        }
    }
    peaks
}

/// The series since the release.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Series {
    pub(super) rows: Vec<State>,
}

impl Series {
    /// The observation at `time` (s), if the slide has got there.
    pub(super) fn at(&self, time: f64) -> Option<&State> {
        self.rows.iter().find(|row| (row.time - time).abs() < 1e-6)
    }

    /// Metrics of a slide of `section` that begins with `start`.
    pub(super) fn metrics(&self, section: &Section, start: &State) -> Vec<(Metric, f64)> {
        let runout = |row: &State| row.toe - section.toe();
        let bulk = |row: &State| row.bulk_toe - section.toe();
        let at = |time: f64, f: &dyn Fn(&State) -> f64| self.at(time).map_or(f64::NAN, f);
        let end = |f: &dyn Fn(&State) -> f64| self.rows.last().map_or(f64::NAN, f);
        let all = |f: fn(&State) -> f64| self.rows.iter().map(f);
        let failure = self.rows.iter().find(|row| row.failed >= FAILED);
        let energies = || std::iter::once(start).chain(&self.rows).map(State::energy);
        let falls = end(&|row| start.potential - row.potential);
        let gains = || energies().zip(energies().skip(1)).map(|(a, b)| b - a);
        vec![
            (RUNOUT_1S, at(1.0, &runout)),
            (RUNOUT_2_5S, at(2.5, &runout)),
            (RUNOUT_END, end(&runout)),
            (BULK_RUNOUT_2_5S, at(2.5, &bulk)),
            (BULK_RUNOUT_END, end(&bulk)),
            (SETTLEMENT_AT_REST, start.settlement),
            (SETTLEMENT_2_5S, at(2.5, &|row| row.settlement)),
            (SETTLEMENT_END, end(&|row| row.settlement)),
            (FAILED_SHARE_2_5S, at(2.5, &|row| row.failed)),
            (FAILED_SHARE_END, end(&|row| row.failed)),
            (FAILURE_TIME, failure.map_or(f64::NAN, |row| row.time)),
            (RETROGRESSION_END, end(&|row| row.retrogression)),
            (SHEAR_BANDS_END, end(&|row| row.bands)),
            (PLASTIC_DISSIPATION, end(&|row| row.dissipated - start.dissipated)),
            (KINETIC_ENERGY_MAX, all(|row| row.kinetic).fold(0.0, f64::max)),
            (ENERGY_GAIN, gains().fold(0.0, f64::max) / start.potential),
            (UNACCOUNTED_ENERGY, end(&|row| (row.accounted() - start.accounted()) / start.potential)),
            (FALLEN_ENERGY, falls / start.potential),
            (JACOBIAN_MIN, all(|row| row.jacobian.0).fold(f64::INFINITY, f64::min)),
            (JACOBIAN_MAX, all(|row| row.jacobian.1).fold(0.0, f64::max)),
            (LOG_JACOBIAN_GAP, end(&|row| row.log_jacobian_gap)),
        ]
    }
}

/// Largest range, over the width, of the distances `moved` (m) of the particles of one place, over the largest of these
/// distances. Zero in plane strain.
pub(super) fn spread_over_width(moved: &[f64], across: usize) -> f64 {
    let most = moved.iter().copied().fold(0.0, f64::max);
    let range = |place: &[f64]| {
        let ends = place.iter().fold((f64::INFINITY, 0.0_f64), |(lo, hi), d| (lo.min(*d), hi.max(*d)));
        ends.1 - ends.0
    };
    moved.chunks(across).map(range).fold(0.0, f64::max) / most
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peaks_are_told_apart_by_the_valleys_between_them() {
        let none: [usize; 0] = [];
        assert_eq!(peaks(&[]), none);
        assert_eq!(peaks(&[0.1, 0.2, 0.1]), none);
        assert_eq!(peaks(&[0.0, 1.0, 2.0, 1.9, 2.5, 0.1]), [4]);
        assert_eq!(peaks(&[0.0, 2.0, 0.1, 0.0, 0.7, 3.0, 0.2, 1.0]), [1, 5, 7]);
        // A peak that stands on the shoulder of another is part of it.
        assert_eq!(peaks(&[2.0, 1.2, 2.0]), [0]);
    }

    #[test]
    fn what_differs_over_the_width_is_seen() {
        assert_eq!(spread_over_width(&[1.0, 1.0, 2.0, 2.0], 2), 0.0);
        assert_eq!(spread_over_width(&[1.0, 1.0, 2.0, 1.5], 2), 0.25);
    }

    fn slope() -> (Section, Vec<[f64; 2]>) {
        let section = Section { height: 5.0, crest: 10.0, run: 5.0 };
        (section, section.seed(0.1))
    }

    #[test]
    fn a_corner_that_slides_off_is_what_has_failed() {
        let (section, reference) = slope();
        let released = reference.clone();
        // Everything right of x = 8 m goes down and out; along that line it is sheared.
        let slides = |x: &[f64; 2]| x[0] > 8.0;
        let positions: Vec<[f64; 2]> =
            (reference.iter()).map(|x| if slides(x) { [x[0] + 1.0, x[1] - 0.5] } else { *x }).collect();
        let strain: Vec<f64> = (reference.iter()).map(|x| if (x[0] - 8.0).abs() < 0.2 { 1.0 } else { 0.0 }).collect();
        let look = Look {
            section: &section,
            spacing: 0.1,
            across: 1,
            reference: &reference,
            positions: &positions,
            plastic_strain: &strain,
        };
        assert!((look.toe() - 15.95).abs() < 0.06, "{}", look.toe());
        // The columns below a face of 45° hold 1, 2, 3 … particles: ten of them 55, eleven 66. The
        // hundredth part of 6225 particles ends in the eleventh.
        let bulk = look.bulk_toe();
        assert_eq!(positions.iter().filter(|x| x[0] > bulk).count(), 55);
        assert_eq!(positions.iter().filter(|x| x[0] >= bulk).count(), 66);
        assert!((look.settlement() - 0.5).abs() < 1e-9);
        assert!((look.retrogression(&released) - 2.0).abs() < 0.06);
        let [band] = look.bands()[..] else { panic!("{:?}", look.bands()) };
        assert!((band - 2.0).abs() < 0.2, "{band}");
        let failed = look.failed(&released) * 62.5;
        assert!((failed - 22.5).abs() < 0.5, "{failed}");
    }
}
