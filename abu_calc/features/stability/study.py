"""Stability of the balanced state of a scene, and the speeds at which it changes.

The result also holds warnings about the method, bounds on stalling of balls with the margin of the viscous drag rate,
and the outcome of balls in a growing arrangement.
"""

from collections.abc import Iterator
from typing import Annotated, ClassVar, Final, NamedTuple, Self

from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.boundaries import Crossing, StabilityBoundary, boundaries, crossings_of, growth_over
from abu_calc.dynamics.stability.family import ARRANGEMENTS, Arrangement
from abu_calc.dynamics.stability.stall import hanging_bounds
from abu_calc.dynamics.stability.verdict import Stability, critical_damping
from abu_calc.dynamics.stability.verdict import stability as judged
from abu_calc.features.stability.attractors import Attractor, AttractorSearch, attractors_of
from abu_calc.features.stability.disturbed import ArrangementEnd, consequence
from abu_calc.features.swing_arm.view import ArmMotion, SwingArmRecord
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import shown, to_si, wrapped_deg
from abu_calc.inputs.read_machine import Machine
from abu_calc.registry import imported
from abu_calc.simulation.arguments import checked, one_of
from abu_calc.simulation.records import SceneModel, finite
from abu_calc.simulation.result import Result
from abu_calc.simulation.subject import Source, Subject, subject_of

STATES = ("at a resonance", "above a heavily damped resonance", "at rest under gravity")
"""Stalled states of balls, in the order of the bounds."""


@record
class HangingBound(Record):
    """Viscous drag rate above which balls do not stall in one of three ways; null if no drag rate suffices."""

    state: Annotated[str, Quantity("balls can stall")]
    drag: Annotated[float | None, Quantity("up to a drag rate of", unit="per_s")]
    margin: Annotated[float | None, Quantity("drag rate over the bound")]


@record
class Hanging(Record):
    """Closed bounds at the scene's speed: they suffice and are not necessary."""

    drag: Annotated[float, Quantity("viscous drag rate of the race", "h₀", unit="per_s")]
    hanging_drag: Annotated[float | None, Quantity("drag rate above which no ball stalls", unit="per_s")]
    doubt: Annotated[bool, Quantity("balls may stall")]
    bounds: tuple[HangingBound, ...]

    @classmethod
    def of(cls, scene: Scene, half_angle: float) -> Self | None:
        """Record of a scene with balls; `half_angle` [rad] of touching ones, 0 without size."""
        if not scene.ball_masses:
            return None
        bounds = hanging_bounds(scene, half_angle, horizontal=scene.effect("gravity") is not None)
        drags = zip(STATES, (bounds.resonance, bounds.damped, bounds.gravity), strict=True)
        return cls(
            drag=bounds.drag,
            hanging_drag=bounds.largest,
            doubt=bounds.doubt(),
            bounds=tuple(
                HangingBound(state=state, drag=drag, margin=bounds.margin(drag)) for state, drag in drags if drag > 0
            ),
        )


SCENES: Final = ("idle", "swing-arm-idle", "swing-arm-cutting")
"""Scenes of a machine with a balanced state.

A run-up passes through all speeds, and a wheel at the workpiece is held.
"""

FASTEST_RPM: Final = 1e6
SPEEDS: Final = f"LOW:HIGH in rpm, above 0, ascending, up to {FASTEST_RPM:g}"
"""The range of speeds that can be asked for, in words."""

DRAWN: Final = 64
"""Starts that are drawn in a search for attractors unless a number is given."""

SLOWEST, FASTEST = 0.1, 2.0
"""Range in which crossings are looked for unless one is given, in multiples of the scene's own speed."""

SPEEDS_SHOWN: Final = 81
"""Number of speeds over a range at which the growth rate is given."""

Pairs = tuple[tuple[float, float], ...]


@record
class GrowthAt(Record):
    """Growth rate of the slowest-dying disturbance at a speed; below zero it dies out."""

    speed: Annotated[float, Quantity("speed", "Ω", 6, unit="rpm")]
    growth_rate: Annotated[float, Quantity("growth rate of a disturbance", "max Re λ", unit="per_s")]


