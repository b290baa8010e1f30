//! A slide in plane strain or in three dimensions: gravity, then the reduced strength.

use super::look::{Look, Series, State, spread_over_width};
use super::*;
use crate::cases::slope::ground::{BASE, Ground, RISE, ROW, STAGE, STAGE_DAMPING};
use crate::cases::slope::section::GRAVITY;

/// Width (m) in full, and cells across a slice.
const FULL: f64 = 5.0;
const SLICE: f64 = 4.0;
/// Distance from the back wall, over the height, within which the stress is that of level ground.
const FAR: f64 = 0.5;
/// Times (s) of the snapshots.
const SNAPSHOTS: [f64; 5] = [0.5, 1.0, 2.5, 4.0, 5.5];
/// Rows between two frames of the animation, and the largest number of particles that is animated.
const FRAME: usize = 20;
const ANIMATED: usize = 20_000;
/// Times (s) at which the flow is still one slide, uniform over the width, and at which it is fastest.
const EARLY: f64 = 0.5;
const FLOWING: f64 = 2.5;

/// Measures at the end of the gravity stage.
const AT_REST: [Metric; 4] = [KINETIC_SHARE_AT_REST, CHECKERBOARD_AT_REST, YIELDED_AT_REST, WIDTH_SPREAD_AT_REST];

/// Sums up to the moment when the current strength began to hold.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct Before {
    /// Time (s) and steps since the reduction began.
    time: f64,
    steps: u64,
    /// Stress work (J) since then.
    stress_work: f64,
    /// Energy that flow had dissipated (J/m³), and the plastic strain, of every particle in seeding order.
    dissipated: Vec<f64>,
    plastic_strain: Vec<f64>,
}

#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct Seen {
    /// Factor by which the peak has been divided; none under rising gravity.
    reduction: Option<f64>,
    before: Before,
    /// The end of the gravity stage, and the values of [`AT_REST`].
    rest: State,
    at_rest: [f64; 4],
    /// Places (m) in the section and vertical stresses (Pa) when the strength is reduced, in seeding order.
    released: Vec<[f64; 2]>,
    stress: Vec<f64>,
    pub(super) series: Series,
    early_spread: f64,
    /// Rms of σ_m − Πσ_m over γ H in the flow.
    checkerboard: f64,
}

impl Seen {
    /// The crest's settlement (m) at the end of the gravity stage, and 0.5 s after the reduction.
    pub(super) fn settlements(&self) -> [f64; 2] {
        let early = self.series.at(EARLY);
        let early = early.map_or(f64::NAN, |state| state.settlement);
        [self.rest.settlement, early]
    }
}

impl Setup<Landslide> {
    /// Width (m) in three dimensions.
    fn whole_width(&self) -> Result<f64, Error> {
        let (h, given) = (self.h, self.width);
        let width = match self.level.starts_with("slice") {
            _ if given > 0.0 => given,
            true => SLICE * h,
            false => FULL,
        };
        let cells = width / h;
        if (cells - cells.round()).abs() > 1e-9 || cells < SLICE - 0.5 {
            return Err(Error::Input(format!(
                "parameter width: {width} m is {cells} cells of {h} m; allowed: a whole number of cells, four or more"
            )));
        }
        Ok(width)
    }

    /// The strength with its peak, and only that, divided by `reduction`.
    fn strength(&self, reduction: f64) -> Result<Strength, Fault> {
        let peak = self.peak_strength / reduction;
        Strength::softening(peak, self.residual_strength.min(peak), self.softening)
    }
}

/// A slide: first under rising gravity with its full strength, then with the reduced one.
pub(super) struct Slide<const D: usize> {
    setup: Setup<Landslide>,
    ground: Ground<D>,
    /// Places (m) of the particles in the section.
    reference: Vec<[f64; 2]>,
}

impl<const D: usize> Slide<D> {
    /// Ends the gravity stage.
    fn release(&self, seen: &mut Seen, phase: &mut Phase<D>) -> Result<(), Fault> {
        self.measure_rest(seen, phase.run.as_mut());
        seen.released = positions(phase.run.as_ref());
        self.reduce(seen, phase)?;
        // Sums begin anew here.
        seen.rest.stress_work = 0.0;
        (seen.before.time, seen.before.steps, seen.before.stress_work) = (0.0, 0, 0.0);
        Ok(())
    }

