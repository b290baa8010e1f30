//! A free disc that turns, against the exact one: losses of angular momentum and energy by each transfer.

mod run;

use super::parameters::TimeStep;
use crate::cases::prelude::*;
use run::{RADIUS, Spin};

const LEVELS: [Level; 2] = [Level { name: "r4", h: 0.25 }, Level { name: "r8", h: 0.125 }];
/// Turns up to which a disc is judged by the exact one; beyond them by the losses of its transfer.
const FEW: f64 = 2.0;

parameters! {
    struct Disc {
        turns: f64 = real("-", "10", 0.1, 1e4), "turns";
        rim_speed: f64 = real("-", "0.1", 1e-3, 0.3), "speed of the rim over that of waves";
        cfl: f64 = common::CFL;
        time_step: TimeStep = common::TIME_STEP;
        flip: f64 = common::FLIP;
        ppc_per_direction: usize = common::PPC_PER_DIRECTION;
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.3");
        wall: common::Wall = common::WALL;
    }
}

metrics! { ALL:
    ANGULAR_MOMENTUM_ERROR = "angular_momentum_error", "-", "largest change of the angular momentum, that of affine parts with it, over its start; 10⁻¹² if it is less";
    ANGULAR_MOMENTUM_END = "angular_momentum_end", "-", "angular momentum at the end over its start";
    MOMENTUM_ERROR = "momentum_error", "-", "largest linear momentum over the mass times the speed of the rim; 10⁻¹² if it is less";
    ENERGY_GAIN = "energy_gain", "-", "largest rise of kinetic and stored energy, over their start";
    ENERGY_LOSS = "energy_loss", "-", "largest fall of kinetic and stored energy, over their start";
    ENERGY_END = "energy_end", "-", "change of kinetic and stored energy at the end, over their start";
    STRETCH_ERROR = "stretch_error", "-",
        "largest distance of the rms radius from that of the exact disc that turns as fast as the particles do by their angular momentum, over what the turning adds to it at the start";
    STRETCH_MEAN_ERROR = "stretch_mean_error", "-", "mean of that distance over the last half of the run, with its sign";
    PHASE_ERROR = "phase_error", "-", "angle that the disc has turned by over the exact one, less one";
    STORED_SHARE = "stored_share", "-", "stored energy over kinetic and stored energy at the start";
    MASS = "mass", "kg/m", "mass of the disc";
}

pub(super) fn case() -> Case {
    Case::of::<2, Spin>("spin", "A disc that turns", ALL)
        .planned(plan())
        .described("A free elastic disc starts in the exact state of one that turns, and turns ten or a hundred times: angular momentum, \
            energy and radius of every basis and transfer.")
        .reference("The rotating disc in plane strain at small strain (Timoshenko & Goodier 1951, §32).")
        .reference("Conservation of momentum, angular momentum and energy.")
        .limit("The exact disc is that of small strains: its stretch is off by the strain, a hundredth of it.")
        .limit("What FLIP takes of the angular momentum follows from no theory here: it is in the table.")
        .wanted("rotation", "angular momentum that is left", "affine-parts-take-their-share")
        .missed_by("flip-spins-down filters-spin-down")
        .wanted("stretch", "mean stretch of the last half", "stretch")
        .missed_by("gimp-swells musl-swells")
        .where_referenced()
        .checks(checks())
        .headline(ANGULAR_MOMENTUM_ERROR, "angular momentum off by (–)", 1.0, 6)
        .headline(ENERGY_END, "energy at the end (%)", 100.0, 2)
        .headline(ENERGY_GAIN, "gain (%)", 100.0, 3)
        .headline(STRETCH_MEAN_ERROR, "stretch off by (%)", 100.0, 1)
        .headline(PHASE_ERROR, "angle off by (%)", 100.0, 2)
        .watched(&["angular_momentum", "rms_radius"])
        .sketch(Sketch::of("A disc of 2 m in diameter that turns about its centre and touches nothing.")
            .disc([0.0, 0.0], RADIUS)
            .load([RADIUS, 0.0], [RADIUS, 0.5])
            .load([-RADIUS, 0.0], [-RADIUS, -0.5])
            .note([0.0, 0.0], "0.1 c at the rim")
            .length([-RADIUS, -1.15], [RADIUS, -1.15], "2 m"))
        .cost(|spec| {
            let steps = Setup::of_plan(spec).and_then(Spin::new).map_or(0, |disc| disc.steps);
            1e-6 * steps as f64 * (RADIUS / spec.level.h).powi(2)
        })
        .table(table())
        .breaks_down(breaks_down)
}

