"""The wheel's imbalance from each of its sources.

The same vibration as different instruments show it: one imbalance, one design, one difference to the prediction.
"""

import math
from functools import cache
from typing import Any

import pytest

import abu_calc
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.units import velocity_from_level
from abu_calc.inputs.wheel import Shown
from abu_calc.sizing import size
from abu_calc.sizing import size as sized
from abu_calc.sizing.case import read_case
from abu_calc.sizing.design import Design
from abu_calc.sizing.imbalance import find_imbalance, imbalance_from_level, readings, velocity_shown
from tests.cli.runner import abu, once
from tests.sizing.machines import machine

OMEGA = 5800 * math.pi / 30


@pytest.mark.parametrize(("inertance", "grams"), [(1 / 6.4, 265), (1 / 6.4 + 0.2, 116), (1 / 6.4 - 0.4, 169)])
def test_imbalance_of_111_db_by_place(inertance: float, grams: float) -> None:
    found = imbalance_from_level(velocity_from_level(111), OMEGA, inertance)
    assert 1e6 * found == pytest.approx(grams, abs=1.0)


@pytest.mark.slow
def test_background_is_taken_off_the_measured_level() -> None:
    level = {"wheel__imbalance_g_mm": None, "wheel__measured_level_db": 111.0}
    quiet = size(machine(**level))
    noisy = size(machine(**level, machine__background_level_db=105.0))
    share = math.sqrt(1 - 10 ** ((105 - 111) / 10))
    assert noisy.imbalance.value == pytest.approx(quiet.imbalance.value * share, rel=1e-9)
    assert noisy.idle.worst.before == pytest.approx(111.0) == quiet.idle.worst.before
    with pytest.raises(InputError, match="background"):
        size(machine(**level, machine__background_level_db=111.0))


def test_a_handle_at_a_node_says_nothing_of_the_imbalance() -> None:
    node = 1000 * 0.1 / (6.2 * 0.2)  # p = −J/(M·a)
    with pytest.raises(InputError, match="node") as caught:
        size(
            machine(
                machine__transverse_inertia_kg_m2=0.1,
                machine__center_of_mass_to_wheel_mm=200.0,
                machine__handle=[{"name": "rear", "from_center_of_mass_mm": -node}],
                wheel__imbalance_g_mm=None,
                wheel__measured_level_db=100.0,
                wheel__measured_at="rear",
            )
        )
    assert caught.value.place.key == "wheel.measured_at"


def test_a_balance_grade_is_a_speed_of_the_centre_of_mass() -> None:
    """G16: eΩ = 16 mm/s for the wheel of 0.6 kg at 5800 rpm."""
    imbalance = find_imbalance(read_case(machine(wheel__imbalance_g_mm=None, wheel__balance_grade="G16")))
    assert imbalance.value == pytest.approx(0.6 * 16e-3 / OMEGA)
    assert "G16" in imbalance.source


SPEED = 5800 * math.pi / 30
V = 5e-8 * 10 ** (111 / 20)


def weight(w: float) -> float:
    """|W_h| by the equations of ISO 5349-1, annex A, as a product of magnitudes; Q of the band limits is 1/√2."""
    f = w / (2 * math.pi)

    def second(corner: float, q: float) -> float:
        return math.hypot(1 - (f / corner) ** 2, f / corner / q)

    low = (f / 6.31) ** 2 / second(6.31, 0.5**0.5)
    high = 1 / second(1258.9, 0.5**0.5)
    return low * high * math.hypot(1, f / 15.915) / second(15.915, 0.64)


ALIKE: dict[str, dict[str, Any]] = {
    "dB": {"measured_level_db": 111.0},
    "mm/s": {"measured_velocity_mm_per_s": 1e3 * V},
    "µm": {"measured_displacement_um": 1e6 * V / SPEED},
    "m/s²": {"measured_acceleration_m_per_s2": V * SPEED},
    "m/s² without weighting": {"measured_acceleration_m_per_s2": V * SPEED, "measured_weighting": "none"},
    "a_h": {"measured_acceleration_m_per_s2": V * SPEED * weight(SPEED), "measured_weighting": "Wh"},
    "a_hv": {
        "measured_acceleration_m_per_s2": math.sqrt(2) * V * SPEED * weight(SPEED),
        "measured_weighting": "Wh",
        "measured_axes": 3,
    },
    "mm/s of three axes": {"measured_velocity_mm_per_s": math.sqrt(2) * 1e3 * V, "measured_axes": 3},
    "a list, averaged in velocity": {"measured_velocity_mm_per_s": [900 * V, 1100 * V]},
}


