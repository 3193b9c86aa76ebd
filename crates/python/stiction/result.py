"""Results of a run: channels by name as numpy arrays, tables, what friction did."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any

from . import _native
from .diagnostics import Diagnostics, ParameterError
from .files import whole_folder
from .names import Named, typed_errors, unknown

if TYPE_CHECKING:
    import numpy as np
    import pandas
    import polars
    import xarray
    from numpy.typing import NDArray

    from .model import Model
    from .plots import Plots

    Floats = NDArray[np.float64]

REGIMES = ("stuck", "transition", "sliding")
"""The regimes of friction by number, as in the channel `regime`."""

ANALYSES = ("modelInput", "initialConditions", "static", "quasiStatic", "dynamic", "kinematic")
"""What a row belongs to, by number."""

_CAUSES = ("preload", "reaction", "bending", "torsion")


@dataclass(frozen=True)
class _Column:
    """Unit of a channel and its place in the table."""

    unit: str
    place: int


class _Entity:
    """A thing of the model with its channels."""

    def __init__(self, said: Mapping[str, Any]) -> None:
        self.name: str = said["name"]
        self.element: str = said["element"] or said["name"]
        self.kind: str = said["kind"]
        self.id: int = said["id"] or 0
        self.columns = {name: _Column(unit, place) for name, unit, place in said["components"]}


class Result:
    """What a run computed: a channel is ``result["SLIDE.FX"]``, a read-only numpy array over `time`.

    Names are those of result files, in any case; `channels` lists them and `units` has their units.
    """

    def __init__(
        self,
        entities: str,
        times: bytes,
        kinds: bytes,
        columns: bytes,
        report: str,
        diagnostics: Diagnostics,
        log: str,
        about: dict[str, Any],
    ) -> None:
        self._raw = (entities, times, kinds, columns, report, diagnostics, log, about)
        self.diagnostics = diagnostics
        """Warnings about the model and about what the run came upon."""
        self.log = log
        """The message file of the run."""
        self._about = about

    @classmethod
    def _of_run(
        cls,
        ran: tuple[Any, ...],
        model: Model,
        options: dict[str, Any],
        checksum: str | None = None,
    ) -> Result:
        entities, times, kinds, columns, report, messages, log, stopped = ran
        about = {
            "title": model.title,
            "prefix": model._about["prefix"],
            "units": model.units,
            "version": _native.__version__,
            "model": checksum or model.checksum,
            "frictions": {friction.id: friction.joint for friction in model.frictions.values()},
            "joints": {f.id: model.joints[f.joint].kind for f in model.frictions.values()},
            "options": options,
        }
        diagnostics = Diagnostics._of_json(messages)
        result = cls(entities, times, kinds, columns, report, diagnostics, log, about)
        if isinstance(stopped, KeyboardInterrupt):
            raise Interrupted(result) from stopped
        if stopped is not None:
            raise stopped
        return result

    def __reduce__(self) -> tuple[Any, ...]:
        return Result, self._raw

    @cached_property
    def _report(self) -> dict[str, Any]:
        report: dict[str, Any] = json.loads(self._raw[4])
        return report

    @cached_property
    def _entities(self) -> list[_Entity]:
        return [_Entity(said) for said in json.loads(self._raw[0])]

    @cached_property
    def _columns(self) -> dict[str, _Column]:
        return {
            f"{entity.name}.{name}": column
            for entity in self._entities
            for name, column in entity.columns.items()
        }

    @cached_property
    def _lower(self) -> dict[str, _Column]:
        return {name.lower(): column for name, column in self._columns.items()}

    @property
    def success(self) -> bool:
        """Whether all commands were carried out."""
        return self.outcome == "completed"

    @property
    def outcome(self) -> str:
        """`completed`, `interrupted`, `not simulated`, `assembly failed` or `integration failed`."""
        return str(self._report["outcome"])

    @property
    def message(self) -> str:
        """What went wrong, with its place; else how it ended."""
        return str(self._report["message"] or f"{self.outcome} at time {self._report['time']}")

    @property
    def stats(self) -> Mapping[str, Any]:
        """What the run took: `steps`, `rejections`, `failures`, `starts`, `residuals`,
        `factorisations` of the integrator, `outputs`, `elapsed_seconds`."""
        more = {name: self._report[name] for name in ("outputs", "elapsed_seconds")}
        return {**self._report["integrator"], **more}

    @property
    def report(self) -> Mapping[str, Any]:
        """Everything that `run.json` tells of a run: failures, modes, energy balance, frictions."""
        return dict(self._report)

    @property
    def accuracy(self) -> Mapping[str, Any] | None:
        """How accurate the run is; None where it was not checked. `accurate`, whether the estimate of
        the error stayed within a hundred errors of a step; the largest `distance` and `rotation` of a
        body from a second run with a tenth of ERROR, each with `body`, `difference`, the `estimate` of
        the error (twice that), `unit`, `errors` (the estimate in errors of a step) and `time`;
        `inaccurate_from`, the first that was beyond; `suggested_error`; `elements`, the largest
        differences of frictions and states; `outputs` compared and `unmatched`; `second_failure`."""
        accuracy: Mapping[str, Any] | None = self._report["accuracy"]
        return accuracy

    @property
    def options(self) -> Mapping[str, Any]:
        """What `Model.run` was given, and the changes of the model."""
        return dict(self._about["options"])

    @property
    def model_checksum(self) -> str:
        """The checksum of the model that was run."""
        return str(self._about["model"])

    @cached_property
    def time(self) -> Floats:
        """Times of the outputs, in the model's unit."""
        import numpy as np

        return np.frombuffer(self._raw[1])

    @cached_property
    def analysis(self) -> NDArray[np.uint8]:
        """What each output belongs to, a number of `stiction.result.ANALYSES`."""
        import numpy as np

        return np.frombuffer(self._raw[2], dtype=np.uint8)

    @cached_property
    def values(self) -> Floats:
        """All channels, one a row, in the order of `channels`; read-only, as are the views of it."""
        import numpy as np

        count = sum(len(entity.columns) for entity in self._entities)
        return np.frombuffer(self._raw[3]).reshape(count, len(self.time))

    @cached_property
    def channels(self) -> tuple[str, ...]:
        """Names of all channels in the order of `values`."""
        return tuple(sorted(self._columns, key=lambda name: self._columns[name].place))

    @cached_property
    def units(self) -> Mapping[str, str]:
        """Units by channel; empty for plain numbers."""
        return {name: self._columns[name].unit for name in self.channels}

    def __getitem__(self, channel: str) -> Floats:
        column = self._lower.get(channel.lower())
        if column is None:
            raise unknown("channel", channel, self._columns)
        return self._row(column)

    def __contains__(self, channel: object) -> bool:
        return isinstance(channel, str) and channel.lower() in self._lower

    def _row(self, column: _Column) -> Floats:
        row: Floats = self.values[column.place]
        return row

    @cached_property
    def friction(self) -> Named[FrictionResult]:
        """What each friction did, by its name, its id or the name of its joint."""
        details = {e.id: e for e in self._entities if e.kind == "Stiction_Friction"}
        frictions = [
            FrictionResult(self, entity, details[entity.id])
            for entity in self._entities
            if entity.kind == "Friction"
        ]
        own = ((friction.name, friction.id, friction) for friction in frictions)
        return Named("friction", own, ((friction.joint, friction) for friction in frictions))

    def to_pandas(self) -> pandas.DataFrame:
        """All channels over time, without a copy; ``attrs["units"]`` has the units."""
        import pandas

        time = pandas.Index(self.time, name="time", copy=False)
        frame = pandas.DataFrame(self.values.T, time, list(self.channels), copy=False)
        frame.attrs.update(self._attributes(self.units))
        return frame

    def to_polars(self) -> polars.DataFrame:
        """All channels and the column `time`."""
        import polars

        columns = {"time": self.time, **dict(zip(self.channels, self.values))}
        return polars.DataFrame(columns)

    @cached_property
    def energy(self) -> Mapping[str, Floats]:
        """Energies of the model at each output, and the works that were put in until then: `kinetic`,
        `weight`, `stored` (in creep and bristles), `work_of_forces` (springs among them),
        `work_of_motions`, `dissipated`, `residual`. The changes of the first three and what was
        dissipated, less the works, are the residual: zero but for the error of the integration."""
        entity = next(entity for entity in self._entities if entity.kind == "Stiction_Energy")
        return {name.lower(): self._row(column) for name, column in entity.columns.items()}

    def save(
        self, folder: str | os.PathLike[str], formats: Sequence[str] = ("parquet",)
    ) -> None:
        """Writes the tables `friction` and `states` in the `formats` "parquet" and "csv", and the message
        file, as a run with `output` does. The folder, of which there may be an empty one, gets its
        name when it is whole.

        Raises `OutputError` where the folder has something in it or cannot be written.
        """
        check_formats(formats, ("parquet", "csv"))
        about = self._about
        facts = {
            "version": about["version"],
            "outcome": self.outcome,
            "model": self.model_checksum,
            "options": json.dumps(about["options"]),
        }
        with whole_folder(folder) as part, typed_errors():
            _native.save(
                os.fspath(part),
                list(formats),
                self._raw[:4],
                about["title"],
                about["units"]["time"],
                list(facts.items()),
            )
            (part / f"{about['prefix']}.msg").write_text(self.log, encoding="utf-8", newline="")

    @cached_property
    def plot(self) -> Plots:
        """Pictures: ``result.plot.friction("slide")``; they need matplotlib."""
        from .plots import Plots

        return Plots(self)

    def to_xarray(self) -> xarray.Dataset:
        """Parts, joints and frictions over time: dimensions `time`, `part`, `joint` or `friction`, and
        `component` (x, y, z); every variable has its unit in ``attrs["units"]``."""
        from .labelled import dataset_of

        return dataset_of(self)

    def _attributes(self, units: Mapping[str, str]) -> dict[str, Any]:
        return {
            "units": {"time": self._about["units"]["time"], **units},
            "title": self._about["title"],
            "model": self.model_checksum,
        }

    def __repr__(self) -> str:
        accuracy = self.accuracy
        doubt = "" if accuracy is None or accuracy["accurate"] else ", beyond 100 ERROR: see accuracy"
        channels = len(self._columns)
        return f"<Result {self.outcome}: {len(self.time)} outputs of {channels} channels{doubt}>"

    def _repr_html_(self) -> str:
        stats = self.stats
        heads = ("friction", "joint", "peak", "at time", "dissipated", "stuck", "transition", "sliding")
        rows = "".join(
            "<tr>"
            + "".join(
                f"<td>{escape(cell)}</td>"
                for cell in (
                    said["friction"],
                    said["joint"],
                    f"{said['peak']['value']:.4g} {said['peak']['unit']}",
                    f"{said['peak']['time']:.4g}",
                    f"{said['dissipated']['value']:.4g} {said['dissipated']['unit']}",
                    *(str(said["outputs"][regime]) for regime in REGIMES),
                )
            )
            + "</tr>"
            for said in self._report["frictions"]
        )
        return (
            f"<h4>{escape(self._about['title'])}</h4><p>{escape(self.message)}: {stats['outputs']} "
            f"outputs, {stats['steps']} steps, {stats['elapsed_seconds']:.2f} s</p>"
            f"<table><tr>{''.join(f'<th>{head}</th>' for head in heads)}</tr>{rows}</table>"
        )


