"""A swing arm judged as a whole: its bounds, and the balanced state on it."""

from collections.abc import Iterable
from dataclasses import replace

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.family import Arrangement
from abu_calc.dynamics.stability.verdict import stability
from abu_calc.foundation.checks import Check, Grade, coded, verdict
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import in_file, shown
from abu_calc.inputs.duty import SwingArm
from abu_calc.simulation.scene_of_design import scene_of_design
from abu_calc.sizing.design import Design
from abu_calc.sizing.swing_arm import SwingArmBounds, doubted

IDLE, CUTTING = "swing-arm-idle", "swing-arm-cutting"


@dataclass(frozen=True)
class ArmJudgement:
    """The table of an arm, its bounds, and its checks, that of the balanced state last.

    `carries`: whether the balls can carry the imbalance; `simulated`: whether the checks are those of the scenes, too.
    """

    table: SwingArm
    bounds: SwingArmBounds
    checks: tuple[Check, ...]
    carries: bool
    simulated: bool = False

    def advice(self, changes: Iterable[str] = ()) -> str:
        """Sentence on what to change on the arm: `changes` of the next step in words, else the checks that fail."""
        bad, step = [check.code for check in self.checks if check.status in ("fail", "not-done")], ", ".join(changes)
        if step:
            text = f"change {step}, as the next step says (simulated)."
        elif not bad:
            text = f"nothing to change. {_room(self.bounds)}"
        elif not self.carries:
            text = "the balls cannot carry the imbalance: no change of the arm helps."
        else:
            where = "See the actions" if self.simulated else "`abu size FILE` tries changes"
            text = f"not as it must be: {', '.join(bad)}. {where}."
        return f"{text}{' It rests on example data.' if self.table.borrowed() else ''}"


def judge_arm(design: Design) -> ArmJudgement:
    """Judge the swing arm of a sized machine, which must have one."""
    table, bounds = _table(design), _bounds(design)
    balanced = doubted((balanced_check(design),), table.borrowed())
    return ArmJudgement(table, bounds, (*bounds.checks, *balanced), _carries(design))


def balanced_check(design: Design) -> Check:
    """Check that the balls stay where they balance, off and on the workpiece, over the speed range.

    Judged are the ends of the speed range. The check warns if the balls do not stay at the worst contact
    angle. At that angle, evenly spread balls are judged at the lowest speed.
    """
    if not _carries(design):
        return coded("ABU505", "not-done", "The balls cannot carry the imbalance, see ABU201", None,
            remedy="Specify heavier or more balls, or a better balanced wheel.",
        )  # fmt: skip
    try:
        rates, missing = _rates(design)
        worst = _worst_angle(design)
    except NotTrustworthyError as error:
        reason = f"Stability is not known: {str(error).splitlines()[0]}"
        return coded("ABU505", "not-done", reason, None)
    place = max(rates, key=lambda location: rates[location][0], default="")
    rate, stable = rates.get(place, (None, True))
    if stable and missing:
        grade: Grade = "warn" if rates else "not-done"
        message = f"{missing}. The balanced state is not judged there"
        return coded("ABU505", grade, message, rate, 0.0)
    message = f"Every small disturbance dies out, off the workpiece and on it, slowest {place}"
    if not stable:
        message = f"A small disturbance grows {place}"
    elif not worst:
        angle = shown(_bounds(design).worst_contact_angle, "deg")
        message += f". At the worst contact angle, {angle}, a disturbance grows"
    return coded("ABU505", verdict(stable, worst), message, rate, 0.0)


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
            rpm = f"{place}, at {shown(speed, 'rpm', '.6g')}"
            rates[rpm] = _growth(design, replace(scene, speed=speed), "worst")
    return rates, missing


def _worst_angle(design: Design) -> bool:
    """True if the balanced state is stable at the worst contact angle."""
    angle = dict([in_file("contact_angle_deg", _bounds(design).worst_contact_angle)])
    turned = _with(design, _table(design).model_copy(update=angle))
    try:
        scene = scene_of_design(turned, CUTTING)
    except NotTrustworthyError:  # not pressed there, nor anywhere else
        return True
    return _growth(design, replace(scene, speed=design.case.speed_range[0]), "fan")[1]


def steady_at_work(design: Design) -> bool:
    """True if evenly spread balls stay on the workpiece, at the lowest speed: the quick part of the check."""
    try:
        scene = replace(scene_of_design(design, CUTTING), speed=design.case.speed_range[0])
        return _growth(design, scene, "fan")[1]
    except NotTrustworthyError:
        return False


def _growth(design: Design, scene: Scene, arrangement: Arrangement) -> tuple[float, bool]:
    assessment = stability(scene, design.autobalancer.half_angle, arrangement)
    if assessment.growth_rate is None or assessment.stable is None:
        raise NotTrustworthyError(assessment.reason or "there is no balanced state")
    return assessment.growth_rate, assessment.stable


def _with(design: Design, table: SwingArm) -> Design:
    whole = design.case.table.model_copy(update={"swing_arm": table})
    return replace(design, case=replace(design.case, table=whole))


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


def _table(design: Design) -> SwingArm:
    table = design.case.table.swing_arm
    assert table is not None
    return table


def _bounds(design: Design) -> SwingArmBounds:
    assert design.swing_arm is not None
    return design.swing_arm
