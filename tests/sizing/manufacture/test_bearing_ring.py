"""The race of a bearing's ring: a sphere, estimated, or the design is refused."""

import math

import pytest

from abu_calc.foundation.errors import InputError
from abu_calc.sizing import size
from abu_calc.sizing.manufacture.bearing_ring import bearing_rings, sphere_band
from tests.sizing.machines import machine

ROOM = {"autobalancer__design": "bearing-ring", "autobalancer__max_outer_diameter_mm": 90.0,
        "autobalancer__max_width_mm": 40.0, "autobalancer__max_mass_fraction": 0.2}  # fmt: skip


@pytest.mark.slow
def test_the_groove_is_the_sphere_and_the_ring_is_one_of_the_catalogue() -> None:
    design = size(machine(**ROOM))
    best = design.autobalancer
    ring = next(each for each in bearing_rings() if each.sphere_radius == best.race_radius)
    assert design.track.groove_radius == best.race_radius
    dimensions = design.construction.parts.dimensions
    assert dimensions.groove_radius == best.race_radius and dimensions.inner_width == ring.width
    assert 2 * dimensions.ring_radius == ring.outside_diameter
    assert next(each for each in design.checks if each.code == "ABU312").status == "warn"


def test_a_measured_sphere_is_used_as_it_is() -> None:
    design = size(machine(**ROOM, autobalancer__race_radius_mm=28.4))
    assert design.autobalancer.race_radius == pytest.approx(28.4e-3)
    assert next(each for each in design.checks if each.code == "ABU312").status == "pass"


def test_every_sphere_lies_inside_its_ring_and_runs_out_to_its_faces() -> None:
    for ring in bearing_rings():
        low, high = sphere_band(ring)
        assert low < ring.sphere_radius < high < ring.outside_diameter / 2
        assert ring.width / 2 < math.sqrt(low**2 - (ring.width / 2) ** 2)


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"autobalancer__max_outer_diameter_mm": 40.0}, "1203"),
        ({"autobalancer__race_radius_mm": 40.0}, "the nearest is"),
    ],
)
def test_where_no_ring_fits_the_design_is_refused_with_the_nearest(changes: dict[str, float], word: str) -> None:
    with pytest.raises(InputError, match=word):
        size(machine(**{**ROOM, **changes}))
