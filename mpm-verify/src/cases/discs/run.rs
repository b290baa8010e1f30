//! Scene and observations of the discs, four times a second at the paper's speed, as often at others.

use super::*;
use crate::cases::build::DENSITY;
use crate::exact::free_flight::until_met;

/// The centre of symmetry (m).
const MIDDLE: f64 = 0.5;
/// Side of the square of cells (m), and room around it.
const SIDE: f64 = 1.0;
const ROOM: f64 = 0.2;
/// The paper's cell size (m) and time step (s), its duration (s) and speed (m/s).
const CELL: f64 = 0.05;
const STEP: f64 = 0.0025;
const DURATION: f64 = 37.5;
/// Duration (s) with an offset, after which centres that fly freely are half a metre beyond each other.
const DURATION_ASIDE: f64 = 95.0;
pub(super) const AT_SPEED: f64 = 0.005;
/// Way of a disc along each axis before rims touch (m).
const WAY_TO_TOUCH: f64 = 0.3 - 0.2 * std::f64::consts::FRAC_1_SQRT_2;
/// Times in which a wave crosses a disc and comes back, from the touch to the end of a fast run: a few contacts.
const CROSSINGS: f64 = 5.0;

/// Paper's steps in a row.
const ROW: f64 = 100.0;
/// The row of the snapshot, when the discs are at rest, pressed together.
pub(super) const IN_CONTACT: u64 = 95;

impl Setup<Discs> {
    /// Mass (kg/m) of the particles by their shares of a cell.
    pub(super) fn mass_of(&self, particles: u64, ppc: u32) -> f64 {
        particles as f64 * (1000.0 * self.h.powi(2) / f64::from(ppc))
    }

    /// Duration (s): that of the same way at another speed, and no less than fast discs need to part.
    fn duration(&self) -> f64 {
        let lasts = if self.offset > 0.0 { DURATION_ASIDE } else { DURATION };
        let (e, nu) = (self.young_modulus, self.poisson_ratio);
        let wave_speed = (e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)) / DENSITY).sqrt();
        let contact = CROSSINGS * 4.0 * RADIUS / wave_speed;
        (lasts * AT_SPEED / self.speed).max(WAY_TO_TOUCH / self.speed + contact)
    }

    /// Time step (s) and number of steps.
    pub(super) fn timing(&self) -> (f64, u64) {
        let duration = self.duration();
        let dt = STEP * (self.h / CELL) * self.step_factor.value();
        (dt, (duration / dt).ceil() as u64)
    }

    /// Shift of each disc along each axis (m): half of the offset across the diagonal.
    fn aside(&self) -> f64 {
        0.5 * self.offset * std::f64::consts::FRAC_1_SQRT_2
    }

    /// Positions (m) of the particles of one disc after the other; those of the second are mirror images of those of the first
    /// about the centre.
    pub(super) fn seed(&self) -> Vec<[f64; 2]> {
        let spacing = self.pitch();
        let along = (2.0 * RADIUS / spacing).round() as usize;
        let ([[x0, y0], _], aside) = (CENTRES, self.aside());
        let first = by_columns([along; 2], spacing).filter(|[x, y]| (x - x0).hypot(y - y0) <= RADIUS);
        let first: Vec<[f64; 2]> = first.map(|[x, y]| [x + aside, y - aside]).collect();
        let second: Vec<[f64; 2]> = first.iter().map(|[x, y]| [2.0 * MIDDLE - x, 2.0 * MIDDLE - y]).collect();
        [first, second].concat()
    }
}

#[derive(Default, Clone, Copy, Serialize, Deserialize)]
struct Sums {
    momentum: [f64; 2],
    angular: f64,
    /// Σ|p| (kg m/s).
    magnitude: f64,
    /// Velocity of the first disc against the second (m/s).
    relative: [f64; 2],
    /// Kinetic, stored, accumulated (J).
    energies: [f64; 3],
}

