"""Levels where machines are held: bodies in space, and their limits in the wheel plane."""

import math
from typing import Any

import pytest

from abu_calc.formulas.body_motion import BodyMotion, BodySprings, imbalance_at, velocity_rms
from abu_calc.formulas.rigid_body import Inertia, RigidBody
from abu_calc.foundation.units import level_from_velocity, to_si, velocity_from_level
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.read_machine import read
from abu_calc.sizing import size
from abu_calc.sizing.actions import with_entries
from abu_calc.sizing.case import WHEEL_PLANE, read_case
from abu_calc.sizing.design import Design
from abu_calc.sizing.places import in_space
from tests.formulas.bodies import G125, G230, V305, SpaceCase, settled_amplitudes
from tests.sizing.machines import check_of, machine

HANDLES_125 = [
    {"name": "rear", "position_mm": [-110.0, 0.0, -5.0]},
    {"name": "side", "position_mm": [62.0, 120.0, -8.0]},
]
ANGLE_125: dict[str, Any] = {
    "machine__layout": "angle", "machine__mass_kg": 2.2, "machine__speed_rpm": 11000.0,
    "machine__spindle_axis": "vertical", "machine__center_of_mass_from_wheel_mm": [-95.0, 0.0, -48.0],
    "machine__inertia_kg_m2": [0.0040, 0.0200, 0.0190], "machine__inertia_xz_kg_m2": -0.0015,
    "machine__handle": HANDLES_125, "wheel__mass_kg": 0.2, "wheel__diameter_mm": 125.0, "wheel__imbalance_g_mm": 38.0,
    "autobalancer__max_outer_diameter_mm": 50.0, "autobalancer__bore_diameter_mm": 14.0,
    "autobalancer__max_mass_fraction": 0.1, "autobalancer__ball_count": 5, "autobalancer__ball_diameter_mm": 11.0,
    "autobalancer__race_radius_mm": 22.0,
}  # fmt: skip
"""With the balls that are chosen for it, so that no test looks for them anew."""


def angle_grinder(**changes: Any) -> MachineFile:
    return machine(**{**ANGLE_125, **changes})


def without_inertia(**changes: Any) -> MachineFile:
    keys = ("center_of_mass_from_wheel_mm", "inertia_kg_m2", "inertia_xz_kg_m2")
    return angle_grinder(**{f"machine__{key}": None for key in keys}, **changes)


@pytest.fixture(scope="module")
def design() -> Design:
    return size(angle_grinder())


def test_file_describes_the_reference_body(design: Design) -> None:
    body = design.case.body
    assert body.wheel == pytest.approx(G125.wheel) and body.body.inertia == G125.body.inertia and body.in_space
    assert body.mass == pytest.approx(G125.body.mass)
    assert body.effective_mass() == pytest.approx(1.08336, rel=5e-6)
    assert [held.place for held in design.case.handles] == [pytest.approx(place) for place in G125.handles.values()]


@pytest.mark.parametrize(
    ("place", "expected"), [(0, (12.5264, 2.93740, 8.17211)), (1, (19.7999, 18.3292, 39.0305))], ids=["rear", "side"]
)
def test_levels_without_balls_are_those_of_the_reference(
    design: Design, place: int, expected: tuple[float, float, float]
) -> None:
    levels = [axis.before for axis in design.idle.places[place].axes]
    assert [1e3 * velocity_from_level(level) for level in levels if level] == pytest.approx(expected, rel=5e-6)


def test_eccentricity_moves_all_places_as_an_imbalance_of_m_f_times_e(design: Design) -> None:
    """Race in the wheel plane: an imbalance m_F·w moves every place, w the residual whirl of the race."""
    autobalancer, body = design.autobalancer, design.case.body
    budget, speed = autobalancer.budget, design.case.speed
    w = math.hypot(budget.race_eccentricity, budget.rolling_friction, budget.race_ovality)
    added = autobalancer.mass - autobalancer.balls_mass
    for place in design.idle.places:
        assert place.place is not None
        motion = body.axes(place.place, added)
        for axis, share in zip(place.axes, motion, strict=True):
            expected = level_from_velocity(w * body.effective_mass(added) * share * speed / math.sqrt(2))
            # the balls' own mass changes what is left by 0.1 … 1.5 %
            assert axis.after == pytest.approx(expected, abs=0.15)


