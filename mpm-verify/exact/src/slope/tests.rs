use super::*;

fn slope(degrees: f64, depth_factor: f64) -> Slope {
    Slope::new(1.0, degrees.to_radians(), depth_factor).unwrap()
}

fn number(degrees: f64, depth_factor: f64) -> f64 {
    slope(degrees, depth_factor).stability_number()
}

fn near(found: f64, expected: f64, tolerance: f64) {
    let difference = (found - expected).abs();
    assert!(difference <= tolerance, "{found}, expected {expected}");
}

/// Angles and depth factors with critical circles of every kind.
const SLOPES: [(f64, f64); 14] = [
    (90.0, 1.0),
    (53.0, 4.0),
    (30.0, 100.0),
    (75.0, 1.0),
    (60.0, 1.0),
    (60.0, 3.0),
    (45.0, 1.0),
    (45.0, 1.2),
    (45.0, 1.5),
    (30.0, 1.0),
    (30.0, 1.2),
    (15.0, 1.0),
    (15.0, 3.0),
    (5.0, 1.5),
];

/// Taylor (1948), table 16.1: c/γH with three digits; his search by hand is good to one in the last.
#[test]
fn taylors_table_is_met() {
    for (degrees, expected) in [(90.0, 0.261), (75.0, 0.219), (60.0, 0.191), (53.0, 0.181)] {
        near(1.0 / number(degrees, 100.0), expected, 1e-3);
    }
    for degrees in [45.0, 30.0, 22.5, 15.0, 7.5] {
        near(1.0 / number(degrees, 100.0), 0.181, 5e-4);
    }
}

/// The same table for the best circle through the toe of a deep soil, in which a circle off the toe is more
/// dangerous: c/γH and the depth factor that the circle touches.
#[test]
fn taylors_toe_circles_are_met() {
    for (degrees, expected, depth_factor) in [(45.0, 0.170, 1.062), (30.0, 0.156, 1.301), (15.0, 0.145, 2.117)] {
        let toe = slope(degrees, 100.0).on_face(SEARCH);
        assert_eq!(toe.circle.exit, Vector2::zeros());
        near(1.0 / toe.number, expected, 1e-3);
        near(1.0 - toe.circle.lowest().y, depth_factor, 0.02);
    }
}

/// Read off the curves of Taylor's chart for β < 53°, to 0.003.
#[test]
fn taylors_chart_over_depth_is_met() {
    for (degrees, depth_factor, expected) in [
        (45.0, 1.0, 0.166),
        (30.0, 1.0, 0.132),
        (22.5, 1.0, 0.114),
        (15.0, 1.02, 0.090),
        (45.0, 2.0, 0.178),
        (30.0, 2.0, 0.172),
        (22.5, 2.0, 0.166),
        (15.0, 2.0, 0.150),
        (7.5, 2.0, 0.106),
        (15.0, 3.0, 0.168),
        (7.5, 3.0, 0.140),
    ] {
        near(1.0 / number(degrees, depth_factor), expected, 3e-3);
    }
}

/// Griffiths and Lane (1999), doi:10.1680/geot.1999.49.3.387: a slope of 2 to 1 over a base at D = 2 with
/// c = 0.25 γH has the factor of safety 1.47 by Taylor's chart and by finite elements.
#[test]
fn the_slope_of_griffiths_and_lane_is_as_safe_as_published() {
    let s = Slope::new(10.0, 0.5_f64.atan(), 2.0).unwrap();
    near(s.factor_of_safety(50e3, 20e3).unwrap(), 1.47, 0.01);
}

/// 45° on a firm base at the level of the toe: the circle touches the base and leaves a little above the toe.
/// The numbers are those of a random search over centres and radii with horizontal strips for the moment.
#[test]
fn the_critical_circle_of_45_degrees_is_that_of_an_independent_search() {
    let m = slope(45.0, 1.0).critical();
    near(number(45.0, 1.0), 6.077_867_020, 1e-8);
    near(m.circle.radius, 1.673_588_7, 1e-5);
    near(m.circle.centre.x, 0.261_950_3, 1e-5);
    near(m.circle.lowest().y, 0.0, 1e-9);
    near(m.circle.exit.y, 0.0179, 1e-4);
    near(m.circle.entry.x, 1.7940, 1e-4);
}

#[derive(serde::Deserialize)]
struct Bounds {
    angle: f64,
    cut: f64,
    lower: f64,
    upper: f64,
}

