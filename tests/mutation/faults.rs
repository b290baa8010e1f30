//! The faults: what is broken, and the checks that must go red.

/// A fault: where, which expression becomes which, the runs that must notice, and the check that must
/// go red.
pub(crate) struct Fault {
    pub(crate) name: &'static str,
    pub(crate) file: &'static str,
    pub(crate) sound: &'static str,
    pub(crate) broken: &'static str,
    pub(crate) seen_by: &'static [(Runs, &'static str)],
}

/// Runs of one case, judged together: what follows `mpm-verify run`.
pub(crate) type Runs = &'static [&'static str];

const RATE: Runs = &["cook --basis bspline2 --remedy fbar-rate"];
const RECURSIVE: Runs = &["cook --remedy fbar-recursive"];
/// Large enough to tell where a body force is evaluated, too small for particles to cross cells.
const AXIS: Runs = &[
    "mms-axis --remedy none --set amplitude=0.005 --level n8",
    "mms-axis --remedy none --set amplitude=0.005 --level n16",
    "mms-axis --remedy none --set amplitude=0.005 --level n32",
];
const AXIS_SPLINES: Runs = &[
    "mms-axis --basis bspline2 --remedy none --level n8",
    "mms-axis --basis bspline2 --remedy none --level n16",
    "mms-axis --basis bspline2 --remedy none --level n32",
];
const WALL: Runs = &[
    "mms-wall-pressure --remedy none --level n8",
    "mms-wall-pressure --remedy none --level n16",
    "mms-wall-pressure --remedy none --level n32",
];
const WALL_SPLINES: Runs = &[
    "mms-wall-pressure --basis bspline2 --remedy none --level n8",
    "mms-wall-pressure --basis bspline2 --remedy none --level n16",
    "mms-wall-pressure --basis bspline2 --remedy none --level n32",
];
const VORTEX: Runs = &[
    "mms-vortex-box --remedy fbar-rate --level n8",
    "mms-vortex-box --remedy fbar-rate --level n8 --set poisson_ratio=0.3",
];
const BAR: Runs = &[
    "vibrating-bar --remedy none --level n8",
    "vibrating-bar --remedy fbar-rate --level n8",
];
const BAR_CONSISTENT: Runs = &[
    "vibrating-bar --remedy none --level n8",
    "vibrating-bar --remedy fbar-consistent --level n8",
];

const FOOTING: Runs = &[
    "footing --remedy fbar-rate --level b10 --set domain_width=3 --set domain_depth=3 --set penetration=0.0025",
];
const BARRIER: Runs = &[
    "footing --remedy fbar-rate --level b10 --set domain_width=3 --set domain_depth=3 --set penetration=0.0025 --set contact=barrier",
];

/// Until the front is at the wall.
const DAM: Runs =
    &["dam-break --remedy fbar-recursive --level h0.5 --set duration=0.45 --set cfl=0.3"];

/// Water behind the gate, and hardly longer.
const RESTING: Runs = &["dam-break --remedy none --level h0.5 --set duration=0.1 --set cfl=0.3"];

/// A slide far beyond its limit.
const SLIDE: Runs =
    &["landslide-2d --remedy fbar-consistent --level h0.4 --set reduction=2 --set duration=1.5"];

/// Discs that collide.
const DISCS: Runs = &["discs --scheme midpoint-gimp-none --set step_factor=100"];

/// The first step of a column of solid and water.
const COLUMN: Runs =
    &["terzaghi --scheme poro-linear-two-grid --level n20 --set first_step=0.05 --set steps=1"];

/// A slab of solid and water under a plate, and a column under a load and drained by faces.
const SLAB: Runs = &["mandel --scheme poro-linear-two-grid --level n8 --set steps=60"];
const FACE: Runs = &["consolidation --scheme poro-gimp-equal --level n8"];

/// A known motion of solid and water that crosses cells.
const SOAKED: Runs = &[
    "mms-poro --scheme poro-gimp-two-grid --set amplitude=0.04 --level n8",
    "mms-poro --scheme poro-gimp-two-grid --set amplitude=0.04 --level n16",
    "mms-poro --scheme poro-gimp-two-grid --set amplitude=0.04 --level n32",
];