    /// Reduces the strength to that of the next row.
    fn reduce(&self, seen: &mut Seen, phase: &mut Phase<D>) -> Result<(), Fault> {
        let run = phase.run.as_mut();
        let (time, steps, totals) = (run.time(), run.work().steps, run.totals());
        let plastic_strain = plastic_strain(run);
        seen.before = Before {
            time: seen.before.time + time,
            steps: seen.before.steps + steps,
            stress_work: seen.before.stress_work + totals.accumulated.stress_work,
            dissipated: self.dissipated(seen, &plastic_strain)?,
            plastic_strain,
        };
        let body = run.body()?;
        seen.reduction = Some(self.next_reduction(seen));
        phase.enter(self.begin(seen)?, Some(&body))
    }

    fn strength(&self, seen: &Seen) -> Result<Strength, Fault> {
        self.setup.strength(seen.reduction.unwrap_or(1.0))
    }

    /// The factor by which the peak strength is divided during the next row.
    fn next_reduction(&self, seen: &Seen) -> f64 {
        let share = (seen.series.rows.len() + 1) as f64 * ROW / self.setup.release.max(ROW);
        match self.setup.reduction {
            whole if share > 1.0 - 1e-9 => whole,
            whole => 1.0 + (whole - 1.0) * share,
        }
    }

    /// The slope with these places (m) and plastic strains.
    fn look<'a>(&'a self, positions: &'a [[f64; 2]], plastic_strain: &'a [f64]) -> Look<'a> {
        Look {
            section: &self.ground.slope.section,
            spacing: self.ground.spacing,
            across: self.ground.across,
            reference: &self.reference,
            positions,
            plastic_strain,
        }
    }

    fn observe(&self, seen: &Seen, run: &mut dyn Simulation<D>) -> Result<State, Fault> {
        let (positions, plastic_strain) = (positions(run), plastic_strain(run));
        let look = self.look(&positions, &plastic_strain);
        let (totals, p) = (run.totals(), run.particles());
        let potential: f64 = p.mass.iter().zip(&p.position).map(|(m, x)| m * GRAVITY * x[1]).sum();
        let per_metre = 1.0 / self.ground.width;
        let volume = self.ground.spacing.powi(D as i32);
        let dissipated = self.dissipated(seen, &plastic_strain)?;
        Ok(State {
            time: seen.before.time + run.time(),
            toe: look.toe(),
            bulk_toe: look.bulk_toe(),
            settlement: look.settlement(),
            kinetic: per_metre * totals.kinetic_energy,
            potential: per_metre * potential,
            stress_work: per_metre * (seen.before.stress_work + totals.accumulated.stress_work),
            stored: per_metre * totals.stored_energy,
            dissipated: per_metre * (volume * dissipated.iter().sum::<f64>()),
            base_force: 0.0,
            failed: look.failed(&seen.released),
            retrogression: look.retrogression(&seen.released),
            bands: look.bands().len() as f64,
            jacobian: totals.jacobian,
            log_jacobian_gap: totals.log_jacobian_gap_rms,
        })
    }

    /// Energy that flow has dissipated (J/m³) at every particle: with former strengths, then with the current one.
    fn dissipated(&self, seen: &Seen, now: &[f64]) -> Result<Vec<f64>, Fault> {
        let strength = self.strength(seen)?;
        let work = |strain: f64| strength.plastic_work(strain);
        let before = seen.before.dissipated.iter().zip(&seen.before.plastic_strain);
        let added = before.zip(now);
        Ok(added.map(|((dissipated, before), now)| dissipated + work(*now) - work(*before)).collect())
    }

    /// Rms of σ_m − Πσ_m over γ H.
    fn checkerboard(&self, run: &mut dyn Simulation<D>) -> f64 {
        let mean = run.field(Field::MeanStress);
        let averaged = run.field(Field::AveragedMeanStress);
        checkerboard(&mean, &averaged) / self.ground.overburden()
    }

    /// Rms over the particles far from the face of the vertical stress (Pa) less the weight above, over γ H; by where they
    /// start (m).
    pub(super) fn overburden_error(&self, references: &[[f64; 2]], stress: &[f64]) -> f64 {
        let (weight, height) = (self.ground.slope.density * GRAVITY, self.ground.slope.section.height);
        let far = references.iter().zip(stress).filter(|(x, _)| x[0] < FAR * height);
        rms(far.map(|(x, stress)| stress + weight * (height - x[1]))) / self.ground.overburden()
    }

    /// Force on the base over the weight of the ground, whose mass is `mass` (kg).
    pub(super) fn base_reaction(&self, rest: &State, mass: f64) -> (Metric, f64) {
        (BASE_REACTION_RATIO, rest.base_force / (mass * GRAVITY / self.ground.width))
    }

    fn measure_rest(&self, seen: &mut Seen, run: &mut dyn Simulation<D>) {
        let stress = run.force_stress();
        seen.stress = run.particles().seeded(|k| stress[k].get(1, 1));
        let strain = plastic_strain(run);
        let yielded = strain.iter().filter(|e| **e > 0.0).count();
        seen.at_rest = [
            run.residual().kinetic_energy / run.totals().stored_energy,
            self.checkerboard(run),
            yielded as f64 / strain.len() as f64,
            spread_over_width(&moved(run), self.ground.across),
        ];
    }
}

