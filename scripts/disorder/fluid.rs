//! A fluid on GIMP or quadratic splines: particles, nodes, the average Π.

pub const GRAVITY: f64 = 9.81;

/// Index of the first of three functions at `x`, values and derivatives.
pub type Functions = (usize, [f64; 3], [f64; 3]);

#[derive(Clone, Copy, PartialEq)]
pub enum Basis {
    Gimp,
    Splines,
}

/// An axis of `cells` cells from zero, with a wall there and maybe at its other end.
pub struct Axis {
    pub basis: Basis,
    pub cells: usize,
    pub h: f64,
    pub half: f64,
    pub far_wall: bool,
}

impl Axis {
    pub fn nodes(&self) -> usize {
        self.cells + if self.basis == Basis::Gimp { 3 } else { 2 }
    }

    pub fn at(&self, x: f64) -> Functions {
        let h = self.h;
        if self.basis == Basis::Gimp {
            let (length, begin) = (2.0 * self.half / h, (x - self.half + h) / h);
            let first = begin.floor();
            let a = begin - first;
            let inside = (a + length).min(1.0);
            let over = a + length - inside;
            let w0 = 0.5 / length * ((1.0 - a).powi(2) - (1.0 - inside).powi(2));
            let w2 = 0.5 / length * over * over;
            let (d0, d2) = (-(inside - a) / length / h, over / length / h);
            return (first as usize, [w0, 1.0 - w0 - w2, w2], [d0, -d0 - d2, d2]);
        }
        let first = (x / h).floor().clamp(0.0, self.cells as f64 - 1.0);
        let t = x / h - first;
        let near = |t: f64| {
            (
                [(1.0 - t).powi(2), 2.0 * t - 1.5 * t * t, 0.5 * t * t],
                [2.0 * t - 2.0, 2.0 - 3.0 * t, t],
            )
        };
        let (w, d) = if first == 0.0 {
            near(t)
        } else if self.far_wall && first as usize == self.cells - 1 {
            let (w, d) = near(1.0 - t);
            ([w[2], w[1], w[0]], [-d[2], -d[1], -d[0]])
        } else {
            (
                [0.5 * (1.0 - t).powi(2), 0.5 + t - t * t, 0.5 * t * t],
                [t - 1.0, 1.0 - 2.0 * t, t],
            )
        };
        (first as usize, w, d.map(|d| d / h))
    }

    /// −1 where a wall at the begin holds node `i`, 1 where one at the end does.
    pub fn held(&self, i: usize) -> i32 {
        let on = usize::from(self.basis == Basis::Gimp);
        if i <= on {
            -1
        } else if self.far_wall && i + on + 1 >= self.nodes() {
            1
        } else {
            0
        }
    }

    /// Volume that a function has where all is full, over h.
    pub fn volume(&self, i: usize) -> f64 {
        let end = |i: usize| -> f64 {
            match (self.basis, i) {
                (Basis::Gimp, 0) => 0.0,
                (Basis::Gimp, 1) => 0.5,
                (Basis::Splines, 0) => 1.0 / 3.0,
                (Basis::Splines, 1) => 2.0 / 3.0,
                _ => 1.0,
            }
        };
        end(i).min(if self.far_wall { end(self.nodes() - 1 - i) } else { 1.0 })
    }
}

/// The particles of a fluid and their nodes.
pub struct Fluid {
    pub axes: [Axis; 2],
    pub density: f64,
    pub modulus: f64,
    pub start: Vec<[f64; 2]>,
    pub x: Vec<[f64; 2]>,
    pub v: Vec<[f64; 2]>,
    pub volume0: f64,
    pub j: Vec<f64>,
    pub j_bar: Vec<f64>,
    /// Per particle: the functions along both axes.
    pub seen: Vec<[Functions; 2]>,
    pub node_volume: Vec<f64>,
}

impl Fluid {
    pub fn len(&self) -> usize {
        self.x.len()
    }
    pub fn nodes(&self) -> usize {
        self.axes[0].nodes() * self.axes[1].nodes()
    }
    pub fn volume(&self, p: usize) -> f64 {
        self.j[p] * self.volume0
    }
    pub fn mass(&self) -> f64 {
        self.density * self.volume0
    }

