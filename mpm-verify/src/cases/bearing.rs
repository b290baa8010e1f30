//! A rigid strip footing on ground with friction and cohesion, with or without weight, beside a surcharge.
//!
//! Set-up, choices and tolerances: `docs/bearing.md`.

use crate::cases::footing::run::{BASE, FOOTING, WIDTH, ground, held_nodes, held_width};
use crate::cases::footing::sketch;
use crate::cases::observe::mean_stress;
use crate::cases::prelude::*;
use crate::exact::ground::{prandtl_extent, prandtl_reissner};
use crate::statistics::checkerboard;
use mpm_core::SymmetricTensor;
use mpm_core::material::{DruckerPrager, Matched, MohrCoulomb};
use mpm_core::stage::DeadForce;

/// Rows of the series.
const ROWS: f64 = 100.0;
/// The last share of the penetration, over which the load is averaged.
const PLATEAU: f64 = 0.25;
/// Penetration over B, over q_u/E, from which on the ground is plastic: J2 ground is from 3.6 on (docs/footing.md).
const PLASTIC: f64 = 5.0;
/// Largest q_u/E of a load that the strain of the ground does not change by a percent.
const STIFF: f64 = 1e-3;
/// The fastest rate (m/s) that halving proves slow enough, and E/ρ (m²/s²) of the ground that proves it.
const SLOW: (f64, f64) = (1e-3, 1e4);
/// Most damping that is known to hold nothing up, and largest relative difference of the forces on base and footing.
const DAMPED: f64 = 0.002;
const INERTIA: f64 = 0.01;
/// N_γ of a rough footing at φ = 30° by the method of characteristics, and a cohesion over γ B that adds nothing.
const N_GAMMA: f64 = 14.754;
const LITTLE: f64 = 1e-4;
/// Largest share of a pressure that its average does not see.
const SMOOTH: f64 = 0.2;
/// The longest step, as a CFL number, that halving proves short enough.
const SAFE_STEP: f64 = 0.5;

choices! {
    /// Yield surface.
    enum Surface { Cone = "cone", Pyramid = "pyramid" }
}

parameters! {
    /// Parameters of the case.
    struct Bearing {
        young_modulus: f64 = common::YOUNG_MODULUS.with_default("1e7");
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.3");
        density: f64 = common::DENSITY.with_default("1000"), "density ρ; it only matters for how slowly the footing must move";
        cohesion: f64 = real("Pa", "100", 1e-6, 1e12), "cohesion c";
        friction: f64 = real("deg", "20", 1.0, 45.0), "angle of friction φ";
        dilation: f64 = real("deg", "20", 0.0, 45.0), "angle of dilation ψ, at most φ";
        surface: Surface = Surface::Cone.by_default(), "yield surface: Drucker and Prager's cone, matched in plane strain, or Mohr and Coulomb's pyramid";
        unit_weight: f64 = real("Pa/m", "0", 0.0, 1e12), "unit weight γ of the ground, which begins at rest under K₀ = 1 − sin φ";
        surcharge: f64 = real("Pa", "0", 0.0, 1e12), "load q on the surface beside the footing, a dead one that rises with the footing's speed";
        domain_width: i32 = whole("B", "4", 2, 40), "width of the right half of the ground, in widths of the footing";
        domain_depth: i32 = whole("B", "3", 1, 40), "depth of the ground, in widths of the footing";
        penetration_rate: f64 = real("m/s", "1e-3", 1e-6, 1.0), "speed of the footing after its start";
        penetration: f64 = real("B", "0.002", 1e-4, 0.01), "penetration at the end, in widths of the footing";
        ramp: f64 = real("s", "0.5", 1e-6, 1e3), "time over which the footing's speed rises from zero";
        damping: f64 = common::DAMPING.with_default("0.002");
        cfl: f64 = common::CFL;
        flip: f64 = common::FLIP;
        wall: common::Wall = common::WALL;
        ppc_per_direction: usize = common::PPC_PER_DIRECTION;
    }
}

