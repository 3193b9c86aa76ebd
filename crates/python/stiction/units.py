"""Numbers with units, turned into the units of a model."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from .diagnostics import ParameterError
from .names import unknown

# Name, powers of force, length and time, size in the SI. Standard gravity, pound and inch are exact
# by definition.
_POUND_FORCE = 0.45359237 * 9.80665
_UNITS: dict[str, tuple[tuple[int, int, int], float]] = {
    name: (powers, size)
    for names, powers, size in [
        ("N newton", (1, 0, 0), 1.0),
        ("mN millinewton", (1, 0, 0), 1e-3),
        ("kN knewton", (1, 0, 0), 1e3),
        ("MN meganewton", (1, 0, 0), 1e6),
        ("cN centinewton", (1, 0, 0), 1e-2),
        ("uN micronewton", (1, 0, 0), 1e-6),
        ("nN nanonewton", (1, 0, 0), 1e-9),
        ("dyn dyne", (1, 0, 0), 1e-5),
        ("kgf kilogram_force kg_force", (1, 0, 0), 9.80665),
        ("lbf pound_force", (1, 0, 0), _POUND_FORCE),
        ("ozf ounce_force", (1, 0, 0), _POUND_FORCE / 16),
        ("kpound_force", (1, 0, 0), 1e3 * _POUND_FORCE),
        ("poundal", (1, 0, 0), 0.45359237 * 0.3048),
        ("m meter", (0, 1, 0), 1.0),
        ("km kilometer", (0, 1, 0), 1e3),
        ("cm centimeter", (0, 1, 0), 1e-2),
        ("mm millimeter", (0, 1, 0), 1e-3),
        ("um micrometer", (0, 1, 0), 1e-6),
        ("nm nanometer", (0, 1, 0), 1e-9),
        ("angstrom", (0, 1, 0), 1e-10),
        ("in inch", (0, 1, 0), 0.0254),
        ("ft foot", (0, 1, 0), 0.3048),
        ("yd yard", (0, 1, 0), 0.9144),
        ("mile", (0, 1, 0), 1609.344),
        ("mils", (0, 1, 0), 2.54e-5),
        ("microinch", (0, 1, 0), 2.54e-8),
        ("s sec second", (0, 0, 1), 1.0),
        ("ms millisec millisecond", (0, 0, 1), 1e-3),
        ("us microsec microsecond", (0, 0, 1), 1e-6),
        ("ns nanosec nanosecond", (0, 0, 1), 1e-9),
        ("min minute", (0, 0, 1), 60.0),
        ("h hr hour", (0, 0, 1), 3600.0),
        ("day", (0, 0, 1), 86400.0),
    ]
    for name in names.split()
}

#: Units of the arguments of FRICTION by their dimension, with those of the model to be put in.
_OF_DIMENSION = {
    "length": "{length}",
    "length/time": "{length}/{time}",
    "force": "{force}",
    "force*length": "{force}*{length}",
    "force/length": "{force}/{length}",
    "force*time/length": "{force}*{time}/{length}",
}

_PARTS = re.compile(r"([*/]?)\s*([A-Za-z_]+)(?:(?:\*\*|\^)(-?\d+))?\s*")


@dataclass(frozen=True)
class Quantity:
    """A number with its unit, such as ``Quantity(1, "mm/s")`` or ``Quantity(2, "N*m")``.

    Names are those of the UNITS statement in lower case and the usual symbols; ``*``, ``/`` and
    ``**`` join them.
    """

    value: float
    unit: str


def of_dimension(dimension: str, units: Mapping[str, str]) -> str:
    """The unit that a dimension has in a model; empty for plain numbers."""
    return _OF_DIMENSION.get(dimension, "").format_map(dict(units))


def converted(quantity: Quantity, unit: str) -> float:
    """The number of a quantity in another unit.

    >>> converted(Quantity(5.0, "mm/s"), "meter/sec")
    0.005
    """
    (powers, size), (wanted, into) = _size(quantity.unit), _size(unit)
    if powers != wanted:
        shown = f"in {unit}" if unit else "a plain number"
        raise ParameterError(f"{quantity.value} {quantity.unit} cannot be given {shown}")
    return quantity.value * (size / into)


def _size(unit: str) -> tuple[tuple[int, int, int], float]:
    """Powers of force, length and time, and the size in the SI."""
    powers, size, place = (0, 0, 0), 1.0, 0
    while place < len(unit):
        found = _PARTS.match(unit, place)
        if not found or (place > 0) != bool(found[1]):
            raise ParameterError(f"{unit!r} is no unit; write it as mm/s or N*m")
        sign, name, power = found.groups()
        if name not in _UNITS:
            raise ParameterError(str(unknown("unit", name, _UNITS)))
        count = int(power or 1) * (-1 if sign == "/" else 1)
        own, factor = _UNITS[name]
        powers = (
            powers[0] + count * own[0],
            powers[1] + count * own[1],
            powers[2] + count * own[2],
        )
        size *= factor**count
        place = found.end()
    return powers, size
