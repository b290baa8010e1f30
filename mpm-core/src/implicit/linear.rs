//! Sparse linear systems, by `faer`: LDLᵀ of symmetric matrices, LU of others.

use super::failure::Failure;
use super::unknowns::Pattern;
use crate::ledger::Ledger;
use crate::work::clocked;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::sparse::linalg::cholesky::{LdltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky};
use faer::sparse::linalg::lu::{LuRef, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};

/// One thread: other numbers of them would add in another order.
const PAR: Par = Par::Seq;

/// Why a system has no solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Singular;

enum Factors {
    None,
    Symmetric(SymbolicCholesky<usize>, Vec<f64>),
    General(SymbolicLu<usize>, NumericLu<usize, f64>),
}

/// Solves systems of one pattern after the other; the order of elimination is kept as long as the pattern is.
pub(crate) struct Direct {
    symmetric: bool,
    /// The pattern of the matrices; it can be of a solver that was saved, whose factors are not kept.
    pub(crate) pattern: Pattern,
    factors: Factors,
    memory: MemBuffer,
}

fn matrix<'a>(pattern: &'a Pattern, values: &'a [f64]) -> SparseColMatRef<'a, usize, f64> {
    let n = pattern.len();
    let symbolic = SymbolicSparseColMatRef::new_checked(n, n, &pattern.begin, None, &pattern.row);
    SparseColMatRef::new(symbolic, values)
}

impl Direct {
    /// For matrices that are symmetric, or not.
    pub(crate) fn new(symmetric: bool) -> Self {
        Self {
            symmetric,
            pattern: Pattern::default(),
            factors: Factors::None,
            memory: MemBuffer::new(faer::dyn_stack::StackReq::EMPTY),
        }
    }

    /// Readies for matrices of a pattern.
    pub(crate) fn analyse(&mut self, pattern: &Pattern) -> Result<(), Singular> {
        if self.pattern == *pattern && !matches!(self.factors, Factors::None) {
            return Ok(());
        }
        self.pattern = pattern.clone();
        let n = pattern.len();
        let structure = SymbolicSparseColMatRef::new_checked(n, n, &pattern.begin, None, &pattern.row);
        let need;
        self.factors = if self.symmetric {
            let order = SymmetricOrdering::Amd;
            let symbolic =
                factorize_symbolic_cholesky(structure, Side::Lower, order, Default::default()).map_err(|_| Singular)?;
            need = symbolic
                .factorize_numeric_ldlt_scratch::<f64>(PAR, Default::default())
                .or(symbolic.solve_in_place_scratch::<f64>(1, PAR));
            let values = vec![0.0; symbolic.len_val()];
            Factors::Symmetric(symbolic, values)
        } else {
            let symbolic = factorize_symbolic_lu(structure, Default::default()).map_err(|_| Singular)?;
            need = symbolic
                .factorize_numeric_lu_scratch::<f64>(PAR, Default::default())
                .or(symbolic.solve_in_place_scratch::<f64>(1, PAR));
            Factors::General(symbolic, NumericLu::new())
        };
        self.memory = MemBuffer::new(need);
        Ok(())
    }

    /// Factorises the matrix with these entries.
    pub(crate) fn factorise(&mut self, values: &[f64]) -> Result<(), Singular> {
        let given = matrix(&self.pattern, values);
        let stack = MemStack::new(&mut self.memory);
        match &mut self.factors {
            Factors::None => Err(Singular),
            Factors::Symmetric(symbolic, factors) => symbolic
                .factorize_numeric_ldlt(
                    factors,
                    given,
                    Side::Lower,
                    LdltRegularization::default(),
                    PAR,
                    stack,
                    Default::default(),
                )
                .map(|_| ())
                .map_err(|_| Singular),
            Factors::General(symbolic, factors) => symbolic
                .factorize_numeric_lu(factors, given, PAR, stack, Default::default())
                .map(|_| ())
                .map_err(|_| Singular),
        }
    }

    /// Replaces `x` by the solution with the right-hand side `x`.
    pub(crate) fn solve(&mut self, x: &mut [f64]) {
        let n = x.len();
        let right = MatMut::from_column_major_slice_mut(x, n, 1);
        let stack = MemStack::new(&mut self.memory);
        match &self.factors {
            Factors::None => {}
            Factors::Symmetric(symbolic, factors) => {
                LdltRef::new(symbolic, factors).solve_in_place_with_conj(Conj::No, right, PAR, stack);
            }
            Factors::General(symbolic, factors) => {
                LuRef::new_unchecked(symbolic, factors).solve_in_place_with_conj(Conj::No, right, PAR, stack);
            }
        }
    }

