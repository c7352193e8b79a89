"""Numbers too small or too large to compute with are refused by their keys, before formulas divide by them."""

import tomllib
from pathlib import Path
from typing import Any

import pytest
import tomli_w

import abu_calc
from abu_calc.foundation.errors import Place
from abu_calc.inputs.variation import variation
from tests.cli.runner import abu
from tests.fuzz.inputs import _parent, _paths
from tests.fuzz.kinds import KINDS

TEXTS = {
    f"{kind.name} {number}": text
    for kind in KINDS
    if not kind.plain
    for number, text in enumerate(kind.texts)
}  # fmt: skip


def floats(document: dict[str, Any]) -> list[tuple[str | int, ...]]:
    """Paths of the numbers that may have a fraction, results to be expected left out."""
    return [
        path for path in _paths(document)
        if isinstance(_parent(document, path)[path[-1]], float) and path[0] != "expected"
    ]  # fmt: skip


@pytest.mark.few(3)
@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_denormals_are_refused_by_their_keys(text: str, tmp_path: Path) -> None:
    file, wrong = tmp_path / "machine.toml", []
    for path in floats(tomllib.loads(text)):
        document = tomllib.loads(text)
        _parent(document, path)[path[-1]] = 5e-324
        file.write_text(tomli_w.dumps(document), encoding="utf-8")
        seen = abu("validate", str(file))
        key = next(part for part in reversed(path) if isinstance(part, str))
        if seen.status != 2 or key not in seen.err or "bug" in seen.err:
            wrong.append((path, seen.status, seen.err))
    assert wrong == []


def test_zero_and_the_least_magnitude_are_taken() -> None:
    machine = abu_calc.read("msh-230")
    for value in (0.0, 1e-12):
        assert machine.changed({"wheel.runout_mm": value}).whole().wheel.runout_mm == value
    for value in (9e-13, 5e-324):
        with pytest.raises(abu_calc.InputError, match=r"runout_mm: too small to compute with.*at least 1e-12"):
            machine.changed({"wheel.runout_mm": value})


@pytest.mark.parametrize("text", ["[" * 5000, "choice(" + "[" * 5000 + ")", "1," + "{a=" * 5000])
def test_brackets_without_end_are_no_values(text: str) -> None:
    """Bare words are text: the key of the file refuses them."""
    try:
        values = variation(text, Place(key="vary wheel.mass_kg")).values
    except abu_calc.InputError:
        return
    assert all(isinstance(value, (str, int)) for value in values)
    seen = abu("sweep", "msh-230", "--vary", f"wheel.mass_kg={text}")
    assert seen.status == 2 and "--vary wheel.mass_kg" in seen.err and "bug" not in seen.err


@pytest.mark.parametrize("most", [1e300, 1e12, -1e300, 1.7e308])
def test_samples_beyond_all_vibration_are_refused_by_their_column(most: float, tmp_path: Path) -> None:
    file = tmp_path / "signal.csv"
    rows = "\n".join(f"{k / 1000},{most if k == 500 else -most if k == 501 else k % 7}" for k in range(1000))
    file.write_text(f"t_s,ax_m_per_s2\n{rows}\n", encoding="utf-8")
    seen = abu("levels", str(file))
    assert seen.status == 2 and "ax_m_per_s2: a sample is larger" in seen.err


@pytest.mark.parametrize("length", [300, 5000])
def test_names_that_are_too_long_for_the_system_are_refused_by_their_key(length: int, tmp_path: Path) -> None:
    file = tmp_path / "roll.toml"
    assert abu("init", "--readings", str(file)).status == 0
    text = file.read_text(encoding="utf-8")
    before, rest = text.split("[[run]]", 1)
    run = f'[[run]]\nspeed_rpm = 3000.0\nquantity = "displacement"\nfile = "{"x" * length}"\n'
    file.write_text(before + run + rest[rest.index("[tolerance]") :], encoding="utf-8")
    for command in ("validate", "balance"):
        seen = abu(command, str(file))
        assert seen.status == 2 and "run[0].file" in seen.err and len(seen.err) < 900
