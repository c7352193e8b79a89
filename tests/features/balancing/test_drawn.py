"""Sketch of mark, sensors and angles: letters where the angles say."""

import math
from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.balancing.corrections import Share
from abu_calc.features.balancing.drawn import (
    ACROSS,
    HEIGHT,
    WIDTH,
    lag_of,
    plane_picture,
    sketch,
    sketch_places,
    sketch_words,
)
from abu_calc.features.balancing.figures import balance_extras
from abu_calc.features.balancing.solution import PlaneCorrection
from tests.features.balancing.field import Fan
from tests.features.balancing.rig import RIG, ROTOR, Workshop, written


@pytest.mark.parametrize("sensor", [0.0, 50.0, -120.0])
@pytest.mark.parametrize("phase", ["lag", "lead"])
def test_the_high_spot_is_behind_its_sensor_by_the_lag(tmp_path: Path, sensor: float, phase: str) -> None:
    """By hand: at t = 0 the mark is under M, the vibration sensor is `sensor` behind it, and A·cos(ωt − α) has its peak
    under that sensor once the rotor has turned by α.
    """
    shop = Workshop(sensor_deg=sensor)
    alpha = shop.read()[0][1]
    text = shop.run() + f'phase = "{phase}"\n'
    if phase == "lead":
        for _, value in shop.read():
            text = text.replace(f"phase_deg = {value!r}", f"phase_deg = {-value!r}")
    result = abu_calc.balance(written(tmp_path, RIG, ROTOR, text))
    places = {letter: degrees for letter, degrees, _ in sketch_places(result)}
    assert places["M"] == places["0"] == 0.0 and places["V"] == pytest.approx(sensor)
    assert math.cos(math.radians(places["h"] - sensor - alpha)) == pytest.approx(1.0)
    assert places["o"] == pytest.approx(205.0)
    words = " ".join(sketch_words(result))
    assert phase in words and ("ago" in words) == (phase == "lead")
    lines, _ = sketch(result)
    assert {"M", "V", "h", "o", "0"} & set("".join(lines)) and len(lines) == 13
    assert lag_of(result.runs[0], result.runs[0].sensors[0].phase_deg) == pytest.approx((alpha + 180) % 360 - 180)


def test_the_convention_figure_names_both_angles(tmp_path: Path) -> None:
    fan = Fan()
    text = [fan.run(1500.0), fan.run(1500.0, (20.0, 0.0))]
    result = abu_calc.balance(written(tmp_path, fan.plane, *text))
    figures = {figure.name: figure for figure in balance_extras(result).figures}
    drawn = [shape.text for shape in figures["convention"].shown.shapes if hasattr(shape, "text")]
    assert any(line.startswith("phase") for line in drawn) and any(line.startswith("heavy spot") for line in drawn)
    assert "seen from the left end" in [s.text for s in figures["planes"].shown.shapes if hasattr(s, "text")]


def test_without_phase_the_sketch_has_no_high_spot(tmp_path: Path) -> None:
    fan = Fan()
    runs = [fan.run(1500.0, phases=False), *(fan.run(1500.0, (25.0, a), phases=False) for a in (0.0, 120.0, 240.0))]
    result = abu_calc.balance(written(tmp_path, fan.plane, *runs))
    assert "h" not in {letter for letter, _, _ in sketch_places(result)}


def plane(mass_g: float, *corrections: Share) -> PlaneCorrection:
    """A plane whose heavy spot is at 90°."""
    return PlaneCorrection(
        mass=mass_g / 1e3, angle=math.pi / 2, mass_uncertainty=1e-4, angle_uncertainty=0.02, remove_at=math.pi / 2,
        add_at=1.5 * math.pi, corrections=corrections, imbalance=mass_g / 1e4, permitted=None, rest=1e-6,
        rest_at_most=2e-6, leftover=0.0, printed_mass=None, printed_angle=None,
    )  # fmt: skip


@pytest.mark.parametrize(("sense", "right"), [(1, True), (-1, False)])
def test_a_heavy_spot_is_marked_only_where_there_is_mass(sense: int, right: bool) -> None:
    """Against rotation, 90° is at the right of one who sees the rotor turn counterclockwise; the mark is on top."""
    _, *rows = plane_picture(
        "plane", plane(12.0, Share(action="remove", mass=0.012, angle=math.pi / 4)), sense, "against rotation"
    )
    spots = [(row, line.index("o")) for row, line in enumerate(rows) if "o" in line]
    assert spots == [(HEIGHT // 2, WIDTH // 2 + (ACROSS if right else -ACROSS))]
    assert (rows[HEIGHT // 2].index("o") > rows[0].index("0")) is right
    _, *rows = plane_picture("plane", plane(0.0), sense, "against rotation")
    assert not any("o" in line for line in rows)


@pytest.mark.parametrize(("sense", "above", "below"), [(1, "<---", "--->"), (-1, "--->", "<---")])
def test_arrows_go_round_as_the_rotor_turns(sense: int, above: str, below: str) -> None:
    """Counterclockwise, the upper half moves to the left and the lower one to the right."""
    _, *rows = plane_picture("plane", plane(0.0), sense, "against rotation")
    upper, lower = rows[: HEIGHT // 2], rows[HEIGHT // 2 + 1 :]
    for half, arrow, other in ((upper, above, below), (lower, below, above)):
        assert sum(arrow in line for line in half) == 1 and not any(other in line for line in half)
