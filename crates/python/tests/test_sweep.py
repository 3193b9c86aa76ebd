"""Studies on one machine: designs, outputs, failures, folders."""

import json
import math
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import duckdb
import numpy as np
import pandas
import pickle
import pyarrow.parquet  # type: ignore[import-untyped]
import pytest
import scipy.stats  # type: ignore[import-untyped]
import stiction
from models import BLOCK

MODEL = stiction.loads(BLOCK)
PEAK = {"peak": "max_abs(guide.force)"}


def sweep(parameters: dict[str, Any], **settings: Any) -> stiction.Study:
    return stiction.sweep(MODEL, parameters, **{"outputs": PEAK, "end": 0.05, "dtout": 0.01, **settings})


def test_a_factorial_has_every_combination_the_last_parameter_first() -> None:
    study = sweep({"guide.mu_static": [0.25, 0.3], "guide.mu_dynamic": np.array([0.1, 0.15, 0.2])})
    assert study["guide.mu_static"].tolist() == [0.25] * 3 + [0.3] * 3
    assert study["guide.mu_dynamic"].tolist() == [0.1, 0.15, 0.2] * 2
    assert study["case"].tolist() == list(range(6)) and study.success
    assert len(set(study["hash"])) == len(set(study["seed"])) == 6


def test_a_list_has_pairs() -> None:
    study = sweep({"guide.mu_static": [0.25, 0.3], "pull.function": ["10*TIME", "20*TIME"]}, design="list")
    assert study["pull.function"].tolist() == ["10*TIME", "20*TIME"]
    # Before it lets go the friction is the pull.
    assert study["peak"] == pytest.approx([0.5, 1.0], rel=0.02)


def test_sobol_points_are_those_of_scipy() -> None:
    """In 64 dimensions: the forces that pull at a block."""
    forces = "".join(
        f"SFORCE/{id}, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=0\n" for id in range(101, 165)
    )
    model = stiction.loads(BLOCK.replace("INTEGRATOR", forces + "INTEGRATOR"))
    study = stiction.sweep(
        model,
        {f"SFORCE/{id}.function": stiction.Uniform(0, 1) for id in range(101, 165)},
        outputs=PEAK,
        design="sobol",
        cases=128,
        end=0.01,
        steps=1,
    )
    expected = scipy.stats.qmc.Sobol(64, scramble=False).random(128)
    found = np.stack([study[name] for name in study.parameters], axis=1)
    np.testing.assert_array_equal(found, expected)


def test_a_latin_hypercube_meets_every_layer_once() -> None:
    parameters = {
        "guide.mu_static": stiction.Uniform(0.25, 0.75),
        "guide.max_stiction_deformation": stiction.LogUniform(0.1, 100, "um"),
    }
    study = sweep(parameters, design="latin_hypercube", cases=40, seed=3)
    layers = 40 * (study["guide.mu_static"] - 0.25) / 0.5
    assert sorted(layers.astype(int)) == list(range(40))
    decades = np.log10(study["guide.max_stiction_deformation"] / 1e-7)
    assert sorted((40 * decades / 3).astype(int)) == list(range(40))
    again = sweep(parameters, design="latin_hypercube", cases=40, seed=3)
    assert columns(again) == columns(study)
    other = sweep(parameters, design="latin_hypercube", cases=40, seed=4)
    assert set(other["hash"]).isdisjoint(study["hash"])


def columns(study: stiction.Study) -> list[tuple[str, str, Any]]:
    """All columns, bit for bit."""
    raw: list[tuple[str, str, Any]] = study._raw[0]
    return raw


def test_the_table_is_the_same_whoever_runs_it(tmp_path: Path) -> None:
    parameters = {"guide.mu_static": np.linspace(0.2, 0.4, 60)}
    studies = [
        sweep(parameters, workers=workers, directory=tmp_path / str(workers)) for workers in (1, 2, 4)
    ]
    assert columns(studies[0]) == columns(studies[1]) == columns(studies[2])
    files = {(tmp_path / str(workers) / "cases.parquet").read_bytes() for workers in (1, 2, 4)}
    assert len(files) == 1


