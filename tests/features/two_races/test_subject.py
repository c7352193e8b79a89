"""`abu simulate`, `abu stability` and `abu compare` of a machine with two races."""

import pytest

import abu_calc
from abu_calc.features.compare import study
from abu_calc.features.compare.study import compare
from abu_calc.foundation.errors import InputError
from tests.cli.runner import abu
from tests.remembered import recalled

PRESET = "pedestal-grinder"


@pytest.mark.slow
def test_a_run_ends_balanced_in_both_races() -> None:
    result = abu_calc.simulate(abu_calc.read(PRESET))
    assert result.status == "pass"
    assert result.axis_amplitude_mm < 0.3 * (result.unbalanced_amplitude_mm or 0.0)
    assert result.settling_time_s is not None
    assert any("in phase" in warning for warning in result.warnings)


@pytest.mark.slow
def test_stability_changes_above_both_critical_speeds() -> None:
    """Critical speeds 730 and 804 rpm; two races of finite mass balance above 864.4 rpm with four balls each."""
    result = abu_calc.stability(abu_calc.read(PRESET), speeds_rpm=(700.0, 3000.0))
    assert result.stable
    (boundary,) = result.boundaries_rpm or ()
    assert 804.455 < boundary.speed_rpm < 950


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"start": "settled"}, "no such start"),
        ({"scene": "grinding"}, "no such scene"),
        ({"race_centre_deg": 90.0}, "one race only"),
    ],
)
def test_what_two_races_do_not_have_is_refused(keys: dict[str, object], words: str) -> None:
    with pytest.raises(InputError, match=words):
        abu_calc.simulate(abu_calc.read(PRESET), **keys)  # type: ignore[arg-type]


@pytest.mark.slow
def test_a_heavier_wheel_stands_beside_the_preset(monkeypatch: pytest.MonkeyPatch) -> None:
    """The design of the preset stands for both."""
    machine = abu_calc.read(PRESET)
    monkeypatch.setattr(study, "size", lambda *_, **__: recalled("size", machine))
    result = compare([machine, machine.changed({"wheel.0.imbalance_g_mm": 2000.0})])
    rows = {row.path: row.values for row in result.differences}
    assert rows["wheel[0].imbalance_g_mm"] == (2500.0, 2000.0)


def test_some_starts_only_are_refused() -> None:
    with pytest.raises(InputError, match="all start cases"):
        abu_calc.size(abu_calc.read(PRESET), starts="none")


def test_a_changed_machine_as_text_is_read_as_the_same() -> None:
    machine = abu_calc.read(PRESET).changed({"wheel.0.imbalance_g_mm": 2400.0})
    assert abu_calc.read(machine.to_toml()).tables == machine.tables


@pytest.mark.slow
def test_the_command_prints_one_screen() -> None:
    seen = abu("simulate", PRESET)
    assert "2 races with 10 balls" in " ".join(seen.out.split())
