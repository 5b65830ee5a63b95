#!/usr/bin/env python3
"""Solves the reference sets of the tilting table at 50 digits, independently of Trunnion; writes solutions.json.

The rows are typed from the paper's equations (7), (9) and (10) with its misprints corrected; k8 stands for the
constant that k8 R and w_z1 make together. Data are taken as the decimals in the files, pi at full precision.

    pip install mpmath==1.4.1 && python solve.py
"""

import csv
import json
from pathlib import Path

from mpmath import betainc, cos, findroot, floor, matrix, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 50
HERE = Path(__file__).parent
DATA = HERE.parent / "reference" / "tilting-table"
SETS = ["full", "r100", "arc220", "exact", "arc90"]
NAMES = ["e_xa1", "e_xa2"] + [f"k{i}" for i in range(1, 12)]
SHARED = ["k1", "k2", "k3", "k4", "k5"]


def columns(file):
    with open(file, newline="") as f:
        return [{k: mpf(v) for k, v in line.items()} for line in csv.DictReader(f)]


def eps_basis(a):
    a -= 2 * pi * floor(a / (2 * pi))  # what closes after a turn is that of the angle less whole turns
    return [a**4 - 2 * pi * a**3 - 2 * pi**2 * a**2 + 4 * pi**3 * a, a**3 - 3 * pi * a**2 + 2 * pi**2 * a]  # (10)


def run1(R, a):
    s, c = sin(a), cos(a)
    f1, f2 = eps_basis(a)
    k = {"k1": R**2 * s**3, "k2": R**3 * s**2 * c**2, "k3": R**2 * s**2 * c, "k4": R * s**2, "k5": R * s * c}
    return {"e_xa1": R * f1, "e_xa2": R * f2, **k, "k6": s, "k7": c, "k8": mpf(1)}  # (7)


def run2(R, a):
    s, c = sin(a), cos(a)
    k = {"k1": R**2 * s**2 * c, "k2": R**3 * s * c**3, "k3": R**2 * s * c**2, "k4": R * s * c, "k5": R * c**2}
    return {**k, "k9": c, "k10": s, "k11": R}  # (9)


def least_squares(rows, y, names):
    """Coefficients, (X'X)^-1 and the residual sum of squares; columns scaled to a norm of one."""
    X = [[row.get(n, mpf(0)) for n in names] for row in rows]
    p = len(names)
    norm = [sqrt(sum(x[j] ** 2 for x in X)) for j in range(p)]
    X = [[v / n for v, n in zip(x, norm)] for x in X]
    A = matrix(p, p)
    b = matrix(p, 1)
    for x, v in zip(X, y):
        for i in range(p):
            b[i] += x[i] * v
            for j in range(p):
                A[i, j] += x[i] * x[j]
    inverse = A**-1
    z = inverse * b
    rss = sum((v - sum(x[j] * z[j] for j in range(p))) ** 2 for x, v in zip(X, y))
    scaled = matrix(p, p)
    for i in range(p):
        for j in range(p):
            scaled[i, j] = inverse[i, j] / norm[i] / norm[j]
    return [z[j] / norm[j] for j in range(p)], scaled, rss


def student_t_95(dof):
    """t with P(|T| > t) = 0.05: the regularised incomplete beta function I_x(dof/2, 1/2), x = dof/(dof + t²)."""
    tail = lambda t: betainc(mpf(dof) / 2, mpf(1) / 2, 0, dof / (dof + t**2), regularized=True) - mpf("0.05")
    return findroot(tail, mpf("1.96"), tol=mpf(10) ** -30)


def joint(R, tilting, separation):
    rows = [run1(R, a) for a, _ in tilting] + [run2(R, a) for a, _ in separation]
    y = [v for _, v in tilting] + [v for _, v in separation]
    z, inverse, rss = least_squares(rows, y, NAMES)
    dof = len(y) - len(NAMES)
    return dict(zip(NAMES, z)), inverse * (rss / dof), NAMES, dof


def two_step(R, tilting, separation):
    first = [*SHARED, "k9", "k10", "k11"]
    k, inverse, rss = least_squares([run2(R, a) for a, _ in separation], [v for _, v in separation], first)
    cov_k = inverse * (rss / (len(separation) - len(first)))
    k = dict(zip(first, k))
    second = ["e_xa1", "e_xa2", "k6", "k7", "k8"]
    rows = [run1(R, a) for a, _ in tilting]
    rest = [v - sum(row[n] * k[n] for n in SHARED) for row, (_, v) in zip(rows, tilting)]
    e, inverse, rss = least_squares(rows, rest, second)
    dof = len(tilting) - len(second)
    # G = -(E'E)^-1 E'K, column by column
    gain = matrix(len(second), len(SHARED))
    for j, n in enumerate(SHARED):
        column, _, _ = least_squares(rows, [-row[n] for row in rows], second)
        for i, v in enumerate(column):
            gain[i, j] = v
    shared = cov_k[: len(SHARED), : len(SHARED)]
    cov_e = inverse * (rss / dof) + gain * shared * gain.T
    names = second + first
    cov = matrix(len(names), len(names))
    for i in range(len(second)):
        for j in range(len(second)):
            cov[i, j] = cov_e[i, j]
    for i in range(len(first)):
        for j in range(len(first)):
            cov[len(second) + i, len(second) + j] = cov_k[i, j]
    return {**k, **dict(zip(second, e))}, cov, names, dof


def digits(x):
    return nstr(x, 25, strip_zeros=False)


def solution(name):
    directory = DATA / name
    R = mpf(json.loads((directory / "truth.json").read_text())["radius_mm"])
    rad = lambda line: line["a_deg"] * pi / 180
    table = {line["a_deg"]: line for line in columns(directory / "table.csv")}
    tilting_lines = columns(directory / "tilting.csv")
    tilting = []
    for line in tilting_lines:
        a, t = rad(line), table[line["a_deg"]]
        tilting.append((a, (line["dr_um"] + t["dya_um"] * sin(a) - t["dza_um"] * cos(a)) / 1000))
    separation_lines = columns(directory / "separation.csv")
    separation = [(rad(line), line["dr_um"] / 1000) for line in separation_lines]
    degrees = [line["a_deg"] for line in tilting_lines]
    points = [5 * i for i in range(-72, 145) if min(degrees) <= 5 * i <= max(degrees)]
    out = {"radius_mm": str(R)}
    for estimator, estimate in [("joint", joint), ("two-step", two_step)]:
        values, cov, names, dof = estimate(R, tilting, separation)
        t = student_t_95(dof)
        at = [names.index("e_xa1"), names.index("e_xa2")]
        coefficients = []
        for n in NAMES:
            i = names.index(n)
            coefficients.append({"name": n, "value": digits(values[n]), "std": digits(sqrt(cov[i, i]))})
        curve = []
        for deg in points:
            g = eps_basis(deg * pi / 180)
            value = sum(g[i] * values[NAMES[i]] for i in range(2)) * 10**6
            variance = sum(g[i] * g[j] * cov[at[i], at[j]] for i in range(2) for j in range(2))
            std = sqrt(abs(variance)) * 10**6
            curve.append({"a_deg": deg, "value": digits(value), "std": digits(std), "u95": digits(t * std)})
        out[estimator] = {"degrees_of_freedom": dof, "coefficients": coefficients, "eps_xa_urad": curve}
    return out


if __name__ == "__main__":
    text = json.dumps({name: solution(name) for name in SETS}, indent=1)
    (HERE / "solutions.json").write_text(text + "\n")
