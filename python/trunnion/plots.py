"""Pictures of results with matplotlib, which has to be installed: ``pip install trunnion[plots]``.

Each takes the dict that :meth:`trunnion.Fit.report` gives and returns the axes it has drawn on.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_UNITS = {"urad": "µrad", "um": "µm", "deg": "°", "mm": "mm"}


def function(report: dict[str, Any], name: str, ax: Axes | None = None) -> Axes:
    """An estimated function over its coordinate with its band of 95 %; where it is not determined, the sum S it is seen in."""
    curve = _named(report["functions"], name)
    ax = ax or plt.subplots(layout="constrained")[1]
    key = f"{curve['coordinate']}_{curve['coordinate_unit']}"
    at, value = ([point[column] for point in curve["points"]] for column in (key, "value"))
    half = [point["sum_u95"] for point in curve["points"]]
    low, high = ([v + sign * u for v, u in zip(value, half, strict=True)] for sign in (-1, 1))
    ax.fill_between(at, low, high, alpha=0.25, lw=0, label="95 %")
    ax.plot(at, value, label=name if curve["determined"] else f"S, the sum in which {name} is seen")
    ax.set_xlabel(f"{curve['coordinate']} / {_UNITS[curve['coordinate_unit']]}")
    ax.set_ylabel(f"{name if curve['determined'] else 'S'} / {_UNITS[curve['unit']]}")
    ax.legend()
    return ax


def budget(report: dict[str, Any], name: str, ax: Axes | None = None) -> Axes:
    """The standard uncertainties of a function, source by source, where its uncertainty is largest."""
    curve = _named(report["functions"], name)
    lines = [line for line in curve["largest"]["budget"]["lines"] if line["std"] > 0.0][::-1]
    ax = ax or plt.subplots(layout="constrained")[1]
    ax.barh([line["source"] for line in lines], [line["std"] for line in lines])
    ax.set_xlabel(f"standard uncertainty / {_UNITS[curve['unit']]}")
    return ax


def residuals(report: dict[str, Any], ax: Axes | None = None) -> Axes:
    """The residuals of every recording, averaged over steps of its sweep; ValueError of a factor's report, which has none."""
    if report["recordings"] is None:
        raise ValueError("the report is of a factor, which keeps no residuals\n  expected the report of a fit of arrays or files")
    ax = ax or plt.subplots(layout="constrained")[1]
    for recording in report["recordings"]:
        for way in ("increasing", "decreasing"):
            along = recording[way]
            if along["sweep_deg"]:
                ax.plot(along["sweep_deg"], along["residual_um"], ".", ms=3, label=f"{recording['run']}, {way}")
    ax.set_xlabel("sweep / °")
    ax.set_ylabel("residual / µm")
    ax.legend()
    return ax


def _named(functions: list[dict[str, Any]], name: str) -> dict[str, Any]:
    for own in functions:
        if own["name"] == name:
            return own
    raise KeyError(f"{name!r} is not in the report: expected one of {[own['name'] for own in functions]}")
