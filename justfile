# What is done with this project, by name: `just --list`. `tests/run` installs the runner and calls `ci`.

# Mesa's device selection only adds noise on machines without a display. The program turns it off itself; tests of the library do not.
export NODEVICE_SELECT := "1"

swiftshader := env("XDG_CACHE_HOME", env("HOME", "") / ".cache") / "spiral-atlas/swiftshader/icd.json"

# Every check and test, as continuous integration runs them
ci: setup lint test examples python capi ompl opendrive explorer-test fuzz swiftshader

# Installs what the tests need
setup:
    tests/setup

# Formatting, lints and documentation
lint:
    cargo fmt --all --check
    cargo clippy --locked --release --all-targets -- -D warnings
    cargo clippy --locked --release --no-default-features -- -D warnings
    cargo clippy --locked --release --package spiral-atlas-python --package spiral-atlas-capi --package spiral-atlas-explorer -- -D warnings
    RUSTDOCFLAGS="-D warnings" cargo doc --locked --release --no-deps

# All tests, or those whose name contains a text
test *filter:
    cargo test --locked --release {{filter}}

# The programs in examples/
examples:
    for example in examples/*.rs; do cargo run --quiet --locked --release --example "$(basename "$example" .rs)"; done

# The Python package: built, installed into a fresh environment, tested
python:
    tests/python

# The C library: installed beside itself, tested with two compilers and sanitizers
capi:
    tests/capi

# Joins as motions of OMPL's planners
ompl:
    tests/ompl

# Roads, judged by the ASAM quality checker and SUMO
opendrive:
    tests/opendrive

# The explorer for browsers, as a folder of static files
explorer:
    crates/explorer/build

# The explorer on this machine, at http://localhost:8000
explorer-serve: explorer
    python3 -m http.server --bind 127.0.0.1 --directory target/explorer 8000

# The explorer in Chromium, compared with the program
explorer-test:
    tests/explorer

# The picture of the explorer, anew
explorer-picture:
    tests/explorer --picture

# The coverage-guided fuzzers of the readers, for some seconds each
fuzz seconds="15":
    @if command -v c++ >/dev/null; then fuzz/run {{seconds}}; else \
        echo "no C++ compiler is to be had for libFuzzer; the readers were fuzzed without coverage only"; fi

# Tests of the GPU evaluator on a second, independent software adapter
swiftshader:
    #!/usr/bin/env bash
    set -euo pipefail
    [ -f "{{swiftshader}}" ] || exit 0
    export VK_DRIVER_FILES="{{swiftshader}}" SPIRAL_ATLAS_TEST_ADAPTER=swiftshader
    cargo test --locked --release --test gpu -- engine:: arithmetic::
    # Its compiler needs many minutes for the shaders of the cubic and the PH quintic.
    cargo test --locked --release --test gpu -- few_nodes --skip on_cubic --skip on_ph_quintic

# Speeds, beside peers in the same run
bench:
    benches/run

# The committed pictures of the shipped recipes, anew
pictures:
    for recipe in $(ls atlases/*.toml | grep -v manifest); do \
        cargo run --quiet --locked --release -- generate --backend cpu --out target/pictures "$recipe"; done
    cp target/pictures/*.png atlases/
