"""`python3 -m stiction sweep study.toml`: what the program's `--cluster` starts."""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from .cluster import connected
from .diagnostics import ClusterError, InputError, StictionError
from .study import Plan, record_of

#: Seconds between two lines of progress.
INTERVAL = 0.5


def arguments_of(words: Sequence[str]) -> argparse.Namespace:
    """What the command line says."""
    parser = argparse.ArgumentParser(prog="python3 -m stiction", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    sweep = commands.add_parser("sweep", help="run a study on a Dask cluster")
    sweep.add_argument("study", help="study file (.toml)")
    sweep.add_argument("-o", "--output", help="folder for the table")
    sweep.add_argument("--cluster", required=True, help="address of the scheduler")
    sweep.add_argument("--resume", action="store_true", help="go on with the study in the folder")
    sweep.add_argument("--progress", choices=["auto", "plain", "json", "none"], default="auto")
    return parser.parse_args(words)


def main(words: Sequence[str]) -> int:
    """Runs a study; returns the exit code, which is that of the program `stiction`."""
    arguments = arguments_of(words)
    folder = arguments.output or f"{Path(arguments.study).stem}-study"
    started = time.perf_counter()
    try:
        plan = Plan.of_file(arguments.study)
        if plan.model.diagnostics:
            print(plan.model.diagnostics, file=sys.stderr)
        with connected(arguments.cluster) as client:
            told = progress_of(arguments.progress, plan.native.cases())
            record = record_of(plan, folder, arguments.resume, None, client, told)
    except InputError as error:
        print(error, file=sys.stderr)
        return 3
    except (ClusterError, StictionError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("interrupted; the same command with --resume goes on from here", file=sys.stderr)
        return 130
    print(record.summary(folder, time.perf_counter() - started), end="")
    return 0


def progress_of(kind: str, cases: int) -> Callable[[int, int], None]:
    """What shows how far a study is, on standard error."""
    if kind == "auto":
        kind = "plain" if sys.stderr.isatty() else "none"
    last = -INTERVAL
    started = time.monotonic()

    def told(done: int, failed: int) -> None:
        nonlocal last
        now = time.monotonic()
        if kind == "none" or (now - last < INTERVAL and done < cases):
            return
        last = now
        said = {"done": done, "failed": failed, "cases": cases, "elapsed": now - started}
        plain = f"{done} of {cases} cases, {failed} failed, {now - started:.1f} s"
        print(json.dumps(said) if kind == "json" else plain, file=sys.stderr, flush=True)

    return told


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