    /// `f(node, w, ∂w/∂x, ∂w/∂y)` for the nodes of a particle.
    #[inline(always)]
    pub fn each(&self, p: usize, mut f: impl FnMut(usize, f64, f64, f64)) {
        let [(i, wx, dx), (j, wy, dy)] = &self.seen[p];
        let rows = self.axes[1].nodes();
        for a in 0..3 {
            for b in 0..3 {
                f((i + a) * rows + j + b, wx[a] * wy[b], dx[a] * wy[b], wx[a] * dy[b]);
            }
        }
    }

    pub fn look_around(&mut self) {
        for p in 0..self.len() {
            self.seen[p] = [self.axes[0].at(self.x[p][0]), self.axes[1].at(self.x[p][1])];
        }
        let mut sums = vec![0.0; self.nodes()];
        for p in 0..self.len() {
            self.each(p, |i, w, _, _| sums[i] += w * self.volume(p));
        }
        self.node_volume = sums;
    }

    /// Π `q`.
    pub fn average(&self, q: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.nodes()];
        for p in 0..self.len() {
            let given = self.volume(p) * q[p];
            self.each(p, |i, w, _, _| sums[i] += w * given);
        }
        for (sum, volume) in sums.iter_mut().zip(&self.node_volume) {
            if *volume > 0.0 {
                *sum /= volume;
            }
        }
        self.gathered(&sums)
    }

    pub fn gathered(&self, nodes: &[f64]) -> Vec<f64> {
        let gather = |p| {
            let mut sum = 0.0;
            self.each(p, |i, w, _, _| sum += w * nodes[i]);
            sum
        };
        (0..self.len()).map(gather).collect()
    }

    /// (I − Π) s (I − Π) q with a share s of every particle.
    pub fn unseen(&self, q: &[f64], share: impl Fn(usize) -> f64) -> Vec<f64> {
        let rough = self.less_average(q);
        let shared: Vec<f64> = (0..self.len()).map(|p| share(p) * rough[p]).collect();
        self.less_average(&shared)
    }

    pub fn less_average(&self, q: &[f64]) -> Vec<f64> {
        q.iter().zip(self.average(q)).map(|(q, mean)| q - mean).collect()
    }

    /// A q = q − (I − Π)(1 − ε)(I − Π) q.
    pub fn a(&self, q: &[f64], eps: &[f64]) -> Vec<f64> {
        q.iter()
            .zip(self.unseen(q, |p| 1.0 - eps[p]))
            .map(|(q, r)| q - r)
            .collect()
    }

    /// (J̄/J) p, tension positive.
    pub fn stress(&self) -> Vec<f64> {
        (0..self.len())
            .map(|p| self.j_bar[p] / self.j[p] * self.modulus * (self.j_bar[p] - 1.0))
            .collect()
    }

    pub fn gap(&self) -> Vec<f64> {
        self.j.iter().zip(&self.j_bar).map(|(j, bar)| (j / bar).ln()).collect()
    }

    /// Σ V q ∇w of every node, what holds taken off.
    pub fn gradient_sums(&self, q: &[f64]) -> Vec<[f64; 2]> {
        let mut sums = vec![[0.0; 2]; self.nodes()];
        for p in 0..self.len() {
            let given = self.volume(p) * q[p];
            self.each(p, |i, _, dx, dy| {
                sums[i][0] += given * dx;
                sums[i][1] += given * dy;
            });
        }
        sums
    }

    /// Moves the particles by a field of nodal displacements, volumes with them.
    pub fn displace(&mut self, nodes: &[[f64; 2]]) {
        for p in 0..self.len() {
            let (mut u, mut g) = ([0.0; 2], [[0.0; 2]; 2]);
            self.each(p, |i, w, dx, dy| {
                for a in 0..2 {
                    u[a] += w * nodes[i][a];
                    g[a][0] += dx * nodes[i][a];
                    g[a][1] += dy * nodes[i][a];
                }
            });
            self.x[p] = [self.x[p][0] + u[0], self.x[p][1] + u[1]];
            self.j[p] *= (1.0 + g[0][0]) * (1.0 + g[1][1]) - g[0][1] * g[1][0];
        }
    }

    /// Kinetic, potential and stored energy.
    pub fn energies(&self) -> [f64; 3] {
        let mut e = [0.0; 3];
        for p in 0..self.len() {
            e[0] += 0.5 * self.mass() * (self.v[p][0].powi(2) + self.v[p][1].powi(2));
            e[1] += self.mass() * GRAVITY * self.x[p][1];
            e[2] += 0.5 * self.modulus * self.volume0 * (self.j_bar[p] - 1.0).powi(2);
        }
        e
    }
}
