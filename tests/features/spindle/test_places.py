"""Places of the races searched on the spindle, against displacements and levers written out here."""

import pytest

from abu_calc.features.spindle.case import SpindleCase, arms, capacity_needs, choose_all, read_case
from abu_calc.features.spindle.study import _search_notes
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import read_machine

TRUE = tuple(f"autobalancer.{k}.race_eccentricity_mm=0.0" for k in (0, 1))


def case_of(*overrides: str) -> SpindleCase:
    tables = read_machine("pedestal-grinder", overrides).spindle
    assert tables is not None
    return read_case(tables)


@pytest.mark.slow
def test_without_a_stretch_the_given_places_stand() -> None:
    assert case_of().races == (0.3, -0.3)
    assert not list(_search_notes(choose_all(case_of())))


def test_true_races_go_where_the_larger_capacity_is_least() -> None:
    """Beyond its wheel race 1 carries less than 2500 g·mm, and race 2 more: 2166 g·mm at 340 and -259 mm."""
    case = case_of(
        *TRUE, "autobalancer.0.plane_range_mm=[220.0, 340.0]", "autobalancer.1.plane_range_mm=[-340.0, -220.0]"
    )
    chosen = max(capacity_needs(case))
    grid = [(z1 / 1e3, -z2 / 1e3) for z1 in range(220, 341, 10) for z2 in range(220, 341, 10)]
    needs = [
        max(
            sum(abs((place - z2 if race == 0 else z1 - place) / (z1 - z2)) * size for place, size in WHEELS)
            for race in (0, 1)
        )
        for z1, z2 in grid
    ]
    assert chosen == pytest.approx(min(needs), rel=0.005)  # the search steps by 3 mm
    first, second = case.races
    assert chosen == pytest.approx(
        (0.26 - second) / (first - second) * 2500e-6 + abs(-0.26 - second) / (first - second) * 1800e-6
    )


WHEELS = ((0.26, 2500e-6), (-0.26, 1800e-6))


@pytest.mark.slow
def test_races_go_outside_the_places_that_must_be_still() -> None:
    """A handle at 400 mm: races at ±z leave it Δ·max(1, 0.4/z) off; at 400 mm and beyond no more than Δ."""
    handle = 'machine.handle=[{name="h", from_center_of_mass_mm=400.0}]'
    wide = ("autobalancer.0.plane_range_mm=[250.0, 450.0]", "autobalancer.1.plane_range_mm=[-450.0, -250.0]")
    case = case_of(handle, *wide)
    assert case.races[0] >= 0.4 - 1e-9
    assert arms((0.4,), case.races) == pytest.approx(1.0)
    assert arms((0.4,), (0.3, -0.3)) == pytest.approx(0.8 / 0.6)
    notes = list(_search_notes(choose_all(case)))
    assert "race eccentricity at the loudest place: 13.3 µm as given, 10 µm as chosen" in notes[-1].lower()


def test_races_that_may_touch_stay_apart() -> None:
    stretch = ("autobalancer.{k}.plane_range_mm=[-100.0, 100.0]", "autobalancer.{k}.plane_mm={z}")
    case = case_of(*(entry.format(k=k, z=z) for k, z in enumerate((100.0, -100.0)) for entry in stretch))
    assert abs(case.races[0] - case.races[1]) > 1e-3


@pytest.mark.parametrize("stretch", ["[310.0, 340.0]", "[340.0, 280.0]", "[300.0]", '["a", "b"]'])
def test_a_stretch_without_its_place_is_refused(stretch: str) -> None:
    with pytest.raises(InputError):
        case_of(f"autobalancer.0.plane_range_mm={stretch}")
