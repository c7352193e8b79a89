"""Changes of a swing arm that are worth a trial, beyond those that meet its bounds."""

from collections.abc import Iterator, Mapping, Set
from dataclasses import replace
from itertools import islice, product
from typing import Final

from abu_calc.features.swing_arm.scenes import on_work
from abu_calc.features.swing_arm.verdict import CUTTING, IDLE, ArmJudgement, balanced_check, steady_at_work
from abu_calc.foundation.checks import RANK
from abu_calc.simulation.design_scenes import simulated
from abu_calc.simulation.quiet import DECAY_TIMES
from abu_calc.sizing import size
from abu_calc.sizing.actions import with_entries
from abu_calc.sizing.design import Design
from abu_calc.sizing.proposals import ARM, Entries
from abu_calc.sizing.swing_arm import CONTACT, DAMPING, INERTIA, MARGINS, PRESSING, swing_arm_bounds, up

Way = dict[str, float]
"""Entries of the arm."""

STRONGER: Final = (1.0, 2.0, 5.0, 20.0, 100.0)
"""Factors on the damping of the pivot with which the balanced state may be stable."""
FIRMER: Final = (1.0, 2.0, 4.0)
"""Factors on the pressing torque with which the disk may stay on its workpiece."""
TIMES: Final = (1.0, 4.0)
"""Factors on the damping with which the arm comes to rest within the longest scene."""
LONGEST: Final = 3.0
"""Quiet times permitted: as long as a scene lasts at most."""


def changes_on_arm(
    design: Design, judged: ArmJudgement, mending: Mapping[str, object], lost: Set[str], *, late: bool, strict: bool
) -> Iterator[Entries]:
    """Changes with which bounds, balanced state and scenes hold, on top of `mending` of sizing; then more damping.

    None if all checks of the arm pass, its scenes are not `lost`, and start cases on it are not `late` alone. `strict`:
    checks have to pass without a warning.
    """
    table, scenes = design.case.table, lost & {IDLE, CUTTING}
    least = RANK.index("pass" if strict and not judged.table.borrowed() else "warn")
    if not late and not scenes and all(RANK.index(check.status) >= least for check in judged.checks):
        return
    design = size(with_entries(table, mending)) if mending else design
    ways = ((way, _on_arm(design, way, least)) for way in _steadier(design))
    steady = ((way, other) for way, other in ways if other and _steady(other, least))
    for nearest, held in islice(steady, 1):
        for way, more in _calmer(held, late=late):
            other = _on_arm(held, way, least)
            if (nearest or way or mending) and other and _stays(other, {CUTTING, *scenes}):
                yield from ({**mending, **nearest, **way, **damping} for damping in ({}, *more))
                return


def _steadier(design: Design) -> Iterator[Way]:
    """The arm as it is, then a softer contact or more inertia, more damping, or both, from near to far."""
    arm = design.case.table.swing_arm
    assert arm is not None
    ways: list[tuple[float, Way]] = [(1.0, {})]
    for factor in MARGINS[1:]:
        ways.append((factor, {ARM + CONTACT: -up(-arm.contact_stiffness_N_per_m / factor)}))
        ways.append((factor, {ARM + INERTIA: up(factor * arm.moment_of_inertia_kg_m2)}))
    pairs = sorted(product(ways, STRONGER), key=lambda pair: (max(pair[0][0], pair[1]), pair[0][0] + pair[1]))
    for (_, way), damping in pairs:
        yield way | ({ARM + DAMPING: up(damping * arm.joint_damping_N_s_per_m)} if damping > 1 else {})


def _calmer(design: Design, *, late: bool) -> Iterator[tuple[Way, list[Way]]]:
    """The arm as it is, then more damping, with which it comes to rest within a scene, a firmer press, or both; with
    each the larger dampings there are. If start cases are `late`, the damping is not kept.
    """
    arm, bounds = design.case.table.swing_arm, design.swing_arm
    assert arm is not None and bounds is not None
    rest = 2 * bounds.arm.inertia / bounds.arm.length**2 * DECAY_TIMES
    rest /= LONGEST * design.case.table.limits.longest_quiet_time
    damped: list[Way] = [
        {ARM + DAMPING: up(times * rest)} for times in TIMES if times * rest > arm.joint_damping_N_s_per_m
    ]
    if not (late and damped):
        damped.insert(0, {})
    pressed: list[Way] = [{ARM + PRESSING: up(factor * arm.pressing_moment_N_m)} for factor in FIRMER]
    ways = product(range(len(damped)), range(len(pressed)))
    for damping, press in sorted(ways, key=lambda way: (sum(way), way[1])):
        yield {**damped[damping], **(pressed[press] if press else {})}, damped[damping + 1 :]


def _on_arm(design: Design, way: Way, least: int) -> Design | None:
    """The design on another arm; None if a bound is missed, by a check below a grade, or if no file may say so."""
    try:
        case = replace(design.case, table=with_entries(design.case.table, way))
    except ValueError:
        return None
    made, arm = design.autobalancer, case.table.swing_arm
    assert arm is not None
    bounds = swing_arm_bounds(case, arm, design.imbalance.value, made.mass, made.capacity)
    missed = any(RANK.index(check.status) < least for check in bounds.checks)
    return None if missed else replace(design, case=case, swing_arm=bounds)


def _steady(design: Design, least: int) -> bool:
    """True if the check of the balanced state has at least a grade; its quick part is made first."""
    return steady_at_work(design) and RANK.index(balanced_check(design).status) >= least


def _stays(design: Design, scenes: set[str]) -> bool:
    """True if the disk stays on its workpiece, and every scene can be simulated."""
    runs, failures = simulated(design, 0.01, names=sorted(scenes))
    check = None if failures else on_work(design, runs)
    return not failures and (check is None or check.status in ("pass", "warn"))
