#!/bin/bash
# One run on one core: every tool derives both runs of the paper and prints its median, ms. `PYTHON` names an interpreter
# with numpy, sympy, symengine, symforce, casadi and wrenfold; `TARGET` a directory for what cargo builds.
set -e
cd "$(dirname "$0")"
python=${PYTHON:-python3}
target=${TARGET:-$PWD/target}
root=$(git rev-parse --show-toplevel)
export CARGO_TARGET_DIR=$target
cost="cargo bench --quiet --manifest-path $root/Cargo.toml -p trunnion-codegen --bench cost"
$cost --no-run
cargo build --quiet --release --manifest-path symplex/Cargo.toml
work=$(mktemp -d)
cp ./*.py "$work"
cd "$work"
core="taskset -c 0"
echo "== trunnion"
$core $cost
for tool in sympy_ring symengine wrenfold symforce casadi; do
    echo "== $tool"
    $core "$python" derive_$tool.py 2>&1 | grep -E "median|ms incl" || echo "did not run"
done
echo "== symplex"
$core "$target/release/derive-symplex" | grep median
$core "$target/release/row"
