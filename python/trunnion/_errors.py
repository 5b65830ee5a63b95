"""What is refused, with where it is wrong."""

from __future__ import annotations


class TrunnionError(ValueError):
    """What is wrong, and what would have been right on the lines below.

    ``file`` and ``line`` (from 1) are where it is wrong, ``row`` (from 0) which pose; None where there is no such place.
    """

    def __init__(self, message: str, file: str | None = None, line: int | None = None, row: int | None = None) -> None:
        super().__init__(message, file, line, row)
        self.file = file
        self.line = line
        self.row = row

    def __str__(self) -> str:
        return str(self.args[0])


class ModelError(TrunnionError):
    """A description that makes no model."""


class DataError(TrunnionError):
    """Arrays or files that are no measurement."""


class EstimateError(TrunnionError):
    """Measurements that give no estimate."""


class FactorError(TrunnionError):
    """A factor that cannot be read or merged."""


class PoseError(TrunnionError):
    """A pose that the parallel machine cannot have."""