def wheel(values: dict[str, Any], table: str = "wheel") -> dict[str, Any]:
    return {f"{table}.{key}": value for key, value in values.items()}


@cache
def straight() -> Design:
    return sized(abu_calc.read("avtovaz-707-222").whole())


@pytest.mark.parametrize("values", ALIKE.values(), ids=ALIKE)
def test_the_same_machine_sizes_alike(values: dict[str, Any]) -> None:
    base = abu_calc.read("avtovaz-707-222")
    same, found = straight(), sized(base.changed(wheel(values)).whole())
    assert found.imbalance.value == pytest.approx(same.imbalance.value, rel=1e-9)
    assert (found.autobalancer.ball_count, found.autobalancer.ball_diameter, found.autobalancer.race_radius) == (
        same.autobalancer.ball_count, same.autobalancer.ball_diameter, same.autobalancer.race_radius,
    )  # fmt: skip
    assert found.idle.worst.before == pytest.approx(111.0, abs=1e-9)
    assert found.idle.worst.after == pytest.approx(same.idle.worst.after, abs=1e-9)


@pytest.mark.parametrize("values", ALIKE.values(), ids=ALIKE)
def test_what_was_measured_after_stands_beside_the_prediction_alike(values: dict[str, Any]) -> None:
    from abu_calc.simulation.vibration_records import compared, level_where_measured

    machine = abu_calc.read("avtovaz-707-305")  # its speed is another
    speed, level = 1750 * math.pi / 30, 99.0
    factor = {"measured_level_db": None, "measured_velocity_mm_per_s": 1.0, "measured_displacement_um": SPEED / speed}
    there = 5e-8 * 10 ** (level / 20) / V
    scaled: dict[str, Any] = {}
    for key, value in values.items():
        if key == "measured_level_db":
            scaled[key] = level
        elif key.startswith("measured_acceleration"):
            scaled[key] = value * there * speed / SPEED * (
                weight(speed) / weight(SPEED) if values.get("measured_weighting") == "Wh" else 1
            )  # fmt: skip
        elif key in factor:
            many = [one * there * (factor[key] or 1) for one in (value if isinstance(value, list) else [value])]
            scaled[key] = many
        else:
            scaled[key] = value
    design = sized(machine.changed(wheel(scaled, "measured_after")).whole())
    predicted = level_where_measured(design, 1e-5)
    found = compared(design.case, predicted)
    assert found is not None and predicted is not None
    assert found.difference_db == pytest.approx(level - predicted, abs=1e-9)


def test_readings_of_111_db() -> None:
    """By hand: 17.741 mm/s; divided by 607.37 1/s 29.21 µm; times it 10.775 m/s²; W_h 0.1658."""
    found = readings(V, SPEED)
    assert found.velocity == pytest.approx(17.741e-3, rel=1e-4)
    assert found.displacement == pytest.approx(29.21e-6, rel=1e-4)
    assert found.acceleration == pytest.approx(10.775, rel=1e-4)
    assert found.weighted == pytest.approx(10.775 * weight(SPEED), rel=1e-4)
    assert found.total == pytest.approx(math.sqrt(2) * 10.775 * weight(SPEED), rel=1e-4)


@pytest.mark.parametrize("hertz", [5.5, 1420.0])
def test_no_weighting_where_the_standard_has_none(hertz: float) -> None:
    shown = Shown("measured_acceleration_m_per_s2", (2.5,), "Wh", 1, None)
    with pytest.raises(InputError, match="not defined"):
        velocity_shown(shown, 2 * math.pi * hertz)
    assert readings(1e-3, 2 * math.pi * hertz).weighted is None


