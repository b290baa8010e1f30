//! Surfaces of rigid bodies: polygons in the plane and triangle meshes in space, by the closest points of `parry3d`.

use mpm_core::Error;
use mpm_core::contact::{Gap, Surface};
use nalgebra::{SMatrix, SVector};
use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQueryWithLocation;
use parry3d_f64::shape::{TopologyError, TriMesh, TriMeshFlags, TrianglePointLocation};
use std::collections::HashSet;

/// A triangle with less than this share of the square over its longest side has no area.
const FLAT: f64 = 1e-7;
/// Sine of an angle between a normal and the way to an edge that is rounding: the edge's facets lie in one plane there.
const ROUNDING: f64 = 1e-9;

const FACET: &str = "facet of a mesh, counted from 0,";

/// A surface of facets, segments in the plane and triangles in space. Its normal is that of the nearest facet, and turns
/// about corners and edges that stand out.
#[derive(Debug, Clone)]
pub struct Mesh<const D: usize> {
    /// The triangles; in the plane, those of a strip along z on both sides of it for every segment.
    triangles: TriMesh,
    /// Whether a corner of the triangles is at the surface's rim.
    rim: Vec<bool>,
}

impl<const D: usize> Mesh<D> {
    /// The surface of facets with these corners (m), which meet where they have corners in common. The body's outside is
    /// on the left of a segment from its first corner to its second, and where a triangle's corners turn
    /// counter-clockwise.
    ///
    /// # Errors
    /// No facets; corners that are not finite; a facet without an area; more than two at an edge, or two with their
    /// outsides on different sides.
    pub fn new(facets: &[[[f64; D]; D]]) -> Result<Self, Error> {
        let bad = |what, value, allowed| Err(Error::Input { what, value, allowed });
        if !(2..=3).contains(&D) {
            return bad("axes of a mesh", D as f64, "2 or 3");
        }
        if let Some(x) = facets.as_flattened().as_flattened().iter().find(|x| !x.is_finite()) {
            return bad("corner of a mesh", *x, "finite (m)");
        }
        let mut triangles = Vec::new();
        let longest = facets.iter().map(|facet| side(facet, 0).length()).fold(0.0, f64::max);
        for (k, facet) in facets.iter().enumerate() {
            // Zero has one sign, so that equal corners are found.
            let corner = |k: usize, z: f64| point(&facet[k]) + Vector::new(0.0, 0.0, z);
            let sides = (0..D).map(|k| side(facet, k).length()).fold(0.0, f64::max);
            let area = if D == 2 { sides * sides } else { side(facet, 0).cross(side(facet, 1)).length() };
            if area <= FLAT * sides * sides {
                return bad(FACET, k as f64, "one with an area");
            }
            if D == 2 {
                let [a, b, up, beside] =
                    [(0, -longest), (1, -longest), (0, longest), (1, longest)].map(|(k, z)| corner(k, z));
                triangles.extend([[a, up, b], [b, up, beside]]);
            } else {
                triangles.push([corner(0, 0.0), corner(1, 0.0), corner(2, 0.0)]);
            }
        }
        let indices = (0..triangles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        let Ok(mut mesh) = TriMesh::new(triangles.as_flattened().to_vec(), indices) else {
            return bad("facets of a mesh", 0.0, "1 or more");
        };
        let flags = TriMeshFlags::MERGE_DUPLICATE_VERTICES | TriMeshFlags::HALF_EDGE_TOPOLOGY | TriMeshFlags::ORIENTED;
        let unlike = "one with at most one other at an edge, which has its outside on the same side";
        let number = |triangle: u32| f64::from(triangle / (4 - D as u32));
        match mesh.set_flags(flags) {
            Ok(()) => {}
            Err(TopologyError::BadTriangle(at)) => return bad(FACET, number(at), "one with an area"),
            Err(TopologyError::BadAdjacentTrianglesOrientation { triangle2, .. }) => {
                return bad(FACET, number(triangle2), unlike);
            }
        }
        let mut known = HashSet::new();
        for (at, mut corners) in (0..).zip(mesh.indices().iter().copied()) {
            corners.sort_unstable();
            if !known.insert(corners) {
                return bad(FACET, number(at), unlike);
            }
        }
        let mut rim = vec![false; mesh.vertices().len()];
        for edge in mesh.topology().iter().flat_map(|all| &all.half_edges).filter(|edge| edge.twin == u32::MAX) {
            let [from, to] = [edge.vertex, mesh.topology().map_or(0, |all| all.half_edges[edge.next as usize].vertex)];
            (rim[from as usize], rim[to as usize]) = (true, true);
        }
        Ok(Self { triangles: mesh, rim })
    }

    /// Whether a part of a triangle, an edge or a corner, is at the rim.
    fn ends_at(&self, triangle: u32, location: &TrianglePointLocation) -> bool {
        match location {
            TrianglePointLocation::OnVertex(k) => {
                self.rim[self.triangles.indices()[triangle as usize][*k as usize] as usize]
            }
            TrianglePointLocation::OnEdge(k, _) => self.triangles.topology().is_some_and(|all| {
                let first = all.faces[triangle as usize].half_edge;
                all.half_edges[(first + k) as usize].twin == u32::MAX
            }),
            TrianglePointLocation::OnFace(..) | TrianglePointLocation::OnSolid => false,
        }
    }
}

impl<const D: usize> Surface<D> for Mesh<D> {
    fn gap(&self, x: &[f64; D], within: f64) -> Option<Gap<D>> {
        let x = point(x);
        let within = within.next_up().min(f64::MAX);
        let (nearest, (triangle, location)) =
            self.triangles.project_local_point_and_get_location_with_max_dist(x, false, within)?;
        let facet = self.triangles.triangle(triangle);
        let (off, face) = (x - nearest.point, facet.scaled_normal().normalize());
        let before = off.cross(face).length() <= ROUNDING * off.length();
        if before || matches!(location, TrianglePointLocation::OnFace(..)) {
            return Some(Gap { size: face.dot(x - facet.a), normal: vector(face), bend: SMatrix::zeros() });
        }
        if self.ends_at(triangle, &location) {
            return None;
        }
        let size = if nearest.is_inside { -off.length() } else { off.length() };
        let normal: SVector<f64, D> = vector(off / size);
        let mut across = SMatrix::<f64, D, D>::identity() - normal * normal.transpose();
        if let (TrianglePointLocation::OnEdge(k, _), 3) = (location, D) {
            let ends = [facet.a, facet.b, facet.c, facet.a];
            let along: SVector<f64, D> = vector((ends[k as usize + 1] - ends[k as usize]).normalize());
            across -= along * along.transpose();
        }
        Some(Gap { size, normal, bend: across / size })
    }

