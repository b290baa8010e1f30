//! What is seen of the strip, step by step.

use super::metrics as m;
use super::oedometer::settlement as settlement_of_clay;
use super::parameters::{ALPHA, DIMENSION, GAMMA, HALF_WIDTH, LAW, LOAD, PENETRATION, STEPS};
use super::reference::solution;
use super::scene::{
    BASE, PER_CELL, SIDE, duration, elastic, is_driven, is_plastic, load, moduli, plane, strip,
    surcharge,
};
use crate::cases::observe::{column, position_columns, reference_columns};
use crate::cases::parameters::require_quotient;
use crate::drive::{Drive, Stage, Watch};
use crate::error::Error;
use crate::job::{Column, Job, Snapshot};
use crate::metric::Metric;
use crate::parameter::Parameters;
use crate::record::Discretisation;
use crate::spec::RunSpec;
use crate::statistics::rms;
use mpm_core::{Error as Broken, Field, Part, Simulation};
use serde::{Deserialize, Serialize};
use std::array::from_fn;

/// Least value of what is rounding.
const ROUNDING: f64 = 1e-9;
/// What is nearer to the strip's edge than this share of its half width is not smooth.
const NEAR: f64 = 0.5;
/// After so many quarters of the steps particles are kept.
const QUARTERS: u64 = 4;

/// What has been seen of the strip.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Seen {
    steps: u64,
    /// Whether a step had no solution.
    stopped: bool,
    turnover: f64,
    most: u64,
    /// Settlement (m) and load (Pa) after every step.
    path: Vec<[f64; 2]>,
}

impl Seen {
    /// Load (Pa) at a settlement (m), by a straight line between steps; NaN where it was not reached.
    fn load_at(&self, settlement: f64) -> f64 {
        let begun = [[0.0; 2]];
        let before = begun.iter().chain(&self.path);
        let mut parts = before.zip(&self.path);
        let part = parts.find(|(_, after)| after[0] >= settlement);
        part.map_or(f64::NAN, |([s, q], [t, r])| {
            q + (r - q) * (settlement - s) / (t - s)
        })
    }

    /// Growth of the load in the last quarter of all steps, over itself.
    fn growth(&self) -> f64 {
        let of = |k: usize| self.path.get(k).map_or(f64::NAN, |at| at[1]);
        let all = self.path.len();
        1.0 - of((3 * all / 4).saturating_sub(1)) / of(all.saturating_sub(1))
    }
}

/// What begins a run.
type Begin<const D: usize> = fn(&RunSpec, &Parameters) -> Result<Box<dyn Simulation<D>>, Broken>;

/// A strip that settles, or a square.
pub(super) struct Strip<const D: usize> {
    spec: RunSpec,
    parameters: Parameters,
    begin: Begin<D>,
}

/// A run at its start.
///
/// # Errors
/// The parameters don't make a scene.
pub(super) fn drive(spec: &RunSpec, parameters: &Parameters) -> Result<Box<dyn Job>, Error> {
    if !is_plastic(parameters) && !is_driven(parameters) {
        let [bulk, shear] = moduli(parameters);
        let strain = parameters.number(LOAD) / (bulk + 4.0 / 3.0 * shear);
        let why = "where soil that stays as stiff as at rest would keep no height";
        require_quotient("load / M of young_modulus", strain, 0.0..=1.0, why)?;
    }
    match parameters.number(DIMENSION) {
        2.0 => Strip::drive(spec, parameters, plane),
        _ if is_plastic(parameters) => Err(Error::Input(format!(
            "{} = {} has no meaning with dimension = 3; allowed: {}",
            LAW.name,
            parameters.text(LAW),
            LAW.default
        ))),
        _ => Strip::drive(spec, parameters, elastic::<3>),
    }
}

impl<const D: usize> Strip<D> {
    /// The axis upward.
    const UP: usize = D - 1;

