"""Studies on a Dask cluster: batches of cases, recorded once, whatever happens to workers."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import lru_cache
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING, Any

import cloudpickle  # type: ignore[import-untyped]
from distributed import Client, Future, KilledWorker

from . import _native
from .diagnostics import ClusterError, StictionError

if TYPE_CHECKING:
    from .study import Plan

#: Wall time that a batch should take, seconds: the scheduler needs about a millisecond for each.
BATCH_SECONDS = 1.0

#: Batches that a thread of a worker has, one to work on and the others to go on with at once.
AHEAD = 2

#: Seconds for which a cluster may have no workers.
PATIENCE = 60.0

#: Seconds between two looks at the cluster.
LOOK = 1.0


@contextmanager
def connected(address: str) -> Iterator[Client]:
    """A client of the scheduler at an address such as `tcp://10.0.0.1:8786`."""
    try:
        client = Client(address)
    except (OSError, TimeoutError, ValueError) as error:
        raise ClusterError(f"no Dask scheduler answers at {address}: {error}") from error
    with client:
        yield client


def run_on(
    client: Client,
    plan: Plan,
    record: _native.Record,
    told: Callable[[int, int], object],
) -> None:
    """Runs the cases that are not done on the workers of a cluster, and records each when it is done."""
    batches = _Batches(record.open_cases())
    running: dict[Any, tuple[Future[Any], list[int]]] = {}
    finished: SimpleQueue[Future[Any]] = SimpleQueue()
    looks = _Looks(client)
    # The text of the model travels once; a worker that needs it after its holder is lost gets it anew.
    text = cloudpickle.dumps((plan, plan.native.manifest()))
    packed = client.submit(_same, text, pure=False)
    try:
        while batches or running:
            threads = looks.threads()
            while cases := batches.take(threads, len(running)):
                future = client.submit(_rows, packed, cases, pure=False)
                running[future.key] = future, cases
                future.add_done_callback(finished.put)
            try:
                future = finished.get(timeout=LOOK)
            except Empty:
                record.push([])
                told(*record.counts())
                continue
            _, cases = running.pop(future.key)
            rows = _answer(future, cases, batches, plan)
            record.push(rows)
            told(*record.counts())
    except OSError as error:
        raise ClusterError(f"the Dask cluster does not answer any more: {error}") from error
    finally:
        with suppress(Exception):
            client.cancel([packed, *(future for future, _ in running.values())])


class _Batches:
    """The cases that are not given to anybody yet, in batches that take about the same time."""

    def __init__(self, cases: list[int]) -> None:
        self._cases = deque(cases)
        #: Those that were with workers that have ended, to be run by themselves after all others.
        self._suspects: deque[int] = deque()
        self._tried_alone: list[int] = []
        #: Time and number of the cases that are done.
        self._seconds, self._done = 0.0, 0

    def __bool__(self) -> bool:
        return bool(self._cases or self._suspects)

    def take(self, threads: int, running: int) -> list[int]:
        """The next batch, where so many threads work on so many; empty where there is none for them."""
        if not self._cases:
            if running or not self._suspects or not threads:
                return []
            # By itself, so that it is known to be the one if its worker ends.
            self._tried_alone = [self._suspects.popleft()]
            return self._tried_alone
        if running >= AHEAD * threads:
            return []
        size = 1
        if self._done:
            size = int(BATCH_SECONDS * self._done / max(self._seconds, 1e-9))
        # The last batches are small, so that all threads end together.
        size = max(1, min(size, len(self._cases) // (AHEAD * threads)))
        return [self._cases.popleft() for _ in range(size)]

    def took(self, seconds: float, cases: int) -> None:
        """How long some cases took."""
        self._seconds += seconds
        self._done += cases

    def suspect(self, cases: list[int]) -> bool:
        """Takes back cases of which one may have ended its worker; returns whether it is known which."""
        known = self._tried_alone == cases
        if not known:
            self._suspects.extend(cases)
        return known


class _Looks:
    """Looks at the workers of a cluster now and then."""

    def __init__(self, client: Client) -> None:
        self._client = client
        self._threads = 0
        self._looked = -LOOK
        self._alive = time.monotonic()

    def threads(self) -> int:
        """Threads of all workers; raises where there have been none for long."""
        now = time.monotonic()
        if now - self._looked < LOOK:
            return self._threads
        self._looked = now
        if self._client.status not in ("running", "connecting"):
            raise ClusterError(f"the connection to the Dask scheduler is {self._client.status}")
        found: dict[str, int] = self._client.nthreads()
        self._threads = sum(found.values())
        if self._threads:
            self._alive = now
        elif now - self._alive > PATIENCE:
            raise ClusterError(f"the Dask cluster has had no workers for {PATIENCE:g} s")
        return self._threads


def _answer(future: Future[Any], cases: list[int], batches: _Batches, plan: Plan) -> list[_native.Row]:
    """The rows of a batch; none where its cases are to be run again."""
    if future.cancelled():
        raise ClusterError("the Dask scheduler has gone, or its tasks were cancelled")
    try:
        rows, seconds = future.result()
    except KilledWorker as error:
        if not batches.suspect(cases):
            return []
        message = f"the worker ended while it ran this case: {error}".splitlines()[0]
        return [(cases[0], [None] * len(plan.definition[4]), False, message, 0)]
    except Exception as error:
        kind = type(error).__name__
        raise ClusterError(f"a Dask worker cannot run the study: {kind}: {error}") from error
    batches.took(seconds, len(rows))
    return list(rows)


def _same(packed: bytes) -> bytes:
    return packed


@lru_cache(maxsize=4)
def _plan(packed: bytes) -> Plan:
    plan: Plan
    plan, manifest = cloudpickle.loads(packed)
    if plan.native.manifest() != manifest:
        raise StictionError("the worker has another version of stiction")
    return plan


def _rows(packed: bytes, cases: list[int]) -> tuple[list[_native.Row], float]:
    """What a worker does: the rows of some cases, and how long it took."""
    plan = _plan(packed)
    started = time.perf_counter()
    return plan.rows(cases), time.perf_counter() - started
