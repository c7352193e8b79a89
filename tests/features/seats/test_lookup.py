"""Bearings looked up by designation or by sizes."""

from typing import Any

import pytest

from abu_calc.features.seats.lookup import from_table
from abu_calc.features.seats.seats import seat_bearing
from abu_calc.foundation.errors import InputError
from tests.features.seats.samples import by_designation, seats


def um(metres: float) -> float:
    return round(1e6 * metres, 6)


def span(interval: Any) -> list[float]:
    return [um(interval.smallest), um(interval.largest)]


def test_a_designation_brings_its_sizes_and_type() -> None:
    found = seat_bearing(by_designation("7516"))
    assert found.bearing.type == "tapered"
    assert span(found.housing.interference) == [-32, 28]  # the ring of a tapered bearing is 0/−20
    assert found.shaft.load_intensity == pytest.approx(1.8 * 3000 / 0.028)
    given = seat_bearing(by_designation("7516", chamfer_mm=2.0))
    assert given.shaft.load_intensity == pytest.approx(1.8 * 3000 / 0.029)
    assert given.housing.load_intensity == pytest.approx(1.8 * 3000 / 0.024)  # the cup is 28 mm wide


@pytest.mark.parametrize(("written", "read"), [("C3", "C3"), ("P5", None)])
def test_suffixes_of_the_designation_count(written: str, read: str | None) -> None:
    found = seat_bearing(by_designation(f"6205-2RS {written}", bearing_class=None)).bearing
    assert found.internal_clearance == read
    assert found.bearing_class == ("5" if written == "P5" else "0")
    with pytest.raises(InputError, match="contradicts the designation"):
        seat_bearing(by_designation("6205 C3 P5", internal_clearance="CN", bearing_class="6"))


def test_a_group_of_a_bearing_that_has_none_is_refused() -> None:
    for name, group in (("7206B", "CN"), ("7206B", "C3"), ("6203", "CB"), ("HK1010", "CN")):
        with pytest.raises(InputError, match="no clearance group of this name"):
            seat_bearing(by_designation(name, internal_clearance=group))
    with pytest.raises(InputError, match="40° alone"):
        seat_bearing(by_designation("7005C", internal_clearance="CB"))
    assert seats(internal_clearance=None).clearance is None
    assert seats(internal_clearance="CN", bearing_type="ball").clearance is not None
    with pytest.raises(InputError, match="without the type"):
        seats(internal_clearance="CN", width_mm=33.5)  # of no bearing
    assert seats(internal_clearance="CN").clearance is not None  # as 32216
    assert seats(internal_clearance="CN", bearing_type="cylindrical").clearance is not None


def test_a_chamfer_is_lent_by_the_bearing_of_the_same_sizes() -> None:
    found = seats(chamfer_mm=None)
    assert found.bearing.inner.chamfer == pytest.approx(2.5e-3)
    assert any("that of 32216" in note for note in found.shaft.notes)
    assert um(found.housing.ring_limits.lower) == -18  # still taken as a radial bearing
    assert not any("chamfer" in note for note in seats().shaft.notes)


def test_given_ratings_win_and_what_is_not_known_is_not_guessed() -> None:
    given = seat_bearing(by_designation("6205", dynamic_load_rating_kN=10.0, radial_load_kN=1.0))
    assert given.bearing.load_ratio == pytest.approx(0.1)
    assert seats().bearing.load_ratio == pytest.approx(3 / 187)  # 32216 has these sizes
    assert seats(width_mm=33.5).bearing.load_ratio is None  # no bearing has these, and no type is given
    assert seats(dynamic_load_rating_kN=187.0, bearing_type="tapered").shaft.joint.maker.classes == ("m6",)


def test_sizes_beside_a_designation_must_agree() -> None:
    """6205 is 25 × 52 × 15 mm (ISO 15)."""
    assert from_table(by_designation("6205", bore_mm=25.0, outer_mm=52.0, width_mm=15.0)).designation == "6205"
    with pytest.raises(InputError, match="outer_mm contradicts") as caught:
        from_table(by_designation("6205", outer_mm=62.0))
    assert (caught.value.found, caught.value.allowed) == ("62", "52")


def test_measured_limits_are_metres_inside() -> None:
    looked_up = from_table(by_designation("6205", shaft_limits_um=(-14.0, -6.0)))
    measured = looked_up.shaft.measured
    assert measured is not None and (measured.lower, measured.upper) == pytest.approx((-14e-6, -6e-6))
    assert looked_up.housing.measured is None


def test_a_type_beside_a_designation_must_be_its_own() -> None:
    """6205 is a deep groove ball bearing, 30205 one with tapered rollers (ISO 355)."""
    for name, own, other in (
        ("6205", "ball", "tapered"),
        ("30205", "tapered", "ball"),
        ("NU205", "cylindrical", "ball"),
    ):
        assert from_table(by_designation(name, bearing_type=own)).kind == own
        with pytest.raises(InputError, match=f"bearing_type contradicts the designation {name}") as caught:
            from_table(by_designation(name, bearing_type=other))
        assert (caught.value.place.key, caught.value.found, caught.value.allowed) == ("bearing_type", other, own)