metrics! { OWN:
    CAPACITY_RATIO = "capacity_ratio", "-", "load by the width that the footing acts with over c N_c + q N_q + ½ γ B N_γ of associated flow, mean over the last quarter of the penetration";
    CAPACITY_ERROR = "capacity_error", "-", "relative distance of the load by B from that, the same mean";
    CAPACITY_PEAK = "capacity_peak", "-", "largest load of the run, as capacity_ratio";
    CAPACITY_RISE = "capacity_rise", "-", "relative growth of the load per 10⁻³ of s/B over the last quarter of the penetration";
    FORCE_IMBALANCE = "force_imbalance", "-", "force on the base, less surcharge and weight, over that on the footing, less one, mean over the last quarter: inertia";
    CHECKERBOARD_RATIO = "checkerboard_ratio", "-", "rms over all particles of σ_m − Πσ_m over that of σ_m";
    PLASTIC_STRAIN_MAX = "plastic_strain_max", "-", "largest equivalent plastic strain of a particle";
    MASS = "mass", "kg/m", "mass of the particles";
}

impl Setup<Bearing> {
    /// c N_c + q N_q + ½ γ B N_γ (Pa) under a footing of this width (m).
    fn exact(&self, width: f64) -> f64 {
        let [nq, nc] = prandtl_reissner(self.friction.to_radians());
        self.cohesion * nc + self.surcharge * nq + 0.5 * self.unit_weight * width * N_GAMMA
    }

    /// Width (m) that the footing acts with.
    fn width(&self) -> f64 {
        held_width(self.basis(), self.wall, self.h).0
    }

    fn law(&self) -> Result<SharedLaw, Fault> {
        let (elasticity, angles) =
            ((self.young_modulus, self.poisson_ratio), [self.friction, self.dilation].map(f64::to_radians));
        Ok(match self.surface {
            Surface::Cone => DruckerPrager::new(elasticity, self.cohesion, angles, Matched::PlaneStrain)?.into(),
            Surface::Pyramid => MohrCoulomb::new(elasticity, self.cohesion, angles)?.into(),
        })
    }

    fn is_associated(&self) -> bool {
        self.dilation == self.friction
    }

    /// Why the load of a run is not that of the theory, if it is not.
    fn other_load(&self) -> Option<String> {
        let [own, exact] = [
            [self.domain_width, self.domain_depth].map(|n| f64::from(n) * WIDTH),
            prandtl_extent(self.friction.to_radians(), WIDTH),
        ];
        let strain = self.exact(WIDTH) / self.young_modulus;
        let beside = self.friction != 30.0 || self.surcharge > 0.0 || self.cohesion > LITTLE * self.unit_weight * WIDTH;
        let rate = SLOW.0 * (self.young_modulus / self.density / SLOW.1).sqrt().min(1.0);
        let slow = self.penetration_rate <= rate * (1.0 + f64::EPSILON);
        let plastic = (1.0 - PLATEAU) * self.penetration >= PLASTIC * strain;
        let reasons = [
            (own[0] < exact[0] || own[1] < exact[1], "the mechanism is wider or deeper than the ground"),
            (self.unit_weight > 0.0 && beside, "N_γ is known here for φ = 30° without cohesion and surcharge"),
            (!plastic, "the ground is not plastic yet"),
            (strain > STIFF, "the ground deforms by more than a thousandth before it yields"),
            (!slow, "pressed so fast, the ground rings"),
            (self.cfl > SAFE_STEP, "the step is so long that yielding ground swings"),
            (self.damping > DAMPED, "damping holds what would move"),
            (self.transfer() != TransferName::Flip || self.flip < 1.0, "the transfer resists as a viscosity does"),
        ];
        reasons.into_iter().find(|(is, _)| *is).map(|(_, why)| why.to_owned())
    }

    fn locks(&self) -> bool {
        self.remedy() == RemedyName::None && self.basis() == Gimp
    }

    /// Penetration over B at `time` (s).
    fn stroke(&self, time: f64) -> f64 {
        self.penetration_rate * Amplitude::Rise(self.ramp).integral(time) / WIDTH
    }

    fn dt(&self) -> Result<f64, Fault> {
        Ok(courant_time_step(self.cfl, self.h, self.law()?.wave_speed(self.density)))
    }

    /// Surcharge of the whole surface beside the footing (N/m).
    fn surcharged(&self) -> f64 {
        self.surcharge * (f64::from(self.domain_width) - 0.5) * WIDTH
    }
}

/// Penetration over B, and forces (N/m): that of the ground on the footing, upward, and on its base, downward.
type Load = [f64; 3];

struct Pressing {
    setup: Setup<Bearing>,
    dt: f64,
    steps_per_row: u64,
}

impl Problem<2> for Pressing {
    type Parameters = Bearing;
    type Seen = Vec<Load>;

