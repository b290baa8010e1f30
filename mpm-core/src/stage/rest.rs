//! When a relaxed motion counts as at rest.

use crate::memory::{Memory, MemoryError, Saved};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// Observation of a motion at one time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Observation {
    /// Time (s).
    pub time: f64,
    /// Out-of-balance force over the load, in a measure of the observer's choice.
    pub force_ratio: f64,
    /// Kinetic over stored energy.
    pub energy_ratio: f64,
    /// A displacement to watch (m).
    pub displacement: f64,
}

/// At rest: over a whole window of time the out-of-balance force and the kinetic energy stay small and
/// the watched displacement stays within `drift` of its value.
#[derive(Debug, Clone, PartialEq)]
pub struct RestCriterion {
    /// Largest [`Observation::force_ratio`].
    pub force_ratio: f64,
    /// Largest [`Observation::energy_ratio`].
    pub energy_ratio: f64,
    /// Largest relative drift over the window.
    pub drift: f64,
    /// Length of the window (s).
    pub window: f64,
    /// The observations of the window.
    history: VecDeque<Observation>,
}

impl RestCriterion {
    /// A criterion without history.
    #[must_use]
    pub fn new(force_ratio: f64, energy_ratio: f64, drift: f64, window: f64) -> Self {
        Self { force_ratio, energy_ratio, drift, window, history: VecDeque::new() }
    }

    /// Takes an observation; true when the motion is at rest.
    pub fn observe(&mut self, now: Observation) -> bool {
        self.history.push_back(now);
        while self.history.get(1).is_some_and(|second| now.time - second.time >= self.window) {
            self.history.pop_front();
        }
        let Some(first) = self.history.front() else {
            return false;
        };
        if now.time - first.time < self.window {
            return false;
        }
        let still = self.drift * now.displacement.abs();
        self.history.iter().all(|o| {
            o.force_ratio <= self.force_ratio
                && o.energy_ratio <= self.energy_ratio
                && (o.displacement - now.displacement).abs() <= still
        })
    }
}

impl Memory for RestCriterion {
    fn save(&self) -> Result<Saved, MemoryError> {
        Saved::of(&self.history)
    }

    fn restore(&mut self, saved: &Saved) -> Result<(), MemoryError> {
        self.history = saved.read("criterion of rest")?;
        Ok(())
    }
}