def test_level_is_limited_in_the_wheel_plane(design: Design) -> None:
    """The louder of x and y there: of U/m_y without the autobalancer, m_y of the reference."""
    assert design.idle.judged == WHEEL_PLANE
    speed = design.case.speed
    expected = level_from_velocity(38e-6 / 0.760896 * speed / math.sqrt(2))
    assert design.idle.worst.before == pytest.approx(expected, abs=0.01)
    assert "Wheel plane" in check_of(design, "ABU401").message


def test_capacity_and_slow_motion_take_m_f(design: Design) -> None:
    need = design.autobalancer.requirement
    assert need.effective_mass == pytest.approx(design.case.body.effective_mass(design.autobalancer.mass))
    assert need.eccentricity_part == pytest.approx(need.effective_mass * 10e-6)
    assert need.required == pytest.approx(38e-6 + need.eccentricity_part)


def test_race_in_another_plane_carries_the_ratio_of_the_reference() -> None:
    """V of the reference G230, 25 mm inboard: 167.47 of 152 g·mm, in sizing with the autobalancer's mass."""
    entries = {
        "machine__layout": "angle", "machine__mass_kg": 5.5, "machine__speed_rpm": 6500.0,
        "machine__center_of_mass_from_wheel_mm": [-135.0, 0.0, -75.0],
        "machine__inertia_kg_m2": [0.022, 0.130, 0.125], "machine__inertia_xz_kg_m2": -0.010,
        "machine__rotor_polar_inertia_kg_m2": 0.0032, "wheel__mass_kg": 0.5, "wheel__diameter_mm": 230.0,
        "wheel__imbalance_g_mm": 152.0, "autobalancer__plane_offset_mm": -25.0,
    }  # fmt: skip
    case = read_case(machine(**entries))
    assert case.body.body == G230.body and case.race_place == pytest.approx(G230.race)
    ratio = case.body.inertance(case.race_place, case.body.wheel) / case.body.inertance(
        case.race_place, case.race_place
    )
    assert 152 * ratio == pytest.approx(167.483, rel=5e-6)  # without the suspension and the balls' mass of 167.471


def test_handle_of_an_old_file_is_judged_as_before() -> None:
    """A body along its spindle: its loudest handle decides, and its axes are alike."""
    handles = [{"name": "front", "from_center_of_mass_mm": 100.0}, {"name": "rear", "from_center_of_mass_mm": -200.0}]
    held = size(machine(machine__transverse_inertia_kg_m2=0.1, machine__center_of_mass_to_wheel_mm=200.0,
                        machine__handle=handles))  # fmt: skip
    assert held.idle.judged == "front" and not held.case.body.in_space
    x, y, z = held.idle.places[0].axes
    assert x == y and x.before == held.idle.places[0].levels.before and z.before == 0.0


@pytest.mark.parametrize("axes", [1, 3])
def test_imbalance_from_a_level_at_a_handle(design: Design, axes: int) -> None:
    """What the handle shows of 38 g·mm gives 38 g·mm back: the loudest axis, or the vector total of three."""
    speed = to_si(11000, "rpm")
    motion = BodyMotion(G125.body, speed, BodySprings((2 * math.pi * 2.5,) * 2, (0.5, 0.5)))
    v = velocity_rms(motion.displacement(G125.handles["side"], [imbalance_at(G125.wheel, 38e-6)]), speed)
    shown = math.hypot(*v) if axes == 3 else max(v)
    entries = {
        "wheel__imbalance_g_mm": None, "wheel__measured_acceleration_m_per_s2": shown * speed,
        "wheel__measured_at": "side", "wheel__measured_axes": axes,
    }  # fmt: skip
    found = size(angle_grinder(**entries)).imbalance.value
    assert 1e6 * found == pytest.approx(38.0, rel=1e-4)


