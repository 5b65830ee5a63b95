"""Measurement models of multi-axis machine tools: derived exactly, fitted, with uncertainty.

Lengths are in mm and angles in rad wherever a name does not say otherwise (``a_deg``, ``dr_um``, ``noise_um``).
"""

from trunnion._errors import DataError, EstimateError, FactorError, ModelError, PoseError, TrunnionError
from trunnion._trunnion import Derivation, Exechon, Factor, Fit, Model, Project, Setup, Simulated, models

__all__ = [
    "DataError",
    "Derivation",
    "EstimateError",
    "Exechon",
    "Factor",
    "FactorError",
    "Fit",
    "Model",
    "ModelError",
    "PoseError",
    "Project",
    "Setup",
    "Simulated",
    "TrunnionError",
    "models",
]
