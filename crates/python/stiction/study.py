"""Studies: many runs of a model with other arguments, and a number or more of each."""

from __future__ import annotations

import json
import math
import os
import sys
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from html import escape
from types import CodeType
from typing import TYPE_CHECKING, Any, Union

from . import _native
from .diagnostics import ParameterError
from .model import Model, Value, _written, load
from .names import typed_errors, unknown
from .result import Result
from .units import Quantity

if TYPE_CHECKING:
    import pandas
    import polars
    from distributed import Client

#: Rows that notebooks show.
_SHOWN = 10


@dataclass(frozen=True)
class Uniform:
    """Numbers from `low` to `high`, all alike; in the model's unit without another one."""

    low: float
    high: float
    unit: str | None = None


@dataclass(frozen=True)
class LogUniform:
    """Numbers from `low` to `high` whose logarithms are all alike: `LogUniform(1e-4, 1e-2)` has as
    many below 1e-3 as above."""

    low: float
    high: float
    unit: str | None = None


Levels = Union[Uniform, LogUniform, Value, Iterable[Value]]
"""What a parameter is given: single values, or the range that a design takes values from."""

Output = Union[str, Callable[[Result], float]]
"""A reduction by its name, such as `"max_abs(guide.force)"`, or a function of the result of a run."""


@dataclass(frozen=True)
class Failure:
    """A case that has failed: its number, its parameters and why."""

    case: int
    parameters: Mapping[str, float | str]
    message: str


class Plan:
    """A study that can be run, here or in other processes: it can be pickled."""

    def __init__(
        self,
        model: Model,
        definition: _native.Definition,
        functions: Mapping[str, Callable[[Result], float]],
    ) -> None:
        self.model = model
        self.definition = definition
        self.functions = dict(functions)

    def __reduce__(self) -> tuple[Any, ...]:
        return Plan, (self.model, self.definition, self.functions)

    @classmethod
    def of_file(cls, path: str) -> Plan:
        """The study of a study file, `study.toml`."""
        with typed_errors():
            model, definition, _ = _native.read_study(path)
        return cls(load(model), definition, {})

    @cached_property
    def native(self) -> _native.Study:
        """The study in Rust."""
        with typed_errors():
            return _native.Study(self.model._project, *self.definition)

    @property
    def called(self) -> _native.Called | None:
        """What makes the outputs that are functions, None without any."""
        return self._call if self.functions else None

    def _call(self, case: int, ran: _native.Ran, checksum: str) -> list[float] | str:
        end, steps, dtout, error = self.definition[5]
        options = {
            "end": end,
            "steps": steps,
            "dtout": dtout,
            "error": error,
            "integrator": None,
            "check_accuracy": False,
            "changes": [*self.model.changes, *self.native.changes(case)],
            "case": case,
            "seed": self.native.seed(case),
        }
        result = Result._of_run(ran, self.model, options, checksum)
        values = []
        for name, function in self.functions.items():
            try:
                value = float(function(result))
            except Exception as raised:
                return f"output {name!r}: {type(raised).__name__}: {raised}"
            if not math.isfinite(value):
                return f"output {name!r} is {value}"
            values.append(value)
        return values

    def rows(self, cases: Sequence[int]) -> list[_native.Row]:
        """The rows of some cases, run one after the other."""
        with typed_errors():
            return self.native.run(list(cases), self.called)


