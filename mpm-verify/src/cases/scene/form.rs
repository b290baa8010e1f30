//! Form of a scene file: its keys, their units in their names, and the ranges of their values.

use super::fault::Line;
use crate::cases::prelude::*;

/// The version of the format that this program reads.
pub(super) const FORMAT: u32 = 1;
/// Most particles per cell and direction, and most cells along an axis.
const MOST_PER_DIRECTION: u32 = 8;
const MOST_CELLS: u32 = 100_000;

/// Numbers that are read within a range.
macro_rules! numbers {
    ($($(#[$doc:meta])* $name:ident($of:ty): $fits:expr, $allowed:expr;)*) => {
        $($(#[$doc])*
        #[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
        #[serde(try_from = "f64")]
        pub(super) struct $name(pub(super) $of);

        impl TryFrom<f64> for $name {
            type Error = String;

            fn try_from(value: f64) -> Result<Self, String> {
                let fits: fn(f64) -> bool = $fits;
                if fits(value) { Ok(Self(value as $of)) } else { Err(format!("{value} where {} is allowed", $allowed)) }
            }
        }

        impl From<$name> for f64 {
            fn from(number: $name) -> Self {
                number.0.into()
            }
        })*
    };
}

numbers! {
    /// A number.
    Finite(f64): |x| x.is_finite(), "a finite number";
    /// A length, density, stiffness.
    Positive(f64): |x| x.is_finite() && x > 0.0, "a positive, finite number";
    /// A duration, a factor.
    NotNegative(f64): |x| x.is_finite() && x >= 0.0, "zero or a positive, finite number";
    /// A share.
    Share(f64): |x| (0.0..=1.0).contains(&x), "0 to 1";
    /// A CFL number.
    Courant(f64): |x| x > 0.0 && x <= 1.0, "a positive number of at most 1";
    /// Particles along a side of a cell.
    PerDirection(u32): |x| x.fract() == 0.0 && (1.0..=f64::from(MOST_PER_DIRECTION)).contains(&x),
        format!("a whole number from 1 to {MOST_PER_DIRECTION}");
    /// Cells along an axis.
    Cells(u32): |x| x.fract() == 0.0 && (4.0..=f64::from(MOST_CELLS)).contains(&x),
        format!("a whole number from 4 to {MOST_CELLS}");
    /// Rows of a series.
    Rows(u32): |x| x.fract() == 0.0 && (1.0..=f64::from(MOST_CELLS)).contains(&x),
        format!("a whole number from 1 to {MOST_CELLS}");
}

/// Two ends along an axis, the lower one first; `-inf` and `inf` are allowed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<f64>")]
pub(super) struct Ends(pub(super) [f64; 2]);

impl TryFrom<Vec<f64>> for Ends {
    type Error = String;

    fn try_from(given: Vec<f64>) -> Result<Self, String> {
        match given[..] {
            [lo, hi] if lo <= hi => Ok(Self([lo, hi])),
            _ => Err(format!("{given:?} where a lower and an upper end are allowed, in this order")),
        }
    }
}

/// A name chosen by the user; it heads columns and appears in messages.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String")]
pub(super) struct Name(pub(super) String);

impl TryFrom<String> for Name {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        let fits = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        match (1..=24).contains(&name.len()) && name.chars().all(fits) {
            true => Ok(Self(name)),
            false => Err(format!("name {name:?} where 1 to 24 lower-case letters, digits and hyphens are allowed")),
        }
    }
}

/// One, the default of a factor.
fn one() -> Finite {
    Finite(1.0)
}

/// Names of phases.
fn named<'a, D: serde::Deserializer<'a>>(given: D) -> Result<Vec<String>, D::Error> {
    match Vec::deserialize(given)? {
        none if none.is_empty() => Err(serde::de::Error::custom("no phase where one or more are allowed")),
        names => Ok(names),
    }
}

/// Tables of keys, none of which may be unknown.
macro_rules! tables {
    ($($(#[$of:meta])* $name:ident { $($(#[$key:meta])* $field:ident: $value:ty,)* })*) => {
        $($(#[$of])*
        #[derive(Debug, Serialize, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(super) struct $name {
            $($(#[$key])* pub(super) $field: $value,)*
        })*
    };
}

/// Kinds, by their names, each with its keys.
macro_rules! kinds {
    ($($(#[$of:meta])* $name:ident { $($kinds:tt)* })*) => {
        $($(#[$of])*
        #[derive(Debug, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case", deny_unknown_fields)]
        pub(super) enum $name {
            $($kinds)*
        })*
    };
}

tables! {
    /// A scene file, of the format [`FORMAT`].
    Form {
        format: Line<u32>, title: String,
        grid: Line<GridForm>, body: Line<BodyForm>, law: Line<LawForm>,
        #[serde(default)] bodies: Vec<Line<BodyForm>>,
        #[serde(default)] amplitudes: Vec<Line<AmplitudeForm>>,
        water: Option<Line<WaterForm>>,
        #[serde(default)] loads: Vec<Line<LoadForm>>,
        #[serde(default)] supports: Vec<Line<SupportForm>>,
        #[serde(default)] contacts: Vec<Line<ContactForm>>,
        solver: Line<SolverForm>, phases: Vec<Line<PhaseForm>>, output: Line<OutputForm>,
    }

    /// The grid. It has as many axes as `cells` has numbers.
    GridForm {
        cell_size_m: Positive, lower_m: Vec<Finite>, cells: Vec<Cells>, ends: Vec<EndsForm>,
    }

    /// A box whose ends are included, without bounds along axes that are not named.
    #[derive(Clone, Copy, Default)]
    Region {
        x_m: Option<Ends>, y_m: Option<Ends>, z_m: Option<Ends>,
    }

    /// A body. The first one has `particles_per_direction`, which holds for all; the others have a name and a law here.
    BodyForm {
        name: Option<Name>, density_kg_m3: Positive, particles_per_direction: Option<PerDirection>,
        shapes: Vec<Line<ShapeForm>>,
        velocity_m_s: Option<Vec<Finite>>,
        law: Option<Line<LawForm>>,
        /// Whether the scheme's remedy averages over it.
        remedy: Option<bool>,
        /// Coulomb's coefficient with which it slides on others; without, it sticks to those that have none either.
        friction: Option<NotNegative>,
        /// Horizontal over vertical stress at the start, of ground under its weight; none of a body without stress.
        k0: Option<NotNegative>,
        /// How much its cohesion grows per metre below its highest point, of a law by Mohr and Coulomb.
        cohesion_gradient_pa_m: Option<NotNegative>,
        /// Its own pores, where they are not those of `water`.
        porosity: Option<Share>, conductivity: Option<ConductivityForm>,
    }

    /// A factor over time, linear between knots of time (s) and factor, which stand here or in a CSV file beside the scene.
    AmplitudeForm {
        name: Name, knots: Option<Vec<[Finite; 2]>>, file: Option<String>,
    }

    /// A strength that softening leaves, and the plastic strain at which it does.
    #[derive(Clone, Copy)]
    ResidualForm {
        cohesion_pa: Finite, friction_deg: Finite,
        /// Zero.
        #[serde(default)] dilation_deg: NotNegative,
        plastic_strain: Positive,
    }

    WaterForm {
        porosity: Share,
        conductivity: ConductivityForm,
        /// With it water has a weight, and the densities of bodies are those of saturated ground.
        density_kg_m3: Option<Positive>,
        /// Where the pressure is zero at the start; the top of the bodies without it.
        level_m: Option<Finite>,
        /// Pressure nodes held at zero.
        drained: Option<Region>,
        #[serde(default)] faces: Vec<Line<FaceForm>>,
    }

    /// Sides of particle domains, of the particles in a region, under a load or drained.
    FaceForm {
        axis: AxisForm, end: EndForm,
        #[serde(default)] on: Region,
        traction_pa: Option<Vec<Finite>>,
        #[serde(default)] rise_s: NotNegative, amplitude: Option<Name>,
        drain_penalty_m_pa_s: Option<Positive>,
    }

    /// A rigid body with a barrier in front, of a face or a surface: the face is at `lo` a floor of what lies above it, at
    /// `hi` what presses from above.
    ContactForm {
        name: Name, axis: Option<AxisForm>, end: Option<EndForm>, at_m: Option<Finite>,
        #[serde(default)] within: Region,
        surface: Option<SurfaceForm>,
        velocity_m_s: Option<Vec<Finite>>,
        #[serde(default)] rise_s: NotNegative, amplitude: Option<Name>,
        stiffness_n_m: Positive, reach_m: Positive,
        friction: Option<FrictionForm>,
        #[serde(default, deserialize_with = "named")] phases: Vec<String>,
    }

    /// Coulomb's friction; without a coefficient what touches never slips.
    #[derive(Clone, Copy)]
    FrictionForm {
        coefficient: Option<NotNegative>, stiffness_n_m: Positive,
    }

    /// The scheme and its settings; each kind of solver has its own.
    SolverForm {
        scheme: String, time_step_s: Option<Positive>, cfl: Option<Courant>,
        flip: Option<Share>, pic_rate_per_s: Option<NotNegative>, kinetic_damping: Option<bool>, walls: Option<WallsForm>,
        tolerance: Option<Positive>, ghost_penalty: Option<NotNegative>, lumped: Option<Share>,
        ghost_pressure: Option<NotNegative>, projection_per_pa: Option<Positive>,
    }

    /// A part of the run. Its time begins at zero; the body continues from the end of the phase before.
    PhaseForm {
        name: Name,
        duration_s: Positive,
        /// Explicit runs only.
        local_damping: Option<Share>,
        /// In place of the scene's, of the same kind: a strength that is reduced.
        law: Option<LawForm>,
    }

    OutputForm {
        row_s: Positive,
        snapshot_rows: Option<Rows>,
    }
}

kinds! {
    /// Conditions at the two ends of an axis, the lower one first.
    #[derive(Clone, Copy)]
    EndsForm { Walls, WallOpen, OpenWall, Open, Periodic }

    #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
    AxisForm { X, Y, Z }

    #[derive(Clone, Copy)]
    EndForm { Lo, Hi }

    #[derive(Clone, Copy)]
    WallForm { Fixed, Roller, Separable }

    /// How B-splines meet walls.
    #[derive(Clone, Copy)]
    WallsForm { OpenKnot, WallLine }

    /// A part of the body. Particles stand at (k + ½) of their distance from zero, with whole numbers k.
    ShapeForm {
        /// Seeded from one corner to the opposite one.
        Box { from_m: Vec<Finite>, to_m: Vec<Finite> },
        /// In the plane of x and y; in three dimensions between two z.
        Polygon { corners_m: Vec<Vec<Finite>>, z_m: Option<Ends> },
        /// A disc, or a ball.
        Disc { centre_m: Vec<Finite>, radius_m: Positive },
        /// From a CSV file beside the scene: places, and volumes and velocities if it has them.
        Particles { file: String },
    }

    /// The surface of a rigid body.
    SurfaceForm {
        /// Sides from corner to corner, with the body's outside on their left; closed where the last corner is the first.
        Polygon { corners_m: Vec<Vec<Finite>> },
        /// Triangles of a file beside the scene, whose corners turn counter-clockwise as seen from outside.
        Stl { file: String },
    }

    /// Where a cone has the limit loads of Mohr and Coulomb's law.
    #[derive(Clone, Copy, Default)]
    MatchedForm { #[default] PlaneStrain, Compression, Extension }

    LawForm {
        NeoHookean { young_modulus_pa: Finite, poisson_ratio: Finite },
        Hencky { young_modulus_pa: Finite, poisson_ratio: Finite },
        HenckyJ2 { young_modulus_pa: Finite, poisson_ratio: Finite, strength: StrengthForm },
        DruckerPrager {
            young_modulus_pa: Finite,
            poisson_ratio: Finite,
            cohesion_pa: Finite,
            friction_deg: Finite,
            /// Zero.
            #[serde(default)]
            dilation_deg: NotNegative,
            /// Plane strain.
            #[serde(default)]
            matched: MatchedForm,
        },
        MohrCoulomb {
            young_modulus_pa: Finite,
            poisson_ratio: Finite,
            cohesion_pa: Finite,
            friction_deg: Finite,
            /// Zero.
            #[serde(default)]
            dilation_deg: NotNegative,
            /// The greatest principal stress; none without it.
            tension_pa: Option<NotNegative>,
            residual: Option<ResidualForm>,
        },
        NewtonianFluid { bulk_modulus_pa: Finite, viscosity_pa_s: Finite },
        /// The porosity is that of `water`.
        ImprovedHencky { bulk_parameter: Finite, shear_modulus_pa: Finite },
        CamClay {
            bulk_parameter: Finite, shear_modulus_pa: Finite,
            critical_ratio: Finite, plastic_compressibility: Finite,
            preconsolidation_pa: Finite, initial_pressure_pa: Finite,
            #[serde(default = "one")] alpha: Finite, #[serde(default = "one")] gamma: Finite,
        },
    }

    /// A strength of von Mises' law: of undrained shear in plane strain, or as ‖s‖.
    StrengthForm {
        Undrained { shear_strength_pa: Finite },
        Perfect { norm_pa: Finite },
        Softening { peak_pa: Finite, residual_pa: Finite, eta: Finite },
    }

    /// A number, or its product with n³/(1 − n)².
    #[derive(Clone, Copy)]
    ConductivityForm {
        Constant { m2_pa_s: Positive },
        KozenyCarman { m2_pa_s: Positive },
    }

    LoadForm {
        Gravity {
            acceleration_m_s2: Vec<Finite>,
            #[serde(default)] rise_s: NotNegative, amplitude: Option<Name>,
            #[serde(default, deserialize_with = "named")] phases: Vec<String>,
        },
        /// A force shared by the particles that begin in a region; per metre of depth in plane strain.
        Force {
            total_n: Vec<Finite>,
            on: Region,
            #[serde(default)] rise_s: NotNegative, amplitude: Option<Name>,
            #[serde(default, deserialize_with = "named")] phases: Vec<String>,
        },
        /// A traction on the free sides, at an end of an axis, of the particles that begin in a region. It keeps its
        /// direction, and its size per undeformed area.
        Traction {
            traction_pa: Vec<Finite>,
            axis: AxisForm, end: EndForm,
            #[serde(default)] on: Region,
            #[serde(default)] rise_s: NotNegative, amplitude: Option<Name>,
            #[serde(default, deserialize_with = "named")] phases: Vec<String>,
        },
        /// A pressure on such sides, which stays normal to them and goes with their area.
        Pressure {
            pressure_pa: Finite,
            axis: AxisForm, end: EndForm,
            #[serde(default)] on: Region,
            #[serde(default)] rise_s: NotNegative, amplitude: Option<Name>,
            #[serde(default, deserialize_with = "named")] phases: Vec<String>,
        },
        /// Dashpots on such sides: waves leave through them, and one may come in with a velocity.
        Absorbing {
            axis: AxisForm, end: EndForm,
            #[serde(default)] on: Region,
            incoming_m_s: Option<Vec<Finite>>,
            #[serde(default)] rise_s: NotNegative, amplitude: Option<Name>,
            #[serde(default, deserialize_with = "named")] phases: Vec<String>,
        },
    }

    SupportForm {
        Wall {
            name: Name, axis: AxisForm, end: EndForm, kind: WallForm, friction: Option<NotNegative>,
            #[serde(default, deserialize_with = "named")] phases: Vec<String>,
        },
        /// Nodes in a region that move at the given speeds (m/s), and freely along the axes that are not named.
        Nodes {
            name: Name,
            within: Region,
            velocity_m_s: BTreeMap<AxisForm, Finite>,
            /// Whether the region moves with them.
            #[serde(default)] moves: bool,
            #[serde(default)] rise_s: NotNegative, amplitude: Option<Name>,
            #[serde(default, deserialize_with = "named")] phases: Vec<String>,
        },
    }
}
