"""A trial of a Monte Carlo over noise with NumPy: the rows don't change, so the operator from readings to coefficients is kept."""

import time

import numpy as np

R, SAMPLES, COEFFICIENTS, TRIALS = 150.0, 360, 13, 20_000
rng = np.random.default_rng(1)
operator = np.linalg.pinv(rng.standard_normal((2 * SAMPLES, COEFFICIENTS)))


def alone():
    for _ in range(TRIALS):
        operator @ rng.uniform(-0.1, 0.1, 2 * SAMPLES)


def together():
    for _ in range(TRIALS // 1000):
        operator @ rng.uniform(-0.1, 0.1, (2 * SAMPLES, 1000))


for name, run in [("NumPy, the operator kept, a trial at a time", alone), ("NumPy, the operator kept, 1,000 trials at a time", together)]:
    times = []
    for _ in range(5):
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    print(f"| {name} | {sorted(times)[2] / TRIALS * 1e6:.1f} |")