/// Finite-element limit analysis, from `references/slope_bounds.py`, without a circle in it.
#[test]
fn the_number_is_between_the_bounds_of_finite_elements() {
    let text = include_str!("../../../references/slope_bounds.json");
    let bounds: Vec<Bounds> = serde_json::from_str(text).unwrap();
    assert_eq!(bounds.iter().filter(|b| b.cut > 0.0).count(), 3);
    assert_eq!(bounds.len(), 6);
    for b in bounds {
        let n = slope(b.angle, 1.0).cut(b.cut).unwrap().stability_number();
        assert!(b.lower < n && n < b.upper, "{} {n} {}", b.lower, b.upper);
        near(n, b.lower, 0.02 * n);
    }
}

/// Arcs of vanishing curvature are Culmann's planes, γH/c = 4 sin β/(1 − cos β): 4 for a vertical cut.
#[test]
fn flat_arcs_are_culmanns_planes_and_circles_are_worse() {
    near(number(90.0, 1.0), 3.83, 5e-3);
    for degrees in [90.0_f64, 60.0, 45.0] {
        let (s, beta) = (slope(degrees, 1.0), degrees.to_radians());
        let (sin, cos) = (0.5 * beta).sin_cos();
        let (exit, entry) = (Vector2::zeros(), Vector2::new(cos / sin, 1.0));
        let radius = 1e5;
        let away = (radius * radius - 0.25 * (entry - exit).norm_squared()).sqrt();
        let centre = entry / 2.0 + away * Vector2::new(-sin, cos);
        let arc = Circle { centre, radius, exit, entry };
        let culmann = 4.0 * beta.sin() / (1.0 - beta.cos());
        near(s.number(&arc), culmann, 1e-3);
        assert!(s.stability_number() < culmann);
    }
}

/// A cut as high as the slope is a vertical face; none is the slope; and a deeper cut is never safer.
#[test]
fn a_cut_is_between_the_slope_and_a_vertical_face() {
    let slope = slope(45.0, 1.0);
    let cut_by = |cut: f64| slope.cut(cut).unwrap().stability_number();
    assert_eq!(cut_by(0.0), slope.stability_number());
    near(cut_by(1.0), number(90.0, 1.0), 1e-9);
    // A random search over exits, entries and angles, with horizontal strips for area and moment.
    near(cut_by(0.2), 5.537, 2e-3);
    let depths = [0.0, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0];
    assert!(depths.windows(2).all(|d| cut_by(d[1]) < cut_by(d[0])));
    for cut in [-0.1, 1.1, f64::NAN] {
        assert!(slope.cut(cut).is_err());
    }
    assert!(Slope::new(1.0, 0.5, 1.2).unwrap().cut(0.2).is_err());
}

/// Area and first moment of the mass above an arc through the foot of a cut, by horizontal strips.
#[test]
fn the_mass_over_a_cut_is_that_of_strips() {
    let slope = slope(45.0, 1.0).cut(0.2).unwrap();
    let m = slope.critical();
    assert!(m.circle.lowest().y > -1e-9 && m.circle.exit.x >= 0.2);
    let count = 200_000;
    let (mut area, mut moment) = (0.0, 0.0);
    for k in 0..count {
        let y = (f64::from(k) + 0.5) / f64::from(count);
        if y < m.circle.exit.y {
            continue;
        }
        let left = y.max(0.2);
        let right = m.circle.centre.x + (m.circle.radius.powi(2) - (y - m.circle.centre.y).powi(2)).sqrt();
        area += right - left;
        moment += 0.5 * (right * right - left * left);
    }
    let dy = 1.0 / f64::from(count);
    near(m.area, area * dy, 1e-5);
    near(m.area * m.centroid.x, moment * dy, 1e-5);
}

#[test]
fn deep_circles_tend_to_their_limit_from_above() {
    let alpha = (0..100).fold(1.2_f64, |alpha, _| (2.0 * alpha).atan());
    near(DEEP, 4.0 * alpha / alpha.sin().powi(2), 1e-14);
    for degrees in [15.0, 30.0, 50.0] {
        let [near_by, deep] = [10.0, 100.0].map(|d| slope(degrees, d).on_floor(SEARCH).number);
        assert!(DEEP < deep && deep < near_by, "{near_by} {deep}");
        near(deep, DEEP, 1e-3);
    }
}