    fn new(setup: Setup<Bearing>) -> Result<Self, Error> {
        if setup.dilation > setup.friction {
            let (psi, phi) = (setup.dilation, setup.friction);
            return Err(Error::Input(format!("dilation = {psi} deg; allowed: from 0 to friction = {phi} deg")));
        }
        let dt = setup.dt()?;
        let duration = setup.penetration * WIDTH / setup.penetration_rate + 0.5 * setup.ramp;
        Ok(Self { setup, dt, steps_per_row: (duration / dt / ROWS).ceil() as u64 })
    }

    fn discretisation(&self) -> Discretisation {
        self.setup.regular(2, self.dt)
    }

    fn begin(&self, _: &Self::Seen) -> Begun<2> {
        let setup = &self.setup;
        let mut ground = ground(setup, [setup.domain_width, setup.domain_depth], setup.law()?)?;
        if setup.unit_weight > 0.0 {
            let (weight, k0) = (setup.unit_weight, 1.0 - setup.friction.to_radians().sin());
            ground.bodies = ground.bodies.under(|_, x| {
                let yy = weight * x[1];
                SymmetricTensor { xx: k0 * yy, yy, zz: k0 * yy, ..SymmetricTensor::default() }
            })?;
            let down = [0.0, -weight / setup.density];
            ground = ground.load(Gravity(Box::new(move |_| down)));
        }
        let beside = |x: &[f64; 2]| x[0] > 0.5 * WIDTH && x[1] > -0.75 * setup.pitch();
        let surcharge = DeadForce::shared(
            [0.0, -setup.surcharged()],
            Amplitude::Rise(setup.ramp),
            &ground.bodies.particles,
            beside,
        );
        let velocity = [Some(0.0), Some(-setup.penetration_rate)];
        let scene = ground.load(surcharge).constrain(held_nodes(setup.h, velocity, setup.ramp));
        setup.explicit(scene, self.dt, setup.damping)
    }

    fn row(&self, seen: &mut Self::Seen, phase: &mut Phase<2>) -> Result<Row, Fault> {
        let mut load = Load::default();
        for _ in 0..self.steps_per_row {
            load[0] += self.setup.stroke(phase.run.time());
            phase.steps(1)?;
            load[1] += phase.run.on(Part::Constraint(FOOTING)).force[1];
            load[2] -= phase.run.on(Part::Constraint(BASE)).force[1];
        }
        let load = load.map(|sum| sum / self.steps_per_row as f64);
        seen.push(load);
        let totals = phase.run.totals();
        Ok(row! {
            "penetration (-)": load[0],
            "footing_force (N/m)": load[1],
            "base_force (N/m)": load[2],
            "capacity_ratio (-)": 2.0 * load[1] / self.setup.width() / self.setup.exact(self.setup.width()),
            "kinetic_energy (J/m)": totals.kinetic_energy,
            "jacobian_min (-)": totals.jacobian.0,
            "jacobian_max (-)": totals.jacobian.1,
        })
    }

    fn progress(&self, _: &Self::Seen, phase: &Phase<2>) -> f64 {
        (self.setup.stroke(phase.run.time()) / self.setup.penetration * (1.0 + 1e-9)).min(1.0)
    }

    fn particles<'a>(&self, _: &Self::Seen, mut columns: Columns<'a, 2>) -> Columns<'a, 2> {
        let (mean_stress, averaged) = mean_stress(columns.run());
        columns
            .references()
            .displacements()
            .seeded("mean_stress", "Pa", mean_stress)
            .seeded("averaged_mean_stress", "Pa", averaged)
            .field("plastic_strain", "-", Field::PlasticStrain)
            .jacobian()
    }

    fn metrics(&self, seen: &Self::Seen, phase: &mut Phase<2>) -> Vec<(Metric, f64)> {
        let setup = &self.setup;
        let plateau: Vec<&Load> = seen.iter().filter(|l| l[0] > (1.0 - PLATEAU) * setup.penetration).collect();
        let mean_of = |k: usize| mean(plateau.iter().map(|l| l[k]));
        let ratio = |force: f64, width: f64| 2.0 * force / width / setup.exact(width);
        let (force, most) = (mean_of(1), seen.iter().map(|l| l[1]).fold(0.0, f64::max));
        let points: Vec<(f64, f64)> = plateau.iter().map(|l| (l[0], l[1] / force)).collect();
        let run = phase.run.as_mut();
        let dead = setup.surcharged() + setup.unit_weight / setup.density * run.totals().mass;
        let (mean_stress, averaged) = mean_stress(run);
        let board = checkerboard(&mean_stress, &averaged) / rms(mean_stress.iter().copied());
        vec![
            (CAPACITY_RATIO, ratio(force, setup.width())),
            (CAPACITY_ERROR, ratio(force, WIDTH) - 1.0),
            (CAPACITY_PEAK, ratio(most, setup.width())),
            (CAPACITY_RISE, fit_line(&points).map_or(f64::NAN, |line| 1e-3 * line.slope)),
            (FORCE_IMBALANCE, (mean_of(2) - dead) / force - 1.0),
            (CHECKERBOARD_RATIO, board),
            (PLASTIC_STRAIN_MAX, run.field(Field::PlasticStrain).into_iter().fold(0.0, f64::max)),
            (MASS, run.totals().mass),
        ]
    }
}

