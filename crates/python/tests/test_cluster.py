"""Studies on a Dask cluster of a scheduler and worker processes that the tests start on loopback."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import dask
import numpy as np
import pandas
import pytest
import stiction
from distributed import Client
from models import BLOCK
from stiction import cluster
from stiction.__main__ import main

MODEL = stiction.loads(BLOCK)
OUTPUTS: dict[str, Any] = {
    "peak": "max_abs(guide.force)",
    "stick": "longest_stick(guide)",
    "last": lambda result: result.friction["guide"].force[-1],
}
#: A case takes about a millisecond.
SETTINGS: dict[str, Any] = {"outputs": OUTPUTS, "end": 0.02, "dtout": 0.01}


class Cluster:
    """A scheduler and its workers, each a process."""

    def __init__(self, folder: Path, workers: int, nanny: str = "--no-nanny") -> None:
        self.folder = folder
        file = folder / "scheduler.json"
        self.scheduler = self.start(
            "distributed.cli.dask_scheduler", "--port", "0", "--scheduler-file", str(file), "--no-dashboard"
        )
        self.workers = [
            self.start(
                "distributed.cli.dask_worker",
                *("--scheduler-file", str(file), "--nthreads", "1", "--no-dashboard", nanny),
                *("--local-directory", str(folder), "--death-timeout", "60"),
            )
            for _ in range(workers)
        ]
        self.client = Client(scheduler_file=str(file), timeout="60s")
        self.address = str(json.loads(file.read_text())["address"])
        if workers:
            self.client.wait_for_workers(workers, timeout=60)

    def start(self, module: str, *arguments: str) -> subprocess.Popen[bytes]:
        environment = {
            **os.environ,
            "DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT": "2s",
            "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "1",
        }
        command = [sys.executable, "-m", module, "--host", "127.0.0.1", *arguments]
        with (self.folder / "log.txt").open("ab") as log:
            return subprocess.Popen(command, stdout=log, stderr=log, env=environment)

    def close(self) -> None:
        self.client.close()
        for process in [*self.workers, self.scheduler]:
            process.kill()
            process.wait()


@pytest.fixture
def four(tmp_path: Path) -> Iterator[Cluster]:
    started = Cluster(tmp_path, 4)
    yield started
    started.close()


def columns(study: stiction.Study) -> list[tuple[str, str, Any]]:
    """All columns, bit for bit."""
    raw: list[tuple[str, str, Any]] = study._raw[0]
    return raw


def test_a_study_survives_the_loss_of_a_worker(four: Cluster, tmp_path: Path) -> None:
    """2,000 cases on four workers, of which one is killed: each once, and the table of one core."""
    parameters = {"guide.mu_static": stiction.Uniform(0.25, 0.4), "guide.mu_dynamic": stiction.Uniform(0.1, 0.2)}
    design: dict[str, Any] = {"design": "latin_hypercube", "cases": 2000, **SETTINGS}
    killed: list[int] = []

    def kill(done: int, count: int) -> None:
        if done > 200 and not killed:
            killed.append(done)
            four.workers[0].send_signal(signal.SIGKILL)

    study = stiction.sweep(
        MODEL, parameters, client=four.client, directory=tmp_path / "cluster", progress=kill, **design
    )
    assert killed and killed[0] < 2000 and four.workers[0].wait() == -signal.SIGKILL
    assert study["case"].tolist() == list(range(2000)) and study.success
    serial = stiction.sweep(MODEL, parameters, workers=1, directory=tmp_path / "serial", **design)
    assert columns(study) == columns(serial)
    files = [tmp_path / name / "cases.parquet" for name in ("cluster", "serial")]
    assert files[0].read_bytes() == files[1].read_bytes()
    assert len(pandas.read_parquet(files[0])) == 2000


STUDY = """
model = "block.adm"
end = 0.02
dtout = 0.01
design = "sobol"
cases = 64
[parameters]
guide.mu_static = { from = 0.25, to = 0.4 }
guide.max_stiction_deformation = { from = 1, to = 100, unit = "um", spacing = "log" }
[outputs]
peak = "max_abs(guide.force)"
"""


def test_the_program_runs_a_study_file_on_a_cluster(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What `stiction sweep --cluster` starts."""
    (tmp_path / "block.adm").write_text(BLOCK)
    file = tmp_path / "study.toml"
    file.write_text(STUDY)
    folder = str(tmp_path / "results")
    two = Cluster(tmp_path, 2)
    try:
        words = ["sweep", str(file), "-o", folder, "--progress", "json"]
        words += ["--cluster", two.address]
        assert main(words) == 0
        said = capsys.readouterr()
        assert said.out.startswith("64 of 64 cases done, 0 failed")
        assert '"done": 64' in said.err
        assert main(words) == 2 and "holds a study already" in capsys.readouterr().err
        with dask.config.set({"distributed.comm.timeouts.connect": "1s"}):
            assert main([*words[:-1], "tcp://127.0.0.1:1"]) == 2
        assert "no Dask scheduler answers" in capsys.readouterr().err
        file.write_text(STUDY.replace("guide.force", "guide.froce"))
        assert main(words) == 3 and "study.toml:11:8" in capsys.readouterr().err
    finally:
        two.close()
    parameters: dict[str, Any] = {
        "guide.mu_static": stiction.Uniform(0.25, 0.4),
        "guide.max_stiction_deformation": stiction.LogUniform(1, 100, "um"),
    }
    settings = {**SETTINGS, "outputs": {"peak": "max_abs(guide.force)"}, "design": "sobol", "cases": 64}
    study = stiction.sweep(MODEL, parameters, **settings)
    frame = pandas.read_parquet(Path(folder) / "cases.parquet")
    pandas.testing.assert_frame_equal(frame, study.to_pandas(), check_exact=True, check_dtype=False)


