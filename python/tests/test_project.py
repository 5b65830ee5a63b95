"""A project in Python is the one of the command line: the same model, runs, fit, to the last bit."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import RUNS, Command, columns

import trunnion
from trunnion import DataError, ModelError


@pytest.fixture
def bench(command: Command) -> Command:
    command("simulate", "tilting-table-a", "--radius", 100, "--seed", 7, "--samples", 500, "--out", "bench/data")
    return command


def project(bench: Command, **changes: str) -> Path:
    """A project with sections changed, one for each name."""
    sections = {
        "model": 'model = "tilting-table-a"',
        "machine": '[machine]\nname = "Bench"\nserial = "7"',
        "lengths": "[lengths]\nR_mm = 100",
        "instrument": '[instrument]\npreset = "QC20-W"',
        "limits": "[limits]\nlength_um = 20\nangle_urad = 50",
        "fit": '[fit]\ntable = "data/table.csv"',
        "tilting": '[run.tilting]\nfiles = ["data/tilting.csv"]\nweight = 2',
        "separation": '[run.separation]\nfiles = ["data/separation.csv"]',
    }
    file = bench.folder / "bench/trunnion.toml"
    file.write_text("\n\n".join((sections | changes).values()) + "\n")
    return file


def fitted(bench: Command, *options: object) -> dict[str, Any]:
    printed = bench.json("fit", "bench", *options)
    del printed["made"]
    return printed


def test_its_fit_is_that_of_the_command(bench: Command) -> None:
    file = project(bench)
    own = trunnion.Project(file.parent)
    assert trunnion.Project(file).runs == own.runs == {run: [bench.folder / f"bench/data/{run}.csv"] for run in RUNS}
    assert own.machine == {"name": "Bench", "serial": "7"}
    assert (own.estimator, own.robust, own.weights) == ("joint", False, {"tilting": 2.0})
    assert own.table == bench.folder / "bench/data/table.csv"
    assert own.setup.lengths["R"] == 100.0
    fit = own.fit()
    expected = fitted(bench)
    assert expected["machine"]["serial"] == "7" and expected["instrument"]["name"] == "QC20-W"
    assert fit.report() == expected
    assert [c["value"] for c in expected["coefficients"]] == fit.coefficients.tolist()


def test_what_is_given_stands_in_for_its_own(bench: Command) -> None:
    own = trunnion.Project(project(bench))
    options = ["--estimator", "two-step", "--robust", "huber", "--weight", "separation=3"]
    fit = own.fit(estimator="two-step", robust=True, weights={"separation": 3.0})
    assert fit.report() == fitted(bench, *options)
    given = ["--instrument-um", 0.5, "--instrument-share", 0.001, "--bar-length-um", 1, "--length-um", 10]
    values = {"constant_um": 0.5, "proportional": 0.001, "bar_length_um": 1.0}
    assert own.fit().report(instrument=values, length_um=10.0) == fitted(bench, *given)
    other = trunnion.Project(project(bench, instrument=""))
    assert other.fit().report(instrument="QC20-W") == fitted(bench, "--instrument", "QC20-W")
    assert other.fit().report(instrument={"preset": "QC20-W", "noise_um": 1.0}) == fitted(
        bench, "--instrument", "QC20-W", "--instrument-noise-um", 1
    )
    assert trunnion.Project(project(bench), R=101.0).fit().report() == fitted(bench, "--radius", 101)


def test_a_run_that_was_not_made(bench: Command) -> None:
    file = project(bench, tilting="", fit='[fit]\nestimator = "joint"\nrobust = "huber"')
    own = trunnion.Project(file)
    assert own.setup.runs == ["separation"] and own.setup.model.runs == list(RUNS)
    assert own.fit().report() == fitted(bench)
    assert own.robust and not own.fit(robust=False).report()["weighed_down"]


def test_columns_and_assumptions(bench: Command) -> None:
    for run in RUNS:
        data = bench.folder / f"bench/data/{run}.csv"
        data.write_text(data.read_text().replace("a_deg,dr_um", "Angle [deg],Radius"))
    names = '[columns]\na = "Angle [deg]"\ndr_um = "Radius"\n\n[assume]\ns_xy = "0"'
    own = trunnion.Project(project(bench, columns=names))
    fit = own.fit()
    assert fit.report() == fitted(bench)
    assert fit.report()["machine"]["assumptions"] == ["s_xy = 0"]
    # By hand the same.
    folder = bench.folder / "bench/data"
    files = {run: folder / f"{run}.csv" for run in RUNS}
    called = {"a": "Angle [deg]", "dr_um": "Radius"}
    again = own.setup.fit(files, columns=called, table=folder / "table.csv", weights={"tilting": 2.0})
    assert np.array_equal(again.coefficients, fit.coefficients)
    with pytest.raises(DataError, match="missing column a_deg or a_rad"):
        own.setup.fit(files, table=folder / "table.csv")
    with pytest.raises(DataError, match="expected names for a, dr"):
        own.setup.fit(files, columns={"b": "Angle"})


def test_its_set_up_is_one(bench: Command) -> None:
    own = trunnion.Setup.from_project(project(bench))
    assert own.lengths["R"] == 100.0
    again = pickle.loads(pickle.dumps(own))
    runs = {run: columns(bench.folder / f"bench/data/{run}.csv") for run in RUNS}
    fit = again.fit(runs, weights={"tilting": 2.0})
    assert fit.report()["instrument"]["name"] == "QC20-W"
    assert np.array_equal(fit.coefficients, own.fit(runs, weights={"tilting": 2.0}).coefficients)
    factor = trunnion.Factor(own, runs)
    assert factor.solve(again).report()["limits"] == {"length_um": 20.0, "angle_urad": 50.0}
    assert trunnion.Setup.from_project(project(bench).parent, R=120.0).lengths["R"] == 120.0


def test_what_is_no_project_is_refused(bench: Command) -> None:
    for changes, line, message in [
        ({"limits": "[limitss]"}, "[limitss]", "unknown field"),
        ({"tilting": "[run.tilting]\nfiles = []"}, "files = []", "no file"),
        ({"instrument": '[instrument]\npreset = "X"'}, 'preset = "X"', "QC20-W"),
        ({"model": 'model = "none.toml"'}, None, "no such file"),
    ]:
        with pytest.raises(ModelError, match=message) as refused:
            trunnion.Project(project(bench, **changes))
        if line is not None:
            file = bench.folder / "bench/trunnion.toml"
            assert refused.value.file == str(file)
            assert file.read_text().splitlines()[refused.value.line - 1] == line
    with pytest.raises(ModelError, match="a folder without trunnion.toml"):
        trunnion.Project(bench.folder)
    with pytest.raises(ModelError, match="missing field `model`"):
        (bench.folder / "other.toml").write_text("[fit]\n")
        trunnion.Project(bench.folder / "other.toml")
    with pytest.raises(DataError, match="has no run `other`"):
        trunnion.Project(project(bench, other='[run.other]\nfiles = ["data/tilting.csv"]')).fit()
    with pytest.raises(DataError, match="none.csv"):
        trunnion.Project(project(bench, tilting='[run.tilting]\nfiles = ["none.csv"]')).fit()
    with pytest.raises(DataError, match="no run"):
        trunnion.Project(project(bench, tilting="", separation="")).fit()
    with pytest.raises(ValueError):
        trunnion.Project(project(bench)).fit(weights={"other": 1.0})
