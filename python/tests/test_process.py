"""What a process feels of it: nothing leaks, other threads go on."""

from __future__ import annotations

import subprocess
import sys
import threading
import time

import pytest

LOOP = """
import resource
import numpy as np
import trunnion

setup = trunnion.Setup.from_catalogue("tilting-table-a", R=150.0)
runs = setup.simulate(samples=36_000).runs
strided = {run: {name: np.repeat(own, 2)[::2] for name, own in columns.items()} for run, columns in runs.items()}
bad = {run: (columns["a_rad"], np.full(36_000, np.nan)) for run, columns in runs.items()}
machine, points = trunnion.Exechon(), np.tile([0.0, 0.0, -100.0], (36_000, 1))

def once():
    for own in [runs, strided]:
        fit = setup.fit(own)
        fit.coefficients, fit.covariance, fit.residuals(own)
    setup.rows("tilting", runs["tilting"]["a_rad"])
    factor = trunnion.Factor.from_bytes(trunnion.Factor(setup, runs).to_bytes())
    setup.simulate(samples=36_000).runs
    machine.drm(points)
    for call in [lambda: setup.fit(bad), lambda: machine.ik(points * 1e3), lambda: trunnion.Model.from_description("x")]:
        try:
            call()
        except ValueError:
            continue
        raise AssertionError("taken")

once()
pages = int(open("/proc/self/statm").read().split()[0])
# Each round handles some 20 MB: what a round in a hundred would leave is seen.
limit = pages * resource.getpagesize() + 60_000_000
resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
for _ in range(60):
    once()
"""


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_nothing_is_left_behind() -> None:
    done = subprocess.run([sys.executable, "-c", LOOP], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_other_threads_go_on(setup) -> None:
    long = threading.Thread(target=lambda: setup.monte_carlo(trials=3000))
    long.start()
    steps = 0
    while long.is_alive():
        steps += 1
        time.sleep(0.001)
    # Held up until the end, this thread would make one.
    assert steps > 10


def test_threads_share_a_set_up(setup, runs) -> None:
    expected = setup.fit(runs).coefficients.tobytes()
    found: list[bytes] = []
    threads = [threading.Thread(target=lambda: found.append(setup.fit(runs).coefficients.tobytes())) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected] * 8
