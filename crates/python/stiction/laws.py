"""The friction laws over numpy arrays, without a model.

Symbols are those of the literature; the keywords of the FRICTION statement stand beside them. Signs
as in results: velocities are those of the I part relative to the J part, forces act on I and oppose the
motion. Any consistent units will do. Arguments broadcast.

>>> import numpy as np
>>> law = LuGre(mu_s=0.3, mu_d=0.25, sigma0=1e4, vs=1e-3)
>>> law.steady_state(np.array([-1.0, 0.0, 1.0]))
array([ 0.25,  0.  , -0.25])
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from .diagnostics import ParameterError

Floats = NDArray[np.float64]


class Stick(NamedTuple):
    """What ORIGINAL gives: the coefficient `mu`, the `regime` (0 stuck, 1 transition, 2 sliding) and
    the `creep` to go on with after the step."""

    mu: Floats
    regime: NDArray[np.int8]
    creep: Floats


class Bristles(NamedTuple):
    """What LuGre gives: `force`, `deflection` of the bristles and its `rate`."""

    force: Floats
    deflection: Floats
    rate: Floats


def _checked(law: object, least: dict[str, tuple[float, bool]]) -> None:
    """Refuses parameters that are not finite or out of their ranges: a bound, and whether the value
    may be equal to it."""
    for field in fields(law):  # type: ignore[arg-type]
        value = getattr(law, field.name)
        if isinstance(value, str):
            continue
        bound, equal = least.get(field.name, (0.0, False))
        if not math.isfinite(value) or value < bound or (value == bound and not equal):
            sign = ">=" if equal else ">"
            message = f"{field.name} must be a finite number {sign} {bound:g}, it is {value}"
            raise ParameterError(message)


def _arrays(**given: ArrayLike) -> tuple[tuple[int, ...], list[bytes]]:
    """Their common shape, and the bytes of each."""
    arrays = {name: np.asarray(value, dtype=np.float64) for name, value in given.items()}
    for name, array in arrays.items():
        if not np.isfinite(array).all():
            raise ParameterError(f"{name} must be finite")
    spread = np.broadcast_arrays(*arrays.values())
    return spread[0].shape, [np.ascontiguousarray(array).tobytes() for array in spread]


def _array(found: bytes, shape: tuple[int, ...]) -> Floats:
    return np.frombuffer(found).reshape(shape)


@dataclass(frozen=True)
class Original:
    """FORMULATION=ORIGINAL, stick and slip by creep; docs/theory/friction.md has the formulas."""

    mu_s: float
    """MU_STATIC."""
    mu_d: float
    """MU_DYNAMIC."""
    vs: float = 0.1
    """STICTION_TRANSITION_VELOCITY, length/time."""
    c: float = 1.5
    """TRANSITION_VELOCITY_COEFFICIENT: sliding is complete at `c vs`."""
    dm: float = 0.01
    """MAX_STICTION_DEFORMATION, length."""
    effect: Literal["all", "stiction", "sliding"] = "all"
    """EFFECT."""

    def __post_init__(self) -> None:
        _checked(self, {"c": (1.0, False)})
        if self.effect not in ("all", "stiction", "sliding"):
            raise ParameterError(f"effect is all, stiction or sliding, not {self.effect!r}")

    def evaluate(self, velocity: ArrayLike, creep: ArrayLike = 0.0) -> Stick:
        """Coefficient, regime and creep at a velocity (length/time) and creep (length) of the
        surfaces. The friction on I is load times the coefficient.

        >>> Original(mu_s=0.3, mu_d=0.2).evaluate([0.5, -0.5]).mu
        array([-0.2,  0.2])
        """
        shape, (v, d) = _arrays(velocity=velocity, creep=creep)
        parameters = (self.mu_s, self.mu_d, self.vs, self.c, self.dm)
        mu, regime, settled = _native.original(parameters, self.effect, v, d)
        regimes = _array(regime, shape).astype(np.int8)
        return Stick(_array(mu, shape), regimes, _array(settled, shape))


@dataclass(frozen=True)
class LuGre:
    """FORMULATION=LUGRE, the bristles of Canudas de Wit, Olsson, Åström and Lischinsky (1995)."""

    mu_s: float
    """MU_STATIC."""
    mu_d: float
    """MU_DYNAMIC."""
    sigma0: float = 1e4
    """BRISTLE_STIFFNESS_COEFFICIENT, force/length."""
    sigma1: float = 1e2
    """DAMPING_COEFFICIENT, force time/length."""
    sigma2: float = 0.0
    """VISCOUS_FRICTION_COEFFICIENT, force time/length."""
    vs: float = 1e-3
    """VELOCITY_THRESHOLD_STRIBECK, length/time."""
    delta: float = 2.0
    """DECAY_EXPONENT_STRIBECK."""

    def __post_init__(self) -> None:
        _checked(self, {"sigma1": (0.0, True), "sigma2": (0.0, True)})

    @property
    def _parameters(self) -> tuple[float, float, float, float, float, float, float]:
        first = (self.mu_s, self.mu_d, self.sigma0, self.sigma1)
        return (*first, self.sigma2, self.vs, self.delta)

    def stribeck(self, speed: ArrayLike) -> Floats:
        """The Stribeck curve ``g(v) = mu_d + (mu_s - mu_d) exp(-(v/vs)^delta)`` at a speed."""
        shape, (v,) = _arrays(speed=np.abs(speed))
        return _array(_native.lugre_stribeck(self._parameters, v), shape)

    def steady_state(
        self, velocity: ArrayLike, load: ArrayLike = 1.0, preload: ArrayLike = 0.0
    ) -> Floats:
        """Friction on I in steady motion, ``-(g(v) N + P) sign(v) - sigma2 v``; zero at rest."""
        v = np.asarray(velocity, dtype=np.float64)
        shape, (_, n, p) = _arrays(velocity=v, load=load, preload=preload)
        level = self.stribeck(v) * _array(n, shape) + _array(p, shape)
        # Adding zero makes the zero at rest plain.
        return np.asarray(-level * np.sign(v) - self.sigma2 * v + 0.0)

    def evaluate(
        self,
        velocity: ArrayLike,
        deflection: ArrayLike = 0.0,
        load: ArrayLike = 1.0,
        preload: ArrayLike = 0.0,
        dt: float = 0.0,
    ) -> Bristles:
        """Friction on I after a step `dt` of the backward Euler formula from a deflection, which is
        stable for every `dt`; with `dt` zero the friction at an instant with that deflection.

        A simulator of its own keeps the deflection: it gives the one of the last step, and takes the
        force and the new one.
        """
        if not (math.isfinite(dt) and dt >= 0.0):
            raise ParameterError(f"dt must be a finite number >= 0, it is {dt}")
        given = {"velocity": velocity, "deflection": deflection, "load": load, "preload": preload}
        shape, (v, z, n, p) = _arrays(**given)
        if (_array(n, shape) < 0.0).any() or (_array(p, shape) < 0.0).any():
            raise ParameterError("load and preload must not be negative")
        force, after, rate = _native.lugre(self._parameters, dt, v, z, n, p)
        return Bristles(_array(force, shape), _array(after, shape), _array(rate, shape))
