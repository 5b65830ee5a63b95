from __future__ import annotations

import copy
import functools
import operator
import pickle

import numpy as np
import pytest

import trunnion
from trunnion import EstimateError, FactorError


def parts(runs, count: int):
    for run, own in runs.items():
        for piece in np.array_split(np.arange(len(own["a_rad"])), count):
            yield {run: {name: values[piece] for name, values in own.items()}}


@pytest.mark.parametrize("estimator", ["joint", "two-step"])
def test_the_sum_of_the_parts_is_the_whole(setup, runs, estimator) -> None:
    expected = setup.fit(runs, estimator=estimator)
    whole = trunnion.Factor(setup, runs, estimator=estimator)
    fit = whole.solve(setup)
    assert np.array_equal(fit.coefficients, expected.coefficients)
    assert np.array_equal(fit.covariance, expected.covariance)
    factors = [trunnion.Factor(setup, part, estimator=estimator) for part in parts(runs, 5)]
    for merged in [sum(factors), functools.reduce(operator.add, reversed(factors))]:
        assert merged.samples == whole.samples == 720
        fit = merged.solve(setup)
        assert np.abs((fit.coefficients - expected.coefficients) / expected.std).max() < 1e-8
        assert fit.degrees_of_freedom == expected.degrees_of_freedom
    merged = trunnion.Factor(setup, estimator=estimator)
    for factor in factors:
        merged.merge(factor)
    assert merged == sum(factors)


def test_it_pickles_and_is_checked(setup, runs) -> None:
    factor = trunnion.Factor(setup, runs)
    for again in [
        pickle.loads(pickle.dumps(factor)),
        copy.deepcopy(factor),
        trunnion.Factor.from_bytes(factor.to_bytes()),
    ]:
        assert again == factor and again.to_bytes() == factor.to_bytes()
        assert np.array_equal(again.solve(setup).coefficients, factor.solve(setup).coefficients)
    whole = factor.to_bytes()
    for at in range(0, len(whole), 7):
        changed = bytearray(whole)
        changed[at] ^= 0x10
        for bad in [bytes(changed), whole[:at]]:
            with pytest.raises(FactorError):
                trunnion.Factor.from_bytes(bad)
    for bad in [b"", b"x", whole + b"\0", b"\0" * 10000]:
        with pytest.raises(FactorError, match="these bytes"):
            trunnion.Factor.from_bytes(bad)
    with pytest.raises(TypeError):
        trunnion.Factor.from_bytes("text")


def test_what_does_not_belong_together_is_refused(setup, runs) -> None:
    factor, before = trunnion.Factor(setup, runs), trunnion.Factor(setup, runs)
    longer = trunnion.Setup.from_catalogue("tilting-table-a", R=100.0)
    for other in [trunnion.Factor(longer, runs), trunnion.Factor(setup, runs, estimator="two-step")]:
        with pytest.raises(FactorError, match="expected factors of one set-up"):
            factor.merge(other)
        with pytest.raises(FactorError):
            factor + other
    with pytest.raises(FactorError):
        factor.solve(longer)
    with pytest.raises(FactorError):
        factor.push(longer, runs)
    with pytest.raises(EstimateError, match="0 samples"):
        trunnion.Factor(setup).solve(setup)
    with pytest.raises(ValueError):
        factor.push(setup, {"tilting": runs["tilting"], "separation": ([0.0], [float("nan")])})
    for wrong in [1, None, "x"]:
        with pytest.raises(TypeError):
            wrong + factor
        with pytest.raises(TypeError):
            factor + wrong
    with pytest.raises(RuntimeError):
        factor.merge(factor)
    assert factor == before


def close(own: object, expected: object, where: str = "") -> None:
    """The same texts, and numbers to a thousandth."""
    if isinstance(expected, dict):
        assert isinstance(own, dict) and own.keys() == expected.keys(), where
        for key in expected:
            close(own[key], expected[key], f"{where}/{key}")
    elif isinstance(expected, list):
        assert isinstance(own, list) and len(own) == len(expected), where
        for at, (one, other) in enumerate(zip(own, expected, strict=True)):
            close(one, other, f"{where}/{at}")
    elif isinstance(expected, float):
        assert own == pytest.approx(expected, rel=1e-3, abs=1e-9), where
    else:
        assert own == expected, where


