//! From a scene file to scenes: grid, body, what acts on it, phase by phase.

use super::amplitude::{Amplitudes, amplitudes};
use super::body::{check_bodies, other_laws};
use super::contact::{Surface, contact, surface};
use super::fault::{Line, Source};
use super::form::{
    AxisForm, ConductivityForm, EndForm, EndsForm, FaceForm, Finite, Form, Name, NotNegative, SupportForm, WallForm,
    WallsForm,
};
use super::phase::{Phase, phases, scheme};
use super::shape::{Seeds, ends, holds, seed, vector};
use super::weight::weigh;
use crate::cases::prelude::*;
use crate::size::Size;
use mpm_core::basis::WallTreatment;
use mpm_core::explicit;
use mpm_core::implicit::{self, TimeRule};
use mpm_core::poro::{self, Face, PressureSpace};
use mpm_core::stage::{Constraint, HOLDS_NOTHING, KineticDamping, LocalDamping, MovingNodes, RigidNodes};
use std::sync::Mutex;

/// Most cells of a grid.
const MOST_CELLS: f64 = 1e8;

/// Relative difference of two lengths that is rounding.
const ROUNDING: f64 = 1e-9;

/// A part of a scene: its place in the file, its name and the phases in which it acts.
type Named<'a> = (std::ops::Range<usize>, &'a str, &'a [String]);

/// Everything that a run of a scene file needs.
pub(super) struct Setup<const D: usize> {
    pub(super) form: Form,
    pub(super) scheme: Scheme,
    pub(super) phases: Vec<Phase>,
    pub(super) amplitudes: Amplitudes,
    /// The surfaces of all contacts; a plane face has no such surface.
    pub(super) surfaces: Vec<Option<Surface<D>>>,
    pub(super) grid: Grid<D>,
    pub(super) seeds: Seeds<D>,
    /// Where the particles of every body end among all, and the laws of the bodies after the first one.
    pub(super) ends: Vec<usize>,
    pub(super) others: Vec<SharedLaw>,
    pub(super) spacing: f64,
    /// Size as it was weighed.
    pub(super) size: Size,
    /// The simulation of the first phase at its start, until a run begins with it.
    first: Mutex<Option<Box<dyn Simulation<D>>>>,
}

impl<const D: usize> Setup<D> {
    /// Set-up of the scene in a file.
    pub(super) fn new(source: &Source, mut form: Form) -> Result<Self, Error> {
        let grid = grid(source, &form)?;
        let scheme = scheme(source, &form)?;
        form.fill(scheme);
        check_bodies(source, &form, scheme)?;
        let spacing = grid.h / f64::from(per_direction(&form));
        let size = weigh(source, &form, &grid, spacing, scheme)?;
        if let Some(why) = size.too_large(source.memory) {
            return Err(source.at(&form.grid, why + "; larger cells or fewer particles_per_direction make it smaller"));
        }
        let (seeds, ends) = seed(source, &form, &grid, spacing)?;
        let others = other_laws(source, &form)?;
        let phases = phases(source, &form, scheme, grid.h, &others)?;
        let amplitudes = amplitudes(source, &form)?;
        let surfaces = form.contacts.iter().map(|contact| surface(source, contact)).collect::<Result<_, _>>()?;
        let setup = Self {
            scheme,
            phases,
            amplitudes,
            surfaces,
            grid,
            seeds,
            ends,
            others,
            spacing,
            size,
            form,
            first: Mutex::new(None),
        };
        setup.check(source)?;
        setup.check_geostatic(source)?;
        Ok(setup)
    }

