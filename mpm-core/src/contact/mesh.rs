//! Surfaces of facets: segments in the plane, triangles in space.

use crate::error::{Error, require};
use crate::frame::Frame;
use nalgebra::{SMatrix, SVector};
use std::collections::HashMap;

/// The surface of a rigid body as a place sees it, from the point that is nearest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap<const D: usize> {
    /// Distance (m), negative inside the body.
    pub size: f64,
    /// Outward unit normal.
    pub normal: SVector<f64, D>,
    /// Slope of the normal over the place (1/m): zero before a facet.
    pub bend: SMatrix<f64, D, D>,
}

/// A surface of facets. Its normal is that of the nearest facet, and turns about corners and edges that stand out.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh<const D: usize> {
    /// A tree: the middle one of any range is its root, and has the box about all of it.
    facets: Vec<Facet<D>>,
}

/// Corners of a part of a facet, a bit each.
type Part = usize;
/// Parts of a triangle, and none.
const PARTS: usize = 8;
/// A triangle with less than this share of the square over its longest side has no area.
const FLAT: f64 = 1e-7;
/// Share of a side by which a point is beyond a facet and not, by rounding, on its edge.
const BEYOND: f64 = 1e-12;

const FACET: &str = "facet of a mesh, counted from 0,";

#[derive(Debug, Clone, PartialEq)]
struct Facet<const D: usize> {
    corners: [SVector<f64, D>; D],
    /// Normals by [`Part`], of any length where facets meet; none at the surface's rim.
    normals: [Option<SVector<f64, D>>; PARTS],
    ends: [SVector<f64, D>; 2],
}

/// The nearest point: square of its distance (m²), itself, and the facet's part inside which it lies.
type Nearest<'a, const D: usize> = (f64, SVector<f64, D>, &'a Facet<D>, Part);

impl<const D: usize> Mesh<D> {
    /// The surface of facets with these corners (m), which meet where they have corners in common. The body's outside is
    /// on the left of a segment from its first corner to its second, and where a triangle's corners turn
    /// counter-clockwise.
    ///
    /// # Errors
    /// No facets; corners that are not finite; a facet without an area; more than two at an edge, or two with their
    /// outsides on different sides.
    pub fn new(facets: &[[[f64; D]; D]]) -> Result<Self, Error> {
        require(D > 1, "axes of a mesh", D as f64, "2 or 3")?;
        require(!facets.is_empty(), "facets of a mesh", 0.0, "1 or more")?;
        // Zero has one sign in a key.
        let key = |x: &SVector<f64, D>| x.map(|x| (x + 0.0).to_bits());
        let (mut numbers, mut sums, mut rims) = (HashMap::new(), HashMap::new(), HashMap::new());
        let mut made = Vec::with_capacity(facets.len());
        for (k, given) in facets.iter().enumerate() {
            let corners = given.map(SVector::<f64, D>::from);
            for x in given.as_flattened() {
                require(true, "corner of a mesh", *x, "finite (m)")?;
            }
            let sides: [f64; D] = std::array::from_fn(|k| (corners[(k + 1) % D] - corners[k]).norm());
            let normal = across(&corners);
            let least = FLAT * sides.iter().fold(0.0, |most: f64, side| most.max(*side)).powi(D as i32 - 1);
            require(normal.norm() > least, FACET, k as f64, "one with an area")?;
            let corner = corners.map(|x| {
                let count = numbers.len();
                *numbers.entry(key(&x)).or_insert(count)
            });
            for (part, name) in (1..1 << D).map(|part| (part, name(&corner, part))) {
                let unlike = "one with at most one other at an edge, which has its outside on the same side";
                let own = part.count_ones() as usize != D || !sums.contains_key(&name);
                require(own, FACET, k as f64, unlike)?;
                *sums.entry(name).or_insert_with(SVector::zeros) += normal.normalize() * angle(&corners, part);
                // An edge that both its facets run through in one direction has their outsides on different sides.
                if part.count_ones() as usize == D - 1 {
                    let omitted = part.trailing_ones() as usize;
                    let turns = omitted % 2 == 1;
                    let ordered = D == 2 || (0..D).filter(|k| *k != omitted).is_sorted_by_key(|k| corner[k]);
                    let met: &mut Vec<bool> = rims.entry(name).or_default();
                    met.push(turns == ordered);
                    let fits = met.len() == 1 || met.len() == 2 && met[0] != met[1];
                    require(fits, FACET, k as f64, unlike)?;
                }
            }
            made.push((corners, corner));
        }
        // Corners of an edge at the rim are there, too.
        let mut at_rim: Vec<[usize; 3]> =
            rims.into_iter().filter(|(_, met)| met.len() == 1).map(|(name, _)| name).collect();
        at_rim.extend(at_rim.clone().into_iter().flatten().map(|corner| [corner, usize::MAX, usize::MAX]));
        at_rim.sort_unstable();
        let facet = |(corners, corner): ([SVector<f64, D>; D], [usize; D])| {
            let normals = std::array::from_fn(|part| {
                let name = name(&corner, part);
                sums.get(&name).copied().filter(|_| part > 0 && at_rim.binary_search(&name).is_err())
            });
            Facet { corners, normals, ends: [corners[0]; 2] }
        };
        let mut facets: Vec<Facet<D>> = made.into_iter().map(facet).collect();
        arrange(&mut facets);
        Ok(Self { facets })
    }

