"""Balance grades, limits of vibration, hand-arm weighting, the hand."""

import math
import tomllib

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.errors import InputError, RangeError
from abu_calc.spec.bearing_file import Limits
from abu_calc.standards.balance import balance_grades, permissible_imbalance
from abu_calc.standards.hands import hand
from abu_calc.standards.tables import csv_rows
from abu_calc.units import from_si, level_from_velocity, to_si
from tests.standards import vibration


def test_grades_of_the_standard():
    assert list(balance_grades()) == [
        "G4000",
        "G1600",
        "G630",
        "G250",
        "G100",
        "G40",
        "G16",
        "G6.3",
        "G2.5",
        "G1",
        "G0.4",
    ]


def test_permissible_imbalance_as_printed():
    """U [g·mm] = 9549·G·m/n is printed with 9549 for 30000/π, so to four digits."""
    found = from_si(permissible_imbalance("G16", 0.6, to_si(5800, "rpm")), "g_mm")
    assert found == pytest.approx(9549 * 16 * 0.6 / 5800, rel=1e-4)


@settings(derandomize=True, deadline=None)
@given(st.sampled_from(sorted(balance_grades())), st.floats(0.01, 1e4), st.floats(1.0, 1e4))
def test_the_permitted_eccentricity_turns_at_the_grade(grade, mass, speed):
    eccentricity = permissible_imbalance(grade, mass, speed) / mass
    assert 1e3 * eccentricity * speed == pytest.approx(float(grade[1:]), rel=1e-12)


@pytest.mark.parametrize("grade", ["G6", "6.3", "g6.3", "G6.30", ""])
def test_unknown_grades_are_refused(grade):
    with pytest.raises(InputError, match=r"G4000, .*G6\.3"):
        permissible_imbalance(grade, 1.0, 100.0)


@pytest.mark.parametrize(("mass", "speed"), [(0, 1), (1, 0), (-1, 1), (math.nan, 1), (1, math.nan), (1, math.inf)])
def test_impossible_rotors_are_refused(mass, speed):
    with pytest.raises(RangeError):
        permissible_imbalance("G6.3", mass, speed)


def test_limits_by_octaves():
    levels = [(round(from_si(o.nominal, "hz"), 1), o.limit.level) for o in vibration.octaves()]
    assert levels == [(8, 115), (16, 109), (31.5, 109), (63, 109), (125, 109), (250, 109), (500, 109), (1000, 109)]


def test_levels_and_velocities_say_the_same():
    """The standard rounds velocities to two digits and levels to 1 dB, so within 0.5 dB."""
    for limit in (*(o.limit for o in vibration.octaves()), vibration.corrected_limit()):
        assert level_from_velocity(limit.velocity) == pytest.approx(limit.level, abs=0.5)


@pytest.mark.parametrize(("rpm", "nominal", "low", "high"), [(5800, 125, 88.4, 176.8), (1750, 31.5, 22.1, 44.2)])
def test_octave_of_a_speed(rpm, nominal, low, high):
    found = vibration.octave(to_si(rpm, "rpm"))
    hertz = [from_si(f, "hz") for f in (found.nominal, found.low, found.high)]
    assert hertz == pytest.approx([nominal, low, high], abs=0.05)


@settings(derandomize=True, deadline=None)
@given(st.floats(5.7, 1400.0))
def test_bands_leave_no_gap_and_do_not_overlap(hertz):
    frequency = to_si(hertz, "hz")
    for bands in (vibration.octaves(), vibration.third_octaves()):
        inside = [band for band in bands if band.low <= frequency < band.high]
        # neighbouring bounds are the same number but for rounding
        edge = min(abs(frequency / band.low - 1) for band in bands) < 1e-9
        assert len(inside) == 1 or edge


@pytest.mark.parametrize("hertz", [5.5, 1415.0, 0.0, -10.0, math.nan, math.inf])
def test_frequencies_outside_are_refused(hertz):
    for look_up in (vibration.octave, vibration.hand_arm_weight):
        with pytest.raises(RangeError, match="no band of the standard"):
            look_up(to_si(hertz, "hz"))


def test_weights_follow_the_filter_of_the_standard():
    """Second route: the band-limiting and transition filters of ISO 5349-1 A.1; the table is rounded to 3 digits."""

    def filtered(f: float) -> float:
        s = 2j * math.pi * f
        w1, w2, w3 = (2 * math.pi * x for x in (6.310, 1258.9, 15.915))
        q = 0.64
        band = s**2 * w2**2 / ((s**2 + w1 * s / 0.71 + w1**2) * (s**2 + w2 * s / 0.71 + w2**2))
        return abs(band * (s + w3) * w3 / (s**2 + w3 * s / q + w3**2))

    for band in vibration.third_octaves():
        exact = math.sqrt(from_si(band.low, "hz") * from_si(band.high, "hz"))
        assert vibration.hand_arm_weight(to_si(exact, "hz")) == pytest.approx(filtered(exact), rel=8e-3)
        assert abs(math.log2(from_si(band.nominal, "hz") / exact)) < 0.03


def test_the_default_limit_of_a_file_is_that_of_the_standard():
    assert Limits().vibration_level_db == vibration.octave(to_si(5800, "rpm")).limit.level


def test_exposure_values():
    assert (vibration.exposure_action_value(), vibration.exposure_limit_value()) == (2.5, 5.0)


def test_the_hand_has_four_of_everything():
    for axis, palm in (("x", 0.4129), ("y", 0.7600), ("z", 1.1252)):
        found = hand(axis)
        assert found.masses[0] == palm
        assert [len(v) for v in (found.masses, found.stiffness, found.damping)] == [4, 4, 4]
        assert min(found.masses + found.stiffness + found.damping) > 0
    with pytest.raises(InputError):
        hand("source")


def test_every_data_file_names_source_and_edition():
    from abu_calc.standards import tables

    for path in (*tables._DATA.iterdir(), *vibration.DATA.iterdir()):
        text = path.read_text(encoding="utf-8")
        if path.suffix == ".toml":
            assert {"source", "edition"} <= set(tomllib.loads(text))
        else:
            assert path.suffix == ".csv"
            assert "# source: " in text
            assert "# edition: " in text
            assert len({len(row) for row in csv_rows(path.stem)}) == 1