    /// That what acts has as many components as the grid has axes, and acts in phases that there are.
    fn check(&self, source: &Source) -> Result<(), Error> {
        let known = |at: &std::ops::Range<usize>, phases: &[String]| {
            let unknown = phases.iter().find(|name| self.phases.iter().all(|p| p.name != **name));
            let Some(name) = unknown else { return Ok(()) };
            let names: Vec<&str> = self.phases.iter().map(|p| &*p.name).collect();
            Err(source.fault(at, format!("unknown phase {name:?}; allowed: {}", names.join(", "))))
        };
        for load in &self.form.loads {
            self.check_load(source, load)?;
            known(&load.span(), load.get_ref().when().2)?;
        }
        for support in &self.form.supports {
            let axes: Vec<AxisForm> = match support.get_ref() {
                SupportForm::Wall { axis, .. } => vec![*axis],
                SupportForm::Nodes { velocity_m_s, .. } => velocity_m_s.keys().copied().collect(),
            };
            axes.iter().try_for_each(|axis| own_axis::<D, _>(source, support, *axis))?;
            self.check_support(source, support)?;
        }
        let named = self.named().concat();
        for (k, (at, name, phases)) in named.iter().enumerate() {
            known(at, phases)?;
            let same = |(_, other, others): &&(_, &str, &[String])| {
                other == name && self.phases.iter().any(|p| acts(others, &p.name) && acts(phases, &p.name))
            };
            if named[..k].iter().any(|other| same(&other)) {
                return Err(source.fault(at, format!("a second support, contact or body {name:?} in a phase")));
            }
        }
        for contact in &self.form.contacts {
            let form = contact.get_ref();
            form.axis.map_or(Ok(()), |axis| own_axis::<D, _>(source, contact, axis))?;
            if let Some(velocity) = &form.velocity_m_s {
                vector::<D, _>(source, contact, "velocity_m_s", velocity)?;
            }
        }
        let faces = self.form.water.iter().flat_map(|w| &w.get_ref().faces);
        for face in faces {
            let form = face.get_ref();
            own_axis::<D, _>(source, face, form.axis)?;
            if form.traction_pa.is_some() == form.drain_penalty_m_pa_s.is_some() {
                return Err(source.at(face, "a face has either traction_pa or drain_penalty_m_pa_s"));
            }
            if let Some(traction) = &form.traction_pa {
                vector::<D, _>(source, face, "traction_pa", traction)?;
            }
        }
        Ok(())
    }

    /// Refuses a wall where the grid has none, and nodes that move away from their region, which stays: by more than half a
    /// cell along an axis where it ends.
    fn check_support(&self, source: &Source, support: &Line<SupportForm>) -> Result<(), Error> {
        let (within, velocity_m_s, moves) = match support.get_ref() {
            SupportForm::Wall { kind: WallForm::Separable, .. } if self.scheme.transfer() == TransferName::Musl => {
                let said = "musl gains energy at a separable wall, up to a fifth in an impact: a roller or another transfer is allowed";
                return Err(source.at(support, said));
            }
            SupportForm::Wall { kind, friction: Some(_), .. }
                if !matches!(kind, WallForm::Separable) || self.scheme.transfer() == TransferName::Xpic2 =>
            {
                let said = "friction of a wall is of kind = \"separable\" and of a transfer other than xpic; a contact \
                            with a face has friction in any scheme";
                return Err(source.at(support, said));
            }
            SupportForm::Wall { axis, end, .. } => {
                let (lo, hi) = self.grid.axes[*axis as usize].wall_ends();
                let there = matches!(end, EndForm::Lo) && lo || matches!(end, EndForm::Hi) && hi;
                let said = "a wall at an end of the grid that has none";
                return if there { Ok(()) } else { Err(source.at(support, said)) };
            }
            SupportForm::Nodes { within, velocity_m_s, moves, .. } => (within, velocity_m_s, *moves),
        };
        if moves && velocity_m_s.values().all(|velocity| velocity.0 == 0.0) {
            return Err(source.at(support, "moves = true with no velocity_m_s but zero: a region that moves has one"));
        }
        let farthest = (1..=self.phases.len()).map(|count| self.strokes(support.get_ref(), count, Amplitude::farthest));
        let farthest =
            farthest.fold([0.0_f64; D], |most, strokes| std::array::from_fn(|a| most[a].max(strokes[a].abs())));
        for (axis, stroke) in farthest.into_iter().enumerate() {
            let most = 0.5 * self.grid.h;
            let ends = ends::<D>(within)[axis].iter().any(|end| end.is_finite());
            let (axis, periodic) = (["x", "y", "z"][axis], self.grid.axes[axis].is_periodic());
            if ends && stroke > most * (1.0 + ROUNDING) && (!moves || periodic) {
                let said = format!(
                    "nodes move {stroke} m along {axis} where their region stays: at most half a cell is allowed, {most} m, \
                     or ends -inf and inf along that axis, or moves = true unless it is periodic"
                );
                return Err(source.at(support, said));
            }
        }
        Ok(())
    }

