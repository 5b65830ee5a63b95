"""The paper's two steps with NumPy and SciPy on the readings that rust/src/main.rs makes; prints `name;ns;error;kB` like it.
Usage: numpy_scipy.py SAMPLES EXACT"""

import sys
import time
import tracemalloc

import numpy as np
import scipy.linalg

R, PI = 150.0, np.pi
samples = int(sys.argv[1])
exact = np.loadtxt(sys.argv[2])
a = 2 * PI * np.arange(samples) / samples


def reading(run):
    return 0.004 * np.exp(np.sin(a + run)) + 1e-4 * np.sin(997.0 * a * run) + 1e-7 * a * (a - 2 * PI)


def two_step(solve):
    s, c = np.sin(a), np.cos(a)
    second = np.column_stack([R**2 * s**2 * c, R**3 * s * c**3, R**2 * s * c**2, R * s * c, R * c**2, c, s, np.full(samples, R)])
    k = solve(second, y2)
    s, c = np.sin(a), np.cos(a)
    shared = np.column_stack([R**2 * s**3, R**3 * s**2 * c**2, R**2 * s**2 * c, R * s**2, R * s * c])
    own = np.column_stack([R * f1(a), R * f2(a), s, c, np.ones(samples)])
    e = solve(own, y1 - shared @ k[:5])
    return np.array([e[0], e[1], *k[:5], *e[2:], *k[5:]])


def f1(x):
    return x * (x - 2 * PI) * (x * x - 2 * PI**2)


def f2(x):
    return x * (x - PI) * (x - 2 * PI)


def normal_equations(m, y):
    size = np.linalg.norm(m, axis=0)
    m = m / size
    return np.linalg.solve(m.T @ m, m.T @ y) / size


y1, y2 = reading(1.0), reading(2.0)
for name, solve in [
    ("NumPy lstsq", lambda m, y: np.linalg.lstsq(m, y, rcond=None)[0]),
    ("SciPy lstsq (gelsy)", lambda m, y: scipy.linalg.lstsq(m, y, lapack_driver="gelsy")[0]),
    ("NumPy scaled normal equations", normal_equations),
]:
    value = two_step(solve)
    times = []
    for _ in range(25):
        start = time.perf_counter()
        two_step(solve)
        times.append(time.perf_counter() - start)
    error = np.max(np.abs(value / exact - 1))
    tracemalloc.start()
    two_step(solve)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    print(f"{name};{sorted(times)[12] * 1e9 / samples:.1f};{error:.1e};{peak / 1e3:.1f}")