def check_formats(formats: Sequence[str], known: Sequence[str]) -> None:
    """Raises `ParameterError` for a format of results that is none of those known."""
    for format in formats:
        if format not in known:
            raise ParameterError(str(unknown("format", format, known)))


class Interrupted(KeyboardInterrupt):
    """Ctrl-C stopped a run; `result` has what was computed until then."""

    def __init__(self, result: Result) -> None:
        super().__init__(result.message)
        self.result = result


class FrictionResult:
    """What one friction did over `time`: channels by name, read-only numpy arrays.

    | channel | what it is |
    |---|---|
    | `force`, `torque` | friction on the part of marker I: of a joint that slides, that turns |
    | `load` (`normal`) | effective load at the sliding surfaces |
    | `mu` | coefficient of friction, opposing the motion |
    | `velocity` | velocity of the surfaces, I relative to J |
    | `creep` | creep of the surfaces while they stick |
    | `regime` | 0 stuck, 1 transition, 2 sliding |
    | `share_preload`, `share_reaction` | parts of the friction by its cause, together 1 where there is any |
    | `share_bending`, `share_torsion` | the other two |
    | `power`, `work`, `stored`, `dissipated` | energy taken out of the motion |
    | `limited` | 1 where a limit of the friction was reached |
    | `sticks`, `stuck_time`, `largest_creep` | what was counted so far |

    A cylindrical joint has both a force and a torque. About one axis all have signs; in a spherical joint they
    are magnitudes. The components of result files are there as well, in lower case: `fx`, `murz`,
    `creep_ax`, `by_bending`, ...
    """

    def __init__(self, result: Result, entity: _Entity, detail: _Entity) -> None:
        self._result = result
        self.name, self.id = entity.element, entity.id
        """Name and id of the FRICTION."""
        self.joint: str = result._about["frictions"][self.id]
        """Name of its joint, and its type as in the dataset."""
        self.joint_kind: str = result._about["joints"][self.id]
        self._columns = {
            name.lower(): column
            for one in (entity, detail)
            for name, column in one.columns.items()
        }

    @property
    def time(self) -> Floats:
        """Times of the outputs."""
        return self._result.time

    @property
    def slides(self) -> bool:
        """Whether its load is a force: the joint slides."""
        return self.joint_kind in ("TRANSLATIONAL", "CYLINDRICAL")

    @property
    def turns(self) -> bool:
        """Whether there is turning."""
        return self.joint_kind != "TRANSLATIONAL"

    @cached_property
    def _named(self) -> dict[str, tuple[str, Callable[[], Floats]]]:
        """Units of our own channels and how they come about."""
        unit = {name: column.unit for name, column in self._columns.items()}
        named: dict[str, tuple[str, Callable[[], Floats]]] = {}
        if self.slides:
            named["force"] = (unit["friction"], lambda: self["friction"])
        if self.turns:
            # Of a joint that slides as well the torque is beside the friction along the axis.
            torque = "tz" if self.slides else "friction"
            named["torque"] = (unit["tz"], lambda: self[torque])
        coefficient, creep = ("mu{}", "creep_{}") if self.slides else ("mur{}", "creep_a{}")
        for name, raw in (("mu", coefficient), ("creep", creep)):
            named[name] = (unit[raw.format("z")], self._about_axis(raw))
        named["normal"] = (unit["load"], lambda: self["load"])
        for cause in _CAUSES:
            named[f"share_{cause}"] = ("", self._share(cause))
        return named

    def _about_axis(self, raw: str) -> Callable[[], Floats]:
        def value() -> Floats:
            three = [self[raw.format(axis)] for axis in "xyz"]
            if self.joint_kind == "SPHERICAL":
                return _length(three)
            # The motion has one axis of I; the two other components are zero.
            return three[0] + three[1] + three[2]

        return value

    def _share(self, cause: str) -> Callable[[], Floats]:
        def value() -> Floats:
            import numpy as np

            total = sum(np.abs(self[f"by_{one}"]) for one in _CAUSES)
            own = np.abs(self[f"by_{cause}"])
            return np.divide(own, total, out=np.zeros_like(own), where=np.asarray(total > 0))

        return value

    @property
    def channels(self) -> tuple[str, ...]:
        """Names of the channels: ours, then those of result files."""
        return (*self._named, *self._columns)

    @property
    def units(self) -> Mapping[str, str]:
        """Units by channel; empty for plain numbers."""
        own = {name: unit for name, (unit, _) in self._named.items()}
        return {**own, **{name: column.unit for name, column in self._columns.items()}}

    def __getitem__(self, channel: str) -> Floats:
        name = channel.lower()
        if name in self._named:
            return self._named[name][1]()
        if name in self._columns:
            return self._result._row(self._columns[name])
        raise unknown("channel of friction", channel, self.channels)

    def __getattr__(self, name: str) -> Floats:
        if name.startswith("_") or name in ("name", "id", "joint", "joint_kind"):
            raise AttributeError(name)
        try:
            return self[name]
        except LookupError as error:
            raise AttributeError(str(error)) from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.channels]

    def __iter__(self) -> Iterator[str]:
        return iter(self.channels)

    def to_pandas(self) -> pandas.DataFrame:
        """Its channels over time; ``attrs["units"]`` has the units."""
        import pandas

        time = pandas.Index(self.time, name="time", copy=False)
        columns = {name: self[name] for name in self.channels}
        frame = pandas.DataFrame(columns, time, copy=False)
        frame.attrs.update(self._result._attributes(self.units))
        return frame

    def to_polars(self) -> polars.DataFrame:
        """Its channels and the column `time`."""
        import polars

        return polars.DataFrame({"time": self.time, **{name: self[name] for name in self.channels}})

    def __repr__(self) -> str:
        return f"<FrictionResult {self.name!r} of {self.joint_kind} {self.joint!r}>"


def _length(three: list[Floats]) -> Floats:
    import numpy as np

    return np.asarray(np.sqrt(three[0] ** 2 + three[1] ** 2 + three[2] ** 2))