    /// Strokes (m) of a support, along every axis, in the first phases of the scene, the last of which it leaves by `last`.
    fn strokes(&self, support: &SupportForm, count: usize, last: fn(&Amplitude, f64) -> f64) -> [f64; D] {
        let SupportForm::Nodes { velocity_m_s, rise_s, amplitude, phases, .. } = support else { return [0.0; D] };
        let amplitude = self.over_time(*rise_s, amplitude);
        let acting = self.phases.iter().take(count).filter(|phase| acts(phases, &phase.name));
        let durations: Vec<f64> = acting.map(Phase::duration).collect();
        let time = durations.split_last().map_or(0.0, |(end, before)| {
            let before: f64 = before.iter().map(|duration| amplitude.integral(*duration)).sum();
            before + last(&amplitude, *end)
        });
        speeds(velocity_m_s).map(|speed| speed.map_or(0.0, |speed| speed * time))
    }

    /// The factor over the time of a phase.
    pub(super) fn over_time(&self, rise: NotNegative, name: &Option<Name>) -> Amplitude {
        let table = name.as_ref().and_then(|name| self.amplitudes.get(&name.0));
        table.cloned().unwrap_or(Amplitude::Rise(rise.0))
    }

    /// Particles per cell.
    pub(super) fn per_cell(&self) -> u32 {
        per_direction(&self.form).pow(D as u32)
    }

    /// How B-splines meet walls.
    pub(super) fn walls(&self) -> WallTreatment {
        match self.form.solver.get_ref().walls {
            Some(WallsForm::WallLine) => WallTreatment::WallLine,
            _ => WallTreatment::OpenKnot,
        }
    }

    /// Supports, then contacts and bodies, in the scene's order: place in the file, name, phases.
    fn named(&self) -> [Vec<Named<'_>>; 3] {
        let supports = self.form.supports.iter().map(|s| match s.get_ref() {
            SupportForm::Wall { name, phases, .. } | SupportForm::Nodes { name, phases, .. } => {
                (s.span(), &*name.0, &phases[..])
            }
        });
        let contacts = self.form.contacts.iter();
        let contacts = contacts.map(|c| (c.span(), &*c.get_ref().name.0, &c.get_ref().phases[..]));
        let bodies = self.form.all_bodies().map(|body| (body.span(), body.get_ref().name(), &[][..]));
        [supports.collect(), contacts.collect(), bodies.collect()]
    }

    /// Names of supports, then of contacts and of bodies that touch others, of a phase, in the scene's order.
    pub(super) fn parts(&self, phase: &str) -> [Vec<&str>; 3] {
        let mut all = self.named();
        if !self.form.slides() {
            all[2].clear();
        }
        all.map(|all| all.iter().filter(|(.., phases)| acts(phases, phase)).map(|(_, name, _)| *name).collect())
    }

    /// The error of a phase that can't begin, with the place of a support that holds nothing.
    pub(super) fn fault(&self, source: &Source, phase: &Phase, error: &mpm_core::Error) -> Error {
        let acting = |(.., phases): &&Named<'_>| acts(phases, &phase.name);
        match *error {
            mpm_core::Error::Input { what: HOLDS_NOTHING, value, allowed } => {
                let [supports, ..] = self.named();
                let at = supports.iter().filter(acting).nth(value as usize).map_or(0..0, |(at, ..)| at.clone());
                source.fault(&at, format!("a support that holds no node of its own: {allowed}"))
            }
            _ => Error::file(&source.path, format!("phase {}: {error}", phase.name)),
        }
    }

