#!/usr/bin/env bash
# Calls from Python beside the same ones in Rust, on one core: the table of README.md. Usage: run.sh PYTHON, one that has the package.
set -euo pipefail
cd "$(dirname "$0")"
python=${1:?a Python with the package}
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 RAYON_NUM_THREADS=1
taskset -c 0 "$python" speed.py
cd ../../..
taskset -c 0 cargo bench --quiet --bench fit -- 'arrays of 36,000' 2>/dev/null | grep -A3 'arrays of'
