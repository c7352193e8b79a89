"""Windows' ways of failing, simulated: narrow consoles, locked files, no fork, no limits of resources.

None of this has run on Windows itself.
"""

import builtins
import io
import signal
import sys
from pathlib import Path
from typing import Any

import pytest

from abu_calc.cli import app
from abu_calc.cli.streams import make_safe
from abu_calc.foundation.parallel import interrupts_left_to_parent, process_pool
from tests.cli.runner import abu


def test_workers_are_started_afresh_where_signals_cannot_be_held_back(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(signal, "pthread_sigmask", raising=False)
    with interrupts_left_to_parent():
        pool: Any = process_pool(1)
    assert pool._mp_context.get_start_method() == "spawn"
    pool.shutdown()


@pytest.mark.parametrize("encoding", ["cp1252", "cp866", "ascii"])
def test_narrow_consoles_get_other_signs(encoding: str, monkeypatch: pytest.MonkeyPatch) -> None:
    raw = io.BytesIO()
    consoles = [io.TextIOWrapper(io.BufferedWriter(each), encoding=encoding) for each in (raw, io.BytesIO())]  # type: ignore[type-var]
    for name, console in zip(("stdout", "stderr"), consoles, strict=True):
        monkeypatch.setattr(sys, name, console)
    make_safe()
    print("→ √2 µm ≤ Ω █")
    sys.stdout.flush()
    assert raw.getvalue().decode(encoding).startswith(("-> sqrt2", "-> √2"))


@pytest.mark.parametrize("more", [(), ("--force",)])
def test_a_file_that_another_program_holds_open_is_named(
    more: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: Any) -> None:
        raise PermissionError(13, "The process cannot access the file because it is being used by another process")

    for name in ("replace", "hardlink_to", "rename"):
        monkeypatch.setattr(Path, name, refuse)
    file = tmp_path / "presets.json"
    if more:
        file.write_text("{}", encoding="utf-8")
    seen = abu("presets", "--output", str(file), *more)
    assert seen.status == 2 and str(file) in seen.err and "used by another process" in seen.err
    assert [path.name for path in tmp_path.iterdir() if path.stat().st_size > 2] == []


def test_a_system_without_limits_of_resources_has_none(monkeypatch: pytest.MonkeyPatch) -> None:
    real = builtins.__import__

    def without(name: str, *rest: Any) -> Any:
        if name == "resource":
            raise ImportError(name)
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without)
    assert app._memory() is None
