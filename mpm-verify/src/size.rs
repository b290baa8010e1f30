//! Size of a scene, and whether it can be had in the memory that there is.

/// Particles bear numbers of 32 bits.
const MOST_PARTICLES: f64 = u32::MAX as f64;
pub(crate) const MEBIBYTE: f64 = 1_048_576.0;
/// Bytes of a gibibyte, the unit of `--memory`.
pub const GIBIBYTE: f64 = 1024.0 * MEBIBYTE;

/// Size of a scene: exact, or extrapolated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size {
    pub(crate) particles: f64,
    pub(crate) nodes: f64,
    /// Bytes of memory at the start. Newton's method takes more: its matrices and their factors.
    pub(crate) bytes: f64,
    /// Whether it is estimated: from a coarser scene, or from shapes and cells.
    pub(crate) worked_out: bool,
}

impl Size {
    /// A scene `factor` times as large.
    pub(crate) fn times(self, factor: f64) -> Self {
        Self {
            particles: self.particles * factor,
            nodes: self.nodes * factor,
            bytes: self.bytes * factor,
            worked_out: true,
        }
    }

    /// Why a scene of this size can't be had in `memory` (bytes), if that is known; nothing of one that can.
    pub fn too_large(self, memory: Option<f64>) -> Option<String> {
        match memory {
            _ if self.particles > MOST_PARTICLES => Some(format!("more than {MOST_PARTICLES:e} particles: {self}")),
            Some(memory) if self.bytes > memory => Some(format!(
                "the scene is larger than the {:.3} GiB of memory that it may have (--memory): {self}",
                memory / GIBIBYTE
            )),
            _ => None,
        }
    }
}

impl std::fmt::Display for Size {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let count = |n: f64| if self.worked_out { format!("about {n:.2e}") } else { n.to_string() };
        let (particles, nodes) = (count(self.particles), count(self.nodes));
        let memory = match self.bytes < GIBIBYTE {
            true => format!("{:.1} MiB", self.bytes / MEBIBYTE),
            false => format!("{:.1} GiB", self.bytes / GIBIBYTE),
        };
        write!(f, "{particles} particles, {nodes} nodes, {memory} at the start")
    }
}
