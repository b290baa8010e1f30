//! The runs that must notice a fault.

/// Runs of one case, judged together: what follows `mpm-verify run`.
pub(crate) type Runs = &'static [&'static str];

/// Runs of seconds, which are asked about the faults alone that are to be seen by them.
pub(crate) const DEAR: [Runs; 3] = [SLIDE, CUT, CUT_TWICE];

pub(crate) const RATE: Runs = &["cook --basis bspline2 --remedy fbar-rate"];
pub(crate) const RECURSIVE: Runs = &["cook --remedy fbar-recursive"];
/// Large enough to tell where a body force is evaluated, too small for particles to cross cells.
pub(crate) const AXIS: Runs = &[
    "mms-axis --remedy none --set amplitude=0.005 --level n8",
    "mms-axis --remedy none --set amplitude=0.005 --level n16",
    "mms-axis --remedy none --set amplitude=0.005 --level n32",
];
pub(crate) const AXIS_SPLINES: Runs = &[
    "mms-axis --basis bspline2 --remedy none --level n8",
    "mms-axis --basis bspline2 --remedy none --level n16",
    "mms-axis --basis bspline2 --remedy none --level n32",
];
pub(crate) const WALL: Runs = &[
    "mms-wall-pressure --remedy none --level n8",
    "mms-wall-pressure --remedy none --level n16",
    "mms-wall-pressure --remedy none --level n32",
];
pub(crate) const WALL_SPLINES: Runs = &[
    "mms-wall-pressure --basis bspline2 --remedy none --level n8",
    "mms-wall-pressure --basis bspline2 --remedy none --level n16",
    "mms-wall-pressure --basis bspline2 --remedy none --level n32",
];
pub(crate) const VORTEX: Runs = &[
    "mms-vortex-box --remedy fbar-rate --level n8",
    "mms-vortex-box --remedy fbar-rate --level n8 --set poisson_ratio=0.3",
];
pub(crate) const BAR: Runs = &["vibrating-bar --remedy none --level n8", "vibrating-bar --remedy fbar-rate --level n8"];
pub(crate) const BAR_CONSISTENT: Runs =
    &["vibrating-bar --remedy none --level n8", "vibrating-bar --remedy fbar-consistent --level n8"];

pub(crate) const FOOTING: Runs =
    &["footing --remedy fbar-rate --level b10 --set domain_width=3 --set domain_depth=3 --set penetration=0.0025"];
/// Elastic, in equilibrium: what a held node's increment is shows in the slope.
pub(crate) const PRESSED: Runs =
    &["footing --solver quasi-static --level b10 --set undrained_strength=1e6 --set load_steps=4"];
pub(crate) const BARRIER: Runs = &[
    "footing --remedy fbar-rate --level b10 --set domain_width=3 --set domain_depth=3 --set penetration=0.0025 --set contact=barrier",
];

/// Until the front is at the wall.
pub(crate) const DAM: Runs = &["dam-break --remedy fbar-recursive --level h0.5 --set duration=0.45 --set cfl=0.3"];

/// Water behind the gate, and hardly longer.
pub(crate) const RESTING: Runs = &["dam-break --remedy none --level h0.5 --set duration=0.1 --set cfl=0.3"];

/// A slide far beyond its limit.
pub(crate) const SLIDE: Runs =
    &["landslide-2d --remedy fbar-consistent --level h0.4 --set reduction=2 --set duration=1.5"];

/// Discs that collide.
pub(crate) const DISCS: Runs = &["discs --scheme midpoint-gimp-none --set step_factor=100"];
/// Discs with velocities of their own, that collide and that pass.
pub(crate) const TOUCHING: Runs = &["discs --scheme gimp-none-flip --set contact=bodies --set speed=0.1"];
pub(crate) const PASSING: Runs =
    &["discs --scheme bspline2-none-flip --set contact=bodies --set offset=0.5 --set speed=0.1"];

/// The first step of a column of solid and water.
pub(crate) const COLUMN: Runs =
    &["terzaghi --scheme poro-linear-two-grid --level n20 --set first_step=0.05 --set steps=1"];

/// A slab of solid and water under a plate, and a column under a load and drained by faces.
pub(crate) const SLAB: Runs = &["mandel --scheme poro-linear-two-grid --level n8 --set steps=60"];
pub(crate) const FACE: Runs = &["consolidation --scheme poro-gimp-equal --level n8"];

