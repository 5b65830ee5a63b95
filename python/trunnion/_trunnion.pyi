from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Literal, final

import numpy as np
import numpy.typing as npt

__all__ = ["Derivation", "Exechon", "Factor", "Fit", "Model", "Project", "Setup", "Simulated", "models"]

_Vector = np.ndarray[tuple[int], np.dtype[np.float64]]
_Matrix = np.ndarray[tuple[int, int], np.dtype[np.float64]]
_Path = str | PathLike[str]
# A pair of arrays, a dict of arrays, a frame, the path of a file; a list of them where a run was measured several times.
_Runs = Mapping[str, Any]
_Estimator = Literal["joint", "two-step"]
# A name, or the keys of `[instrument]` in a model file.
_Instrument = str | Mapping[str, str | float]
# How far an axis goes, from and to, degrees or mm, by its name.
_Ranges = Mapping[str, tuple[float, float]]
_Unreachable = Literal["raise", "nan"]
_Frame = Literal["machine", "base"]
_Tilted = Literal["projected", "carried"]

def models() -> list[str]: ...

@final
class Model:
    @staticmethod
    def from_catalogue(name: str) -> Model: ...
    @staticmethod
    def from_file(path: _Path) -> Model: ...
    @staticmethod
    def from_description(description: str | Mapping[str, Any], /, name: str = "description") -> Model: ...
    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def text(self) -> str: ...
    @property
    def runs(self) -> list[str]: ...
    @property
    def lengths(self) -> list[str]: ...
    def derive(self) -> Derivation: ...
    def plan(
        self,
        functions: Sequence[str],
        /,
        *,
        within: Sequence[float] | None = None,
        lengths: Mapping[str, float] | None = None,
        ranges: _Ranges | None = None,
        samples: int = 360,
        noise_um: float = 0.1,
        instrument: _Instrument | None = None,
        length_um: float | None = None,
        angle_urad: float | None = None,
    ) -> dict[str, Any]: ...
    def compare(
        self,
        *,
        radius: Sequence[float] | None = None,
        lengths: Mapping[str, float] | None = None,
        ranges: _Ranges | None = None,
        range_deg: Sequence[tuple[float, float]] | None = None,
        without: Sequence[Sequence[str]] | None = None,
        samples: int = 360,
        noise_um: float = 0.1,
        estimator: _Estimator = "joint",
        length_um: float | None = None,
        angle_urad: float | None = None,
    ) -> dict[str, Any]: ...

