"""Studies that many tests ask for, made once a session: kept in memory, and in files for its other processes."""

import importlib
import inspect
import os
import pickle
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from hashlib import sha256
from pathlib import Path
from typing import Any

import pytest

from abu_calc.inputs.reading.document import FileReading

STUDIES = {
    "effects": "effects",
    "grinding": "grinding",
    "levels": "levels",
    "simulate": "simulate",
    "size": "design",
    "stability": "stability",
}
"""Folders of the studies that tests share, by their commands."""
NO_MATTER = {"progress", "workers"}
"""Arguments that change nothing in a result."""

_folder: list[Path] = []
_made: dict[str, Any] = {}


def share(folder: Path) -> None:
    """Where the processes of a session meet."""
    folder.mkdir(exist_ok=True)
    _folder[:] = [folder]


@contextmanager
def remembered() -> Iterator[None]:
    """A study of the same file, entries and arguments is not made anew; for tests that patch nothing of it."""
    with pytest.MonkeyPatch.context() as patch:
        for name in STUDIES:
            study = getattr(importlib.import_module(f"abu_calc.features.{STUDIES[name]}.study"), name)
            for own, module in list(sys.modules.items()):  # others may have imported it by its name
                if own.startswith("abu_calc.features.") and vars(module).get(name) is study:
                    patch.setattr(module, name, partial(_recalled, study))
        yield


def recalled(name: str, reading: FileReading, *arguments: Any, **named: Any) -> Any:
    """What the study of this name returns, for tests of what is made of it."""
    return _recalled(
        getattr(importlib.import_module(f"abu_calc.features.{STUDIES[name]}.study"), name), reading, *arguments, **named
    )


def _recalled(study: Callable[..., Any], source: Any, *arguments: Any, **named: Any) -> Any:
    if not isinstance(source, FileReading):
        return study(source, *arguments, **named)
    key = _key(study, source, *arguments, **named)
    if key not in _made:
        _made[key] = _read(key) or _written(key, study(source, *arguments, **named))
    return _made[key]


def _key(study: Callable[..., Any], reading: FileReading, *arguments: Any, **named: Any) -> str:
    given = inspect.signature(study).bind(reading, *arguments, **named)
    given.apply_defaults()
    others = [(name, repr(value)) for name, value in list(given.arguments.items())[1:] if name not in NO_MATTER]
    asked = study.__name__, type(reading).__name__, reading.file, reading.text, reading.overrides, others
    return sha256(repr(asked).encode()).hexdigest()


def _read(key: str) -> Any:
    for folder in _folder:
        if (folder / key).exists():
            return pickle.loads((folder / key).read_bytes())
    return None


def _written(key: str, result: Any) -> Any:
    for folder in _folder:
        part = folder / f"{key}.{os.getpid()}"
        part.write_bytes(pickle.dumps(result))
        part.replace(folder / key)
    return result
