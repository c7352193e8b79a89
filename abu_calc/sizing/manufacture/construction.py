"""Step 11: the construction: parts to make, closure, fastening, seat of the race ring, with their checks."""

from abu_calc.foundation.checks import Check
from abu_calc.foundation.frozen import dataclass
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import Case
from abu_calc.sizing.manufacture.bearing_ring import ring_check
from abu_calc.sizing.manufacture.cover import (
    BURST_RATIO,
    PROOF_SHARE,
    Cover,
    burst_check,
    burst_ratio,
    choose_cover,
    contained,
    containment_check,
    cover_check,
    filling_check,
    overspeed_check,
    overspeed_stress,
)
from abu_calc.sizing.manufacture.eccentricity import EccentricitySplit
from abu_calc.sizing.manufacture.fastening import slip_torque, torque_check
from abu_calc.sizing.manufacture.ring_seat import RaceQuality, RingSeat, bears_ring, race_quality, ring_seat, seat_check
from abu_calc.sizing.parts.demands import with_surfaces
from abu_calc.sizing.parts.housing_parts import HousingParts, housing_parts


@dataclass(frozen=True)
class Construction:
    """Parts with the demands on their surfaces, hold of the cover, seat of the race ring, checks."""

    parts: HousingParts
    quality: RaceQuality
    cover: Cover
    seat: RingSeat | None
    checks: tuple[Check, ...]
    requirements: tuple[tuple[str, bool], ...]
    """Requirements of the search by name, and whether the construction meets them."""


def construct(case: Case, candidate: Candidate, split: EccentricitySplit) -> Construction:
    """The construction of a candidate at the highest speed."""
    parts, top = housing_parts(case, candidate), case.speed_range[1]
    force, quality = candidate.strength.ball_force, race_quality(case, candidate)
    closed, seat = choose_cover(case, parts, force, top), ring_seat(case, parts, force, top)
    torque = slip_torque(case, parts, split.fit)

    checks = (
        filling_check(parts),
        overspeed_check(parts, force, top),
        cover_check(parts, closed),
        *torque_check(case, parts, split.fit, torque),
        burst_check(parts, force, top),
        *containment_check(case, parts, top),
        *seat_check(case, parts, seat),
        *ring_check(case, candidate.race_radius),
    )
    requirements = (
        ("strength at overspeed", _strong(parts, force, top)),
        ("hold of the cover", closed.holds),
        ("slip torque", torque is None or torque.holds),
        ("containment of a ball", contained(case, parts, top)),
        ("strength of the ring's seat", bears_ring(parts, seat)),
    )
    return Construction(with_surfaces(parts, split, quality, closed, seat), quality, closed, seat, checks, requirements)


def _strong(parts: HousingParts, force: float, top: float) -> bool:
    """True if stress at overspeed and burst speed both hold."""
    _, stress, material = overspeed_stress(parts, force, top)
    return stress <= PROOF_SHARE * material.strength and burst_ratio(parts, force, top) >= BURST_RATIO
