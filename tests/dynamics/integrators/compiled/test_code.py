"""Machine code of a structure: kept on disk, rebuilt where it is damaged, under a key of all that it depends on."""

import os
from pathlib import Path

import numpy as np
import pytest

from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.compiled import availability as ready
from abu_calc.dynamics.integrators.compiled import code as compiled_code
from abu_calc.dynamics.integrators.compiled import llvm_engine as machine
from abu_calc.dynamics.integrators.compiled import run as compiled
from tests.dynamics.scenes import scene_on


@pytest.mark.slow
def test_code_is_kept_on_disk_and_rebuilt_where_it_is_damaged(fresh: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    equations = assemble(scene_on("planar", DryRollingFrictionEffect(0.002, 0.1)))
    built: list[str] = []
    original = machine.compiled
    monkeypatch.setattr(machine, "compiled", lambda text: built.append(text) or original(text))  # type: ignore[func-returns-value]
    assert not ready.loaded(equations, "rk45")
    runs = [compiled.integrate(equations, 1e-6, [2.0]).y]
    assert len(built) == len(list(fresh.iterdir())) == 2
    assert ready.loaded(equations, "rk45") and not ready.loaded(equations, "dop853")
    for damages in ((bytes, bytes), (lambda code: code[:-100], lambda code: os.urandom(len(code)))):
        before = {path: path.read_bytes() for path in fresh.iterdir()}
        for damage, (place, content) in zip(damages, before.items(), strict=True):
            place.write_bytes(damage(content))
        compiled_code._codes.clear()
        compiled_code._texts.clear()
        compiled_code._loops.clear()
        assert not ready.loaded(equations, "rk45")
        runs.append(compiled.integrate(equations, 1e-6, [2.0]).y)
        assert {path: path.read_bytes() for path in fresh.iterdir()} == before
    assert len(built) == 2 + 0 + 2
    assert all(np.array_equal(run, runs[0]) for run in runs)


def test_the_key_tells_numbers_from_outside_apart(fresh: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A constant of another file is in the machine code."""
    text = "def go() -> float:\n return SIZE\n"
    keys = {compiled_code._key([(text, {"SIZE": size})]) for size in (1.0, 2.0, 1)}
    keys.add(compiled_code._key([(text + "\n", {"SIZE": 1.0})]))
    monkeypatch.setattr(machine, "described", lambda: "another processor")
    keys.add(compiled_code._key([(text, {"SIZE": 1.0})]))
    assert len(keys) == 5