#[test]
fn only_the_ratio_of_weight_and_strength_matters() {
    let (small, large) = (slope(45.0, 1.5), Slope::new(12.0, 45_f64.to_radians(), 1.5));
    let large = large.unwrap();
    let n = small.stability_number();
    near(large.stability_number(), n, 1e-9);
    near(large.critical().area, 144.0 * small.critical().area, 1e-3);
    near(large.factor_of_safety(30e3, 18e3).unwrap(), n * 30.0 / 216.0, 1e-9);
}

/// At c = γH/N the work of gravity is dissipated.
#[test]
fn at_failure_work_and_dissipation_balance() {
    for (degrees, depth_factor) in SLOPES {
        let s = Slope::new(12.0, degrees.to_radians(), depth_factor).unwrap();
        let (m, gamma) = (s.critical(), 18e3);
        let c = gamma * 12.0 / s.stability_number();
        let work = m.work(gamma);
        assert!(work > 0.0);
        near(m.dissipation(c), work, 1e-12 * work);
        near(m.factor_of_safety(c, gamma), 1.0, 1e-12);
        near(s.factor_of_safety(2.0 * c, gamma).unwrap(), 2.0, 1e-12);
    }
}

/// Height of the ground.
fn ground(s: &Slope, x: f64) -> f64 {
    (x * s.angle.tan()).clamp(0.0, s.height)
}

/// Area and first moments of the mass above an arc, by the midpoints of vertical slices.
fn slices(s: &Slope, circle: &Circle, count: u32) -> [f64; 3] {
    let width = (circle.entry.x - circle.exit.x) / f64::from(count);
    let mut sum = [0.0; 3];
    for i in 0..count {
        let x = circle.exit.x + (f64::from(i) + 0.5) * width;
        let below = (circle.radius.powi(2) - (x - circle.centre.x).powi(2)).sqrt();
        let (top, bottom) = (ground(s, x), circle.centre.y - below);
        let area = (top - bottom) * width;
        sum[0] += area;
        sum[1] += area * x;
        sum[2] += area * (top + bottom) / 2.0;
    }
    sum
}

#[test]
fn area_and_centroid_are_the_limit_of_fine_slices() {
    for (degrees, depth_factor) in SLOPES {
        let s = slope(degrees, depth_factor);
        let m = s.critical();
        let exact = [m.area, m.area * m.centroid.x, m.area * m.centroid.y];
        let error = |count| {
            let found = slices(&s, &m.circle, count);
            let errors = found.iter().zip(exact).map(|(a, b)| (a - b).abs());
            errors.fold(0.0, f64::max)
        };
        let size = exact.iter().copied().fold(0.0, f64::max);
        let [coarse, fine] = [error(100), error(10_000)];
        assert!(fine < 1e-3 * coarse && fine < 1e-6 * size, "{coarse} {fine}");
    }
}

#[test]
fn critical_arcs_lie_in_the_soil_above_the_base() {
    for (degrees, depth_factor) in SLOPES {
        let s = slope(degrees, depth_factor);
        let c = s.critical().circle;
        near((c.point(1.0) - c.entry).norm(), 0.0, 1e-12 * c.radius);
        near(c.entry.y, s.height, 1e-12);
        near(c.exit.y, ground(&s, c.exit.x), 1e-12);
        for i in 0..=1000 {
            let x = c.point(f64::from(i) / 1000.0);
            near((x - c.centre).norm(), c.radius, 1e-12 * c.radius);
            assert!(x.y >= c.lowest().y - 1e-12 && x.y >= -s.depth() - 1e-9, "{x}");
            assert!(x.y <= ground(&s, x.x) + 1e-9, "{x}");
        }
    }
}

/// A circle by centre and radius, if its lower arc cuts one mass off above the base, with ends anywhere.
fn cut(s: &Slope, centre: Vector2<f64>, radius: f64) -> Option<Circle> {
    let bottom = |x: f64| centre.y - (radius.powi(2) - (x - centre.x).powi(2)).max(0.0).sqrt();
    let at = |i: u32| centre.x + radius * (f64::from(i) / 200.0 - 1.0);
    let inside = |x: f64| bottom(x) < ground(s, x);
    let within: Vec<u32> = (0..=400).filter(|i| inside(at(*i))).collect();
    let (first, last) = (*within.first()?, *within.last()?);
    let one = (last - first) as usize + 1 == within.len();
    if !one || first == 0 || last == 400 || centre.y - radius < -s.depth() {
        return None;
    }
    let crossing = |mut dry: f64, mut wet: f64| {
        for _ in 0..50 {
            let x = 0.5 * (dry + wet);
            *(if inside(x) { &mut wet } else { &mut dry }) = x;
        }
        Vector2::new(wet, ground(s, wet))
    };
    Some(Circle { centre, radius, exit: crossing(at(first - 1), at(first)), entry: crossing(at(last + 1), at(last)) })
}

