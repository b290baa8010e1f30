//! A solver before its first step.

use super::held;
use super::linear::Direct;
use super::response::variables;
use super::{Interpolation, Moduli, Remedy, Settings, Solver, Stabilisation, TimeRule, contact};
use crate::error::{Error, require, require_none};
use crate::ledger::Ledger;
use crate::material::AnyLaw;
use crate::monitor::Convergence;
use crate::projection::Onto;
use crate::room::Room;
use crate::scene::Scene;
use nalgebra::Matrix3;

impl<const D: usize> Solver<D> {
    /// A solver of `scene` with `settings` at time zero.
    ///
    /// # Errors
    /// A setting or particle that is not allowed; a stabilisation that the functions do not offer; F̄ with a law that is
    /// not conservative or friction that can slip; a contact across a periodic axis; a constraint on one side only
    /// or that holds no node of its own; a particle off the grid.
    pub fn new<I: Interpolation<D>>(scene: Scene<D>, settings: Settings) -> Result<Self, Error> {
        Self::on(Box::new(I::on(scene.grid)?), scene, settings)
    }

    fn on(functions: Box<dyn Interpolation<D>>, mut scene: Scene<D>, settings: Settings) -> Result<Self, Error> {
        settings.check()?;
        contact::check(&scene.contacts, &scene.grid, settings.remedy)?;
        held::check(&scene.constraints)?;
        let averages = settings.remedy != Remedy::None;
        let offered = !averages || matches!(settings.onto, Onto::Basis | Onto::Hats | Onto::Cells);
        require(offered, "averages of an implicit run onto blocks or patches", 1.0, "0: the basis, hats or cells")?;
        let laws = || scene.bodies.each.iter().map(|body| &body.law);
        let bodies = scene.bodies.each.len();
        let what = "bodies that a variational F-bar averages over";
        require(!averages || bodies == 1, what, bodies as f64, "1: others take remedy none")?;
        let slides = scene.bodies.each.iter().filter(|body| body.slides.is_some()).count();
        require_none(slides, "bodies that slide in an implicit run", "0: an explicit solver has contact")?;
        require(
            laws().all(|law| law.conservative()) || !averages,
            "variational F-bar with a law without a potential",
            1.0,
            "remedy none: the law has a rate of stress, a viscosity or friction",
        )?;
        functions.offers(settings.stabilisation)?;
        let moduli: Vec<Moduli> = laws().map(|law| moduli_of(law.as_ref(), settings.dt)).collect();
        let stiffness = |m: &Moduli| m.lambda + 2.0 * m.mu;
        let greatest = moduli.iter().max_by(|a, b| stiffness(a).total_cmp(&stiffness(b)));
        let least = moduli.iter().fold(f64::INFINITY, |least, m| least.min(m.mu));
        let moduli = greatest.copied().unwrap_or(Moduli { lambda: 0.0, mu: 0.0 });
        let inertia_alone = settings.rule != TimeRule::Static && settings.stabilisation == Stabilisation::None;
        require(
            least > 0.0 || inertia_alone,
            "shear modulus of a quasi-static or stabilised run",
            least,
            "positive (Pa): a fluid has no static equilibrium",
        )?;
        scene.check_half_size()?;
        let particles = &mut scene.bodies.particles;
        let mut ledger =
            Ledger::new([particles.len(), functions.len()], scene.constraints.len(), scene.bodies.each.len());
        ledger.convergence = Some(Convergence::default());
        let room = Room::new(&scene.grid, particles.half_size.map(|l| functions.beyond_wall(l)));
        for (k, x) in particles.position.iter_mut().enumerate() {
            let placed = room.place(x);
            placed.map_err(|fault| ledger.breakdown(&particles.id, k, fault))?;
        }
        // Columns that a step of this rule does not need.
        match settings.rule {
            TimeRule::Static => particles.velocity = Vec::new(),
            TimeRule::Midpoint { .. } => {}
            TimeRule::Newmark { .. } => {
                particles.acceleration = vec![[0.0; D]; particles.len()];
            }
        }
        particles.affine = Vec::new();
        particles.increment = Vec::new();
        if scene.loads.is_empty() {
            particles.external_force = Vec::new();
        }
        if averages {
            particles.j_bar = particles.jacobian.clone();
        }
        for contact in &mut scene.contacts {
            contact.attach(particles.len());
        }
        let mut solver = Self {
            originals: functions.originals(),
            held: held::components(functions.as_ref(), &scene, 0.0)?,
            moduli,
            direct: Direct::new(contact::is_symmetric(&scene)),
            advance: Vec::new(),
            ledger,
            functions,
            scene,
            settings,
        };
        let started = solver.start_accelerations();
        started.map_err(|failure| solver.error(failure))?;
        Ok(solver)
    }
}

/// Lamé's parameters of undeformed material, from the law's tangent.
pub(crate) fn moduli_of(law: &dyn AnyLaw, dt: f64) -> Moduli {
    let mut row = vec![0.0; law.numbers()];
    law.at_rest(&Matrix3::identity(), &mut row);
    let tangent = law.stress(&variables::<3, 10>(&Matrix3::identity()), dt, &row);
    Moduli { lambda: tangent.xx.slope[4], mu: tangent.xy.slope[1] }
}