    fn drive(
        spec: &RunSpec,
        parameters: &Parameters,
        begin: Begin<D>,
    ) -> Result<Box<dyn Job>, Error> {
        let strip = Self {
            spec: spec.clone(),
            parameters: parameters.clone(),
            begin,
        };
        Ok(Box::new(Drive::new(strip, Seen::default())?))
    }

    fn half_width(&self) -> f64 {
        self.parameters.number(HALF_WIDTH)
    }

    /// Of the strip, or the square, what lies in the scene (m or m²).
    fn area(&self) -> f64 {
        self.half_width().powi(Self::UP as i32)
    }

    fn spacing(&self) -> f64 {
        self.spec.level.h / PER_CELL as f64
    }

    /// Particles along an edge.
    fn row(&self) -> usize {
        (SIDE / self.spacing()).round() as usize
    }

    /// Place of a particle along every axis at the start.
    fn place(&self, reference: &[f64; D]) -> [usize; D] {
        reference.map(|x| (x / self.spacing()).floor() as usize)
    }

    /// Of the particle next to the axis at the surface, over the half width.
    fn settlement(&self, run: &dyn Simulation<D>) -> f64 {
        let p = run.particles();
        let mut top = [0; D];
        top[Self::UP] = self.row() - 1;
        let next = p.reference.iter().position(|x| self.place(x) == top);
        next.map_or(f64::NAN, |k| {
            (p.reference[k][Self::UP] - p.position[k][Self::UP]) / self.half_width()
        })
    }

    /// Load on the strip (Pa) beside what rests on the whole surface.
    fn load(&self, run: &dyn Simulation<D>) -> f64 {
        if is_driven(&self.parameters) {
            run.on(Part::Constraint(strip(D))).force[Self::UP] / self.area()
        } else {
            load(&self.parameters, run.time())
        }
    }

    /// Pressure over the load of the particles, row by row as they were at the start; NaN where there is none.
    fn pressures(&self, stage: &mut Stage<D>, over: f64) -> Vec<f64> {
        let field = stage.run.field(Field::PorePressure);
        let row = self.row();
        let mut all = vec![f64::NAN; row.pow(D as u32)];
        for (p, x) in field.iter().zip(&stage.run.particles().reference) {
            let k = self.place(x).iter().rev().fold(0, |k, i| k * row + i);
            if let Some(value) = all.get_mut(k) {
                *value = p / over;
            }
        }
        all
    }

    /// Whether a particle in this place was not near the strip's edge.
    fn is_far(&self, place: [usize; D]) -> bool {
        let from_edge = place.map(|k| (k as f64 + 0.5) * self.spacing() - self.half_width());
        let across = &from_edge[..Self::UP];
        let inside = across.iter().fold(f64::NEG_INFINITY, |a, b| a.max(*b));
        let outside = across.iter().map(|x| x.max(0.0).powi(2)).sum::<f64>();
        let across = if inside < 0.0 { inside } else { outside.sqrt() };
        let depth = from_edge[Self::UP] + self.half_width() - SIDE;
        across.hypot(depth) > NEAR * self.half_width()
    }

    /// Places of the particles, as their pressures are stored.
    fn places(&self) -> impl Iterator<Item = [usize; D]> {
        let row = self.row();
        let of = move |k: usize| from_fn(|a| k / row.pow(a as u32) % row);
        (0..row.pow(D as u32)).map(of)
    }

    /// Of clay under a load on its whole surface the settlement's relative error.
    fn uniform_error(&self, run: &dyn Simulation<D>) -> f64 {
        let own = |p| self.parameters.number(p) == 1.0;
        let whole = self.half_width() == SIDE;
        if !(whole && is_plastic(&self.parameters) && own(ALPHA) && own(GAMMA)) {
            return f64::NAN;
        }
        let p = run.particles();
        let volume = |of: &[f64]| of.iter().sum::<f64>();
        let settled = 1.0 - volume(&p.volume) / volume(&p.reference_volume);
        (settled / settlement_of_clay(&self.parameters) - 1.0).abs()
    }

