"""Verdict on a machine at its workpiece, in words: whether the autobalancer helps, why, and which changes help.

Parts of the result of `abu grinding`, in user units.
"""

import cmath
import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.grinding.outcomes import GrindingOutcomes
from abu_calc.features.grinding.start_cases import WHEN
from abu_calc.features.grinding.steady_contact import RestingBalls, SteadyWork
from abu_calc.features.grinding.work import LOUDER, Side, TriedRemedy, Work
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import from_si, shown, wrapped_deg
from abu_calc.reporting.blocks import capitalised


def in_words(work: Work, tried: Sequence[TriedRemedy], loads: GrindingOutcomes | None = None) -> str:
    """A sentence or two; the level first, then the start cases that are louder than the usual case."""
    before, after = work.levels.before, work.levels.after
    if work.lowered is None or before is None or after is None:
        return f"It is not known whether the autobalancer helps under load: {_unknown(work)}.{changes(tried)}"
    levels = f"{_level(after, work.fitted)} dB with it, {_level(before, work.without)} dB without"
    if work.lowered:
        haste = "" if work.always else f" {_haste(work)}"
        starts = starts_in_words(work, loads)
        every = work.always and (loads is None or not (loads.louder("settled") or loads.louder("at once")))
        prevents = "" if every else changes(tried) or NOTHING
        helps = f"The autobalancer helps under load: {levels}."
        if loads is not None and (louder := loads.louder("settled")):
            helps = (
                f"The autobalancer helps under load, but not in {len(louder)} of {loads.count('settled')} start cases: "
                f"{levels}, up to {louder[-1].level:.1f} dB in these."
            )
        return f"{helps} {_helps(work)}{haste}{starts}{prevents}"
    return f"The autobalancer makes the loaded machine LOUDER: {levels}. {_worse(work)}{changes(tried) or NOTHING}"


def starts_in_words(work: Work, loads: GrindingOutcomes | None) -> str:
    """The loudest motion of the start cases and its share, if it is louder than the usual case by more than 1 dB."""
    loudest = None if loads is None else loads.loudest
    if (
        loads is None
        or loudest is None
        or loads.louder("settled")
        or loudest.highest <= (work.levels.after or math.inf) + LOUDER
    ):
        return ""
    when, hasty = WHEN[loudest.pressed], work.level_at_once or -math.inf
    if not work.always and loudest.pressed == "at once" and abs(loudest.highest - hasty) <= LOUDER:
        return (
            f" So {'does' if loudest.count == 1 else 'do'} {loudest.count} of {loudest.total} start cases pressed then."
        )
    cases, ends = (
        f"{loudest.count} of {loudest.total} start cases pressed {when}",
        "ends" if loudest.count == 1 else "end",
    )
    return f" {cases} {ends} {loudest.state}, at up to {loudest.highest:.1f} dB."


def _level(value: float, side: Side) -> str:
    """Level in words, with the scatter of chaotic runs."""
    return f"{value:.1f} ± {max(side.scatter, 0.1):.1f}" if side.scatter else f"{value:.1f}"


NOTHING = " No smaller runout, softer contact or larger normal force was found that changes this."


def changes(tried: Sequence[TriedRemedy]) -> str:
    """Sentence on the changes that help, with the level of each; empty without any."""
    if not tried:
        return ""
    texts = (f"{capitalised(_remedy(remedy))}: {_short(remedy)}." for remedy in tried)
    first = "This change prevents" if len(tried) == 1 else f"Each of {len(tried)} changes prevents"
    return f" {first} that in all simulated cases. {' '.join(texts)}"


def _short(remedy: TriedRemedy) -> str:
    """Loudest level with the change beside the level without autobalancer."""
    after, before = remedy.level_after_db, remedy.level_before_db
    known = "not known" if after is None else f"{after:.1f} dB at most"
    return known + ("" if before is None else f", {before:.1f} dB without")


def _levels(remedy: TriedRemedy) -> str:
    """Loudest level with the change, and the level without autobalancer beside it."""
    after, before = remedy.level_after_db, remedy.level_before_db
    known = "not known" if after is None else f"{after:.1f} dB"
    return f"loudest case {known}" + ("" if before is None else f", without autobalancer {before:.1f} dB")


def shortest(tried: Sequence[TriedRemedy]) -> str | None:
    """The first remedy alone."""
    if not tried:
        return None
    text = _remedy(tried[0])
    return f"{capitalised(text)}: {_levels(tried[0])} (simulated)."


def _remedy(remedy: TriedRemedy) -> str:
    if remedy.runout is not None:
        return f"reduce wheel.runout_mm to {remedy.runout_mm:g}"
    if remedy.contact_stiffness is not None:
        return f"reduce grinding.contact_stiffness_N_per_m to {_plain(remedy.contact_stiffness)}"
    return f"raise grinding.press_force_N to {remedy.press_force:g}"