@record
class StabilityResult(Result):
    """The balanced state of a scene at its speed; complex numbers as real and imaginary part."""

    command: ClassVar[str] = "stability"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"searched"}
    optional: ClassVar[frozenset[str]] = frozenset(
        {"arm_advice", "swing_arm", "arm_motion", "growth_by_speed", "consequence", "attractors", "attractor_search"}
    )

    model: SceneModel
    speed: Annotated[float, Quantity("speed", "Ω", 6, unit="rpm")]
    state: Annotated[str | None, Quantity("state judged", "", 4, "balanced, race still or arm alone")]
    stable: Annotated[bool | None, Quantity("stable")]
    growth_rate: Annotated[float | None, Quantity("growth rate of a disturbance", "max Re λ", unit="per_s")]
    eigenvalues: Annotated[Pairs | None, Quantity("eigenvalues", "λ", 5, "1/s")]
    floquet_multipliers: Annotated[Pairs | None, Quantity("Floquet multipliers of one revolution", "μ", 5)]
    critical_damping: Annotated[
        float | None, Quantity("damping against parametric resonance", "h_sh", unit="N_s_per_m")
    ]
    resting_angles_deg: Annotated[tuple[float, ...] | None, Quantity("balls rest at", "θ", 5)]
    arrangement: Annotated[str, Quantity("arrangement", "", 4, "asked for: worst, fan or start")]
    arrangements_judged: Annotated[int, Quantity("arrangements judged")]
    hanging: Hanging | None
    effects_left_out: Annotated[tuple[str, ...], Quantity("effects left out of the linear motion")]
    boundaries_rpm: tuple[StabilityBoundary, ...] | None
    crossings_rpm: tuple[Crossing, ...] | None
    arm_advice: Annotated[str | None, Quantity("what to change on the arm")] = None
    swing_arm: SwingArmRecord | None = None
    arm_motion: ArmMotion | None = None
    growth_by_speed: tuple[GrowthAt, ...] | None = None
    """Growth rates over the speeds asked for, of the arrangement that is worst at each."""
    consequence: ArrangementEnd | None = None
    """Outcome of balls in the worst arrangement, if it grows and others do not."""
    attractors: tuple[Attractor, ...] | None = None
    """All attractors that starts reach, if they were asked for."""
    attractor_search: AttractorSearch | None = None
    searched: Annotated[tuple[float, float] | None, Quantity("range in which boundaries were looked for", unit="rpm")]


@checked
def stability(
    source: Source, scene: str | None = None, *, speeds_rpm: tuple[float, float] | None = None,
    arrangement: str = "worst", crossings: bool = False, attractors: bool = False, starts: int | None = None,
    seed: int = 0, only: str | None = None, progress: Progress = silent,
) -> StabilityResult:  # fmt: skip
    """Judge the balanced state of a scene by eigenvalues or Floquet multipliers, and say whether balls may hang.

    `scene`: of a machine, see `SCENES`. With `speeds_rpm`, low and high, also every speed between them where stability
    changes; with `crossings` too, every speed where an eigenvalue crosses, though others grow already, without a range
    from a tenth to twice the scene's speed. `arrangement` of more than two balls in a race: the "worst" of all that
    balance, the even "fan", or that to which they go from the "start" angles. `attractors` adds where starts end:
    designed ones and `starts` (64) drawn by `seed`, or of these the one named `only`. Raises InputError, and
    NotTrustworthyError where multipliers do not settle.
    """
    one_of("scene", scene, SCENES)
    one_of("arrangement", arrangement, ARRANGEMENTS)
    _check_speeds(speeds_rpm)
    if starts is not None and not attractors:
        raise InputError("starts are followed for attractors alone", place=Place(key="starts"), found=str(starts),
                         remedy="Add --attractors, Python: attractors=True.")  # fmt: skip
    way = next(name for name in ARRANGEMENTS if name == arrangement)
    subject = _subject(source, scene)
    band = _band(speeds_rpm, subject.scene.speed if crossings else None)
    pressed = grinds(subject.scene)
    if attractors and pressed:
        raise InputError(
            "the wheel is pressed to its workpiece: there is no balanced state to end at",
            place=Place(key="attractors"), remedy="Leave grinding_contact out of the file, or ask for another --scene.",
        )  # fmt: skip
    progress("balanced state")
    judgement = not_judged(subject.scene) if pressed else judged(subject.scene, subject.half_angle, way)
    # What cannot be judged at one speed cannot at others.
    limits = crossed = None
    if band:
        progress(f"speeds from {shown(band, 'rpm', 'g', ' to ')}")
    if band and judgement.reason is None:
        limits = boundaries(subject.scene, *band, subject.half_angle, way)
        crossed = crossings_of(subject.scene, *band, subject.half_angle, way) if crossings else None
    arm = _on_arm(subject)
    ends = attractors_of(subject, DRAWN if starts is None else starts, seed, progress, only) if attractors else None
    return StabilityResult(
        title=subject.title,
        checks=(_check(judgement, way, pressed=pressed), *(ends[2:] if ends else ())),
        warnings=(*subject.warnings, *stability_warnings(judgement, subject.scene, way), *arm.warnings),
        provenance=subject.provenance,
        model=SceneModel.of(subject.scene),
        speed=judgement.speed,
        state=judgement.state,
        stable=judgement.stable,
        growth_rate=judgement.growth_rate,
        eigenvalues=_pairs(judgement.eigenvalues),
        floquet_multipliers=_pairs(judgement.multipliers),
        critical_damping=critical_damping(subject.scene),
        resting_angles_deg=None if judgement.angles is None else tuple(map(wrapped_deg, judgement.angles)),
        arrangement=arrangement,
        arrangements_judged=judgement.arrangements,
        hanging=Hanging.of(subject.scene, subject.half_angle),
        effects_left_out=judgement.left_out,
        boundaries_rpm=limits,
        crossings_rpm=crossed,
        arm_advice=arm.advice,
        swing_arm=arm.bounds,
        arm_motion=arm.motion,
        growth_by_speed=None if limits is None or band is None else _growth(subject, band, limits, way),
        consequence=_consequence(subject, judgement, way, progress),
        attractors=ends[0] if ends else None,
        attractor_search=ends[1] if ends else None,
        searched=band,
    )


