//! Parts of this program that are timed.

use crate::measured::Sample;
use crate::turn::{Error, Outcome, Timed, timed};
use mpm_core::{Memory, Simulation};
use rayon::ThreadPool;
use std::collections::BTreeMap;

/// Something of this program that goes on.
pub(crate) trait Going: Send {
    /// Goes on by a slice and returns the updates.
    fn go_on(&mut self) -> Result<u64, Error>;
    /// Its outcome, if there is anything to compare.
    fn outcome(&mut self) -> Result<Option<Outcome>, Error> {
        Ok(None)
    }
}

/// Something of this program on threads of its own.
pub(crate) struct Local<G> {
    pool: ThreadPool,
    going: G,
}

impl<G: Going> Local<G> {
    /// `begin` on a number of threads.
    pub(crate) fn new(threads: usize, begin: impl FnOnce() -> Result<G, Error> + Send) -> Result<Self, Error> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|e| format!("{threads} threads can't be started: {e}"))?;
        let going = pool.install(begin)?;
        Ok(Self { pool, going })
    }

    /// The work that goes on.
    pub(crate) fn going(&self) -> &G {
        &self.going
    }
}

impl<G: Going> Timed for Local<G> {
    fn slice(&mut self) -> Result<Sample, Error> {
        let Self { pool, going } = self;
        pool.install(|| timed(|| going.go_on()))
    }

    fn outcome(&mut self) -> Result<Option<Outcome>, Error> {
        let Self { pool, going } = self;
        pool.install(|| going.outcome())
    }

    fn held(self: Box<Self>) -> Option<u64> {
        let Self { going, .. } = *self;
        // Each thread counts its own: many may have allocated, this one alone gives back.
        let given_back = allocation_counter::measure(|| drop(going));
        Some(given_back.bytes_current.unsigned_abs())
    }
}

pub(crate) fn checksum(memory: &(impl Memory + ?Sized)) -> Result<u32, Error> {
    let bytes = postcard::to_stdvec(&memory.save()?)?;
    Ok(crc32fast::hash(&bytes))
}

/// A simulation; a slice is a number of steps.
pub(crate) struct Steps<const D: usize> {
    pub(crate) simulation: Box<dyn Simulation<D>>,
    pub(crate) steps: u64,
}

impl<const D: usize> Going for Steps<D> {
    fn go_on(&mut self) -> Result<u64, Error> {
        let before = self.simulation.work().particle_steps;
        for _ in 0..self.steps {
            self.simulation.step()?;
        }
        Ok(self.simulation.work().particle_steps - before)
    }

    fn outcome(&mut self) -> Result<Option<Outcome>, Error> {
        Ok(Some(Outcome { bits: Some(checksum(self.simulation.as_ref())?), sums: sums(self.simulation.as_ref()) }))
    }
}

/// Sums over a body and means over its particles, as peers tell them.
fn sums<const D: usize>(simulation: &dyn Simulation<D>) -> BTreeMap<String, f64> {
    let (totals, particles) = (simulation.totals(), simulation.particles());
    let mean = |sum: f64| sum / particles.len() as f64;
    let centre = |a: usize| mean(particles.position.iter().map(|x| x[a]).sum());
    let jacobian = mean(particles.jacobian.iter().sum());
    let averaged = match particles.j_bar.is_empty() {
        true => jacobian,
        false => mean(particles.j_bar.iter().sum()),
    };
    let sums = [
        ("mass", totals.mass),
        ("kinetic_energy", totals.kinetic_energy),
        ("stored_energy", totals.stored_energy),
        ("mean_jacobian", jacobian),
        ("mean_averaged_jacobian", averaged),
    ];
    let of_body = sums.map(|(name, value)| (name.to_owned(), value));
    let of_axes = ["x", "y", "z"].iter().enumerate().take(D).flat_map(|(a, axis)| {
        [(format!("momentum_{axis}"), totals.momentum[a]), (format!("centre_{axis}"), centre(a))]
    });
    of_body.into_iter().chain(of_axes).collect()
}
