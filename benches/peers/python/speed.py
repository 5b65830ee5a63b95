"""Times of calls from Python, the shortest and the median of many: what README.md has in its table."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

import numpy as np
import trunnion

SAMPLES, POSES = 36_000, 1_000_000


def timed(name: str, call: Callable[[], object], times: int, unit: str, count: int) -> None:
    call()
    seconds = []
    for _ in range(times):
        start = time.perf_counter()
        call()
        seconds.append(time.perf_counter() - start)
    least, median = min(seconds), statistics.median(seconds)
    print(f"| {name} | {1e3 * least:.2f} | {1e3 * median:.2f} | {1e9 * least / count:.0f} a {unit} |")


setup = trunnion.Setup.from_catalogue("tilting-table-a", R=150.0)
runs = setup.simulate(seed=1, samples=SAMPLES).runs
names = list(setup.derive().base)


def matrices() -> tuple[np.ndarray, np.ndarray]:
    """Both runs' rows under each other, columns scaled, and the readings less what is known."""
    rows = np.zeros((len(runs) * SAMPLES, len(names)))
    for at, (run, own) in enumerate(runs.items()):
        columns = [names.index(name) for name in setup.regressors(run)]
        rows[at * SAMPLES : (at + 1) * SAMPLES, columns] = setup.rows(run, own["a_rad"])
    a = runs["tilting"]["a_rad"]
    known = np.cos(a) * runs["tilting"]["dza_mm"] - np.sin(a) * runs["tilting"]["dya_mm"]
    return rows, np.concatenate([runs["tilting"]["dr_mm"] - known, runs["separation"]["dr_mm"]])


rows, readings = matrices()
scale = np.linalg.norm(rows, axis=0)
scaled = rows / scale
fit = setup.fit(runs)
solution = np.linalg.lstsq(scaled, readings)[0] / scale
print("largest difference from numpy.linalg.lstsq, in standard deviations:", np.abs((solution - fit.coefficients) / fit.std).max())

print("\n| call | least, ms | median, ms | ns |\n|---|---:|---:|---|")
timed("`Setup.fit`, arrays", lambda: setup.fit(runs), 40, "sample", 2 * SAMPLES)
timed("`Factor` and `solve`: without a second look", lambda: trunnion.Factor(setup, runs).solve(setup), 40, "sample", 2 * SAMPLES)
timed("`numpy.linalg.lstsq`, matrices ready-made", lambda: np.linalg.lstsq(scaled, readings), 20, "sample", 2 * SAMPLES)
timed("`Setup.rows`, both runs, and lstsq", lambda: np.linalg.lstsq(matrices()[0], readings), 10, "sample", 2 * SAMPLES)

random = np.random.default_rng(1)
points = random.uniform([-200.0, -200.0, -200.0], [200.0, 200.0, -100.0], (POSES, 3))
machine = trunnion.Exechon()
timed("`Exechon.ik`, 1e6 poses in no order", lambda: machine.ik(points), 3, "pose", POSES)
along = points[np.argsort(points[:, 0])]
along[:, 1:] = [0.0, -150.0]
timed("`Exechon.ik`, 1e6 poses along a line", lambda: machine.ik(along), 3, "pose", POSES)