def test_hands_hold_a_body_in_space_at_two_handles() -> None:
    held = size(angle_grinder(suspension={"model": "hands"}))
    free = size(angle_grinder())
    for hand, bare in zip(held.idle.places, free.idle.places, strict=True):
        # at 183 Hz the hands' masses on the handles change levels by some tenths to three decibels
        assert hand.levels.before == pytest.approx(bare.levels.before, abs=3.5)
        assert hand.levels.before != pytest.approx(bare.levels.before, abs=0.01)
    one = size(angle_grinder(suspension={"model": "hands"}, machine__handle=HANDLES_125[:1]))
    assert any("first two handles" in warning for warning in one.warnings)


@pytest.mark.few(1)
@pytest.mark.parametrize(
    ("case", "suspension", "expected"),
    [
        (G230, None, [(11.7180, 1.62991, 9.09178), (15.0394, 14.5331, 36.8850)]),
        (V305, {"model": "hands"}, [(13.9062, 2.31820, 10.4077), (19.9160, 27.9588, 20.3801)]),
    ],
    ids=["G230", "V305"],
)
def test_reference_bodies_as_files(case: SpaceCase, suspension: dict[str, str] | None, expected: Any) -> None:
    """Velocity rms of both handles without balls [mm/s]; the wheel's face works, so hands push along the spindle."""
    inertia = case.body.inertia
    assert inertia is not None
    entries: dict[str, Any] = {
        "machine__layout": "angle", "machine__mass_kg": case.body.mass - 0.5, "machine__speed_rpm": float(case.rpm),
        "machine__spindle_axis": "vertical", "machine__center_of_mass_from_wheel_mm": [-1e3 * x for x in case.wheel],
        "machine__inertia_kg_m2": [inertia.xx, inertia.yy, inertia.zz], "machine__inertia_xz_kg_m2": inertia.xz,
        "machine__rotor_polar_inertia_kg_m2": case.body.rotor_polar_inertia, "wheel__mass_kg": 0.5,
        "machine__handle": [
            {"name": name, "position_mm": [1e3 * x for x in place]} for name, place in case.handles.items()
        ],
        "wheel__imbalance_g_mm": 1e6 * case.imbalance,
        "autobalancer__plane_offset_mm": 1e3 * (case.race[2] - case.wheel[2]),
    }  # fmt: skip
    if suspension:
        entries["suspension"] = suspension
    for place, velocities in zip(size(machine(**entries)).idle.places, expected, strict=True):
        found = [1e3 * velocity_from_level(axis.before) for axis in place.axes if axis.before is not None]
        assert found == pytest.approx(velocities, rel=5e-6)


def test_estimate_takes_the_place_of_the_point_mass() -> None:
    point, estimated = (size(without_inertia(**lengths)) for lengths in (
        {}, {"machine__length_mm": 300.0, "machine__height_mm": 60.0}))  # fmt: skip
    assert any("point mass" in warning for warning in point.warnings)
    assert not any("point mass" in warning for warning in estimated.warnings)
    assert any("estimated" in warning for warning in estimated.warnings)
    assert point.case.body.effective_mass() == pytest.approx(2.4) and point.bands is None
    assert estimated.case.body.effective_mass() == pytest.approx(0.47 * 2.4, rel=0.03)
    polar = estimated.case.body.body.rotor_polar_inertia
    assert polar == pytest.approx(0.2 * 0.0625**2 / 2)


@pytest.mark.parametrize(("center", "words"), [([95.0, 0.0, -48.0], "x > 0"), ([-95.0, 0.0, 48.0], "z > 0")])
def test_mistaken_signs_of_the_centre_of_mass_are_asked_about(center: list[float], words: str) -> None:
    turned = size(angle_grinder(machine__center_of_mass_from_wheel_mm=center))
    assert any(words in warning for warning in turned.warnings)
    assert not any("signs" in warning for warning in size(angle_grinder()).warnings)


