//! What is observed of the flow, and the metrics made of it.

use super::metrics as m;
use super::reference::{COMPARED, TANK, energies, front, passage, time_scale};
use crate::metric::Metric;
use crate::statistics::rms;
use serde::{Deserialize, Serialize};

/// The state behind the gate, just before it is removed.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Start {
    /// Forces (N/m) on the floor, downward, and on gate and back wall, outward.
    pub(super) base_reaction: f64,
    pub(super) gate_force: f64,
    pub(super) back_force: f64,
    /// Pressure (Pa) at the floor.
    pub(super) base_pressure: f64,
    /// Rms over the particles of the pressure less the hydrostatic one, over that at the floor.
    pub(super) profile_error: f64,
    /// Kinetic energy (J/m).
    pub(super) kinetic_energy: f64,
}

impl Start {
    pub(super) fn metrics(&self, weight: f64) -> Vec<(Metric, f64)> {
        vec![
            (m::BASE_REACTION_RATIO, self.base_reaction / weight),
            (m::GATE_FORCE, self.gate_force),
            (m::BACK_FORCE, self.back_force),
            (m::BASE_PRESSURE, self.base_pressure),
            (m::PRESSURE_PROFILE_ERROR, self.profile_error),
            (m::START_KINETIC_ENERGY, self.kinetic_energy),
        ]
    }
}

/// One observation; forces are means since the one before.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Row {
    /// Time (s) since the gate was removed.
    pub(super) time: f64,
    /// The outermost particle and half its spacing (m).
    pub(super) front: f64,
    /// The highest particle within a cell of the back wall and half its spacing (m).
    pub(super) back_level: f64,
    /// Centre of mass (m).
    pub(super) centre: [f64; 2],
    /// Energies (J/m).
    pub(super) kinetic: f64,
    pub(super) potential: f64,
    pub(super) stress_work: f64,
    pub(super) stored: f64,
    /// Forces (N/m) on the floor, downward, and on the walls, outward.
    pub(super) floor_force: f64,
    pub(super) back_force: f64,
    pub(super) front_force: f64,
    /// Rms (Pa) of the pressure, and of what its average changes.
    pub(super) pressure_rms: f64,
    pub(super) checkerboard_rms: f64,
    /// Share of the particles in tension.
    pub(super) tension: f64,
    /// Area (m²) under the highest particles.
    pub(super) covered: f64,
    /// Least and greatest J.
    pub(super) jacobian: (f64, f64),
    /// Rms ln(J/J̄).
    pub(super) log_jacobian_gap: f64,
}

/// A column of the series: its name with unit, and its value in a row.
type Column = (&'static str, fn(&Row) -> f64);

impl Row {
    /// Columns of the series, with units.
    pub(super) const COLUMNS: [Column; 19] = [
        ("time (s)", |r| r.time),
        ("front (m)", |r| r.front),
        ("back_level (m)", |r| r.back_level),
        ("centre_x (m)", |r| r.centre[0]),
        ("centre_y (m)", |r| r.centre[1]),
        ("kinetic_energy (J/m)", |r| r.kinetic),
        ("potential_energy (J/m)", |r| r.potential),
        ("stress_work (J/m)", |r| r.stress_work),
        ("energy (J/m)", Self::energy),
        ("stored_energy (J/m)", |r| r.stored),
        ("floor_force (N/m)", |r| r.floor_force),
        ("back_force (N/m)", |r| r.back_force),
        ("front_force (N/m)", |r| r.front_force),
        ("pressure_rms (Pa)", |r| r.pressure_rms),
        ("checkerboard_rms (Pa)", |r| r.checkerboard_rms),
        ("tension (-)", |r| r.tension),
        ("covered (m²)", |r| r.covered),
        ("jacobian_min (-)", |r| r.jacobian.0),
        ("jacobian_max (-)", |r| r.jacobian.1),
    ];

    pub(super) fn values(&self) -> Vec<f64> {
        Self::COLUMNS.map(|(_, value)| value(self)).to_vec()
    }

    /// Kinetic and potential energy (J/m).
    fn motion(&self) -> f64 {
        self.kinetic + self.potential
    }

    /// With the work of the stress (J/m): what a step may lose and not gain.
    fn energy(&self) -> f64 {
        self.motion() + self.stress_work
    }
}

/// The flow so far, since the gate was removed.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Flow {
    pub(super) rows: Vec<Row>,
}

