//! Memory estimate before a run, extrapolated from coarser grids; a scene that does not fit is never built.

use super::*;
use crate::size::{GIBIBYTE, MEBIBYTE, Size};

/// Bytes of the largest scene that is built for its measurement instead of extrapolated from a coarser one.
const BUILT: f64 = 32.0 * MEBIBYTE;
/// Bytes from which a coarser scene is large enough that its edges count for little.
const LARGE: f64 = 4.0 * MEBIBYTE;
/// Times that cells are made larger, at most; and from one scene to another whose growth tells the dimension.
const MOST_LARGER: u32 = 1024;
const TELLING: f64 = 4.0;
/// Where Linux tells what memory is to be had.
const MEMORY: &str = "/proc/meminfo";

impl Size {
    /// Size of the scene of a run.
    ///
    /// # Errors
    /// The parameters make no scene.
    pub fn of(case: &Case, spec: &RunSpec) -> Result<Self, Error> {
        if let Some(size) = case.size {
            return Ok(size);
        }
        let parameters = Parameters::new(&case.parameters, &spec.set)?;
        // Allocations are counted thread by thread, so that the scene must be built on one.
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let pool = pool.map_err(|e| Error::Input(format!("a thread can't be started: {e}")))?;
        pool.install(|| Self::found(case, spec, &parameters)).map_err(|e| given(e, spec))
    }

    fn found(case: &Case, spec: &RunSpec, parameters: &Parameters) -> Result<Self, Error> {
        let mut coarsest: Option<(Self, f64)> = None;
        for factor in (2..=MOST_LARGER).rev().filter(|n| is_fit(*n)).map(f64::from) {
            let mut of_larger_cells = spec.clone();
            of_larger_cells.level.h *= factor;
            let Ok((size, dimension)) = Self::built(case, &of_larger_cells, parameters) else { continue };
            let of_growth = |growth: f64| size.times(factor.powf(growth));
            if of_growth(dimension).bytes < BUILT {
                break;
            }
            let (coarse, largest) = *coarsest.get_or_insert((size, factor));
            if largest >= TELLING * factor {
                // A slice a cell thick grows as a plane does.
                let growth = (size.particles / coarse.particles).ln() / (largest / factor).ln();
                if size.bytes >= LARGE {
                    return Ok(of_growth(growth.round().clamp(0.0, dimension)));
                }
            } else if size.bytes >= BUILT {
                // Too large to be followed any further.
                return Ok(of_growth(dimension));
            }
        }
        Self::built(case, spec, parameters).map(|(size, _)| size)
    }

    /// Size of a built scene, with its dimension.
    fn built(case: &Case, spec: &RunSpec, parameters: &Parameters) -> Result<(Self, f64), Error> {
        let mut begun = None;
        let counted = allocation_counter::measure(|| begun = Some((case.begin)(spec, parameters)));
        let begun = begun.ok_or_else(|| Error::Input("nothing was begun".to_owned()))?;
        let job: Box<dyn Job> = begun.and_then(require_particles)?;
        let work = job.work();
        let size = Self {
            particles: work.particles as f64,
            nodes: work.nodes as f64,
            bytes: counted.bytes_max as f64,
            worked_out: false,
        };
        Ok((size, job.discretisation().dim as f64))
    }

    /// Checks that a scene of this size fits in `memory` (bytes), if that is known.
    ///
    /// # Errors
    /// It can't.
    pub fn require(self, memory: Option<f64>, spec: &RunSpec) -> Result<(), Error> {
        self.too_large(memory).map_or(Ok(()), |why| Err(given(Error::Input(why), spec)))
    }
}

/// Checks that `memory` (bytes) holds the largest of these scenes, as many as run side by side.
///
/// # Errors
/// It does not.
pub fn require_together(sizes: &[Size], memory: f64, side_by_side: usize) -> Result<(), Error> {
    let mut bytes: Vec<f64> = sizes.iter().map(|size| size.bytes).collect();
    bytes.sort_by(|a, b| b.total_cmp(a));
    bytes.truncate(side_by_side);
    let all: f64 = bytes.iter().sum();
    if all <= memory {
        return Ok(());
    }
    let [all, memory] = [all, memory].map(|bytes| bytes / GIBIBYTE);
    Err(Error::Input(format!(
        "the {} largest scenes take {all:.3} GiB side by side, and may take {memory:.3} GiB (--memory): fewer --threads",
        bytes.len()
    )))
}

/// Whether lengths that are whole numbers of cells are likely to be so of cells as many times larger.
fn is_fit(mut factor: u32) -> bool {
    for prime in [2, 5] {
        while factor.is_multiple_of(prime) {
            factor /= prime;
        }
    }
    factor == 1
}

/// Bytes of memory that the machine has to give, where it tells.
#[must_use]
pub fn available_memory() -> Option<f64> {
    let told = std::fs::read_to_string(Path::new(MEMORY)).ok()?;
    let line = told.lines().find_map(|l| l.strip_prefix("MemAvailable:"))?;
    let kibibytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024.0)
}

