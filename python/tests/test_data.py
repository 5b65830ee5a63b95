"""Whatever is given: the right numbers, or an exception that says what is wrong."""

from __future__ import annotations

import pickle
from functools import partial
from pathlib import Path

import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pytest

import trunnion
from trunnion import DataError, EstimateError, ModelError, TrunnionError


def pairs(runs: dict[str, dict[str, np.ndarray]]) -> dict[str, object]:
    return {run: (own["a_rad"], own["dr_mm"]) for run, own in runs.items()}


@pytest.mark.parametrize("frame", [pd.DataFrame, pl.DataFrame, pa.table, dict], ids=["pandas", "polars", "pyarrow", "dict"])
def test_frames_are_arrays(setup, runs, frame) -> None:
    expected = setup.fit(runs)
    fit = setup.fit({run: frame(own) for run, own in runs.items()})
    assert np.array_equal(fit.coefficients, expected.coefficients)
    assert np.array_equal(fit.covariance, expected.covariance)


def test_units_are_in_the_names(setup, runs) -> None:
    scaled = {}
    for run, own in runs.items():
        scaled[run] = {"a_deg": np.degrees(own["a_rad"]), "dr_um": own["dr_mm"] * 1e3, "feed": own["dr_mm"] * 0}
        scaled[run] |= {name.replace("mm", "um"): own[name] * 1e3 for name in own if name.startswith("d") and name != "dr_mm"}
    fit, expected = setup.fit(scaled), setup.fit(runs)
    assert np.abs((fit.coefficients - expected.coefficients) / expected.std).max() < 1e-6


def test_any_layout_gives_the_same(setup, runs) -> None:
    runs = pairs(runs)
    expected = setup.fit(runs).coefficients

    def check(of) -> None:
        assert np.array_equal(setup.fit({run: tuple(map(of, pair)) for run, pair in runs.items()}).coefficients, expected)

    def frozen(x):
        x = x.copy()
        x.flags.writeable = False
        return x

    check(frozen)
    check(lambda x: np.repeat(x, 3)[::3])
    check(lambda x: x[::-1].copy()[::-1])
    check(lambda x: x.astype(">f8"))
    check(lambda x: x.astype(np.longdouble))
    check(list)
    check(pd.Series)
    check(pl.Series)
    check(lambda x: np.ma.masked_array(x, mask=False))
    unaligned = np.zeros(8 * 360 + 1, np.uint8)[1:].view(np.float64)

    def odd(x):
        unaligned[:] = x
        return unaligned.copy() if x is None else np.array(unaligned, copy=True)

    check(odd)


def test_what_is_narrower_is_widened(setup, runs) -> None:
    narrow = {run: (own["a_rad"].astype(np.float32), own["dr_mm"].astype(np.float32)) for run, own in runs.items()}
    wide = {run: tuple(x.astype(np.float64) for x in pair) for run, pair in narrow.items()}
    assert np.array_equal(setup.fit(narrow).coefficients, setup.fit(wide).coefficients)
    whole = {run: (np.arange(6), np.zeros(6, int)) for run in setup.runs}
    with pytest.raises(EstimateError, match="6 samples where at least|cannot tell|12 samples"):
        setup.fit(whole)