impl Flow {
    /// The observation nearest to `time` (s), if the flow has got there.
    fn at(&self, time: f64) -> Option<&Row> {
        self.rows.iter().find(|row| (row.time - time).abs() < 1e-6)
    }

    /// Distances (m) of the front from the inviscid one while they are compared, if the flow has got so far.
    fn front_errors(&self) -> Vec<f64> {
        let (from, to) = (COMPARED.0 * time_scale(), COMPARED.1 * time_scale());
        if self.rows.last().is_none_or(|row| row.time < to) {
            return Vec::new();
        }
        (self.rows.iter())
            .filter(|row| (from..=to).contains(&row.time))
            .filter_map(|row| Some(row.front - front(row.time)?))
            .collect()
    }

    /// When (s) the front passes `x` (m).
    fn arrival(&self, x: f64) -> f64 {
        let passes = |pair: &&[Row]| pair[0].front < x && pair[1].front >= x;
        self.rows.windows(2).find(passes).map_or(f64::NAN, |pair| {
            let share = (x - pair[0].front) / (pair[1].front - pair[0].front);
            pair[0].time + share * (pair[1].time - pair[0].time)
        })
    }

    /// Mean from the removal of the gate to `time` (s); NaN if the flow has not got there.
    fn mean(&self, time: f64, f: impl Fn(&Row) -> f64) -> f64 {
        if self.at(time).is_none() {
            return f64::NAN;
        }
        let values: Vec<f64> = (self.rows.iter())
            .filter(|row| row.time < time + 1e-6)
            .map(f)
            .collect();
        values.iter().sum::<f64>() / values.len() as f64
    }

