//! Description of the machine and its memory bandwidth, measured by a triad aᵢ = bᵢ + s cᵢ over arrays larger than any
//! cache (McCalpin 1995).

use crate::local::{Going, Local};
use crate::turn::{Error, Turn};
use rayon::prelude::*;

/// Numbers per array: 256 MiB each.
const LENGTH: usize = 1 << 25;
/// Numbers that one thread takes at a time.
const PART: usize = 1 << 16;
/// Bytes that are read and written for one entry, the line that a write fetches before it left aside.
const BYTES: u64 = 24;

struct Triad {
    a: Vec<f64>,
    b: Vec<f64>,
    c: Vec<f64>,
}

impl Going for Triad {
    fn go_on(&mut self) -> Result<u64, Error> {
        let (b, c) = (self.b.par_chunks(PART), self.c.par_chunks(PART));
        self.a.par_chunks_mut(PART).zip(b.zip(c)).for_each(|(a, (b, c))| {
            for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
                *a = b + 3.0 * c;
            }
        });
        Ok(BYTES * LENGTH as u64)
    }
}

/// The triad on each number of threads.
pub(super) fn turns(threads: &[usize]) -> Result<Vec<Turn>, Error> {
    let turn = |&threads: &usize| {
        let triad =
            Local::new(threads, || Ok(Triad { a: vec![0.0; LENGTH], b: vec![1.0; LENGTH], c: vec![2.0; LENGTH] }))?;
        Ok(Turn {
            group: "memory",
            name: "triad".to_owned(),
            threads,
            particles: 0,
            timed: Box::new(triad),
            like: None,
        })
    };
    threads.iter().map(turn).collect()
}

/// Name, family and model of the processor, where the system tells.
#[must_use]
pub fn processor() -> Option<String> {
    named(&std::fs::read_to_string("/proc/cpuinfo").ok()?)
}

/// Name of the first core described in `told`.
fn named(told: &str) -> Option<String> {
    let field = |name: &str| {
        let value = told.lines().find_map(|line| {
            let (key, value) = line.split_once(':')?;
            (key.trim() == name).then(|| value.trim())
        });
        value.map(ToOwned::to_owned)
    };
    let name = field("model name")?;
    let (family, model) = (field("cpu family")?, field("model")?);
    Some(format!("{name}, family {family}, model {model}"))
}

#[cfg(test)]
mod tests {
    use super::named;

    #[test]
    fn a_processor_is_named_by_its_first_core() {
        let told = "processor\t: 0\ncpu family\t: 25\nmodel\t\t: 17\nmodel name\t: AMD EPYC\n\n\
                    processor\t: 1\ncpu family\t: 6\nmodel\t\t: 1\nmodel name\t: Other\n";
        let name = "AMD EPYC, family 25, model 17";
        assert_eq!(named(told).as_deref(), Some(name));
        assert_eq!(named("CPU implementer\t: 0x41\n"), None);
    }
}
