//! Contact between bodies, Bardenhagen, Brackbill & Sulsky (2000), doi 10.1016/S0045-7825(99)00338-2, and Bardenhagen et
//! al. (2001): bodies that slide have velocity fields of their own, which exchange momentum at nodes that two of them see.
//!
//! The gap g of a node is that between the domains of the particles that see it, along the shortest way between their
//! convex hulls. Its normal n is the shortest way between the hulls of the ends of all these ways near it; where those
//! overlap, its own way, and where its own hulls do, that of the gradients of both volumes. With the relative velocity
//! w = v_a − v_b and the reduced mass m, a step of Δt exchanges, where they would meet,
//!
//! J = m (w·n − max(g, 0)/Δt) n + min(m |w_t|, μ J_n) w_t/|w_t|,
//!
//! which b gains and a loses: they move apart as they will, nothing acts before surfaces meet, and momentum is exact. A
//! grid alone would have them meet where they see a common node, up to two cells apart. Components that constraints hold
//! take no part. `docs/bodies.md` has limits and tests.

use super::stages::push;
use super::{Solver, Transfer, VelocityField};
use crate::basis::Basis;
use crate::bodies::Bodies;
use crate::lattice::{Lattice, Stencil};
use crate::ledger::Ledger;
use nalgebra::{SMatrix, SVector};
use std::array::from_fn;

/// Share of a way's square by which it may be longer than the shortest one, and most moves until it is found.
const NEAREST: f64 = 1e-12;
const MOVES: usize = 100;
/// Points of which one of least norm is made, at most.
const MOST: usize = 4;
/// Cells along each axis within which ways count for the normal of a node.
const NEAR: usize = 3;
/// Share of the squares of differences by which points on a line are kept apart.
const LEAST: f64 = 1e-12;

/// A node that the particles of two fields see.
#[derive(Debug, Clone, Copy)]
struct Shared<const D: usize> {
    node: usize,
    /// Gradients of the volumes of both (m^(D − 1)).
    slopes: [SVector<f64, D>; 2],
    /// Unit normal, from the first body to the second.
    normal: SVector<f64, D>,
    /// The gap between the domains of the particles (m).
    gap: f64,
    /// The components that no constraint holds.
    free: [bool; D],
}

/// Where two bodies may touch: room for what a step finds.
pub(super) struct Touching<const D: usize> {
    shared: Vec<Shared<D>>,
    /// One more than the place of every node in that list; zero of nodes that are not in it.
    place: Vec<u32>,
    /// Whether a stencil that begins at a node may have one of these.
    begins: Vec<bool>,
    /// Particles with such stencils, of both, and those that see a listed node, by its place.
    near: [Vec<usize>; 2],
    seen: [Vec<(usize, usize)>; 2],
    /// Particles at the ends of the shortest ways, of both, by place, and those near one node.
    ends: [Vec<(usize, usize)>; 2],
    around: [Vec<(usize, usize)>; 2],
}

/// The shortest way (m) between two hulls, and the pairs of particles at its ends.
struct Way<const D: usize> {
    way: SVector<f64, D>,
    pairs: [[(usize, usize); 2]; MOST],
    count: usize,
}

impl<const D: usize, const S: usize, B: Basis<S>, T: Transfer<D>> Solver<D, S, B, T> {
    /// Lets every two fields meet.
    pub(super) fn meet(&mut self) {
        let Self { fields, touching, lattice, scene, ledger, settings, .. } = self;
        ledger.touches.iter_mut().for_each(|touch| touch.force = [0.0; 3]);
        for second in 1..fields.len() {
            for first in 0..second {
                if let Ok(pair) = fields.get_disjoint_mut([first, second]) {
                    touching.find(lattice, &scene.bodies, &pair);
                    touching.exchange(&scene.bodies, settings.dt, pair, ledger);
                }
            }
        }
    }
}

impl<const D: usize> Touching<D> {
    /// Room on a lattice of this many nodes.
    pub(super) fn new(nodes: usize) -> Self {
        let (place, begins) = (vec![0; nodes], vec![false; nodes]);
        let [seen, ends, around] = <[[Vec<_>; 2]; 3]>::default();
        Self { place, begins, shared: Vec::new(), near: Default::default(), seen, ends, around }
    }