    /// Keeps the simulation of the first phase, which a run begins with.
    pub(super) fn keep_first(&self, run: Box<dyn Simulation<D>>) {
        if let Ok(mut first) = self.first.lock() {
            first.get_or_insert(run);
        }
    }

    /// The simulation with which a run begins.
    pub(super) fn begin(&self) -> Result<Box<dyn Simulation<D>>, mpm_core::Error> {
        let first = self.first.lock().ok().and_then(|mut first| first.take());
        first.map_or_else(|| self.solve(&self.phases[0]), Ok)
    }

    /// The simulation of a phase at its start.
    pub(super) fn solve(&self, phase: &Phase) -> Result<Box<dyn Simulation<D>>, mpm_core::Error> {
        let scene = self.scene(phase)?;
        match self.scheme {
            Scheme::Explicit(_) => mpm_solvers::solver(self.scheme, scene, self.explicit(phase)?),
            Scheme::Implicit(_) => mpm_solvers::implicit(self.scheme, scene, self.implicit(phase)),
            Scheme::Poro(_) => {
                let water = self.water(&scene.bodies.particles)?;
                mpm_solvers::poro(self.scheme, scene, water, self.poro(phase))
            }
        }
    }

    /// The scene of a phase.
    fn scene(&self, phase: &Phase) -> Result<Scene<D>, mpm_core::Error> {
        let bodies = self.bodies(phase)?;
        Ok(Scene {
            grid: self.grid,
            loads: self.loads(phase, &bodies.particles)?,
            bodies,
            constraints: self.constraints(phase),
            contacts: self.contacts(&phase.name)?,
        })
    }

    fn constraints(&self, phase: &Phase) -> Vec<Box<dyn Constraint<D>>> {
        let mut all: Vec<Box<dyn Constraint<D>>> = Vec::new();
        for support in &self.form.supports {
            match support.get_ref() {
                SupportForm::Wall { axis, end, kind, friction, phases, .. } if acts(phases, &phase.name) => {
                    let kind = match kind {
                        WallForm::Fixed => WallKind::Fixed,
                        WallForm::Roller => WallKind::Roller,
                        WallForm::Separable => WallKind::Separable,
                    };
                    let friction = friction.map_or(0.0, |friction| friction.0);
                    all.push(Box::new(Wall { friction, ..Wall::new(*axis as usize, end_of(*end), kind) }));
                }
                SupportForm::Nodes { within, velocity_m_s, moves, rise_s, amplitude, phases, .. }
                    if acts(phases, &phase.name) =>
                {
                    let amplitude = self.over_time(*rise_s, amplitude);
                    let nodes = RigidNodes { extent: ends(within), velocity: speeds(velocity_m_s), amplitude };
                    let before = self.phases.iter().take_while(|other| other.name != phase.name).count();
                    let from = self.strokes(support.get_ref(), before, Amplitude::integral);
                    all.push(if *moves { Box::new(MovingNodes { nodes, from }) } else { Box::new(nodes) });
                }
                _ => {}
            }
        }
        all
    }

    fn contacts(&self, phase: &str) -> Result<Vec<RigidContact<D>>, mpm_core::Error> {
        let forms = self.form.contacts.iter().map(Line::get_ref).zip(&self.surfaces);
        let forms = forms.filter(|(form, _)| acts(&form.phases, phase));
        let made =
            forms.map(|(form, surface)| contact(form, surface.as_ref(), self.over_time(form.rise_s, &form.amplitude)));
        made.collect()
    }