def test_heavy_wheel_asks_for_its_polar_inertia() -> None:
    heavy = {"wheel__mass_kg": 0.4, "wheel__diameter_mm": 150.0}
    assert any("polar inertia" in warning for warning in size(angle_grinder(**heavy)).warnings)
    known = size(angle_grinder(**heavy, machine__rotor_polar_inertia_kg_m2=0.001))
    assert not any("polar inertia" in warning for warning in known.warnings)


FRONT, REAR = 100.0, -200.0
"""Handles of the straight grinder 707-222, and its body: J = 0.1 kg·m², wheel 200 mm before the centre of mass."""
IN_SPACE = {"inertia_kg_m2": [0.1, 0.1, 0.01], "center_of_mass_from_wheel_mm": [0.0, 0.0, -200.0]}
ALONG = {"transverse_inertia_kg_m2": 0.1, "center_of_mass_to_wheel_mm": 200.0}


def straight_grinder(body: dict[str, Any], offset: float) -> Design:
    """The preset 707-222 with a body and two handles, its race without friction, as it idles."""
    tables = read("avtovaz-707-222").whole("size")
    handles = [{"name": "front", "from_center_of_mass_mm": FRONT}, {"name": "rear", "position_mm": [0, 0, REAR]}]
    entries: dict[str, object] = {
        **{f"machine.{key}": value for key, value in body.items()}, "machine.handle": handles,
        "autobalancer.rolling_friction_mm": 0.0, "autobalancer.plane_offset_mm": offset,
        "autobalancer.race_eccentricity_mm": 0.0 if offset else 0.010,
    }  # fmt: skip
    return size(with_entries(tables, entries))


def integrated(design: Design, *, balls: bool) -> dict[str, Any]:
    """Six degrees of freedom and balls, integrated: velocity rms along x, y, z at both handles [m/s]."""
    autobalancer, case = design.autobalancer, design.case
    added = autobalancer.mass - autobalancer.balls_mass if balls else 0.0
    count = autobalancer.ball_count
    whole = SpaceCase(
        RigidBody(case.body.mass + added, Inertia(0.1, 0.1, 0.01)), 5800, (0, 0, 0.2), (0, 0, case.race_place[2]),
        design.imbalance.value, autobalancer.ball_mass, autobalancer.pitch_radius,
        {"front": (0, 0, FRONT / 1e3), "rear": (0, 0, REAR / 1e3)}, eccentricity=-case.race_eccentricity, count=count,
        start=tuple(0.3 + 0.7 * k for k in range(count)),
    )  # fmt: skip
    return settled_amplitudes(whole, whole.handles, balls=balls, turns=350 if balls else 150)


@pytest.mark.slow
@pytest.mark.parametrize("body", [IN_SPACE, ALONG], ids=["in space", "along the spindle"])
def test_handles_of_the_straight_grinder_without_balls(body: dict[str, Any]) -> None:
    design = straight_grinder(body, 0.0)
    for name, velocity in integrated(design, balls=False).items():
        place = next(place for place in design.idle.places if place.name == name)
        assert place.levels.before == pytest.approx(level_from_velocity(max(velocity)), abs=0.02)


@pytest.mark.few(0, 1)
@pytest.mark.slow
@pytest.mark.parametrize("offset", [0.0, -25.0])
def test_handles_of_the_straight_grinder_with_balls(offset: float) -> None:
    """Within 0.2 dB: the motion that the eccentricity leaves, or a race off the wheel's plane without it."""
    design = straight_grinder(IN_SPACE, offset)
    places = design.idle.places
    if offset:  # without the race's ovality, which the integration does not have
        places = in_space(design.case, design.imbalance.value, design.autobalancer, 0.0)
    for name, velocity in integrated(design, balls=True).items():
        place = next(place for place in places if place.name == name)
        assert place.levels.after == pytest.approx(level_from_velocity(max(velocity)), abs=0.2)
