"""Results as an xarray Dataset."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import xarray

if TYPE_CHECKING:
    from .result import Result, _Entity

# Variables of three components, by the kind of their entities: dimension, name, components.
_VECTORS = [
    ("Part", "part", "position", ("X", "Y", "Z")),
    ("Part", "part", "angles", ("PSI", "THETA", "PHI")),
    ("Part", "part", "velocity", ("VX", "VY", "VZ")),
    ("Part", "part", "angular_velocity", ("WX", "WY", "WZ")),
    ("Part", "part", "acceleration", ("ACCX", "ACCY", "ACCZ")),
    ("Joint", "joint", "reaction_force", ("FX", "FY", "FZ")),
    ("Joint", "joint", "reaction_torque", ("TX", "TY", "TZ")),
    ("Friction", "friction", "friction_force", ("FX", "FY", "FZ")),
    ("Friction", "friction", "friction_torque", ("TX", "TY", "TZ")),
    ("Friction", "friction", "surface_velocity", ("VX", "VY", "VZ")),
    ("Friction", "friction", "surface_velocity_of_turning", ("WX", "WY", "WZ")),
]

# Channels of every friction.
_SCALARS = [
    "load",
    "mu",
    "creep",
    "regime",
    "power",
    "work",
    "stored",
    "dissipated",
    "share_preload",
    "share_reaction",
    "share_bending",
    "share_torsion",
]


def dataset_of(result: Result) -> xarray.Dataset:
    """Parts, joints and frictions over time."""
    kinds: dict[str, list[_Entity]] = {}
    for entity in result._entities:
        kinds.setdefault(entity.kind, []).append(entity)
    variables: dict[str, Any] = {}
    coordinates: dict[str, Any] = {
        "time": ("time", result.time, {"units": result._about["units"]["time"]}),
        "component": ["x", "y", "z"],
    }
    for kind, dimension, name, components in _VECTORS:
        entities = kinds.get(kind, [])
        if not entities:
            continue
        coordinates[dimension] = [entity.element for entity in entities]
        columns = [[entity.columns[one] for one in components] for entity in entities]
        places = np.array([[column.place for column in three] for three in columns])
        data = np.moveaxis(result.values[places], -1, 0)
        attributes = {"units": columns[0][0].unit}
        variables[name] = (("time", dimension, "component"), data, attributes)
    frictions = list(result.friction.values())
    for name in _SCALARS if frictions else []:
        data = np.stack([friction[name] for friction in frictions], axis=-1)
        # The load of a joint that slides is a force, that of one that turns a torque.
        units = list(dict.fromkeys(friction.units[name] for friction in frictions))
        variables[name] = (("time", "friction"), data, {"units": " or ".join(units)})
    if frictions:
        coordinates["friction_joint"] = ("friction", [friction.joint for friction in frictions])
        loads = [friction.units["load"] for friction in frictions]
        coordinates["friction_load_unit"] = ("friction", loads)
    attributes = {"title": result._about["title"], "model": result.model_checksum}
    return xarray.Dataset(variables, coordinates, attributes)