def test_reductions_are_those_of_the_channels() -> None:
    """Each against numpy over the result of the same run, sticks against closed forms: the block of 2 kg
    lets go when the pull of 10 N/s reaches 0.3 * 2 * 9.81 N, at 0.5886 s. It is stuck until it is faster
    than 1 mm/s, which with friction unchanged takes sqrt(2 * 2 kg * 1 mm/s / (10 N/s)) = 0.020 s more."""
    channels = ["guide.force", "guide.velocity", "guide.mu", "guide.creep", "BLOCK_XFORM.VX", "GUIDE.FY", "rub.load"]
    outputs = {
        f"{kind} {channel}": f"{kind}({channel})"
        for kind in ("min", "max", "max_abs", "mean", "last")
        for channel in channels
    }
    more = {"share": "stuck_share(guide)", "longest": "longest_stick(RUB)", "cause": "max(guide.share_reaction)"}
    study = sweep({"guide.mu_static": [0.3]}, outputs={**outputs, **more}, end=1.0, dtout=1e-3, error=1e-7)
    result = MODEL.run(end=1.0, dtout=1e-3, error=1e-7)
    for channel in channels:
        owner, _, name = channel.partition(".")
        values = result[channel] if channel in result else result.friction[owner][name]
        expected = {
            "min": values.min(),
            "max": values.max(),
            "max_abs": np.abs(values).max(),
            "last": values[-1],
            "mean": np.trapezoid(values, result.time) / result.time[-1],
        }
        for kind, value in expected.items():
            assert study[f"{kind} {channel}"][0] == pytest.approx(value, rel=1e-12, abs=1e-300), channel
    # The creep that comes before takes some of the speed ahead.
    assert study["longest"][0] == pytest.approx(0.6086, abs=2e-3)
    assert study["share"][0] == pytest.approx(result.friction["guide"].stuck_time[-1], rel=1e-12)
    assert study["cause"][0] == 1.0
    assert study.units["max_abs guide.force"] == "newton" and study.units["longest"] == "sec"
    assert study.units["mean guide.velocity"] == "meter/sec" and study.units["share"] == ""


def test_functions_see_the_result_of_each_case() -> None:
    seen = []

    def peak(result: stiction.Result) -> float:
        seen.append((result.options["case"], result.options["seed"], result.model_checksum))
        return float(np.abs(result.friction["guide"].force).max())

    study = sweep({"guide.mu_static": [0.25, 0.3, 0.35]}, outputs={**PEAK, "own": peak})
    assert study["own"].tolist() == study["peak"].tolist()
    seen.sort()
    assert [seed for _, seed, _ in seen] == study["seed"].tolist()
    checksums = [MODEL.replace({"guide.mu_static": mu}).checksum for mu in (0.25, 0.3, 0.35)]
    assert [checksum for _, _, checksum in seen] == checksums


def test_cases_that_fail_are_rows() -> None:
    def fails(result: stiction.Result) -> float:
        case = result.options["case"]
        if case == 2:
            raise ValueError("no such luck")
        return math.nan if case == 3 else 1.0

    study = sweep(
        {"guide.mu_static": [0.3, -0.1, 0.31, 0.32, 0.33]}, outputs={**PEAK, "function": fails}
    )
    assert study["success"].tolist() == [True, False, False, False, True] and not study.success
    messages = [failure.message for failure in study.failures]
    assert "MU_STATIC" in messages[0]
    assert messages[1:] == ["output 'function': ValueError: no such luck", "output 'function' is nan"]
    assert study.failures[0].parameters == {"guide.mu_static": -0.1}
    assert np.isnan(study["peak"]).tolist() == [False, True, True, True, False]
    assert study.to_polars()["peak"].null_count() == 3
    assert study.to_pandas()["peak"].isna().sum() == 3
    assert "ValueError" in study._repr_html_() and "1 failed" not in repr(study)


