"""A fleet on an existing engine: the tests of many machines in Parquet, fitted where they lie.

Each partition makes a factor of the samples that it has of each test (a machine, a date); factors of one test are added up,
which is what the engine does with any sum, and solved.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from operator import add
from pathlib import Path
from typing import Any

import dask.bag
import numpy as np
import pandas as pd

import trunnion

SETUP = trunnion.Setup.from_catalogue("tilting-table-a", R=150.0)
TEST = ["machine", "date"]


def factors(file: Path | str) -> list[tuple[tuple[int, str], trunnion.Factor]]:
    """A factor of each test for the samples of it in this file: some of the runs, or a part of one."""
    tests = pd.read_parquet(file).groupby(TEST, sort=False)
    return [(test, trunnion.Factor(SETUP, dict(list(samples.groupby("run"))))) for test, samples in tests]


def estimates(files: list[Path]) -> dict[tuple[int, str], np.ndarray]:
    """The base parameters of each test, (p,)."""
    sums = dask.bag.from_sequence(files, npartitions=len(files)).map(factors).flatten().foldby(_test, _add, 0, add, 0)
    return {test: factor.solve(SETUP).coefficients for test, factor in sums.compute()}


def _test(item: tuple[Any, trunnion.Factor]) -> Any:
    return item[0]


def _add(total: trunnion.Factor, item: tuple[Any, trunnion.Factor]) -> trunnion.Factor:
    return total + item[1]


def written(folder: Path, machines: int, samples: int, files: int) -> list[Path]:
    """Simulated tests of so many machines, in files that cut them anywhere."""
    tests = []
    for machine in range(machines):
        for run, columns in SETUP.simulate(seed=machine, samples=samples).runs.items():
            own = {"machine": machine, "date": f"2026-{1 + machine % 12:02}-01", "run": run}
            # Of known functions that a run does not see the value is not there, and not asked for.
            tests.append(pd.DataFrame(own | columns))
    whole = pd.concat(tests, ignore_index=True)
    paths = [folder / f"{at:03}.parquet" for at in range(files)]
    for path, rows in zip(paths, np.array_split(np.arange(len(whole)), files), strict=True):
        whole.iloc[rows].to_parquet(path)
    return paths


def main() -> None:
    """Prints how long it takes with one and two workers, and for ten times the data; imports of the first call count."""
    from dask.distributed import Client, LocalCluster

    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--machines", type=int, default=300)
    arguments.add_argument("--samples", type=int, default=2000)
    asked = arguments.parse_args()
    for times in (1, 10):
        with tempfile.TemporaryDirectory() as folder:
            files = written(Path(folder), asked.machines * times, asked.samples, 8 * times)
            size = sum(file.stat().st_size for file in files) / 1e6
            for workers in (1, 2):
                with (
                    LocalCluster(n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
                    Client(cluster) as client,
                ):
                    before = client.run(time.process_time)
                    start = time.perf_counter()
                    found = estimates(files)
                    seconds = time.perf_counter() - start
                    after = client.run(time.process_time)
                    busiest = max(after[worker] - before[worker] for worker in after)
                    told = f"{seconds:.1f} s, {busiest:.1f} s of the busiest worker's processor"
                    print(f"{len(found)} machines, {size:.0f} MB, {workers} workers: {told}", flush=True)


if __name__ == "__main__":
    main()
