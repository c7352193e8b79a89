"""Step 11: the construction: parts to make, closure, fastening, seat of the race ring, with their checks."""

from abu_calc.foundation.checks import Check
from abu_calc.foundation.frozen import dataclass
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.bearing_ring import ring_check
from abu_calc.sizing.case import Case
from abu_calc.sizing.closure import (
    burst_check,
    containment_check,
    filling_check,
    overspeed_check,
)
from abu_calc.sizing.cover import Cover, choose_cover, cover_check
from abu_calc.sizing.eccentricity import EccentricitySplit
from abu_calc.sizing.fastening import torque_check
from abu_calc.sizing.parts.demands import with_surfaces
from abu_calc.sizing.parts.housing_parts import HousingParts, housing_parts
from abu_calc.sizing.race_quality import RaceQuality, race_quality
from abu_calc.sizing.ring_seat import RingSeat, ring_seat, seat_check


@dataclass(frozen=True)
class Construction:
    """Parts with the demands on their surfaces, hold of the cover, seat of the race ring, checks."""

    parts: HousingParts
    quality: RaceQuality
    cover: Cover
    seat: RingSeat | None
    checks: tuple[Check, ...]


def construct(case: Case, candidate: Candidate, split: EccentricitySplit) -> Construction:
    """The construction of a candidate at the highest speed."""
    parts, top = housing_parts(case, candidate), case.speed_range[1]
    force, quality = candidate.strength.ball_force, race_quality(case, candidate)
    closed, seat = choose_cover(case, parts, force, top), ring_seat(case, parts, force, top)
    checks = (
        filling_check(parts),
        overspeed_check(parts, force, top),
        cover_check(parts, closed),
        torque_check(case, candidate, parts, split.fit),
        burst_check(parts, force, top),
        containment_check(case, parts, top),
        *seat_check(case, parts, seat),
        *ring_check(case, candidate.race_radius),
    )
    return Construction(with_surfaces(parts, split, quality, closed, seat), quality, closed, seat, checks)
