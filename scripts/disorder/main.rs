//! Order of the particles of a liquid: the table of docs/notes/averages.md, made by a model of its own.
//!
//!     rustc --edition 2024 -O -C target-cpu=native -o disorder scripts/disorder/main.rs && ./disorder
//!
//! An inviscid fluid in two dimensions, p = −K (J̄ − 1), FLIP, `fbar-consistent` and each candidate by itself: the standing
//! wave over twenty periods (GIMP and quadratic splines, n8) and the dam break at h = 0.25 m with GIMP. The whole table
//! takes some minutes; `./disorder wave gimp 8 hold=10 relax=0` is one run, `./disorder dam hold=10` another,
//! `./disorder rows 0 2` the first two rows.

mod fluid;
mod problem;

use fluid::{Basis, Fluid, GRAVITY};
use problem::{Problem, begin, wave_frequency, wave_shape};
use std::f64::consts::PI;

/// Options of a run beside `fbar-consistent` with β = `relax` and ε = `share`; all are off at zero.
#[derive(Clone, Copy)]
struct Options {
    /// The wave's amplitude over 0.01 m.
    amplitude: f64,
    /// How long the dam break runs (s).
    duration: f64,
    /// Particles per direction and cell; zero for the case's own.
    particles: f64,
    /// β and ε.
    relax: f64,
    share: f64,
    /// ε² K is at least this many times |Πp|.
    hold: f64,
    /// A stress (I − Π) κ ln(J/J̄), κ this many times |Πp|: the same stiffness, beside ε.
    spring: f64,
    /// A stress (I − Π) η (I − Π) div v with η this many times ρ c h.
    viscosity: f64,
    /// ln J loses the share min(1, this γ) of ln(J/J̄), γ the shear of a step; of what Π can't see of it.
    volume: f64,
    volume_unseen: f64,
    /// Rate (1/s) at which places flow down the gradient of Σ V (ln J/J̄)², and away from nodes that are too heavy.
    shift: f64,
    spread: f64,
    /// Shares of PIC, and of (1 − S S⁺)² as in XPIC(2), per second.
    pic: f64,
    xpic: f64,
}

const NOTHING: Options = Options {
    amplitude: 1.0,
    duration: 0.4,
    particles: 0.0,
    relax: 10.0,
    share: 0.01,
    hold: 0.0,
    spring: 0.0,
    viscosity: 0.0,
    volume: 0.0,
    volume_unseen: 0.0,
    shift: 0.0,
    spread: 0.0,
    pic: 0.0,
    xpic: 0.0,
};

impl Options {
    fn set(&mut self, entry: &str) {
        let (name, value) = entry.split_once('=').unwrap_or((entry, "1"));
        let value = value.parse().unwrap_or_else(|_| panic!("{entry}: not a number"));
        *match name {
            "amplitude" => &mut self.amplitude,
            "duration" => &mut self.duration,
            "particles" => &mut self.particles,
            "relax" => &mut self.relax,
            "share" => &mut self.share,
            "hold" => &mut self.hold,
            "spring" => &mut self.spring,
            "viscosity" => &mut self.viscosity,
            "volume" => &mut self.volume,
            "volume_unseen" => &mut self.volume_unseen,
            "shift" => &mut self.shift,
            "spread" => &mut self.spread,
            "pic" => &mut self.pic,
            "xpic" => &mut self.xpic,
            _ => panic!("{name}: no such option"),
        } = value;
    }
}

/// Candidates: name and options.
const CANDIDATES: &[(&str, &[&str])] = &[
    ("`fbar-consistent` as it is", &[]),
    ("no relaxation, β = 0", &["relax=0"]),
    ("a larger ε = 0.1", &["share=0.1"]),
    ("ε = 0.1, β = 0", &["share=0.1", "relax=0"]),
    ("**ε² K ≥ 10 \\|Πp\\|, β = 0**", &["hold=10", "relax=0"]),
    ("ε² K ≥ 10 \\|Πp\\|, β = 10", &["hold=10"]),
    ("ε² K ≥ 100 \\|Πp\\|, β = 0", &["hold=100", "relax=0"]),
    (
        "ε² K ≥ 10 \\|Πp\\|, β = 0, 8 × 8 particles",
        &["hold=10", "relax=0", "particles=8"],
    ),
    ("a spring, 10 \\|Πp\\| ln(J/J̄)", &["spring=10"]),
    (
        "the spring alone, ε = 0, and β = 1000",
        &["spring=10", "share=0", "relax=1000"],
    ),
    ("a viscosity of the unseen, 0.1 ρ c h", &["viscosity=0.1"]),
    ("J relaxes to J̄, 10 γ", &["volume=10"]),
    ("… what Π can't see of it", &["volume_unseen=10"]),
    ("places flow back, 10/s", &["shift=10"]),
    ("heavy nodes push, 10/s", &["spread=10"]),
    ("PIC, 0.1/s", &["pic=0.1"]),
    ("XPIC(2), 1/s", &["xpic=1"]),
    ("no averages (ε = 1, β = 0)", &["share=1", "relax=0"]),
];

