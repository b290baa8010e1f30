# Verify (the default): run and judge the pr tier, write reports/latest.
default: verify

build:
    cargo build --release --workspace

# All tests.
test:
    cargo test --release

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
    cargo bench -p mpm-benches --bench kernels

# Builds for the instruction sets of this machine give the same bits, or the same sums within a bound.
paths:
    .ci/paths

# Workloads, problems and laws in turns with peers; its tables are committed.
speed python="python3":
    cargo run --release -- bench --peers taichi --python {{python}} --out reports/bench

# The nightly tier: the whole report in reports/night, and what git keeps of it; in the end everything has been measured.
nightly:
    cargo run --release -- verify --tier nightly --resume --out reports/night || test $? -ne 2
    just keep reports/night
    cargo run --release -- complete

# A tier (nightly or long) of one case, kept as the nightly one; stop it at any time and start it again.
night-of case tier="nightly":
    cargo run --release -- verify {{case}} --tier {{tier}} --resume --out reports/{{tier}}-{{case}} || test $? -ne 2
    just keep reports/{{tier}}-{{case}}

# Judge a folder of runs as this night's, with trends, and keep a row a run; the rows of other runs stay. Fill the tables of the
# pages with them.
keep folder:
    cp reports/history.csv {{folder}}
    cargo run --release -- report {{folder}} --night "$(date -u +%F)" --commit "$(git rev-parse HEAD)" || test $? -ne 2
    cargo run --release -- keep {{folder}}
    just tables

# Fill the tables of README and docs from the rows that are kept.
tables:
    cargo run --release -- tables

# Damage 50,000 scene files.
fuzz-scenes:
    MPM_FUZZ_SCENES=50000 cargo test --release -p mpm-verify --lib scene::tests::fuzz

# Break the solver on purpose and see named checks go red.
mutants:
    cargo test --release -p mpm-verify --test mutation

# What continuous integration does.
ci:
    .ci/run
