"""Runs: what they return, how they are stopped, what they refuse."""

import pickle
import signal
import threading
from pathlib import Path

import numpy as np
import pytest
import stiction
from models import BLOCK, EXAMPLES, PENDULUM

LOAD = 2 * 9.81


@pytest.fixture(scope="module")
def pulled() -> stiction.Result:
    return stiction.loads(BLOCK).run(end=1.0, dtout=1e-3)


def test_friction_holds_and_then_slides(pulled: stiction.Result) -> None:
    assert pulled.success and pulled.message == "completed at time 1.0"
    friction = pulled.friction["guide"]
    assert friction.time is pulled.time and len(pulled.time) == 1001
    # Once it slides at many times the transition velocity the friction is the dynamic one, exactly.
    sliding = friction.velocity > 0.01
    assert sliding.sum() > 300
    np.testing.assert_allclose(friction.force[sliding], -0.2 * LOAD, rtol=1e-12)
    np.testing.assert_allclose(friction.mu[sliding], -0.2, rtol=1e-12)
    # From where the pull is at the static limit its excess, 10 N/s on 2 kg, takes the block to the
    # transition velocity within sqrt(2 m Vs/(10 N/s)); outputs are 1 ms apart, and the creep has
    # given way a little before.
    expected = 0.3 * LOAD / 10 + np.sqrt(2 * 2.0 * 0.001 / 10)
    assert friction.time[friction.regime > 0][0] == pytest.approx(expected, abs=2e-3)
    np.testing.assert_allclose(friction.load, LOAD, rtol=1e-12)
    np.testing.assert_array_equal(friction.normal, friction.load)
    rubs = friction.force != 0.0
    np.testing.assert_allclose(friction.share_reaction[rubs], 1.0, rtol=1e-12)
    assert friction.units["force"] == "newton" and friction.units["velocity"] == "meter/sec"


def test_the_work_of_friction_is_what_the_pull_put_in_less_what_moves(
    pulled: stiction.Result,
) -> None:
    friction = pulled.friction["RUB"]
    speed = pulled["BLOCK_XFORM.VZ"]
    power = 10 * pulled.time * speed
    put_in = (0.5 * (power[1:] + power[:-1]) * np.diff(pulled.time)).sum()
    kinetic = 0.5 * 2.0 * speed[-1] ** 2
    # The sum over 1001 outputs of a motion with a kink where it lets go.
    assert friction.work[-1] == pytest.approx(put_in - kinetic, rel=1e-4)


def test_channels_are_views_that_cannot_be_written(pulled: stiction.Result) -> None:
    force = pulled["rub_detail.friction"]
    assert np.shares_memory(force, pulled.values) and not force.flags.writeable
    assert np.shares_memory(force, pulled.friction["RUB"].force)
    assert pulled.units["RUB.FZ"] == "newton"
    assert pulled.channels[0] == "BLOCK_XFORM.X" and len(pulled.channels) == len(pulled.values)
    with pytest.raises(stiction.UnknownName, match="is RUB.FZ .*meant"):
        pulled["rub.fzz"]
    with pytest.raises(stiction.UnknownName, match="is RUB meant"):
        pulled.friction["rubb"]
    with pytest.raises(AttributeError, match="is velocity .*meant"):
        pulled.friction["rub"].velocty  # noqa: B018


def test_results_equal_the_files_of_results(tmp_path: Path) -> None:
    model = stiction.loads(BLOCK)
    result = model.run(end=0.1, steps=10, output=tmp_path / "run")
    names = sorted(path.name for path in (tmp_path / "run").iterdir())
    assert names == ["model.msg", "model.req", "model.res"]
    text = (tmp_path / "run" / "model.res").read_text()
    # The file has the shortest digits that give the same number, as Python writes them.
    values = {float(word) for word in text.split() if word[-1].isdigit() and word[0] in "-0123456789"}
    assert float(result["RUB.FZ"][-1]) in values
    assert "A block that is pulled" in result.log


def test_both_laws_turn_about_a_pin() -> None:
    result = stiction.loads(PENDULUM).run(end=0.5, dtout=0.01)
    pin = result.friction[1]
    assert pin.units["torque"] == "newton-meter" and pin.turns and not pin.slides
    # Friction opposes the motion of the surfaces.
    moving = np.abs(pin.velocity) > 0.01
    assert moving.sum() > 30 and (pin.torque[moving] * pin.velocity[moving] < 0).all()
    with pytest.raises(AttributeError):
        pin.force  # noqa: B018


