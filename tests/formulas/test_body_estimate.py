"""Estimated bodies: the shares that the source of the estimate gives, and its bands."""

import pytest

from abu_calc.formulas.rigid_body import LENGTHS, BodyEstimate, Layout, PlacedBody, estimated_body
from abu_calc.foundation.errors import InputError, RangeError

LENGTH: dict[Layout, dict[str, float]] = {
    "straight": {"L": 0.45},
    "angle": {"L": 0.30, "H": 0.06},
    "face": {"H": 0.30},
}


def effective_share(placed: PlacedBody) -> float:
    return placed.body.effective_mass(placed.wheel) / placed.body.mass


@pytest.mark.parametrize(
    ("layout", "share", "low", "high"),
    [("straight", 0.29, 0.235, 0.35), ("angle", 0.495, 0.42, 0.57), ("face", 0.35, 0.29, 0.42)],
)
def test_effective_share_of_the_mass(layout: Layout, share: float, low: float, high: float) -> None:
    """Against 4000 random assemblies; those of angle grinders have other heights too, so 0.05 of the mass is left."""
    estimate = estimated_body(layout, 5.0, LENGTH[layout])
    assert effective_share(estimate.nominal) == pytest.approx(share, abs=0.025)
    found = estimate.band(effective_share)
    assert found[0] == pytest.approx(low, abs=0.01)
    assert found[1] == pytest.approx(high, abs=0.05)


@pytest.mark.parametrize(("layout", "width"), [("straight", 0.13), ("angle", 0.08), ("face", 0.12)])
def test_known_centre_of_mass_narrows_the_band(layout: Layout, width: float) -> None:
    guessed = estimated_body(layout, 5.0, LENGTH[layout])
    known = estimated_body(layout, 5.0, LENGTH[layout], center_of_mass_to_wheel=guessed.nominal.wheel)
    assert known.nominal == guessed.nominal
    low, high = known.band(effective_share)
    nominal = effective_share(known.nominal)
    assert (high - low) / 2 / nominal == pytest.approx(width, abs=0.02)
    assert all(placed.wheel == known.nominal.wheel for pair in known.ends for placed in pair)


def test_straight_machine_by_hand() -> None:
    placed = estimated_body("straight", 6.0, {"L": 0.5}).nominal
    assert placed.wheel == pytest.approx((0.0, 0.0, 0.22))
    assert placed.body.inertia is not None
    assert placed.body.inertia.xx == pytest.approx(6.0 * (0.284 * 0.5) ** 2)
    assert placed.body.inertia.yy == placed.body.inertia.xx


def test_angle_machine_by_hand() -> None:
    placed = estimated_body("angle", 2.4, {"L": 0.3, "H": 0.06}, polar=1e-4).nominal
    assert placed.wheel == pytest.approx((0.087, 0.0, 0.048))
    assert placed.body.inertia is not None
    assert placed.body.inertia.xz == pytest.approx(-0.2 * 2.4 * 0.087 * 0.048)
    assert placed.body.rotor_polar_inertia == 1e-4


def test_angle_machine_of_unknown_height() -> None:
    """0.8 · 0.22 L to the wheel plane; the height of usual machines widens the band, and lies within it."""
    alone = estimated_body("angle", 2.4, {"L": 0.3})
    assert alone.nominal.wheel == pytest.approx((0.087, 0.0, 0.0528))

    def mass(placed: PlacedBody) -> float:
        return placed.body.effective_mass(placed.wheel)

    low, high = alone.band(mass)
    for height in (0.054, 0.06, 0.084):
        known = estimated_body("angle", 2.4, {"L": 0.3, "H": height})
        assert low < mass(known.nominal) < high
        assert high - low > known.band(mass)[1] - known.band(mass)[0]


@pytest.mark.parametrize("layout", list(LENGTHS))
def test_missing_length_is_refused_by_its_key(layout: Layout) -> None:
    for missing in LENGTHS[layout]:
        if (layout, missing) == ("angle", "H"):
            continue  # assumed by the length
        lengths = {name: length for name, length in LENGTH[layout].items() if name != missing}
        with pytest.raises(InputError, match=r"machine\.length_mm|machine\.height_mm"):
            estimated_body(layout, 5.0, lengths)


@pytest.mark.parametrize("height", [0.001, 0.16])
def test_odd_proportions_of_an_angle_grinder_are_refused(height: float) -> None:
    with pytest.raises(RangeError):
        estimated_body("angle", 2.4, {"L": 0.3, "H": height})


def test_band_of_a_sure_quantity_has_no_width() -> None:
    estimate = estimated_body("face", 5.0, LENGTH["face"])
    assert estimate.band(lambda placed: placed.body.mass) == (5.0, 5.0)
    assert isinstance(estimate, BodyEstimate)