@pytest.mark.parametrize("estimator", ["joint", "two-step"])
def test_its_report_is_that_of_the_samples(setup, runs, estimator) -> None:
    fit = setup.fit(runs, estimator=estimator)
    expected = fit.report(instrument="QC20-W")
    factor = sum(trunnion.Factor(setup, part, estimator=estimator) for part in parts(runs, 3))
    own = pickle.loads(pickle.dumps(factor)).solve(setup)
    assert own.of_factor and not fit.of_factor
    assert np.allclose(own.rms, fit.rms, rtol=1e-9)
    report = own.report(instrument="QC20-W")
    assert expected.pop("recordings") and report.pop("recordings") is None
    # What nearly cancels says nothing of itself.
    for told in [expected, report]:
        for function in told["functions"]:
            function["largest"]["inputs"] = [row for row in function["largest"]["inputs"] if row["share_percent"] > 0.1]
            function["neglected_terms"] = function["neglected_terms"][:3]
    close(report, expected)
    budget = own.budget("eps_xa", instrument="QC20-W")["budget"]
    assert budget["u95"] == pytest.approx(fit.budget("eps_xa", instrument="QC20-W")["budget"]["u95"], rel=1e-5)


def test_weights_are_those_of_a_fit(setup, runs) -> None:
    weights = {"tilting": 2.0}
    expected = setup.fit(runs, weights=weights)
    factor = trunnion.Factor(setup, weights=weights)
    factor.push(setup, {"tilting": runs["tilting"]}, weights=weights)
    factor.push(setup, {"separation": runs["separation"]})
    for own in [factor, trunnion.Factor(setup, runs, weights=weights)]:
        fit = own.solve(setup)
        assert np.array_equal(fit.coefficients, expected.coefficients)
        budgets = [of.budget("eps_xa")["budget"]["u95"] for of in (fit, expected)]
        assert budgets[0] == pytest.approx(budgets[1], rel=1e-4)
    with pytest.raises(trunnion.DataError, match="weight"):
        trunnion.Factor(setup, runs, weights={"tilting": -1.0})
    # Kept apart: two numbers for one run.
    both = trunnion.Factor(setup, runs) + trunnion.Factor(setup, runs, weights=weights)
    assert both.solve(setup).rms.shape == (3,)
    assert list(both.solve(setup).report()["runs"]) == ["tilting/1", "tilting/2", "separation"]


def test_what_only_samples_tell_is_said(setup, runs) -> None:
    from trunnion import plots

    odd = {run: dict(own) for run, own in runs.items()}
    odd["tilting"]["dr_mm"] = odd["tilting"]["dr_mm"] + 2e-3 * np.sin(9 * odd["tilting"]["a_rad"])
    fit = trunnion.Factor(setup, odd).solve(setup)
    told = [warning for warning in fit.report()["warnings"] if "not noise" in warning]
    assert len(told) == 1 and told[0].endswith("only a fit of the samples tells, not one of a factor")
    with pytest.raises(ValueError, match="keeps no residuals"):
        plots.residuals(fit.report())
    # With the samples at hand there are residuals.
    residuals = fit.residuals(odd)["tilting"][0]
    assert np.isclose(np.sqrt(np.mean(residuals**2)), fit.rms[0])
    bare = {run: (own["a_rad"], own["dr_mm"]) for run, own in runs.items()}
    assert any("no table" in warning for warning in trunnion.Factor(setup, bare).solve(setup).report()["warnings"])
    assert not any("no table" in warning for warning in trunnion.Factor(setup, runs).solve(setup).report()["warnings"])
    with pytest.raises(TypeError, match="robust"):
        trunnion.Factor(setup, runs, robust=True)


def test_its_size_does_not_grow(setup) -> None:
    sizes = [len(trunnion.Factor(setup, setup.simulate(samples=n).runs).to_bytes()) for n in (720, 72_000)]
    assert sizes[0] == sizes[1] < 50_000