    /// The same surface seen from `frame`.
    #[must_use]
    pub fn seen_from(&self, frame: &Frame<D>) -> Self {
        let place = |x: &SVector<f64, D>| SVector::from(frame.place(&(*x).into()));
        let facet = |facet: &Facet<D>| Facet {
            corners: facet.corners.map(|x| place(&x)),
            normals: facet.normals.map(|n| n.map(|n| frame.vector(&n.into(), 1.0).into())),
            ends: facet.ends.map(|x| place(&x)),
        };
        let mut facets: Vec<Facet<D>> = self.facets.iter().map(facet).collect();
        arrange(&mut facets);
        Self { facets }
    }

    /// Whether a facet's normal has a part along `axis`.
    pub fn crosses(&self, axis: usize) -> bool {
        self.facets.iter().any(|facet| across(&facet.corners)[axis] != 0.0)
    }

    /// Whether a facet is within `distance` (m) of `x` (m).
    pub fn is_near(&self, x: &[f64; D], distance: f64) -> bool {
        self.nearest(x, distance).is_some()
    }

    /// What lies at `x` (m) sees of the surface; none beyond `within` (m), and beside the surface, where a part of its rim
    /// is nearest.
    pub fn gap(&self, x: &[f64; D], within: f64) -> Option<Gap<D>> {
        let (_, point, facet, part) = self.nearest(x, within)?;
        let outward = facet.normals[part]?;
        let x = SVector::from(*x);
        if part == (1 << D) - 1 {
            let size = outward.dot(&(x - facet.corners[0]));
            return Some(Gap { size, normal: outward, bend: SMatrix::zeros() });
        }
        let (off, sign) = (x - point, outward.dot(&(x - point)).signum());
        let size = sign * off.norm();
        if size == 0.0 {
            return Some(Gap { size, normal: outward.normalize(), bend: SMatrix::zeros() });
        }
        let normal = off / size;
        let mut across = SMatrix::identity() - normal * normal.transpose();
        if part.count_ones() == 2 {
            let [from, to] = [part.trailing_zeros(), part.ilog2()].map(|k| facet.corners[k as usize]);
            let along = (to - from).normalize();
            across -= along * along.transpose();
        }
        Some(Gap { size, normal, bend: across / size })
    }

    fn nearest(&self, x: &[f64; D], within: f64) -> Option<Nearest<'_, D>> {
        let mut found = None;
        search(&self.facets, &SVector::from(*x), &mut (within * within), &mut found);
        found
    }
}

/// Finds the nearest point of facets within a distance whose square is `most` (m²).
fn search<'a, const D: usize>(
    facets: &'a [Facet<D>],
    x: &SVector<f64, D>,
    most: &mut f64,
    found: &mut Option<Nearest<'a, D>>,
) {
    let Some(root) = facets.get(facets.len() / 2).filter(|root| root.apart(x) <= *most) else { return };
    let (square, point, part) = root.nearest(x, (1 << D) - 1);
    if square <= *most {
        *most = square;
        *found = Some((square, point, root, part));
    }
    let halves = [&facets[..facets.len() / 2], &facets[facets.len() / 2 + 1..]];
    let [first, second] = halves.map(|half| half.get(half.len() / 2).map_or(0.0, |root| root.apart(x)));
    let order = if first <= second { [0, 1] } else { [1, 0] };
    order.into_iter().for_each(|half| search(halves[half], x, most, found));
}