    /// The same with the transposed matrix.
    pub(crate) fn solve_transposed(&mut self, x: &mut [f64]) {
        if self.symmetric {
            return self.solve(x);
        }
        let n = x.len();
        let right = MatMut::from_column_major_slice_mut(x, n, 1);
        let stack = MemStack::new(&mut self.memory);
        if let Factors::General(symbolic, factors) = &self.factors {
            LuRef::new_unchecked(symbolic, factors).solve_transpose_in_place_with_conj(Conj::No, right, PAR, stack);
        }
    }

    /// The displacements of nodes that forces `right` give, without forces on what else the nodes of the matrix have.
    pub(crate) fn displacements<const D: usize>(&mut self, right: &[f64]) -> Vec<f64> {
        let width = self.pattern.width;
        let mut x = vec![0.0; self.pattern.len()];
        for (x, r) in x.chunks_exact_mut(width).zip(right.chunks(D)) {
            x[..D].copy_from_slice(r);
        }
        self.solve(&mut x);
        x.chunks_exact(width).flat_map(|x| x[..D].iter().copied()).collect()
    }
}

/// Scales a matrix to a diagonal of ones, and of the result an estimate of the condition in the 1-norm (Hager 1984,
/// doi:10.1137/0905023), from below; infinite of a singular one.
pub(crate) fn condition(symmetric: bool, pattern: &Pattern, values: &[f64]) -> f64 {
    let n = pattern.len();
    let root: Vec<f64> = (0..n)
        .map(|i| pattern.place(i, i).map_or(1.0, |k| values[k].abs().sqrt()))
        .map(|d| if d > 0.0 { 1.0 / d } else { 1.0 })
        .collect();
    let mut scaled = values.to_vec();
    let mut norm: f64 = 0.0;
    for column in 0..n {
        let mut sum = 0.0;
        for k in pattern.begin[column]..pattern.begin[column + 1] {
            scaled[k] *= root[pattern.row[k]] * root[column];
            sum += scaled[k].abs();
        }
        norm = norm.max(sum);
    }
    let mut solver = Direct::new(symmetric);
    let ready = solver.analyse(pattern).and_then(|()| solver.factorise(&scaled));
    if ready.is_err() || n == 0 {
        return f64::INFINITY;
    }
    let mut x = vec![1.0 / n as f64; n];
    let mut inverse: f64 = 0.0;
    for _ in 0..5 {
        let mut y = x.clone();
        solver.solve(&mut y);
        inverse = inverse.max(y.iter().map(|y| y.abs()).sum());
        let mut z: Vec<f64> = y.iter().map(|y| y.signum()).collect();
        solver.solve_transposed(&mut z);
        let dot: f64 = z.iter().zip(&x).map(|(z, x)| z * x).sum();
        let greatest = (0..n).fold(0, |k, i| if z[i].abs() > z[k].abs() { i } else { k });
        if z[greatest].abs() <= dot {
            break;
        }
        x.fill(0.0);
        x[greatest] = 1.0;
    }
    norm * inverse
}

/// Direct solution in a step, counted in the ledger.
pub(crate) struct Linear<'a> {
    pub(crate) direct: &'a mut Direct,
    pub(crate) ledger: &'a mut Ledger,
}

impl Linear<'_> {
    /// Prepares for matrices of a pattern.
    pub(crate) fn analyse(&mut self, pattern: &Pattern) -> Result<(), Failure> {
        let Ledger { work, spent, .. } = &mut *self.ledger;
        work.analyses += u64::from(self.direct.pattern != *pattern);
        let analysed = clocked(&mut spent.factorisation, || self.direct.analyse(pattern));
        analysed.map_err(|_| Failure::Singular(0))
    }

    /// Factorises the matrix of an iteration with these entries.
    pub(crate) fn factorise(&mut self, values: &[f64], iteration: u32) -> Result<(), Failure> {
        let Ledger { work, spent, .. } = &mut *self.ledger;
        work.assemblies += 1;
        work.factorisations += 1;
        work.nonzeros += self.direct.pattern.entries() as u64;
        let factorised = clocked(&mut spent.factorisation, || self.direct.factorise(values));
        factorised.map_err(|_| Failure::Singular(iteration))
    }
}
