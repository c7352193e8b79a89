"""`abu size` of machines whose verdict is known: published balls, a soft and a stiff mount, hands."""

import pytest

import abu_calc
from abu_calc.features.design.start_rules import RULES
from abu_calc.sizing import size as size_design
from tests.cli.runner import once


@pytest.mark.parametrize(
    ("name", "count", "diameter", "idle"),
    [
        ("avtovaz-707-222", 2, 16.0, True),
        ("avtovaz-707-222", 4, 16.0, False),
        ("avtovaz-707-370", 3, 16.0, False),
        ("avtovaz-707-305", 3, 19.844, False),
    ],
)
def test_the_sources_own_balls_suffice_where_they_found_so(name: str, count: int, diameter: float, idle: bool) -> None:
    """Two for idling and four under load on the straight machine; three on the others."""
    pins = {"autobalancer.ball_count": count, "autobalancer.ball_diameter_mm": diameter}
    design = size_design(abu_calc.read(name).changed(pins | ({"grinding.contact": "face"} if idle else {})).whole())
    chosen = design.autobalancer
    assert (chosen.ball_count, chosen.ball_diameter) == (count, pytest.approx(1e-3 * diameter, abs=1e-6))
    (capacity,) = (check for check in design.checks if check.code == "ABU201")
    assert capacity.status == "pass", capacity


def test_two_balls_do_not_suffice_under_load() -> None:
    pins = {"autobalancer.ball_count": 2, "autobalancer.ball_diameter_mm": 16.0}
    design = size_design(abu_calc.read("avtovaz-707-222").changed(pins).whole())
    assert {check.code for check in design.checks if check.status == "fail"} >= {"ABU201"}
    assert design.autobalancer.capacity_ratio < 1.2


@pytest.mark.hard
def test_below_resonance_it_makes_things_worse_and_says_so() -> None:
    seen = once("size", "avtovaz-707-370", "--set", "suspension.natural_frequencies_hz=[130.0, 130.0]",
                "--set", "suspension.damping_ratios=[0.05, 0.05]", "--json")  # fmt: skip
    document = seen.document
    failed = {check["code"]: check for check in document["checks"] if check["status"] == "fail"}
    assert seen.status == 1 and {"ABU101", "ABU701"} <= failed.keys()
    assert "increase the imbalance" in failed["ABU701"]["message"]
    assert document["result"]["vibration"]["level_after_db"] is None  # no number that could not be trusted
    missing = {c["code"] for c in document["checks"] if c["status"] == "not-done"}
    assert missing == {"ABU401", "ABU402"}
    assert document["result"]["frequency"]["region"] == "subcritical"
    assert not document["result"]["frequency"]["balancing_possible"]
    assert document["result"]["data_gaps"] == []


@pytest.mark.slow
def test_a_machine_in_hands_is_simulated_with_them() -> None:
    # With friction balls stop somewhere in its band.
    smooth = abu_calc.read("avtovaz-707-370").changed({"autobalancer.rolling_friction_mm": 0.0})
    held = abu_calc.size(smooth.changed({"suspension.model": "hands"}), starts="none")
    idle, grinding = held.simulation
    assert (idle.scene, grinding.scene) == ("idle", "grinding")
    needing = {rule.code for rule in RULES}
    others = [check for check in held.checks if check.code not in needing and check.requested]
    assert {check.status for check in others} <= {"pass", "warn"}
    # Palms, fingers and skin: more than the two coordinates of the axis.
    states = held.model.to_dict()["scenes"]["idle"]["states"]
    assert states[:2] == ["x", "y"] and states.index("θ1") > 4
    # At 97 Hz hands change the amplitude by a few per cent only, and the balls do as well in them as on springs.
    springs = abu_calc.simulate(smooth)
    assert idle.axis_amplitude_mm == pytest.approx(springs.axis_amplitude_mm, rel=0.1)