/// A body of no particle would be a run of nothing.
pub(super) fn require_particles(job: Box<dyn Job>) -> Result<Box<dyn Job>, Error> {
    match job.work().particles {
        0 => Err(Error::Input(format!(
            "the body has no particle: it is smaller than half a cell of {} m",
            job.discretisation().h
        ))),
        _ => Ok(job),
    }
}

/// An error of a scene, with what was set of its parameters if it doesn't name that.
pub(super) fn given(error: Error, spec: &RunSpec) -> Error {
    let (Error::Input(_) | Error::Scene(_)) = error else { return error };
    let said = error.to_string();
    let names = |set: &&String| set.split('=').next().is_some_and(|name| said.contains(name));
    match spec.set.iter().all(|set| names(&set)) {
        true => error,
        false => Error::Input(format!("{said}; with {}", spec.set.join(", "))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;

    fn spec(case: &Case, level: usize, set: &[&str]) -> RunSpec {
        crate::record::fixture::spec(case.default_scheme(None), case.levels[level], set)
    }

    /// An extrapolated size equals that of the scene itself.
    #[test]
    fn a_size_that_is_worked_out_is_that_of_the_scene() {
        let case = cases::find("dam-break").unwrap();
        let spec = spec(case, 2, &["ppc_per_direction=4"]);
        let parameters = Parameters::new(&case.parameters, &spec.set).unwrap();
        let mut coarser = spec.clone();
        coarser.level.h *= 4.0;
        let (coarse, dimension) = Size::built(case, &coarser, &parameters).unwrap();
        assert_eq!(dimension, 2.0);
        let worked_out = coarse.times(16.0);
        let (exact, _) = Size::built(case, &spec, &parameters).unwrap();
        // Nodes around the body are more beside larger cells.
        assert_eq!(worked_out.particles, exact.particles);
        assert!(worked_out.nodes >= exact.nodes);
        let bytes = worked_out.bytes / exact.bytes;
        assert!((0.9..1.25).contains(&bytes), "{worked_out}, {exact}");
    }

    #[test]
    fn every_case_has_a_size() {
        for case in cases::all() {
            let size = Size::of(case, &spec(case, 0, &[])).unwrap();
            assert!(size.particles > 0.0 && size.bytes > 0.0, "{}", case.name);
            size.require(Some(GIBIBYTE), &spec(case, 0, &[])).unwrap();
        }
    }

    /// Refused without being built: it would take more memory than machines have.
    #[test]
    fn what_the_machine_cannot_hold_is_refused_before_it_is_built() {
        for (name, level, set) in [
            ("landslide", 0, &["width=1000", "floor=500", "crest=200", "height=100", "ppc_per_direction=8"][..]),
            ("mms-axis", 4, &["dimension=3", "ppc_per_direction=5"]),
            ("column", 1, &["height=1000", "width=1000", "ppc_per_direction=5"]),
        ] {
            let case = cases::find(name).unwrap();
            let spec = spec(case, level, set);
            let mut size = None;
            let counted = allocation_counter::measure(|| size = Some(Size::of(case, &spec)));
            assert!((counted.bytes_max as f64) < GIBIBYTE);
            let size = size.unwrap().unwrap();
            assert!(size.worked_out, "{size}");
            let refused = size.require(Some(0.1 * GIBIBYTE), &spec).unwrap_err();
            let said = refused.to_string();
            assert!(said.contains("than") && said.contains(set[0]), "{said}");
            assert_eq!(said.lines().count(), 1);
        }
        let all = Size { particles: 5e9, nodes: 1.0, bytes: 1.0, worked_out: true };
        let case = cases::find("column").unwrap();
        let refused = all.require(None, &spec(case, 0, &[])).unwrap_err();
        assert!(refused.to_string().contains("particles"));
    }

    #[test]
    fn what_was_set_is_named_with_an_error_of_the_scene() {
        let case = cases::find("column").unwrap();
        for set in ["height=0.001", "width=0.001"] {
            let error = Size::of(case, &spec(case, 0, &[set])).unwrap_err();
            assert!(error.to_string().ends_with(&format!("with {set}")), "{error}");
        }
        let named = Size::of(case, &spec(case, 0, &["bulk_modulus=0.001", "height=2"]));
        let named = named.unwrap_err().to_string();
        assert!(named.contains("parameter height") && named.contains("bulk_modulus"));
    }

    #[test]
    fn scenes_side_by_side_share_the_memory() {
        let sizes = [1.0, 3.0, 2.0].map(|bytes| Size { particles: 1.0, nodes: 1.0, bytes, worked_out: false });
        require_together(&sizes, 3.0, 1).unwrap();
        require_together(&sizes, 5.0, 2).unwrap();
        let refusal = require_together(&sizes, 4.9, 2).unwrap_err();
        assert!(refusal.to_string().contains("the 2 largest"), "{refusal}");
    }

    #[test]
    fn the_machine_tells_its_memory() {
        if Path::new(MEMORY).exists() {
            assert!(available_memory().unwrap() > MEBIBYTE);
        }
    }
}
