# Verify (the default): run and judge the pr tier, write reports/latest.
default: verify

build:
    cargo build --release --workspace

# All tests.
test:
    cargo test --release --workspace

# Run and judge a tier: quick, pr, nightly or long.
verify tier="pr":
    cargo run --release -- verify --tier {{tier}}

# Time per particle of the kernels.
bench:
    cargo bench -p mpm-core --bench kernels

# The nightly tier, into the folder that is committed.
nightly:
    cargo run --release -- verify --tier nightly --out reports/nightly

# Break the solver on purpose and see named checks go red.
mutants:
    cargo test --release -p mpm-verify --test mutation

# What continuous integration does.
ci:
    .ci/run