def test_a_run_that_cannot_go_on_is_a_row() -> None:
    """A force that has no value from 0.02 s on, in one of two cases."""
    study = sweep({"pull.function": ["10*TIME", "SQRT(0.02-TIME)"]})
    assert study["success"].tolist() == [True, False]
    assert study["message"][1] and study["peak"][0] > 0


@pytest.mark.parametrize(
    ("parameters", "settings", "error", "message"),
    [
        ({"gide.mu_static": [0.3]}, {}, stiction.UnknownName, "is GUIDE meant"),
        ({"guide.mu_statik": [0.3]}, {}, stiction.InputError, "MU_STATIC"),
        ({"mu_static": [0.3]}, {}, stiction.ParameterError, "names no argument"),
        ({"guide.mu_static": []}, {}, stiction.ParameterError, "no cases"),
        ({"guide.mu_static": [0.3, math.nan]}, {}, stiction.ParameterError, "finite"),
        ({"guide.mu_static": [0.3, math.inf]}, {}, stiction.ParameterError, "finite"),
        ({"guide.mu_static": [-1.0, -2.0]}, {}, stiction.InputError, "MU_STATIC"),
        ({"guide.mu_static": [0.3], "RUB.MU_STATIC": [0.2]}, {}, stiction.ParameterError, "twice"),
        (
            {"guide.max_stiction_deformation": [stiction.Quantity(1, "N")]},
            {},
            stiction.ParameterError,
            "cannot be given in meter",
        ),
        ({"guide.mu_static": stiction.Uniform(0.1, 0.2, "mm")}, {}, stiction.ParameterError, "a plain number"),
        ({"guide.mu_static": stiction.Uniform(0.1, 0.2)}, {}, stiction.ParameterError, "is a range"),
        ({"guide.mu_static": [0.3]}, {"design": "sobol", "cases": 4}, stiction.ParameterError, "takes a range"),
        ({"guide.mu_static": stiction.Uniform(0.3, 0.2)}, {"design": "sobol", "cases": 4}, stiction.ParameterError, "lower end"),
        ({"guide.mu_static": stiction.LogUniform(0, 0.2)}, {"design": "sobol", "cases": 4}, stiction.ParameterError, "above zero"),
        ({"guide.mu_static": stiction.Uniform(0.1, 0.2)}, {"design": "sobol", "cases": 0}, stiction.ParameterError, "no cases"),
        ({"guide.mu_static": stiction.Uniform(0.1, 0.2)}, {"design": "sobol"}, stiction.ParameterError, "number of cases"),
        ({"guide.mu_static": [0.3]}, {"cases": 4}, stiction.ParameterError, "leave their number out"),
        ({"guide.mu_static": [0.3], "guide.mu_dynamic": [0.1, 0.2]}, {"design": "list"}, stiction.ParameterError, "as many values"),
        ({"guide.mu_static": [0.3]}, {"design": "factorail"}, stiction.UnknownName, "is factorial meant"),
        ({"guide.mu_static": [0.3]}, {"outputs": {}}, stiction.ParameterError, "no outputs"),
        ({"guide.mu_static": [0.3]}, {"outputs": {"a": "guide.force"}}, stiction.ParameterError, "no reduction"),
        ({"guide.mu_static": [0.3]}, {"outputs": {"a": "mxa(guide.force)"}}, stiction.UnknownName, "is max meant"),
        ({"guide.mu_static": [0.3]}, {"outputs": {"a": "max(guide.froce)"}}, stiction.UnknownName, "is force meant"),
        ({"guide.mu_static": [0.3]}, {"outputs": {"a": "max(gide.fx)"}}, stiction.UnknownName, "GUIDE.FX"),
        ({"guide.mu_static": [0.3]}, {"outputs": {"a": "stuck_share(pull)"}}, stiction.UnknownName, "RUB"),
        ({"guide.mu_static": [0.3]}, {"outputs": {"Case": "max(guide.force)"}}, stiction.ParameterError, "another name"),
        ({"guide.mu_static": [0.3]}, {"end": None}, stiction.ParameterError, "give the end"),
        ({"guide.mu_static": [0.3]}, {"end": math.nan}, stiction.ParameterError, "positive"),
        ({"guide.mu_static": [0.3]}, {"workers": 0}, stiction.ParameterError, "workers"),
        ({"guide.mu_static": [0.3]}, {"seed": -1}, stiction.ParameterError, "seed"),
    ],
)
def test_what_cannot_be_studied(
    parameters: dict[str, Any], settings: dict[str, Any], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        sweep(parameters, **settings)


def test_the_columns_have_units_and_survive_pickling(tmp_path: Path) -> None:
    study = sweep({"guide.max_stiction_deformation": [stiction.Quantity(10, "um")]}, directory=tmp_path)
    assert study["guide.max_stiction_deformation"][0] == pytest.approx(1e-5, rel=1e-15)
    assert study.to_pandas().attrs["units"]["guide.max_stiction_deformation"] == "meter"
    assert columns(pickle.loads(pickle.dumps(study))) == columns(study)
    assert "(newton)" in study._repr_html_()
    with pytest.raises(stiction.UnknownName, match="is peak meant"):
        study["peek"]
    said = pyarrow.parquet.read_metadata(tmp_path / "cases.parquet").metadata
    assert json.loads(said[b"stiction.units"])["peak"] == "newton"
    assert json.loads(said[b"stiction.study"]) == json.loads((tmp_path / "study.json").read_text())
    frame = pandas.read_parquet(tmp_path / "cases.parquet")
    pandas.testing.assert_frame_equal(frame, study.to_pandas(), check_exact=True, check_dtype=False)
    assert frame["success"].dtype == bool


def test_a_folder_is_resumed_or_refused(tmp_path: Path) -> None:
    parameters = {"guide.mu_static": np.linspace(0.2, 0.4, 20)}
    whole = sweep(parameters, directory=tmp_path / "whole")
    folder = tmp_path / "study"
    with pytest.raises(KeyboardInterrupt):
        # The second look comes long before the end: each case waits a little.
        sweep(parameters, outputs={**PEAK, "slow": slow}, directory=folder, workers=1, progress=interrupts)
    parts = sorted((folder / "parts").iterdir())
    assert parts and all(part.suffix == ".parquet" for part in parts)
    assert not (folder / "cases.parquet").exists()
    done = sum(len(pandas.read_parquet(part)) for part in parts)
    assert 0 < done < 20
    settings: dict[str, Any] = {"outputs": {**PEAK, "slow": slow}, "directory": folder}
    with pytest.raises(stiction.FolderError, match="holds a study already"):
        sweep(parameters, **settings)
    with pytest.raises(stiction.FolderError, match=r"another study \(cases, values differ\)"):
        sweep({"guide.mu_static": [0.3]}, resume=True, **settings)
    SLOW.clear()
    study = sweep(parameters, resume=True, **settings)
    assert len(SLOW) == 20 - done
    assert study["peak"].tolist() == whole["peak"].tolist()
    assert not (folder / "parts").exists() and len(pandas.read_parquet(folder / "cases.parquet")) == 20
    SLOW.clear()
    assert columns(sweep(parameters, resume=True, **settings)) == columns(study) and not SLOW
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "thesis.txt").write_text("two years")
    with pytest.raises(stiction.FolderError, match="thesis.txt"):
        sweep(parameters, directory=tmp_path / "other")


