//! A homogeneously stretched and crushed body: where it tears, where its step becomes too long, and what reports it.

mod run;

use crate::cases::prelude::*;
use crate::exact::stretched_lattice::FREE;
use run::Stretching;

const LEVELS: [Level; 1] = [Level { name: "n8", h: 0.5 / FREE as f64 }];
/// The plane, crushed to the same J.
const PLANE: &str = "dimension=2 end=0.2236";
/// Relative resolution of the stretch of a stop, and effect of the free part's noise on the speed of waves.
const SEEN: f64 = 0.02;
/// Noise of the stress over the stress where slopes jump.
const JUMPS: f64 = 0.3;

parameters! {
    struct Stretch {
        end: f64 = real("-", "8", 0.02, 20.0), "stretch of each axis at the end: above 1 the body is pulled, below it is crushed";
        dimension: usize = whole("-", "1", 1, 2), "1: uniaxial strain; 2: plane strain, alike along both axes";
        speed: f64 = real("-", "0.02", 1e-3, 0.2), "speed of the ends of the free part at the start over that of waves in the undeformed body";
        rows: i32 = whole("-", "140", 10, 10_000), "rows of the series; quasi-static: equal load steps";
        cfl: f64 = common::CFL.with_default("0.1"), "CFL number c Δt / h of pressure waves in the undeformed body";
        ppc_per_direction: usize = common::PPC_PER_DIRECTION;
        poisson_ratio: f64 = common::POISSON_RATIO.with_default("0.3");
    }
}

metrics! { ALL:
    TEAR_STRETCH = "tear_stretch", "-", "first stretch at which the mean stress of the free part is less than half of the exact one, if reached";
    PARTED_STRETCH = "parted_stretch", "-", "first stretch at which neighbours have no common node, if reached";
    PREDICTED_TEAR_STRETCH = "predicted_tear_stretch", "-", "the same of particles at their exact places: where gap and support of the functions tear the body at the latest";
    UNSTABLE_STRETCH = "unstable_stretch", "-",
        "first stretch at which some motion of the free nodes, in the exact state without a remedy, has a negative stiffness, less the share by which the noise that is foretold may stretch some place more; none of linear functions";
    STOPPED_STRETCH = "stopped_stretch", "-", "stretch at which the program stops with an error, if it does";
    PREDICTED_STOP_STRETCH = "predicted_stop_stretch", "-", "explicit: stretch at which the fastest particle and waves of the exact state pass a cell in a step";
    STRESS_NOISE = "stress_noise", "-",
        "largest rms over the free part of what the stress differs from the exact one by, over it, up to unstable_stretch; of linear functions to predicted_tear_stretch";
    PREDICTED_NOISE = "predicted_noise", "-", "largest rms of the stress that answers the forces of a uniform stress on the lattice, over the exact stress, up to the same stretch";
    STRESS_KEPT = "stress_kept", "-", "mean stress of the free part at the end, over the exact one";
}

pub(super) fn case() -> Case {
    Case::of::<1, Stretching>("stretch", "A body that is stretched eightfold", ALL)
        .planned(plan())
        .described("The ends of a body move as if it were stretched alike everywhere, to eight times its length or a twentieth of it; \
            the part between them is free. Where does it tear, where is its step too long, and what says so?")
        .reference("Exact: the homogeneous motion and the law's stress in it.")
        .reference("Eigenvalues of the stiffness of the exact state, forces of its lattice: docs/stretch.md.")
        .limit("One law, undeformed domains, one lattice of particles; in the plane crushed only.")
        .wanted("stress", "mean stress of the stretched or crushed body", "stress-noise crushed-whole")
        .missed_by("jumps tears-early recursion-loses")
        .wanted("end", "stretch at which the body tears or the step is too long", "tears-no-earlier stops")
        .missed_by("jumps tears-early")
        .where_referenced()
        .checks(checks())
        .headline(TEAR_STRETCH, "tears at (–)", 1.0, 2)
        .headline(UNSTABLE_STRETCH, "holds at least to (–)", 1.0, 2)
        .headline(PREDICTED_TEAR_STRETCH, "neighbours part at (–)", 1.0, 2)
        .headline(STOPPED_STRETCH, "stops at (–)", 1.0, 2)
        .headline(PREDICTED_STOP_STRETCH, "predicted to stop at (–)", 1.0, 2)
        .headline(STRESS_NOISE, "noise of the stress (%)", 100.0, 1)
        .headline(PREDICTED_NOISE, "predicted (%)", 100.0, 1)
        .headline(STRESS_KEPT, "mean stress kept (%)", 100.0, 1)
        .watched(&["stress_kept", "stress_error"])
        .sketch(sketch())
        .cost(|spec| if spec.set.join(" ") == PLANE { 1.0 } else { 0.1 })
        .begun(problem::begin_in::<1, 2, Stretching>)
        .tables(tables())
}

