"""A swing arm judged as a whole: its bounds, the balanced state on it, and a change that was tried where they fail."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Final

from abu_calc.checks import Check, Grade, coded, verdict
from abu_calc.dynamics.balanced.arrangements import Arrangement
from abu_calc.dynamics.balanced.stability import stability
from abu_calc.dynamics.scene import Scene
from abu_calc.errors import NotTrustworthyError
from abu_calc.frozen import dataclass
from abu_calc.progress import Progress, silent
from abu_calc.scenes.from_design import contact_half_angle, scene_of_design
from abu_calc.sizing.arm_repairs import Change, Way, changes
from abu_calc.sizing.design import Design
from abu_calc.sizing.swing_arm import SwingArmBounds, doubted, swing_arm_bounds
from abu_calc.spec.machine import SwingArm
from abu_calc.units import from_si

MARGINS: Final = (1.05, 1.2, 1.5, 2.0, 3.0)
"""Over each bound, one after another, until the balanced state is stable, too."""

STRONGER: Final = (2.0, 5.0, 20.0, 100.0)
"""Times the joint damping, where the bounds do not suffice."""

FAR: Final = math.log(10)
"""Another way that asks for more than so much of a key is not worth telling."""

IDLE, CUTTING = "swing-arm-idle", "swing-arm-cutting"
BOUNDS: Final = {
    "ABU501": ("moment_of_inertia_kg_m2",),
    "ABU502": ("joint_damping_N_s_per_m",),
    "ABU503": ("pressing_moment_N_m", "contact_angle_deg"),
    "ABU504": ("contact_angle_deg",),
}
"""What the remedy of each check changes."""


@dataclass(frozen=True)
class ArmJudgement:
    """All checks of an arm, what to change on it in a line, and the changes with which all checks passed."""

    bounds: SwingArmBounds
    checks: tuple[Check, ...]
    advice: str
    changes: tuple[Change, ...] = ()

    @property
    def may_pass(self) -> bool:
        """Whether all checks pass, as it is or with the changes."""
        return bool(self.changes) or not any(_bad(check) for check in self.checks)


def judge_arm(design: Design, progress: Progress = silent) -> ArmJudgement | None:
    """Of a sized machine; None where it hangs on no arm. What is advised was tried: every check of the arm passes."""
    table, bounds = design.case.table.swing_arm, design.swing_arm
    if table is None or bounds is None:
        return None
    borrowed = table.borrowed()
    checks = (*bounds.checks, *doubted((balanced_check(design),), borrowed))
    doubt = " It rests on example data." if borrowed else ""
    bad = {check.code for check in checks if _bad(check)}
    if not bad:
        return ArmJudgement(bounds, checks, f"nothing to change. {_room(bounds)}{doubt}")
    if not _carries(design):
        return ArmJudgement(bounds, checks, "the balls cannot carry the imbalance: no change of the arm helps.")
    found = _tried(design, bad, progress)
    if not found:
        text = f"no change found. Tried: inertia, damping and contact angle, to {MARGINS[-1]:g} times their bounds"
        return ArmJudgement(bounds, checks, f"{text}.{doubt}")
    told = "; or ".join(", ".join(change.text for change in one) for one in found)
    text = f"change {told}. {'Each tried' if len(found) > 1 else 'Tried'}: all checks of the arm pass.{doubt}"
    return ArmJudgement(bounds, tuple(_remedied(check, found[0]) for check in checks), text, found[0])


def balanced_check(design: Design) -> Check:
    """Whether the balls stay where they balance: off the work and on it, at the ends of the speed range.

    Warns where they do not at the worst contact angle; there, at the lowest speed, evenly fanned balls are judged.
    """
    code, unit = "ABU505", "1/s"
    if not _carries(design):
        return coded(code, "not-done", "the balls cannot carry the imbalance, see ABU201", unit=unit,
                     remedy="Heavier or more balls, or a better balanced wheel.")  # fmt: skip
    try:
        rates, missing = _rates(design)
        worst = _worst_angle(design)
    except NotTrustworthyError as error:
        reason = f"not known: {str(error).splitlines()[0]}"
        return coded(code, "not-done", reason, unit=unit, remedy="Another drag, or more joint damping.")
    place = max(rates, key=lambda one: rates[one][0], default="")
    rate, stable = rates.get(place, (None, True))
    if stable and missing:
        grade: Grade = "warn" if rates else "not-done"
        return coded(code, grade, f"{missing}, and is not judged there", rate, 0.0, unit, "See ABU503 and ABU504.")
    message = f"every small disturbance dies out, off the work and on it; the slowest {place}"
    remedy = None
    if not stable:
        message, remedy = f"not every small disturbance dies out {place}", "More joint damping or more inertia."
    elif not worst:
        message += "; not at the worst contact angle"
        angle = from_si(_bounds(design).worst_angle, "deg")
        remedy = f"Stay away from a contact angle of {angle:.3g}°, or more inertia."
    return coded(code, verdict(stable, worst), message, rate, 0.0, unit, remedy)


def _rates(design: Design) -> tuple[dict[str, tuple[float, bool]], str]:
    """Growth rate [1/s] and whether it is stable, by place and speed; and why a place could not be judged."""
    speeds = dict.fromkeys((*design.case.speed_range, design.case.speed))
    table, rates, missing = _table(design), dict[str, tuple[float, bool]](), ""
    for name, words in ((IDLE, "off the work"), (CUTTING, "at work")):
        if name == IDLE and not table.joint_stiffness_N_per_m:
            continue  # nothing holds it there
        try:
            scene = scene_of_design(design, name)
        except NotTrustworthyError as error:
            missing = f"at work: {str(error).splitlines()[0]}"
            continue
        for speed in speeds:
            rpm = f"{words}, at {from_si(speed, 'rpm'):.6g} rpm"
            rates[rpm] = _growth(design, replace(scene, speed=speed), "worst")
    return rates, missing


def _worst_angle(design: Design) -> bool:
    """Whether it is stable at the worst contact angle."""
    angle = from_si(_bounds(design).worst_angle, "deg")
    turned = _with(design, _table(design).model_copy(update={"contact_angle_deg": angle}))
    try:
        scene = scene_of_design(turned, CUTTING)
    except NotTrustworthyError:  # not pressed there, nor anywhere else
        return True
    return _growth(design, replace(scene, speed=design.case.speed_range[0]), "fan")[1]


def _growth(design: Design, scene: Scene, arrangement: Arrangement) -> tuple[float, bool]:
    found = stability(scene, contact_half_angle(design), arrangement)
    if found.growth_rate is None or found.stable is None:
        raise NotTrustworthyError(found.reason or "there is no balanced state")
    return found.growth_rate, found.stable


def _ways(bad: set[str]) -> Iterator[tuple[Way, ...]]:
    """Kinds of change for the bounds that fail, each from small to large."""
    if bad != {"ABU505"}:
        yield tuple(Way(margin) for margin in MARGINS)
    if "ABU501" in bad:
        yield tuple(Way(margin, softer_contact=True) for margin in MARGINS)
    if "ABU504" in bad:
        yield tuple(Way(margin, joint="stiffer") for margin in MARGINS)
    if "ABU503" in bad and "ABU504" not in bad:
        yield tuple(Way(margin, joint="softer") for margin in MARGINS)


def _stronger() -> Iterator[tuple[Way, ...]]:
    """Where no margin over the bounds makes the balanced state stable: more damping, more inertia, both."""
    yield tuple(Way(damping=one) for one in STRONGER)
    yield tuple(Way(inertia=one) for one in MARGINS[1:])
    yield tuple(Way(inertia=one, damping=two) for one in MARGINS[1:] for two in STRONGER)


def _tried(design: Design, bad: set[str], progress: Progress) -> list[tuple[Change, ...]]:
    """A change of each kind that passes, the nearest first; more damping and more inertia where one is too little."""
    found = [one for one in (_first(design, ways, progress) for ways in _ways(bad)) if one]
    if not found:
        damping, inertia, both = _stronger()
        found = [one for one in (_first(design, damping, progress), _first(design, inertia, progress)) if one]
        found = found or [one for one in (_first(design, both, progress),) if one]
    found.sort(key=_reach)
    return [one for one in found if one is found[0] or all(change.reach < FAR for change in one)]


def _reach(found: tuple[Change, ...]) -> float:
    """How far it is, in halves of a power of e: of ways about as far the first one stays first."""
    return round(2 * max(change.reach for change in found))


def _first(design: Design, ways: tuple[Way, ...], progress: Progress) -> tuple[Change, ...]:
    """The smallest change of a kind with which every check of the arm passes; none where there is none."""
    tried = ((way, found) for way in ways if (found := _changes(design, way)))
    before: Way | None = None
    for way, found in tried:
        progress(f"swing arm: with {', '.join(change.text for change in found)}")
        if changed(design, found):
            nearer = before and _changes(design, _between(before, way))
            return nearer if nearer and changed(design, nearer) else found
        before = way
    return ()


def _changes(design: Design, way: Way) -> tuple[Change, ...]:
    arm, own, lowest = _bounds(design).arm, _table(design).moment_of_inertia_kg_m2, design.case.speed_range[0]
    return changes(arm, own, design.imbalance.value, lowest, way) or ()


def _between(one: Way, other: Way) -> Way:
    """Half way from one that did not pass to one that did, by multiples."""
    return replace(
        other, margin=math.sqrt(one.margin * other.margin), inertia=math.sqrt(one.inertia * other.inertia),
        damping=math.sqrt(one.damping * other.damping),
    )  # fmt: skip


def changed(design: Design, found: tuple[Change, ...]) -> Design | None:
    """The machine with another arm; None where some check of it does not pass."""
    values = _table(design).model_dump() | {change.key: change.new for change in found}
    try:
        table = SwingArm.model_validate(values)
    except ValueError:  # beyond what a file may say
        return None
    case, one = design.case, design.autobalancer
    bounds = swing_arm_bounds(case, table, design.imbalance.value, one.mass, one.capacity)
    if any(_bad(check) for check in bounds.checks):
        return None
    other = replace(_with(design, table), swing_arm=bounds)
    try:  # the quick part first
        cutting = replace(scene_of_design(other, CUTTING), speed=case.speed_range[0])
        held = _growth(other, cutting, "fan")[1] and not _bad(balanced_check(other))
    except NotTrustworthyError:
        return None
    return other if held else None


def _with(design: Design, table: SwingArm) -> Design:
    whole = design.case.table.model_copy(update={"swing_arm": table})
    return replace(design, case=replace(design.case, table=whole))


def _remedied(check: Check, found: tuple[Change, ...]) -> Check:
    """A check that failed, with its part of the change."""
    if not _bad(check):
        return check
    own = [change.text for change in found if change.key in BOUNDS.get(check.code, ())] or [
        "what the line on the arm says"
    ]
    return replace(check, remedy=f"Tried: {', '.join(own)}.")


def _room(bounds: SwingArmBounds) -> str:
    """By how much the arm is better than it must be."""
    arm, limit = bounds.arm, min(bounds.stiffness_limit, bounds.stiffness_limit_exact)
    stiffer = "any contact"
    if arm.contact_stiffness:
        stiffer = f"less than {limit / arm.contact_stiffness:.3g} times the contact stiffness"
    share = 100 * bounds.damping_limit / arm.joint_damping
    return f"The bounds permit {stiffer}, and ask for more than {share:.2g} % of the joint damping."


def _carries(design: Design) -> bool:
    one = design.autobalancer
    return one.capacity >= design.imbalance.value * abs(one.requirement.plane_ratio)


def _bad(check: Check) -> bool:
    return check.status in ("fail", "not-done")


def _table(design: Design) -> SwingArm:
    table = design.case.table.swing_arm
    assert table is not None
    return table


def _bounds(design: Design) -> SwingArmBounds:
    assert design.swing_arm is not None
    return design.swing_arm
