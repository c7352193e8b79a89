"""Stability of the balanced state of a scene, and the speeds at which it changes."""

from typing import Annotated, ClassVar, Final, NamedTuple

from abu_calc.checks import Check, verdict
from abu_calc.dynamics.balanced.arrangements import ARRANGEMENTS, Arrangement
from abu_calc.dynamics.balanced.boundaries import Boundary, boundaries, growth_over
from abu_calc.dynamics.balanced.crossings import crossings_of
from abu_calc.dynamics.balanced.stability import Stability, critical_damping
from abu_calc.dynamics.balanced.stability import stability as judged
from abu_calc.dynamics.effects.grinding_contact import GrindingContact
from abu_calc.dynamics.scene import Scene
from abu_calc.errors import InputError, Place
from abu_calc.progress import Progress, silent
from abu_calc.studies.arguments import checked, one_of
from abu_calc.studies.arm_records import ArmMotion, SwingArm
from abu_calc.studies.consequence import ArrangementEnd
from abu_calc.studies.design_records import StabilityBoundary, stability_boundaries
from abu_calc.studies.hanging import Hanging
from abu_calc.studies.quantity import Quantity, Record, record
from abu_calc.studies.result import Result
from abu_calc.studies.scene_model import SceneModel
from abu_calc.studies.simulated_scene import finite
from abu_calc.studies.stability_warnings import stability_warnings
from abu_calc.studies.subject import Source, Subject, subject_of
from abu_calc.units import from_si, to_si, wrapped_deg

SCENES: Final = ("idle", "swing-arm-idle", "swing-arm-cutting")
"""Scenes of a machine with a balanced state.

A run-up passes through all speeds, and a wheel at the workpiece is held.
"""

FASTEST_RPM: Final = 1e6
SPEEDS: Final = f"LOW:HIGH in rpm, above 0, ascending, up to {FASTEST_RPM:g}"
"""The range of speeds that can be asked for, in words."""

SLOWEST, FASTEST = 0.1, 2.0
"""Range in which crossings are looked for unless one is given, in multiples of the scene's own speed."""

SPEEDS_SHOWN: Final = 81
"""Number of speeds over a range at which the growth rate is given."""

Pairs = tuple[tuple[float, float], ...]


@record
class Crossing(Record):
    """A speed at which eigenvalues or multipliers cross the edge of stability."""

    speed_rpm: Annotated[float, Quantity("speed", "Ω", 6)]
    growing_below: Annotated[int, Quantity("growing below it")]
    growing_above: Annotated[int, Quantity("growing above it")]


@record
class GrowthAt(Record):
    """Growth rate of the slowest-dying disturbance at a speed; below zero it dies out."""

    speed_rpm: Annotated[float, Quantity("speed", "Ω", 6)]
    growth_rate_per_s: Annotated[float, Quantity("growth rate of a disturbance", "max Re λ")]


@record
class StabilityResult(Result):
    """The balanced state of a scene at its speed; complex numbers as real and imaginary part."""

    command: ClassVar[str] = "stability"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"searched_rpm"}
    optional: ClassVar[frozenset[str]] = frozenset(
        {"arm_advice", "swing_arm", "arm_motion", "growth_by_speed", "consequence"}
    )

    model: SceneModel
    speed_rpm: Annotated[float, Quantity("speed", "Ω", 6)]
    state: Annotated[str | None, Quantity("state judged", "", 4, "balanced, race still or arm alone")]
    stable: Annotated[bool | None, Quantity("stable")]
    growth_rate_per_s: Annotated[float | None, Quantity("growth rate of a disturbance", "max Re λ")]
    eigenvalues: Annotated[Pairs | None, Quantity("eigenvalues", "λ", 5, "1/s")]
    floquet_multipliers: Annotated[Pairs | None, Quantity("Floquet multipliers of one revolution", "μ", 5)]
    critical_damping_N_s_per_m: Annotated[float | None, Quantity("damping against parametric resonance", "h_sh")]
    resting_angles_deg: Annotated[tuple[float, ...] | None, Quantity("balls rest at", "θ", 5)]
    arrangement: Annotated[str, Quantity("arrangement", "", 4, "asked for: worst, fan or start")]
    arrangements_judged: Annotated[int, Quantity("arrangements judged")]
    hanging: Hanging | None
    effects_left_out: Annotated[tuple[str, ...], Quantity("effects left out of the linear motion")]
    boundaries_rpm: tuple[StabilityBoundary, ...] | None
    crossings_rpm: tuple[Crossing, ...] | None
    arm_advice: Annotated[str | None, Quantity("what to change on the arm")] = None
    swing_arm: SwingArm | None = None
    arm_motion: ArmMotion | None = None
    growth_by_speed: tuple[GrowthAt, ...] | None = None
    """Growth rates over the speeds asked for, of the arrangement that is worst at each."""
    consequence: ArrangementEnd | None = None
    """Outcome of balls in the worst arrangement, if it grows and others do not."""
    searched_rpm: tuple[float, float] | None
    """The range of speeds that boundaries were looked for in."""