SLOW: list[int] = []


def slow(result: stiction.Result) -> float:
    SLOW.append(result.options["case"])
    time.sleep(0.02)
    return 0.0


def interrupts(done: int, count: int) -> None:
    if done > 2:
        raise KeyboardInterrupt


def test_a_folder_is_used_by_one_study_at_a_time(tmp_path: Path) -> None:
    refused = []

    def another(result: stiction.Result) -> float:
        try:
            sweep({"guide.mu_static": [0.3]}, directory=tmp_path / "study", resume=True)
        except stiction.FolderError as error:
            refused.append(str(error))
        return 0.0

    sweep({"guide.mu_static": [0.3]}, outputs={"a": another}, directory=tmp_path / "study")
    assert len(refused) == 1 and "in use" in refused[0]


#: A study whose process is ended from outside, or that finds no room.
PROGRAM = """
import resource, sys, time
PAUSE = {pause}
import numpy as np
import stiction
sys.path.insert(0, {tests!r})
from models import BLOCK

def slow(result):
    time.sleep(PAUSE)
    return 0.0

{before}
try:
    stiction.sweep(
        stiction.loads(BLOCK), {{"guide.mu_static": np.linspace(0.2, 0.4, 400)}},
        outputs={{"peak": "max_abs(guide.force)", "slow": slow}}, end=0.05, dtout=0.01,
        directory={folder!r}, resume=True, workers=2,
    )
except stiction.OutputError as error:
    print(type(error).__name__, error)
"""


