"""Models: what they hold, changing them, running them."""

from __future__ import annotations

import json
import math
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from html import escape
from pathlib import Path
from typing import Any, Union

from . import _native
from .diagnostics import Diagnostics, ParameterError
from .files import refuse_used, write_whole
from .names import Named, typed_errors, unknown
from .result import Result, check_formats
from .units import Quantity, converted

Value = Union[float, Quantity, str, Sequence[Union[float, str]]]
"""What an argument of a statement can be given: a number (model units), a number with its unit, a
word or expression, or several of them."""


@dataclass(frozen=True)
class Element:
    """An element of a model: its statement, id and name, and the statement as it is now."""

    statement: str
    id: int
    name: str
    text: str = field(repr=False)


@dataclass(frozen=True)
class Part(Element):
    """A PART; `mass` in the model's unit, None where the file gives none."""

    mass: float | None
    ground: bool


@dataclass(frozen=True)
class Joint(Element):
    """A JOINT of a kind between the markers `i` and `j` (ids), with its frictions."""

    kind: str
    i: int
    j: int
    frictions: tuple[Friction, ...]

    @property
    def friction(self) -> Friction | None:
        """The friction of the joint, None where it has none. Of two (the yokes of a Hooke or
        universal joint) it is the first."""
        return self.frictions[0] if self.frictions else None


@dataclass(frozen=True)
class Friction(Element):
    """A FRICTION. Its arguments are attributes by their keywords in lower case: `mu_static`,
    `formulation`, `pin_radius`, ...; numbers are in model units, which `units` has by argument.
    `given` names those that the file gives; the others have their defaults."""

    joint: str
    yoke: str | None
    arguments: Mapping[str, Any] = field(repr=False)
    units: Mapping[str, str] = field(repr=False)
    given: frozenset[str] = field(repr=False)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name == "arguments":
            raise AttributeError(name)
        if name not in self.arguments:
            raise AttributeError(str(unknown("argument of FRICTION", name, self.arguments)))
        return self.arguments[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.arguments]

    def __repr__(self) -> str:
        shown = [f"{name}={self._shown(name)}" for name in self.arguments if name in self.given]
        return f"Friction({self.name!r}, joint={self.joint!r}, {', '.join(shown)})"

    def _shown(self, name: str) -> str:
        value, unit = self.arguments[name], self.units.get(name, "")
        return f"{value!r} {unit}" if unit else f"{value!r}"


