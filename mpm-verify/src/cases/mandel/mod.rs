//! Consolidation of a slab between rigid plates at small strain: nodes that move as one, water and solid in two dimensions,
//! and the pressure that rises before it falls.
//!
//! Mandel 1953, doi:10.1680/geot.1953.3.7.287. Set-up, choices and tolerances: `docs/mandel.md`.

mod checks;
mod metrics;
mod parameters;
mod pictures;
mod scene;
mod tables;
mod watch;

use super::family::{family, levels};
use crate::case::{Case, Family, Tier};
use crate::metric::error;
use crate::results::headline;
use crate::scheme::{BasisName, Scheme, SpaceName};
use crate::sketch::{Shape, Sketch};
use crate::spec::Level;
use metrics::{
    CENTRE_PRESSURE_ERROR, CENTRE_PRESSURE_ERROR_SPACE, ENTRIES, EQUATIONS_DISTANCE, MASS_ERROR,
    PEAK, PEAK_TIME, SETTLEMENT_ERROR,
};
use scene::WIDTH;
use watch::Consolidation;

use BasisName::{Gimp, Linear};
use SpaceName::{Equal, Ppp, TwoGrid};
use Tier::{Nightly, Pr, Quick};

const LEVELS: [(&str, f64); 3] = [("n8", 8.0), ("n16", 16.0), ("n32", 32.0)];
/// Steps that shrink as h² with the 240 of n16.
const COARSE: &[&str] = &["steps=60"];
const FINE: &[&str] = &["steps=960"];
const MIDDLE: &[&str] = &["steps=120"];
const RATIOS: [&[&str]; 2] = [&["poisson_ratio=0"], &["poisson_ratio=0.4"]];

pub(super) fn case() -> Case {
    let levels = levels(WIDTH, LEVELS);
    Case {
        name: "mandel",
        title: "Consolidation of a slab between plates",
        description: "A slab full of water is pressed together by rigid plates and drains at its sides, at small strain: the pressure \
                      in its middle rises before it falls. Exact solutions are series: of the slab, of its steps, and of the \
                      difference equations of its cells.",
        references: vec![
            "Mandel's series, derived on its page, tested against its equations and an independent integration in time."
                .to_owned(),
            "The difference equations by elimination, whose closed form in modes is tested against that.".to_owned(),
        ],
        limits: &[
            "Small strain on a fixed grid, and an answer that does not depend on the height.",
            "Two particles a cell and axis: with more the difference equations are others.",
        ],
        parameters: parameters::ALL.to_vec(),
        plan: plan(&levels),
        levels,
        metrics: metrics::ALL.to_vec(),
        checks: checks::checks(),
        headlines: vec![
            headline(CENTRE_PRESSURE_ERROR, "error of p in the middle (% of F/2a)", 100.0, 3),
            headline(CENTRE_PRESSURE_ERROR_SPACE, "of space alone (%)", 100.0, 3),
            headline(PEAK, "peak (F/2a)", 1.0, 4),
            headline(PEAK_TIME, "its T", 1.0, 4),
            headline(SETTLEMENT_ERROR, "error of settlement (%)", 100.0, 4),
            headline(EQUATIONS_DISTANCE, "from the difference equations (–)", 1.0, 7),
            headline(MASS_ERROR, "water made (–)", 1.0, 10),
            headline(ENTRIES, "entries of a matrix", 1.0, 0),
        ],
        quantities: vec![
            error(CENTRE_PRESSURE_ERROR_SPACE, "error of p in the middle, of space"),
            error(CENTRE_PRESSURE_ERROR, "error of p in the middle"),
        ],
        sweeps: Vec::new(),
        watched: &["centre_pressure", "settlement"],
        field: None,
        sketch: sketch(),
        cost: Box::new(|spec| 1e-6 * spec.level.h.powi(-3)),
        ladder: &[],
        own_runs: crate::record::of_defaults,
        begin: Box::new(|spec, parameters| Ok(Box::new(Consolidation::drive(spec, parameters)?))),
        pictures: pictures::draw,
        tables: tables::all(),
        breaks_down: |_| None,
    }
}

fn schemes(bases: &[BasisName]) -> Vec<Scheme> {
    let of = |basis: &BasisName| [TwoGrid, Equal, Ppp].map(|space| Scheme::poro(*basis, space));
    bases.iter().flat_map(of).collect()
}

fn plan(levels: &[Level]) -> Vec<Family> {
    let both = schemes(&[Gimp, Linear]);
    let (gimp, linear) = both.split_at(3);
    let (n8, n16, n32) = (&levels[..1], &levels[1..2], &levels[2..]);
    let mut all = vec![
        family(Quick, n8, &both[..1], COARSE),
        family(Pr, n8, &both, &[]),
        family(Pr, n8, linear, COARSE),
        family(Pr, n8, linear, MIDDLE),
        family(Pr, n16, linear, &[]),
        family(Pr, n32, linear, &[]),
        family(Nightly, n8, gimp, COARSE),
        family(Nightly, n8, gimp, MIDDLE),
        family(Nightly, n16, gimp, &[]),
        family(Nightly, n32, gimp, &[]),
        family(Nightly, n32, &both, FINE),
    ];
    all.extend(RATIOS.map(|set| family(Pr, n8, linear, set)));
    all.extend(RATIOS.map(|set| family(Nightly, n16, &both, set)));
    all
}

fn sketch() -> Sketch {
    let mut shapes = vec![
        Shape::Body(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 0.25], [0.0, 0.25]]),
        Shape::Held([0.0, 0.0], [1.0, 0.0]),
        Shape::Held([0.0, 0.0], [0.0, 0.25]),
        Shape::length([0.0, -0.12], [1.0, -0.12], "a = 1 m"),
        Shape::note([1.12, 0.12], "drained"),
        Shape::note([0.5, 0.5], "plate, F"),
    ];
    for k in 0..5 {
        let x = 0.1 + 0.2 * f64::from(k);
        shapes.push(Shape::Load([x, 0.42], [x, 0.27]));
    }
    Sketch {
        shapes,
        description: "A quarter of a slab between rigid plates, drained at its side.",
    }
}
