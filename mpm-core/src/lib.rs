//! Finite-strain material point method (MPM) with the F̄ family of locking remedies.
//!
//! The method is that of Zhao, Jiang & Choo, "Circumventing volumetric locking in explicit material point methods"
//! (2023); equation numbers in this crate are theirs. A [`Scene`] is a [`Grid`], [`Bodies`] and what acts on it; a
//! solver, behind [`Simulation`], moves it. There are three kinds: the [explicit](explicit::Solver) one, whose `step`
//! is the algorithm, the [implicit](implicit::Solver) one, and that of [solid and water](poro::Solver). Shared parts:
//!
//! * [`Grid`], [`Lattice`] and [`nodes`]: cells, axes, the nodes of a basis and what they hold in a step;
//! * [`basis`]: linear, uGIMP, quadratic and cubic B-splines, one-dimensional factors of a tensor product;
//! * [`material`]: constitutive laws, pure functions in three dimensions;
//! * [`bodies`]: each with a law, the states of its [`Particles`], and how it meets the others;
//! * [`stage`]: loads, force filters, constraints and particle filters;
//! * [`contact`]: barrier contact with rigid bodies, with friction;
//! * [`projection`]: the volume average Π;
//! * [`frame`]: a scene in another frame and other units;
//! * [`monitor`]: mass, momentum, the energy budget, J and ln(J/J̄), reactions;
//! * [`memory`]: checkpoint and bit-identical restart.
//!
//! The explicit solver has in [`explicit`] its [`Settings`](explicit::Settings), particle–grid transfers
//! ([`explicit::transfer`]: PIC/FLIP blend, APIC, XPIC, MUSL) and remedies ([`explicit::remedy`]: how the averaged
//! Jacobian J̄ is formed).
//!
//! The implicit solver has in [`implicit`] its functions, penalties and Newton's method; a body with water adds
//! [`poro`].
//!
//! A block of nearly incompressible rubber that begins to sag under its weight:
//!
//! ```
//! use mpm_core::basis::QuadraticBSpline;
//! use mpm_core::explicit::remedy::{Fbar, Form};
//! use mpm_core::explicit::{Settings, Solver, courant_time_step};
//! use mpm_core::material::{Law, NeoHookean};
//! use mpm_core::stage::{BodyForce, End, Wall, WallKind};
//! use mpm_core::{Axis, Bodies, Error, Grid, Particles, Scene, Simulation};
//!
//! fn main() -> Result<(), Error> {
//!     let (cell, spacing, density) = (0.25, 0.125, 1000.0);
//!     // A square metre: two particles per direction and cell, one metre from the walls at the sides.
//!     let place = |k: usize| (k as f64 + 0.5) * spacing;
//!     let places = (0..64).map(|k| [1.0 + place(k % 8), place(k / 8)]);
//!     let volume = spacing * spacing;
//!     let particles = Particles::new(places.collect(), volume, density, [0.5 * spacing; 2])?;
//!     let law = NeoHookean::new(1e5, 0.499)?;
//!     let dt = courant_time_step(0.3, cell, law.wave_speed(density));
//!     let grid = Grid::new(cell, [Axis::walls(0.0, 12), Axis::walls(0.0, 6)])?;
//!     let scene = Scene::new(grid, Bodies::new(law, particles)?)
//!         .load(BodyForce(Box::new(|_, _| [0.0, -9.81])))
//!         .constrain(Wall::new(1, End::Lo, WallKind::Fixed));
//!     let settings = Settings::new(dt).remedy(Box::new(Fbar::new(Form::Consistent)));
//!     // Three quadratic splines are non-zero at a point.
//!     let mut solver = Solver::<2, 3, QuadraticBSpline>::new(scene, settings)?;
//!     while solver.time() < 0.05 {
//!         solver.step()?;
//!     }
//!     let p = solver.particles();
//!     let sunk = (p.reference.iter().zip(&p.position)).map(|(from, to)| from[1] - to[1]);
//!     let most = sunk.fold(0.0, f64::max);
//!     // Less than in free fall, as the floor holds it.
//!     assert!(most > 1e-3 && most < 0.5 * 9.81 * 0.05 * 0.05);
//!     Ok(())
//! }
//! ```
//!
//! All quantities are in SI units. The dimension is a const generic: 1 (uniaxial strain),
//! 2 (plane strain) or 3.

pub mod basis;
pub mod bodies;
pub mod contact;
pub mod eights;
pub mod error;
pub mod explicit;
#[cfg(test)]
mod fixture;
pub mod frame;
pub mod grid;
pub mod implicit;
pub mod lattice;
pub mod ledger;
pub mod material;
pub mod memory;
pub mod monitor;
pub mod nodes;
pub mod number;
pub mod order;
pub mod parallel;
pub mod particles;
pub mod poro;
pub mod projection;
pub mod reach;
mod room;
pub mod scene;
pub mod simulation;
pub mod space;
pub mod stage;
pub mod tensor;
pub mod work;

pub use basis::Basis;
pub use bodies::{Bodies, Body};
pub use error::{Cause, Error, Fault};
pub use frame::Frame;
pub use grid::{Axis, Grid, Side};
pub use lattice::Lattice;
pub use ledger::Ledger;
pub use material::Law;
pub use memory::{Memory, MemoryError, Memoryless, Saved};
pub use monitor::{Reaction, Totals};
pub use particles::Particles;
pub use scene::Scene;
pub use simulation::{Field, Part, Simulation};
pub use tensor::SymmetricTensor;
pub use work::{Spent, Work};
