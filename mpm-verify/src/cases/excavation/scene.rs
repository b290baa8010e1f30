//! Scenes of the excavation: ground, base, rollers, and what follows from the parameters.

use super::*;
use crate::exact::slope::Slope;
use mpm_core::implicit::{Settings, TimeRule};
use mpm_core::material::HypoelasticJ2;
use mpm_solvers::implicit;
use std::f64::consts::FRAC_PI_4;

/// Height (m) of the slope, and its run, at 45°.
pub(super) const HEIGHT: f64 = 1.0;
/// Acceleration of gravity (m/s²), which makes a mass of the paper's unit weight.
pub(super) const GRAVITATION: f64 = 9.81;
/// Room beyond the toe (m), and cells above the crest and below a base with friction.
const ROOM: f64 = 4.0;
const MARGIN: usize = 4;
/// Reach d̂ of the base's barrier over the cell size: that of the lowest particles of four a cell.
const REACH: f64 = 0.25;
/// Share of its reach by which the barrier gives way under the full height.
const GIVES_WAY: f64 = 0.1;
/// Time (s) between two rows after the excavation, of which there is one at least, as nearly as they fit.
const ROW: f64 = 0.05;
/// Indices of the constraints of the scene; a base with friction is the first contact instead.
pub(super) const ROLLERS: usize = 0;
pub(super) const HELD_BASE: usize = 1;
/// The stages of a run, each of which takes over the ground of the one before.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Stage {
    /// Gravity rises on the whole slope; equilibrium in every step.
    #[default]
    Gravity,
    /// Motion of the whole slope under full gravity, where there was no equilibrium.
    Settling,
    /// Equilibrium of the cut slope, of a static scheme.
    Cut,
    /// Motion of the cut slope.
    Collapse,
    Over,
}

impl Stage {
    /// Whether the wedge at the toe is there.
    pub(super) fn is_whole(self) -> bool {
        matches!(self, Self::Gravity | Self::Settling)
    }

    pub(super) fn moves(self) -> bool {
        matches!(self, Self::Settling | Self::Collapse)
    }
}

impl Setup<Excavation> {
    pub(super) fn slides(&self) -> bool {
        self.base == Base::Frictional
    }

    pub(super) fn softens(&self) -> bool {
        self.residual < self.peak
    }

    /// Coordinate of the foot of the cut face (m).
    pub(super) fn foot(&self) -> f64 {
        self.crest + HEIGHT - self.cut
    }

    fn density(&self) -> f64 {
        self.unit_weight / GRAVITATION
    }

    fn strength(&self) -> Result<Strength, Fault> {
        let [peak, residual, slope] = [self.peak, self.residual, self.softening].map(|c| SQRT_2 * c);
        Strength::softening_linearly(peak, residual, slope)
    }

    fn hencky(&self) -> Result<HenckyJ2, Fault> {
        HenckyJ2::new(self.young_modulus, self.poisson_ratio, self.strength()?)
    }

    /// Rows of a stage that is run to its end.
    pub(super) fn rows(&self, stage: Stage) -> u64 {
        match stage {
            Stage::Gravity if self.gravity == Raising::Step => 1,
            Stage::Gravity => self.load_steps as u64,
            Stage::Cut => 1,
            Stage::Settling | Stage::Collapse => (self.duration / ROW).round().max(1.0) as u64,
            Stage::Over => 0,
        }
    }

    /// Time step (s) after the excavation, and number of steps in a row.
    fn timing(&self) -> Result<(f64, u64), Fault> {
        let speed = self.hencky()?.wave_speed(self.density());
        let row = self.duration / self.rows(Stage::Collapse) as f64;
        let steps = (row * speed / (self.cfl * self.h)).ceil().max(1.0);
        Ok((row / steps, steps as u64))
    }

    /// Least factor of safety of limit analysis, and the length (m) of the arc or path along which the slope slides: of arcs,
    /// which a rough base allows, and of a foot that slides on its base.
    pub(super) fn factor(&self, cut: f64, cohesion: f64) -> (f64, f64) {
        let slope = Slope::new(HEIGHT, FRAC_PI_4, 1.0).and_then(|s| s.cut(cut));
        let Ok(slope) = slope else { return (f64::NAN, f64::NAN) };
        let arc = slope.critical();
        let length = arc.circle.radius * arc.circle.angle();
        let turning = arc.factor_of_safety(cohesion, self.unit_weight);
        if !self.slides() {
            return (turning, length);
        }
        let sliding = slope.sliding(self.friction, cohesion, self.unit_weight);
        if sliding.factor < turning {
            return (sliding.factor, HEIGHT / sliding.angle.sin());
        }
        (turning, length)
    }

    fn grid(&self) -> Result<Grid<2>, Fault> {
        let cells = |length: f64| (length / self.h).round() as usize;
        let along = cells(self.crest + HEIGHT + ROOM);
        let up = cells(HEIGHT) + MARGIN;
        let upward = if self.slides() {
            Axis::open(-(MARGIN as f64) * self.h, up + MARGIN)
        } else {
            Axis::bounded(0.0, up, (Side::Wall, Side::Open))
        };
        Grid::new(self.h, [Axis::bounded(0.0, along, (Side::Wall, Side::Open)), upward])
    }

