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

# Accept drift of a case, after `just verify`: just bless cook "why the results have changed"
bless case reason:
    cargo run --release -- bless {{case}} --reason "{{reason}}"

# Pictures, tables and pages of a folder again, without simulating.
report folder="reports/latest":
    cargo run --release -- report {{folder}}

# Time per particle of the kernels.
bench:
    cargo bench -p mpm-core --bench kernels

# Builds for the instruction sets of this machine give the same bits, or the same sums within a bound.
paths:
    .ci/paths

# Workloads, problems and laws in turns with peers; the report is committed.
speed python="python3":
    cargo run --release -- bench --peers taichi --python {{python}} --out reports/bench

# The nightly tier, and what is kept of it: results.csv, summary.md and the history.
nightly:
    cargo run --release -- verify --tier nightly --resume --out reports/night
    .ci/keep reports/night

# The long tier of a case, its night included; stop it at any time and start it again.
long-of case:
    cargo run --release -- verify {{case}} --tier long --resume --out reports/long-{{case}}

# The report of what has ended of it.
long-report case:
    cargo run --release -- report reports/long-{{case}} --so-far

# Fill the tables of results of the pages in docs/ from the report of a night and those of long runs.
tables night="reports/night" *long:
    python3 scripts/tables.py {{night}} {{long}}

# Break the solver on purpose and see named checks go red.
mutants:
    cargo test --release -p mpm-verify --test mutation

# What continuous integration does.
ci:
    .ci/run