fn breaks_down(r: &Record) -> Option<&'static str> {
    const SWELLS: &str = "the disc swells until it leaves the grid: see musl-swells and gimp-swells";
    let hundred = Setup::<Disc>::number_of(r, |d| d.turns) >= 100.0;
    match (r.transfer(), r.basis(), r.remedy()) {
        (TransferName::Flip, Linear, _) => {
            Some("a rim that reaches over a grid line by a little has nodes of hardly any mass: docs/critical-step.md")
        }
        (TransferName::Musl, _, _) if hundred => Some(SWELLS),
        (TransferName::Musl, Linear, _) if r.is_default() && r.level == "r8" => Some(SWELLS),
        (TransferName::Apic, Gimp, FbarConsistent) if hundred => Some(SWELLS),
        _ => None,
    }
}

fn plan() -> Plan {
    let none = RemedyName::None;
    let mut all = pairs(&BASES, &[none]);
    all.extend(pairs(&[Gimp, Bspline2], &[FbarConsistent]));
    all.extend(other_transfers());
    all.extend([Linear, Gimp].map(|b| Scheme::explicit(b, none, TransferName::Musl)));
    let blended = pairs(&[Gimp, Bspline2], &[none]);
    // The scheme that breaks down at once is left to the night.
    let lives = |scheme: &&Scheme| **scheme != Scheme::flip(Linear, none);
    let alive: Vec<Scheme> = all.iter().filter(lives).copied().collect();
    let smooth: Vec<Scheme> = all.iter().filter(|s| s.basis() != Linear).copied().collect();
    Plan::of(LEVELS)
        .runs(Quick, "r4", &blended[..1], "")
        .runs(Pr, "r4", &alive, "")
        .runs(Pr, "r4 r8", &alive, "turns=2")
        .each(Nightly, "r4 r8", &all, ["turns=2", ""])
        .runs(Nightly, "r4", &all, "turns=100")
        .runs(Nightly, "r4 r8", &smooth, "time_step=auto turns=2")
        .each(Pr, "r4", &blended, ["flip=0.99", "flip=0"])
}

impl Setup<Disc> {
    fn is_long(&self) -> bool {
        self.turns > FEW
    }

    fn is_of(&self, transfer: TransferName) -> bool {
        self.transfer() == transfer
    }

    /// Share of the angular momentum that affine parts take: 4D/R², with D the mean second moment of the functions.
    fn affine_share(&self) -> f64 {
        // Hats averaged over places, and over a domain of half the spacing; quadratic splines everywhere.
        let half = 0.5 / self.ppc_per_direction as f64;
        let moment = match self.basis() {
            Gimp => 1.0 / 6.0 + half * half / 3.0,
            _ => 0.25,
        };
        let share = 4.0 * moment * (self.h / RADIUS).powi(2);
        share / (1.0 + share)
    }
}

