//! The equations of a step and their derivatives: Eqs. (2) to (8) of `docs/poromechanics.md`.

use super::response::{Particle, Slopes};
use super::settings::{PressureSpace, Settings, Tangent};
use super::unknowns::Unknowns;
use super::water::Water;
use crate::bodies::{Bodies, check_jacobian};
use crate::error::Fault;
use crate::implicit::Penalty;
use crate::implicit::algebra::{dot, norm};
use crate::implicit::elements::{Elements, LAST_BITS};
use crate::implicit::response::Square;
use crate::implicit::unknowns::Pattern;
use crate::parallel::{LIGHT, map};
use crate::space::{determinant, embed};
use nalgebra::{DMatrix, SMatrix, SVector};
use std::array::from_fn;
use std::ops::Range;

/// Runs of particles whose matrices are held at once.
const BATCH: usize = 256;

/// Data of a step that are frozen at its start.
pub(super) struct Setting<const D: usize> {
    /// The functions of the displacement at the particles, and those of the pressure.
    pub(super) solid: Elements<D>,
    pub(super) water: Elements<D>,
    pub(super) unknowns: Unknowns<D>,
    /// Particles that the same nodes of both see.
    pub(super) runs: Vec<Range<usize>>,
    /// Ghost penalties, on displacements and on pressures.
    pub(super) ghosts: [Vec<Penalty>; 2],
    /// The unknowns of every run, of every ghost penalty of displacements, and of pressures.
    pub(super) groups: Vec<Vec<Option<usize>>>,
    pub(super) pattern: Pattern,
    /// Functions of the pressure at every particle less their means over its cell; empty unless projected.
    pub(super) fluctuations: Vec<Vec<f64>>,
    pub(super) drains: Vec<Drain>,
    /// Volumes of water (m³) that sources give to the nodes of the pressure; none without sources.
    pub(super) inflow: Vec<f64>,
    /// Pressures of the nodes at the start (Pa), from which increments are measured; zero where none is.
    pub(super) before: Vec<f64>,
    /// Forces of loads on the nodes (N), at the end of the step.
    pub(super) external: Vec<SVector<f64, D>>,
}

/// A corner by which water leaves.
pub(super) struct Drain {
    /// Nodes and unknowns of the pressure, with their shares of the corner.
    pub(super) node: Vec<usize>,
    pub(super) unknown: Vec<Option<usize>>,
    pub(super) w: Vec<f64>,
    /// Water that a pressure of one drives through it (m³/(Pa s)).
    pub(super) rate: f64,
}

impl Drain {
    /// The pressure there (Pa), and the sum of the sizes of what it is made of.
    fn pressure(&self, of_nodes: &[f64]) -> [f64; 2] {
        let (mut pressure, mut size) = (0.0, 0.0);
        for (node, w) in self.node.iter().zip(&self.w) {
            pressure += of_nodes[*node] * w;
            size += (of_nodes[*node] * w).abs();
        }
        [pressure, size]
    }
}

/// A step of a body.
pub(super) struct Step<'a, const D: usize> {
    pub(super) bodies: &'a Bodies<D>,
    pub(super) water: &'a Water<D>,
    pub(super) settings: &'a Settings,
    pub(super) dt: f64,
    pub(super) setting: &'a Setting<D>,
}

/// Volume of grains over that of the undeformed body, of every particle.
pub(super) fn solid_shares<const D: usize>(bodies: &Bodies<D>, water: &Water<D>) -> impl Iterator<Item = f64> {
    let each = bodies.each.iter().zip(&water.media);
    each.flat_map(|(body, medium)| body.range().map(|_| 1.0 - medium.porosity))
}

/// A trial: nodal increments and pressures, and what they make of the body.
pub(super) struct Trial<const D: usize> {
    /// Increments (m) and pressures (Pa) of the nodes.
    pub(super) u: Vec<[f64; D]>,
    pub(super) p: Vec<f64>,
    /// F̃ of every particle.
    pub(super) f: Vec<SMatrix<f64, D, D>>,
    /// Pressure at every particle (Pa), and its gradient (Pa/m).
    pub(super) pressure: Vec<f64>,
    pub(super) slope: Vec<[f64; D]>,
    /// n J of every particle, the volume of pores over that of the undeformed body.
    pub(super) pores: Vec<f64>,
    /// Forces of the stress on the nodes, and those that act from outside, of gravity too (N).
    pub(super) internal: Vec<SVector<f64, D>>,
    pub(super) external: Vec<SVector<f64, D>>,
    /// Out-of-balance forces, Eq. (2) (N).
    pub(super) momentum: Vec<SVector<f64, D>>,
    /// Out-of-balance volumes of water, Eq. (5) (m³).
    pub(super) mass: Vec<f64>,
    /// Norms of what the two equations balance (N, m³).
    pub(super) scale: [f64; 2],
    /// Norm of the residual of (5) that the last bits of J̃ and of the pressures leave (m³).
    pub(super) rounding: f64,
    /// Water that leaves by drained faces (m³).
    pub(super) drained: f64,
}