/// Places (m) in the section, in seeding order.
fn positions<const D: usize>(run: &dyn Simulation<D>) -> Vec<[f64; 2]> {
    let p = run.particles();
    p.seeded(|k| [p.position[k][0], p.position[k][1]])
}

fn plastic_strain<const D: usize>(run: &mut dyn Simulation<D>) -> Vec<f64> {
    let strain = run.field(Field::PlasticStrain);
    run.particles().seeded(|k| strain[k])
}

/// Distance (m) of every particle from its reference position, in seeding order.
fn moved<const D: usize>(run: &dyn Simulation<D>) -> Vec<f64> {
    let p = run.particles();
    let distance = |k: usize| {
        let squares = p.position[k].iter().zip(&p.reference[k]).map(|(x, reference)| (x - reference).powi(2));
        squares.sum::<f64>().sqrt()
    };
    p.seeded(distance)
}

/// A breakdown, with time and steps of the strengths that held before since the release.
fn since_release(before: &Before, error: Fault) -> Fault {
    match error {
        mpm_core::Error::Breakdown { time, step, particle, fault } => {
            mpm_core::Error::Breakdown { time: before.time + time, step: before.steps + step, particle, fault }
        }
        other => other,
    }
}

fn fields<const D: usize>(columns: Columns<D>) -> Columns<D> {
    columns.field("plastic_strain", "-", Field::PlasticStrain).field("mean_stress", "Pa", Field::MeanStress)
}

impl<const D: usize> Problem<D> for Slide<D> {
    type Parameters = Landslide;
    type Seen = Seen;

    fn new(setup: Setup<Landslide>) -> Result<Self, Error> {
        let width = if D == 3 { setup.whole_width()? } else { 1.0 };
        let ground = Ground::new(&setup, width)?;
        // A wrong reduced strength is an error before anything moves.
        setup.strength(setup.reduction)?;
        let places = setup.start_at(ground.seed());
        Ok(Self { setup, ground, reference: places.iter().map(|x| [x[0], x[1]]).collect() })
    }

    fn unseen(&self) -> Seen {
        let particles = self.reference.len();
        Seen {
            before: Before {
                dissipated: vec![0.0; particles],
                plastic_strain: vec![0.0; particles],
                ..Before::default()
            },
            early_spread: f64::NAN,
            checkerboard: f64::NAN,
            ..Seen::default()
        }
    }

    fn discretisation(&self) -> Discretisation {
        self.setup.regular(D, self.ground.dt)
    }