def _consequence(subject: Subject, judgement: Stability, way: Arrangement, progress: Progress) -> ArrangementEnd | None:
    """Outcome of the worst arrangement if it grows and others do not, on an anisotropic support."""
    if way != "worst" or judgement.stable is not False or judgement.multipliers is None:
        return None
    progress("the worst arrangement, disturbed")
    return consequence(subject.scene, judgement, subject.half_angle)


class ArmAnswer(NamedTuple):
    """Statements on a swing arm; empty for other supports."""

    advice: str | None = None
    bounds: SwingArmRecord | None = None
    motion: ArmMotion | None = None
    warnings: tuple[str, ...] = ()


def _on_arm(subject: Subject) -> ArmAnswer:
    """Motion of an arm with its imbalance; for a machine also its bounds and which of them fail."""
    if subject.scene.support.standing_arm(subject.scene.balls) is None:
        return ArmAnswer()
    from abu_calc.features.swing_arm.motion import arm_motion
    from abu_calc.features.swing_arm.scenes import advise_scene
    from abu_calc.features.swing_arm.verdict import judge_arm

    bounds = None if subject.design is None else SwingArmRecord.of(judge_arm(subject.design))
    advice = advise_scene(subject.scene) if bounds is None else bounds.advice
    moved = arm_motion(subject.scene)
    if isinstance(moved, str):
        return ArmAnswer(advice, bounds, None, (f"No forced motion and no tongue: {moved}.",))
    return ArmAnswer(advice, bounds, moved)


def _check_speeds(speeds_rpm: tuple[float, float] | None) -> None:
    if speeds_rpm is None or 0 < speeds_rpm[0] < speeds_rpm[1] <= FASTEST_RPM:
        return
    speed_range = ":".join(f"{speed:g}" for speed in speeds_rpm)
    raise InputError("not a range of speeds", place=Place(key="speeds_rpm"), found=speed_range, allowed=SPEEDS)


def _band(speeds_rpm: tuple[float, float] | None, rated: float | None) -> tuple[float, float] | None:
    """Range of speeds [rad/s] as asked for, else about the rated one."""
    if speeds_rpm is not None:
        return to_si(speeds_rpm[0], "rpm"), to_si(speeds_rpm[1], "rpm")
    return None if rated is None else (SLOWEST * rated, min(FASTEST * rated, to_si(FASTEST_RPM, "rpm")))


def _growth(
    subject: Subject, band: tuple[float, float], limits: tuple[StabilityBoundary, ...], way: Arrangement
) -> tuple[GrowthAt, ...]:
    """Evenly over the band of speeds, and where stability changes."""
    low, high = band
    even = (low + (high - low) * step / (SPEEDS_SHOWN - 1) for step in range(SPEEDS_SHOWN))
    speeds = sorted({*even, *(boundary.speed for boundary in limits)})
    return tuple(
        GrowthAt(speed=speed, growth_rate=rate)
        for speed, rate in growth_over(subject.scene, speeds, subject.half_angle, way)
    )


def grinds(scene: Scene) -> bool:
    """True if the scene presses a wheel to the workpiece in the plane.

    Its balanced state is not that of an idle machine.
    """
    return any(isinstance(effect, GrindingContactEffect) and effect.contact != "face" for effect in scene.effects)