NAN, FAR = float("nan"), 1e300
BAD = [
    (lambda a, r: (a[:-1], r), DataError, "the reading has 360 values where the sweep has 359"),
    (lambda a, r: (a, r.reshape(2, -1)), DataError, r"shape \[2, 180\]"),
    (lambda a, r: (a, r[0]), DataError, r"shape \[\]"),
    (lambda a, r: (a, r, r), DataError, r"a tuple of 3\n  expected \(sweep_rad, reading_mm\)"),
    (lambda a, r: (a, np.where(np.arange(360) == 7, NAN, r)), DataError, "the reading is NaN at sample 7"),
    (lambda a, r: (a, np.ma.masked_where(np.arange(360) == 9, r)), DataError, "the reading is NaN at sample 9"),
    (lambda a, r: (a, pd.Series(r).mask(np.arange(360) == 5)), DataError, "NaN at sample 5"),
    (lambda a, r: (a, np.full(360, np.inf)), DataError, "the reading is inf at sample 0"),
    (lambda a, r: (a, np.full(360, FAR)), DataError, "beyond the stroke of a ball-bar"),
    (lambda a, r: (np.degrees(a), r), DataError, r"turns at sample 63, .*\n  expected at most 10: is the angle in rad"),
    (lambda a, r: (a, r * 1j), TypeError, "the reading has the type complex128"),
    (lambda a, r: (a, r.astype(str)), TypeError, "has the type <U"),
    (lambda a, r: (a, r.astype(object)), TypeError, "has the type object"),
    (lambda a, r: (a, r.view("M8[ns]")), TypeError, "has the type datetime64"),
    (lambda a, r: (a, None), TypeError, "has the type object"),
    (lambda a, r: 5, TypeError, "neither arrays nor columns"),
    (lambda a, r: a, TypeError, "neither arrays nor columns"),
    (lambda a, r: {"a_deg": a}, DataError, r"no column dr_um or dr_mm\n  found a_deg"),
    (lambda a, r: {"b_deg": a, "dr_um": r}, DataError, "no column a_deg or a_rad"),
    (lambda a, r: {"a_deg": a, "a_rad": a, "dr_um": r}, DataError, "both a_deg and a_rad"),
    (lambda a, r: {"a_rad": a, "dr_mm": r, "dya_um": r[1:]}, DataError, "dya has 359 values"),
    (
        lambda a, r: {"a_rad": a, "dr_mm": r, "dya_um": r, "u_dya_um": r - 1},
        DataError,
        "uncertainty of dya is negative",
    ),
    (lambda a, r: [], DataError, "run `tilting` is not given"),
    (lambda a, r: (a[:3], r[:3]), EstimateError, "cannot tell"),
    (lambda a, r: (a[:0], r[:0]), EstimateError, "cannot tell"),
    (lambda a, r: (a, memoryview(b"x")), DataError, "the reading has 1 values"),
]


@pytest.mark.parametrize("bad", range(len(BAD)))
def test_what_is_no_run_is_refused(setup, runs, bad: int) -> None:
    change, error, message = BAD[bad]
    tilting = runs["tilting"]
    given = {"tilting": change(tilting["a_rad"], tilting["dr_mm"]), "separation": runs["separation"]}
    with pytest.raises(error, match=message) as refused:
        setup.fit(given)
    assert isinstance(refused.value, (TypeError, ValueError))
    # Once more, and the set-up is as it was.
    assert setup.fit(runs).names == setup.fit(pairs(runs)).names