@checked
def stability(
    source: Source, scene: str | None = None, *, speeds_rpm: tuple[float, float] | None = None,
    arrangement: str = "worst", crossings: bool = False, progress: Progress = silent,
) -> StabilityResult:  # fmt: skip
    """Judge the balanced state of a scene by eigenvalues or Floquet multipliers, and say whether balls may hang.

    `scene`: of a machine, see `SCENES`. With `speeds_rpm`, low and high, also every speed between them where stability
    changes; with `crossings` too, every speed where an eigenvalue crosses, though others grow already, without a range
    from a tenth to twice the scene's speed. `arrangement` of more than two balls in a race: the "worst" of all that
    balance, the even "fan", or that to which they go from the "start" angles. Raises InputError, and
    NotTrustworthyError where multipliers do not settle.
    """
    one_of("scene", scene, SCENES)
    one_of("arrangement", arrangement, ARRANGEMENTS)
    _check_speeds(speeds_rpm)
    subject, way = (
        subject_of(source, scene, command="stability"),
        next(name for name in ARRANGEMENTS if name == arrangement),
    )
    if crossings and speeds_rpm is None:
        rated = from_si(subject.scene.speed, "rpm")
        speeds_rpm = SLOWEST * rated, min(FASTEST * rated, FASTEST_RPM)
    pressed = grinds(subject.scene)
    progress("balanced state")
    judgement = not_judged(subject.scene) if pressed else judged(subject.scene, subject.half_angle, way)
    # What cannot be judged at one speed cannot at others.
    if speeds_rpm:
        progress(f"speeds from {speeds_rpm[0]:g} to {speeds_rpm[1]:g} rpm")
    limits = _limits(subject, speeds_rpm, way) if speeds_rpm and judgement.reason is None else None
    arm = _on_arm(subject, progress)
    return StabilityResult(
        title=subject.title,
        checks=(_check(judgement, way, pressed=pressed),),
        warnings=(*subject.warnings, *stability_warnings(judgement, subject.scene, way), *arm.warnings),
        model=SceneModel.of(subject.scene),
        provenance=subject.provenance,
        speed_rpm=from_si(judgement.speed, "rpm"),
        state=judgement.state,
        stable=judgement.stable,
        growth_rate_per_s=finite(judgement.growth_rate),
        eigenvalues=_pairs(judgement.eigenvalues),
        floquet_multipliers=_pairs(judgement.multipliers),
        critical_damping_N_s_per_m=critical_damping(subject.scene),
        resting_angles_deg=None if judgement.angles is None else tuple(map(wrapped_deg, judgement.angles)),
        arrangement=arrangement,
        arrangements_judged=judgement.arrangements,
        hanging=Hanging.of(subject.scene, subject.half_angle),
        effects_left_out=judgement.left_out,
        boundaries_rpm=None if limits is None else stability_boundaries(limits),
        crossings_rpm=_crossings(subject, speeds_rpm, way) if crossings and speeds_rpm and limits is not None else None,
        arm_advice=arm.advice,
        swing_arm=arm.bounds,
        arm_motion=arm.motion,
        growth_by_speed=None if limits is None or speeds_rpm is None else _growth(subject, speeds_rpm, limits, way),
        consequence=_consequence(subject, judgement, way, progress),
        searched_rpm=speeds_rpm,
    )


def _consequence(subject: Subject, judgement: Stability, way: Arrangement, progress: Progress) -> ArrangementEnd | None:
    """Outcome of the worst arrangement if it grows and others do not, on an anisotropic support."""
    if way != "worst" or judgement.stable is not False or judgement.multipliers is None:
        return None
    from abu_calc.analysis.disturbed import consequence

    progress("the worst arrangement, disturbed")
    end = consequence(subject.scene, judgement, subject.half_angle)
    return None if end is None else ArrangementEnd.of(end)


class ArmAnswer(NamedTuple):
    """Statements on a swing arm; empty for other supports."""

    advice: str | None = None
    bounds: SwingArm | None = None
    motion: ArmMotion | None = None
    warnings: tuple[str, ...] = ()


