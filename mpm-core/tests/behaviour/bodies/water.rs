//! Several bodies with water in their pores.

use super::*;
use mpm_core::poro::{self, Conductivity, Face, Water};

/// Two layers of a metre, the lower one on a floor that lets no water out, the upper one drained and loaded on top: with
/// strains that hardly change them, each obeys p′ = c p″ with c = κ M.
struct Layers {
    moduli: [f64; 2],
    conductivities: [f64; 2],
    load: f64,
}

impl Layers {
    /// Settlement of the top and pressure at the floor, at `time`. Modes are cos(ω y/√c₁) below and, from the top,
    /// sin(ω y/√c₂) above, with ω from tan a tan b = (κ₂/√c₂)/(κ₁/√c₁), a = ω/√c₁, b = ω/√c₂: pressure and flux are
    /// those of both at the joint. They are orthogonal with the weights 1/M.
    fn exact(&self, time: f64) -> [f64; 2] {
        let roots: [f64; 2] = std::array::from_fn(|k| (self.conductivities[k] * self.moduli[k]).sqrt());
        let ratio = self.conductivities[1] / roots[1] / (self.conductivities[0] / roots[0]);
        let gap = |w: f64| {
            let [(sa, ca), (sb, cb)] = roots.map(|root| (w / root).sin_cos());
            ratio * ca * cb - sa * sb
        };
        let step = 0.02 * roots[0].min(roots[1]);
        let mut settled: f64 = self.moduli.iter().map(|m| self.load / m).sum();
        let mut at_floor = 0.0;
        for k in 0..2000 {
            let (mut lo, mut hi) = (f64::from(k) * step, f64::from(k + 1) * step);
            if gap(lo).signum() == gap(hi).signum() {
                continue;
            }
            for _ in 0..60 {
                let middle = 0.5 * (lo + hi);
                *(if gap(middle).signum() == gap(lo).signum() { &mut lo } else { &mut hi }) = middle;
            }
            let [a, b] = roots.map(|root| lo / root);
            // The part above is scaled to the pressure of the part below at the joint.
            let above = a.cos() / b.sin();
            let means = [a.sin() / a, above * (1.0 - b.cos()) / b];
            let squares = [0.5 + 0.25 * (2.0 * a).sin() / a, above * above * (0.5 - 0.25 * (2.0 * b).sin() / b)];
            let weighed = |of: [f64; 2]| of[0] / self.moduli[0] + of[1] / self.moduli[1];
            let share = self.load * weighed(means) / weighed(squares) * (-lo * lo * time).exp();
            settled -= share * weighed(means);
            at_floor += share;
        }
        [settled, at_floor]
    }

    /// The same by `cells` a metre, in as many steps.
    fn found(&self, time: f64, cells: usize) -> [f64; 2] {
        let h = 1.0 / cells as f64;
        let grid = Grid::new(h, [Axis::bounded(0.0, 2 * cells + 2, (Side::Wall, Side::Open))]).unwrap();
        let [below, above] = [0, cells].map(|lo| block::<1>(h, 2, [lo], [lo + cells]));
        // Oedometric moduli without contraction across.
        let [lower, upper] = self.moduli.map(|modulus| Hencky::new(modulus, 0.0).unwrap());
        let bodies = Bodies::new(lower, below).unwrap().and(upper, above).unwrap();
        let scene = Scene::new(grid, bodies).constrain(Wall::new(0, End::Lo, WallKind::Roller));
        let top = move |x: &[f64; 1]| x[0] > 2.0 - 0.5 * h;
        let load = -self.load;
        let face = Face::loaded(&scene.bodies.particles, top, (0, End::Hi), move |_| [load]);
        let [k1, k2] = self.conductivities.map(Conductivity::Constant);
        let water = Water::new(0.4, k1).and(0.3, k2).drained(move |x| x[0] > 2.0 - 0.5 * h).face(face);
        let settings = poro::Settings::new(time / cells as f64);
        let mut solver = poro::Solver::<1>::new::<Lattice<1, 3, Gimp>>(scene, water, settings).unwrap();
        for _ in 0..cells {
            solver.step().unwrap();
        }
        let p = solver.particles();
        let settled = (0..p.len()).map(|k| p.reference_volume[k] - p.volume[k]).sum();
        let nodes = solver.pressure_nodes();
        [settled, nodes.iter().find(|(x, _)| x[0].abs() < 0.5 * h).unwrap().1]
    }
}

