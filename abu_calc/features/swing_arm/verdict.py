"""A swing arm judged as a whole: its bounds, the balanced state on it, and a change that was tried if they fail."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Final

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.arrangements import Arrangement
from abu_calc.dynamics.stability.verdict import stability
from abu_calc.foundation.checks import Action, Check, Grade, coded, verdict
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.units import from_si
from abu_calc.inputs.machine import SwingArm
from abu_calc.simulation.scene_of_design import contact_half_angle, scene_of_design
from abu_calc.sizing.actions import overrides, pins, words
from abu_calc.sizing.design import Design
from abu_calc.sizing.swing_arm import ArmRepair, SwingArmBounds, Way, changes, doubted, swing_arm_bounds

MARGINS: Final = (1.05, 1.2, 1.5, 2.0, 3.0)
"""Factors over each bound, tried one after another until the balanced state is stable too."""

STRONGER: Final = (2.0, 5.0, 20.0, 100.0)
"""Multiples of the pivot damping, tried if the bounds do not suffice."""

FAR: Final = math.log(10)
"""Another way that asks for more than so much of a key is not worth telling."""

IDLE, CUTTING = "swing-arm-idle", "swing-arm-cutting"


@dataclass(frozen=True)
class ArmJudgement:
    """All checks of an arm, what to change on it in a line, and the changes with which all checks passed."""

    bounds: SwingArmBounds
    checks: tuple[Check, ...]
    advice: str
    changes: tuple[ArmRepair, ...] = ()

    @property
    def may_pass(self) -> bool:
        """True if all checks pass, as the arm is or with the changes."""
        return bool(self.changes) or not any(_bad(check) for check in self.checks)


def judge_arm(
    design: Design, progress: Progress = silent, balanced: Callable[[], Check] | None = None
) -> ArmJudgement | None:
    """Judge the swing arm of a sized machine; None if the machine has no swing arm.

    Every advised change was tried: with it, every check of the arm passes. `balanced` gives the `balanced_check` of the
    design if it was begun before.
    """
    table, bounds = design.case.table.swing_arm, design.swing_arm
    if table is None or bounds is None:
        return None
    borrowed = table.borrowed()
    checks = (*bounds.checks, *doubted((balanced() if balanced else balanced_check(design),), borrowed))
    doubt = " It rests on example data." if borrowed else ""
    bad = {check.code for check in checks if _bad(check)}
    if not bad:
        return ArmJudgement(bounds, checks, f"nothing to change. {_room(bounds)}{doubt}")
    if not _carries(design):
        return ArmJudgement(bounds, checks, "the balls cannot carry the imbalance: no change of the arm helps.")
    plans = _tried(design, bad, progress)
    if not plans:
        text = (
            f"no change found by calculating inertia, damping and contact angle to {MARGINS[-1]:g} times their bounds"
        )
        return ArmJudgement(bounds, checks, f"{text}.{doubt}")
    advice = "; or ".join(", ".join(change.text for change in plan) for plan in plans)
    each = "with each, all" if len(plans) > 1 else "all"
    text = f"change {advice}. Calculated: {each} checks of the arm pass.{doubt}"
    return ArmJudgement(bounds, _with_actions(design, checks, plans[0]), text, plans[0])


def balanced_check(design: Design) -> Check:
    """Check that the balls stay where they balance, off and on the workpiece, over the speed range.

    Judged are the ends of the speed range. The check warns if the balls do not stay at the worst contact
    angle. At that angle, evenly spread balls are judged at the lowest speed.
    """
    code, unit = "ABU505", "1/s"
    if not _carries(design):
        return coded(code, "not-done", "The balls cannot carry the imbalance, see ABU201", unit=unit,
                     remedy="Specify heavier or more balls, or a better balanced wheel.")  # fmt: skip
    try:
        rates, missing = _rates(design)
        worst = _worst_angle(design)
    except NotTrustworthyError as error:
        reason = f"Stability is not known: {str(error).splitlines()[0]}"
        return coded(code, "not-done", reason, unit=unit, remedy="Specify another drag rate, or more pivot damping.")
    place = max(rates, key=lambda location: rates[location][0], default="")
    rate, stable = rates.get(place, (None, True))
    if stable and missing:
        grade: Grade = "warn" if rates else "not-done"
        message = f"{missing}. The balanced state is not judged there"
        return coded(code, grade, message, rate, 0.0, unit, "See the actions of ABU503 and ABU504.")
    message = f"Every small disturbance dies out, off the workpiece and on it, slowest {place}"
    remedy: str | None = None
    if not stable:
        message, remedy = f"A small disturbance grows {place}", "Add damping to the pivot, or inertia to the arm."
    elif not worst:
        message += ". At the worst contact angle a disturbance grows"
        angle = from_si(_bounds(design).worst_contact_angle, "deg")
        remedy = f"Keep away from a contact angle of {angle:.3g}°, or add inertia."
    return coded(code, verdict(stable, worst), message, rate, 0.0, unit, remedy)


def _rates(design: Design) -> tuple[dict[str, tuple[float, bool]], str]:
    """Growth rate [1/s] and whether it is stable, by place and speed; and why a place could not be judged."""
    speeds = dict.fromkeys((*design.case.speed_range, design.case.speed))
    table, rates, missing = _table(design), dict[str, tuple[float, bool]](), ""
    for name, place in ((IDLE, "off the workpiece"), (CUTTING, "on the workpiece")):
        if name == IDLE and not table.joint_stiffness_N_per_m:
            continue  # nothing holds it there
        try:
            scene = scene_of_design(design, name)
        except NotTrustworthyError as error:
            missing = f"On the workpiece: {str(error).splitlines()[0]}"
            continue
        for speed in speeds:
            rpm = f"{place}, at {from_si(speed, 'rpm'):.6g} rpm"
            rates[rpm] = _growth(design, replace(scene, speed=speed), "worst")
    return rates, missing


def _worst_angle(design: Design) -> bool:
    """True if the balanced state is stable at the worst contact angle."""
    angle = from_si(_bounds(design).worst_contact_angle, "deg")
    turned = _with(design, _table(design).model_copy(update={"contact_angle_deg": angle}))
    try:
        scene = scene_of_design(turned, CUTTING)
    except NotTrustworthyError:  # not pressed there, nor anywhere else
        return True
    return _growth(design, replace(scene, speed=design.case.speed_range[0]), "fan")[1]


def _growth(design: Design, scene: Scene, arrangement: Arrangement) -> tuple[float, bool]:
    assessment = stability(scene, contact_half_angle(design), arrangement)
    if assessment.growth_rate is None or assessment.stable is None:
        raise NotTrustworthyError(assessment.reason or "there is no balanced state")
    return assessment.growth_rate, assessment.stable


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
    """Stronger changes if no margin over the bounds makes the balanced state stable.

    They are more damping, more inertia, or both.
    """
    yield tuple(Way(damping=damping) for damping in STRONGER)
    yield tuple(Way(inertia=inertia) for inertia in MARGINS[1:])
    yield tuple(Way(inertia=inertia, damping=two) for inertia in MARGINS[1:] for two in STRONGER)


def _tried(design: Design, bad: set[str], progress: Progress) -> list[tuple[ArmRepair, ...]]:
    """A change of each kind that passes, the nearest first; more damping and more inertia where one is too little."""
    plans = [plan for plan in (_first(design, ways, progress) for ways in _ways(bad)) if plan]
    if not plans:
        damping, inertia, both = _stronger()
        plans = [plan for plan in (_first(design, damping, progress), _first(design, inertia, progress)) if plan]
        plans = plans or [plan for plan in (_first(design, both, progress),) if plan]
    plans.sort(key=_reach)
    return [plan for plan in plans if plan is plans[0] or all(change.reach < FAR for change in plan)]


def _reach(plan: tuple[ArmRepair, ...]) -> float:
    """Size of a change, in halves of a power of e.

    The rounding keeps the first of several changes of about the same size first.
    """
    return round(2 * max(change.reach for change in plan))


def _first(design: Design, ways: tuple[Way, ...], progress: Progress) -> tuple[ArmRepair, ...]:
    """The smallest change of a kind with which every check of the arm passes; none where there is none."""
    tried = ((way, plan) for way in ways if (plan := _changes(design, way)))
    before: Way | None = None
    for way, plan in tried:
        progress(f"swing arm: with {', '.join(change.text for change in plan)}")
        if changed(design, plan):
            nearer = before and _changes(design, _between(before, way))
            return nearer if nearer and changed(design, nearer) else plan
        before = way
    return ()


def _changes(design: Design, way: Way) -> tuple[ArmRepair, ...]:
    arm, own, lowest = _bounds(design).arm, _table(design).moment_of_inertia_kg_m2, design.case.speed_range[0]
    return changes(arm, own, design.imbalance.value, lowest, way) or ()


def _between(failing: Way, other: Way) -> Way:
    """Half way from one that did not pass to one that did, by multiples."""
    return replace(
        other, margin=math.sqrt(failing.margin * other.margin), inertia=math.sqrt(failing.inertia * other.inertia),
        damping=math.sqrt(failing.damping * other.damping),
    )  # fmt: skip


def changed(design: Design, plan: tuple[ArmRepair, ...]) -> Design | None:
    """The machine with another arm; None where some check of it does not pass."""
    values = _table(design).model_dump() | {change.key: change.new for change in plan}
    try:
        table = SwingArm.model_validate(values)
    except ValueError:  # beyond what a file may say
        return None
    case, autobalancer = design.case, design.autobalancer
    bounds = swing_arm_bounds(case, table, design.imbalance.value, autobalancer.mass, autobalancer.capacity)
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


def _with_actions(design: Design, checks: tuple[Check, ...], plan: tuple[ArmRepair, ...]) -> tuple[Check, ...]:
    """The checks with the whole change as their action."""
    entries: dict[str, object] = {f"swing_arm.{change.key}": change.new for change in plan}
    action = Action(f"Set {words(entries)}.", overrides({**entries, **pins(design.autobalancer)}))
    return tuple(check.with_action(action) if _bad(check) else check for check in checks)


def _room(bounds: SwingArmBounds) -> str:
    """Sentence on how far the arm is inside its bounds."""
    arm, limit = bounds.arm, min(bounds.contact_stiffness_limit, bounds.contact_stiffness_limit_exact)
    stiffer = "any contact"
    if arm.contact_stiffness:
        stiffer = f"less than {limit / arm.contact_stiffness:.3g} times the contact stiffness"
    share = 100 * bounds.damping_limit / arm.joint_damping
    return f"The bounds permit {stiffer}, and require more than {share:.2g} % of the pivot damping."


def _carries(design: Design) -> bool:
    autobalancer = design.autobalancer
    return autobalancer.capacity >= design.imbalance.value * abs(autobalancer.requirement.plane_ratio)


def _bad(check: Check) -> bool:
    return check.status in ("fail", "not-done")


def _table(design: Design) -> SwingArm:
    table = design.case.table.swing_arm
    assert table is not None
    return table


def _bounds(design: Design) -> SwingArmBounds:
    assert design.swing_arm is not None
    return design.swing_arm
