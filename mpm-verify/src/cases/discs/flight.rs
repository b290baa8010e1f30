//! Duration of the free flight, until a function sees both discs.

use super::{Contact, Discs};
use crate::exact::lattice::nodes;
use crate::setup::Setup;
use std::f64::consts::SQRT_2;

/// Radius and centres (m) of the discs.
pub(super) const RADIUS: f64 = 0.2;
pub(super) const CENTRES: [[f64; 2]; 2] = [[0.2, 0.2], [0.8, 0.8]];
/// Way in cells, along each axis, between two looks.
const LOOK: f64 = 0.005;

/// Columns of particles of a disc: positions and ends (cells).
fn columns(disc: &[[f64; 2]], h: f64) -> Vec<[[f64; 2]; 2]> {
    let ends = disc.chunk_by(|[a, _], [b, _]| a == b).map(|column| {
        let ys = || column.iter().map(|[_, y]| y / h);
        let x = column[0][0] / h;
        let [low, high] = [ys().fold(f64::INFINITY, f64::min), ys().fold(f64::NEG_INFINITY, f64::max)];
        [[x; 2], [low, high]]
    });
    ends.collect()
}

/// The last look (s) before a node sees both discs, or the time (s) at which bodies can touch first, if that is within
/// `duration` (s).
pub(super) fn until_met(setup: &Setup<Discs>, duration: f64) -> Option<f64> {
    if setup.contact == Contact::Bodies {
        // Domains of particles end half their distance beyond the rims, at most.
        let way = (2.0 * RADIUS + setup.pitch()).powi(2) - setup.offset.powi(2);
        let gap = (CENTRES[1][0] - CENTRES[0][0]) * SQRT_2 - way.max(0.0).sqrt();
        return Some(gap / (2.0 * SQRT_2 * setup.speed)).filter(|time| way >= 0.0 && *time <= duration);
    }
    let (h, basis) = (setup.h, setup.basis());
    let half_size = 0.5 / setup.ppc_per_direction as f64;
    let places = setup.seed();
    let (first, second) = places.split_at(places.len() / 2);
    let [first, second] = [first, second].map(|disc| columns(disc, h));
    // Particles of a column stand so close that it sees all nodes between those that its ends see.
    let seen = |column: &[[f64; 2]; 2], way: f64| {
        column.map(|[low, high]| {
            let [from, to] = [low, high].map(|x| nodes(basis, half_size, x + way));
            [from[0], to[1]]
        })
    };
    let look = LOOK * h / setup.speed;
    let meet = |k: &u64| {
        let way = LOOK * *k as f64;
        let others: Vec<_> = second.iter().map(|column| seen(column, -way)).collect();
        let meets = |own: [[f64; 2]; 2]| {
            let common = |a: [f64; 2], b: [f64; 2]| a[0] <= b[1] && b[0] <= a[1];
            others.iter().any(|other| common(own[0], other[0]) && common(own[1], other[1]))
        };
        first.iter().any(|column| meets(seen(column, way)))
    };
    let looks = (duration / look).ceil() as u64;
    let met = (0..=looks).find(meet)?;
    Some(look * met.saturating_sub(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::lattice::support;
    use crate::record::fixture::setup;
    use crate::scheme::{BasisName, RemedyName, Scheme};
    use crate::spec::Level;

    fn met(basis: BasisName, h: f64, offset: f64) -> Option<f64> {
        let offset = format!("offset={offset}");
        until_met(&setup(Scheme::flip(basis, RemedyName::None), Level { name: "", h }, &[&offset]), 95.0)
    }

    /// A function that sees both has a support of each within √2 of it, along the diagonal.
    #[test]
    fn discs_miss_each_other_beyond_what_functions_reach() {
        for basis in [BasisName::Linear, BasisName::Gimp, BasisName::Bspline2] {
            for h in [0.05, 0.025] {
                let reach = 2.0 * 2f64.sqrt() * support(basis, 0.25) * h;
                assert!(met(basis, h, 2.0 * RADIUS + reach).is_none(), "{basis} {h}");
                assert!(met(basis, h, 2.0 * RADIUS).is_some(), "{basis} {h}");
            }
        }
    }

    /// Head on, rims are a gap of 0.6 √2 − 0.4 m apart.
    #[test]
    fn discs_meet_head_on_once_their_gap_is_within_reach() {
        let gap = 0.6 * 2f64.sqrt() - 0.4;
        let closing = 2.0 * 2f64.sqrt() * 0.005;
        for basis in [BasisName::Linear, BasisName::Gimp, BasisName::Bspline2] {
            let reach = 2.0 * 2f64.sqrt() * support(basis, 0.25) * 0.05;
            let free = met(basis, 0.05, 0.0).unwrap();
            let (earliest, latest) = ((gap - reach) / closing, (gap + 0.05) / closing);
            assert!((earliest..latest).contains(&free), "{basis} {free}");
        }
    }
}
