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
    with pytest.raises(ValueError, match="no report"):
        factor.solve(setup).report()
