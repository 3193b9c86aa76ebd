"""Messages about a model, with their places, and the exceptions that carry them."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any, overload


@dataclass(frozen=True)
class Diagnostic:
    """One message about one place of a file.

    Lines and columns count from 1; `text` is the message as the program shows it, with the line of
    the file and a mark under the place. `code` is explained in docs/diagnostics.md.
    """

    severity: str
    code: str
    message: str
    file: str
    line: int
    column: int
    end_line: int
    end_column: int
    help: str | None
    notes: tuple[str, ...]
    text: str

    def __str__(self) -> str:
        return self.text.rstrip()

    @classmethod
    def _of(cls, said: dict[str, Any]) -> Diagnostic:
        start, end = said["span"]["start"], said["span"]["end"]
        return cls(
            severity=said["severity"],
            code=said["code"],
            message=said["message"],
            file=said["file"],
            line=start["line"],
            column=start["column"],
            end_line=end["line"],
            end_column=end["column"],
            help=said["help"],
            notes=tuple(said["notes"]),
            text=said["text"],
        )


class Diagnostics(Sequence[Diagnostic]):
    """Messages in the order of the files; notebooks show them as a table."""

    def __init__(self, messages: Iterable[Diagnostic] = ()) -> None:
        self._messages = tuple(messages)

    @classmethod
    def _of_json(cls, text: str) -> Diagnostics:
        return cls(Diagnostic._of(said) for said in json.loads(text))

    @overload
    def __getitem__(self, index: int) -> Diagnostic: ...
    @overload
    def __getitem__(self, index: slice) -> Diagnostics: ...
    def __getitem__(self, index: int | slice) -> Diagnostic | Diagnostics:
        if isinstance(index, slice):
            return Diagnostics(self._messages[index])
        return self._messages[index]

    def __len__(self) -> int:
        return len(self._messages)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Diagnostics) and self._messages == other._messages

    def __hash__(self) -> int:
        return hash(self._messages)

    def __repr__(self) -> str:
        return f"Diagnostics({list(self._messages)!r})"

    def __str__(self) -> str:
        return "\n".join(str(message) for message in self._messages)

    def _repr_html_(self) -> str:
        if not self._messages:
            return "<p>no messages</p>"
        rows = "".join(
            f"<tr><td>{escape(message.severity)}</td><td>{escape(message.code)}</td>"
            f"<td>{escape(message.file)}:{message.line}:{message.column}</td>"
            f"<td>{escape(message.message)}</td><td>{escape(message.help or '')}</td></tr>"
            for message in self._messages
        )
        head = "<tr><th>severity</th><th>code</th><th>place</th><th>message</th><th>help</th></tr>"
        return f"<table>{head}{rows}</table>"


class StictionError(Exception):
    """What stiction raises on purpose."""


class InputError(StictionError, ValueError):
    """A model, a change of it or a command that cannot be used; `diagnostics` say where and why."""

    def __init__(self, message: str, diagnostics: Diagnostics = Diagnostics()) -> None:
        super().__init__(message, diagnostics)
        self.diagnostics = diagnostics

    def __str__(self) -> str:
        return str(self.args[0])


class ParameterError(StictionError, ValueError):
    """An argument of a call that is out of its range, not finite or of another unit."""


class UnknownName(StictionError, LookupError):
    """There is nothing of that name; the message has the names that may have been meant."""


class OutputError(StictionError, OSError):
    """Results that cannot be written."""


class FolderError(OutputError):
    """A folder that cannot take a study: it is in use, or holds another one."""


class ClusterError(StictionError, ConnectionError):
    """A cluster that does not answer, or has no workers any more."""