@final
class Derivation:
    @property
    def rank(self) -> int: ...
    @property
    def base(self) -> dict[str, str]: ...
    @property
    def kernel(self) -> list[dict[str, str]]: ...
    @property
    def confounded(self) -> list[str]: ...
    @property
    def functions(self) -> dict[str, Literal[True] | str]: ...
    @property
    def unseen(self) -> list[str]: ...
    def text(self) -> str: ...
    def latex(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...
    def source(self, language: Literal["rust", "c", "numpy"]) -> str: ...
    def _repr_latex_(self) -> str: ...

@final
class Setup:
    def __new__(cls, model: Model, /, **lengths: float) -> Setup: ...
    @staticmethod
    def from_catalogue(name: str, /, **lengths: float) -> Setup: ...
    @staticmethod
    def from_file(path: _Path, /, **lengths: float) -> Setup: ...
    @staticmethod
    def from_project(path: _Path, /, **lengths: float) -> Setup: ...
    @staticmethod
    def from_description(description: str | Mapping[str, Any], /, **lengths: float) -> Setup: ...
    @property
    def model(self) -> Model: ...
    @property
    def lengths(self) -> dict[str, float]: ...
    @property
    def runs(self) -> list[str]: ...
    @property
    def functions(self) -> list[str]: ...
    def derive(self) -> Derivation: ...
    def subset(self, runs: Sequence[str]) -> Setup: ...
    def regressors(self, run: str) -> list[str]: ...
    def known(self, run: str) -> list[str]: ...
    def rows(self, run: str, sweeps: npt.ArrayLike) -> _Matrix: ...
    def simulate(
        self,
        *,
        seed: int = 1,
        samples: int = 360,
        noise_um: float = 0.1,
        range_deg: tuple[float, float] | None = None,
        length_um: float | None = None,
        angle_urad: float | None = None,
    ) -> Simulated: ...
    def fit(
        self,
        runs: _Runs,
        /,
        *,
        table: _Path | None = None,
        columns: Mapping[str, str] | None = None,
        estimator: _Estimator = "joint",
        robust: bool = False,
        weights: Mapping[str, float] | None = None,
        sigma_um: float | None = None,
    ) -> Fit: ...
    def predict(
        self,
        *,
        samples: int = 360,
        noise_um: float = 0.1,
        range_deg: tuple[float, float] | None = None,
        estimator: _Estimator = "joint",
    ) -> dict[str, Any]: ...
    def positions(
        self,
        count: int | None = None,
        *,
        in_all: bool = False,
        functions: Sequence[str] | None = None,
        within: Sequence[float] | None = None,
        ranges: _Ranges | None = None,
        step_deg: float = 5.0,
        noise_um: float = 0.1,
    ) -> dict[str, Any]: ...
    def monte_carlo(
        self,
        *,
        trials: int = 2000,
        estimator: _Estimator = "joint",
        noise_alone: bool = False,
        seed: int = 1,
        samples: int = 360,
        noise_um: float = 0.1,
        range_deg: tuple[float, float] | None = None,
        length_um: float | None = None,
        angle_urad: float | None = None,
    ) -> list[dict[str, Any]]: ...

@final
class Project:
    def __new__(cls, path: _Path, /, **lengths: float) -> Project: ...
    @property
    def setup(self) -> Setup: ...
    @property
    def runs(self) -> dict[str, list[Path]]: ...
    @property
    def table(self) -> Path | None: ...
    @property
    def estimator(self) -> _Estimator: ...
    @property
    def robust(self) -> bool: ...
    @property
    def weights(self) -> dict[str, float]: ...
    @property
    def machine(self) -> dict[str, str]: ...
    def fit(
        self,
        *,
        estimator: _Estimator | None = None,
        robust: bool | None = None,
        weights: Mapping[str, float] | None = None,
        sigma_um: float | None = None,
    ) -> Fit: ...

@final
class Simulated:
    @property
    def runs(self) -> dict[str, dict[str, _Vector]]: ...
    @property
    def truth(self) -> dict[str, float]: ...
    def function(self, name: str, at: npt.ArrayLike) -> _Vector: ...

@final
class Fit:
    @property
    def estimator(self) -> _Estimator: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def definitions(self) -> list[str]: ...
    @property
    def units(self) -> list[str]: ...
    @property
    def coefficients(self) -> _Vector: ...
    @property
    def covariance(self) -> _Matrix: ...
    @property
    def std(self) -> _Vector: ...
    @property
    def degrees_of_freedom(self) -> int: ...
    @property
    def condition(self) -> float: ...
    @property
    def rms(self) -> _Vector: ...
    @property
    def of_factor(self) -> bool: ...
    @property
    def functions(self) -> dict[str, str]: ...
    def function(self, name: str, at: npt.ArrayLike) -> tuple[_Vector, _Vector]: ...
    def residuals(self, runs: _Runs) -> dict[str, list[_Vector]]: ...
    def report(
        self, *, instrument: _Instrument | None = None, length_um: float | None = None, angle_urad: float | None = None
    ) -> dict[str, Any]: ...
    def budget(
        self,
        function: str,
        /,
        *,
        instrument: _Instrument | None = None,
        length_um: float | None = None,
        angle_urad: float | None = None,
    ) -> dict[str, Any] | None: ...

@final
class Factor:
    def __new__(
        cls,
        setup: Setup,
        runs: _Runs | None = None,
        /,
        *,
        estimator: _Estimator = "joint",
        weights: Mapping[str, float] | None = None,
    ) -> Factor: ...
    @staticmethod
    def from_bytes(bytes: bytes) -> Factor: ...
    def to_bytes(self) -> bytes: ...
    @property
    def samples(self) -> int: ...
    @property
    def estimator(self) -> _Estimator: ...
    def push(self, setup: Setup, runs: _Runs, *, weights: Mapping[str, float] | None = None) -> None: ...
    def solve(self, setup: Setup, /, *, sigma_um: float | None = None) -> Fit: ...
    def merge(self, other: Factor) -> None: ...
    def __add__(self, other: Factor, /) -> Factor: ...
    def __radd__(self, zero: Literal[0], /) -> Factor: ...

@final
class Exechon:
    def __new__(cls, file: _Path | None = None) -> Exechon: ...
    def ik(
        self,
        points: npt.ArrayLike,
        directions: npt.ArrayLike | None = None,
        *,
        frame: _Frame = "machine",
        tilted: _Tilted = "projected",
        unreachable: _Unreachable = "raise",
    ) -> dict[str, npt.NDArray[np.float64]]: ...
    def drm(
        self,
        points: npt.ArrayLike,
        directions: npt.ArrayLike | None = None,
        *,
        frame: _Frame = "machine",
        tilted: _Tilted = "projected",
        unreachable: _Unreachable = "raise",
    ) -> _Vector: ...
    def fk(
        self,
        struts: npt.ArrayLike,
        a: npt.ArrayLike,
        c: npt.ArrayLike,
        *,
        frame: _Frame = "machine",
        tilted: _Tilted = "projected",
        unreachable: _Unreachable = "raise",
    ) -> dict[str, npt.NDArray[np.float64]]: ...