/// Soil that sinks out of its cells, and clay in uniaxial strain.
pub(crate) const STRIP: Runs = &["strip --level b4"];
pub(crate) const STRIP_WITHOUT_FLOW: Runs = &[
    "strip --set conductivity=1e-16 --set load=40 --set steps=1 --level b2",
    "strip --set conductivity=1e-16 --set load=40 --set steps=1 --level b4",
    "strip --set conductivity=1e-16 --set load=40 --set steps=1 --level b8",
];
pub(crate) const UNIFORM_CLAY: Runs = &[
    "strip --set duration=1e10 --set half_width=5 --set law=cam-clay --set load=1e5 --set steps=10 --level b2",
    "strip --set duration=1e10 --set half_width=5 --set law=cam-clay --set load=1e5 --set steps=20 --level b2",
    "strip --set duration=1e10 --set half_width=5 --set law=cam-clay --set load=1e5 --set steps=40 --level b2",
];

/// A slope whose toe is cut away: with softening and without, and on a base as slippery as ice.
pub(crate) const CUT: Runs = &["excavation --scheme midpoint-gimp-none --level h0.1"];
pub(crate) const CUT_TWICE: Runs = &[
    "excavation --scheme midpoint-gimp-none --level h0.1",
    "excavation --scheme midpoint-gimp-none --level h0.1 --set residual=5e3",
];
pub(crate) const SLIPPERY: Runs = &[
    "excavation --scheme quasi-static-gimp-none --level h0.1 --set base=friction --set friction=0.05 --set residual=5e3",
];

/// A known motion of solid and water that crosses cells.
pub(crate) const SOAKED: Runs = &[
    "mms-poro --scheme poro-gimp-two-grid --set amplitude=0.04 --level n8",
    "mms-poro --scheme poro-gimp-two-grid --set amplitude=0.04 --level n16",
    "mms-poro --scheme poro-gimp-two-grid --set amplitude=0.04 --level n32",
];

/// A column that settles by a fifth of its height.
pub(crate) const SETTLING: Runs = &[
    "consolidation --scheme poro-gimp-equal --level n8",
    "consolidation --scheme poro-gimp-equal --level n16",
    "consolidation --scheme poro-gimp-equal --level n32",
];

/// A beam in equilibrium, and one whose stress turns.
pub(crate) const BEAM: Runs = &["cantilever --level h0.1"];
pub(crate) const TURNED_BEAM: Runs = &["cantilever --level h0.1 --set law=jaumann"];

/// A membrane in equilibrium, in one step on the lattice; and one far bent.
pub(crate) const MEMBRANE: Runs =
    &["cook --solver quasi-static --remedy fbar-consistent --level h1 --set load_steps=1"];
pub(crate) const BENT_MEMBRANE: Runs =
    &["cook --solver quasi-static --basis bspline2 --remedy none --level h1 --set load=10 --set load_steps=5"];
/// A slow vortex over the cells, and over Poisson's ratios.
pub(crate) const SLOW: Runs = &["mms-static --level n8", "mms-static --level n16", "mms-static --level n32"];
pub(crate) const SLOW_RATIOS: Runs = &["mms-static --level n8", "mms-static --level n8 --set poisson_ratio=0.3"];

/// A soft body whose velocity has a constant gradient, beside walls and in three dimensions, and free fall.
pub(crate) const AFFINE: Runs = &["patch --scheme bspline2-none-apic"];
pub(crate) const FILTERED: Runs = &["patch --scheme bspline2-none-xpic2"];
pub(crate) const NINE_ENTRIES: Runs = &["patch --scheme gimp-none-flip --set dimension=3"];
pub(crate) const DAMPED: Runs = &["patch --scheme gimp-none-flip --set strain=0 --set fall=0.2 --set damping=0.5"];
pub(crate) const FALLING: Runs = &["patch --scheme newmark-gimp-none --set strain=0 --set fall=0.2"];

/// A bar whose energy Newmark's rule is known to take.
pub(crate) const NEWMARK: Runs = &["vibrating-bar --scheme newmark-linear-none --level n16 --set cfl=4"];

/// A column that stands, and yields where it is pressed most.
pub(crate) const YIELDING: Runs =
    &["newton --scheme quasi-static-gimp-none --level n8 --set support=stands --set yield_strain=0.05"];