def test_what_is_no_set_of_runs_is_refused(setup, runs) -> None:
    for given, error, message in [
        (5, TypeError, "not a mapping"),
        ({}, DataError, "no run is given"),
        ({"tilting": runs["tilting"]}, DataError, r"`separation` is not given\n.*Setup.subset"),
        ({"other": runs["tilting"]}, DataError, "has no run `other`"),
        ({7: runs["tilting"]}, TypeError, None),
        ({"tilting": runs["tilting"], "separation": "run.csv"}, TypeError, "files and arrays"),
    ]:
        with pytest.raises(error, match=message):
            setup.fit(given)
    for option, error in [
        ({"estimator": "best"}, ValueError),
        ({"weights": {"tilting": 0.0}}, DataError),
        ({"weights": {"other": 1.0}}, DataError),
        ({"weights": {"tilting": NAN}}, DataError),
        ({"sigma_um": -1.0}, ValueError),
        ({"sigma_um": NAN}, ValueError),
        ({"table": "table.csv"}, TypeError),
        ({"columns": {"a": "Angle"}}, TypeError),
        ({"robust": "huber"}, TypeError),
    ]:
        with pytest.raises(error):
            setup.fit(runs, **option)
    for call in [
        lambda: setup.rows("other", [0.0]),
        lambda: setup.rows("tilting", [[0.0]]),
        lambda: setup.simulate(samples=0),
        lambda: setup.simulate(noise_um=NAN),
        lambda: setup.simulate(range_deg=(90.0, 0.0)),
        lambda: setup.simulate(length_um=-1.0),
        lambda: setup.monte_carlo(trials=0),
        lambda: setup.predict(samples=1),
        lambda: setup.positions(),
        lambda: setup.positions(12, within=[1.0]),
        lambda: setup.positions(100_000),
        lambda: setup.positions(12, functions=["other"]),
        lambda: setup.positions(within=[1.0, 2.0]),
        lambda: setup.positions(within=[NAN]),
        lambda: setup.positions(12, step_deg=0.0),
        lambda: setup.subset([]),
        lambda: setup.subset(["other"]),
        lambda: setup.fit(runs).function("other", [0.0]),
        lambda: setup.fit(runs).report(instrument="other"),
        lambda: setup.model.plan(["other"]),
        lambda: setup.model.plan(["eps_xa"], within=[1.0, 2.0]),
        lambda: setup.model.compare(radius=[]),
        lambda: setup.model.compare(radius=[0.15]),
        lambda: setup.model.compare(radius=[NAN]),
        lambda: setup.model.compare(range_deg=[]),
        lambda: setup.model.compare(range_deg=[(90.0, 0.0)]),
        *[
            lambda call=call, ranges=ranges: call(ranges=ranges)
            for call in [setup.model.compare, partial(setup.model.plan, ["eps_xa"]), partial(setup.positions, 12)]
            for ranges in [{"A": (30.0, -30.0)}, {"A": (30.0, 30.0)}, {"A": (NAN, 30.0)}, {"A": (0.0, 2e5)}, {"Q": (0.0, 30.0)}]
        ],
        lambda: setup.model.compare(without=[["other"]]),
        lambda: setup.model.compare(lengths={"R": 150.0}),
        lambda: setup.model.compare(lengths={"Q": 150.0}),
        lambda: setup.model.compare(estimator="best"),
        lambda: setup.model.compare(samples=1),
        lambda: setup.fit(runs).report(instrument={"other": 1.0}),
        lambda: setup.fit(runs).report(instrument={"constant_um": -1.0}),
        lambda: setup.fit(runs).report(instrument={"constant_um": NAN}),
        lambda: setup.fit(runs).report(instrument={"constant_um": "1"}),
        lambda: setup.fit(runs).report(instrument={"preset": 1.0}),
        lambda: setup.fit(runs).report(instrument={"preset": "other"}),
        lambda: trunnion.Setup(setup.model, Q=1.0),
        lambda: trunnion.Setup(setup.model, R=NAN),
        lambda: trunnion.Model.from_catalogue("other"),
    ]:
        with pytest.raises(ValueError):
            call()
    with pytest.raises(OverflowError):
        setup.simulate(samples=-1)
    with pytest.raises(DataError, match=r"no axis `Q`\n  expected one of A, "):
        setup.model.compare(ranges={"Q": (0.0, 30.0)})
    with pytest.raises(ValueError, match=r"ranges\[\"A\"\]: empty"):
        setup.model.compare(ranges={"A": (30.0, -30.0)})
    with pytest.raises(TypeError):
        setup.model.compare(ranges={"A": 30.0})


def test_rows_of_nothing_and_of_not_a_number(setup) -> None:
    assert setup.rows("tilting", []).shape == (0, 10)
    assert np.isnan(setup.rows("tilting", [NAN, 0.0])[0]).any()
    assert np.isfinite(setup.rows("tilting", [NAN, 0.0])[1]).all()


