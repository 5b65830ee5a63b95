from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import trunnion
from trunnion import DataError, ModelError, PoseError


@pytest.fixture(scope="module")
def machine() -> trunnion.Exechon:
    return trunnion.Exechon()


def test_out_of_reach_is_said_or_left_out(machine) -> None:
    points = np.array([[0.0, 0.0, -100.0], [0.0, 0.0, 1e6], [10.0, 0.0, -100.0]])
    with pytest.raises(PoseError, match="^row 1: ") as refused:
        machine.ik(points)
    assert refused.value.row == 1
    solved = machine.ik(points, unreachable="nan")
    assert np.isnan(solved["struts"]).all(axis=1).tolist() == [False, True, False]
    alone = machine.ik(points[[0, 2]])
    assert np.array_equal(solved["struts"][[0, 2]], alone["struts"])


def test_layouts_and_frames(machine) -> None:
    points = np.array([[0.0, 0.0, -100.0], [50.0, -20.0, -150.0]])
    expected = machine.ik(points)["struts"]
    assert np.array_equal(machine.ik(np.asfortranarray(points))["struts"], expected)
    assert np.array_equal(machine.ik(points.tolist())["struts"], expected)
    assert machine.ik(points[:0])["struts"].shape == (0, 3)
    solved = machine.ik(points)
    base = machine.fk(solved["struts"], solved["a"], solved["c"], frame="base")
    again = machine.ik(base["points"], base["directions"], frame="base")
    assert np.abs(again["struts"] - expected).max() < 1e-7


def test_what_is_no_pose_is_refused(machine, tmp_path: Path) -> None:
    point = [[0.0, 0.0, -100.0]]
    for call, error in [
        (lambda: machine.ik([0.0, 0.0, 0.0]), DataError),
        (lambda: machine.ik(np.zeros((2, 4))), DataError),
        (lambda: machine.ik(point, [[0.0, 0.0, 1.0]] * 2), DataError),
        (lambda: machine.ik(point, [[0.0, 0.0, 2.0]], unreachable="nan"), PoseError),
        (lambda: machine.ik([[np.nan, 0.0, 0.0]], unreachable="nan"), PoseError),
        (lambda: machine.ik(point, frame="world"), ValueError),
        (lambda: machine.ik(point, unreachable="skip"), ValueError),
        (lambda: machine.ik([["a", "b", "c"]]), TypeError),
        (lambda: machine.fk([[1.0, 2.0, 3.0]], [0.0], [0.0, 1.0]), DataError),
        (lambda: machine.fk([[1.0, 2.0, 3.0]], [[0.0]], [0.0]), DataError),
    ]:
        with pytest.raises(error):
            call()
    file = tmp_path / "machine.toml"
    file.write_text("name = 5\n")
    with pytest.raises(ModelError) as refused:
        trunnion.Exechon(file)
    assert (refused.value.file, refused.value.line) == (str(file), 1)