impl<const D: usize> Step<'_, D> {
    fn particle(&self, p: usize) -> Particle<'_, D> {
        let particles = &self.bodies.particles;
        Particle {
            law: &self.bodies.of(p).law,
            state: self.bodies.of(p).state(p),
            medium: self.water.media[self.bodies.place_of(p)],
            gravity: self.water.gravity.as_ref(),
            rate: self.settings.volume_rate,
            dt: self.dt,
            volume: particles.volume[p],
            jacobian: particles.jacobian[p],
        }
    }

    /// τ (1/Pa) of the projection; zero without.
    fn projection(&self) -> f64 {
        match self.settings.pressure_space {
            PressureSpace::Projected { strength } => strength,
            PressureSpace::TwoGrid | PressureSpace::Equal => 0.0,
        }
    }

    /// The trial with these values of the unknowns.
    ///
    /// # Errors
    /// The first particle whose J̃ or porosity is not positive and finite, or whose stress is not finite.
    pub(super) fn trial(&self, values: &[f64]) -> Result<Trial<D>, (usize, Fault)> {
        let setting = self.setting;
        let (u, p) = setting.unknowns.spread(values);
        let particles = &self.bodies.particles;
        let count = particles.len();
        let gathered = map(count, LIGHT, |k| {
            let (nodes, w, dw) = setting.water.seen(k);
            let (mut pressure, mut slope) = (0.0, [0.0; D]);
            for ((node, w), dw) in nodes.iter().zip(w).zip(dw) {
                pressure += p[*node] * w;
                for (slope, dw) in slope.iter_mut().zip(dw) {
                    *slope += p[*node] * dw;
                }
            }
            (setting.solid.deformation(k, &u), pressure, slope)
        });
        let solid = solid_shares(self.bodies, self.water);
        let mut pores = Vec::with_capacity(count);
        for (k, ((f, ..), solid)) in gathered.iter().zip(solid).enumerate() {
            let change = determinant(f);
            check_jacobian(change).map_err(|fault| (k, fault))?;
            let jacobian = particles.jacobian[k] * change;
            if jacobian <= solid {
                return Err((k, Fault::NonPositivePorosity(1.0 - solid / jacobian)));
            }
            pores.push(jacobian - solid);
        }
        let answers = map(count, LIGHT, |k| {
            let (f, pressure, slope) = &gathered[k];
            self.particle(k).respond(&embed(f), *pressure, slope)
        });
        for (k, answer) in answers.iter().enumerate() {
            if let Some(value) = answer.stress.iter().copied().find(|s| !s.is_finite()) {
                let quantity = "stress";
                return Err((k, Fault::NotFinite { quantity, value }));
            }
        }
        let mut internal = vec![SVector::zeros(); u.len()];
        setting.solid.scatter(SVector::zeros(), &mut internal, |k, sums| {
            for (sum, dw) in sums.iter_mut().zip(setting.solid.gradients(k)) {
                for i in 0..D {
                    sum[i] += dot(&answers[k].stress[D * i..D * (i + 1)], dw);
                }
            }
        });
        let mut external = setting.external.clone();
        if let Some(gravity) = &self.water.gravity {
            let weights: Vec<[f64; D]> = (answers.iter()).map(|a| gravity.acceleration.map(|g| a.mass * g)).collect();
            let weights = setting.solid.forces(u.len(), &weights);
            for (force, weight) in external.iter_mut().zip(weights) {
                *force += weight;
            }
        }
        let mut momentum: Vec<SVector<f64, D>> =
            (internal.iter().zip(&external)).map(|(inner, outer)| inner - outer).collect();
        add_penalties(&setting.ghosts[0], u.as_flattened(), D, |i, force| {
            momentum[i / D][i % D] += force;
        });
        // Residual, the sum of the sizes of what it is made of, and of what those are made of.
        let mut water = vec![SVector::<f64, 3>::zeros(); p.len()];
        let projection = self.projection();
        setting.water.scatter(SVector::zeros(), &mut water, |k, sums| {
            let (nodes, w, dw) = setting.water.seen(k);
            let answer = &answers[k];
            let slopes = nodes.iter().zip(dw).map(|(n, dw)| p[*n].abs() * norm(dw));
            let steep = slopes.sum::<f64>();
            let mobility: f64 = (0..D).map(|a| answer.mobility[D * a + a]).sum();
            for (place, sum) in sums.iter_mut().enumerate() {
                let stored = w[place] * answer.rate;
                let moved = self.dt * dot(&answer.flow[..D], &dw[place]);
                let bits = w[place] * particles.volume[k] + self.dt * mobility * steep * norm(&dw[place]);
                *sum += SVector::from([stored + moved, stored.abs() + moved.abs(), bits]);
                if let Some(own) = setting.fluctuations.get(k) {
                    let change = |(n, s): (&usize, &f64)| (p[*n] - setting.before[*n]) * s;
                    let change: f64 = nodes.iter().zip(own).map(change).sum();
                    sum[0] += projection * particles.volume[k] * own[place] * change;
                }
            }
        });
        for (sums, volume) in water.iter_mut().zip(&setting.inflow) {
            *sums += SVector::from([-volume, volume.abs(), 0.0]);
        }
        let mut drained = 0.0;
        for drain in &setting.drains {
            let factor = self.dt * drain.rate;
            let [pressure, size] = drain.pressure(&p);
            drained += factor * pressure;
            for (node, w) in drain.node.iter().zip(&drain.w) {
                let share = factor * w;
                let out = share * pressure;
                water[*node] += SVector::from([out, out.abs(), share * size]);
            }
        }
        add_penalties(&setting.ghosts[1], &p, 1, |i, volume| {
            water[i][0] += volume;
        });
        let size = |forces: &[SVector<f64, D>]| -> f64 { forces.iter().map(SVector::norm_squared).sum::<f64>().sqrt() };
        let of_all = |k: usize| norm(&water.iter().map(|of| of[k]).collect::<Vec<_>>());
        Ok(Trial {
            scale: [size(&internal).max(size(&external)), of_all(1)],
            rounding: LAST_BITS * f64::EPSILON * of_all(2),
            mass: water.iter().map(|of| of[0]).collect(),
            u,
            p,
            pressure: gathered.iter().map(|g| g.1).collect(),
            slope: gathered.iter().map(|g| g.2).collect(),
            f: gathered.into_iter().map(|g| g.0).collect(),
            pores,
            internal,
            external,
            momentum,
            drained,
        })
    }

    /// −(2) and (5) at the unknowns: what K times the correction has to be.
    pub(super) fn residual(&self, trial: &Trial<D>) -> Vec<f64> {
        let unknowns = &self.setting.unknowns;
        let mut residual = vec![0.0; unknowns.count];
        for (node, force) in trial.momentum.iter().enumerate() {
            for (a, i) in unknowns.of(&[node], &[]).into_iter().enumerate() {
                if let Some(i) = i {
                    residual[i] -= force[a];
                }
            }
        }
        for (node, volume) in trial.mass.iter().enumerate() {
            if let [Some(i)] = unknowns.of(&[], &[node])[..] {
                residual[i] = *volume;
            }
        }
        residual
    }

    /// The entries of the matrix K, Eq. (8): the derivatives of (2) and of −(5).
    pub(super) fn matrix(&self, trial: &Trial<D>) -> Vec<f64> {
        let setting = self.setting;
        let mut values = vec![0.0; setting.pattern.entries()];
        let mut add = |group: &[Option<usize>], of: &dyn Fn(usize, usize) -> f64| {
            for (j, column) in group.iter().enumerate() {
                let Some(column) = column else { continue };
                for (i, row) in group.iter().enumerate() {
                    // Several components of one unknown add up.
                    if let Some(place) = row.and_then(|row| setting.pattern.place(row, *column)) {
                        values[place] += of(i, j);
                    }
                }
            }
        };
        let (of_runs, of_ghosts) = setting.groups.split_at(setting.runs.len());
        for (runs, groups) in setting.runs.chunks(BATCH).zip(of_runs.chunks(BATCH)) {
            let matrices = map(runs.len(), 1, |k| self.of_run(runs[k].clone(), trial));
            for (group, matrix) in groups.iter().zip(&matrices) {
                add(group, &|i, j| matrix[(i, j)]);
            }
        }
        let [of_solid, of_water] = &setting.ghosts;
        let factors = (of_solid.iter().map(|g| (g, 1.0))).chain(of_water.iter().map(|g| (g, -1.0)));
        for (group, (ghost, factor)) in of_ghosts.iter().zip(factors) {
            add(group, &|i, j| factor * ghost.stiffness[(i, j)]);
        }
        for drain in &setting.drains {
            let factor = -self.dt * drain.rate;
            add(&drain.unknown, &|i, j| factor * drain.w[i] * drain.w[j]);
        }
        values
    }

    /// The derivatives of what the particles of a run add.
    fn of_run(&self, run: Range<usize>, trial: &Trial<D>) -> DMatrix<f64> {
        let setting = self.setting;
        let of_solid = D * setting.solid.gradients(run.start).len();
        let size = of_solid + setting.water.gradients(run.start).len();
        let mut matrix = DMatrix::zeros(size, size);
        let whole = self.settings.tangent == Tangent::Consistent;
        let gravity = self.water.gravity.as_ref().map(|g| g.acceleration);
        let projection = self.projection();
        for k in run {
            let (f, pressure, slope) = (&trial.f[k], trial.pressure[k], &trial.slope[k]);
            let s: Slopes<D> = self.particle(k).slopes(f, pressure, slope);
            let (_, w, dw) = setting.solid.seen(k);
            let (_, m, dm) = setting.water.seen(k);
            let by = |of: &Square<D>, b: usize, g: &[f64; D]| dot(&of[b], g);
            for (j, g) in dw.iter().enumerate() {
                for b in 0..D {
                    let column = j * D + b;
                    let stress: Square<D> = from_fn(|a| from_fn(|c| by(&s.stress_by_f[a][c], b, g)));
                    for (i, f) in dw.iter().enumerate() {
                        for a in 0..D {
                            matrix[(i * D + a, column)] += dot(f, &stress[a]);
                        }
                    }
                    if let Some(g0) = gravity.filter(|_| whole) {
                        let mass = by(&s.mass_by_f, b, g);
                        for (i, w) in w.iter().enumerate() {
                            for a in 0..D {
                                matrix[(i * D + a, column)] -= w * mass * g0[a];
                            }
                        }
                    }
                    let rate = by(&s.rate_by_f, b, g);
                    let flow: [f64; D] = from_fn(|i| by(&s.flow_by_f[i], b, g));
                    let push = dot(g, &s.stress_by_p[b]);
                    for (q, (m, dm)) in m.iter().zip(dm).enumerate() {
                        let row = of_solid + q;
                        matrix[(row, column)] -= m * rate;
                        if whole {
                            matrix[(row, column)] -= self.dt * dot(dm, &flow);
                        }
                        matrix[(column, row)] += m * push;
                    }
                }
            }
            let own = setting.fluctuations.get(k);
            let penalty = projection * self.bodies.particles.volume[k];
            for (j, g) in dm.iter().enumerate() {
                let flow: [f64; D] = from_fn(|i| dot(&s.mobility[i], g));
                for (i, f) in dm.iter().enumerate() {
                    let extra = own.map_or(0.0, |own| penalty * own[i] * own[j]);
                    matrix[(of_solid + i, of_solid + j)] -= self.dt * dot(f, &flow) + extra;
                }
            }
        }
        matrix
    }

    /// Symmetric scaling of the matrix: one over the root of a diagonal entry; for a pressure, of the entry after
    /// elimination, which does not vanish where hardly any water flows.
    pub(super) fn scales(&self, values: &[f64]) -> Vec<f64> {
        let Pattern { begin, row, .. } = &self.setting.pattern;
        let displacements = self.setting.unknowns.displacements;
        let count = self.setting.unknowns.count;
        let mut size = vec![0.0; count];
        for column in 0..count {
            let rows = begin[column]..begin[column + 1];
            let of = |k: usize| match row[k] {
                i if i == column => values[k].abs(),
                i if column >= displacements && i < displacements => values[k] * values[k] / size[i],
                _ => 0.0,
            };
            let sum: f64 = rows.map(of).sum();
            size[column] = if sum > 0.0 && sum.is_finite() { sum } else { 1.0 };
        }
        size.iter().map(|size| 1.0 / size.sqrt()).collect()
    }
}

/// Calls `add` with the place of every value that penalties act on, and what they add there.
fn add_penalties(penalties: &[Penalty], of: &[f64], components: usize, mut add: impl FnMut(usize, f64)) {
    for Penalty { node, stiffness } in penalties {
        let place = |k: usize| node[k / components] * components + k % components;
        for j in 0..stiffness.ncols() {
            for i in 0..stiffness.nrows() {
                add(place(i), stiffness[(i, j)] * of[place(j)]);
            }
        }
    }
}