/// Steps between two looks, and between two corrections of places or velocities.
const LOOK: usize = 20;
const EVERY: usize = 10;

/// Measures of a run.
#[derive(Default)]
struct Seen {
    /// Times (s) at which the mode passes zero.
    passes: Vec<f64>,
    lost: f64,
    gained: f64,
    gap: f64,
    j: (f64, f64),
    /// Dam break: front (m) and rms p − Πp (Pa) at 0.4 s, kinetic and potential energy at the end over the start.
    front: f64,
    rough: f64,
    left: f64,
    broken: Option<f64>,
}

/// The frequency over the exact one from passes up to `time`.
fn frequency(passes: &[f64], time: f64) -> f64 {
    let passes: Vec<f64> = passes.iter().copied().filter(|t| *t < time).collect();
    let half_periods = passes.len().saturating_sub(1) as f64;
    half_periods / (passes.last().unwrap_or(&0.0) - passes.first().unwrap_or(&0.0)) * PI / wave_frequency()
}

fn run(problem: Problem, options: &Options) -> Seen {
    let (mut f, steps, dt) = begin(problem, options);
    let (n, h) = (f.len(), f.axes[0].h);
    let c = (f.modulus / f.density).sqrt();
    let rest: Vec<[f64; 2]> = f.x.clone();
    let dam = matches!(problem, Problem::Dam);
    let viscosity = options.viscosity * f.density * c * h;
    let flip = (-options.pic * dt).exp();
    let mut unseen_rate = vec![0.0; n];
    let mut seen = Seen {
        j: (f64::INFINITY, 0.0),
        ..Seen::default()
    };
    let start: f64 = f.energies().iter().sum();
    let (mut largest, mut before) = (0.0f64, (0.0, 0.0));
    let norm: f64 = f
        .start
        .iter()
        .map(|x| {
            let s = wave_shape(*x);
            s[0] * s[0] + s[1] * s[1]
        })
        .sum();
    let rows = f.axes[1].nodes();
    for step in 0..=steps {
        let time = step as f64 * dt;
        f.look_around();
        let stress = f.stress();
        let pressure = if options.hold > 0.0 || options.spring > 0.0 {
            f.average(&stress)
        } else {
            vec![0.0; n]
        };
        let eps: Vec<f64> = pressure
            .iter()
            .map(|s| {
                (options.hold * s.abs() / f.modulus)
                    .max(options.share.powi(2))
                    .sqrt()
                    .min(1.0)
            })
            .collect();
        let mut of_force = f.a(&stress, &eps);
        if step % LOOK == 0 || step == steps {
            let [kinetic, potential, stored] = f.energies();
            largest = largest.max(kinetic);
            let gain = kinetic + potential + stored - start;
            seen.gained = seen.gained.max(gain / largest.max(1e-300));
            seen.lost = -gain / largest.max(1e-300);
            seen.left = (kinetic + potential) / (0.5 * f.density * GRAVITY * 4.0 * 4.0);
            seen.gap = (f.gap().iter().map(|q| q * q).sum::<f64>() / n as f64).sqrt();
            for j in &f.j {
                seen.j = (seen.j.0.min(*j), seen.j.1.max(*j));
            }
            if dam && seen.front == 0.0 && time >= 0.4 - 0.5 * dt {
                seen.front = f.x.iter().map(|x| x[0] + f.axes[0].half).fold(0.0, f64::max);
                seen.rough = (f.less_average(&of_force).iter().map(|p| p * p).sum::<f64>() / n as f64).sqrt();
            }
            let mode = |p: usize| {
                let s = wave_shape(f.start[p]);
                (f.x[p][0] - rest[p][0]) * s[0] + (f.x[p][1] - rest[p][1]) * s[1]
            };
            let now = (time, (0..n).map(mode).sum::<f64>() / norm);
            if before.1 * now.1 < 0.0 {
                seen.passes
                    .push(before.0 - (now.0 - before.0) * before.1 / (now.1 - before.1));
            }
            before = now;
            if step == steps {
                break;
            }
        }
        if viscosity > 0.0 || options.spring > 0.0 {
            let q: Vec<f64> = f
                .gap()
                .iter()
                .enumerate()
                .map(|(p, q)| unseen_rate[p] + options.spring * pressure[p].abs() * q)
                .collect();
            for (s, q) in of_force.iter_mut().zip(f.less_average(&q)) {
                *s += q;
            }
        }
        // To the nodes and back.
        let (mass, force) = (f.mass(), f.gradient_sums(&of_force));
        let mut nodes = vec![[0.0; 3]; f.nodes()];
        for p in 0..n {
            let v = f.v[p];
            f.each(p, |i, w, _, _| {
                nodes[i][0] += w * mass * v[0];
                nodes[i][1] += w * mass * v[1];
                nodes[i][2] += w * mass;
            });
        }
        let mut change = vec![[0.0; 2]; f.nodes()];
        for (i, node) in nodes.iter_mut().enumerate() {
            let m = node[2];
            if m <= 0.0 {
                continue;
            }
            let held = [f.axes[0].held(i / rows), f.axes[1].held(i % rows)];
            for a in 0..2 {
                let old = node[a] / m;
                let mut new = old - dt * force[i][a] / m - if a == 1 { dt * GRAVITY } else { 0.0 };
                let leaves = if dam {
                    new * f64::from(held[a]) > 0.0
                } else {
                    held[a] != 0
                };
                if leaves {
                    new = 0.0;
                }
                node[a] = new;
                change[i][a] = new - old;
            }
        }
        let (mut moved, mut shear, mut growth) = (vec![[0.0; 2]; n], vec![0.0; n], vec![0.0; n]);
        for p in 0..n {
            let (mut u, mut dv, mut g) = ([0.0; 2], [0.0; 2], [[0.0; 2]; 2]);
            f.each(p, |i, w, dx, dy| {
                for a in 0..2 {
                    u[a] += w * nodes[i][a];
                    dv[a] += w * change[i][a];
                    g[a][0] += dx * nodes[i][a];
                    g[a][1] += dy * nodes[i][a];
                }
            });
            for a in 0..2 {
                f.v[p][a] = flip * (f.v[p][a] + dv[a]) + (1.0 - flip) * u[a];
                moved[p][a] = dt * u[a];
            }
            growth[p] = (1.0 + dt * g[0][0]) * (1.0 + dt * g[1][1]) - dt * dt * g[0][1] * g[1][0];
            let (e, o) = (0.5 * (g[0][0] - g[1][1]), 0.5 * (g[0][1] + g[1][0]));
            shear[p] = 2.0 * dt * (e * e + o * o).sqrt();
        }
        if options.xpic > 0.0 && step % EVERY == 0 {
            damp(&mut f, &nodes, options.xpic * dt * EVERY as f64);
        }
        // The averages are those of the volumes at the step's start.
        if viscosity > 0.0 {
            unseen_rate = f.less_average(&growth).iter().map(|r| r * viscosity / dt).collect();
        }
        let mut next: Vec<f64> = f.a(&growth, &eps).iter().zip(&f.j_bar).map(|(g, j)| g * j).collect();
        if options.relax > 0.0 {
            let rest = f.unseen(&next, |p| (options.relax * shear[p]).min(1.0));
            for (next, rest) in next.iter_mut().zip(rest) {
                *next -= rest;
            }
        }
        let mut j: Vec<f64> = f.j.iter().zip(&growth).map(|(j, g)| j * g).collect();
        let parted: Vec<f64> = j.iter().zip(&next).map(|(j, bar)| (j / bar).ln()).collect();
        if options.volume > 0.0 {
            for p in 0..n {
                j[p] *= (-(options.volume * shear[p]).min(1.0) * parted[p]).exp();
            }
        }
        if options.volume_unseen > 0.0 {
            let q = f.unseen(&parted, |p| (options.volume_unseen * shear[p]).min(1.0));
            for p in 0..n {
                j[p] *= (-q[p]).exp();
            }
        }
        let places = ((options.shift > 0.0 || options.spread > 0.0) && step % EVERY == 0)
            .then(|| flow(&f, options, &parted, dt * EVERY as f64, &nodes));
        f.j_bar = next;
        f.j = j;
        if let Some(places) = places {
            f.displace(&places);
        }
        for p in 0..n {
            for a in 0..2 {
                f.x[p][a] += moved[p][a];
            }
            let goes = moved[p][0].abs().max(moved[p][1].abs());
            let room = if f.axes[0].basis == Basis::Gimp {
                f.axes[0].half
            } else {
                0.0
            };
            let [x, y] = f.x[p];
            let top = f.axes[1].cells as f64 * h - f.axes[1].half;
            let inside = x >= -room && x <= f.axes[0].cells as f64 * h + room && y >= -room && y < top;
            if !(f.j[p] > 0.0 && inside && goes + c * f.j[p] * dt <= h) {
                seen.broken = Some(time);
                return seen;
            }
        }
    }
    seen
}