/// A column that settles by a fifth of its height.
const SETTLING: Runs = &[
    "consolidation --scheme poro-gimp-equal --level n8",
    "consolidation --scheme poro-gimp-equal --level n16",
    "consolidation --scheme poro-gimp-equal --level n32",
];

/// A beam in equilibrium, and one whose stress turns.
const BEAM: Runs = &["cantilever --level h0.1"];
const TURNED_BEAM: Runs = &["cantilever --level h0.1 --set law=jaumann"];

/// A membrane in equilibrium, in one step on the lattice; and one far bent.
const MEMBRANE: Runs =
    &["cook --solver quasi-static --remedy fbar-consistent --level h1 --set load_steps=1"];
const BENT_MEMBRANE: Runs = &[
    "cook --solver quasi-static --basis bspline2 --remedy none --level h1 --set load=10 --set load_steps=5 --set ghost=0.001",
];
/// A slow vortex over the cells, and over Poisson's ratios.
const SLOW: Runs = &[
    "mms-static --level n8",
    "mms-static --level n16",
    "mms-static --level n32",
];
const SLOW_RATIOS: Runs = &[
    "mms-static --level n8",
    "mms-static --level n8 --set poisson_ratio=0.3",
];

pub(crate) const FAULTS: [Fault; 51] = [
    Fault {
        name: "a particle in equilibrium has a fiftieth more volume",
        file: "implicit/equilibrium.rs",
        sound: "particles.reference_volume[p] * j",
        broken: "1.02 * particles.reference_volume[p] * j",
        seen_by: &[
            (MEMBRANE, "load-at-its-place"),
            (BENT_MEMBRANE, "large-loads"),
            (SLOW, "order-displacement"),
        ],
    },
    Fault {
        name: "a load step ends before its load",
        file: "implicit/mod.rs",
        sound: "self.external(self.time + place * dt, &setting.elements)",
        broken: "self.external(self.time + 0.9 * place * dt, &setting.elements)",
        seen_by: &[(MEMBRANE, "static-reaction")],
    },
    Fault {
        name: "F-bar in variational form averages nothing",
        file: "implicit/average.rs",
        sound: "smooth[p] + UNSEEN * rough[p] + (1.0 - UNSEEN) * seen[p]",
        broken: "smooth[p] + rough[p] + 0.0 * seen[p]",
        seen_by: &[(SLOW_RATIOS, "no-locking")],
    },
    Fault {
        name: "the tangent is a tenth too soft",
        file: "implicit/response.rs",
        sound: "whole.slope[D * k + l]",
        broken: "0.9 * whole.slope[D * k + l]",
        seen_by: &[(BEAM, "newton")],
    },
    Fault {
        name: "the ghost penalty vanishes",
        file: "implicit/interpolation.rs",
        sound: "factor * moduli.young()",
        broken: "0.0 * moduli.young()",
        seen_by: &[(BEAM, "completes")],
    },
    Fault {
        name: "Jaumann's stress turns by half of the rotation",
        file: "material/hypoelastic.rs",
        sound: "stress.push_forward(&cayley(0.5))",
        broken: "stress.push_forward(&cayley(0.25))",
        seen_by: &[(TURNED_BEAM, "corner")],
    },
    Fault {
        name: "P2G drops the stress along the last axis",
        file: "explicit/transfer/kernel.rs",
        sound: "along.mul_add(slope[k], nodes[k].change)",
        broken: "(along * 0.0).mul_add(slope[k], nodes[k].change)",
        seen_by: &[(RATE, "completes")],
    },
    Fault {
        name: "P2G halves the mass",
        file: "explicit/transfer/kernel.rs",
        sound: "momentum.as_mut_array()[3] = self.mass[l]",
        broken: "momentum.as_mut_array()[3] = 0.5 * self.mass[l]",
        seen_by: &[(RATE, "mid-edge")],
    },
    Fault {
        name: "F-bar takes the cubic root in plane strain",
        file: "space.rs",
        sound: "x.sqrt()",
        broken: "cube_root(x)",
        seen_by: &[(RATE, "mean-stress-rms")],
    },
    Fault {
        name: "F-bar is skipped",
        file: "explicit/remedy/mod.rs",
        sound: "entry * stretch",
        broken: "entry + stretch * Eight::ZERO",
        seen_by: &[(RATE, "mean-stress-rms"), (VORTEX, "no-locking")],
    },
    Fault {
        name: "the gradient has the wrong sign",
        file: "basis/bspline.rs",
        sound: "*d *= T::splat(self.inverse_h)",
        broken: "*d *= T::splat(-self.inverse_h)",
        // In force and strain the two signs cancel: displacements stay right, stresses turn over.
        seen_by: &[(RATE, "mean-stress-probe")],
    },
    Fault {
        name: "the wall does not hold",
        file: "stage/wall.rs",
        sound: "(behind && held)",
        broken: "(behind && held && grid.h < 0.0)",
        seen_by: &[(RATE, "completes")],
    },
    Fault {
        name: "the printed algorithm no longer creeps",
        file: "explicit/remedy/fbar_recursive.rs",
        sound: "fill_with_products(&mut self.next, &particles.j_bar, change)",
        broken: "self.next.clone_from(if change.is_empty() { change } else { &particles.jacobian })",
        seen_by: &[(RECURSIVE, "never-at-rest")],
    },
    Fault {
        name: "the body force is that of the current position",
        file: "stage/load.rs",
        sound: "&p.reference[..]",
        broken: "&p.position[..]",
        seen_by: &[(AXIS, "order-displacement")],
    },
    Fault {
        name: "the gradient is a hundredth too large",
        file: "basis/bspline.rs",
        sound: "*d *= T::splat(self.inverse_h)",
        broken: "*d *= T::splat(1.01 * self.inverse_h)",
        seen_by: &[(AXIS_SPLINES, "order-displacement")],
    },
    Fault {
        name: "the increment of the volume is averaged twice",
        file: "explicit/remedy/fbar_rate.rs",
        sound: "average.average(particles, &mut self.averaged)",
        broken: "for _ in 0..2 { average.average(particles, &mut self.averaged) }",
        seen_by: &[(BAR, "averaging-softens")],
    },
    Fault {
        name: "the consistent average lacks its second term",
        file: "explicit/remedy/fbar_consistent.rs",
        sound: "*field += (1.0 - UNSEEN) * *seen",
        broken: "*field += 0.0 * *seen",
        seen_by: &[(BAR_CONSISTENT, "averaging-softens")],
    },
    Fault {
        name: "splines are not interpolatory at walls",
        file: "explicit/start.rs",
        sound: "Lattice::new(scene.grid, settings.wall)",
        broken: "Lattice::new(scene.grid, crate::basis::WallTreatment::WallLine)",
        seen_by: &[(WALL_SPLINES, "order-displacement")],
    },
    Fault {
        name: "a wall holds the node before it too",
        file: "stage/wall.rs",
        sound: "x <= ends.lo + ON_WALL * grid.h",
        broken: "x <= ends.lo + grid.h",
        seen_by: &[(WALL, "order-displacement")],
    },
    Fault {
        name: "the strength is taken for that of the norm √(3/2)‖s‖",
        file: "material/strength.rs",
        sound: "std::f64::consts::SQRT_2 * shear_strength",
        broken: "3.0_f64.sqrt() * shear_strength",
        seen_by: &[(FOOTING, "prandtl")],
    },
    Fault {
        name: "the strength in tension is taken for Tresca's",
        file: "material/strength.rs",
        sound: "std::f64::consts::SQRT_2 * shear_strength",
        broken: "(8.0_f64 / 3.0).sqrt() * shear_strength",
        seen_by: &[(FOOTING, "prandtl")],
    },
    Fault {
        name: "the flow doesn't keep the volume",
        file: "material/hencky_j2.rs",
        sound: "direction.scale_add_identity(-share, T::default())",
        broken: "direction.scale_add_identity(-share, T::splat(-0.1) * flow)",
        seen_by: &[(FOOTING, "completes")],
    },
    Fault {
        name: "the law holds √(3/2) ‖s‖ against the strength of ‖s‖",
        file: "material/hencky_j2.rs",
        sound: "shear * norm",
        broken: "shear * norm * T::splat(1.5_f64.sqrt())",
        seen_by: &[(FOOTING, "prandtl")],
    },
    Fault {
        name: "softening is forgotten",
        file: "material/strength.rs",
        sound: "(T::splat(-eta) * plastic_strain).exp()",
        broken: "(T::splat(0.0 * eta) * plastic_strain).exp()",
        seen_by: &[(SLIDE, "energy-closure")],
    },
    Fault {
        name: "the barrier presses back with half the force",
        file: "contact/mod.rs",
        sound: "self.reaction.force[a] -= force[a]",
        broken: "self.reaction.force[a] -= 0.5 * force[a]",
        seen_by: &[(BARRIER, "quasi-static")],
    },
    Fault {
        name: "a separable wall lets through and does not let go",
        file: "stage/wall.rs",
        sound: "Bound::AtLeast",
        broken: "Bound::AtMost",
        seen_by: &[(DAM, "completes")],
    },
    Fault {
        name: "a wall throws back twice what it stops",
        file: "explicit/stages.rs",
        sound: "*change += held - free",
        broken: "*change += 3.0 * (held - free)",
        seen_by: &[(DAM, "energy-not-gained")],
    },
    Fault {
        name: "the water's pressure is a tenth too low",
        file: "material/newtonian_fluid.rs",
        sound: "T::splat(self.bulk_modulus) * (j - T::splat(1.0))",
        broken: "T::splat(0.9 * self.bulk_modulus) * (j - T::splat(1.0))",
        seen_by: &[(RESTING, "pressure-profile")],
    },
    Fault {
        name: "one of eight stencils is its neighbour's",
        file: "lattice/stencils.rs",
        sound: "self.of.rows[slow][fast][a][self.l]",
        broken: "self.of.rows[slow][fast][a][self.l.max(1)]",
        seen_by: &[(RATE, "no-energy-gain")],
    },
    Fault {
        name: "the last of eight particles receives what that of the eight before did",
        file: "explicit/stages.rs",
        sound: "0..EIGHT",
        broken: "0..EIGHT - 1",
        seen_by: &[(AXIS, "order-displacement")],
    },
    Fault {
        name: "the place of a particle is that before the step",
        file: "explicit/rest.rs",
        sound: "x[a] += increment[a]",
        broken: "x[a] += Eight::ZERO * increment[a]",
        seen_by: &[(AXIS, "order-displacement")],
    },
    Fault {
        name: "the water is as viscous as tar",
        file: "material/newtonian_fluid.rs",
        sound: "2.0 * self.viscosity",
        broken: "2e7 * self.viscosity",
        seen_by: &[(DAM, "front")],
    },
    Fault {
        name: "gravity on the nodes pulls a tenth too little",
        file: "explicit/stages.rs",
        sound: "node.change += gravity * mass",
        broken: "node.change += gravity * (0.9 * mass)",
        seen_by: &[(RESTING, "base-reaction")],
    },
    Fault {
        name: "the wave of a deformed state is ten times as fast",
        file: "explicit/rest.rs",
        sound: "p.law.wave_modulus(j, &stress, &after)",
        broken: "Eight::splat(100.0) * p.law.wave_modulus(j, &stress, &after)",
        seen_by: &[(RATE, "completes")],
    },
    Fault {
        name: "contact looks at one particle alone",
        file: "contact/mod.rs",
        sound: "self.near.push(k as u32)",
        broken: "if k == 0 { self.near.push(k as u32) }",
        seen_by: &[(BARRIER, "quasi-static")],
    },
    Fault {
        name: "half of the lumped mass is lost",
        file: "implicit/inertia.rs",
        sound: "x * (self.lumped * m)",
        broken: "x * (0.5 * self.lumped * m)",
        seen_by: &[(DISCS, "no-energy-gain")],
    },
    Fault {
        name: "particles take a tenth too much of their nodes' change",
        file: "implicit/dynamics.rs",
        sound: "SVector::from(*velocity) + elements.value(p, &change)",
        broken: "SVector::from(*velocity) + elements.value(p, &change) * 1.1",
        seen_by: &[(DISCS, "no-energy-gain")],
    },
    Fault {
        name: "the midpoint rule moves farther than its velocity",
        file: "implicit/inertia.rs",
        sound: "4.0 / (dt * dt)",
        broken: "3.9 / (dt * dt)",
        seen_by: &[(DISCS, "no-energy-gain")],
    },
    Fault {
        name: "water pulls the solid together",
        file: "poro/response.rs",
        sound: "-p * cofactor[i][j]",
        broken: "p * cofactor[i][j]",
        seen_by: &[(COLUMN, "completes")],
    },
    Fault {
        name: "water presses on areas of the step's start",
        file: "poro/response.rs",
        sound: "-p * cofactor[i][j]",
        broken: "-p * T::splat(f64::from(u8::from(i == j)))",
        seen_by: &[(SOAKED, "order-space")],
    },
    Fault {
        name: "water flows through volumes of the step's start",
        file: "poro/response.rs",
        sound: "conductivity * square / change",
        broken: "conductivity * square",
        seen_by: &[(SOAKED, "order-space")],
    },
    Fault {
        name: "pores don't change the conductivity",
        file: "poro/response.rs",
        sound: "self.water.conductivity.at(number(1.0) - solid)",
        broken: "self.water.conductivity.at(number(self.water.porosity))",
        seen_by: &[(SETTLING, "order-space"), (SOAKED, "order-space")],
    },
    Fault {
        name: "domains reach past walls",
        file: "poro/pores.rs",
        sound: "l.min(KEPT * distance)",
        broken: "*l",
        seen_by: &[(SOAKED, "completes")],
    },
    Fault {
        name: "the top of the column lets no water out",
        file: "poro/mod.rs",
        sound: "self.drained[node].then_some(0.0)",
        broken: "None",
        seen_by: &[(COLUMN, "overshoot")],
    },
    Fault {
        name: "the water's pressure is one of the undeformed configuration",
        file: "poro/step.rs",
        sound: "self.particle(k).respond(&embed(f), *pressure, slope)",
        broken: "self.particle(k).respond(&embed(f), *pressure / self.body.particles.jacobian[k], slope)",
        seen_by: &[(SETTLING, "order-space")],
    },
    Fault {
        name: "domains keep the size that they began with",
        file: "poro/commit.rs",
        sound: "grown(&before, half_size, determinant(f))",
        broken: "before",
        seen_by: &[(SETTLING, "order-space")],
    },
    Fault {
        name: "the exact change of volume is another one",
        file: "poro/response.rs",
        sound: "change - number(1.0)",
        broken: "change * change.ln()",
        seen_by: &[(SETTLING, "water")],
    },
    Fault {
        name: "a tenth of a plate's force is lost",
        file: "poro/outside.rs",
        sound: "force / nodes.len() as f64",
        broken: "0.9 * force / nodes.len() as f64",
        seen_by: &[(SLAB, "support"), (SLAB, "difference-equations")],
    },
    Fault {
        name: "the nodes of a plate move each for itself",
        file: "poro/mod.rs",
        sound: "self.tied[node][axis]",
        broken: "self.tied[node][axis].filter(|_| false)",
        seen_by: &[(SLAB, "difference-equations")],
    },
    Fault {
        name: "half of the drained area is lost after the first step",
        file: "poro/outside.rs",
        sound: "penalty * area",
        broken: "if self.time > 0.0 { 0.5 * penalty * area } else { penalty * area }",
        seen_by: &[(FACE, "completes")],
    },
    Fault {
        name: "a tenth of a face's load is lost after the first step",
        file: "poro/outside.rs",
        sound: "of_corner * *w",
        broken: "of_corner * (if self.time > 0.0 { 0.9 * *w } else { *w })",
        seen_by: &[(FACE, "completes")],
    },
];

/// A constant that is off by a millionth: no check against the truth can see it, the goldens do.
pub(crate) const DRIFT: Fault = Fault {
    name: "the neo-Hookean pressure is a millionth too large",
    file: "material/neo_hookean.rs",
    sound: "T::splat(0.5 * self.lambda) * squared_jacobian.ln()",
    broken: "T::splat(0.500_000_5 * self.lambda) * squared_jacobian.ln()",
    seen_by: &[],
};