def not_judged(scene: Scene) -> Stability:
    """The answer for a scene that grinds."""
    reason = "the scene presses the wheel to its workpiece, where the balanced state differs from that at idle"
    left_out = tuple(effect.name for effect in scene.effects)
    return Stability(scene.speed, None, None, None, None, None, None, reason, left_out)


def _pairs(values: tuple[complex, ...] | None) -> Pairs | None:
    return None if values is None else tuple((value.real, value.imag) for value in values)


def _check(judgement: Stability, way: Arrangement, *, pressed: bool) -> Check:
    if judgement.reason is not None:
        remedy = "Specify a second race in another plane, or bearings alike along x and y." if way != "start" else None
        if pressed:
            remedy = (
                "`abu simulate FILE` shows the motion on the workpiece. Remove grinding_contact from the file to judge "
                "the idle state."
            )
        return coded("ABU802", "not-done", judgement.reason, None, remedy=remedy)
    if judgement.angles is None:
        return coded("ABU802", "fail", "there is no balanced state: the balls cannot carry the imbalance", None,
            remedy="Specify heavier or more balls, a larger race, or a better balanced rotor.",
        )  # fmt: skip
    message = "every small disturbance of the balanced state dies out"
    if not judgement.stable:
        message = "a small disturbance of the balanced state grows, although the balls could balance here"
    remedy = (
        None
        if judgement.stable
        else "Avoid the unstable speeds (--speeds finds them, Python: speeds_rpm=), or change drag rate and damping."
    )
    return coded("ABU802", verdict(bool(judgement.stable)), message, finite(judgement.growth_rate), 0.0, remedy)


BALANCED_TO_FIRST_ORDER: Final = frozenset({"gravity"})
"""Effects that leave the balanced state as it is, to the first order."""


def _subject(source: Source, scene: str | None) -> Subject:
    """Subject of a source; of a machine with two races, its balls evenly spread."""
    if isinstance(source, Machine) and source.spindle is not None:
        subject: Subject = imported("spindle.start_cases:spindle_subject")(source, scene, "spread")
        return subject
    return subject_of(source, scene, command="stability")


def stability_warnings(judgement: Stability, scene: Scene, way: Arrangement) -> Iterator[str]:
    """Each a sentence or two."""
    yield from _state_judged(judgement, scene)
    if judgement.multipliers is not None:
        yield (
            "The support acts differently as the rotor turns: Floquet multipliers of one revolution replace the "
            "eigenvalues."
        )
    if judgement.angles is not None:
        yield from _arrangements(judgement, scene, way)
    others = [name for name in judgement.left_out if name not in BALANCED_TO_FIRST_ORDER]
    if others:
        yield f"Left out of the linear motion, at steady speed: {', '.join(others)}."


def _state_judged(judgement: Stability, scene: Scene) -> Iterator[str]:
    """Warnings about a judged state other than balls opposite the imbalance with a still axis."""
    if judgement.reason:
        yield f"No eigenvalues: {judgement.reason}."
    elif judgement.state is None:
        yield "No eigenvalues: there is no balanced state at this speed."
    if judgement.state == "race still":
        yield (
            "The race is not in the plane of the imbalance. Its balls hold the race still; the spindle keeps moving "
            "elsewhere. That state is judged."
        )
    if judgement.state == "arm alone":
        why = "the balls cannot carry the imbalance" if scene.ball_masses else "there are no balls"
        yield f"The forced motion of the arm alone with its imbalance is judged: {why}."


def _arrangements(judgement: Stability, scene: Scene, way: Arrangement) -> Iterator[str]:
    """Warning about the arrangement that was judged, of many that balance."""
    counts = [len(race.ball_masses) for race in scene.races]
    most = max(counts, default=0)
    if most <= 2:
        return
    phrase = {
        "fan": "the one spread evenly about the light side; others may be less stable",
        "start": "the one that point-like, heavily damped balls reach from their start angles",
        "worst": f"the least stable of {judgement.arrangements} that represent all, the evenly spread one among them",
    }[way]
    if way == "worst" and judgement.multipliers is not None and judgement.state == "balanced":
        phrase = f"the least stable that a search found, {judgement.arrangements} of them compared"
    if way == "worst" and judgement.state == "race still":
        phrase = "the one with even gaps; others are not known if the spindle moves"
    yield (
        f"{most} balls of a race can balance in many arrangements. The verdict is for {phrase}. Neutral motions from "
        "one to another do not count."
    )
    if way == "worst" and (
        sum(count > 2 for count in counts) > 1 or any(len(set(r.ball_masses)) > 1 for r in scene.races)
    ):
        yield (
            "Not all arrangements are compared: several races change together, from even to less even, and unequal "
            "balls keep the order of the file."
        )