    fn roughness(&self, all: &[f64]) -> f64 {
        let row = self.row();
        let is_inner = |place: &[usize; D]| place.iter().all(|i| (1..row - 1).contains(i));
        let places = self.places().enumerate();
        let inner = places.filter(|(_, place)| is_inner(place) && self.is_far(*place));
        rms(inner.map(|(k, _)| {
            let beside = (0..D).map(|a| row.pow(a as u32));
            let sum: f64 = beside.map(|next| all[k - next] + all[k + next]).sum();
            all[k] - sum / (2 * D) as f64
        }))
    }
}

/// Whether a step has no solution: of clay, that its limit is reached.
fn is_limit(error: &Broken) -> bool {
    matches!(
        error,
        Broken::NoConvergence { .. } | Broken::Singular { .. }
    )
}

impl<const D: usize> Watch<D> for Strip<D> {
    type Seen = Seen;

    fn discretisation(&self) -> Discretisation {
        Discretisation {
            dim: D,
            h: self.spec.level.h,
            ppc: PER_CELL.pow(D as u32) as u32,
            dt: duration(&self.parameters),
            wall: "open-knot".to_owned(),
        }
    }

    fn scene(&self, _: &Seen) -> Result<Box<dyn Simulation<D>>, Broken> {
        (self.begin)(&self.spec, &self.parameters)
    }