#[test]
fn layers_with_water_consolidate_as_their_series_says() {
    let cases = [([100.0, 1000.0], [1.0, 0.2]), ([1000.0, 100.0], [0.2, 3.0]), ([100.0, 100.0], [0.05, 1.0])];
    for (moduli, conductivities) in cases {
        let layers = Layers { moduli, conductivities, load: 1e-4 };
        // When about half has consolidated.
        let time = (0..4000).map(|k| 2.5e-4 * f64::from(k)).find(|t| layers.exact(*t)[1] < 0.5 * layers.load).unwrap();
        let exact = layers.exact(time);
        let found = [10, 20, 40].map(|cells| {
            let found = layers.found(time, cells);
            told(&format!("settlement of layers with water, {cells} cells a metre (m)"), found[0], exact[0]);
            told("pressure at their floor (Pa)", found[1], exact[1]);
            found
        });
        for k in [0, 1] {
            // Backward Euler is of first order; once that is taken off, less than a fifth is left.
            let error = |value: f64| (value / exact[k] - 1.0).abs();
            let better = error(2.0 * found[2][k] - found[1][k]);
            assert!((0.45..0.6).contains(&(error(found[2][k]) / error(found[1][k]))), "{found:?} of {exact:?}");
            assert!(better < 0.2 * error(found[2][k]), "{better}, {found:?} of {exact:?}");
        }
    }
}

/// A soft and tight column beside a stiff and open one that it does not touch consolidates as it does alone: ghost
/// penalties of the greatest modulus and conductivity would hold its loose rim.
#[test]
fn a_body_elsewhere_does_not_hold_one_with_water() {
    let (h, load) = (0.1, 1e-3);
    let consolidate = |several: bool| {
        let [left, right] = [[1, 5], [11, 15]].map(|[lo, hi]| block::<2>(h, 2, [lo, 0], [hi, 7]));
        let mut bodies = Bodies::new(Hencky::new(50.0, 0.25).unwrap(), left).unwrap();
        let mut water = Water::new(0.4, Conductivity::Constant(1e-3));
        if several {
            bodies = bodies.and(Hencky::new(5e4, 0.25).unwrap(), right).unwrap();
            water = water.and(0.3, Conductivity::Constant(1.0));
        }
        let axes = [Axis::open(0.0, 16), Axis::bounded(0.0, 12, (Side::Wall, Side::Open))];
        let floor = Wall::new(1, End::Lo, WallKind::Fixed);
        let scene = Scene::new(Grid::new(h, axes).unwrap(), bodies).constrain(floor);
        let top = move |x: &[f64; 2]| x[0] < 0.8 && x[1] > 0.66;
        let face = Face::loaded(&scene.bodies.particles, top, (1, End::Hi), move |_| [0.0, -load]);
        let water = water.drained(move |x| x[1] > 0.5 * h).face(face);
        let settings = poro::Settings::new(0.5).ghosts(0.1, 0.1).pressure_space(poro::PressureSpace::Equal);
        let mut solver = poro::Solver::<2>::new::<Lattice<2, 3, Gimp>>(scene, water, settings).unwrap();
        solver.step().unwrap();
        let pressure = solver.field(Field::PorePressure);
        let p = solver.particles();
        let of_soft = (0..p.len()).filter(|k| p.reference[*k][0] < 0.8);
        of_soft.map(|k| (p.position[k], pressure[k])).collect::<Vec<_>>()
    };
    for ((a, p), (b, q)) in consolidate(false).iter().zip(consolidate(true)) {
        // Newton's tolerance is one of all forces and volumes.
        assert!((a[0] - b[0]).abs() < 1e-10 && (a[1] - b[1]).abs() < 1e-10, "{a:?} and {b:?}");
        assert!((p - q).abs() < 1e-6 * load, "{p} and {q}");
    }
}
