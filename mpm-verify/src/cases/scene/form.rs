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
        #[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
        #[serde(try_from = "f64")]
        pub(super) struct $name(pub(super) $of);

        impl TryFrom<f64> for $name {
            type Error = String;

            fn try_from(value: f64) -> Result<Self, String> {
                let fits: fn(f64) -> bool = $fits;
                match fits(value) {
                    true => Ok(Self(value as $of)),
                    false => Err(format!("{value} where {} is allowed", $allowed)),
                }
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
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
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
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
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

/// A scene file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Form {
    /// [`FORMAT`].
    pub(super) format: Line<u32>,
    pub(super) title: String,
    pub(super) grid: Line<GridForm>,
    pub(super) body: Line<BodyForm>,
    pub(super) law: Line<LawForm>,
    #[serde(default)]
    pub(super) bodies: Vec<Line<BodyForm>>,
    pub(super) water: Option<Line<WaterForm>>,
    #[serde(default)]
    pub(super) loads: Vec<Line<LoadForm>>,
    #[serde(default)]
    pub(super) supports: Vec<Line<SupportForm>>,
    #[serde(default)]
    pub(super) contacts: Vec<Line<ContactForm>>,
    pub(super) solver: Line<SolverForm>,
    pub(super) phases: Vec<Line<PhaseForm>>,
    pub(super) output: Line<OutputForm>,
}

/// The grid. It has as many axes as `cells` has numbers.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GridForm {
    pub(super) cell_size_m: Positive,
    pub(super) lower_m: Vec<Finite>,
    pub(super) cells: Vec<Cells>,
    pub(super) ends: Vec<EndsForm>,
}

/// Conditions at the two ends of an axis, the lower one first.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum EndsForm {
    Walls,
    WallOpen,
    OpenWall,
    Open,
    Periodic,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum AxisForm {
    X,
    Y,
    Z,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum EndForm {
    Lo,
    Hi,
}

/// A box whose ends are included, without bounds along axes that are not named.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Region {
    pub(super) x_m: Option<Ends>,
    pub(super) y_m: Option<Ends>,
    pub(super) z_m: Option<Ends>,
}

/// A body. The first one has `particles_per_direction`, which holds for all; the others have a name and a law here.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BodyForm {
    pub(super) name: Option<Name>,
    pub(super) density_kg_m3: Positive,
    pub(super) particles_per_direction: Option<PerDirection>,
    pub(super) shapes: Vec<Line<ShapeForm>>,
    pub(super) velocity_m_s: Option<Vec<Finite>>,
    pub(super) law: Option<Line<LawForm>>,
    /// Whether the scheme's remedy averages over it: true.
    pub(super) remedy: Option<bool>,
    /// Coulomb's coefficient with which it slides on others; without, it sticks to those that have none either.
    pub(super) friction: Option<NotNegative>,
    /// Horizontal over vertical stress at the start, of ground under its weight; none of a body without stress.
    pub(super) k0: Option<NotNegative>,
    /// Of its pores, where they are not those of `water`.
    pub(super) porosity: Option<Share>,
    pub(super) conductivity: Option<ConductivityForm>,
}

/// A part of the body. Particles stand at (k + ½) of their distance from zero, with whole numbers k.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum ShapeForm {
    /// Seeded from one corner to the opposite one.
    Box { from_m: Vec<Finite>, to_m: Vec<Finite> },
    /// In the plane of x and y; in three dimensions between two z.
    Polygon { corners_m: Vec<Vec<Finite>>, z_m: Option<Ends> },
    /// A disc, or a ball.
    Disc { centre_m: Vec<Finite>, radius_m: Positive },
    /// From a CSV file beside the scene: places, and volumes and velocities if it has them.
    Particles { file: String },
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum LawForm {
    NeoHookean {
        young_modulus_pa: Finite,
        poisson_ratio: Finite,
    },
    Hencky {
        young_modulus_pa: Finite,
        poisson_ratio: Finite,
    },
    HenckyJ2 {
        young_modulus_pa: Finite,
        poisson_ratio: Finite,
        strength: StrengthForm,
    },
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
    NewtonianFluid {
        bulk_modulus_pa: Finite,
        viscosity_pa_s: Finite,
    },
    /// The porosity is that of `water`.
    ImprovedHencky {
        bulk_parameter: Finite,
        shear_modulus_pa: Finite,
    },
    CamClay {
        bulk_parameter: Finite,
        shear_modulus_pa: Finite,
        critical_ratio: Finite,
        plastic_compressibility: Finite,
        preconsolidation_pa: Finite,
        initial_pressure_pa: Finite,
        alpha: Option<Finite>,
        gamma: Option<Finite>,
    },
}