    fn is_near(&self, x: &[f64; D], distance: f64) -> bool {
        let within = distance.next_up().min(f64::MAX);
        self.triangles.project_local_point_and_get_location_with_max_dist(point(x), false, within).is_some()
    }

    fn crosses(&self, axis: usize) -> bool {
        self.triangles.triangles().any(|triangle| triangle.scaled_normal()[axis] != 0.0)
    }
}

/// Triangles of an STL file, binary or text: their corners (m).
///
/// # Errors
/// A file that is cut, or of another format.
pub fn triangles(stl: &[u8]) -> std::io::Result<Vec<[[f64; 3]; 3]>> {
    let mut bytes = stl.to_vec();
    // One in binary may begin as one in text does, and has as many bytes as its triangles need.
    let count = bytes.get(80..84).and_then(|count| count.try_into().ok()).map_or(0, u32::from_le_bytes);
    if bytes.len() == 84 + 50 * count as usize {
        bytes[0] = 0;
    }
    let mut file = std::io::Cursor::new(&bytes);
    let all: Result<Vec<stl_io::Triangle>, _> = stl_io::create_stl_reader(&mut file)?.collect();
    Ok(all?.iter().map(|triangle| triangle.vertices.map(|x| x.0.map(f64::from))).collect())
}

/// A place in space; one in the plane is where z is zero.
fn point<const D: usize>(x: &[f64; D]) -> Vector {
    let at = |a: usize| x.get(a).copied().unwrap_or(0.0) + 0.0;
    Vector::new(at(0), at(1), at(2))
}

/// A side of a facet, from a corner to the next.
fn side<const D: usize>(facet: &[[f64; D]; D], k: usize) -> Vector {
    point(&facet[(k + 1) % D]) - point(&facet[k])
}

fn vector<const D: usize>(v: Vector) -> SVector<f64, D> {
    SVector::from_fn(|a, _| v[a])
}