impl<const D: usize> Facet<D> {
    /// Square of the distance (m²) of a place from the box.
    fn apart(&self, x: &SVector<f64, D>) -> f64 {
        (x - x.sup(&self.ends[0]).inf(&self.ends[1])).norm_squared()
    }

    /// The nearest point of a part: square of its distance (m²), itself, and the part inside which it lies.
    fn nearest(&self, x: &SVector<f64, D>, part: Part) -> (f64, SVector<f64, D>, Part) {
        let mut own = (0..D).filter(|k| part >> k & 1 == 1);
        let first = own.next().unwrap_or(0);
        let sides =
            [own.next(), own.next()].map(|k| k.map_or_else(SVector::zeros, |k| self.corners[k] - self.corners[first]));
        let off = x - self.corners[first];
        let [a, b, c] = [sides[0].dot(&sides[0]), sides[0].dot(&sides[1]), sides[1].dot(&sides[1])];
        let [p, q] = sides.map(|side| side.dot(&off));
        let shares = match part.count_ones() {
            1 => [0.0; 2],
            2 => [p / a, 0.0],
            _ => [(c * p - b * q) / (a * c - b * b), (a * q - b * p) / (a * c - b * b)],
        };
        let weights = [1.0 - shares[0] - shares[1], shares[0], shares[1]];
        let corners = (0..D).filter(|k| part >> k & 1 == 1);
        let beyond = corners.zip(weights).filter(|(_, weight)| *weight < -BEYOND);
        let edges = beyond.map(|(k, _)| self.nearest(x, part & !(1 << k)));
        edges.min_by(|one, other| one.0.total_cmp(&other.0)).unwrap_or_else(|| {
            let point = self.corners[first] + sides[0] * shares[0] + sides[1] * shares[1];
            ((x - point).norm_squared(), point, part)
        })
    }
}

/// Makes facets a tree.
fn arrange<const D: usize>(facets: &mut [Facet<D>]) {
    let corners = facets.iter().flat_map(|facet| facet.corners);
    let ends = corners
        .fold(None, |ends, x| Some(ends.map_or([x; 2], |[lo, hi]: [SVector<f64, D>; 2]| [lo.inf(&x), hi.sup(&x)])));
    let Some(ends) = ends else { return };
    let (axis, middle) = ((ends[1] - ends[0]).imax(), facets.len() / 2);
    let place = |facet: &Facet<D>| facet.corners.iter().map(|x| x[axis]).sum::<f64>();
    facets.select_nth_unstable_by(middle, |a, b| place(a).total_cmp(&place(b)));
    facets[middle].ends = ends;
    let (before, behind) = facets.split_at_mut(middle);
    arrange(before);
    arrange(&mut behind[1..]);
}

/// A normal of a facet, as long as its area, or twice that of a triangle.
fn across<const D: usize>(corners: &[SVector<f64, D>; D]) -> SVector<f64, D> {
    let [u, v] = [1, D - 1].map(|k| corners[k] - corners[0]);
    SVector::from_fn(|a, _| match D {
        2 => [-u[1], u[0]][a],
        _ => u[(a + 1) % D] * v[(a + 2) % D] - u[(a + 2) % D] * v[(a + 1) % D],
    })
}

/// The angle of a triangle at a corner, and one for other parts.
fn angle<const D: usize>(corners: &[SVector<f64, D>; D], part: Part) -> f64 {
    let k = part.trailing_zeros() as usize;
    let sides = [1, 2].map(|on| corners[(k + on) % D] - corners[k]);
    if D == 3 && part.is_power_of_two() { sides[0].angle(&sides[1]) } else { 1.0 }
}

/// Numbers of the corners of a part, in their order.
fn name<const D: usize>(corner: &[usize; D], part: Part) -> [usize; 3] {
    let mut name: [usize; 3] = std::array::from_fn(|k| if part >> k & 1 == 1 { corner[k] } else { usize::MAX });
    name.sort_unstable();
    name
}