    /// Coulomb's friction beneath the particles, with a barrier that just touches the lowest ones.
    fn contact(&self) -> Result<RigidContact<2>, Fault> {
        let reach = REACH * self.h;
        let weight = self.unit_weight * HEIGHT * self.pitch();
        let gap = (1.0 - GIVES_WAY) * reach;
        let barrier = Barrier::carrying_at(weight, gap, reach)?;
        let lowest = 0.5 * self.pitch();
        let face = RigidFace::half_space(1, End::Lo, lowest - 0.5 * (gap + reach))?;
        Ok(RigidContact::new(face, barrier).with_friction(Friction::new(self.friction, barrier.stiffness(gap))?))
    }

    fn stage_settings(&self, stage: Stage) -> Result<Settings, Fault> {
        let (dt, _) = self.timing()?;
        let settings = self.implicit_settings(dt).ok_or(mpm_core::Error::Input {
            what: "solvers of the excavation other than quasi-static, midpoint and newmark",
            value: 1.0,
            allowed: "none",
        })?;
        let settings = if stage.moves() {
            settings
        } else {
            let once = stage == Stage::Gravity && self.gravity == Raising::Step;
            Settings {
                rule: TimeRule::Static,
                dt: 1.0 / self.rows(stage) as f64,
                most_halvings: if once { 0 } else { settings.most_halvings },
                ..settings
            }
        };
        Ok(settings.stabilised(Stabilisation::ghost(self.ghost)))
    }
}

/// The ground in particles.
pub(super) struct Ground {
    pub(super) setup: Setup<Excavation>,
    /// Places (m); the wedge that will be cut away comes last.
    places: Vec<[f64; 2]>,
    /// Indices of the particles on the face, which are half ones.
    halves: Vec<usize>,
    /// Number of particles that stay.
    kept: usize,
    pub(super) strength: Strength,
    pub(super) dt: f64,
    pub(super) steps_in_row: u64,
}

impl Ground {
    pub(super) fn of(setup: Setup<Excavation>) -> Result<Self, Error> {
        let mut foreign = match setup.rule() {
            Some(Midpoint) => vec!["alpha", "delta"],
            Some(Newmark) => vec!["lumped"],
            Some(QuasiStatic) => vec!["alpha", "delta", "lumped", "cfl", "duration"],
            None => {
                let solvers = ["quasi-static", "midpoint", "newmark"];
                return Err(Error::unknown("solver of the excavation", setup.scheme.solver(), solvers));
            }
        };
        foreign.push("wall");
        if !setup.slides() {
            foreign.push("friction");
        }
        if setup.gravity == Raising::Step {
            foreign.push("load_steps");
        }
        setup.forbid(&foreign)?;
        let (dt, steps_in_row) = setup.timing()?;
        let spacing = setup.pitch();
        let [across, up, foot] =
            [setup.crest + HEIGHT, HEIGHT, setup.foot()].map(|length| (length / spacing).round() as usize);
        let rows = (0..across).flat_map(|i| (0..up).map(move |j| (i, j)));
        // Centres on the face have i + j + 1 = `across`.
        let (kept, wedge): (Vec<_>, Vec<_>) = rows.filter(|(i, j)| i + j < across).partition(|(i, _)| *i < foot);
        let all = [kept.as_slice(), wedge.as_slice()].concat();
        let on_face = |(k, (i, j)): (usize, &(usize, usize))| (i + j + 1 == across).then_some(k);
        let centre = |k: usize| (k as f64 + 0.5) * spacing;
        Ok(Self {
            halves: all.iter().enumerate().filter_map(on_face).collect(),
            places: setup.start_at(all.iter().map(|(i, j)| [centre(*i), centre(*j)])),
            kept: kept.len(),
            strength: setup.strength()?,
            dt,
            steps_in_row,
            setup,
        })
    }

    fn particles_of(&self, stage: Stage) -> Result<Particles<2>, Fault> {
        let count = if stage.is_whole() { self.places.len() } else { self.kept };
        let (places, spacing) = (self.places[..count].to_vec(), self.setup.pitch());
        let (density, half_size) = (self.setup.density(), [0.5 * spacing; 2]);
        let mut particles = Particles::new(places, spacing * spacing, density, half_size)?;
        for half in self.halves.iter().filter(|k| **k < count) {
            particles.mass[*half] *= 0.5;
            particles.reference_volume[*half] *= 0.5;
        }
        Ok(particles)
    }

    pub(super) fn simulation(&self, stage: Stage) -> Begun<2> {
        let setup = &self.setup;
        let (young, ratio) = (setup.young_modulus, setup.poisson_ratio);
        let law: SharedLaw = match setup.law == LawName::Hencky {
            true => setup.hencky()?.into(),
            false => HypoelasticJ2::new(young, ratio, JaumannUpdate::Split, setup.strength()?)?.into(),
        };
        let body = Bodies::new(law, self.particles_of(stage)?)?;
        let rises = stage == Stage::Gravity;
        let gravity = move |time: f64| {
            let share = if rises { time } else { 1.0 };
            [0.0, -GRAVITATION * share]
        };
        let scene = Scene::new(self.setup.grid()?, body).load(Gravity(Box::new(gravity))).constrain(roller(0, End::Lo));
        let scene =
            if self.setup.slides() { scene.contact(self.setup.contact()?) } else { scene.constrain(clamp(1, End::Lo)) };
        implicit(self.setup.scheme, scene, self.setup.stage_settings(stage)?)
    }
}