def test_a_dead_cluster_is_an_error_and_the_study_is_resumed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A scheduler that is gone is an error, and what is done then stays."""
    monkeypatch.setattr(cluster, "PATIENCE", 3.0)
    one = Cluster(tmp_path, 1)
    try:
        parameters = {"guide.mu_static": np.linspace(0.25, 0.4, 400)}
        folder = tmp_path / "study"

        def end(done: int, count: int) -> None:
            if done > 50:
                one.scheduler.kill()

        with pytest.raises(stiction.ClusterError):
            stiction.sweep(
                MODEL, parameters, client=one.client, directory=folder, progress=end, **SETTINGS
            )
    finally:
        one.close()
    done = sum(len(pandas.read_parquet(part)) for part in folder.glob("parts/*.parquet"))
    assert 50 < done < 400
    study = stiction.sweep(MODEL, parameters, directory=folder, resume=True, **SETTINGS)
    assert columns(study) == columns(stiction.sweep(MODEL, parameters, **SETTINGS))


def test_a_case_that_ends_its_worker_is_a_row(tmp_path: Path) -> None:
    """Its worker is started again each time; the cases that were with it are run all the same."""
    one = Cluster(tmp_path, 1, "--nanny")
    try:

        def ends(result: stiction.Result) -> float:
            if result.options["case"] == 7:
                os._exit(1)
            return 0.0

        parameters = {"guide.mu_static": np.linspace(0.25, 0.4, 20)}
        settings = {**SETTINGS, "outputs": {"ends": ends}}
        study = stiction.sweep(MODEL, parameters, client=one.client, **settings)
    finally:
        one.close()
    [failure] = study.failures
    assert failure.case == 7 and "the worker ended" in failure.message


def test_a_cluster_without_workers_and_none_at_all(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cluster, "PATIENCE", 0.5)
    empty = Cluster(tmp_path, 0)
    try:
        with pytest.raises(stiction.ClusterError, match="no workers"):
            stiction.sweep(MODEL, {"guide.mu_static": [0.3]}, client=empty.client, **SETTINGS)
    finally:
        empty.close()
