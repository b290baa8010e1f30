//! Finite-strain material point method (MPM) with the F̄ family of locking remedies.
//!
//! The method is that of Zhao, Jiang & Choo, "Circumventing volumetric locking in explicit
//! material point methods" (2023); equation numbers in this crate are theirs. A [`Scene`] is a [`Grid`], a [`Body`] and
//! what acts on it; a solver, behind [`Simulation`], moves it. There are three kinds: the
//! [explicit](explicit::Solver) one, whose `step` is the algorithm, the [implicit](implicit::Solver) one, and that of
//! [solid and water](poro::Solver). What is
//! shared:
//!
//! * [`Grid`], [`Lattice`] and [`nodes`]: cells, axes, the nodes of a basis and what they hold in a step;
//! * [`basis`]: linear, uGIMP, quadratic and cubic B-splines, one-dimensional factors of a tensor product;
//! * [`material`]: constitutive laws, pure functions in three dimensions;
//! * [`body`]: one law, its [`Particles`] and their states;
//! * [`stage`]: loads, force filters, constraints and particle filters;
//! * [`contact`]: barrier contact with rigid bodies, with friction;
//! * [`projection`]: the volume average Π;
//! * [`monitor`]: mass, momentum, the energy budget, J and ln(J/J̄), reactions;
//! * [`memory`]: how a run is stopped and goes on as if it had not been.
//!
//! What only the explicit step needs, in [`explicit`]: its [`Settings`](explicit::Settings), particle–grid transfers
//! ([`explicit::transfer`]: PIC/FLIP blend, APIC, XPIC, MUSL) and remedies ([`explicit::remedy`]: how the averaged
//! Jacobian J̄ is formed).
//!
//! What only the implicit one needs, in [`implicit`]: functions as it asks for them, penalties, Newton's method. What a
//! body with water has beside them, in [`poro`].
//!
//! All quantities are in SI units. The dimension is a const generic: 1 (uniaxial strain),
//! 2 (plane strain) or 3.

pub mod basis;
pub mod body;
pub mod contact;
pub mod eights;
pub mod error;
pub mod explicit;
pub mod grid;
pub mod implicit;
pub mod lattice;
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
pub use body::Body;
pub use error::{Error, Fault};
pub use grid::{Axis, Grid, Side};
pub use lattice::Lattice;
pub use material::Law;
pub use memory::{Memory, MemoryError, Memoryless, Saved};
pub use monitor::{Reaction, Totals};
pub use particles::Particles;
pub use scene::Scene;
pub use simulation::{Field, Part, Simulation};
pub use tensor::SymmetricTensor;
pub use work::{Spent, Work};
