//! Two bodies that fly against each other along the diagonal, until a function of the grid sees both.

use crate::lattice::nodes;
use mpm_solvers::scheme::BasisName;

/// Way in cells, along each axis, between two looks.
const LOOK: f64 = 0.005;

/// Columns of particles of a body: positions and ends (cells).
fn columns(body: &[[f64; 2]], h: f64) -> Vec<[[f64; 2]; 2]> {
    let ends = body.chunk_by(|[a, _], [b, _]| a == b).map(|column| {
        let ys = || column.iter().map(|[_, y]| y / h);
        let x = column[0][0] / h;
        let [low, high] = [ys().fold(f64::INFINITY, f64::min), ys().fold(f64::NEG_INFINITY, f64::max)];
        [[x; 2], [low, high]]
    });
    ends.collect()
}

/// The last look (s) before a node sees both bodies, if that is within `duration` (s): their particles by columns (m), of which
/// the first fly at `speed` (m/s) along both axes and the others against them; functions, cells of the size `h` (m), and half
/// the size of particles (cells).
#[must_use]
pub fn until_met(
    bodies: [&[[f64; 2]]; 2],
    (basis, h, half_size): (BasisName, f64, f64),
    speed: f64,
    duration: f64,
) -> Option<f64> {
    let [first, second] = bodies.map(|body| columns(body, h));
    // Particles of a column stand so close that it sees all nodes between those that its ends see.
    let seen = |column: &[[f64; 2]; 2], way: f64| {
        column.map(|[low, high]| {
            let [from, to] = [low, high].map(|x| nodes(basis, half_size, x + way));
            [from[0], to[1]]
        })
    };
    let look = LOOK * h / speed;
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
    use crate::lattice::support;

    const RADIUS: f64 = 0.2;

    /// The time of two discs with centres 0.6 √2 m apart, that fly past each other at a distance of their lines.
    fn met(basis: BasisName, h: f64, offset: f64) -> Option<f64> {
        let (spacing, aside) = (0.5 * h, 0.5 * offset / 2f64.sqrt());
        let along = (2.0 * RADIUS / spacing).round() as usize;
        let lattice = (0..along * along).map(|k| [k / along, k % along].map(|k| (k as f64 + 0.5) * spacing));
        let disc = lattice.filter(|[x, y]| (x - RADIUS).hypot(y - RADIUS) <= RADIUS);
        let first: Vec<[f64; 2]> = disc.map(|[x, y]| [x + aside, y - aside]).collect();
        let second: Vec<[f64; 2]> = first.iter().map(|[x, y]| [1.0 - x, 1.0 - y]).collect();
        until_met([&first, &second], (basis, h, 0.25), 0.005, 95.0)
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
