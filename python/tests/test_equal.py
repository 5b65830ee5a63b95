"""Results are those of the command line, bit for bit: JSON numbers are read back exactly."""

from __future__ import annotations

import inspect
import json
import math
from typing import Any

import numpy as np
import pytest
from conftest import RUNS, Command, columns

import trunnion


def fitted(command: Command, *options: object) -> dict[str, Any]:
    files = [word for run in RUNS for word in ("--run", f"{run}=data/{run}.csv")]
    printed = command.json("fit", "tilting-table-a", *files, "--table", "data/table.csv", *options)
    # What the command says of itself.
    del printed["made"]
    return printed


@pytest.fixture
def measured(command: Command) -> Command:
    command("simulate", "tilting-table-a", "--seed", 7, "--samples", 500, "--out", "data")
    return command


@pytest.mark.parametrize("estimator", ["joint", "two-step"])
@pytest.mark.parametrize("robust", [False, True])
def test_a_fit_of_files(measured: Command, setup: trunnion.Setup, estimator: str, robust: bool) -> None:
    expected = fitted(measured, "--estimator", estimator, *(["--robust", "huber"] if robust else []))
    files = {run: measured.folder / f"data/{run}.csv" for run in RUNS}
    fit = setup.fit(files, table=measured.folder / "data/table.csv", estimator=estimator, robust=robust)
    assert fit.report() == expected


@pytest.mark.parametrize("estimator", ["joint", "two-step"])
def test_a_fit_of_arrays(measured: Command, setup: trunnion.Setup, estimator: str) -> None:
    expected = fitted(measured, "--estimator", estimator, "--weight", "tilting=2", "--instrument", "QC20-W")
    runs = {run: columns(measured.folder / f"data/{run}.csv") for run in RUNS}
    table = columns(measured.folder / "data/table.csv")
    assert np.array_equal(table["a_deg"], runs["tilting"]["a_deg"])
    runs["tilting"] |= {name: values for name, values in table.items() if name != "a_deg"}
    fit = setup.fit(runs, estimator=estimator, weights={"tilting": 2.0})
    assert fit.report(instrument="QC20-W") == expected
    assert [c["value"] for c in expected["coefficients"]] == fit.coefficients.tolist()
    assert [c["noise_std"] for c in expected["coefficients"]] == fit.std.tolist()
    assert [c["unit"] for c in expected["coefficients"]] == fit.units


def test_a_simulation(measured: Command, setup: trunnion.Setup) -> None:
    truth = json.loads((measured.folder / "data/truth.json").read_text())
    simulated = setup.simulate(seed=7, samples=500)
    assert simulated.truth == {name: truth[name] for name in simulated.truth}
    for run in RUNS:
        written = columns(measured.folder / f"data/{run}.csv")
        # What was computed in mm is written as the nearest decimal in µm.
        assert np.allclose(simulated.runs[run]["dr_mm"], written["dr_um"] / 1e3, rtol=1e-15, atol=1e-18)
        assert np.array_equal(simulated.runs[run]["a_rad"], np.radians(written["a_deg"]))


@pytest.mark.parametrize("name", trunnion.models())
def test_every_derivation(command: Command, name: str) -> None:
    derivation = trunnion.Model.from_catalogue(name).derive()
    assert derivation.to_dict() == json.loads(command("derive", name, "--emit", "json"))
    assert derivation.text() == str(derivation) == command("derive", name)
    assert derivation.latex() == command("derive", name, "--emit", "latex")
    assert derivation.source("numpy") == command("derive", name, "--emit", "numpy")
    assert derivation.source("rust") == command("derive", name, "--emit", "rust")
    assert derivation.source("c") == command("derive", name, "--emit", "c")


@pytest.mark.parametrize("name", trunnion.models())
def test_rows_are_those_of_the_printed_source(name: str) -> None:
    setup = trunnion.Setup.from_catalogue(name)
    module: dict[str, Any] = {}
    exec(setup.model.derive().source("numpy"), module)
    sweeps = np.linspace(-1.0, 4.0, 129)
    for run in setup.runs:
        printed = module[run.replace("-", "_")]
        names = list(inspect.signature(printed).parameters)
        if len(names) != len(setup.lengths) + 1:
            # Takes what an axis does along the sweep as well: `cone`.
            continue
        given = [setup.lengths.get(name, sweeps) for name in names]
        expected, _ = printed(*given)
        rows = setup.rows(run, sweeps)
        assert rows.shape == (129, len(setup.regressors(run))) and rows.flags.f_contiguous
        assert np.allclose(rows, expected.T, rtol=1e-12, atol=1e-12 * np.abs(expected).max())


def test_monte_carlo_and_plan(command: Command, setup: trunnion.Setup) -> None:
    printed = command.json("monte-carlo", "tilting-table-a", "--trials", 50, "--estimator", "two-step", "--seed", 4)
    assert setup.monte_carlo(trials=50, estimator="two-step", seed=4) == printed["studies"]
    printed = command.json("plan", "rotary-table-c", "--for", "ECC", "--within", 2, "--samples", 90)
    assert trunnion.Model.from_catalogue("rotary-table-c").plan(["ECC"], within=[2.0], samples=90) == printed