fn checks() -> Vec<Check> {
    use TransferName::{Apic, Flip, Musl, Xpic2};
    type Check = CheckOf<Disc>;
    vec![
        Check::truth("momentum", "linear momentum zero to rounding")
            .at_most(MOMENTUM_ERROR, |_| ROUNDING)
            .because("weights sum to one and their gradients to zero"),
        Check::truth("affine-keeps-angular-momentum", "apic: angular momentum, with that of the affine parts, constant to rounding")
            .when(|d| d.is_of(Apic))
            .at_most(ANGULAR_MOMENTUM_ERROR, |_| ROUNDING)
            .because("the affine part carries what a node's arm has (Jiang et al. 2015), and stresses are symmetric"),
        Check::truth("affine-parts-take-their-share", "apic, up to two turns: spin slower by 4D/R² over one and that, D the functions' mean second moment, within h/R of it")
            .when(|d| d.is_of(Apic) && !d.is_long())
            .within(PHASE_ERROR, |d| -d.affine_share(), |d| d.h / RADIUS * d.affine_share())
            .because("angular momentum is kept, and I ω is then (M R²/2 + 2 M D) ω"),
        Check::truth("no-energy-gain", "none and fbar-consistent, not musl: kinetic and stored energy exceed their start by at most the energy stored then")
            .when(|d| matches!(d.remedy(), RemedyName::None | FbarConsistent) && !d.is_of(Musl))
            .at_most(ENERGY_GAIN, |d| d.metric(STORED_SHARE))
            .because("velocities live half a step before places: what the disc stores and its motion can exchange, and no more"),
        Check::truth("stretch", "splines, flip and apic, no remedy, up to two turns: mean stretch of the last half exact within h/R of it and the squared strain")
            .when(|d| d.is_of(Flip) || d.is_of(Apic))
            .when(|d| d.remedy() == RemedyName::None && d.flip == 1.0)
            .when(|d| d.basis().degree() > 1 && d.basis() != Gimp && !d.is_long())
            .within(STRETCH_MEAN_ERROR, |_| 0.0, |d| d.h / RADIUS + d.rim_speed.powi(2))
            .of_scale(|_| 1.0)
            .because("the rim lies within a cell, and the exact disc is that of small strains"),
        Check::truth("loss-falls-with-cells", "flip, two turns: loss of angular momentum in proportion to h² from 4 to 8 cells in the radius, within 0.15 of the order")
            .when(|d| d.is_of(Flip) && d.set == ["turns=2"] && d.metric(ANGULAR_MOMENTUM_ERROR).is_finite())
            .pairs(
                |coarse, fine| {
                    let same = coarse.scheme == fine.scheme && coarse.set == fine.set;
                    same && coarse.h == 2.0 * fine.h && fine.metric(ANGULAR_MOMENTUM_ERROR).is_finite()
                },
                |d, _| format!("order of angular_momentum_error of {}", d.scheme),
                |coarse, fine| (coarse.metric(ANGULAR_MOMENTUM_ERROR) / fine.metric(ANGULAR_MOMENTUM_ERROR)).log2(),
            )
            .above(|_| FORMAL - SLACK)
            .because("what a node's mass is off the node, times the layer in which it is"),
        Check::known_limit("flip-spins-down", "flip with η = 1, ten turns and more, four cells in the radius: loss of a tenth or more of the angular momentum")
            .when(|d| d.is_of(Flip) && d.flip == 1.0 && d.h >= 0.25 * RADIUS && d.is_long())
            .at_most(ANGULAR_MOMENTUM_END, |_| 0.9)
            .because("a lumped mass beside the rim lies off its node: FLIP keeps the nodes' angular momentum, not the particles'"),
        Check::known_limit("filters-spin-down", "PIC and xpic2, ten turns and more: loss of half or more of the angular momentum")
            .when(|d| (d.flip < 1.0 || d.is_of(Xpic2)) && d.is_long())
            .at_most(ANGULAR_MOMENTUM_END, |_| 0.5)
            .because("a node beside the rim turns as fast as the mass that it sees, which lies further in; a filter hands that to the particles in every step"),
        Check::known_limit("gimp-swells", "gimp with apic, ten turns and more: mean stretch of the last half above the exact one by more than h/R of it")
            .when(|d| d.basis() == Gimp && d.is_of(Apic) && d.is_long())
            .above(STRETCH_MEAN_ERROR, |d| d.h / RADIUS)
            .because("domains keep to the axes of the grid while their lattice turns: they no longer tile it, and crossing makes noise"),
        Check::known_limit("musl-swells", "musl, ten turns and more: radius off the exact one by more than the whole effect of the spin")
            .when(|d| d.is_of(Musl) && d.is_long())
            .above(STRETCH_ERROR, |_| 1.0)
            .because("strains are those of velocities mapped again, places are not: the rim moves off what its stress knows"),
    ]
}

fn table() -> ResultTable {
    const BLEND: Label = ("η", |r| Setup::<Disc>::number_of(r, |d| d.flip).to_string());
    const TURNED: Label = ("turns", |r| Setup::<Disc>::number_of(r, |d| d.turns).to_string());
    let shows = |r: &Record| r.changes_none_but(&["flip", "turns"]) && Setup::<Disc>::number_of(r, |d| d.turns) >= 10.0;
    ResultTable::of("spin", shows)
        .by(&[SCHEME, BLEND, TURNED, LEVEL])
        .metric("angular momentum off by", ANGULAR_MOMENTUM_ERROR, SHORT)
        .metric("energy at the end", ENERGY_END, percent(2))
        .metric("gain", ENERGY_GAIN, percent(3))
        .metric("stretch, mean", STRETCH_MEAN_ERROR, percent(1))
        .metric("largest", STRETCH_ERROR, percent(1))
        .metric("angle", PHASE_ERROR, percent(2))
}
