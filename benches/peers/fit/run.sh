#!/usr/bin/env bash
# The fit beside other tools, one core, the same readings for all: the tables of README.md. Usage: run.sh [OUTPUT]
set -euo pipefail
cd "$(dirname "$0")"
output=${1:-/dev/stdout}
python=${PYTHON:-}
if [[ -z $python ]]; then
    python3 -m venv "${TMPDIR:-/tmp}/trunnion-peers-fit"
    python=${TMPDIR:-/tmp}/trunnion-peers-fit/bin/python
    "$python" -m pip install --quiet numpy scipy pandas mpmath
fi
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 RAYON_NUM_THREADS=1
cargo build --release --quiet --manifest-path rust/Cargo.toml
cargo build --release --quiet --manifest-path ../../../Cargo.toml
target() { cargo metadata --format-version 1 --no-deps --manifest-path "$1" | sed 's/.*"target_directory":"\([^"]*\)".*/\1/'; }
binary=$(target rust/Cargo.toml)/release/peers-fit
trunnion=$(target ../../../Cargo.toml)/release/trunnion
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
one() { taskset -c 0 "$@"; }

solvers() {
    echo "| | samples a run | ns for a sample of both runs | of nalgebra's QR | largest relative error of a coefficient | memory, kB |"
    echo "|---|---:|---:|---:|---:|---:|"
    for samples in 360 3600 36000 360000; do
        # 50 digits of more samples take minutes.
        exact=$work/$samples
        if [[ $samples -le 36000 ]]; then "$python" exact.py paper "$samples" >"$exact"; else printf 'nan\n%.0s' {1..13} >"$exact"; fi
        { one "$binary" solve "$samples" "$exact"; one "$python" numpy_scipy.py "$samples" "$exact"; } | sed 's/nan/–/I' |
            awk -F';' -v n="$samples" 'NR == 1 { base = $2 } { printf "| %s | %d | %.1f | %.2f | %s | %s |\n", $1, n, $2, $2 / base, $3, $4 }'
    done
}

# Wall time (the median of five) and peak memory of a command.
measured() {
    local start
    for _ in 1 2 3 4 5; do
        start=${EPOCHREALTIME/./}
        one /usr/bin/time -f '%M' -o "$work/memory" "$@" >/dev/null 2>&1
        echo "$(("${EPOCHREALTIME/./}" - start)) $(tail -n1 "$work/memory")"
    done | sort -n | awk '{ wall[NR] = $1; if ($2 > memory) memory = $2 } END { printf "%.3f s, %.0f MB", wall[3] / 1e6, memory / 1024 }'
}

files() {
    "$python" - "$1" "$work" <<'PYTHON'
import sys
import numpy as np
n, where = int(sys.argv[1]), sys.argv[2]
a = 360 * np.arange(n) / n
t = np.radians(a)
noise = np.random.default_rng(1).uniform(-0.1, 0.1, (2, n))
readings = {"tilting": 5 * np.sin(t) - 3 * np.cos(t) + 2, "separation": 4 * np.cos(t) + 2 * np.sin(t) * np.cos(t)}
for (name, y), e in zip(readings.items(), noise):
    np.savetxt(f"{where}/{name}.csv", np.c_[a, y + e], fmt="%.6f", delimiter=",", header="a_deg,dr_um", comments="")
PYTHON
}

command() {
    echo "| rows of each file | \`trunnion fit\`, all of the report | pandas and NumPy: coefficients, covariance, curve |"
    echo "|---:|---:|---:|"
    for rows in 360 36000 1000000; do
        files "$rows"
        own=$(measured "$trunnion" fit tilting-table-a --radius 150 --estimator two-step --run "tilting=$work/tilting.csv" --run "separation=$work/separation.csv")
        other=$(measured "$python" script.py "$work/tilting.csv" "$work/separation.csv")
        echo "| $rows | $own | $other |"
    done
}

# Microseconds a trial: what more trials take, over how many more they are.
apart() {
    local more=$1 few many
    shift
    few=$(measured "${monte_carlo[@]}" "$@" --trials 1000) many=$(measured "${monte_carlo[@]}" "$@" --trials $((more + 1000)))
    awk -v few="${few%% *}" -v many="${many%% *}" -v more="$more" 'BEGIN { printf "%.1f", (many - few) / more * 1e6 }'
}

trials() {
    monte_carlo=("$trunnion" monte-carlo tilting-table-a --radius 150 --samples 360 --estimator two-step)
    echo "| a trial of 2 × 360 readings | µs |"
    echo "|---|---:|"
    echo "| \`trunnion monte-carlo --noise-alone\` | $(apart 99000 --noise-alone) |"
    echo "| \`trunnion monte-carlo\`, a machine drawn anew, exact lengths | $(apart 9000) |"
    one "$python" monte_carlo.py
}

{
    solvers
    echo
    command
    echo
    trials
    echo
    echo "| unknowns | blocked, ns a row | nalgebra's QR |"
    echo "|---:|---:|---:|"
    one "$binary" unknowns | awk -F, '{ printf "| %d | %s | %s |\n", $1, $2, $3 }'
    echo
    echo "| runs | unknowns | blocked, ns a row | nalgebra's QR |"
    echo "|---:|---:|---:|---:|"
    one "$binary" runs | awk -F, '{ printf "| %d | %d | %s | %s |\n", $1, $2, $3, $4 }'
    echo
    "$python" exact.py strd ../../../tests/reference/strd "$work/strd"
    echo "| set, shifted and scaled | blocked, f64 | nalgebra's QR | NumPy, lstsq |"
    echo "|---|---:|---:|---:|"
    one "$binary" digits "$work/strd" | awk -F, '{ printf "| %s | %s | %s | %s |\n", $1, $2, $3, $4 }'
} >"$output"
