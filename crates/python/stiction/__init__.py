"""Friction in machine joints: reads Adams Solver datasets, simulates them, computes every FRICTION.

>>> import stiction
>>> model = stiction.load("examples/pendulum/pendulum.adm")
>>> result = model.run(end=1.0, dtout=0.01)
>>> result.success
True
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .diagnostics import (
    ClusterError,
    Diagnostic,
    Diagnostics,
    FolderError,
    InputError,
    OutputError,
    ParameterError,
    StictionError,
    UnknownName,
)
from .model import Element, Friction, Joint, Model, Part, Value, load, loads
from .result import REGIMES, FrictionResult, Interrupted, Result
from .study import Failure, LogUniform, Study, Uniform, sweep
from .units import Quantity

if TYPE_CHECKING:
    from . import laws as laws

__all__ = [
    "REGIMES",
    "ClusterError",
    "Diagnostic",
    "Diagnostics",
    "Element",
    "Failure",
    "FolderError",
    "Friction",
    "FrictionResult",
    "InputError",
    "Interrupted",
    "Joint",
    "LogUniform",
    "Model",
    "OutputError",
    "ParameterError",
    "Part",
    "Quantity",
    "Result",
    "StictionError",
    "Study",
    "Uniform",
    "UnknownName",
    "Value",
    "laws",
    "load",
    "loads",
    "sweep",
]


def __getattr__(name: str) -> object:
    # numpy is loaded only by those who use the laws.
    if name == "laws":
        from importlib import import_module

        return import_module(".laws", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
