//! Ground whose answer is known: shipped scenes, run with cells of several sizes.
//!
//! Set-up, choices and tolerances: `docs/soils.md`.

use super::scene;
use crate::cases::prelude::*;
use crate::exact::ground;
use crate::job::Column as Values;

choices! {
    /// The scene that is run.
    enum Ground { Strip = "strip-load", Wall = "earth-pressure", Rough = "rough-wall", Sand = "sand-column", Cylinder = "sand-cylinder" }
}

parameters! {
    /// Parameters of the case.
    struct Soils {
        ground: Ground = Ground::Strip.by_default(), "scene: a strip load on an elastic half-space, a smooth or a rough wall that gives way and then pushes, or a column or a cylinder of sand that collapses";
    }
}

metrics! { OWN:
    VERTICAL_ERROR = "vertical_stress_error", "-", "strip load: greatest error of σ_yy over the load, below the depth b and up to 4b";
    SHEAR_ERROR = "shear_stress_error", "-", "strip load: that of σ_xy";
    ACTIVE_RATIO = "active_ratio", "-", "earth pressure: force on the wall that gives way over Rankine's, or Sokolovskii's if it is rough";
    PASSIVE_RATIO = "passive_ratio", "-", "earth pressure: force on the wall that pushes over that";
    RUNOUT_RATIO = "runout_ratio", "-", "sand: way of the front of 99 % of the particles beyond the edge, over the width or radius";
    HEIGHT_RATIO = "height_ratio", "-", "sand: height that is left over that of the start";
}

/// Cells (m) of the strip's scene; those of the others are as much larger or smaller.
const CELLS: f64 = 0.25;
/// Half width of the strip and height of its box (m), and the load (Pa).
const STRIP: (f64, f64, f64) = (1.0, 16.0, 1000.0);
/// Share by which the ground is strained when its wall moves.
const STROKE: f64 = 1e-3;
/// Width and height of the column (m).
const COLUMN: f64 = 0.1;

/// Greatest errors of σ_yy and σ_xy over the load.
fn strip(x: &[f64], y: &[f64], stresses: [&[f64]; 2]) -> [f64; 2] {
    let (half, height, load) = STRIP;
    let mut worst = [0.0_f64; 2];
    for (k, x) in x.iter().enumerate() {
        let depth = height - y[k];
        if (half..4.0 * half).contains(&depth) && *x < 3.0 * half {
            for ((worst, stress), exact) in worst.iter_mut().zip(stresses).zip(ground::strip(*x, depth, half)) {
                *worst = worst.max((stress[k] / load - exact).abs());
            }
        }
    }
    worst
}

/// A run of a scene, measured: the last rows of its phases and its particles at the end.
fn measure(of: Ground, ends: &[Row], particles: &[Values]) -> Vec<(Metric, f64)> {
    let column = |name: &str| particles.iter().find(|c| c.name == name).map_or(&[][..], |c| &c.values[..]);
    let force = |row: &Row| row.0.iter().find(|(name, _)| name.starts_with("wall_x")).map_or(f64::NAN, |(_, x)| *x);
    let (x, y) = (column("x"), column("y"));
    match of {
        Ground::Strip => {
            let [vertical, shear] = strip(x, y, ["stress_yy", "stress_xy"].map(column));
            vec![(VERTICAL_ERROR, vertical), (SHEAR_ERROR, shear)]
        }
        Ground::Wall | Ground::Rough => {
            let (weight, [phi, delta]) = (1835.0 * 9.81, [30.0_f64, 15.0].map(f64::to_radians));
            let rough = || ground::rough_wall(phi, delta).map(|k| -0.5 * k * weight * 25.0);
            let exact = if of == Ground::Wall { ground::rankine(weight, 1e3, phi, 5.0) } else { rough() };
            let ratios = ends.iter().zip(exact).map(|(row, exact)| force(row) / exact);
            [ACTIVE_RATIO, PASSIVE_RATIO].into_iter().zip(ratios).collect()
        }
        Ground::Sand | Ground::Cylinder => {
            let z = column("z");
            let from_axis = |k: usize| if z.is_empty() { x[k] } else { x[k].hypot(y[k]) };
            let height = |k: usize| if z.is_empty() { y[k] } else { z[k] };
            let mut places: Vec<(f64, f64)> = (0..x.len()).map(|k| (from_axis(k), height(k))).collect();
            places.sort_by(|a, b| a.0.total_cmp(&b.0));
            let front = places.get(places.len() - 1 - places.len() / 100).map_or(f64::NAN, |place| place.0);
            let height = places.iter().take_while(|p| p.0 < 0.1 * COLUMN).map(|p| p.1).fold(0.0, f64::max);
            vec![(RUNOUT_RATIO, front / COLUMN - 1.0), (HEIGHT_RATIO, height / COLUMN)]
        }
    }
}

