"""Demands on the functional surfaces of each part, from the split of the eccentricity, the limit, and the fits."""

from dataclasses import replace
from typing import TYPE_CHECKING, Final

from abu_calc.sizing.parts.housing_parts import GeometricalTolerance, HousingParts, Kind, Surface, TurnedPart
from abu_calc.standards.tolerance_classes import grade_tolerance

if TYPE_CHECKING:
    from abu_calc.sizing.manufacture.cover import Cover
    from abu_calc.sizing.manufacture.eccentricity import EccentricitySplit
    from abu_calc.sizing.manufacture.ring_seat import RaceQuality, RingSeat

RACE_TOLERANCE: Final = 0.05e-3
"""Tolerance of the race's radius, either way [m]."""
GROOVE_TOLERANCE: Final = 0.2e-3
SEAT_ROUGHNESS: Final = 0.4e-6
"""Ra of ground bores and seats [m], Rz about 1.6 µm."""
FACE_ROUGHNESS: Final = 0.8e-6
GENERAL_ROUGHNESS: Final = 3.2e-6
"""Ra of surfaces that no entry names [m]."""


def with_surfaces(
    parts: HousingParts, split: "EccentricitySplit", quality: "RaceQuality", cover: "Cover", seat: "RingSeat | None"
) -> HousingParts:
    """The parts with the demands on their surfaces."""
    race = _race(parts, split, quality)
    cover_seat, cover_rim = _closure(parts, cover, quality.circularity)
    body = [*_bore(parts, split), cover_seat]
    if parts.ring is None or seat is None:
        return replace(parts, body=_with(parts.body, [*body, race]), cover=_with(parts.cover, [cover_rim]))
    size = parts.dimensions
    ring_seat = Surface("ring seat", "cylinder", 2 * size.ring_radius, tolerance_class=seat.seat_class,
                        limits=seat.seat, roughness=SEAT_ROUGHNESS,
                        geometrical=(GeometricalTolerance("run-out", _seat_run_out(parts, split), "A"),))  # fmt: skip
    outside = Surface("outside", "cylinder", 2 * size.ring_radius, tolerance_class=seat.ring_class, limits=seat.ring,
                      roughness=SEAT_ROUGHNESS)  # fmt: skip
    in_ring = size.ring_end > size.cover_start
    return replace(
        parts,
        body=_with(parts.body, [*_bore(parts, split), ring_seat, *(() if in_ring else (cover_seat,))]),
        ring=_with(parts.ring, [race, outside, *((cover_seat,) if in_ring else ())]),
        cover=_with(parts.cover, [cover_rim]),
    )


def _with(part: TurnedPart, surfaces: list[Surface]) -> TurnedPart:
    return replace(part, surfaces=tuple(surfaces))


def _bore(parts: HousingParts, split: "EccentricitySplit") -> tuple[Surface, Surface, Surface]:
    """Bore, which is datum A, and both faces of the hub."""
    size, fit = parts.dimensions, split.fit
    bore = Surface(
        "bore", "cylinder", 2 * size.bore_radius, tolerance_class="" if fit is None else fit.bore_class,
        limits=None if fit is None else fit.bore, roughness=SEAT_ROUGHNESS, datum="A",
        geometrical=(GeometricalTolerance("cylindricity", _half_grade(2 * size.bore_radius)),),
    )  # fmt: skip
    square = grade_tolerance(5, 2 * size.hub_radius)
    mounting = Surface("mounting face", "plane", roughness=FACE_ROUGHNESS, datum="B",
                       geometrical=(GeometricalTolerance("perpendicularity", square, "A"),))  # fmt: skip
    end = Surface("hub end", "plane", roughness=FACE_ROUGHNESS,
                  geometrical=(GeometricalTolerance("parallelism", square, "B"),))  # fmt: skip
    return bore, mounting, end


def _half_grade(size: float) -> float:
    """Form tolerance [m] of a seat: half of IT5."""
    return grade_tolerance(5, size) / 2


def _seat_run_out(parts: HousingParts, split: "EccentricitySplit") -> float:
    """Run-out of the ring's seat [m]: what a bearing's ring leaves of the race's; a ring ground in place needs less."""
    if split.ring_class:
        return 2 * split.race - split.ring_run_out
    return grade_tolerance(7, 2 * parts.dimensions.ring_radius)


def _race(parts: HousingParts, split: "EccentricitySplit", quality: "RaceQuality") -> Surface:
    """The race with its run-out to the bore, which is the split's part alone."""
    size = parts.dimensions
    kind: Kind = "cylinder" if size.groove_radius is None else "torus"
    if split.ring_class:
        return Surface("race", "sphere", 2 * size.race_radius, groove=size.groove_radius,
                       geometrical=(GeometricalTolerance("run-out", split.ring_run_out),))  # fmt: skip
    low, high = quality.hardness
    return Surface(
        "race", kind, 2 * size.race_radius, groove=size.groove_radius, plus_minus=2 * RACE_TOLERANCE,
        groove_plus_minus=None if size.groove_radius is None else GROOVE_TOLERANCE, roughness=quality.roughness,
        geometrical=(
            GeometricalTolerance("circularity", quality.circularity),
            GeometricalTolerance("run-out", 2 * split.race, "A"),
        ),
        hardness=f"{low:g}–{high:g} HRC",
    )  # fmt: skip


def _closure(parts: HousingParts, cover: "Cover", circularity: float) -> tuple[Surface, Surface]:
    """Seat of the cover, and the cover's rim: a fit or a thread.

    A cover that is pressed in beside the race shapes its wall: seat and rim are as round as the race.
    """
    diameter = 2 * parts.dimensions.seat_radius
    if parts.closure == "screwed":
        thread = parts.thread_name(cover.pitch) if cover.pitch else ""
        return Surface("cover seat", "thread", diameter, thread=thread), Surface(
            "outside", "thread", diameter, thread=thread
        )
    fit, size = cover.fit, parts.dimensions
    beside_race = parts.ring is None or size.ring_end > size.cover_start
    form = (GeometricalTolerance("circularity", circularity),) if beside_race else ()
    return (
        Surface("cover seat", "cylinder", diameter, tolerance_class=fit.bore_class if fit else "",
                limits=fit.bore if fit else None, roughness=SEAT_ROUGHNESS, geometrical=form),
        Surface("outside", "cylinder", diameter, tolerance_class=fit.spindle_class if fit else "",
                limits=fit.spindle if fit else None, roughness=SEAT_ROUGHNESS, geometrical=form),
    )  # fmt: skip