    /// Finds the nodes that both fields see, their normals and the gaps there.
    fn find<const S: usize, B: Basis<S>, T>(
        &mut self,
        lattice: &Lattice<D, S, B>,
        bodies: &Bodies<D>,
        pair: &[&mut VelocityField<T>; 2],
    ) {
        self.find_nodes(lattice, pair);
        let p = &bodies.particles;
        for (near, field) in self.near.iter_mut().zip(pair) {
            near.clear();
            for range in field.bodies.iter().map(|body| bodies.each[*body].range()) {
                lattice.for_each_first_node(&p.position[range.clone()], &p.half_size, |k, first| {
                    if self.begins[first] {
                        near.push(range.start + k);
                    }
                });
            }
        }
        for (side, (near, seen)) in self.near.iter().zip(&mut self.seen).enumerate() {
            seen.clear();
            for k in near {
                let (shared, volume) = (&mut self.shared, p.volume[*k]);
                for_each_seen(lattice, &self.place, &p.position[*k], &p.half_size, |place, slope| {
                    shared[place].slopes[side] += slope * volume;
                    seen.push((place, *k));
                });
            }
            seen.sort_unstable();
        }
        self.ends.iter_mut().for_each(Vec::clear);
        for (place, Shared { slopes: [a, b], normal, gap, .. }) in self.shared.iter_mut().enumerate() {
            let both = self.seen.each_ref().map(|seen| at_place(seen, place));
            *normal = *a - *b;
            if let Some(Way { way, pairs, count }) = shortest_way(&p.position, both) {
                for (side, ends) in self.ends.iter_mut().enumerate() {
                    ends.extend(pairs[..count].iter().map(|pair| (place, pair[side].1)));
                }
                *normal = way.normalize();
                // Where a domain ends along the way, if it is the ellipsoid within.
                let end = |k: usize, sign: f64| {
                    let half = SVector::from(p.half_size) * p.jacobian[k].powf(1.0 / D as f64);
                    normal.dot(&SVector::from(p.position[k])) + sign * normal.component_mul(&half).norm()
                };
                let far = both[0].iter().map(|(_, k)| end(*k, 1.0)).fold(f64::NEG_INFINITY, f64::max);
                let near = both[1].iter().map(|(_, k)| end(*k, -1.0)).fold(f64::INFINITY, f64::min);
                *gap = (near - far).max(0.0);
            }
        }
        for Shared { node, normal, free, .. } in &mut self.shared {
            self.around.iter_mut().for_each(Vec::clear);
            for place in lattice.around(*node, NEAR).filter_map(|near| self.place[near].checked_sub(1)) {
                for (around, ends) in self.around.iter_mut().zip(&self.ends) {
                    around.extend(at_place(ends, place as usize));
                }
            }
            if let Some(wide) = shortest_way(&p.position, self.around.each_ref().map(Vec::as_slice)) {
                *normal = wide.way;
            }
            for k in (0..D).filter(|k| !free[*k]) {
                normal[k] = 0.0;
            }
            *normal = normal.try_normalize(0.0).unwrap_or_else(SVector::zeros);
        }
    }

    fn find_nodes<const S: usize, B: Basis<S>, T>(
        &mut self,
        lattice: &Lattice<D, S, B>,
        [first, second]: &[&mut VelocityField<T>; 2],
    ) {
        self.shared.clear();
        self.place.fill(0);
        self.begins.fill(false);
        let (lines, rows) = Stencil::<D, S>::OUTER;
        let both = first.reach.within(0, first.nodes.len()).flatten();
        for node in both.filter(|node| first.nodes[*node].mass() > 0.0 && second.nodes[*node].mass() > 0.0) {
            let zero = SVector::zeros();
            self.shared.push(Shared { node, slopes: [zero; 2], normal: zero, gap: 0.0, free: [true; D] });
            self.place[node] = self.shared.len() as u32;
            for r in 0..lines * rows {
                let last = lattice.row_offset(r / rows, r % rows) + S;
                self.begins[(node + 1).saturating_sub(last)..=(node + S).saturating_sub(last)].fill(true);
            }
        }
        for c in first.prescribed.iter().chain(&second.prescribed) {
            if let Some(place) = self.place[c.node].checked_sub(1) {
                self.shared[place as usize].free[c.axis] = false;
            }
        }
    }

    /// Exchanges momentum where they would meet in a step of `dt` (s).
    fn exchange<T>(&self, bodies: &Bodies<D>, dt: f64, pair: [&mut VelocityField<T>; 2], ledger: &mut Ledger) {
        let slides = pair.each_ref().map(|field| bodies.each[field.bodies[0]].slides);
        let friction = slides.into_iter().flatten().fold(f64::INFINITY, f64::min);
        let mut total = SVector::<f64, D>::zeros();
        let [first, second] = pair;
        for Shared { node, normal, gap, free, .. } in &self.shared {
            let nodes = [&mut first.nodes[*node], &mut second.nodes[*node]];
            let [a, b] = nodes.each_ref().map(|node| node.motion.to_array());
            let apart = SVector::<f64, D>::from_fn(|k, _| if free[k] { a[k] - b[k] } else { 0.0 });
            let (mass, approach) = (a[3] * b[3] / (a[3] + b[3]), apart.dot(normal));
            let closing = approach - gap / dt;
            if closing <= 0.0 {
                continue;
            }
            let along = apart - normal * approach;
            let slid = along.norm();
            let stuck = if slid > 0.0 { f64::min(1.0, friction * closing / slid) } else { 0.0 };
            let impulse = (normal * closing + along * stuck) * mass;
            total += impulse;
            for (node, sign) in nodes.into_iter().zip([-1.0, 1.0]) {
                let mass = node.mass();
                ledger.residual.kinetic_energy -= node.kinetic_energy();
                for k in (0..D).filter(|k| free[*k]) {
                    let loss = push(node, k, sign * impulse[k] / mass, dt, &mut ledger.residual);
                    ledger.accumulated.constraint_loss += loss;
                }
                ledger.residual.kinetic_energy += node.kinetic_energy();
            }
        }
        for (field, sign) in [first, second].into_iter().zip([-1.0, 1.0]) {
            for body in &field.bodies {
                let touch = &mut ledger.touches[*body];
                for k in 0..D {
                    touch.force[k] += sign * total[k] / dt;
                    touch.impulse[k] += sign * total[k];
                }
            }
        }
    }
}

