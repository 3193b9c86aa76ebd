"""A study on Slurm, with a controller and a node that the test starts on this machine; opt-in.

`apt-get install slurmctld slurmd munge`, then as root `STICTION_SLURM=1 crates/python/check -k slurm -s`.
"""

import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import stiction
from models import BLOCK

pytestmark = pytest.mark.skipif(
    "STICTION_SLURM" not in os.environ, reason="it starts Slurm; STICTION_SLURM=1 asks for it"
)

CONFIGURATION = """ClusterName=test
SlurmctldHost={host}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldPort={controller}
SlurmdPort={node}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/filetxt
JobCompLoc={folder}/jobs.txt
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} RealMemory=2048
PartitionName=all Nodes=ALL Default=YES State=UP
"""


def free_port() -> int:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return int(free.getsockname()[1])


def told(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True, timeout=30).stdout


@pytest.fixture
def slurm(monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The folder of a Slurm of one node, which commands find by SLURM_CONF."""
    # Paths of sockets are short.
    folder = Path(tempfile.mkdtemp(prefix="slurm-"))
    host = socket.gethostname().split(".")[0]
    (folder / "state").mkdir()
    (folder / "spool").mkdir()
    key = folder / "munge.key"
    key.write_bytes(os.urandom(1024))
    key.chmod(0o600)
    configuration = folder / "slurm.conf"
    configuration.write_text(
        CONFIGURATION.format(
            folder=folder, host=host, cores=os.cpu_count(), controller=free_port(), node=free_port()
        )
    )
    monkeypatch.setenv("SLURM_CONF", str(configuration))
    munge = {"key-file": "munge.key", "socket": "munge.socket", "pid-file": "munge.pid"}
    munge |= {"log-file": "munge.log", "seed-file": "munge.seed"}
    places = [f"--{name}={folder / file}" for name, file in munge.items()]
    daemons = [["munged", "--foreground", "--force", *places], ["slurmctld", "-D"], ["slurmd", "-D"]]
    running = []
    for command in daemons:
        with (folder / f"{command[0]}.txt").open("w") as log:
            program = shutil.which(command[0], path=os.environ["PATH"] + ":/usr/sbin")
            assert program, f"{command[0]} is not installed"
            running.append(subprocess.Popen([program, *command[1:]], stdout=log, stderr=log))
        time.sleep(1.0)
    try:
        deadline = time.monotonic() + 30.0
        while "idle" not in told("sinfo", "--noheader", "--format=%T"):
            assert time.monotonic() < deadline, (folder / "slurmctld.txt").read_text()
            time.sleep(0.5)
        yield folder
    finally:
        for daemon in reversed(running):
            daemon.terminate()
            daemon.wait(timeout=30)
        shutil.rmtree(folder)


def test_a_study_on_slurm_gives_the_table_of_one_process(slurm: Path) -> None:
    from dask_jobqueue.slurm import SLURMCluster

    model = stiction.loads(BLOCK)
    settings: dict[str, Any] = {
        "outputs": {
            "peak": "max_abs(guide.force)",
            "stick": "longest_stick(guide)",
            "last": lambda result: result.friction["guide"].force[-1],
        },
        "design": "latin_hypercube",
        "cases": 400,
        "seed": 6,
        "end": 1.0,
        "dtout": 0.01,
    }
    ranges = {"guide.mu_static": stiction.Uniform(0.25, 0.4), "guide.mu_dynamic": stiction.Uniform(0.1, 0.2)}
    alone = stiction.sweep(model, ranges, **settings)

    jobs = 2 if (os.cpu_count() or 1) > 1 else 1
    cluster = SLURMCluster(
        queue="all",
        cores=1,
        processes=1,
        memory="500MB",
        walltime="00:10:00",
        python=sys.executable,
        interface="lo",
        local_directory=str(slurm),
        log_directory=str(slurm),
        scheduler_options={"dashboard_address": ":0"},
    )
    with cluster, cluster.get_client() as client:
        print(cluster.job_script())
        cluster.scale(jobs=jobs)
        client.wait_for_workers(jobs, timeout=60)
        print(told("squeue", "--format=%i %j %T %N %C"))
        on_slurm = stiction.sweep(model, ranges, client=client, **settings)
        by = client.run(lambda: os.environ["SLURM_JOB_ID"])
        print("workers by their Slurm jobs:", by)
    assert len(set(by.values())) == jobs
    assert len(on_slurm) == 400 and not on_slurm.failures
    assert on_slurm._raw[0] == alone._raw[0]
    deadline = time.monotonic() + 30.0
    while told("squeue", "--noheader") and time.monotonic() < deadline:
        time.sleep(0.5)
    print((slurm / "jobs.txt").read_text())
    print(on_slurm.to_pandas().describe())