    /// Metrics of water of a density, on cells of size `h` (m).
    pub(super) fn metrics(&self, density: f64, h: f64) -> Vec<(Metric, f64)> {
        let at = |time: f64, f: fn(&Row) -> f64| self.at(time).map_or(f64::NAN, f);
        let (at_start, _) = energies(density);
        let errors = self.front_errors();
        let near_end = TANK - 2.0 * h;
        let arrival = self.arrival(near_end);
        let until = |row: &Row| row.front < near_end;
        let speeds = (self.rows.windows(2))
            .filter(|pair| until(&pair[1]))
            .map(|pair| (pair[1].front - pair[0].front) / (pair[1].time - pair[0].time));
        let energy: Vec<f64> = std::iter::once(at_start)
            .chain(self.rows.iter().map(Row::energy))
            .collect();
        let motion = || {
            let rows = self.rows.iter().map(Row::motion);
            std::iter::once(at_start).chain(rows)
        };
        let gains = energy.windows(2).map(|pair| pair[1] - pair[0]);
        let all = |f: fn(&Row) -> f64| self.rows.iter().map(f);
        vec![
            (m::FRONT_X_EARLY, at(0.4, |r| r.front)),
            (m::FRONT_RMS_ERROR, rms(errors)),
            (m::FRONT_SPEED_MAX, speeds.fold(0.0, f64::max)),
            (m::ARRIVAL_TIME, arrival),
            (
                m::ARRIVAL_ERROR,
                passage(near_end).map_or(f64::NAN, |(time, _)| (arrival - time).abs()),
            ),
            (m::BACK_LEVEL_EARLY, at(0.4, |r| r.back_level)),
            (m::ENERGY_RATIO, at(0.4, Row::energy) / at_start),
            (m::ENERGY_RATIO_2S, at(2.0, Row::energy) / at_start),
            (m::ENERGY_GAIN, gains.fold(0.0, f64::max) / at_start),
            (
                m::ENERGY_EXCESS,
                energy.iter().copied().fold(0.0, f64::max) / at_start - 1.0,
            ),
            (m::MOTION_RATIO_2S, at(2.0, Row::motion) / at_start),
            (
                m::MOTION_EXCESS,
                motion().fold(0.0, f64::max) / at_start - 1.0,
            ),
            (
                m::MOTION_LOSS,
                1.0 - motion().fold(f64::INFINITY, f64::min) / at_start,
            ),
            (m::PRESSURE_RMS, at(0.4, |r| r.pressure_rms)),
            (m::CHECKERBOARD_RMS, at(0.4, |r| r.checkerboard_rms)),
            (m::TENSION_SHARE, at(0.4, |r| r.tension)),
            (m::COVERED_EARLY, at(0.4, |r| r.covered)),
            (m::CENTRE_X_EARLY, at(0.4, |r| r.centre[0])),
            (m::CENTRE_X_MEAN, self.mean(2.0, |r| r.centre[0])),
            (m::CENTRE_Y_MEAN, self.mean(2.0, |r| r.centre[1])),
            (m::WALL_IMPULSE, 2.0 * self.mean(2.0, |r| r.front_force)),
            (
                m::JACOBIAN_MIN,
                all(|r| r.jacobian.0).fold(f64::INFINITY, f64::min),
            ),
            (m::JACOBIAN_MAX, all(|r| r.jacobian.1).fold(0.0, f64::max)),
            (m::LOG_JACOBIAN_GAP, at(0.4, |r| r.log_jacobian_gap)),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A front that follows the inviscid one `off` (m) ahead, in water that loses a thousandth of its energy.
    fn flow(off: f64) -> Flow {
        let row = |k: u32| {
            let time = 0.005 * f64::from(k);
            Row {
                time,
                front: front(time).map_or(4.0, |x| x + off),
                potential: 0.999 * energies(997.5).0,
                ..Row::default()
            }
        };
        Flow {
            rows: (1..=100).map(row).collect(),
        }
    }

    fn metric(flow: &Flow, of: Metric) -> f64 {
        let metrics = flow.metrics(997.5, 0.25);
        metrics.iter().find(|(m, _)| *m == of).unwrap().1
    }

    #[test]
    fn the_inviscid_front_has_no_error_and_another_its_distance() {
        assert!(metric(&flow(0.0), m::FRONT_RMS_ERROR) < 1e-12);
        assert!((metric(&flow(0.1), m::FRONT_RMS_ERROR) - 0.1).abs() < 1e-12);
        assert!(metric(&flow(0.0), m::ARRIVAL_ERROR) < 1e-5);
        let (_, speed) = passage(5.5).unwrap();
        assert!((metric(&flow(0.1), m::ARRIVAL_ERROR) - 0.1 / speed).abs() < 1e-3);
    }

    #[test]
    fn a_flow_that_ends_early_has_no_late_metrics() {
        let mut early = flow(0.0);
        early.rows.truncate(60);
        for of in [m::FRONT_RMS_ERROR, m::FRONT_X_EARLY, m::CENTRE_X_MEAN] {
            assert!(metric(&early, of).is_nan(), "{}", of.name);
        }
        assert!(metric(&flow(0.0), m::WALL_IMPULSE).is_nan());
    }

    #[test]
    fn energy_is_lost_once_and_never_gained() {
        assert!((metric(&flow(0.0), m::MOTION_LOSS) - 1e-3).abs() < 1e-12);
        assert_eq!(metric(&flow(0.0), m::MOTION_EXCESS), 0.0);
        assert_eq!(metric(&flow(0.0), m::ENERGY_GAIN), 0.0);
        let mut gaining = flow(0.0);
        gaining.rows[50].kinetic = 78.2838;
        assert!((metric(&gaining, m::ENERGY_GAIN) - 1e-3).abs() < 1e-6);
    }
}