    /// How an explicit run takes its steps.
    pub(super) fn explicit(&self, phase: &Phase) -> Result<explicit::Settings<D>, mpm_core::Error> {
        let form = self.form.solver.get_ref();
        let flip = match (form.flip, form.pic_rate_per_s) {
            (Some(share), _) => share.0,
            (None, rate) => (-value(rate) * phase.dt).exp(),
        };
        let mut settings = explicit::Settings::new(phase.dt).wall(self.walls()).remedy(self.scheme.remedy().build());
        if phase.damping > 0.0 {
            settings = settings.filter_forces(LocalDamping::new(phase.damping)?);
        }
        if form.kinetic_damping == Some(true) {
            settings = settings.filter_particles(KineticDamping::default());
        }
        Ok(settings.transfer(Flip::new(flip)?))
    }

    /// How an implicit run takes its steps.
    pub(super) fn implicit(&self, phase: &Phase) -> implicit::Settings {
        let form = self.form.solver.get_ref();
        let rule = match self.scheme.rule() {
            Some(RuleName::Midpoint) => TimeRule::Midpoint { lumped: value(form.lumped) },
            Some(RuleName::Newmark) => TimeRule::Newmark { alpha: 0.25, delta: 0.5 },
            Some(RuleName::QuasiStatic) | None => TimeRule::Static,
        };
        let settings = implicit::Settings::new(phase.dt).rule(rule);
        implicit::Settings {
            tolerance: value(form.tolerance),
            stabilisation: Stabilisation::ghost(value(form.ghost_penalty)),
            ..settings
        }
    }

    /// How a run with water takes its steps.
    pub(super) fn poro(&self, phase: &Phase) -> poro::Settings {
        let form = self.form.solver.get_ref();
        let mut settings = poro::Settings::new(phase.dt);
        if !phase.law.conservative() {
            settings = settings.tangent(poro::Tangent::Consistent);
        }
        poro::Settings {
            pressure_space: match self.scheme {
                Scheme::Poro(parts) if parts.space == SpaceName::TwoGrid => PressureSpace::TwoGrid,
                Scheme::Poro(parts) if parts.space == SpaceName::Ppp => {
                    PressureSpace::Projected { strength: value(form.projection_per_pa) }
                }
                _ => PressureSpace::Equal,
            },
            tolerance: value(form.tolerance),
            ghost_displacement: value(form.ghost_penalty),
            ghost_pressure: value(form.ghost_pressure),
            ..settings
        }
    }

    /// The water in a body of these particles.
    pub(super) fn water(&self, particles: &Particles<D>) -> Result<Water<D>, mpm_core::Error> {
        let form = self.form.water.as_ref().ok_or(mpm_core::Error::Input {
            what: "tables `water`",
            value: 0.0,
            allowed: "1 with a scheme of the kind poro",
        })?;
        let form = form.get_ref();
        let conductivity = |form: &ConductivityForm| match form {
            ConductivityForm::Constant { m2_pa_s } => Conductivity::Constant(m2_pa_s.0),
            ConductivityForm::KozenyCarman { m2_pa_s } => Conductivity::KozenyCarman(m2_pa_s.0),
        };
        let weight = self.heavy_water();
        let density = weight.map_or(0.0, |(density, ..)| density);
        let grains = |density_of: f64, n: f64| (density_of - n * density) / (1.0 - n);
        let mut water = Water::new(form.porosity.0, conductivity(&form.conductivity));
        for own in self.form.bodies.iter().map(Line::get_ref) {
            let porosity = own.porosity.unwrap_or(form.porosity).0;
            water = water.and(porosity, conductivity(own.conductivity.as_ref().unwrap_or(&form.conductivity)));
            water = water.grains(grains(own.density_kg_m3.0, porosity));
        }
        if let Some((density, acceleration, level)) = weight {
            let pressure = move |x: &[f64; D]| density * acceleration[D - 1] * (x[D - 1] - level);
            let grains = grains(self.form.body.get_ref().density_kg_m3.0, form.porosity.0);
            water = water.gravity(poro::Gravity { water: density, grains, acceleration }).start(pressure);
        }
        if let Some(region) = &form.drained {
            water = water.drained(holds(region));
        }
        let faces = form.faces.iter();
        Ok(faces.fold(water, |water, face| water.face(self.face(face.get_ref(), particles))))
    }