class Model:
    """A dataset with its commands. It does not change: `replace` makes another one.

    Parts, joints, frictions and so on are found by name (that of Adams View, in any case) or by id.
    """

    def __init__(self, project: _native.Project, path: str, changes: tuple[str, ...]) -> None:
        self._project = project
        self._path = path
        self._changes = changes

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (self._path, self._project.texts(), self._changes)

    @cached_property
    def _about(self) -> dict[str, Any]:
        about: dict[str, Any] = json.loads(self._project.description())
        return about

    @property
    def title(self) -> str:
        """The first line of the dataset."""
        return str(self._about["title"])

    @property
    def units(self) -> Mapping[str, str]:
        """Names of the units of length, mass, force, time and angle."""
        return dict(self._about["units"])

    @property
    def commands(self) -> tuple[str, ...]:
        """The commands of the command file, each on one line; none for a dataset alone."""
        return tuple(self._about["commands"])

    @property
    def changes(self) -> tuple[str, ...]:
        """What `replace` has changed, as commands."""
        return self._changes

    @property
    def checksum(self) -> str:
        """A checksum (SHA-256) of the dataset and of the changes made to it."""
        return self._project.checksum()

    @cached_property
    def diagnostics(self) -> Diagnostics:
        """Warnings about the model and its commands."""
        return Diagnostics._of_json(self._project.diagnostics())

    def elements(self, statement: str) -> Named[Element]:
        """The elements of a statement, such as ``model.elements("SFORCE")``."""
        wanted = statement.upper()
        found = [said for said in self._about["elements"] if said["statement"] == wanted]
        return Named(
            wanted.lower(),
            ((said["name"], said["id"], Element(**self._head(said))) for said in found),
        )

    def _head(self, said: Mapping[str, Any]) -> dict[str, Any]:
        statement, id = said["statement"], said["id"]
        text = self._project.statement(statement, id) or ""
        return {"statement": statement, "id": id, "name": said["name"], "text": text}

    def _heads(self, statement: str) -> dict[int, dict[str, Any]]:
        elements = self._about["elements"]
        return {e["id"]: self._head(e) for e in elements if e["statement"] == statement}

    @cached_property
    def parts(self) -> Named[Part]:
        """PARTs, the ground among them."""
        heads = self._heads("PART")
        parts = [
            Part(**heads[part["id"]], mass=part["mass"], ground=part["ground"])
            for part in self._about["parts"]
        ]
        return Named("part", ((part.name, part.id, part) for part in parts))

    @cached_property
    def frictions(self) -> Named[Friction]:
        """FRICTIONs; the name of its joint finds a friction, too."""
        heads, joints = self._heads("FRICTION"), self._heads("JOINT")
        frictions = []
        for said in self._about["frictions"]:
            arguments = said["arguments"]
            units = {name: unit for name, _, unit, _ in arguments}
            frictions.append(
                Friction(
                    **heads[said["id"]],
                    joint=joints[said["joint"]]["name"],
                    yoke=said["yoke"],
                    arguments={name: value for name, value, _, _ in arguments},
                    units=units,
                    given=frozenset(name for name, _, _, given in arguments if given),
                )
            )
        own = ((friction.name, friction.id, friction) for friction in frictions)
        return Named("friction", own, ((friction.joint, friction) for friction in frictions))

    @cached_property
    def joints(self) -> Named[Joint]:
        """JOINTs with their frictions."""
        heads = self._heads("JOINT")
        joints = []
        for said in self._about["joints"]:
            head = heads[said["id"]]
            frictions = tuple(self._frictions_of(said["id"]))
            joint = Joint(**head, kind=said["kind"], i=said["i"], j=said["j"], frictions=frictions)
            joints.append(joint)
        return Named("joint", ((joint.name, joint.id, joint) for joint in joints))

    def _frictions_of(self, joint: int) -> list[Friction]:
        said = self._about["frictions"]
        return [self.frictions[one["id"]] for one in said if one["joint"] == joint]

    def replace(self, changes: Mapping[str, Value]) -> Model:
        """The model with other arguments: ``model.replace({"slide.mu_static": 0.25})``.

        Before the dot stands the name of an element, of a joint for its friction, or statement and id
        as in ``"FRICTION/103.mu_static"``; behind it the keyword in any case. Numbers are in model
        units; `Quantity` has its own.

        Raises `UnknownName`, `ParameterError` where a number is not finite or has
        another unit, and `InputError` for what the dataset language refuses.
        """
        statements = tuple(self._change(place, value) for place, value in changes.items())
        with typed_errors():
            project = self._project.changed(list(statements))
        return Model(project, self._path, self._changes + statements)

    def write(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Writes the dataset (`.adm`) with the changes of `replace`: arguments are replaced where they
        stand, and comments, layout and all else are as they were. Commands are not part of it, and
        files that it names are looked for beside it.

        Raises `OutputError` where the file is there already, unless `overwrite`, and where it
        cannot be written; it is written as a whole or not at all.
        """
        with typed_errors():
            content = self._project.dataset_file()
        write_whole(path, content, overwrite)

    def _change(self, place: str, value: Value) -> str:
        with typed_errors():
            change, unit = self._project.argument(place)
        return f"{change}={_written(place, value, unit)}"

    def run(
        self,
        end: float | None = None,
        *,
        dtout: float | None = None,
        steps: int | None = None,
        error: float | None = None,
        integrator: str | None = None,
        reactions: str = "kept",
        reaction_length: float | None = None,
        check_accuracy: bool = True,
        output: str | os.PathLike[str] | None = None,
        formats: Sequence[str] = ("res",),
        overwrite: bool = False,
        progress: bool | Callable[[float, float], object] = False,
    ) -> Result:
        """Simulates the model: the commands of its command file, or the dynamics of a dataset alone
        until `end`, with an output every `dtout` or `steps` of them (model's unit of time).

        `error` is the error tolerance. `integrator` is a method of integration in the place of that
        of the model, whose ERROR stays as it is: "gstiff-si2" (backward differentiation with position
        and velocity constraints, the one for friction), "gstiff-i3" (position constraints alone, which
        passes singular positions), "hht", "newmark" (second order, with numerical damping) or "adams"
        (Adams-Moulton up to order 12: about half the steps for smooth motion at tight errors, not for
        bristles at tight errors nor for singular positions); or it is the rest of an INTEGRATOR
        statement, such as ``"HHT, ERROR=1e-6"``. `reactions` are those of redundant constraints, which
        friction follows: "kept" (those of the equations that are kept, which is arbitrary) or
        "least-squares" (the least of all that give the same motion, as of equally stiff joints, torques
        divided by `reaction_length`, that of the model if not given). A second run beside it, with a
        tenth of the error tolerance in a thread of its own, tells how accurate the run is:
        `Result.accuracy`, and a diagnostic where it is beyond a hundred of that tolerance;
        `check_accuracy=False` leaves it out, which changes no result. With `output` results are written
        into that folder while it runs, in the `formats` "res" (`.res` and `.req`), "parquet" and "csv"
        (tables `friction` and `states`), and the message file; a folder that has something in it is
        refused unless `overwrite`. `progress` shows how far it is, or is called with time and end.

        Other threads of Python go on meanwhile. Ctrl-C stops the run and raises
        `Interrupted`, a KeyboardInterrupt that has the results so far. A run that fails
        raises nothing: `success` and `message` of the result tell. `InputError` is raised
        for what cannot be simulated, with its place.
        """
        for name, number in (("end", end), ("dtout", dtout), ("error", error)):
            if number is not None and not (math.isfinite(number) and number > 0):
                raise ParameterError(f"{name} must be a positive number, it is {number}")
        if steps is not None and not 0 < steps < 2**32:
            raise ParameterError(f"steps must be a positive number of outputs, it is {steps}")
        if steps is not None and dtout is not None:
            raise ParameterError("steps and dtout say the same; give one of them")
        check_formats(formats, ("res", "parquet", "csv"))
        alone = self._about["is_dataset_alone"]
        if alone and end is None:
            raise ParameterError("a dataset alone has no commands; give the end of the simulation")
        if not alone and not (end is steps is dtout is None):
            raise ParameterError(
                "the command file says what to simulate; load the dataset (.adm) to give an end"
            )
        options = {
            "end": end,
            "steps": steps,
            "dtout": dtout,
            "error": error,
            "integrator": integrator,
            "reactions": reactions,
            "reaction_length": reaction_length,
            "check_accuracy": check_accuracy,
            "changes": list(self._changes),
        }
        with typed_errors():
            project, method = self._project, None
            if integrator is not None and integrator.lower() in _native.METHODS:
                method = integrator
            elif integrator is not None:
                project = _with_statement(project, integrator)
            told = progress if callable(progress) else _show if progress else None
            folder = None if output is None else os.fspath(output)
            if folder is not None and not overwrite:
                refuse_used(Path(folder))
            ran = _native.run(
                project,
                folder,
                list(formats),
                end,
                steps,
                dtout,
                error,
                method,
                (reactions, reaction_length),
                check_accuracy,
                [("model", self.checksum), ("options", json.dumps(options))],
                told,
            )
        if progress is True:
            print(file=sys.stderr)
        return Result._of_run(ran, self, options)

    def __repr__(self) -> str:
        counts = f"{len(self.parts)} parts, {len(self.joints)} joints, {len(self.frictions)} frictions"
        return f"<Model {self.title!r}: {counts}>"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{escape(friction.name)}</td><td>{escape(friction.joint)}</td>"
            f"<td>{escape(friction.formulation.lower())}</td>"
            f"<td>{friction.mu_static:g}</td><td>{friction.mu_dynamic:g}</td></tr>"
            for friction in self.frictions.values()
        )
        head = "".join(f"<th>{name}</th>" for name in ("friction", "joint", "law", "static", "dynamic"))
        units = ", ".join(self.units.values())
        return (
            f"<h4>{escape(self.title)}</h4><p>{len(self.parts)} parts, {len(self.joints)} joints, "
            f"{len(self.frictions)} frictions; {escape(units)}; {len(self.diagnostics)} warnings</p>"
            f"<table><tr>{head}</tr>{rows}</table>"
        )


def _show(time: float, end: float) -> None:
    share = 100.0 * time / end if end > 0 else 0.0
    print(f"\r{time:.6g} of {end:.6g} ({share:.0f} %)", end="", file=sys.stderr, flush=True)


def _with_statement(project: _native.Project, integrator: str) -> _native.Project:
    """The project with an INTEGRATOR statement; a word that it does not know was to be a method."""
    try:
        return project.changed([f"INTEGRATOR/{_line('integrator', integrator)}"])
    except _native.InputFailure:
        if integrator.replace("-", "").isalnum():
            raise unknown("integrator", integrator, _native.METHODS) from None
        raise


def _line(place: str, text: str) -> str:
    if any(mark in text for mark in "\n\r!"):
        raise ParameterError(f"{place}: {text!r} is not on one line")
    return text


def _written(place: str, value: Value, unit: str | None) -> str:
    """A value as the dataset language writes it."""
    if isinstance(value, str):
        return _line(place, value)
    if isinstance(value, Quantity):
        if unit is None:
            raise ParameterError(f"{place}: units are known for arguments of FRICTION alone")
        return _written(place, converted(value, unit), unit)
    if isinstance(value, Sequence):
        return ", ".join(_written(place, one, unit) for one in value)
    number = float(value)
    if not math.isfinite(number):
        raise ParameterError(f"{place} must be a finite number, it is {number}")
    return repr(number)


def load(path: str | os.PathLike[str]) -> Model:
    """Reads a dataset (`.adm`) or a command file (`.acf`) with the dataset that it names.

    Raises `InputError` with everything that is wrong with the files.
    """
    shown = os.fspath(path)
    with typed_errors():
        return Model(_native.Project.load(shown), shown, ())


def loads(text: str, name: str = "model.adm", files: Mapping[str, str] | None = None) -> Model:
    """Reads a model from a text; `name` stands for its file in messages, and its ending says whether
    it is a dataset (`.adm`) or a command file (`.acf`), whose dataset is then one of `files`, which
    are texts by their names."""
    texts = {other: content.encode() for other, content in (files or {}).items()}
    texts[name] = text.encode()
    return _unpickled(name, texts, ())


def _unpickled(path: str, texts: dict[str, bytes], changes: tuple[str, ...]) -> Model:
    with typed_errors():
        project = _native.Project.load(path, texts)
        return Model(project.changed(list(changes)) if changes else project, path, changes)