/// Heavy ground without cohesion.
const HEAVY: &str =
    "unit_weight=400 cohesion=1e-3 friction=30 dilation=30 domain_width=6 young_modulus=1e8 penetration=0.001";
/// ψ = 0 at the same φ, and φ = 30° with its wider mechanism.
const CONSTANT_VOLUME: &str = "dilation=0";
const THIRTY: &str = "friction=30 dilation=30 domain_width=6 penetration=0.004";

pub(super) fn case() -> Case {
    let compared = pairs(&[Gimp, Bspline2], &[RemedyName::None, FbarRecursive, FbarRate, FbarConsistent]);
    let sound = pairs(&[Gimp, Bspline2], &[RemedyName::None, FbarConsistent]);
    let plan = Plan::of(levels(WIDTH, [("b10", 10.0), ("b20", 20.0), ("b40", 40.0)]))
        .runs(Pr, "b10", &[sound[0], sound[1], sound[3]], "cfl=0.5 domain_depth=2 penetration=0.001")
        .runs(Nightly, "b10", &compared, "")
        .runs(Nightly, "b20", &sound, "")
        .runs(Long, "b20 b40", &compared, "")
        .runs(Nightly, "b10", &compared, CONSTANT_VOLUME)
        .runs(Nightly, "b20", &sound, CONSTANT_VOLUME)
        .each(Nightly, "b10 b20", &sound, ["surface=pyramid", "surcharge=100"])
        .each(Nightly, "b10 b20", &sound, [THIRTY, HEAVY])
        .runs(Long, "b40", &[sound[1], sound[3]], HEAVY)
        .runs(Nightly, "b10", &sound[1..2], "penetration_rate=5e-4");
    Case::of::<2, Pressing>("bearing", "Strip footing on ground with friction", OWN)
        .planned(plan)
        .described("A rough rigid strip footing pressed slowly into ground with cohesion and friction, a Hencky \
            solid with the cone of Drucker and Prager matched in plane strain, beside a surcharge. Dilation is a constraint \
            on the volume as undrained shear is: GIMP without a remedy locks, and a remedy whose forces do not see what its strains see breaks down.")
        .reference("Prandtl (1920), Reissner (1924): q_u = c N_c + q N_q, exact for associated flow and small strain.")
        .reference("Martin (2005), method of characteristics: ½ γ B N_γ with N_γ = 14.754 at φ = 30°, rough.")
        .reference("Radenkovic (1961): with ψ < φ no load is greater than that of associated flow.")
        .limit("With ψ < φ the load is not unique, falls after a peak and depends on the cells.")
        .limit("N_γ of heavy ground converges slowly: cells count twice for the width, and hold the footing in the ground.")
        .breaks_down(|r| {
            let pushes = matches!(r.remedy(), FbarRecursive | FbarRate | FbarTotal);
            (pushes && Setup::<Bearing>::holds(r, |b| b.dilation > 0.0))
                .then_some("dilation of single particles pushes modes of volume that this average does not see, and nothing answers")
        })
        .wanted("capacity", "load on the footing at the end", "prandtl-reissner")
        .missed_by("locked")
        .wanted("pressure", "mean stress of all particles at the end", "smooth-pressure")
        .missed_by("checkerboard")
        .checks(checks())
        .headline(CAPACITY_RATIO, "load over exact (–)", 1.0, 3)
        .headline(CAPACITY_PEAK, "largest (–)", 1.0, 3)
        .headline(CAPACITY_RISE, "rise (%/10⁻³)", 100.0, 2)
        .headline(CHECKERBOARD_RATIO, "checkerboard (–)", 1.0, 2)
        .quantity(error(CAPACITY_ERROR, "relative error of the load by B"))
        .watched(&["capacity_ratio", "jacobian_max"])
        .sketch(sketch([4, 3], "Ground four footing widths wide and three deep, its base fixed, its sides on rollers, the left one the axis of symmetry; a rigid footing half a metre wide presses on the upper left corner, a surcharge beside it."))
        .tables(vec![
            ResultTable::of("bearing", is_flip)
                .by(&[SCHEME, ("h", |r| r.level.replace('b', "B/")), CHANGED])
                .metric("load over exact", CAPACITY_RATIO, fixed(3))
                .metric("by B, off by", CAPACITY_ERROR, percent(1))
                .metric("largest", CAPACITY_PEAK, fixed(3))
                .metric("rise per 10⁻³", CAPACITY_RISE, percent(1))
                .metric("checkerboard", CHECKERBOARD_RATIO, fixed(2))
                .cpu(),
        ])
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Bearing>;
    // The edge is known to half a cell on either side of the middle between the last held node and the first free one.
    let edge = |b: &Run<Bearing>| b.h / WIDTH;
    let heavy = |b: &Run<Bearing>| {
        (b.unit_weight > 0.0).then(|| "weight bears with the square of the width, and beside nodes that are held in the ground: judged by three levels".to_owned())
    };
    let why = "the ground bears its load over a width that the cells know to h";
    vec![
        Check::truth(
            "quasi-static",
            "mean force on the base that on footing and surface within 1 % over the last quarter of the penetration",
        )
        .unless(|b| b.other_load())
        .at_most(Quantity::abs(FORCE_IMBALANCE), |_| INERTIA)
        .because("linear momentum of a body that is pressed slowly"),
        Check::truth(
            "prandtl-reissner",
            "ψ = φ, all but GIMP without a remedy: load over the effective width c N_c + q N_q within h/B",
        )
        .when(|b| !b.locks())
        .unless(|b| (!b.is_associated()).then(|| "ψ < φ: no exact load".to_owned()))
        .unless(|b| b.other_load())
        .unless(heavy)
        .within(CAPACITY_RATIO, |_| 1.0, edge)
        .because(why),
        Check::truth(
            "below-associated",
            "ψ < φ, all but GIMP without a remedy: greatest load at most that of associated flow, within h/B",
        )
        .when(|b| !b.locks() && !b.is_associated())
        .unless(|b| b.other_load())
        .at_most(CAPACITY_PEAK, move |b| 1.0 + edge(b))
        .because("Radenkovic's first theorem"),
        Check::known_limit(
            "locked",
            "GIMP without a remedy: load over the effective width above that of associated flow by more than h/B",
        )
        .when(|b| b.locks())
        .unless(|b| b.other_load())
        .unless(heavy)
        .above(CAPACITY_RATIO, move |b| 1.0 + edge(b))
        .because("standard MPM locks, for every angle of dilation"),
        Check::truth("smooth-pressure", "F̄, ψ = φ: rms(σ_m − Πσ_m) below 0.2 rms σ_m")
            .when(|b| b.remedy() == FbarConsistent && b.is_associated())
            .unless(|b| b.other_load())
            .at_most(CHECKERBOARD_RATIO, |_| SMOOTH)
            .because("a pressure that is resolved is close to its average: docs/footing.md"),
        Check::known_limit("checkerboard", "none, ψ = φ: rms(σ_m − Πσ_m) above 0.2 rms σ_m")
            .when(|b| b.remedy() == RemedyName::None && b.is_associated())
            .unless(|b| b.other_load())
            .above(CHECKERBOARD_RATIO, |_| SMOOTH)
            .because("standard MPM locks: its pressure is noise, also where its load is not"),
        Check::truth(
            "converges",
            "ψ = φ, F̄, three levels, with and without weight: the finest load by B is the exact one within the grid convergence index",
        )
        .study(|records| {
            let own = records
                .iter()
                .filter(|r| (r.is_default() || r.changes(HEAVY)) && is_flip(r) && r.remedy() == FbarConsistent);
            let of = |((scheme, set), runs): ((Scheme, &Vec<String>), Vec<&Record>)| {
                let [coarse, middle, fine] = finest(&runs)? else { return None };
                let errors = [coarse, middle, fine].map(|r| r.metric(CAPACITY_ERROR));
                let bound = index(errors, 1.0, true).bound;
                let name = format!("{} of {scheme} {}", CAPACITY_ERROR.name, set.join(" "));
                Some(Finding::within(
                    name,
                    errors[2],
                    0.0,
                    bound,
                    "Roache's index of three levels, of first order at most",
                ))
            };
            ladders_by(own, |r| (r.scheme(), &r.set)).into_iter().filter_map(of).collect()
        }),
    ]
}