    fn columns(&self) -> Vec<&'static str> {
        vec![
            "time (s)",
            "load (Pa)",
            "settlement (-)",
            if D == 2 {
                "outflow (m²)"
            } else {
                "outflow (m³)"
            },
            "newton_iterations (-)",
            "parts (-)",
        ]
    }

    fn row(&self, seen: &mut Seen, stage: &mut Stage<D>) -> Result<Vec<f64>, Broken> {
        let iterations = stage.run.work().newton_iterations;
        let before = volumes(stage.run.as_ref());
        match stage.steps(1) {
            // What the last parts came to is a state like others.
            Err(error) if is_plastic(&self.parameters) && is_limit(&error) => seen.stopped = true,
            other => other?,
        }
        seen.steps += 1;
        let run = stage.run.as_ref();
        let changes = before.iter().zip(volumes(run));
        seen.turnover += changes
            .map(|(before, after)| (after - before).abs())
            .sum::<f64>();
        let taken = run.work().newton_iterations - iterations;
        if !seen.stopped {
            seen.most = seen.most.max(taken);
        }
        let [settlement, load] = [self.settlement(run), self.load(run)];
        seen.path.push([settlement * self.half_width(), load]);
        Ok(vec![
            run.time(),
            load,
            settlement,
            run.water().map_or(f64::NAN, |w| w.outflow),
            taken as f64,
            run.convergence().map_or(f64::NAN, |c| c.parts.into()),
        ])
    }

    fn progress(&self, seen: &Seen, _: &Stage<D>) -> f64 {
        if seen.stopped {
            return 1.0;
        }
        seen.steps as f64 / self.parameters.number(STEPS)
    }

    fn snapshot(&self, seen: &Seen, stage: &mut Stage<D>) -> Option<Snapshot> {
        let all = self.parameters.number(STEPS) as u64;
        let quarter = all.is_multiple_of(QUARTERS) && seen.steps.is_multiple_of(all / QUARTERS);
        (quarter && seen.steps < all).then(|| Snapshot {
            time: stage.run.time(),
            columns: self.particles(seen, stage),
        })
    }

    fn particles(&self, _: &Seen, stage: &mut Stage<D>) -> Vec<Column> {
        let pressure = stage.run.field(Field::PorePressure);
        let porosity = stage.run.field(Field::Porosity);
        let strain = stage.run.field(Field::PlasticStrain);
        let p = stage.run.particles();
        let mut columns = position_columns(p);
        columns.extend(reference_columns(p));
        columns.extend([
            column("pore_pressure", "Pa", p.seeded(|k| pressure[k])),
            column("porosity", "-", p.seeded(|k| porosity[k])),
            column("effective_stress_xx", "Pa", p.seeded(|k| p.stress[k].xx)),
            column("effective_stress_yy", "Pa", p.seeded(|k| p.stress[k].yy)),
            column("effective_stress_xy", "Pa", p.seeded(|k| p.stress[k].xy)),
            column("plastic_strain", "-", p.seeded(|k| strain[k])),
            column("jacobian", "-", p.seeded(|k| p.jacobian[k])),
        ]);
        columns
    }

    fn metrics(&self, seen: &Seen, stage: &mut Stage<D>) -> Vec<(Metric, f64)> {
        let last = self.load(stage.run.as_ref());
        let pressures = self.pressures(stage, last);
        let strain = stage.run.field(Field::PlasticStrain);
        let limit = match is_driven(&self.parameters) {
            true => last,
            false => seen.load_at(self.parameters.number(PENETRATION)),
        };
        let run = stage.run.as_ref();
        let settlement = self.settlement(run);
        let work = run.work();
        let swept = settlement * self.half_width() * self.area();
        let lost = run
            .water()
            .map_or(f64::NAN, |w| (w.imbalance / swept).abs());
        let rests = surcharge(&self.parameters) * SIDE.powi(Self::UP as i32);
        let all = last * self.area() + rests;
        let held = -run.on(Part::Constraint(BASE)).force[Self::UP];
        // What is no number stays none.
        let above = |value: f64| if value < ROUNDING { ROUNDING } else { value };
        let least = pressures.iter().copied().fold(f64::INFINITY, f64::min);
        let most = pressures.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let known = solution(self.spec.level.h, &self.parameters);
        let ratio = known.map_or(f64::NAN, |s| {
            let [_, shear] = moduli(&self.parameters);
            settlement * self.half_width() * shear / (self.parameters.number(LOAD) * s.settlement)
        });
        // Of a square those next to a plane of symmetry, where it is known.
        let here = |place: &[usize; D]| place[1..Self::UP].iter().all(|i| *i == 0);
        let apart = |far: bool| {
            let places = self.places().zip(&pressures);
            let here =
                places.filter(move |(place, _)| here(place) && (!far || self.is_far(*place)));
            here.map(move |(place, p)| {
                known.map_or(f64::NAN, |s| p - s.pressure(place[0], place[Self::UP]))
            })
        };
        vec![
            (m::SETTLEMENT, settlement),
            (m::SETTLEMENT_RATIO, ratio),
            (m::PRESSURE_ERROR, rms(apart(false))),
            (
                m::PRESSURE_ERROR_LARGEST,
                known.map_or(f64::NAN, |_| apart(true).fold(0.0, |a, b| b.abs().max(a))),
            ),
            (m::ROUGHNESS, self.roughness(&pressures)),
            (m::LEAST_PRESSURE, least),
            (m::MOST_PRESSURE, most),
            (m::LAST_LOAD, last),
            (m::LIMIT_LOAD, limit),
            (
                m::GROWTH,
                if is_driven(&self.parameters) {
                    seen.growth()
                } else {
                    f64::NAN
                },
            ),
            (m::UNIFORM_ERROR, self.uniform_error(run)),
            (m::PLASTIC_STRAIN, strain.into_iter().fold(0.0, f64::max)),
            (m::SUPPORT_ERROR, above((held / all - 1.0).abs())),
            (m::MASS_ERROR, above(lost)),
            (m::TURNOVER, seen.turnover / swept),
            (m::NEWTON_ITERATIONS, work.newton_iterations as f64),
            (m::MOST_ITERATIONS, seen.most as f64),
            (
                m::ENTRIES,
                work.nonzeros as f64 / work.factorisations.max(1) as f64,
            ),
        ]
    }
}

/// Volumes of the particles (m³, m² in plane strain) by their identity.
fn volumes<const D: usize>(run: &dyn Simulation<D>) -> Vec<f64> {
    let p = run.particles();
    p.seeded(|k| p.volume[k])
}