fn plan() -> Plan {
    let none = RemedyName::None;
    let all = pairs(&BASES, &REMEDIES);
    let slow = implicit(&[RuleName::QuasiStatic], &BASES[..3], &[none, FbarConsistent]);
    // Torn pieces answer rounding.
    let sure = implicit(&[RuleName::QuasiStatic], &BASES[..3], &[none]);
    let plain = pairs(&BASES, &[none]);
    let consistent = pairs(&BASES[1..2], &[FbarConsistent]);
    // Transfers of the plane beside FLIP.
    let mut transfers = other_transfers();
    transfers.extend([Linear, Gimp].map(|basis| Scheme::explicit(basis, none, TransferName::Musl)));
    Plan::of(LEVELS)
        .runs(Quick, "n8", &consistent, "")
        .runs(Pr, "n8", &all, "")
        .runs(Pr, "n8", &sure, "")
        .runs(Pr, "n8", &all, "end=0.05")
        .runs(Pr, "n8", &slow, "end=0.05")
        // Steps that the waves of the deformed body outrun.
        .each(Pr, "n8", &plain, ["cfl=0.4", "cfl=0.55 end=0.05"])
        .runs(Nightly, "n8", &slow, "")
        .runs(Pr, "n8", &plain[1..2], PLANE)
        .runs(Nightly, "n8", &all, PLANE)
        .runs(Nightly, "n8", &transfers, PLANE)
        .each(Nightly, "n8", &plain, ["cfl=0.7 dimension=2 end=0.2236", "ppc_per_direction=4", "speed=0.005"])
}

fn sketch() -> Sketch {
    let high = 0.12;
    let part = |from: f64, to: f64| [[from, 0.0], [to, 0.0], [to, high], [from, high]];
    Sketch::of("A body that is longer than eight cells; beside these its nodes move as all would.")
        .body(part(0.0, 1.0))
        .body(part(-0.5, 0.0))
        .body(part(1.0, 1.5))
        .load([1.0 + 0.1, 0.5 * high], [1.0 + 0.4, 0.5 * high])
        .load([-0.1, 0.5 * high], [-0.4, 0.5 * high])
        .note([0.5, 0.5 * high], "free")
        .length([0.0, -0.08], [1.0, -0.08], "8 h")
}

impl Run<'_, Stretch> {
    fn is_pulled(&self) -> bool {
        self.end > 1.0
    }

    fn is_plain(&self) -> bool {
        self.remedy() == RemedyName::None
    }

    fn is_continuous(&self) -> bool {
        self.basis() != Linear
    }

    fn jumps_in_the_plane(&self) -> bool {
        self.record.discretisation.dim > 1 && !self.is_continuous()
    }
}