fn begin(spec: &RunSpec, values: &Parameters) -> Result<Box<dyn Job>, Error> {
    let of = Soils::read(values)?.ground;
    let text = match of {
        Ground::Strip => include_str!("../../scenes/strip-load.toml"),
        Ground::Wall => include_str!("../../scenes/earth-pressure.toml"),
        Ground::Rough => include_str!("../../scenes/rough-wall.toml"),
        Ground::Sand => include_str!("../../scenes/sand-column.toml"),
        Ground::Cylinder => include_str!("../../scenes/sand-cylinder.toml"),
    };
    scene::begin(
        text,
        spec.level.h / CELLS,
        spec,
        values,
        Box::new(move |ends, particles| measure(of, ends, particles)),
    )
}

pub(super) fn case() -> Case {
    let statics = implicit(&[RuleName::QuasiStatic], &[Gimp, Bspline2], &[RemedyName::None]);
    let sand = pairs(&[Gimp, Bspline2], &[RemedyName::None]);
    let plan = Plan::of(vec![Level::new("c1", CELLS), Level::new("c2", 0.5 * CELLS), Level::new("c4", 0.25 * CELLS)])
        .runs(Pr, "c1", &statics, "")
        .runs(Pr, "c1", &statics, "ground=earth-pressure")
        .runs(Pr, "c1", &statics[1..], "ground=rough-wall")
        .runs(Pr, "c1", &sand[1..], "ground=sand-column")
        .runs(Nightly, "c1 c2 c4", &statics, "")
        .runs(Nightly, "c1 c2", &statics, "ground=earth-pressure")
        .runs(Nightly, "c1 c2", &statics[1..], "ground=rough-wall")
        .runs(Nightly, "c1 c2 c4", &sand, "ground=sand-column")
        .runs(Nightly, "c1 c2", &sand, "ground=sand-cylinder");
    Case {
        cost: Box::new(|spec| (CELLS / spec.level.h).powi(3)),
        ..Case::begun_by("soils", "Ground against exact solutions", &[OWN, &[scene::ENERGY]].concat(), Soils::list(), Box::new(begin))
    }
    .planned(plan)
    .described("Shipped scenes of ground: a strip load on an elastic half-space, by a traction; a smooth and a rough wall \
        before which ground yields, actively and passively; columns of sand that collapse. Levels are cells of the strip load, and those of the others in proportion.")
    .reference("Flamant's solution of a line load, integrated over the strip.")
    .reference("Rankine (1857): K = tan²(π/4 ∓ φ/2).")
    .reference("Sokolovskii (1965), Statics of Granular Media: K of a rough wall, by his equations.")
    .reference("Lube et al. (2004, 2005), doi:10.1017/S0022112004009036, doi:10.1103/PhysRevE.72.041301: experiments on columns of sand, validation.")
    .limit("The strip's half-space is a box of 16 half widths.")
    .limit("Particles of sand that have parted have no stress and fly: the front runs on with smaller cells.")
    .wanted("answer", "stresses below the strip, force on the wall or the column's energy", "stress rankine energy")
    .checks(checks())
    .headline(VERTICAL_ERROR, "σ_yy (% of q)", 100.0, 2)
    .headline(SHEAR_ERROR, "σ_xy (% of q)", 100.0, 2)
    .headline(ACTIVE_RATIO, "active (–)", 1.0, 4)
    .headline(PASSIVE_RATIO, "passive (–)", 1.0, 4)
    .headline(RUNOUT_RATIO, "run-out (–)", 1.0, 2)
    .quantity(error(VERTICAL_ERROR, "greatest error of σ_yy over q"))
    .quantity(error(SHEAR_ERROR, "greatest error of σ_xy over q"))
    .watched(&["displacement_max", "stored_energy"])
    .sketch(Sketch::of("The right half of an elastic half-space, a box on rollers; a traction presses on a strip at its upper left corner.")
        .body([[0.0, 0.0], [16.0, 0.0], [16.0, 16.0], [0.0, 16.0]])
        .held([0.0, 0.0], [16.0, 0.0])
        .held([0.0, 16.0], [0.0, 0.0])
        .held([16.0, 0.0], [16.0, 16.0])
        .load([0.5, 18.0], [0.5, 16.0])
        .length([0.0, 18.5], [1.0, 18.5], "b"))
    .tables(vec![
        table("strip-load", Ground::Strip).metric("σ_yy off by", VERTICAL_ERROR, percent(1)).metric("σ_xy off by", SHEAR_ERROR, percent(1)).cpu(),
        table("earth-pressure", Ground::Wall).metric("active", ACTIVE_RATIO, fixed(4)).metric("passive", PASSIVE_RATIO, fixed(4)).cpu(),
        table("rough-wall", Ground::Rough).metric("active", ACTIVE_RATIO, fixed(3)).metric("passive", PASSIVE_RATIO, fixed(3)).cpu(),
        table("sand-column", Ground::Sand).metric("run-out", RUNOUT_RATIO, fixed(2)).metric("height left", HEIGHT_RATIO, fixed(2)).cpu(),
        table("sand-cylinder", Ground::Cylinder).metric("run-out", RUNOUT_RATIO, fixed(2)).metric("height left", HEIGHT_RATIO, fixed(2)).cpu(),
    ])
}

