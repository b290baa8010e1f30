//! Columns that another code supplies, and the metrics computed from them.

use super::edge::Edge;
use super::run::Bending;
use super::*;
use crate::foreign::{Asked, Foreign, Given, Group, START_X, START_Y};

const MOVED_X: Asked = Asked::particle("ux", "m", "displacement along x under the whole weight");
const MOVED_Y: Asked = Asked::particle("uy", "m", "displacement along y under the whole weight");
const STRESS: Asked = Asked::particle("stress_xx", "Pa", "Cauchy stress σ_xx under the whole weight, tension positive");

/// The edge of a given result, its setup, and columns in the order of our particles.
type GivenEdge<const N: usize> = (Edge, Setup<Cantilever>, [Vec<f64>; N]);

fn given_edge<const N: usize>(given: &Given, columns: [&Asked; N]) -> Result<GivenEdge<N>, Error> {
    let setup = given.setup::<Cantilever>()?;
    let edge = Edge::new(&setup);
    let order = given.in_order([&START_X, &START_Y], &edge.references, setup.h / setup.points_per_direction as f64)?;
    let ordered = columns.map(|column| order.iter().map(|k| given.value(column, *k)).collect());
    Ok((edge, setup, ordered))
}

pub(in crate::cases) fn foreign() -> Foreign {
    let of_all = [STRESS_MIN, STRESS_MAX, STRESS_ERROR];
    let moved = [CORNER_UX, CORNER_UY, EDGE_MEAN_UX, EDGE_MEAN_UY, CORNER_ERROR, EDGE_MEAN_ERROR];
    let groups = vec![
        Group::new(&[START_X, START_Y, MOVED_X, MOVED_Y], moved, |given| {
            let (edge, setup, [ux, uy]) = given_edge(given, [&MOVED_X, &MOVED_Y])?;
            Ok(edge.of_displacement([&ux, &uy], &setup))
        }),
        Group::new(&[START_X, START_Y, STRESS], of_all.into_iter().chain(names(STRESSES)), |given| {
            let (edge, setup, [stress]) = given_edge(given, [&STRESS])?;
            Ok(edge.of_stress(&stress, &setup))
        }),
    ];
    Foreign { judged_as: |_| Scheme::quasi_static(Bspline2, RemedyName::None), ..Foreign::of::<2, Bending>(groups) }
}
