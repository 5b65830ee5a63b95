#!/usr/bin/env bash
# The fit of both runs side by side, one core, the same readings. Usage: run.sh [SAMPLES]
set -euo pipefail
cd "$(dirname "$0")"
samples=${1:-36000}
python=${PYTHON:-}
if [[ -z $python ]]; then
    python3 -m venv "${TMPDIR:-/tmp}/trunnion-peers-fit"
    python=${TMPDIR:-/tmp}/trunnion-peers-fit/bin/python
    "$python" -m pip install --quiet numpy scipy
fi
cargo build --release --quiet --manifest-path rust/Cargo.toml
binary=$(cargo metadata --format-version 1 --no-deps --manifest-path rust/Cargo.toml | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')/release/peers-fit
{
    taskset -c 0 "$binary" "$samples"
    OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 taskset -c 0 "$python" numpy_scipy.py "$samples"
} | awk -F, 'NR == 1 { base = $2 } { printf "%-34s %8.1f ns a sample of each run  %5.2f of the first   eps_xa(90 deg) %s urad\n", $1, $2, $2 / base, $3 }'
