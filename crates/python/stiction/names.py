"""Looking things up by name or id, with what may have been meant where there is no such thing."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import Generic, TypeVar

from . import _native
from .diagnostics import (
    Diagnostics,
    FolderError,
    InputError,
    OutputError,
    ParameterError,
    UnknownName,
)

T = TypeVar("T")


def unknown(what: str, name: object, known: Iterable[str]) -> UnknownName:
    """The error for a name that does not exist."""
    from difflib import get_close_matches

    names = list(dict.fromkeys(known))
    lower = {other.lower(): other for other in names}
    close = [lower[match] for match in get_close_matches(str(name).lower(), lower, n=3)]
    if close:
        help = f"is {' or '.join(close)} meant?"
    elif names:
        shown = ", ".join(names[:12])
        help = f"there are {shown}{', ...' if len(names) > 12 else ''}"
    else:
        help = f"there is no {what} at all"
    return UnknownName(f"there is no {what} {name!r}; {help}")


class Named(Mapping[str, T], Generic[T]):
    """Things by name (in any case) or by id, in the order of the file.

    A thing may have other names that lead to it as well: a friction that of its joint.
    """

    def __init__(
        self,
        what: str,
        things: Iterable[tuple[str, int, T]],
        others: Iterable[tuple[str, T]] = (),
    ) -> None:
        self._what = what
        self._things: dict[str, T] = {}
        self._ids: dict[int, T] = {}
        self._lower: dict[str, T] = {}
        for name, id, thing in things:
            # Where two have the same name the second is known by its id alone.
            self._things.setdefault(name, thing)
            self._ids.setdefault(id, thing)
            self._lower.setdefault(name.lower(), thing)
        self._names = list(self._things)
        for name, thing in others:
            if name.lower() not in self._lower:
                self._names.append(name)
                self._lower[name.lower()] = thing

    def __getitem__(self, name: str | int) -> T:
        found = self._ids.get(name) if isinstance(name, int) else self._lower.get(name.lower())
        if found is None:
            if isinstance(name, int):
                raise unknown(self._what, name, map(str, self._ids))
            raise unknown(self._what, name, self._names)
        return found

    def __contains__(self, name: object) -> bool:
        return name in self._ids or (isinstance(name, str) and name.lower() in self._lower)

    def __iter__(self) -> Iterator[str]:
        return iter(self._things)

    def __len__(self) -> int:
        return len(self._things)

    def __repr__(self) -> str:
        return f"<{len(self)} {self._what}s: {', '.join(self._things)}>"


@contextmanager
def typed_errors() -> Iterator[None]:
    """Raises what fails in Rust as the exceptions of this module."""
    try:
        yield
    except _native.InputFailure as failure:
        text, messages = failure.args
        raise InputError(text.rstrip(), Diagnostics._of_json(messages)) from None
    except _native.OutputFailure as failure:
        path, cause = failure.args
        raise OutputError(f"cannot write {path}: {cause}") from None
    except _native.NameFailure as failure:
        what, name, known = failure.args
        raise unknown(what, name, known) from None
    except _native.ValueFailure as failure:
        raise ParameterError(failure.args[0]) from None
    except _native.FolderFailure as failure:
        raise FolderError(failure.args[0]) from None
