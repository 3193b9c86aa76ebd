"""What the package takes from Rust; see crates/python/src."""

from collections.abc import Callable
from typing import Any

#: Version of the solver.
__version__: str
#: Names of the methods of integration.
METHODS: list[str]

class InputFailure(Exception):
    """What is wrong with an input: text for people, and its messages as JSON."""

class OutputFailure(Exception):
    """A file that cannot be written: its path, and why."""

class NameFailure(Exception):
    """A name of nothing: what it should name, the name, and the names that there are."""

class ValueFailure(Exception):
    """A value that cannot be used: why, and what to write instead."""

class FolderFailure(Exception):
    """A folder that cannot take a study: why, and what to do."""

def conversion(from_: str, into: str, /) -> float: ...

class Project:
    """A dataset with its commands and the changes made to it."""

    @staticmethod
    def load(path: str, texts: dict[str, bytes] | None = None) -> Project: ...
    def changed(self, changes: list[str]) -> Project: ...
    def argument(self, name: str) -> tuple[str, str | None]: ...
    def texts(self) -> dict[str, bytes]: ...
    def checksum(self) -> str: ...
    def dataset_file(self) -> bytes: ...
    def description(self) -> str: ...
    def diagnostics(self) -> str: ...
    def statement(self, statement: str, id: int) -> str | None: ...

def run(
    model: Project,
    folder: str | None,
    formats: list[str],
    end: float | None,
    steps: int | None,
    dtout: float | None,
    error: float | None,
    method: str | None,
    reactions: tuple[str, float | None],
    check_accuracy: bool,
    facts: list[tuple[str, str]],
    told: Callable[[float, float], object] | None,
) -> tuple[str, bytes, bytes, bytes, str, str, str, BaseException | None]: ...
def save(
    folder: str,
    formats: list[str],
    table: tuple[str, bytes, bytes, bytes],
    title: str,
    time_unit: str,
    facts: list[tuple[str, str]],
) -> None: ...
Ran = tuple[str, bytes, bytes, bytes, str, str, str, BaseException | None]
Parameter = tuple[
    str,
    list[tuple[float | str, str | None]],
    tuple[float, float, bool, str | None] | None,
]
Settings = tuple[float | None, int | None, float | None, float | None]
Definition = tuple[
    list[Parameter], str, int | None, int, list[tuple[str, bool, str]], Settings
]
Row = tuple[int, list[float | None], bool, str, int]
Called = Callable[[int, Ran, str], list[float] | str]

def read_study(path: str) -> tuple[str, Definition, str]: ...

class Study:
    """A study that was put together."""

    def __init__(
        self,
        model: Project,
        parameters: list[Parameter],
        design: str,
        cases: int | None,
        seed: int,
        outputs: list[tuple[str, bool, str]],
        settings: Settings,
    ) -> None: ...
    def cases(self) -> int: ...
    def manifest(self) -> str: ...
    def units(self) -> str: ...
    def seed(self, case: int) -> int: ...
    def changes(self, case: int) -> list[str]: ...
    def record(self, folder: str | None, resume: bool) -> Record: ...
    def run(self, cases: list[int], called: Called | None) -> list[Row]: ...

class Record:
    """The cases of a study that are done."""

    def open_cases(self) -> list[int]: ...
    def counts(self) -> tuple[int, int]: ...
    def summary(self, folder: str, seconds: float) -> str: ...
    def push(self, rows: list[Row]) -> None: ...
    def finish(self) -> None: ...
    def run(
        self,
        workers: int | None,
        called: Called | None,
        told: Callable[[int, int], object] | None,
    ) -> None: ...
    def columns(self) -> list[tuple[str, str, Any]]: ...

def original(
    parameters: tuple[float, float, float, float, float],
    effect: str,
    velocity: bytes,
    creep: bytes,
) -> tuple[bytes, bytes, bytes]: ...
def lugre(
    parameters: tuple[float, float, float, float, float, float, float],
    gamma: float,
    velocity: bytes,
    deflection: bytes,
    load: bytes,
    preload: bytes,
) -> tuple[bytes, bytes, bytes]: ...
def lugre_stribeck(
    parameters: tuple[float, float, float, float, float, float, float], speed: bytes
) -> bytes: ...
