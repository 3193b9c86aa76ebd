"""What the package takes from Rust; see crates/python/src."""

from collections.abc import Callable

class InputFailure(Exception):
    """What is wrong with an input: text for people, and its messages as JSON."""

class OutputFailure(Exception):
    """A file that cannot be written: its path, and why."""

class Project:
    """A dataset with its commands and the changes made to it."""

    @staticmethod
    def load(path: str, texts: dict[str, bytes] | None = None) -> Project: ...
    def changed(self, changes: list[str]) -> Project: ...
    def texts(self) -> dict[str, bytes]: ...
    def checksum(self) -> str: ...
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
    facts: list[tuple[str, str]],
    told: Callable[[float, float], object] | None,
) -> tuple[str, bytes, bytes, bytes, str, str, str, BaseException | None]: ...
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