/// The entries of a list, sorted by place, that have one place.
fn at_place(list: &[(usize, usize)], place: usize) -> &[(usize, usize)] {
    let from = list.partition_point(|(at, _)| *at < place);
    let count = list[from..].partition_point(|(at, _)| *at == place);
    &list[from..from + count]
}

/// The shortest way from the convex hull of some particles to that of others, none where they overlap: the point of
/// least norm of their differences, by Wolfe (1976), doi 10.1007/BF01580381.
fn shortest_way<const D: usize>(positions: &[[f64; D]], [from, to]: [&[(usize, usize)]; 2]) -> Option<Way<D>> {
    let at = |(_, k): &(usize, usize)| SVector::from(positions[*k]);
    let mut pairs = [[*from.first()?, *to.first()?]; MOST];
    let mut way = at(&pairs[0][1]) - at(&pairs[0][0]);
    let begun = way.norm_squared();
    // Differences with their shares in the way: at most one more than there are dimensions.
    let mut corral = [(way, 1.0); MOST];
    let mut count = 1;
    for _ in 0..MOVES {
        let least = |seen: &[(usize, usize)], sign: f64| {
            let along = |seen: &&(usize, usize)| sign * way.dot(&at(seen));
            seen.iter().min_by(|a, b| along(a).total_cmp(&along(b))).copied()
        };
        let pair = [least(from, -1.0)?, least(to, 1.0)?];
        let next = at(&pair[1]) - at(&pair[0]);
        if way.norm_squared() - way.dot(&next) <= NEAREST * way.norm_squared() || count > D {
            break;
        }
        (corral[count], pairs[count]) = ((next, 0.0), pair);
        count += 1;
        // Until the nearest point of the plane through the corral has shares of all in it.
        loop {
            let (base, others) = (corral[0].0, &corral[1..count]);
            let mut columns = SMatrix::<f64, D, D>::zeros();
            others.iter().enumerate().for_each(|(k, (point, _))| columns.set_column(k, &(point - base)));
            let mut gram = columns.transpose() * columns;
            // Points on a line have no shares of their own: the least ones are as good.
            let least = LEAST * gram.trace();
            (0..D).for_each(|k| gram[(k, k)] += if k < others.len() { least } else { 1.0 });
            let shares = gram.cholesky()?.solve(&-(columns.transpose() * base));
            let wanted = |k: usize| if k == 0 { 1.0 - shares.sum() } else { shares[k - 1] };
            let reach = |k: usize| if wanted(k) < 0.0 { corral[k].1 / (corral[k].1 - wanted(k)) } else { 1.0 };
            let (step, out) = (0..count).map(|k| (reach(k), k)).fold((1.0, MOST), |a, b| if b.0 < a.0 { b } else { a });
            let moved: [f64; MOST] =
                from_fn(|k| if k < count { corral[k].1 + step * (wanted(k) - corral[k].1) } else { 0.0 });
            corral.iter_mut().zip(moved).for_each(|((_, share), moved)| *share = moved);
            if out == MOST {
                break;
            }
            count -= 1;
            corral.swap(out, count);
            pairs.swap(out, count);
        }
        let shorter = corral[..count].iter().fold(SVector::zeros(), |sum, (point, share)| sum + point * *share);
        if shorter.norm_squared() >= way.norm_squared() {
            break;
        }
        way = shorter;
    }
    // Hulls that overlap leave nothing but rounding.
    (way.norm_squared() > NEAREST * begun).then_some(Way { way, pairs, count })
}

/// `visit(place in the list, gradient of the function (1/m))` for every listed node that a particle at `x` (m) sees.
fn for_each_seen<const D: usize, const S: usize, B: Basis<S>>(
    lattice: &Lattice<D, S, B>,
    places: &[u32],
    x: &[f64; D],
    half_size: &[f64; D],
    mut visit: impl FnMut(usize, SVector<f64, D>),
) {
    let stencil = lattice.stencil(x, half_size);
    let (lines, rows) = Stencil::<D, S>::OUTER;
    for r in 0..lines * rows {
        let (row, last) = (stencil.row(r / rows, r % rows), stencil.last());
        for k in (0..S).filter(|k| row.w * last.w[*k] > 0.0) {
            if let Some(place) = places[row.node + k].checked_sub(1) {
                let along: [f64; D] = from_fn(|a| row.gradient[a] * if a + 1 == D { last.dw[k] } else { last.w[k] });
                visit(place as usize, SVector::from(along));
            }
        }
    }
}