def test_ball_joints_and_yokes_have_their_channels() -> None:
    delta = stiction.load(EXAMPLES / "delta-robot" / "delta.acf").run()
    ball = next(f for f in delta.friction.values() if f.joint_kind == "SPHERICAL")
    assert (ball.torque >= 0).all() and ball.torque.max() > 0
    hooke = stiction.load(EXAMPLES / "hooke" / "hooke.acf").run()
    for yoke in hooke.friction.values():
        moving = np.abs(yoke.velocity) > 10 * 0.1
        assert (yoke.torque[moving] * yoke.velocity[moving] <= 0).all()


def test_settings_of_the_integrator_are_taken() -> None:
    model = stiction.loads(PENDULUM)
    coarse = model.run(end=1.0, dtout=0.1, error=1e-3)
    fine = model.run(end=1.0, dtout=0.1, error=1e-7)
    assert fine.stats["steps"] > coarse.stats["steps"]
    other = model.run(end=1.0, dtout=0.1, integrator="HHT, ERROR=1E-6")
    assert other.success and other.stats["steps"] != coarse.stats["steps"]
    with pytest.raises(stiction.InputError, match="GSTIF"):
        model.run(end=1.0, integrator="GSTIFFF, ERROR=1E-6")


def test_methods_of_integration_are_chosen_by_name() -> None:
    model = stiction.loads(PENDULUM)
    exact = model.run(end=0.5, dtout=0.1, error=1e-9)
    for name in ("gstiff-si2", "gstiff-i3", "hht", "newmark", "adams"):
        result = model.run(end=0.5, dtout=0.1, error=1e-6, integrator=name)
        assert f"the integrator is {name}" in result.log
        # Of the surfaces, 1 cm from the axis; Newmark's method is of first order with its default GAMMA.
        off = np.abs(result.friction[1].velocity - exact.friction[1].velocity).max()
        assert off < (1e-3 if name == "newmark" else 1e-5), name
    assert "Adams-Moulton" in model.run(end=0.1, dtout=0.1, integrator="Adams").log
    # An argument of the statement alone is not the name of a method.
    assert "using BDF I3" in model.run(end=0.1, dtout=0.1, integrator="I3").log
    with pytest.raises(stiction.UnknownName, match="is adams meant"):
        model.run(end=0.1, integrator="adms")


def test_how_accurate_a_run_is_comes_with_it() -> None:
    model = stiction.loads(PENDULUM)
    alone = model.run(end=1.0, dtout=0.01, check_accuracy=False)
    assert alone.accuracy is None
    checked = model.run(end=1.0, dtout=0.01)
    np.testing.assert_array_equal(checked.values, alone.values)
    accuracy = checked.accuracy
    assert accuracy is not None and checked.options["check_accuracy"]
    assert accuracy["outputs"] == 100 and accuracy["second_failure"] is None
    estimate = accuracy["distance"]["estimate"]
    assert 0.0 < estimate == 2 * accuracy["distance"]["difference"]
    far = model.run(end=4.0, dtout=0.01, integrator="NEWMARK, ERROR=1e-5")
    assert far.success and far.accuracy is not None and not far.accuracy["accurate"]
    assert "beyond 100 ERROR" in repr(far) and "beyond" not in repr(checked)
    [warning] = [said for said in far.diagnostics if said.code == "inaccurate"]
    assert "less accurate than 100 ERROR: PART/2" in warning.message


def test_reactions_of_redundant_constraints_are_shared_where_asked() -> None:
    # A second hinge on the same axis, without friction.
    twice = PENDULUM.replace("\nEND", "\nJOINT/2, REVOLUTE, I=20, J=1\nEND")
    model = stiction.loads(twice)
    kept = model.run(end=0.1, dtout=0.1)
    shared = model.run(end=0.1, dtout=0.1, reactions="least-squares", reaction_length=0.5)
    assert shared.success and "divided by 5.0" in shared.log
    assert "not unique" in kept.log and "not unique" not in shared.log
    with pytest.raises(stiction.ParameterError, match="kept or least-squares"):
        model.run(end=0.1, reactions="least")