/// V ← V − s (1 − S S⁺)² V: what two maps to the nodes and back leave.
fn damp(f: &mut Fluid, nodes: &[[f64; 3]], share: f64) {
    let mut rough = f.v.clone();
    for _ in 0..2 {
        for a in 0..2 {
            let mut sums = vec![0.0; nodes.len()];
            for p in 0..f.len() {
                f.each(p, |i, w, _, _| sums[i] += w * f.mass() * rough[p][a]);
            }
            for (sum, node) in sums.iter_mut().zip(nodes) {
                if node[2] > 0.0 {
                    *sum /= node[2];
                }
            }
            for (rough, seen) in rough.iter_mut().zip(f.gathered(&sums)) {
                rough[a] -= seen;
            }
        }
    }
    for p in 0..f.len() {
        for a in 0..2 {
            f.v[p][a] -= share.min(1.0) * rough[p][a];
        }
    }
}

/// Displacements of nodes, h² times the rate, which lower what has parted, or lead away from nodes that are too heavy.
fn flow(f: &Fluid, options: &Options, parted: &[f64], time: f64, nodes: &[[f64; 3]]) -> Vec<[f64; 2]> {
    let (h, rows) = (f.axes[0].h, f.axes[1].nodes());
    let (q, rate) = if options.shift > 0.0 {
        (f.unseen(parted, |_| 1.0), -options.shift)
    } else {
        let excess = |(i, node): (usize, &[f64; 3])| {
            let full = f.density * h * h * f.axes[0].volume(i / rows) * f.axes[1].volume(i % rows);
            if full > 0.0 {
                (node[2] / full - 1.0).max(0.0)
            } else {
                0.0
            }
        };
        let nodes: Vec<f64> = nodes.iter().enumerate().map(excess).collect();
        (f.gathered(&nodes), options.spread)
    };
    let scale = h * h * rate.signum() * (rate.abs() * time).min(0.1);
    let mut moves = f.gradient_sums(&q);
    for (i, u) in moves.iter_mut().enumerate() {
        let held = [f.axes[0].held(i / rows), f.axes[1].held(i % rows)];
        for a in 0..2 {
            u[a] *= if held[a] == 0 && f.node_volume[i] > 0.0 {
                scale / f.node_volume[i]
            } else {
                0.0
            };
        }
    }
    moves
}

