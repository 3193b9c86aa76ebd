"""Numbers with units, turned into the units of a model."""

from __future__ import annotations

from dataclasses import dataclass

from . import _native
from .names import typed_errors

@dataclass(frozen=True)
class Quantity:
    """A number with its unit, such as ``Quantity(1, "mm/s")`` or ``Quantity(2, "N*m")``.

    Names are those of the UNITS statement in lower case and the usual symbols; ``*``, ``/`` and
    ``**`` join them.
    """

    value: float
    unit: str


def converted(quantity: Quantity, unit: str) -> float:
    """The number of a quantity in another unit.

    >>> converted(Quantity(5.0, "mm/s"), "meter/sec")
    0.005
    """
    with typed_errors():
        return quantity.value * _native.conversion(quantity.unit, unit)