def test_a_run_that_fails_tells_and_keeps_its_results() -> None:
    # The second term goes to infinity at 0.5.
    model = stiction.loads(BLOCK).replace({"pull.function": "10*TIME+1E-3/(0.5-TIME)**4"})
    result = model.run(end=1.0, dtout=0.01)
    assert not result.success and result.outcome == "integration failed"
    assert "error" in result.message and 0.4 < result.time[-1] < 0.6


@pytest.mark.parametrize(
    "arguments",
    [
        {},
        {"end": float("nan")},
        {"end": -1.0},
        {"end": 1.0, "dtout": 0.0},
        {"end": 1.0, "steps": 0},
        {"end": 1.0, "steps": 5, "dtout": 0.1},
        {"end": 1.0, "error": float("inf")},
    ],
)
def test_arguments_that_make_no_sense(arguments: dict[str, float]) -> None:
    with pytest.raises(stiction.ParameterError):
        stiction.loads(BLOCK).run(**arguments)  # type: ignore[arg-type]
    commands = stiction.load(EXAMPLES / "incline" / "incline.acf")
    with pytest.raises(stiction.ParameterError, match="command file"):
        commands.run(end=1.0)


def test_a_folder_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError):
        stiction.loads(BLOCK).run(end=0.1, output=tmp_path / "file" / "run")


def test_what_is_not_simulated_is_refused_with_its_place() -> None:
    with_states = BLOCK.replace("INTEGRATOR/", "GSE/1\nINTEGRATOR/")
    with pytest.raises(stiction.InputError) as caught:
        stiction.loads(with_states).run(end=1.0)
    (error,) = (one for one in caught.value.diagnostics if one.severity == "error")
    assert (error.code, error.line, error.column) == ("unsupported-statement", 16, 1)


def test_ctrl_c_stops_a_run_and_keeps_its_results() -> None:
    # Shells start what runs in the background with the signal ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    model = stiction.loads(PENDULUM)
    main = threading.main_thread().ident
    assert main is not None
    timer = threading.Timer(0.5, signal.pthread_kill, (main, signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt) as caught:
            model.run(end=1e5, dtout=0.1)
    finally:
        signal.signal(signal.SIGINT, before)
    assert isinstance(caught.value, stiction.Interrupted)
    result = caught.value.result
    assert result.outcome == "interrupted" and 1 < len(result.time) < 1_000_000
    assert result.time[-1] < 1e5


def test_other_threads_go_on_meanwhile() -> None:
    counted = 0
    stop = threading.Event()

    def count() -> None:
        nonlocal counted
        while not stop.wait(0.001):
            counted += 1

    thread = threading.Thread(target=count, daemon=True)
    thread.start()
    result = stiction.loads(PENDULUM).run(end=1e3, dtout=1.0)
    seen = counted
    stop.set()
    thread.join()
    # With the lock held for the whole run it would have counted once or twice.
    assert result.success and seen > 5


def test_progress_is_told_and_its_errors_stop_the_run(capsys: pytest.CaptureFixture[str]) -> None:
    model = stiction.loads(PENDULUM)
    told: list[tuple[float, float]] = []
    model.run(end=1e3, dtout=1.0, progress=lambda time, end: told.append((time, end)))
    assert told and told == sorted(told) and told[0][1] == 1e3

    def refuse(time: float, end: float) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        model.run(end=1e5, dtout=0.1, progress=refuse)
    model.run(end=1e3, dtout=1.0, progress=True)
    assert "of 1000" in capsys.readouterr().err


def test_results_survive_pickling(pulled: stiction.Result) -> None:
    again = pickle.loads(pickle.dumps(pulled))
    np.testing.assert_array_equal(again.values, pulled.values)
    np.testing.assert_array_equal(again.friction["guide"].force, pulled.friction["guide"].force)
    assert again.message == pulled.message and again.options == pulled.options


def test_notebooks_show_results(pulled: stiction.Result) -> None:
    html = pulled._repr_html_()
    assert "FRICTION/7" in html and "newton" in html
    assert repr(pulled) == f"<Result completed: 1001 outputs of {len(pulled.channels)} channels>"
