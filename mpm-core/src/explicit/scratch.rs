//! Columns that live no longer than a chunk of particles is at hand: a thread has them once, in its cache.

use super::remedy::{Columns, Deformation, DeformationChunk, Filled, Remedy};
use crate::parallel::{CHUNK, Front};
use std::mem::take;
use std::sync::{Mutex, PoisonError};

/// The deformation of a chunk, and what a remedy makes of it.
#[derive(Debug, Default)]
pub(super) struct Scratch<const D: usize> {
    deformation: Deformation<D>,
    columns: Columns,
}

impl<const D: usize> Scratch<D> {
    /// That of this thread, if there is one. Who takes on another chunk before it is given back finds a new one.
    pub(super) fn lent(all: &[Mutex<Self>]) -> Option<Self> {
        let own = all.get(rayon::current_thread_index().unwrap_or(0))?;
        Some(take(&mut *own.lock().unwrap_or_else(PoisonError::into_inner)))
    }

    /// Gives it back.
    pub(super) fn give_back(all: &[Mutex<Self>], lent: Option<Self>) {
        let own = all.get(rayon::current_thread_index().unwrap_or(0));
        if let Some((own, lent)) = own.zip(lent) {
            *own.lock().unwrap_or_else(PoisonError::into_inner) = lent;
        }
    }

    /// Columns of `n` particles, with those of `filled` that outlive the chunk.
    pub(super) fn part<'a>(
        &'a mut self,
        remedy: &dyn Remedy<D>,
        n: usize,
        filled: Filled<'a>,
    ) -> (DeformationChunk<'a, D>, Filled<'a>) {
        if self.columns.next.len() < n {
            // A chunk has its last patch beyond the pieces that others have.
            let most = (n + 1).next_multiple_of(CHUNK);
            self.columns = remedy.columns(most);
            self.deformation = Deformation::of(remedy, &[most]);
        }
        let mut all = (self.deformation.chunk(), self.columns.all());
        let (deformation, Filled { next, rest, .. }) = all.front(1, n);
        (deformation, Filled { next, rest, ..filled })
    }
}
