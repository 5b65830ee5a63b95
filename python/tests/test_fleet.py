"""The fleet of `examples/fleet.py` on a local cluster of processes gives what one process gives."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "examples"))
import fleet

pytestmark = pytest.mark.filterwarnings("default")


def test_a_cluster_gives_what_one_process_gives(tmp_path: Path) -> None:
    from dask.distributed import Client, LocalCluster

    # 7 files over 2 × 40 runs: cut within tests and within runs.
    files = fleet.written(tmp_path, machines=40, samples=360, files=7)
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        assert len(client.run(lambda: __import__("os").getpid())) == 2
        found = fleet.estimates(files)
    whole = pd.concat(map(pd.read_parquet, files))
    assert set(found) == set(whole.groupby(fleet.TEST).groups)
    for test, samples in whole.groupby(fleet.TEST):
        fit = fleet.SETUP.fit(dict(list(samples.groupby("run"))))
        assert np.abs((found[test] - fit.coefficients) / fit.std).max() < 1e-8, test
        truth = fleet.SETUP.simulate(seed=test[0]).truth
        off = (found[test] - np.array([truth[name] for name in fit.names])) / fit.std
        # Five standard deviations of the noise, and what linearisation leaves.
        assert np.abs(off).max() < 60.0, test
