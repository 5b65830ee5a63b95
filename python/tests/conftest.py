from __future__ import annotations

import csv
import json
import os
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import trunnion

ROOT = Path(__file__).resolve().parents[2]
RUNS = ("tilting", "separation")


class Command:
    """The command line, built of the same sources."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.program = Path(os.environ.get("TRUNNION", ROOT / "target/release/trunnion"))

    def __call__(self, *arguments: object) -> str:
        words = [self.program, *map(str, arguments)]
        return subprocess.run(words, cwd=self.folder, check=True, capture_output=True, text=True).stdout

    def json(self, *arguments: object) -> Any:
        return json.loads(self(*arguments, "--json"))


@pytest.fixture
def command(tmp_path: Path) -> Command:
    return Command(tmp_path)


@pytest.fixture(scope="session")
def setup() -> trunnion.Setup:
    return trunnion.Setup.from_catalogue("tilting-table-a", R=150.0)


@pytest.fixture(scope="session")
def runs(setup: trunnion.Setup) -> dict[str, dict[str, np.ndarray]]:
    return setup.simulate(seed=3).runs


def columns(file: Path) -> dict[str, np.ndarray]:
    """A CSV file's columns, each number as Python reads it: correctly rounded."""
    with file.open() as lines:
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
