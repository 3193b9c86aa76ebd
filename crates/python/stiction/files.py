"""Files and folders that are written as a whole or not at all."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from .diagnostics import OutputError


def write_whole(path: str | os.PathLike[str], content: bytes, overwrite: bool) -> None:
    """Writes a file under another name, which ends in `.part`, and then gives it its own."""
    target = Path(path)
    if target.exists() and not overwrite:
        raise OutputError(f"{target} is there already; overwrite=True replaces it")
    part = target.with_name(f"{target.name}.part")
    try:
        with part.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        part.replace(target)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise OutputError(f"cannot write {target}: {error.strerror}") from error


@contextmanager
def whole_folder(path: str | os.PathLike[str]) -> Iterator[Path]:
    """A folder to write into, which ends in `.part` until it is whole; then it gets its name. There
    must be nothing of that name but an empty folder."""
    target = Path(path)
    refuse_used(target)
    part = target.with_name(f"{target.name}.part")
    try:
        part.mkdir(parents=True)
    except FileExistsError:
        message = f"{part} is there: something writes {target.name}, or was stopped; remove it"
        raise OutputError(message) from None
    except OSError as error:
        raise OutputError(f"cannot make {part}: {error.strerror}") from error
    try:
        yield part
        part.replace(target)
    except OSError as error:
        if isinstance(error, OutputError):
            raise
        raise OutputError(f"cannot write {target}: {error.strerror}") from error
    finally:
        shutil.rmtree(part, ignore_errors=True)


def refuse_used(folder: Path) -> None:
    """Raises `OutputError` where a folder for results has something in it."""
    try:
        used = any(folder.iterdir())
    except FileNotFoundError:
        return
    except OSError as error:
        raise OutputError(f"cannot write into {folder}: {error.strerror}") from error
    if used:
        raise OutputError(f"{folder} is not empty; choose another folder")