def _on_arm(subject: Subject, progress: Progress) -> ArmAnswer:
    """Motion of an arm with its imbalance; for a machine also the bounds and what to change."""
    if subject.scene.support.standing_arm(subject.scene.balls) is None:
        return ArmAnswer()
    from abu_calc.analysis.arm import judge_arm
    from abu_calc.analysis.arm_motion import arm_motion
    from abu_calc.analysis.scene_arm import advise_scene

    judged = None if subject.design is None else judge_arm(subject.design, progress)
    advice = advise_scene(subject.scene) if judged is None else judged.advice
    bounds = None if judged is None else SwingArm.of(judged)
    moved = arm_motion(subject.scene)
    if isinstance(moved, str):
        return ArmAnswer(advice, bounds, None, (f"No forced motion and no tongue: {moved}.",))
    return ArmAnswer(advice, bounds, None if moved is None else ArmMotion.of(moved))


def _check_speeds(speeds_rpm: tuple[float, float] | None) -> None:
    if speeds_rpm is None or 0 < speeds_rpm[0] < speeds_rpm[1] <= FASTEST_RPM:
        return
    speed_range = ":".join(f"{speed:g}" for speed in speeds_rpm)
    raise InputError("not a range of speeds", place=Place(key="speeds_rpm"), found=speed_range, allowed=SPEEDS)


def _limits(subject: Subject, speeds_rpm: tuple[float, float], way: Arrangement) -> tuple[Boundary, ...]:
    low, high = (to_si(speed, "rpm") for speed in speeds_rpm)
    return boundaries(subject.scene, low, high, subject.half_angle, way)


def _growth(
    subject: Subject, speeds_rpm: tuple[float, float], limits: tuple[Boundary, ...], way: Arrangement
) -> tuple[GrowthAt, ...]:
    """Evenly over the range, and where stability changes."""
    low, high = (to_si(speed, "rpm") for speed in speeds_rpm)
    even = (low + (high - low) * step / (SPEEDS_SHOWN - 1) for step in range(SPEEDS_SHOWN))
    speeds = sorted({*even, *(boundary.speed for boundary in limits)})
    return tuple(
        GrowthAt(speed_rpm=from_si(speed, "rpm"), growth_rate_per_s=rate)
        for speed, rate in growth_over(subject.scene, speeds, subject.half_angle, way)
    )


def _crossings(subject: Subject, speeds_rpm: tuple[float, float], way: Arrangement) -> tuple[Crossing, ...]:
    low, high = (to_si(speed, "rpm") for speed in speeds_rpm)
    return tuple(
        Crossing(
            speed_rpm=from_si(crossing.speed, "rpm"),
            growing_below=crossing.growing_below,
            growing_above=crossing.growing_above,
        )
        for crossing in crossings_of(subject.scene, low, high, subject.half_angle, way)
    )


def grinds(scene: Scene) -> bool:
    """True if the scene presses a wheel to the workpiece in the plane.

    Its balanced state is not that of an idle machine.
    """
    return any(isinstance(effect, GrindingContact) and effect.contact != "face" for effect in scene.effects)


def not_judged(scene: Scene) -> Stability:
    """The answer for a scene that grinds."""
    reason = (
        "the scene presses the wheel to its work, and the idle balanced state is another one: no verdict is given on it"
    )
    left_out = tuple(effect.name for effect in scene.effects)
    return Stability(scene.speed, None, None, None, None, None, None, reason, left_out)


def _pairs(values: tuple[complex, ...] | None) -> Pairs | None:
    return None if values is None else tuple((value.real, value.imag) for value in values)


def _check(judgement: Stability, way: Arrangement, *, pressed: bool) -> Check:
    name = ("ABU802", "stability of the balanced state")
    if judgement.reason is not None:
        remedy = "A second race in another plane, or bearings alike along x and y." if way != "start" else None
        if pressed:
            remedy = "`abu simulate` shows it at work; without grinding_contact in its file the idle state is judged."
        return Check(*name, "not-done", judgement.reason, unit="1/s", remedy=remedy)
    if judgement.angles is None:
        return Check(
            *name, "fail", "there is no balanced state: the balls cannot carry the imbalance", unit="1/s",
            remedy="Heavier or more balls, a larger race, or a better balanced rotor.",
        )  # fmt: skip
    message = "every small disturbance of the balanced state dies out"
    if not judgement.stable:
        message = "not every small disturbance dies out, although the balls could balance here"
    remedy = (
        None
        if judgement.stable
        else "Leave the forbidden speeds (--speeds finds them, Python: speeds_rpm=), or change drag and damping."
    )
    return Check(*name, verdict(bool(judgement.stable)), message, finite(judgement.growth_rate), 0.0, "1/s", remedy)