def sweep(
    model: Model,
    parameters: Mapping[str, Levels],
    *,
    outputs: Mapping[str, Output],
    design: str = "factorial",
    cases: int | None = None,
    end: float | None = None,
    dtout: float | None = None,
    steps: int | None = None,
    error: float | None = None,
    seed: int = 0,
    workers: int | None = None,
    client: Client | None = None,
    directory: str | os.PathLike[str] | None = None,
    resume: bool = False,
    progress: bool | Callable[[int, int], object] = False,
) -> Study:
    """Runs a model with many values of its arguments: a table with a row for each case.

    `parameters` have the names that `Model.replace` takes; each is given its values, numbers in
    the model's units or `Quantity`, or a range, `Uniform` or `LogUniform`.
    `design` is "factorial" (every combination, the last parameter varies fastest), "list" (the first
    values of all, then the second, ...), "latin_hypercube" or "sobol" (so many `cases` out of
    ranges; `seed` decides which, of a Latin hypercube).

    `outputs` are columns of the table: a function of the `Result` of a run, or a reduction:
    `min`, `max`, `max_abs`, `mean` (over time) or `last` of a channel as in
    `"max_abs(guide.force)"`, `stuck_share` or `longest_stick` of a friction.
    `end`, `dtout`, `steps` and `error` are those of `Model.run`.

    Cases run on all cores, or on so many `workers`, or with a `client` on a Dask cluster; the table
    is the same, bit for bit. A case that fails is a row with its message. With a `directory` each case
    is written when it is done, and `resume` goes on with a study that was begun there.

    Raises `UnknownName`, `ParameterError` and `InputError` for what cannot be
    studied, `FolderError` where the directory is in use or holds something else,
    `OutputError` where it cannot be written, `ClusterError` where the cluster has gone.
    """
    functions = {name: output for name, output in outputs.items() if callable(output)}
    definition: _native.Definition = (
        [_given(model, name, levels) for name, levels in parameters.items()],
        design,
        _whole("cases", cases),
        _whole("seed", seed) or 0,
        [(name, callable(output), _said(output)) for name, output in outputs.items()],
        (end, _whole("steps", steps), dtout, error),
    )
    if workers is not None and workers < 1:
        raise ParameterError(f"workers must be a positive number, it is {workers}")
    if workers is not None and client is not None:
        raise ParameterError("workers are those of this machine, a client has its own; give one of them")
    started = time.perf_counter()
    plan = Plan(model, definition, functions)
    count = plan.native.cases()

    def told(done: int, failed: int) -> None:
        if callable(progress):
            progress(done, count)
        elif progress:
            text = f"\r{done} of {count} cases, {failed} failed"
            print(text, end="", file=sys.stderr, flush=True)

    folder = None if directory is None else os.fspath(directory)
    record = record_of(plan, folder, resume, workers, client, told)
    if progress is True:
        print(file=sys.stderr)
    units = json.loads(plan.native.units())
    manifest = json.loads(plan.native.manifest())
    return Study(record.columns(), units, manifest, folder, time.perf_counter() - started)


def record_of(
    plan: Plan,
    folder: str | None,
    resume: bool,
    workers: int | None,
    client: Client | None,
    told: Callable[[int, int], object],
) -> _native.Record:
    """Runs the cases of a study that are not done yet; `told` is called with the numbers of cases that
    are done and that have failed."""
    with typed_errors():
        record = plan.native.record(folder, resume)
        try:
            if client is None:
                record.run(workers, plan.called, told)
            else:
                from .cluster import run_on

                run_on(client, plan, record, told)
        except BaseException:
            # What is done stays, where the disk takes it.
            with suppress(_native.OutputFailure):
                record.finish()
            raise
        record.finish()
        told(*record.counts())
    return record


def _whole(name: str, number: int | None) -> int | None:
    if number is not None and not 0 <= number < 2**32:
        raise ParameterError(f"{name} must be a whole number from 0 on, it is {number}")
    return number


def _given(model: Model, name: str, levels: Levels) -> _native.Parameter:
    """A parameter as Rust takes it."""
    if isinstance(levels, (Uniform, LogUniform)):
        logarithmic = isinstance(levels, LogUniform)
        return name, [], (float(levels.low), float(levels.high), logarithmic, levels.unit)
    if isinstance(levels, (str, Quantity)) or not isinstance(levels, Iterable):
        levels = [levels]
    return name, [_value(name, value) for value in levels], None


def _value(name: str, value: Value) -> tuple[float | str, str | None]:
    if isinstance(value, Quantity):
        return float(value.value), value.unit
    if isinstance(value, str) or not isinstance(value, Sequence):
        return value if isinstance(value, str) else float(value), None
    return _written(name, value, None), None


def _said(output: Output) -> str:
    """A reduction, or what tells a function from others."""
    if isinstance(output, str):
        return output
    from hashlib import sha256

    name = getattr(output, "__qualname__", type(output).__qualname__)
    code = getattr(output, "__code__", None)
    return f"{name} {sha256(_code(code)).hexdigest()[:16]}" if code else name


