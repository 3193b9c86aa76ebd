"""Pictures of results. Every function takes the Axes to draw into, or makes some, and returns them.

Colours are those of Okabe and Ito, which people with any colour vision tell apart; regimes differ in
lightness, too.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Literal

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Patch

from .diagnostics import ParameterError
from .names import unknown
from .result import REGIMES, FrictionResult, Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_BLUE, _VERMILION, _GREEN, _ORANGE, _SKY, _PURPLE = (
    "#0072B2",
    "#D55E00",
    "#009E73",
    "#E69F00",
    "#56B4E9",
    "#CC79A7",
)
#: Colours of the regimes: stuck dark, transition in between, sliding light.
_REGIMES = (_BLUE, _ORANGE, "#D9D9D9")
_CAUSES = {"preload": _SKY, "reaction": _BLUE, "bending": _ORANGE, "torsion": _VERMILION}


class Plots:
    """The plots of a result: ``result.plot.friction("slide")``."""

    def __init__(self, result: Result) -> None:
        self._result = result

    def friction(self, name: str | int, ax: Axes | None = None) -> Axes:
        """The friction force or torque over time, with its regimes below."""
        friction = self._result.friction[name]
        axes = _axes(ax)
        quantity = _quantity(friction)
        axes.plot(friction.time, friction[quantity], color="black", linewidth=1.2)
        axes.axhline(0.0, color="#808080", linewidth=0.6)
        axes.set_ylabel(f"friction {quantity} ({friction.units[quantity]})")
        self._over_time(axes, friction)
        # A ribbon of 4 % of the height, below the lowest value.
        low, high = axes.get_ylim()
        height = 0.04 * (high - low)
        _ribbon(axes, friction, low - 1.5 * height, height)
        axes.set_ylim(low - 1.5 * height, high)
        _regime_legend(axes)
        return axes

    def regimes(self, names: Iterable[str | int] | None = None, ax: Axes | None = None) -> Axes:
        """When each friction is stuck, in transition or sliding."""
        known = self._result.friction
        chosen = list(known.values()) if names is None else [known[name] for name in names]
        if not chosen:
            raise ParameterError("there is no friction to show")
        axes = _axes(ax, height=1.4 + 0.35 * len(chosen))
        for row, friction in enumerate(chosen):
            _ribbon(axes, friction, row - 0.4, 0.8)
        axes.set_yticks(range(len(chosen)), [friction.name for friction in chosen])
        axes.set_ylim(len(chosen) - 0.4, -0.6)
        axes.spines["left"].set_visible(False)
        axes.tick_params(axis="y", length=0)
        self._over_time(axes)
        _regime_legend(axes)
        return axes

    def loop(
        self,
        name: str | int,
        x: Literal["velocity", "displacement"] = "velocity",
        ax: Axes | None = None,
    ) -> Axes:
        """The friction against the velocity of its surfaces, or how far they have moved."""
        friction = self._result.friction[name]
        quantity = _quantity(friction)
        if x == "velocity":
            along, unit = friction.velocity, friction.units["velocity"]
        elif x == "displacement":
            steps = 0.5 * (friction.velocity[1:] + friction.velocity[:-1]) * np.diff(friction.time)
            along, unit = np.concatenate([[0.0], np.cumsum(steps)]), friction.units["creep"]
        else:
            raise ParameterError(str(unknown("axis", x, ["velocity", "displacement"])))
        axes = _axes(ax)
        axes.axhline(0.0, color="#808080", linewidth=0.6)
        axes.axvline(0.0, color="#808080", linewidth=0.6)
        axes.plot(along, friction[quantity], color=_BLUE, linewidth=1.0)
        axes.plot(along[:1], friction[quantity][:1], "o", color=_BLUE, markersize=5, label="start")
        axes.plot(along[-1:], friction[quantity][-1:], "s", color=_VERMILION, markersize=5, label="end")
        axes.set_xlabel(f"{x} of the surfaces ({unit})")
        axes.set_ylabel(f"friction {quantity} ({friction.units[quantity]})")
        axes.set_title(_title(friction))
        _legend(axes)
        return axes

    def shares(self, name: str | int, ax: Axes | None = None) -> Axes:
        """The friction by its causes over time, one upon the other."""
        friction = self._result.friction[name]
        axes = _axes(ax)
        amounts = {cause: np.abs(friction[f"by_{cause}"]) for cause in _CAUSES}
        # Rounding is no cause.
        least = 1e-9 * max(amount.max() for amount in amounts.values())
        present = {cause: amount for cause, amount in amounts.items() if amount.max() > least}
        axes.stackplot(
            friction.time,
            list(present.values()),
            labels=list(present),
            colors=[_CAUSES[cause] for cause in present],
            edgecolor="white",
            linewidth=0.3,
        )
        axes.set_ylabel(f"friction by cause ({friction.units['by_reaction']})")
        axes.set_ylim(bottom=0.0)
        self._over_time(axes, friction)
        _legend(axes)
        return axes

    def energy(self, ax: Axes | None = None) -> Axes:
        """The energy balance of the run over time: what was put in, where it went, what is left over.

        Curves that would lie on the line at zero are left out, but for the residual.
        """
        energy = self._result.energy
        weight = energy["weight"]
        curves = {
            "work of forces": (energy["work_of_forces"], _GREEN),
            "work of motions": (energy["work_of_motions"], _ORANGE),
            "kinetic": (energy["kinetic"], _BLUE),
            "potential (weight)": (weight - weight[:1], _SKY),
            "stored in creep": (energy["stored"], _PURPLE),
            "dissipated": (energy["dissipated"], _VERMILION),
            "residual": (energy["residual"], "black"),
        }
        sizes = {name: np.abs(values).max(initial=0.0) for name, (values, _) in curves.items()}
        axes = _axes(ax, height=4.0)
        axes.axhline(0.0, color="#808080", linewidth=0.6)
        for name, (values, colour) in curves.items():
            if name == "residual" or sizes[name] > 1e-3 * max(sizes.values()):
                # The residual below the others.
                order = 1.5 if name == "residual" else 2.0
                axes.plot(
                    self._result.time, values, color=colour, linewidth=1.4, label=name, zorder=order
                )
        axes.set_ylabel(f"energy ({self._result.units['ENERGY_BALANCE.KINETIC']})")
        self._over_time(axes)
        axes.set_title("energy balance: works put in = energies gained + dissipated")
        _legend(axes)
        return axes

    def _over_time(self, axes: Axes, friction: FrictionResult | None = None) -> None:
        time = self._result.time
        if len(time) > 1:
            axes.set_xlim(time[0], time[-1])
        axes.set_xlabel(f"time ({self._result._about['units']['time']})")
        if friction is not None:
            axes.set_title(_title(friction))


def _axes(ax: Axes | None, height: float = 3.6) -> Axes:
    axes = ax if ax is not None else plt.subplots(figsize=(7.2, height), layout="constrained")[1]
    axes.spines[["top", "right"]].set_visible(False)
    return axes


def _quantity(friction: FrictionResult) -> str:
    return "force" if friction.slides else "torque"


def _title(friction: FrictionResult) -> str:
    return f"{friction.name} ({friction.joint_kind.lower()} joint {friction.joint})"


def _ribbon(axes: Axes, friction: FrictionResult, bottom: float, height: float) -> None:
    """The regimes as bars from output to output."""
    time, regime = friction.time, friction.regime
    if len(time) < 2:
        return
    starts = np.flatnonzero(np.diff(regime, prepend=-1.0))
    ends = np.append(starts[1:], len(time) - 1)
    spans = np.column_stack([time[starts], time[ends] - time[starts]])
    colours = [_REGIMES[int(regime[start])] for start in starts]
    axes.broken_barh(list(map(tuple, spans)), (bottom, height), facecolors=colours, linewidth=0)


def _regime_legend(axes: Axes) -> None:
    handles = [Patch(color=colour, label=name) for name, colour in zip(REGIMES, _REGIMES)]
    _legend(axes, handles)


def _legend(axes: Axes, handles: list[Patch] | None = None) -> None:
    """Beside the plot, where it covers nothing."""
    given = {} if handles is None else {"handles": handles}
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, **given)