fn checks() -> Vec<Check> {
    type Check = CheckOf<Stretch>;
    type Demand = crate::demand::Demand<Stretch>;
    let (tears, stops) = (PREDICTED_TEAR_STRETCH, PREDICTED_STOP_STRETCH);
    vec![
        Check::truth("stress-noise", "no remedy, all but linear functions, exact state stable: stress exact within twice the response to the lattice's forces")
            .when(|b| b.is_plain() && b.is_continuous())
            .at_most(STRESS_NOISE, |b| SWING * b.metric(PREDICTED_NOISE))
            .because("forces of a wave that the lattice makes, over the stiffness that it meets; twice of what begins at once"),
        Check::truth("tears-no-earlier", "pulled, no remedy, all but linear functions: no tear while every motion of the free nodes has a positive stiffness, predicted noise included")
            .when(|b| b.is_pulled() && b.is_plain() && b.is_continuous() && b.has(TEAR_STRETCH))
            .above(TEAR_STRETCH, |b| b.metric(UNSTABLE_STRETCH))
            .because("a positive stiffness restores; a stress that moves with the particles takes from it"),
        Check::truth("crushed-whole", "crushed, no remedy: no tear, and mean stress exact within the predicted noise")
            .when(move |b| !b.is_pulled() && b.is_plain() && b.is_continuous() && !b.has(stops))
            .within(STRESS_KEPT, |_| 1.0, |b| SWING * b.metric(PREDICTED_NOISE))
            .because("neighbours come closer, and no stiffness is negative under pressure"),
        Check::truth("stops", "explicit, waves of the exact state faster than the step allows: the program stops there within 2 % of stretch, torn or noisy bodies no later")
            .when(move |b| b.has(stops))
            .each([
                Demand::at_most(STOPPED_STRETCH, move |b| b.metric(stops) * (1.0 + SEEN)).when(|b| b.is_pulled()),
                Demand::above(STOPPED_STRETCH, move |b| b.metric(stops) * (1.0 - SEEN)).when(|b| !b.is_pulled() && b.jumps_in_the_plane()),
                Demand::within(STOPPED_STRETCH, move |b| b.metric(stops), move |b| SEEN * b.metric(stops))
                    .when(|b| !b.is_pulled() && !b.jumps_in_the_plane()),
            ])
            .because("(c + |v|) Δt ≤ h of the deformed state, asked in every step"),
        Check::known_limit("jumps", "linear functions without a remedy, two particles a cell: noise three tenths of the stress or more")
            .when(|b| b.ppc_per_direction == 2 && b.is_plain() && !b.is_continuous())
            .above(STRESS_NOISE, |_| JUMPS)
            .because("the stress of a particle pushes another node as soon as it crosses a grid line"),
        Check::known_limit("tears-early", "explicit, pulled: the body tears without an error before particles at their exact places lose their last common node")
            .when(move |b| b.is_pulled() && !b.is_implicit() && !b.has(stops))
            .at_most(TEAR_STRETCH, move |b| b.metric(tears).min(b.end))
            .because("a stress that moves with the particles gives motions a negative stiffness that the grid sees badly"),
        Check::known_limit("recursion-loses", "fbar-recursive, one dimension, crushed to a tenth and less, all but cubic splines: nine tenths of the stress lost")
            .when(|b| b.end <= 0.1 && b.dimension == 1 && b.remedy() == FbarRecursive && b.basis() != Bspline3)
            .at_most(STRESS_KEPT, |_| 0.1)
            .because("under a pressure, what an average can't see grows: docs/critical-step.md"),
    ]
}

fn tables() -> Vec<ResultTable> {
    let crushed = || {
        [
            Column::metric("mean stress kept", STRESS_KEPT, share(1)),
            Column::metric("noise of the stress, most", STRESS_NOISE, share(1)),
            Column::metric("predicted", PREDICTED_NOISE, share(1)),
            Column::metric("stops at", STOPPED_STRETCH, fixed(2)),
        ]
    };
    let long = |r: &Record| Setup::<Stretch>::number_of(r, |b| b.cfl) > 0.1;
    let set: Label = ("set", |r| r.set.join(", "));
    let steps = ResultTable::of("stretch-steps", long).by(&[set, SCHEME]);
    vec![
        ResultTable::of("stretch", Record::is_default)
            .by(&[SCHEME])
            .metric("tears at", TEAR_STRETCH, fixed(2))
            .metric("stops at", STOPPED_STRETCH, fixed(2))
            .metric("holds at least to", UNSTABLE_STRETCH, fixed(2))
            .metric("neighbours part at", PREDICTED_TEAR_STRETCH, fixed(2))
            .metric("noise before", STRESS_NOISE, share(1))
            .metric("predicted", PREDICTED_NOISE, share(1)),
        ResultTable::new("crush", |r| r.set == ["end=0.05"], &[SCHEME], crushed()),
        ResultTable::new("crush-plane", |r| r.changes(PLANE), &[SCHEME], crushed()),
        steps.metric("stops at", STOPPED_STRETCH, fixed(3)).metric("predicted", PREDICTED_STOP_STRETCH, fixed(3)),
    ]
}
