"""Requirements of the search for balls, by name: which of them a design misses. The search reads no check."""

from collections.abc import Iterator
from typing import Final

from abu_calc.sizing.balls import Candidate, shortfalls
from abu_calc.sizing.case import Case
from abu_calc.sizing.design import Design
from abu_calc.sizing.handles import band_end
from abu_calc.sizing.track import LEAST_HARDNESS_HRC, Track, carries_over
from abu_calc.sizing.vibration import measurably_lower

LEVEL, ACCELERATION = "level", "acceleration at the handles"
EXPECTED: Final = frozenset({LEVEL, ACCELERATION})
"""Limits of vibration, as expected."""
INERTIA: Final = " by the band of the estimated inertia"
DOUBTFUL: Final = frozenset(limit + INERTIA for limit in EXPECTED)
"""The same limits at the end of the band that an estimated inertia leaves."""


def missed(design: Design) -> frozenset[str]:
    """Names of the requirements that a design misses. What depends on the file alone is alike for all candidates."""
    return frozenset(name for name, met in _requirements(design) if not met)


def loudness(design: Design) -> tuple[int, int]:
    """How many limits of vibration are exceeded as expected, and how many in doubtful cases."""
    names = missed(design)
    return len(names & EXPECTED), len(names & DOUBTFUL)


def missed_by_race(case: Case, candidate: Candidate, race: Track) -> frozenset[str]:
    """Names of the requirements on balls and race alone that they miss."""
    hard = case.autobalancer.race_hardness_HRC >= LEAST_HARDNESS_HRC
    own = ("hardness of the race", hard), ("speed that carries the balls over", carries_over(case, race))
    return frozenset((*shortfalls(case, candidate), *(name for name, met in own if not met)))


def _requirements(design: Design) -> Iterator[tuple[str, bool]]:
    case, chosen, arm = design.case, design.autobalancer, design.swing_arm
    yield from ((name, False) for name in missed_by_race(case, chosen, design.track))
    yield "speeds at which balls balance", design.frequency.balancing_possible
    off = chosen.budget.plane_offset if case.race_offset and case.body.is_rigid else 0.0
    yield "race near the wheel", off <= chosen.budget.permitted
    yield "fit of the bore", design.eccentricity.holds
    yield from design.construction.requirements
    yield "lower level than without", measurably_lower(design.idle)
    yield from _vibration(design)
    if arm is not None:
        damping, bunched = arm.arm.joint_damping, arm.damping_limit_bunched
        softest = min(arm.contact_stiffness_limit, arm.contact_stiffness_limit_exact)
        yield "supercritical arm", arm.arm.contact_stiffness < softest
        yield "damping of the pivot", damping > arm.damping_limit
        yield "damping of the pivot, balls together", bunched is not None and damping > bunched


def _vibration(design: Design) -> Iterator[tuple[str, bool]]:
    levels, total, bands, limit = design.speed_levels, design.highest_total, design.bands, design.case.level_limit
    if levels is not None:
        yield LEVEL, levels.highest.level_after_db <= limit
        yield LEVEL + INERTIA, bands is None or bands.level is None or bands.level[1] <= limit
    permitted = design.case.table.limits.a_hv_m_per_s2
    if permitted is not None and total is not None:
        end = band_end(total, bands, design.case)
        yield ACCELERATION, total.total <= permitted
        yield ACCELERATION + INERTIA, end is None or end <= permitted
