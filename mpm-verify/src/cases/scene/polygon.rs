//! Polygons of many corners: their sides by rows, of which a point asks one.

/// A place in the plane (m).
type Point = [f64; 2];

/// Entries of all rows over the number of sides, about.
const ENTRIES: f64 = 8.0;

/// A polygon without crossings.
pub(super) struct Polygon {
    corners: Vec<Point>,
    /// A point this near to a side is inside (m).
    margin: f64,
    /// Where the first row begins, and the height of each (m).
    lowest: f64,
    height: f64,
    /// Sides that reach into each row, by their second corners.
    rows: Vec<Vec<usize>>,
}

impl Polygon {
    pub(super) fn new(corners: Vec<Point>, margin: f64) -> Self {
        let sides: Vec<[f64; 2]> = sides(&corners).map(|side| span(side, 1)).collect();
        let lowest = sides.iter().map(|[lo, _]| *lo).fold(f64::INFINITY, f64::min);
        let highest = sides.iter().map(|[_, hi]| *hi).fold(f64::NEG_INFINITY, f64::max);
        let spanned: f64 = sides.iter().map(|[lo, hi]| hi - lo).sum();
        let count = ((ENTRIES * sides.len() as f64 * (highest - lowest) / spanned) as usize).clamp(1, 1_000_000);
        let height = (highest - lowest) / count as f64;
        let mut polygon = Self { corners, margin, lowest, height, rows: vec![Vec::new(); count] };
        for (side, [lo, hi]) in sides.into_iter().enumerate() {
            for row in polygon.row(lo - margin)..=polygon.row(hi + margin) {
                polygon.rows[row].push(side);
            }
        }
        polygon
    }

    /// The row of a height, or the one next to it.
    fn row(&self, y: f64) -> usize {
        (((y - self.lowest) / self.height).max(0.0) as usize).min(self.rows.len() - 1)
    }

    /// Whether a point is inside: on a side, or to the left of an odd number of sides.
    pub(super) fn holds(&self, [x, y]: Point) -> bool {
        let mut inside = false;
        for k in &self.rows[self.row(y)] {
            let (a, b) = (self.corners[(k + self.corners.len() - 1) % self.corners.len()], self.corners[*k]);
            let (along, off) = ([b[0] - a[0], b[1] - a[1]], [x - a[0], y - a[1]]);
            let length = along[0].hypot(along[1]);
            let (ahead, beside) =
                ((off[0] * along[0] + off[1] * along[1]) / length, (off[0] * along[1] - off[1] * along[0]) / length);
            if beside.abs() <= self.margin && (-self.margin..=length + self.margin).contains(&ahead) {
                return true;
            }
            if (a[1] > y) != (b[1] > y) && x < a[0] + along[0] * (y - a[1]) / along[1] {
                inside = !inside;
            }
        }
        inside
    }
}

/// The sides of a polygon, the first of which ends in its first corner.
fn sides(corners: &[Point]) -> impl Iterator<Item = [Point; 2]> {
    let before = corners.iter().cycle().skip(corners.len().saturating_sub(1));
    before.zip(corners).map(|(a, b)| [*a, *b])
}

/// The lower and the upper end of a side along an axis (m).
fn span([a, b]: [Point; 2], axis: usize) -> [f64; 2] {
    [a[axis].min(b[axis]), a[axis].max(b[axis])]
}

/// Two sides of a polygon, by their first corners, that cross each other: those with the first corners.
pub(super) fn crossing(corners: &[Point]) -> Option<[usize; 2]> {
    let count = corners.len();
    let side = |k: usize| [corners[k], corners[(k + 1) % count]];
    // On which side of a line from a to b a point lies.
    let turn = |[a, b]: [Point; 2], c: Point| {
        let (along, off) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
        along[0] * off[1] - along[1] * off[0]
    };
    let parts = |line, [a, b]: [Point; 2]| turn(line, a) * turn(line, b) < 0.0;
    // Along the axis that the sides cover the least: few others begin before one of them ends.
    let covered = |axis: usize| {
        let spans = || (0..count).map(|k| span(side(k), axis));
        let ends = spans().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], [lo, hi]| [l.min(lo), h.max(hi)]);
        spans().map(|[lo, hi]| hi - lo).sum::<f64>() / (ends[1] - ends[0])
    };
    let axis = usize::from(covered(1) < covered(0));
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|j, k| span(side(*j), axis)[0].total_cmp(&span(side(*k), axis)[0]));
    let pairs = order.iter().enumerate().flat_map(|(place, k)| {
        let end = span(side(*k), axis)[1];
        let beside = order[place + 1..].iter().take_while(move |m| span(side(**m), axis)[0] <= end);
        beside.map(|m| [*k.min(m), *k.max(m)])
    });
    pairs.filter(|[k, m]| parts(side(*k), side(*m)) && parts(side(*m), side(*k))).min()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A star of `count` teeth between two radii.
    fn star(count: usize, [least, most]: [f64; 2]) -> Vec<Point> {
        let corner = |k: usize| {
            let (angle, radius) =
                (std::f64::consts::PI * k as f64 / count as f64, if k.is_multiple_of(2) { most } else { least });
            [radius * angle.cos(), radius * angle.sin()]
        };
        (0..2 * count).map(corner).collect()
    }

    #[test]
    fn a_polygon_of_a_hundred_thousand_corners_holds_what_is_inside_and_is_ready_soon() {
        let begun = std::time::Instant::now();
        let corners = star(50_000, [0.999, 1.001]);
        assert_eq!(crossing(&corners), None);
        let polygon = Polygon::new(corners.clone(), 1e-9);
        let mut held = 0;
        for (i, j) in (0..1000).flat_map(|i| (0..1000).map(move |j| (i, j))) {
            let [x, y] = [i, j].map(|k| (f64::from(k) + 0.5) / 500.0 - 1.0);
            let holds = polygon.holds([x, y]);
            held += u32::from(holds);
            let radius = x.hypot(y);
            assert!(holds == (radius < 1.0) || (0.998..1.002).contains(&radius), "{x} {y}");
        }
        assert!((f64::from(held) / 250_000.0 - std::f64::consts::PI).abs() < 0.01, "{held}");
        // On a side and in a corner.
        let middle = [0, 1].map(|a| 0.5 * (corners[0][a] + corners[1][a]));
        assert!(polygon.holds(middle) && polygon.holds(corners[7]));
        // Every point against every side would take minutes.
        assert!(begun.elapsed().as_secs_f64() < 10.0, "{:?}", begun.elapsed());
    }

    #[test]
    fn a_polygon_without_a_height_and_one_of_any_height_have_rows() {
        for y in [0.0, 1e308] {
            let polygon = Polygon::new(vec![[0.0, y], [1.0, y], [2.0, -y]], 1e-9);
            assert!(!polygon.rows.is_empty() && polygon.holds([0.0, y]));
        }
    }

    #[test]
    fn the_first_sides_that_cross_are_found() {
        let mut corners = star(1000, [0.9, 1.1]);
        corners.swap(10, 400);
        assert_eq!(crossing(&corners).map(|[first, _]| first), Some(9));
        assert_eq!(crossing(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]), Some([0, 2]));
    }
}