#[derive(Default, Clone, Serialize, Deserialize)]
pub(super) struct Extremes {
    steps: u64,
    start: Option<Sums>,
    gain: f64,
    loss: f64,
    accumulated: f64,
    momentum: f64,
    angular: f64,
    node_gap: f64,
    closest: f64,
    /// The stored energy of the last step (J), and the most that a step changed it by.
    stored: f64,
    exchanged: f64,
    /// The relative velocity (m/s) of the last step, and the most that a step changed it by.
    relative: Option<[f64; 2]>,
    kick: f64,
    /// Largest change of a velocity, and of a volume, in free flight.
    flight: [f64; 2],
    rows: u64,
}

pub(super) struct Collision {
    setup: Setup<Discs>,
    steps: u64,
    /// Particles of a disc, the first ones in seeding order.
    half: usize,
    /// See [`FREE_UNTIL`].
    free: Option<f64>,
}

impl Collision {
    fn sums(&self, run: &dyn Simulation<2>) -> Sums {
        let totals = run.totals();
        let p = run.particles();
        let mut sums = Sums {
            energies: [totals.kinetic_energy, totals.stored_energy, totals.accumulated.stress_work],
            ..Sums::default()
        };
        for (k, ((x, v), m)) in p.position.iter().zip(&p.velocity).zip(&p.mass).enumerate() {
            let sign = self.sign(p.id[k]) / self.half as f64;
            for a in 0..2 {
                sums.momentum[a] += m * v[a];
                sums.relative[a] += sign * v[a];
            }
            sums.angular += m * ((x[0] - MIDDLE) * v[1] - (x[1] - MIDDLE) * v[0]);
            if let Some(b) = p.affine.get(k) {
                sums.angular += m * (b[(1, 0)] - b[(0, 1)]);
            }
            sums.magnitude += m * v[0].hypot(v[1]);
        }
        sums
    }

    /// 1 of the first disc, −1 of the second.
    fn sign(&self, id: u32) -> f64 {
        if (id as usize) < self.half { 1.0 } else { -1.0 }
    }

    /// Largest change of a particle's velocity, over its speed, and of its volume, over it.
    fn flight(&self, run: &dyn Simulation<2>) -> [f64; 2] {
        let p = run.particles();
        let speed = self.setup.speed;
        let changes = p.velocity.iter().zip(&p.id).map(|(v, id)| {
            let own = self.sign(*id) * speed;
            (v[0] - own).hypot(v[1] - own) / (speed * 2f64.sqrt())
        });
        [changes.fold(0.0, f64::max), p.jacobian.iter().map(|j| (j - 1.0).abs()).fold(0.0, f64::max)]
    }

    /// Distance of the centres of mass (m).
    fn distance(&self, run: &dyn Simulation<2>) -> f64 {
        let p = run.particles();
        let mut apart = [0.0; 2];
        for (x, id) in p.position.iter().zip(&p.id) {
            for (sum, x) in apart.iter_mut().zip(x) {
                *sum += self.sign(*id) * x / self.half as f64;
            }
        }
        apart[0].hypot(apart[1])
    }

    fn note(&self, seen: &mut Extremes, run: &dyn Simulation<2>, start: &Sums) {
        let sums = self.sums(run);
        let [k0, s0, a0] = start.energies;
        let [k, s, a] = sums.energies;
        let whole = k0 + s0;
        let rise = (k + s) / whole - 1.0;
        seen.gain = seen.gain.max(rise);
        seen.loss = seen.loss.max(-rise);
        seen.accumulated = seen.accumulated.max(((k + (a - a0)) / k0 - 1.0).abs());
        seen.node_gap = seen.node_gap.max((k - run.residual().kinetic_energy) / whole);
        let change = [0, 1].map(|i| sums.momentum[i] - start.momentum[i]);
        let momentum = change[0].hypot(change[1]) / start.magnitude;
        seen.momentum = seen.momentum.max(momentum);
        let angular = (sums.angular - start.angular).abs() / (start.magnitude * 2.0 * RADIUS);
        seen.angular = seen.angular.max(angular);
        seen.closest = seen.closest.min(self.distance(run));
        seen.exchanged = seen.exchanged.max((s - seen.stored).abs() / whole);
        seen.stored = s;
        let [before, now] = [seen.relative.unwrap_or(start.relative), sums.relative];
        seen.kick = seen.kick.max((now[0] - before[0]).hypot(now[1] - before[1]));
        seen.relative = Some(now);
        if self.free.is_none_or(|free| run.time() <= free) {
            let now = self.flight(run);
            seen.flight = [0, 1].map(|i| seen.flight[i].max(now[i]));
        }
    }