def test_file_and_line_are_kept(setup, tmp_path: Path) -> None:
    run = tmp_path / "run.csv"
    run.write_text("a_deg,dr_um\n" + "".join(f"{a},0.1\n" for a in range(40)) + "40,x\n")
    with pytest.raises(DataError, match="is not a number") as refused:
        setup.fit({"tilting": run, "separation": str(run)})
    assert (refused.value.file, refused.value.line) == (str(run), 42)
    model = tmp_path / "model.toml"
    model.write_text(setup.model.text.replace('rotary = "x"', 'rotary = "q"'))
    with pytest.raises(ModelError) as refused:
        trunnion.Model.from_file(model)
    assert refused.value.file == str(model)
    assert model.read_text().splitlines()[refused.value.line - 1] == 'rotary = "q"'
    again = pickle.loads(pickle.dumps(refused.value))
    assert (type(again), str(again), again.line) == (ModelError, str(refused.value), refused.value.line)
    assert isinstance(again, TrunnionError)
    with pytest.raises(ModelError, match="no such|NotFound|not found") as refused:
        trunnion.Model.from_file(tmp_path / "none.toml")
    assert refused.value.file == str(tmp_path / "none.toml")


def test_several_recordings_of_a_run(setup, runs) -> None:
    twice = {"tilting": [runs["tilting"], runs["tilting"]], "separation": [runs["separation"]]}
    fit = setup.fit(twice)
    residuals = fit.residuals(twice)
    assert [len(residuals[run]) for run in setup.runs] == [2, 1]
    assert len(fit.rms) == 3
    assert np.allclose([np.sqrt(np.mean(e**2)) for own in residuals.values() for e in own], fit.rms)


def test_three_displacements_in_one_frame() -> None:
    setup = trunnion.Setup.from_catalogue("rotary-table-c-rtest")
    runs = setup.simulate(samples=90).runs
    expected = setup.fit(runs)
    stems = {name.rsplit("-", 1)[0] for name in runs}
    joined = {}
    for stem in stems:
        frame = {f"d{end}_mm": runs[f"{stem}-{end}"]["dr_mm"] for end in "xyz"}
        joined[stem] = frame | {"c_rad": runs[f"{stem}-x"]["c_rad"]}
    assert np.array_equal(setup.fit(joined).coefficients, expected.coefficients)


def test_a_subset_and_pickles(setup, runs) -> None:
    alone = setup.subset(["separation"])
    assert alone.runs == ["separation"]
    for own in [setup, alone]:
        again = pickle.loads(pickle.dumps(own))
        assert (again.runs, again.lengths, again.model.text) == (own.runs, own.lengths, own.model.text)
        given = {run: runs[run] for run in own.runs}
        assert np.array_equal(again.fit(given).coefficients, own.fit(given).coefficients)


def test_values_with_their_correlations(setup, runs) -> None:
    import uncertainties

    fit = setup.fit(runs)
    values = dict(zip(fit.names, uncertainties.correlated_values(fit.coefficients, fit.covariance), strict=True))
    difference = values["e_xa1"] - values["e_xa2"]
    of = np.array([1.0, -1.0] + [0.0] * (len(fit.names) - 2))
    assert np.isclose(difference.std_dev, np.sqrt(of @ fit.covariance @ of), rtol=1e-9)
    assert np.allclose(fit.std**2, np.diag(fit.covariance))


def test_the_truth_is_within_the_band(setup) -> None:
    simulated = setup.simulate(seed=1)
    fit = setup.fit(simulated.runs)
    at = np.radians(np.arange(0.0, 360.0, 5.0))
    values, stds = fit.function("eps_xa", at)
    off = values - simulated.function("eps_xa", at)
    assert (np.abs(off) <= 4.0 * stds + 2e-6).all()
    budget = fit.budget("eps_xa", instrument="QC20-W")
    sources = {line["source"]: line["std"] for line in budget["budget"]["lines"]}
    assert sources["instrument"] > 10 * sources["noise"] > 0
    assert fit.rms.shape == (2,)
