//! Benches of `mpm-core`: `cargo bench -p mpm-benches --bench kernels`.