    /// See [`ASYMMETRY`].
    fn asymmetry(&self, run: &dyn Simulation<2>) -> f64 {
        let p = run.particles();
        let places = p.seeded(|k| p.position[k]);
        let (first, second) = places.split_at(self.half);
        let pairs = first.iter().zip(second);
        let gap = |(a, b): (&[f64; 2], &[f64; 2])| {
            let [x, y] = [0, 1].map(|i| a[i] + b[i] - 2.0 * MIDDLE);
            x.hypot(y) / RADIUS
        };
        pairs.map(gap).fold(0.0, f64::max)
    }
}

impl Problem<2> for Collision {
    type Parameters = Discs;
    type Seen = Extremes;

    fn new(setup: Setup<Discs>) -> Result<Self, Error> {
        setup.check_rule()?;
        let (dt, steps) = setup.timing();
        let why = "m: a disc that moves by more than a cell in a step flies through the other";
        require_quotient("speed times the time step of step_factor", setup.speed * dt, 0.0..=setup.h, why)?;
        let (places, duration) = (setup.seed(), steps as f64 * dt);
        let half = places.len() / 2;
        let free = if setup.contact == Contact::Bodies {
            // Domains of particles end half their distance beyond the rims, at most.
            let way = (2.0 * RADIUS + setup.pitch()).powi(2) - setup.offset.powi(2);
            let gap = (CENTRES[1][0] - CENTRES[0][0]) * SQRT_2 - way.max(0.0).sqrt();
            Some(gap / (2.0 * SQRT_2 * setup.speed)).filter(|time| way >= 0.0 && *time <= duration)
        } else {
            let functions = (setup.basis(), setup.h, 0.5 / setup.ppc_per_direction as f64);
            until_met([&places[..half], &places[half..]], functions, setup.speed, duration)
        };
        Ok(Self { setup, steps, half, free })
    }

    fn unseen(&self) -> Extremes {
        Extremes { closest: f64::INFINITY, ..Extremes::default() }
    }

    fn discretisation(&self) -> Discretisation {
        self.setup.regular(2, self.setup.timing().0)
    }

    fn begin(&self, _: &Extremes) -> Begun<2> {
        let h = self.setup.h;
        let way = self.setup.duration() * self.setup.speed;
        let beyond = way - DURATION * AT_SPEED + self.setup.aside();
        let room = (ROOM / h).round() + (beyond / h).ceil();
        let cells = (SIDE / h).round() + 2.0 * room;
        let grid = Grid::new(h, [Axis::open(-room * h, cells as usize); 2])?;
        let mut particles = self.setup.particles_at(self.setup.seed(), self.setup.pitch(), DENSITY)?;
        let speed = self.setup.speed;
        for (k, velocity) in particles.velocity.iter_mut().enumerate() {
            *velocity = if k < self.half { [speed; 2] } else { [-speed; 2] };
        }
        let law = NeoHookean::new(self.setup.young_modulus, self.setup.poisson_ratio)?;
        let bodies = match self.setup.contact {
            Contact::Grid => Bodies::new(law, particles)?,
            Contact::Bodies => {
                let disc = |first: usize| {
                    let mut particles = particles.clone();
                    particles.permute(&(first as u32..(first + self.half) as u32).collect::<Vec<_>>());
                    particles.id = (0..self.half as u32).collect();
                    particles
                };
                Bodies::new(law, disc(0))?.and(law, disc(self.half))?.sliding(0.0)?
            }
        };
        self.setup.moving(Scene::new(grid, bodies), self.setup.timing().0, 0.0)
    }

