"""Pictures: what they show, with units on their axes."""

from collections.abc import Iterator

import matplotlib
import numpy as np
import pytest
import stiction
from matplotlib import pyplot
from matplotlib.collections import PolyCollection
from models import BLOCK, EXAMPLES

matplotlib.use("Agg")


@pytest.fixture(scope="module")
def result() -> stiction.Result:
    return stiction.loads(BLOCK.replace(", INPUTS=REACTION_FORCE", "")).run(end=1.0, dtout=1e-2)


@pytest.fixture(autouse=True)
def closed() -> Iterator[None]:
    yield
    pyplot.close("all")


def test_friction_over_time(result: stiction.Result) -> None:
    axes = result.plot.friction("guide")
    assert axes.get_ylabel() == "friction force (newton)" and axes.get_xlabel() == "time (sec)"
    np.testing.assert_array_equal(axes.lines[0].get_ydata(), result.friction["guide"].force)
    assert axes.get_title() == "RUB (translational joint GUIDE)"
    legend = axes.get_legend()
    assert legend and [text.get_text() for text in legend.get_texts()] == list(stiction.REGIMES)


def test_regimes_are_bars_from_change_to_change(result: stiction.Result) -> None:
    axes = result.plot.regimes()
    (bars,) = axes.collections
    regime = result.friction["guide"].regime
    changes = 1 + int((np.diff(regime) != 0).sum())
    assert len(bars.get_paths()) == changes
    ends = [path.get_extents() for path in bars.get_paths()]
    assert ends[0].x0 == 0.0 and ends[-1].x1 == 1.0
    assert all(one.x1 == next.x0 for one, next in zip(ends, ends[1:]))
    many = stiction.load(EXAMPLES / "delta-robot" / "delta.acf").run()
    assert len(many.plot.regimes().get_yticks()) == 12
    assert len(many.plot.regimes([111]).get_yticks()) == 1


def test_loops_against_velocity_and_displacement(result: stiction.Result) -> None:
    friction = result.friction["guide"]
    axes = result.plot.loop("guide")
    assert axes.get_xlabel() == "velocity of the surfaces (meter/sec)"
    axes = result.plot.loop("guide", x="displacement")
    assert axes.get_xlabel() == "displacement of the surfaces (meter)"
    along = np.asarray(axes.lines[2].get_xdata())
    # The part moves along z; the sum of trapezoids over 100 outputs is right to their square.
    moved = result["BLOCK_XFORM.Z"][-1] - result["BLOCK_XFORM.Z"][0]
    assert along[-1] == pytest.approx(moved, rel=1e-3) and friction.time is result.time
    with pytest.raises(stiction.ParameterError, match="is velocity meant"):
        result.plot.loop("guide", x="velocty")  # type: ignore[arg-type]


def test_shares_add_up_to_the_friction() -> None:
    # The pull acts 0.1 above the guide, so that it bends it, too.
    bent = BLOCK.replace("MARKER/20, PART=2", "MARKER/20, PART=2\nMARKER/21, PART=2, QP=0, 0.1, 0")
    bent = bent.replace("TRANSLATIONAL, I=20, J=1, ACTIONONLY", "TRANSLATIONAL, I=21, J=1, ACTIONONLY")
    bent = bent.replace(", INPUTS=REACTION_FORCE", ", INITIAL_OVERLAP=0.5")
    result = stiction.loads(bent).run(end=1.0, dtout=1e-2)
    axes = result.plot.shares("guide")
    areas = [area for area in axes.collections if isinstance(area, PolyCollection)]
    assert [area.get_label() for area in areas] == ["reaction", "bending"]
    top = areas[-1].get_paths()[0].get_extents().y1
    assert top == pytest.approx(np.abs(result.friction["guide"].force).max(), rel=1e-9)
    assert axes.get_ylabel() == "friction by cause (newton)"


def test_energy_balance_over_time(result: stiction.Result) -> None:
    axes = result.plot.energy()
    curves = {str(line.get_label()): np.asarray(line.get_ydata()) for line in axes.lines}
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time (sec)", "energy (newton-meter)")
    present = {name for name in curves if not name.startswith("_")}
    assert {"work of forces", "dissipated", "residual"} <= present
    energy = result.energy
    gained = sum(energy[name] - energy[name][0] for name in ("kinetic", "weight", "stored"))
    put_in = energy["work_of_forces"] + energy["work_of_motions"]
    # The residual is that sum; what is left is rounding.
    left = gained + energy["dissipated"] - put_in - energy["residual"]
    assert np.abs(left).max() < 1e-12 * np.abs(put_in).max()
    # 1e-3 is where the solver itself warns of the residual.
    assert np.abs(energy["residual"]).max() < 1e-3 * np.abs(put_in).max()
    assert curves["dissipated"][-1] == result.report["energy_balance"]["dissipated"]


def test_given_axes_are_drawn_into(result: stiction.Result) -> None:
    _, axes = pyplot.subplots(1, 2)
    assert result.plot.friction("guide", ax=axes[0]) is axes[0]
    assert result.plot.energy(ax=axes[1]) is axes[1]