@pytest.mark.parametrize("name", ["tilting-table-a", "rotary-table-c"])
def test_a_comparison_of_bars_and_ranges(command: Command, name: str) -> None:
    model = trunnion.Model.from_catalogue(name)
    assert model.compare() == command.json("plan", name)
    options = ["--radius", "150,100", "--range-deg=-30:120,0:360", "--samples", 90, "--noise-um", 0.3, "--length-um", 20]
    runs = model.runs
    left_out = ["--without", runs[0], "--without", ",".join(runs)]
    printed = command.json("plan", name, *options, *left_out, "--estimator", "joint")
    own = model.compare(
        radius=[150.0, 100.0],
        range_deg=[(-30.0, 120.0), (0.0, 360.0)],
        without=[[runs[0]], runs],
        samples=90,
        noise_um=0.3,
        length_um=20.0,
    )
    assert own == printed
    assert [plan.get("refused") for plan in own["plans"]].count("no run is left") == 4


def test_ranges_of_axes(command: Command) -> None:
    model = trunnion.Model.from_catalogue("tilting-table-b")
    narrow = {"B": (-30.0, 45.0), "X": (-400.0, 400.0)}
    options = ["--range", "B=-30:45", "--range", "X=-400:400"]
    given = {"radius": [150.0], "range_deg": [(0.0, 360.0)], "samples": 90}
    own = model.compare(**given, ranges=narrow)
    assert own == command.json("plan", "tilting-table-b", *options, "--radius", 150, "--range-deg", "0:360", "--samples", 90)
    # Narrower is worse, of the runs as given and of those that are enough; the model keeps its own.
    wide = model.compare(**given)
    for key, number in [("plans", lambda plan: plan["functions"][0]["largest_u95"]), ("recommended", lambda own: own["best"])]:
        assert number(own[key][0]) > 3.0 * number(wide[key][0])
    assert model.compare(**given, ranges={}) == wide

    printed = command.json("plan", "rotary-table-c", "--for", "ECC", "--samples", 90, "--range", "C=-90:90")
    table = trunnion.Model.from_catalogue("rotary-table-c")
    assert table.plan(["ECC"], samples=90, ranges={"C": (-90.0, 90.0)}) == printed != table.plan(["ECC"], samples=90)

    cradle = trunnion.Setup.from_catalogue("ac-trunnion-probe")
    printed = command.json("plan", "ac-trunnion-probe", "--positions", 8, "--step-deg", 10, "--range", "A=-90:15")
    found = cradle.positions(8, step_deg=10.0, ranges={"A": (-90.0, 15.0)})
    assert found == printed != cradle.positions(8, step_deg=10.0)
    assert max(found["runs"][0]["proposed_deg"] + found["runs"][0]["evenly_deg"]) <= 15.0
    assert [axis["name"] for axis in found["axes"]] == ["A", "C"]


def test_positions(command: Command) -> None:
    setup = trunnion.Setup.from_catalogue("ac-trunnion-probe")
    printed = command.json("plan", "ac-trunnion-probe", "--positions", 20, "--in-all", "--for", "EX0C,EA0C", "--step-deg", 30)
    assert setup.positions(20, in_all=True, functions=["EX0C", "EA0C"], step_deg=30.0) == printed
    printed = command.json("plan", "ac-trunnion-probe", "--positions", "fewest", "--within", 3, "--step-deg", 30)
    assert setup.positions(within=[3.0], step_deg=30.0) == printed


def test_poses(command: Command) -> None:
    random = np.random.default_rng(5)
    points = random.uniform([-200.0, -200.0, -200.0], [200.0, 200.0, -100.0], (200, 3))
    tilt, turn = random.uniform(0.0, 0.2, 200), random.uniform(0.0, 6.0, 200)
    directions = np.column_stack([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)])
    lines = [
        ",".join(map(repr, [*point, *direction])) for point, direction in zip(points.tolist(), directions.tolist(), strict=True)
    ]
    (command.folder / "poses.csv").write_text("\n".join(["x_mm,y_mm,z_mm,i,j,k", *lines]) + "\n")
    (command.folder / "ik.csv").write_text(command("exechon", "ik", "poses.csv"))
    expected = columns(command.folder / "ik.csv")
    machine = trunnion.Exechon()
    solved = machine.ik(points, directions)
    for at, name in enumerate(["l1_mm", "l2_mm", "l3_mm"]):
        assert np.array_equal(solved["struts"][:, at], expected[name])
    for name in ["a", "c", "drm"]:
        assert [math.degrees(x) for x in solved[name]] == expected[f"{name}_deg"].tolist()
    assert np.array_equal(solved["iterations"], expected["iterations"])
    assert np.array_equal(machine.drm(points, directions), solved["drm"])
    again = machine.fk(solved["struts"], solved["a"], solved["c"])
    assert np.abs(again["points"] - points).max() < 1e-8
    assert np.abs(again["directions"] - directions).max() < 1e-11