def _haste(work: Work) -> str:
    """Sentence on a start case with the balls on the heavy side."""
    start, level, run = "pressed before the balls have settled", work.level_at_once, work.at_once.run
    if level is None:
        return f"{capitalised(start)}: not known, {work.at_once.failure or NO_METHOD}."
    level_text = _level(level, work.at_once)
    if work.stays_loud and run is not None:
        return f"But {start}, wheel and workpiece keep bouncing at {level_text} dB, still after {run.duration:.2g} s."
    return f"But {start}, {'they bounce at' if work.at_once.parts else 'the level is'} {level_text} dB."


def _helps(work: Work) -> str:
    contact, case = work.design.case.contact, work.design.case
    if contact is None or contact.contact == "face":
        return "A face does not press in the plane of the balls, so they settle as at idle."
    balls = work.fitted.steady.balls
    if balls is not None and balls.places == "short":
        return f"But the {_capacity(work, balls)}."
    if balls is None or balls.places != "balanced":
        return "But the balls do not stay where they would balance (ABU423)."
    if not case.runout:
        return "The wheel runs true: only its imbalance moves the machine."
    amplitude = work.fitted.steady.amplitude or 0.0
    share = f"the spindle follows {_um(amplitude)} of the {_um(case.runout)} of runout"
    if work.fitted.parts:
        return "The balls balance the wheel, though it loses contact with the workpiece now and then."
    return f"The balls balance the wheel, and {share}."


def _capacity(work: Work, balls: RestingBalls) -> str:
    capacities = work.design.autobalancer.capacity, abs(balls.needed)
    carried, needed = (shown(each, "g_mm", ".0f") for each in capacities)
    return f"capacity is {carried} of the {needed} that the workpiece requires"


def _worse(work: Work) -> str:
    case, steady = work.design.case, work.fitted.steady
    balls = steady.balls
    moved = work.design.imbalance.value / case.body.effective_mass()
    runout = f"ε = {_um(case.runout)} {'exceeds' if case.runout > moved else 'against'} m₀e/M = {_um(moved)}"
    if balls is not None and balls.places in ("gathered", "turning"):
        return f"At this contact stiffness balls gather where they add to the imbalance; {runout}."
    if balls is not None and balls.places == "restless":
        return f"The balls do not stay where they would balance (ABU423); {runout}."
    if balls is not None and balls.places == "short":
        return f"The {_capacity(work, balls)}; {runout}."
    if work.fitted.parts and case.contact is not None:
        force = abs(steady.reaction or 0.0)
        return (f"The machine follows the wheel's runout ({runout}). The normal force, {case.contact.press_force:g} ± "
                f"{force:.0f} N, falls to zero: wheel and workpiece lose contact and bounce.")  # fmt: skip
    if work.rest > (work.without.steady.amplitude or 0.0):
        bare = _um(work.without.steady.amplitude or 0.0)
        return f"The wheel alone moves the machine by {bare} only; race and friction leave {_um(work.rest)}."
    return f"The machine follows the wheel's runout: {runout}."


def _unknown(work: Work) -> str:
    before, after = work.levels.before, work.levels.after
    if before is not None and after is not None:
        return (f"{_level(after, work.fitted)} dB with it and {_level(before, work.without)} dB without differ by less "
                "than runs of chaotic bouncing do")  # fmt: skip
    case, failures = work.design.case, [side.failure for side in (work.without, work.fitted) if side.failure]
    if failures:
        return f"no simulation can be trusted, {failures[0]}"
    rigid = case.contact is not None and case.contact.contact == "rigid"
    if rigid and case.contact is not None:
        sides = {"without the autobalancer": work.without, "with it": work.fitted}
        pulls = " and ".join(f"{abs(side.steady.reaction or 0):.0f} N {name}" for name, side in sides.items()
                             if side.parts)  # fmt: skip
        return (f"a rigid contact would have to pull: the force varies by {pulls}, and the normal force is "
                f"{case.contact.press_force:g} N")  # fmt: skip
    return NO_METHOD


NO_METHOD = "no method of calculation is valid"


def _um(length: float) -> str:
    return shown(length, "um")


def _plain(stiffness: float) -> str:
    """
    >>> _plain(4.5e5), _plain(1.2e6)
    ('4.5e5', '1.2e6')
    """
    return f"{stiffness:.2g}".replace("e+0", "e")


SIDES: Final = 60
"""Sides of the polygon that stands for an ellipse."""


@record
class AxisMotion(Record):
    """Amplitudes of the axis; None where balls come to no rest."""

    x_amplitude: Annotated[float | None, Quantity("along the work", "|X|", unit="mm")]
    y_amplitude: Annotated[float | None, Quantity("normal to the work", "|Y|", unit="mm")]

    @classmethod
    def of(cls, axis: tuple[complex, complex] | None) -> Self:
        """Amplitudes of a motion given by its phasors."""
        x, y = (None, None) if axis is None else map(abs, axis)
        return cls(x_amplitude=x, y_amplitude=y)

    @property
    def largest(self) -> float | None:
        """The larger of both."""
        return max((each for each in (self.x_amplitude, self.y_amplitude) if each is not None), default=None)


