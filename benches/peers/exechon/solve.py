"""The same equations (4), (5) with NumPy and SciPy: time a pose, agreement with the command line.

Usage: solve.py POSES.csv IK.csv   (base coordinates; IK.csv is what `trunnion exechon ik --frame base` gave)
"""

import csv
import sys
import time

import numpy as np
from scipy.optimize import root

XU, YS2, XR, YR5, YCP, ZC, YT, TZ = 450.0, 450.0, 150.0, 150.0, 25.0, 375.0, -30.0, 380.0
HOME = np.array([0.0, 0.0, np.sqrt(1438.0**2 - (XU - XR) ** 2)])
SIGN = -1.0


def axes(p):
    x, y, z = p
    q = np.sqrt(y * y + z * z)
    big = y * y - YS2 * y + z * z
    k1 = np.sqrt(big * big + x * x * q * q)
    return np.array([[big / k1, 0.0, x * q / k1], [-x * y / k1, z / q, y * big / (k1 * q)], [-x * z / k1, -y / q, z * big / (k1 * q)]])


def closure(p, s, t):
    r = axes(p)
    across = r[:, 2] - (r[:, 2] @ t) * t
    y_a = SIGN * across / np.linalg.norm(across)
    return s - p - r @ np.array([0.0, YCP, ZC]) - YT * y_a


def newton(s, t, start):
    """Newton-Raphson with difference quotients."""
    p = start.copy()
    for _ in range(40):
        f = closure(p, s, t)
        jacobian = np.empty((3, 3))
        for k in range(3):
            h = np.zeros(3)
            h[k] = 1e-4
            jacobian[:, k] = (closure(p + h, s, t) - closure(p - h, s, t)) / 2e-4
        step = np.linalg.solve(jacobian, f)
        p -= step
        if np.linalg.norm(step) < 3e-7:
            break
    return p


def struts(p):
    r = axes(p)
    ends = (np.array([-XR, 0, 0]), np.array([0, YR5, 0]), np.array([XR, 0, 0]))
    feet = (np.array([-XU, 0, 0]), np.array([0, YS2, 0]), np.array([XU, 0, 0]))
    return [np.linalg.norm(p + r @ e - f) for e, f in zip(ends, feet)]


def rows(file):
    with open(file, newline="") as handle:
        return [[float(v) for v in row] for row in list(csv.reader(handle))[1:]]


def main():
    poses = np.array(rows(sys.argv[1]))
    ours = np.array(rows(sys.argv[2]))[:, 3:6]
    targets = [(row[:3] - TZ * row[3:], row[3:]) for row in poses]

    def timed(name, solve):
        start, worst, before = HOME, 0.0, time.perf_counter()
        found = []
        for s, t in targets:
            start = solve(s, t, start)
            found.append(start)
        spent = (time.perf_counter() - before) / len(targets)
        worst = max(np.abs(np.array(struts(p)) - l).max() for p, l in zip(found, ours))
        print(f"{name:34} {spent * 1e6:9.1f} us a pose, struts differ by at most {worst:.1e} mm")

    timed("NumPy Newton, previous pose", newton)
    timed("NumPy Newton, from home", lambda s, t, _: newton(s, t, HOME))
    timed("SciPy root (hybr), previous pose", lambda s, t, p: root(closure, p, (s, t), tol=1e-12).x)
    timed("SciPy root (hybr), from home", lambda s, t, _: root(closure, HOME, (s, t), tol=1e-12).x)


main()