/// Where a cone has the limit loads of Mohr and Coulomb's law.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum MatchedForm {
    #[default]
    PlaneStrain,
    Compression,
    Extension,
}

/// A strength of von Mises' law: of undrained shear in plane strain, or as ‖s‖.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum StrengthForm {
    Undrained { shear_strength_pa: Finite },
    Perfect { norm_pa: Finite },
    Softening { peak_pa: Finite, residual_pa: Finite, eta: Finite },
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WaterForm {
    pub(super) porosity: Share,
    pub(super) conductivity: ConductivityForm,
    /// Pressure nodes held at zero.
    pub(super) drained: Option<Region>,
    #[serde(default)]
    pub(super) faces: Vec<Line<FaceForm>>,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum ConductivityForm {
    Constant {
        m2_pa_s: Positive,
    },
    /// c n³/(1 − n)².
    KozenyCarman {
        m2_pa_s: Positive,
    },
}

/// Sides of particle domains, of the particles in a region, under a load or drained.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FaceForm {
    pub(super) axis: AxisForm,
    pub(super) end: EndForm,
    #[serde(default)]
    pub(super) on: Region,
    pub(super) traction_pa: Option<Vec<Finite>>,
    #[serde(default)]
    pub(super) rise_s: NotNegative,
    pub(super) drain_penalty_m_pa_s: Option<Positive>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum LoadForm {
    Gravity {
        acceleration_m_s2: Vec<Finite>,
        #[serde(default)]
        rise_s: NotNegative,
        #[serde(default)]
        phases: Vec<String>,
    },
    /// A force shared by the particles that begin in a region; per metre of depth in plane strain.
    Force {
        total_n: Vec<Finite>,
        on: Region,
        #[serde(default)]
        rise_s: NotNegative,
        #[serde(default)]
        phases: Vec<String>,
    },
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub(super) enum SupportForm {
    Wall {
        name: Name,
        axis: AxisForm,
        end: EndForm,
        kind: WallForm,
        #[serde(default)]
        phases: Vec<String>,
    },
    /// Nodes in a region that move at the given speeds (m/s), and freely along the axes that are not named.
    Nodes {
        name: Name,
        within: Region,
        velocity_m_s: BTreeMap<AxisForm, Finite>,
        #[serde(default)]
        rise_s: NotNegative,
        #[serde(default)]
        phases: Vec<String>,
    },
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum WallForm {
    Fixed,
    Roller,
    Separable,
}

/// A rigid face with a barrier in front: at `lo` a floor of what lies above it, at `hi` what presses from above.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ContactForm {
    pub(super) name: Name,
    pub(super) axis: AxisForm,
    pub(super) end: EndForm,
    pub(super) at_m: Finite,
    #[serde(default)]
    pub(super) within: Region,
    pub(super) velocity_m_s: Option<Vec<Finite>>,
    #[serde(default)]
    pub(super) rise_s: NotNegative,
    pub(super) stiffness_n_m: Positive,
    pub(super) reach_m: Positive,
    pub(super) friction: Option<FrictionForm>,
    #[serde(default)]
    pub(super) phases: Vec<String>,
}

/// Coulomb's friction; without a coefficient what touches never slips.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FrictionForm {
    pub(super) coefficient: Option<NotNegative>,
    pub(super) stiffness_n_m: Positive,
}

/// The scheme and its settings; each kind of solver has its own.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SolverForm {
    pub(super) scheme: String,
    pub(super) time_step_s: Option<Positive>,
    pub(super) cfl: Option<Courant>,
    pub(super) flip: Option<Share>,
    pub(super) pic_rate_per_s: Option<NotNegative>,
    pub(super) kinetic_damping: Option<bool>,
    pub(super) walls: Option<WallsForm>,
    pub(super) tolerance: Option<Positive>,
    pub(super) ghost_penalty: Option<NotNegative>,
    pub(super) lumped: Option<Share>,
    pub(super) ghost_pressure: Option<NotNegative>,
    pub(super) projection_per_pa: Option<Positive>,
}

/// How B-splines meet walls.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum WallsForm {
    OpenKnot,
    WallLine,
}

/// A part of the run. Its time begins at zero; the body continues from the end of the phase before.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PhaseForm {
    pub(super) name: Name,
    pub(super) duration_s: Positive,
    /// Explicit runs only.
    pub(super) local_damping: Option<Share>,
    /// In place of the scene's, of the same kind: a strength that is reduced.
    pub(super) law: Option<LawForm>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OutputForm {
    /// Time between two rows of the series.
    pub(super) row_s: Positive,
    /// Rows between two snapshots; none without.
    pub(super) snapshot_rows: Option<Rows>,
}
