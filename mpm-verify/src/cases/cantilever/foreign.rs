//! What another code gives of the cantilever.

use super::edge::Edge;
use super::metrics::{self as m, STRESSES};
use super::parameters::{LOAD_STEPS, POINTS_PER_DIRECTION};
use super::scene::begin;
use crate::cases::observe::start_columns;
use crate::foreign::{Asked, Foreign, Group};
use crate::record::Discretisation;
use crate::scheme::{BasisName, RemedyName, Scheme};

const START_X: Asked = Asked::particle("reference_x", "m", "x before anything moves");
const START_Y: Asked = Asked::particle("reference_y", "m", "y before anything moves");
const MOVED_X: Asked = Asked::particle("ux", "m", "displacement along x under the whole weight");
const MOVED_Y: Asked = Asked::particle("uy", "m", "displacement along y under the whole weight");
const STRESS: Asked = Asked::particle(
    "stress_xx",
    "Pa",
    "Cauchy stress σ_xx under the whole weight, tension positive",
);

pub(in crate::cases) fn foreign() -> Foreign {
    let stresses = STRESSES.iter().map(|(metric, _)| *metric);
    let of_all = [m::STRESS_MIN, m::STRESS_MAX, m::STRESS_ERROR];
    Foreign {
        judged_as: |_| Scheme::quasi_static(BasisName::Bspline2, RemedyName::None),
        discretisation: |spec, parameters, _| Discretisation {
            dim: 2,
            h: spec.level.h,
            ppc: parameters.number(POINTS_PER_DIRECTION).powi(2) as u32,
            dt: 1.0 / parameters.number(LOAD_STEPS),
            wall: "open-knot".to_owned(),
        },
        groups: vec![
            Group {
                columns: &[START_X, START_Y, MOVED_X, MOVED_Y],
                metrics: vec![
                    m::CORNER_UX,
                    m::CORNER_UY,
                    m::EDGE_MEAN_UX,
                    m::EDGE_MEAN_UY,
                    m::CORNER_ERROR,
                    m::EDGE_MEAN_ERROR,
                ],
                measure: |given| {
                    let edge = Edge::new(&given.spec, &given.parameters);
                    let spacing = Edge::spacing(&given.spec, &given.parameters);
                    let order = given.in_order([&START_X, &START_Y], &edge.references, spacing)?;
                    let [ux, uy] = [&MOVED_X, &MOVED_Y].map(|u| {
                        let moved = given.column(u);
                        order.iter().map(|k| moved[*k]).collect::<Vec<f64>>()
                    });
                    Ok(edge.of_displacement([&ux, &uy], &given.parameters))
                },
            },
            Group {
                columns: &[START_X, START_Y, STRESS],
                metrics: of_all.into_iter().chain(stresses).collect(),
                measure: |given| {
                    let edge = Edge::new(&given.spec, &given.parameters);
                    let spacing = Edge::spacing(&given.spec, &given.parameters);
                    let order = given.in_order([&START_X, &START_Y], &edge.references, spacing)?;
                    let stress = given.column(&STRESS);
                    let stress: Vec<f64> = order.iter().map(|k| stress[*k]).collect();
                    Ok(edge.of_stress(&stress, &given.parameters))
                },
            },
        ],
        start: |spec, parameters| Ok(start_columns(begin(spec, parameters)?.particles())),
        setup: &[
            "Plane strain, 0 ≤ x ≤ 1 m, 0 ≤ y ≤ 0.3 m; the side x = 0 is clamped, all others are free.",
            "The elastic law that `law` names, with `young_modulus` and `poisson_ratio`; hencky: W = μ ‖h‖² + λ/2 (tr h)², h = ½ ln b; neo-hookean: W = μ/2 (I₁ − 3 − 2 ln J) + λ/2 ln² J.",
            "In equilibrium under a dead weight of `weight` (N/m³) of the initial volume, downward; in as many steps as you like.",
            "The particles of start.csv, all of them, in any order: the free end is extrapolated from their last two columns.",
        ],
        curves: |_| Vec::new(),
    }
}
