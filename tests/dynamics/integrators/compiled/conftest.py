"""Compiled code as a process meets it that has none."""

from pathlib import Path

import pytest

from abu_calc.dynamics.integrators.compiled import availability as ready
from abu_calc.dynamics.integrators.compiled import code as compiled_code
from abu_calc.foundation import disk_cache as cache


@pytest.fixture
def fresh(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """As in a new process with an empty folder."""
    for name in ("_codes", "_texts", "_loops"):
        monkeypatch.setattr(compiled_code, name, {})
    monkeypatch.setattr(ready, "_failures", [])
    monkeypatch.setenv(cache.FOLDER, str(tmp_path))
    return tmp_path