/// Every circle of a grid, those that enter on the face too, by slices.
#[test]
fn no_circle_of_a_scan_is_worse_than_the_critical_one() {
    for (degrees, depth_factor) in [(60.0, 1.0), (45.0, 1.0), (45.0, 1.5), (15.0, 1.2)] {
        let s = slope(degrees, depth_factor);
        let n = s.stability_number();
        let c = s.critical().circle;
        let mut least = f64::INFINITY;
        for i in 0..32_000 {
            let [a, b, d] = [i % 40, i / 40 % 40, i / 1600].map(|i| f64::from(i) + 0.5);
            let centre = Vector2::new((a / 20.0 - 1.0) * 2.0, 0.1 + b / 20.0 * c.centre.y);
            let radius = (centre.y + s.depth()) * (1.0 - (1.0 - d / 20.0).powi(2));
            let centre = centre + Vector2::new(c.centre.x, 0.0);
            if let Some(circle) = cut(&s, centre, radius) {
                let [area, moment, _] = slices(&s, &circle, 200);
                let work = moment - area * centre.x;
                if work > 1e-6 {
                    let found = radius.powi(2) * circle.angle() / work;
                    least = least.min(found);
                }
            }
        }
        assert!(least > n * (1.0 - 1e-4), "{degrees}: {least} {n}");
        assert!(least < n * 1.03, "{degrees}: {least} {n}");
    }
}

#[test]
fn a_finer_search_finds_the_same() {
    let fine = Search { samples: 29, sections: 50 };
    for (degrees, depth_factor) in SLOPES {
        let s = slope(degrees, depth_factor);
        let found = s.number(&s.least(fine).circle);
        near(s.stability_number() / found, 1.0, 1e-9);
    }
}

#[test]
fn steeper_slopes_and_deeper_bases_are_less_stable() {
    let angles = [1.0, 5.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0];
    let depth_factors = [1.0, 1.1, 1.5, 2.0, 4.0];
    let table = angles.map(|b| depth_factors.map(|d| number(b, d)));
    for row in &table {
        assert!(row.is_sorted_by(|a, b| *b <= a * (1.0 + 1e-9)), "{row:?}");
    }
    for rows in table.windows(2) {
        let steeper = rows[0].iter().zip(&rows[1]);
        assert!(steeper.clone().all(|(flat, steep)| steep < flat));
    }
}

/// A slope whose circle leaves on the face is the upper part of one that goes on down to the base.
#[test]
fn above_the_toe_only_the_depth_of_the_base_matters() {
    for depth_factor in [1.1, 1.2, 1.3] {
        let found = number(15.0, depth_factor);
        near(found * depth_factor, number(15.0, 1.0), 1e-7);
    }
}

#[test]
fn what_is_out_of_range_is_refused_by_name() {
    let refusals = [
        ("height", Slope::new(0.0, 0.5, 1.0)),
        ("height", Slope::new(f64::NAN, 0.5, 1.0)),
        ("height", Slope::new(f64::INFINITY, 0.5, 1.0)),
        ("angle", Slope::new(1.0, 0.01, 1.0)),
        ("angle", Slope::new(1.0, 1.6, 1.0)),
        ("depth_factor", Slope::new(1.0, 0.5, 0.9)),
        ("depth_factor", Slope::new(1.0, 0.5, f64::INFINITY)),
    ];
    for (name, refusal) in refusals {
        let text = refusal.unwrap_err().to_string();
        assert!(text.starts_with(name) && text.contains("allowed: "), "{text}");
    }
    let s = slope(45.0, 1.0);
    for (name, [c, gamma]) in [("cohesion", [0.0, 1.0]), ("cohesion", [f64::NAN, 1.0]), ("unit_weight", [1.0, -1.0])] {
        let text = s.factor_of_safety(c, gamma).unwrap_err().to_string();
        assert!(text.starts_with(name), "{text}");
    }
}
