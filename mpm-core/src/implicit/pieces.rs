//! A basis as polynomials on the intervals of an axis: what penalties are made of.

use crate::basis::{AxisWeights, BSpline, Basis, Gimp, WallTreatment};
use crate::grid::Axis;

/// Most functions on an interval.
const MOST: usize = 4;

/// One axis' functions, interval by interval.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisPieces {
    /// Degree k of the polynomials.
    pub degree: usize,
    /// Intervals before the lower end of the axis, beyond which there are as many after its upper one.
    pub beyond: usize,
    /// Whether the last interval is beside the first.
    pub periodic: bool,
    /// Whether walls stand at the ends.
    pub walls: (bool, bool),
    /// k-th derivatives (1/mᵏ) of the k + 1 functions of every interval, whose first function has its index.
    pub top: Vec<[f64; MOST]>,
    /// ∫ w w′ dx (m) of every interval.
    pub mass: Vec<[[f64; MOST]; MOST]>,
}

impl AxisPieces {
    /// Pieces of the spline of degree `S` − 1 on an axis with `beyond` more intervals at either end than `walls` stand
    /// at.
    fn new<const S: usize>(axis: &Axis, h: f64, beyond: usize, walls: (bool, bool)) -> Self {
        let spline = BSpline::<S>::new(axis, h, WallTreatment::OpenKnot);
        let degree = S - 1;
        let mut pieces =
            Self { degree, beyond, periodic: axis.is_periodic(), walls, top: Vec::new(), mass: Vec::new() };
        for interval in 0..axis.cells {
            let at = |t: f64| spline.weights(axis.lo + (interval as f64 + t) * h, 0.0).w;
            let mut mass = [[0.0; MOST]; MOST];
            for (t, weight) in gauss(S) {
                let w = at(t);
                for (row, a) in mass.iter_mut().zip(w) {
                    for (m, b) in row.iter_mut().zip(w) {
                        *m += h * weight * a * b;
                    }
                }
            }
            pieces.mass.push(mass);
            // The k-th difference of a polynomial of degree k, over the k-th power of the distance, is its derivative.
            let mut top = [0.0; MOST];
            let distance = 1.0 / (degree as f64 + 1.0);
            for j in 0..=degree {
                let w = at((j as f64 + 0.5) * distance);
                let sign = if (degree - j).is_multiple_of(2) { 1.0 } else { -1.0 };
                for (top, w) in top.iter_mut().zip(w) {
                    *top += sign * binomial(degree, j) * w / (distance * h).powi(degree as i32);
                }
            }
            pieces.top.push(top);
        }
        pieces
    }
}

fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |b, i| b * (n - i) as f64 / (i + 1) as f64)
}

/// Points of (0, 1) and weights of Gauss' rule with two to four points.
pub(super) fn gauss(points: usize) -> impl Iterator<Item = (f64, f64)> {
    let rule: &[(f64, f64)] = match points {
        0..=2 => &[(0.577_350_269_189_625_8, 1.0)],
        3 => &[(0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)],
        _ => &[(0.339_981_043_584_856_3, 0.652_145_154_862_546_1), (0.861_136_311_594_052_6, 0.347_854_845_137_453_9)],
    };
    let mirrored = rule.iter().filter(|(x, _)| *x > 0.0).map(|(x, w)| (-x, *w));
    let all = mirrored.chain(rule.iter().copied());
    all.map(|(x, w)| (0.5 + 0.5 * x, 0.5 * w))
}

/// A basis that penalties can be made for.
pub trait Pieces<const S: usize>: Basis<S> {
    /// Whether the functions depend on the place alone, and not on the size of the particle.
    const POINTWISE: bool;

    /// Its pieces on an axis with cells of size `h` (m).
    fn pieces(axis: &Axis, h: f64) -> AxisPieces;

    /// How many intervals, from that of the index of the first function, a particle with these weights touches.
    fn touched(weights: &AxisWeights<S>) -> usize;
}

impl<const S: usize> Pieces<S> for BSpline<S> {
    const POINTWISE: bool = true;

    fn pieces(axis: &Axis, h: f64) -> AxisPieces {
        AxisPieces::new::<S>(axis, h, 0, axis.wall_ends())
    }

    fn touched(_weights: &AxisWeights<S>) -> usize {
        1
    }
}

/// Means of hats, whose jumps are theirs; domains reach over the ends of the axis.
impl Pieces<3> for Gimp {
    const POINTWISE: bool = false;

    fn pieces(axis: &Axis, h: f64) -> AxisPieces {
        let wide = Axis::open(axis.lo - h, axis.cells + 2);
        AxisPieces::new::<2>(&wide, h, 1, axis.wall_ends())
    }

    fn touched(weights: &AxisWeights<3>) -> usize {
        if weights.dw[2] == 0.0 { 1 } else { 2 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Functions sum to one and their k-th derivatives to zero; the k-th derivative of Σ w_i g_i, which for Greville
    /// abscissae g is x, is one of a hat and zero of others.
    #[test]
    fn masses_and_derivatives_are_those_of_a_partition_of_unity() {
        let axis = Axis::walls(-1.0, 6);
        let of = [
            <BSpline<2> as Pieces<2>>::pieces(&axis, 0.5),
            <BSpline<3> as Pieces<3>>::pieces(&axis, 0.5),
            <BSpline<4> as Pieces<4>>::pieces(&axis, 0.5),
            Gimp::pieces(&axis, 0.5),
        ];
        for pieces in of {
            for (mass, top) in pieces.mass.iter().zip(&pieces.top) {
                let sum: f64 = mass.iter().flatten().sum();
                assert!((sum - 0.5).abs() < 1e-14);
                assert!(top.iter().sum::<f64>().abs() < 1e-10);
            }
            let middle = pieces.top[3];
            let h = 0.5_f64.powi(pieces.degree as i32);
            for (j, top) in middle.iter().take(pieces.degree + 1).enumerate() {
                let sign = if (pieces.degree - j).is_multiple_of(2) { 1.0 } else { -1.0 };
                assert!((top * h - sign * binomial(pieces.degree, j)).abs() < 1e-12);
            }
        }
    }
}
