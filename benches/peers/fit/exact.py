"""What the others are held against: `exact.py paper N` prints the 13 coefficients of both runs in two steps, worked out with 50
digits from the same angles and readings; `exact.py strd SOURCE DIRECTORY` writes NIST's sets with x shifted and scaled, the
solution in the shifted variable with 80 digits, and the digits that NumPy reaches."""

import json
import math
import pathlib
import sys

import mpmath
import numpy as np
from mpmath import mp, mpf

mp.dps = 80


def solve(rows, y):
    """Normal equations, with digits to spare."""
    p = len(rows[0])
    gram, right = mpmath.zeros(p), mpmath.zeros(p, 1)
    for row, value in zip(rows, y):
        for i in range(p):
            right[i] += row[i] * value
            for j in range(i, p):
                gram[i, j] += row[i] * row[j]
    for i in range(p):
        for j in range(i):
            gram[i, j] = gram[j, i]
    return mpmath.lu_solve(gram, right)


def reading(a, run):
    return 0.004 * math.exp(math.sin(a + run)) + 1e-4 * math.sin(997.0 * a * run) + 1e-7 * a * (a - 2 * math.pi)


def paper(samples):
    # The angles and readings as every program has them, in double precision; the rows exactly.
    r, pi = mpf(150), mp.pi
    angles = [2 * math.pi * i / samples for i in range(samples)]
    sines = [(mp.sin(mpf(a)), mp.cos(mpf(a))) for a in angles]
    second = [[r * s * r * s * c, r**3 * s * c**3, r * r * s * c * c, r * s * c, r * c * c, c, s, r] for s, c in sines]
    k = solve(second, [mpf(reading(a, 2.0)) for a in angles])
    rest, own = [], []
    for a, (s, c) in zip(angles, sines):
        x = mpf(a)
        shared = [r * r * s**3, r**3 * s * s * c * c, r * r * s * s * c, r * s * s, r * s * c]
        rest.append(mpf(reading(a, 1.0)) - sum(x * y for x, y in zip(shared, k)))
        f1 = x * (x - 2 * pi) * (x * x - 2 * pi**2)
        f2 = x * (x - pi) * (x - 2 * pi)
        own.append([r * f1, r * f2, s, c, mpf(1)])
    e = solve(own, rest)
    for value in [e[0], e[1], *k[:5], e[2], e[3], e[4], *k[5:]]:
        print(mpmath.nstr(value, 20))


def strd(source, directory):
    pathlib.Path(directory).mkdir(parents=True, exist_ok=True)
    for file in sorted(pathlib.Path(source).glob("*.json")):
        data = json.loads(file.read_text())
        x, y = np.array(data["x"], float), np.array(data["y"], float)
        polynomial = data["model"]["type"] == "polynomial"
        intercept = polynomial or data["model"]["intercept"]
        low, high = x.min(axis=0), x.max(axis=0)
        middle, half = ((low + high) / 2, (high - low) / 2) if intercept else (0 * low, np.maximum(abs(low), abs(high)))
        t = (x - middle) / 2.0 ** np.ceil(np.log2(half))
        count = len(data["certified"]["coef"])
        if polynomial:
            rows = np.column_stack([t[:, 0] ** j for j in range(count)])
        else:
            rows = np.column_stack([*([np.ones(len(y))] if intercept else []), *t.T])
        # Powers are rounded: the solution is that of these rows.
        exact = solve([[mpf(v) for v in row] for row in rows], [mpf(v) for v in y])
        exact = [float(v) for v in exact]
        fitted = np.linalg.lstsq(rows, y, rcond=1e-300)[0]
        error = [abs(v - e) / (abs(e) or 1.0) for v, e in zip(fitted, exact)]
        numpy = min(15.0, -math.log10(max(*error, 1e-15))) if len(error) > 1 else min(15.0, -math.log10(max(error[0], 1e-15)))
        written = {"rows": rows.tolist(), "y": y.tolist(), "exact": exact, "numpy": numpy}
        (pathlib.Path(directory) / file.name).write_text(json.dumps(written))


if sys.argv[1] == "paper":
    paper(int(sys.argv[2]))
else:
    strd(*sys.argv[2:])