    fn begin(&self, seen: &Seen) -> Begun<D> {
        let (rise, damping) = if seen.reduction.is_none() { (RISE, STAGE_DAMPING) } else { (0.0, self.setup.damping) };
        let scene = self.ground.scene(&self.setup, self.ground.slope.law(self.strength(seen)?)?, rise)?;
        let settings = self.setup.settings(self.ground.dt, damping)?;
        mpm_solvers::solver(self.setup.scheme, scene, settings)
    }

    fn row(&self, seen: &mut Seen, phase: &mut Phase<D>) -> Result<Row, Fault> {
        let base = |phase: &Phase<D>| phase.run.on(Part::Constraint(BASE)).impulse[1];
        let before = base(phase);
        phase.steps(self.ground.steps_per_row).map_err(|e| since_release(&seen.before, e))?;
        let mut state = self.observe(seen, phase.run.as_mut())?;
        state.base_force = -(base(phase) - before) / ROW / self.ground.width;
        if seen.reduction.is_none() {
            state.time -= STAGE;
            seen.rest = state;
            if state.time > -0.5 * ROW {
                self.release(seen, phase)?;
            }
            return Ok(state.row());
        }
        seen.series.rows.push(state);
        if seen.reduction != Some(self.next_reduction(seen)) {
            self.reduce(seen, phase)?;
        }
        if (state.time - EARLY).abs() < 0.5 * ROW {
            seen.early_spread = spread_over_width(&moved(phase.run.as_ref()), self.ground.across);
        }
        if (state.time - FLOWING).abs() < 0.5 * ROW {
            seen.checkerboard = self.checkerboard(phase.run.as_mut());
        }
        Ok(state.row())
    }

    fn progress(&self, _: &Seen, phase: &Phase<D>) -> f64 {
        let rows = ((STAGE + self.setup.duration) / ROW).round();
        (phase.work().steps / self.ground.steps_per_row) as f64 / rows
    }

    fn snapshot(&self, seen: &Seen, phase: &mut Phase<D>) -> Option<Snapshot> {
        let rows = seen.series.rows.len();
        let time = seen.series.rows.last()?.time;
        let shown = SNAPSHOTS.iter().any(|t| (t - time).abs() < 0.5 * ROW);
        let few = self.reference.len() <= ANIMATED;
        let kept = shown || few && rows.is_multiple_of(FRAME);
        kept.then(|| Snapshot { time, columns: fields(Columns::positions(phase.run.as_mut())).done() })
    }

    fn particles<'a>(&self, seen: &Seen, columns: Columns<'a, D>) -> Columns<'a, D> {
        let at_rest = |id: u32| seen.stress.get(id as usize).copied().unwrap_or(f64::NAN);
        fields(columns).references().jacobian().each("rest_stress_yy", "Pa", |p, k| at_rest(p.id[k]))
    }

    fn metrics(&self, seen: &Seen, phase: &mut Phase<D>) -> Vec<(Metric, f64)> {
        let run = phase.run.as_mut();
        let (rest, totals) = (&seen.rest, run.totals());
        let (positions, plastic_strain) = (positions(run), plastic_strain(run));
        let bands = self.look(&positions, &plastic_strain).bands();
        let mut values = seen.series.metrics(&self.ground.slope.section, rest);
        let rearmost = bands.into_iter().fold(f64::NAN, f64::max);
        values.extend([
            (REARMOST_BAND_END, rearmost),
            (PARTICLES, self.reference.len() as f64),
            (PARTICLES_ACROSS, self.ground.across as f64),
            (MASS, totals.mass / self.ground.width),
            self.base_reaction(rest, totals.mass),
            (OVERBURDEN_ERROR, self.overburden_error(&self.reference, &seen.stress)),
            (CHECKERBOARD_2_5S, seen.checkerboard),
        ]);
        let known = if D == 3 { 4 } else { 3 };
        values.extend(AT_REST.into_iter().zip(seen.at_rest).take(known));
        if D == 3 {
            let end = spread_over_width(&moved(run), self.ground.across);
            values.extend([(WIDTH_SPREAD_0_5S, seen.early_spread), (WIDTH_SPREAD_END, end)]);
        }
        values
    }
}

#[cfg(test)]
mod tests;
