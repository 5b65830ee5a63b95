#!/bin/sh
# The same poses by NumPy, SciPy and by this project; needs python3 with venv, and cargo.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet numpy scipy
python3 - > "$work/poses.csv" <<'PY'
import math
print("x_mm,y_mm,z_mm,i,j,k")
r = math.sqrt(0.5)
for k in range(4096):
    t = k / 4096 * math.tau
    x, y, z = 300 * math.cos(t), 200 * math.sin(2 * t) + 100, -150 + 80 * math.sin(3 * t)
    print(f"{x!r},{272.4873734152916 + r * (y + z)!r},{2071.2721983293386 + r * (z - y)!r},0,{r!r},{r!r}")
PY
cd "$here/../../.."
cargo run --quiet --release -- exechon ik --frame base "$work/poses.csv" > "$work/ik.csv"
OMP_NUM_THREADS=1 "$work/venv/bin/python" "$here/solve.py" "$work/poses.csv" "$work/ik.csv"
cargo bench --quiet -p trunnion-solver --bench exechon -- inverse 2>/dev/null | grep -A1 "^exechon/"