/// A cell of the table.
fn describe(problem: Problem, seen: &Seen) -> String {
    if let Some(time) = seen.broken {
        return format!("breaks down at {time:.1} s");
    }
    match problem {
        Problem::Wave(..) => format!(
            "{:.3} → {:.3}, {:.2}, {:.3}",
            frequency(&seen.passes, 2.6),
            frequency(&seen.passes, 24.0),
            seen.lost,
            seen.gap
        ),
        Problem::Dam => format!(
            "{:.2} m, {:.1} kPa, {:.4}, {:.2} … {:.2}",
            seen.front,
            seen.rough / 1e3,
            seen.left,
            seen.j.0,
            seen.j.1
        ),
    }
}

fn main() {
    let given: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = given.iter().map(String::as_str).collect();
    let mut options = NOTHING;
    let problem = match words.as_slice() {
        ["wave", basis, n, ..] => Problem::Wave(
            if *basis == "gimp" { Basis::Gimp } else { Basis::Splines },
            n.parse().expect("cells"),
        ),
        ["dam", ..] => Problem::Dam,
        ["rows", from, to] => return table(from.parse().expect("a row"), to.parse().expect("a row")),
        _ => return table(0, CANDIDATES.len()),
    };
    words
        .iter()
        .filter(|word| word.contains('='))
        .for_each(|word| options.set(word));
    let seen = run(problem, &options);
    println!(
        "{} (gained {:.4}, J {:.3} … {:.3})",
        describe(problem, &seen),
        seen.gained,
        seen.j.0,
        seen.j.1
    );
}

/// The rows from one up to another.
fn table(from: usize, to: usize) {
    let problems = [
        Problem::Wave(Basis::Gimp, 8),
        Problem::Wave(Basis::Splines, 8),
        Problem::Dam,
    ];
    println!("| | GIMP | splines | dam break |\n|---|---|---|---|");
    for (name, entries) in &CANDIDATES[from..to] {
        let mut options = NOTHING;
        entries.iter().for_each(|entry| options.set(entry));
        print!("| {name} |");
        for problem in problems {
            print!(" {} |", describe(problem, &run(problem, &options)));
            use std::io::Write;
            let _ = std::io::stdout().flush();
        }
        println!();
    }
}