@pytest.mark.few(1)
@pytest.mark.parametrize(("table", "more"), [("wheel", ()), ("measured_after", ())])
def test_a_weighting_that_is_not_defined_names_its_key(table: str, more: tuple[str, ...]) -> None:
    slow = ("--set", "machine.speed_rpm=300", "--set", "suspension.natural_frequencies_hz=0.5")
    given = "--set", f"{table}.measured_acceleration_m_per_s2=2.5", "--set", f"{table}.measured_weighting=Wh"
    seen = abu("size", "avtovaz-707-222", *slow, *given, *more)
    assert seen.status == 2 and f"{table}.measured_weighting" in seen.err and "5.6" in seen.err


@pytest.mark.parametrize(("settings", "word"), [
    (("measured_after={measured_at='front', measured_level_db=100}",), "no handle has this name"),
    (("measured_after={measured_level_db=[]}",), "too few"),
    (("measured_after={measured_displacement_um=0}",), "above 0"),
    (("measured_after={measured_displacement_um=5, measured_axes=2}",), "1 or 3"),
])  # fmt: skip
def test_what_does_not_go_together_is_refused(settings: tuple[str, ...], word: str) -> None:
    seen = abu("size", "avtovaz-707-222", *(part for one in settings for part in ("--set", one)))
    assert seen.status == 2 and word in seen.err, seen.err


@pytest.mark.slow
def test_every_report_of_levels_has_it_beside_the_prediction(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    mean = 5e-8 * (10 ** (102 / 20) + 10 ** (103 / 20)) / 2
    for command in ("size", "simulate", "levels", "grinding"):
        report = ("--full",) if command in ("size", "grinding") else ()
        seen, document = once(command, "avtovaz-707-222", *report), once(command, "avtovaz-707-222", "--json").document
        assert "Measured with the autobalancer, idle, wheel plane: 102, 103 dB" in seen.out, command
        found = document["result"]["measured_after"]
        assert found["measured_level_db"] == pytest.approx(20 * math.log10(mean / 5e-8), abs=1e-9)
        difference = found["measured_level_db"] - found["predicted_level_db"]
        assert found["difference_db"] == pytest.approx(difference, abs=1e-9)
        at_work = "predicted_loaded_db" in found
        assert at_work == (command in ("size", "grinding"))
        assert not at_work or found["predicted_loaded_db"] == pytest.approx(loaded_level(), abs=1e-6)


def loaded_level() -> float:
    return float(once("grinding", "avtovaz-707-222", "--json").document["result"]["level_after_db"])


@pytest.mark.slow
def test_a_scene_at_work_has_it_too() -> None:
    """Beside the idle prediction of sizing its own level under load."""
    for command in ("simulate", "levels"):
        result = once(command, "avtovaz-707-222", "--scene", "grinding", "--json").document["result"]
        found = result["measured_after"]
        sized = once("size", "avtovaz-707-222", "--json").document["result"]["measured_after"]
        assert found["predicted_level_db"] == pytest.approx(sized["predicted_level_db"], abs=1e-6)
        assert found["predicted_loaded_db"] == pytest.approx(result["level_db"], abs=1e-6), command


def test_levels_of_a_design_are_told_as_instruments_show_them() -> None:
    handle = once("size", "avtovaz-707-222", "--json").document["result"]["vibration"]["handles"][0]
    before = handle["shown_before"]
    assert before["velocity_mm_per_s"] == pytest.approx(1e3 * V, rel=1e-6)
    assert before["acceleration_m_per_s2"] == pytest.approx(V * SPEED, rel=1e-6)
    assert before["displacement_um"] == pytest.approx(1e6 * V / SPEED, rel=1e-6)
    assert before["total_m_per_s2"] == pytest.approx(math.sqrt(2) * V * SPEED * weight(SPEED), rel=1e-6)


def test_a_data_sheet_is_no_measurement_of_this_wheel() -> None:
    machine = abu_calc.read("avtovaz-707-222").changed(wheel(ALIKE["a_hv"]))
    assert any("test wheel" in one for one in sized(machine.whole()).warnings)
    assert not any("test wheel" in one for one in straight().warnings)