def _code(code: CodeType) -> bytes:
    """What a function does, without where it stands."""
    constants = [
        _code(constant) if isinstance(constant, CodeType) else repr(constant).encode()
        for constant in code.co_consts
    ]
    return b"\0".join([code.co_code, repr(code.co_names).encode(), *constants])


class Study:
    """The table of a study: a row for each case, in their order.

    Columns are `case`, the parameters (in the model's units), the outputs, `success`, `message`,
    `steps`, `seed` and `hash`; `study["peak"]` is one of them, as a numpy array. Outputs of cases
    that have failed are not numbers (nan).
    """

    def __init__(
        self,
        columns: list[tuple[str, str, Any]],
        units: Mapping[str, str],
        manifest: Mapping[str, Any],
        directory: str | None,
        elapsed: float,
    ) -> None:
        self._raw = (columns, units, manifest, directory, elapsed)
        self.units = dict(units)
        """Units by column; empty for plain numbers, without those that are not known."""
        self.manifest = dict(manifest)
        """What study it is: model, design, seed, ... as in `study.json`."""
        self.directory = directory
        """The folder that it was written into."""
        self.elapsed_seconds = elapsed
        """Wall time, seconds."""

    def __reduce__(self) -> tuple[Any, ...]:
        return Study, self._raw

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return tuple(self.manifest["parameters"])

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs."""
        return tuple(name for name, _ in self.manifest["outputs"])

    @cached_property
    def _columns(self) -> dict[str, Any]:
        import numpy as np

        types = {"double": np.float64, "long": np.int64, "boolean": np.bool_, "text": np.object_}
        return {
            name: np.frombuffer(values) if kind == "double" else np.array(values, dtype=types[kind])
            for name, kind, values in self._raw[0]
        }

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
        return tuple(name for name, _, _ in self._raw[0])

    def __len__(self) -> int:
        return len(self["case"])

    def __getitem__(self, column: str) -> Any:
        if column not in self._columns:
            raise unknown("column", column, self._columns)
        return self._columns[column]

    @property
    def success(self) -> bool:
        """Whether no case has failed."""
        return bool(self["success"].all())

    @property
    def failures(self) -> tuple[Failure, ...]:
        """The cases that have failed."""
        failed = (~self["success"]).nonzero()[0]
        return tuple(
            Failure(
                case=int(self["case"][row]),
                parameters={
                    name: value if isinstance(value := self[name][row], str) else float(value)
                    for name in self.parameters
                },
                message=self["message"][row],
            )
            for row in failed
        )

    def to_pandas(self) -> pandas.DataFrame:
        """The table; `attrs["units"]` has the units."""
        import pandas

        frame = pandas.DataFrame(self._columns)
        frame.attrs.update(units=dict(self.units), title=self.manifest["title"])
        return frame

    def to_polars(self) -> polars.DataFrame:
        """The table, with nulls for the outputs of cases that have failed."""
        import polars

        columns = {name: self[name].tolist() for name in self.columns}
        return polars.DataFrame(columns, strict=False).with_columns(
            polars.col(name).cast(polars.Float64).fill_nan(None) for name in self.outputs
        )

    def __repr__(self) -> str:
        failed = len(self) - int(self["success"].sum())
        return f"<Study of {len(self)} cases, {failed} failed: {', '.join(self.outputs)}>"

    def _repr_html_(self) -> str:
        shown = ["case", *self.parameters, *self.outputs, "message"]
        heads = "".join(
            f"<th>{escape(name)}{f' ({escape(self.units[name])})' if self.units.get(name) else ''}</th>"
            for name in shown
        )
        rows = "".join(
            "<tr>" + "".join(f"<td>{escape(_cell(self[name][row]))}</td>" for name in shown) + "</tr>"
            for row in range(min(len(self), _SHOWN))
        )
        more = f"<p>and {len(self) - _SHOWN} more</p>" if len(self) > _SHOWN else ""
        failed = len(self.failures)
        return (
            f"<h4>{escape(str(self.manifest['title']))}</h4><p>{escape(str(self.manifest['design']))}: "
            f"{len(self)} cases, {failed} failed, {self.elapsed_seconds:.2f} s</p>"
            f"<table><tr>{heads}</tr>{rows}</table>{more}"
        )


def _cell(value: Any) -> str:
    if isinstance(value, str):
        return value.splitlines()[0] if value else ""
    return f"{value:.4g}" if isinstance(value, float) else str(value)