def program(folder: Path, pause: float, before: str = "") -> list[str]:
    tests = str(Path(__file__).parent)
    text = PROGRAM.format(tests=tests, folder=str(folder), pause=pause, before=before)
    return [sys.executable, "-c", text]


def test_a_killed_study_is_resumed(tmp_path: Path) -> None:
    folder = tmp_path / "study"
    process = subprocess.Popen(program(folder, pause=0.03))
    deadline = time.monotonic() + 60
    while not list(folder.glob("parts/*.parquet")) and time.monotonic() < deadline:
        time.sleep(0.05)
    process.send_signal(signal.SIGKILL)
    process.wait()
    done = sum(len(pandas.read_parquet(part)) for part in folder.glob("parts/*.parquet"))
    assert 0 < done < 400 and not (folder / "cases.parquet").exists()
    # What a kill in the middle of a file leaves behind is not taken for a part.
    (folder / "parts" / "000099.parquet.part").write_bytes(b"PAR1")
    subprocess.run(program(folder, pause=0.0), check=True)
    frame = pandas.read_parquet(folder / "cases.parquet")
    assert frame["case"].tolist() == list(range(400)) and frame["success"].all()
    whole = sweep({"guide.mu_static": np.linspace(0.2, 0.4, 400)})
    assert frame["peak"].tolist() == whole["peak"].tolist()


@pytest.mark.skipif(sys.platform != "linux", reason="limits of file sizes are set as on Linux")
def test_a_full_disk_leaves_nothing_half_written(tmp_path: Path) -> None:
    """The limit of the size of files makes writes fail in the middle of a file, as a full disk does."""
    folder = tmp_path / "study"
    limit = "resource.setrlimit(resource.RLIMIT_FSIZE, (8192, 8192))"
    full = subprocess.run(program(folder, 0.0, limit), check=True, capture_output=True, text=True)
    assert full.stdout.startswith("OutputError cannot write") and "parquet" in full.stdout
    assert list((folder / "parts").iterdir()) == [] and not (folder / "cases.parquet").exists()
    assert subprocess.run(program(folder, 0.0), check=True, capture_output=True).stdout == b""
    assert len(pandas.read_parquet(folder / "cases.parquet")) == 400


def test_duckdb_answers_for_which_mu_the_slider_sticks(tmp_path: Path) -> None:
    """The pull of 10 N/s reaches the limit mu * 2 * 9.81 N after mu * 1.962 s, and 1 mm/s some 0.02 s
    later: more than 0.1 s for mu above 0.041."""
    sweep(
        {"guide.mu_static": [0.025, 0.035, 0.05, 0.06], "guide.mu_dynamic": [0.02]},
        outputs={"stick": "longest_stick(guide)"},
        end=0.2,
        directory=tmp_path,
    )
    query = f"""
        select "guide.mu_static" from '{tmp_path}/cases.parquet' where stick > 0.1 order by all
    """
    relation = duckdb.sql(query)
    assert relation is not None
    assert relation.fetchall() == [(0.05,), (0.06,)]