@dataclass(frozen=True, eq=False)
class Orbit:
    """Orbit of the axis over one turn: points from its mean place [µm].

    x is along the workpiece, y away from it. `name` says with which balls. `simulated`: with every effect that
    counts, else as if wheel and workpiece never lost contact.
    """

    name: str
    simulated: bool
    points_um: tuple[tuple[float, float], ...]

    @classmethod
    def steady(cls, name: str, steady: SteadyWork) -> Self | None:
        """The ellipse of phasors; None where balls come to no rest."""
        if steady.axis is None:
            return None
        turn = np.exp(2j * np.pi * np.arange(SIDES + 1) / SIDES)
        return cls.through(name, np.array([(phasor * turn).real for phasor in steady.axis]), simulated=False)

    @classmethod
    def through(cls, name: str, path: NDArray[np.float64], *, simulated: bool = True) -> Self:
        """Orbit through places x, y [m]."""
        points = (from_si(1.0, "um") * path).T.tolist()
        return cls(name, simulated, tuple((x, y) for x, y in points))


@record
class Printed(Record):
    """Demand on the balls by the source's formula as published, its places of two, and its error here."""

    resultant: Annotated[float, Quantity("imbalance of the balls, printed formula", "|V|", unit="g_mm")]
    resultant_angle_deg: Annotated[float, Quantity("its angle", "arg V")]
    ball_angles_deg: Annotated[tuple[float, float] | None, Quantity("balls by the printed formula", "θ", 5)]
    error_deg: Annotated[float | None, Quantity("the printed formula is off by")]
    open: Annotated[float | None, Quantity("imbalance it would leave of what is to be carried", unit="g_mm")]


@record
class Simulated(Record):
    """The end of a run with every effect that counts."""

    x_amplitude: Annotated[float, Quantity("along the work, from the mean place", unit="mm")]
    y_amplitude: Annotated[float, Quantity("normal to the work", unit="mm")]
    velocity_rms: Annotated[float, Quantity("velocity, rms", unit="mm_per_s")]
    imbalance: Annotated[float, Quantity("imbalance of wheel and balls", unit="g_mm")]
    force_amplitude: Annotated[float | None, Quantity("variable force, once per turn", unit="N")]
    largest_force: Annotated[float | None, Quantity("largest force", unit="N")]
    apart: Annotated[float, Quantity("share of the time apart", "", 3, "", percent=True)]
    hardest_at_deg: Annotated[float | None, Quantity("pressed hardest, from the imbalance")]
    ball_angles_deg: Annotated[tuple[float, ...], Quantity("balls end at", "θ", 5)]
    duration: Annotated[float, Quantity("duration of the run", unit="s")]
    scatter_db: Annotated[float, Quantity("level known to", "±", 2, "0 unless it is the mean of chaotic runs")]

    @classmethod
    def of(cls, side: Side) -> Self | None:
        """None without a run."""
        if (run := side.run) is None:
            return None
        presses = len(run.force) > 0
        return cls(
            x_amplitude=run.x,
            y_amplitude=run.y,
            velocity_rms=run.velocity,
            imbalance=abs(run.imbalance),
            force_amplitude=abs(run.reaction) if presses else None,
            largest_force=float(run.force.max()) if presses else None,
            apart=run.apart,
            hardest_at_deg=wrapped_deg(cmath.phase(run.pressure)) if presses and run.reaction else None,
            ball_angles_deg=tuple(map(wrapped_deg, run.ball_angles)),
            duration=run.duration,
            scatter_db=run.scatter,
        )


@record
class ProfilePoint(Record):
    """Force on a point of the wheel, from its imbalance: with and without autobalancer, as if never parting; and as
    simulated, where that was done.
    """

    wheel_angle: Annotated[float, Quantity("point of the wheel", "ψ", unit="deg")]
    with_: Annotated[float | None, Quantity("force with the autobalancer", "N", unit="N")]
    without: Annotated[float | None, Quantity("force without", "N", unit="N")]
    simulated: Annotated[float | None, Quantity("simulated with", "N", unit="N")]
    simulated_without: Annotated[float | None, Quantity("simulated without", "N", unit="N")]

    @classmethod
    def round(
        cls, press: float, free: SteadyWork, bare: SteadyWork, run: Mapping[float, float], alone: Mapping[float, float]
    ) -> tuple["ProfilePoint", ...]:
        """Force profile round the wheel, in 24 points; simulated values are those of the nearest angle."""
        angles = [2 * math.pi * step / 24 for step in range(24)]

        def steady(state: SteadyWork, angle: float) -> float | None:
            """Force [N] at a place of the wheel [rad]: N₀ + Re(N e^{−iα})."""
            return None if state.pressure is None else press + (state.pressure * cmath.exp(-1j * angle)).real

        return tuple(
            cls(wheel_angle=angle, with_=steady(free, angle), without=steady(bare, angle),
                simulated=_nearest(run, angle), simulated_without=_nearest(alone, angle))
            for angle in angles
        )  # fmt: skip


def _nearest(forces: Mapping[float, float], angle: float) -> float | None:
    if not forces:
        return None
    return forces[min(forces, key=lambda sample_angle: abs(math.remainder(sample_angle - angle, 2 * math.pi)))]