/// The runs of a ground.
fn table(name: &'static str, ground: Ground) -> ResultTable {
    let own = move |r: &Record| Setup::<Soils>::holds(r, |s| s.ground == ground);
    ResultTable::of(name, own).by(&[SCHEME, ("cells", |r| format!("h/{}", &r.level[1..]))])
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Soils>;
    // h/b over the b of the strip, and h/H over the height of the wall.
    let half = |s: &Run<Soils>| s.record.discretisation.h / STRIP.0 / PI;
    let wall = |s: &Run<Soils>| {
        if s.ground == Ground::Wall && s.basis() == Gimp { STROKE } else { s.record.discretisation.h / 5.0 }
    };
    let rings = |s: &Run<Soils>| s.is_explicit().then(|| "loaded at once, it rings".to_owned());
    vec![
        Check::truth("stress", "strip load: stresses those of a half-space within h/(π b) of the load")
            .when(|s| s.ground == Ground::Strip)
            .unless(rings)
            .at_most(VERTICAL_ERROR, half)
            .at_most(SHEAR_ERROR, half)
            .because("a cell has the stress of its middle, and particles stand up to h/2 off it along both axes, where stresses change by q/(π b) a length at most"),
        Check::truth("rankine", "earth pressure: forces Rankine's within 0.1 % with GIMP, and within h/H with splines and at rough walls")
            .when(|s| matches!(s.ground, Ground::Wall | Ground::Rough))
            .unless(rings)
            .within(ACTIVE_RATIO, |_| 1.0, wall)
            .within(PASSIVE_RATIO, |_| 1.0, wall)
            .because("the stroke makes the ground 3·10⁻⁴ higher and denser; the place of a wall of held nodes and of the foot of a wedge is known to half a cell, and thrust grows with the square"),
        Check::truth("energy", "sand: kinetic energy is at most what gravity gave and stresses and losses took, by rounding")
            .when(|s| matches!(s.ground, Ground::Sand | Ground::Cylinder))
            .at_most(scene::ENERGY, |_| 1.0)
            .because("a transfer with a lumped mass gives no energy"),
    ]
}