    fn row(&self, seen: &mut Extremes, phase: &mut Phase<2>) -> Result<Row, Fault> {
        let start = *seen.start.get_or_insert_with(|| self.sums(phase.run.as_ref()));
        let finer = CELL / self.setup.h;
        let paper = ROW * finer / self.setup.step_factor.value() * (AT_SPEED / self.setup.speed);
        let steps = (paper.round() as u64).max(1).min(self.steps - seen.steps);
        let before = phase.run.work().newton_iterations;
        for _ in 0..steps {
            phase.steps(1)?;
            seen.steps += 1;
            self.note(seen, phase.run.as_ref(), &start);
        }
        seen.rows += 1;
        let run = phase.run.as_ref();
        let sums = self.sums(run);
        let [k0, s0, _] = start.energies;
        let [k, s, a] = sums.energies;
        Ok(row! {
            "time (s)": run.time(),
            "kinetic_energy (J/m)": k,
            "node_kinetic_energy (J/m)": run.residual().kinetic_energy,
            "stored_energy (J/m)": s,
            "stress_work (J/m)": a,
            "energy_change (-)": (k + s) / (k0 + s0) - 1.0,
            "accumulated_change (-)": (k + a) / k0 - 1.0,
            "momentum_x (kg/s)": sums.momentum[0],
            "momentum_y (kg/s)": sums.momentum[1],
            "angular_momentum (kg m/s)": sums.angular,
            "distance (m)": self.distance(run),
            "newton_iterations (-)": (run.work().newton_iterations - before) as f64,
        })
    }

    fn progress(&self, seen: &Extremes, _: &Phase<2>) -> f64 {
        seen.steps as f64 / self.steps as f64
    }

    fn snapshot(&self, seen: &Extremes, phase: &mut Phase<2>) -> Option<Snapshot> {
        (seen.rows == IN_CONTACT).then(|| self.snapshot_at(phase.run.time(), seen, phase))
    }

    fn particles<'a>(&self, _: &Extremes, columns: Columns<'a, 2>) -> Columns<'a, 2> {
        columns.velocities().each("mean_stress", "Pa", |p, k| p.stress[k].mean()).jacobian()
    }

    fn metrics(&self, seen: &Extremes, phase: &mut Phase<2>) -> Vec<(Metric, f64)> {
        let run = phase.run.as_ref();
        let sums = self.sums(run);
        let start = seen.start.unwrap_or(sums);
        let [k0, s0, _] = start.energies;
        let [k, s, _] = sums.energies;
        let work = run.work();
        let [before, after] = [start.relative, sums.relative];
        let closing = before[0].hypot(before[1]);
        let turned = (after[0] - before[0]).hypot(after[1] - before[1]);
        let mut values = vec![
            (ENERGY_GAIN, seen.gain),
            (ENERGY_LOSS, seen.loss),
            (ENERGY_END, (k + s) / (k0 + s0) - 1.0),
            (ENERGY_ERROR_ACCUMULATED, seen.accumulated),
            (LUMPING_LOSS, run.totals().accumulated.lumping_loss / (k0 + s0)),
            (NODE_ENERGY_GAP, seen.node_gap),
            (MOMENTUM_ERROR, seen.momentum.max(LEAST_ERROR)),
            (ANGULAR_MOMENTUM_ERROR, seen.angular.max(LEAST_ERROR)),
            (ENERGY_EXCHANGED, seen.exchanged),
            (RESTITUTION, after[0].hypot(after[1]) / closing),
            (DEFLECTION, turned / closing),
            (IMPULSE_OF_A_STEP, seen.kick / turned.max(closing)),
            (FLIGHT_ERROR, seen.flight[0].max(LEAST_ERROR)),
            (FLIGHT_STRAIN, seen.flight[1].max(LEAST_ERROR)),
            (ASYMMETRY, self.asymmetry(run).max(ROUNDING)),
            (CLOSEST, seen.closest),
            (NEWTON_ITERATIONS, work.newton_iterations as f64),
            (MASS, run.totals().mass),
        ];
        values.extend(self.free.map(|free| (FREE_UNTIL, free)));
        values
    }
}