    fn face(&self, form: &FaceForm, particles: &Particles<D>) -> Face<D> {
        let (on, at) = (holds(&form.on), (form.axis as usize, end_of(form.end)));
        match (&form.traction_pa, form.drain_penalty_m_pa_s) {
            (Some(traction), _) => {
                let traction = components::<D>(traction);
                let amplitude = self.over_time(form.rise_s, &form.amplitude);
                Face::loaded(particles, on, at, move |time| traction.map(|t| t * amplitude.at(time)))
            }
            (None, penalty) => Face::drained(particles, on, at, value(penalty)),
        }
    }
}

/// The value of a key; the core refuses the one that stands for a key without a value.
fn value(key: Option<impl Into<f64>>) -> f64 {
    key.map_or(f64::NAN, Into::into)
}

/// Speeds (m/s) along the axes that are named.
pub(super) fn speeds<const D: usize>(named: &BTreeMap<AxisForm, Finite>) -> [Option<f64>; D] {
    let axes = [AxisForm::X, AxisForm::Y, AxisForm::Z];
    std::array::from_fn(|a| named.get(&axes[a]).map(|speed| speed.0))
}

/// Components of a vector whose length [`Setup::check`] has looked at.
pub(super) fn components<const D: usize>(given: &[Finite]) -> [f64; D] {
    std::array::from_fn(|a| given.get(a).map_or(0.0, |x| x.0))
}

/// Whether what acts in these phases, or in all if none is named, acts in one.
pub(super) fn acts(phases: &[String], phase: &str) -> bool {
    phases.is_empty() || phases.iter().any(|name| name == phase)
}

pub(super) fn end_of(form: EndForm) -> End {
    match form {
        EndForm::Lo => End::Lo,
        EndForm::Hi => End::Hi,
    }
}

/// Particles along a side of a cell.
fn per_direction(form: &Form) -> u32 {
    form.body.get_ref().particles_per_direction.map_or(1, |count| count.0)
}

pub(super) fn own_axis<const D: usize, T>(source: &Source, at: &Line<T>, axis: AxisForm) -> Result<(), Error> {
    let said = || format!("axis {axis:?} where the grid has {D}").to_lowercase();
    if (axis as usize) < D { Ok(()) } else { Err(source.at(at, said())) }
}

fn grid<const D: usize>(source: &Source, form: &Form) -> Result<Grid<D>, Error> {
    let given = form.grid.get_ref();
    let lower: [f64; D] = vector(source, &form.grid, "lower_m", &given.lower_m)?;
    if given.ends.len() != D {
        let said = format!("ends has {} entries where the grid has {D} axes", given.ends.len());
        return Err(source.at(&form.grid, said));
    }
    let all: f64 = given.cells.iter().map(|n| f64::from(n.0)).product();
    if all > MOST_CELLS {
        let said = format!("cells: {all} in all where {MOST_CELLS} are allowed");
        return Err(source.at(&form.grid, said));
    }
    let axis = |a: usize| {
        let cells = given.cells[a].0 as usize;
        let (wall, open) = (Side::Wall, Side::Open);
        match given.ends[a] {
            EndsForm::Walls => Axis::walls(lower[a], cells),
            EndsForm::Open => Axis::open(lower[a], cells),
            EndsForm::WallOpen => Axis::bounded(lower[a], cells, (wall, open)),
            EndsForm::OpenWall => Axis::bounded(lower[a], cells, (open, wall)),
            EndsForm::Periodic => Axis::periodic(lower[a], cells),
        }
    };
    Grid::new(given.cell_size_m.0, std::array::from_fn(axis)).map_err(|e| source.at(&form.grid, e))
}
