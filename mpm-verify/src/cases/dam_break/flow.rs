//! The observed flow and its metrics.

use super::*;
use crate::exact::dam_break::{COMPARED, energies, front, passage, time_scale};

/// The state behind the gate, just before it is removed.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Start {
    /// Forces (N/m) on the floor, downward, and on gate and back wall, outward.
    pub(super) base_reaction: f64,
    pub(super) gate_force: f64,
    pub(super) back_force: f64,
    /// Pressure (Pa) of every particle in seeding order.
    pub(super) pressures: Vec<f64>,
    /// Kinetic energy (J/m).
    pub(super) kinetic_energy: f64,
}

/// One observation; forces are means since the one before.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct State {
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

impl State {
    pub(super) fn columns(&self) -> Row {
        row! {
            "time (s)": self.time,
            "front (m)": self.front,
            "back_level (m)": self.back_level,
            "centre_x (m)": self.centre[0],
            "centre_y (m)": self.centre[1],
            "kinetic_energy (J/m)": self.kinetic,
            "potential_energy (J/m)": self.potential,
            "stress_work (J/m)": self.stress_work,
            "energy (J/m)": self.energy(),
            "stored_energy (J/m)": self.stored,
            "floor_force (N/m)": self.floor_force,
            "back_force (N/m)": self.back_force,
            "front_force (N/m)": self.front_force,
            "pressure_rms (Pa)": self.pressure_rms,
            "checkerboard_rms (Pa)": self.checkerboard_rms,
            "tension (-)": self.tension,
            "covered (m²)": self.covered,
            "jacobian_min (-)": self.jacobian.0,
            "jacobian_max (-)": self.jacobian.1,
        }
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

#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Flow {
    pub(super) rows: Vec<State>,
}

impl Flow {
    /// The observation nearest to `time` (s), if the flow has got there.
    fn at(&self, time: f64) -> Option<&State> {
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

    /// Time (s) at which the front passes `x` (m).
    fn arrival(&self, x: f64) -> f64 {
        self.rows.windows(2).find(|pair| pair[0].front < x && pair[1].front >= x).map_or(f64::NAN, |pair| {
            let share = (x - pair[0].front) / (pair[1].front - pair[0].front);
            pair[0].time + share * (pair[1].time - pair[0].time)
        })
    }

    /// Mean from the removal of the gate to `time` (s); NaN if the flow has not got there.
    fn mean(&self, time: f64, f: impl Fn(&State) -> f64) -> f64 {
        if self.at(time).is_none() {
            return f64::NAN;
        }
        mean((self.rows.iter()).filter(|row| row.time < time + 1e-6).map(f))
    }

    /// Metrics of water of a density, on cells of size `h` (m).
    pub(super) fn metrics(&self, density: f64, h: f64) -> Vec<(Metric, f64)> {
        let at = |time: f64, f: fn(&State) -> f64| self.at(time).map_or(f64::NAN, f);
        let (at_start, _) = energies(density);
        let errors = self.front_errors();
        let near_end = TANK - 2.0 * h;
        let arrival = self.arrival(near_end);
        let until = |row: &State| row.front < near_end;
        let speeds = (self.rows.windows(2))
            .filter(|pair| until(&pair[1]))
            .map(|pair| (pair[1].front - pair[0].front) / (pair[1].time - pair[0].time));
        let energy: Vec<f64> = std::iter::once(at_start).chain(self.rows.iter().map(State::energy)).collect();
        let motion = || std::iter::once(at_start).chain(self.rows.iter().map(State::motion));
        let gains = energy.windows(2).map(|pair| pair[1] - pair[0]);
        let all = |f: fn(&State) -> f64| self.rows.iter().map(f);
        vec![
            (FRONT_X_EARLY, at(0.4, |r| r.front)),
            (FRONT_RMS_ERROR, rms(errors)),
            (FRONT_SPEED_MAX, speeds.fold(0.0, f64::max)),
            (ARRIVAL_TIME, arrival),
            (ARRIVAL_ERROR, passage(near_end).map_or(f64::NAN, |(time, _)| (arrival - time).abs())),
            (BACK_LEVEL_EARLY, at(0.4, |r| r.back_level)),
            (ENERGY_RATIO, at(0.4, State::energy) / at_start),
            (ENERGY_RATIO_2S, at(2.0, State::energy) / at_start),
            (ENERGY_GAIN, gains.fold(0.0, f64::max) / at_start),
            (ENERGY_EXCESS, energy.iter().copied().fold(0.0, f64::max) / at_start - 1.0),
            (MOTION_RATIO_2S, at(2.0, State::motion) / at_start),
            (MOTION_EXCESS, motion().fold(0.0, f64::max) / at_start - 1.0),
            (MOTION_LOSS, 1.0 - motion().fold(f64::INFINITY, f64::min) / at_start),
            (PRESSURE_RMS, at(0.4, |r| r.pressure_rms)),
            (CHECKERBOARD_RMS, at(0.4, |r| r.checkerboard_rms)),
            (TENSION_SHARE, at(0.4, |r| r.tension)),
            (COVERED_EARLY, at(0.4, |r| r.covered)),
            (CENTRE_X_EARLY, at(0.4, |r| r.centre[0])),
            (CENTRE_X_MEAN, self.mean(2.0, |r| r.centre[0])),
            (CENTRE_Y_MEAN, self.mean(2.0, |r| r.centre[1])),
            (WALL_IMPULSE, 2.0 * self.mean(2.0, |r| r.front_force)),
            (JACOBIAN_MIN, all(|r| r.jacobian.0).fold(f64::INFINITY, f64::min)),
            (JACOBIAN_MAX, all(|r| r.jacobian.1).fold(0.0, f64::max)),
            (LOG_JACOBIAN_GAP, at(0.4, |r| r.log_jacobian_gap)),
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
            State {
                time,
                front: front(time).map_or(4.0, |x| x + off),
                potential: 0.999 * energies(997.5).0,
                ..State::default()
            }
        };
        Flow { rows: (1..=100).map(row).collect() }
    }

    fn metric(flow: &Flow, of: Metric) -> f64 {
        let metrics = flow.metrics(997.5, 0.25);
        metrics.iter().find(|(m, _)| *m == of).unwrap().1
    }

    #[test]
    fn the_inviscid_front_has_no_error_and_another_its_distance() {
        assert!(metric(&flow(0.0), FRONT_RMS_ERROR) < 1e-12);
        assert!((metric(&flow(0.1), FRONT_RMS_ERROR) - 0.1).abs() < 1e-12);
        assert!(metric(&flow(0.0), ARRIVAL_ERROR) < 1e-5);
        let (_, speed) = passage(5.5).unwrap();
        assert!((metric(&flow(0.1), ARRIVAL_ERROR) - 0.1 / speed).abs() < 1e-3);
    }

    #[test]
    fn a_flow_that_ends_early_has_no_late_metrics() {
        let mut early = flow(0.0);
        early.rows.truncate(60);
        for of in [FRONT_RMS_ERROR, FRONT_X_EARLY, CENTRE_X_MEAN] {
            assert!(metric(&early, of).is_nan(), "{}", of.name);
        }
        assert!(metric(&flow(0.0), WALL_IMPULSE).is_nan());
    }

    #[test]
    fn energy_is_lost_once_and_never_gained() {
        assert!((metric(&flow(0.0), MOTION_LOSS) - 1e-3).abs() < 1e-12);
        assert_eq!(metric(&flow(0.0), MOTION_EXCESS), 0.0);
        assert_eq!(metric(&flow(0.0), ENERGY_GAIN), 0.0);
        let mut gaining = flow(0.0);
        gaining.rows[50].kinetic = 78.2838;
        assert!((metric(&gaining, ENERGY_GAIN) - 1e-3).abs() < 1e-6);
    }
}
