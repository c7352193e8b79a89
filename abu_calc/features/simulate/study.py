"""One scene integrated: amplitude, level, quiet and rest time, final places of the balls, and how sure that is.

`SampledMotion` holds the motion of a scene at equally spaced times.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field, replace
from typing import TYPE_CHECKING, Annotated, ClassVar, Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.effect import ACROSS
from abu_calc.dynamics.integrators.choice import WANTED, refuse_removed
from abu_calc.dynamics.integrators.run import TooMuchWorkError
from abu_calc.dynamics.scene import Scene
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.errors import ChaoticError, InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.quantity import Quantity, record
from abu_calc.foundation.rows import Columns
from abu_calc.foundation.units import from_si, in_units
from abu_calc.foundation.validity import Range
from abu_calc.inputs.read_machine import Machine
from abu_calc.registry import imported
from abu_calc.simulation.arguments import checked, one_of
from abu_calc.simulation.ensemble import followed_until
from abu_calc.simulation.predicted_level import compared_starts, starts_for_measurement
from abu_calc.simulation.records import SceneModel, SimulatedScene, in_words
from abu_calc.simulation.response import Response, settling_count
from abu_calc.simulation.result import Result
from abu_calc.simulation.rotor_view import RotorView
from abu_calc.simulation.run_checks import SimulatedLevel, level_at, levels_at_places, loudest, one_run_checks
from abu_calc.simulation.scene_of_design import QUIET
from abu_calc.simulation.simulate import ACCURACY, Simulation
from abu_calc.simulation.start_cases import idle_speed
from abu_calc.simulation.subject import Audit, Source, Subject, simulate_chosen, subject_of
from abu_calc.simulation.subject import audit as with_all_effects
from abu_calc.simulation.vibration_records import MeasuredAfterRecord, measured_place

if TYPE_CHECKING:
    from xarray import Dataset

Array = NDArray[np.float64]


SAMPLES: Final = Range("number of samples", 2, 1_000_000, remedy="ask for a number in this range", key="samples")

MOST_NUMBERS: Final = 2**25
"""Samples times states that are held: 256 MB."""


@dataclass(frozen=True, eq=False)
class SampledMotion(Columns):
    """Axis and balls over time; ball angles in the rotor, a row for each ball, not wrapped.

    `further`: what else of the scene moves, by names with units: tilts, the axis at the bearings, the arm's angle, the
    balls' places along the spindle from the middle of their race, the rotor's speed against what carries it.
    """

    t_s: Array
    x_mm: Array
    y_mm: Array
    ball_angles_deg: Array
    further: Mapping[str, Array] = field(default_factory=dict)

    @classmethod
    def of(cls, run: Simulation, times: NDArray[np.float64]) -> Self:
        """Motion of a run, sampled at these times."""
        scene, states = run.scene, run.trajectory.at(times)
        size, balls = len(scene.support.names), len(scene.ball_masses)
        x, y = scene.axis_place(states)
        angles = states[2 * size : 2 * size + balls]
        axis_and_balls = in_units({"x_mm": x, "y_mm": y, "ball_angles_deg": angles})
        return cls(t_s=times, **axis_and_balls, further=in_units(dict(_further(scene, times, states))))

    @property
    def columns(self) -> dict[str, Array]:
        """All of it, by names with units."""
        angles = {f"ball{k}_deg": row for k, row in enumerate(self.ball_angles_deg, 1)}
        return {"t_s": self.t_s, "x_mm": self.x_mm, "y_mm": self.y_mm, **angles, **self.further}

    def to_xarray(self) -> "Dataset":
        """An xarray.Dataset over `t_s`, ball angles over `ball` as well. Raises OutputError if xarray is missing."""
        from abu_calc.foundation.arrays import dataset

        balls = np.arange(1, len(self.ball_angles_deg) + 1)
        further = {
            name: (("t_s",), values) for name, values in {"x_mm": self.x_mm, "y_mm": self.y_mm, **self.further}.items()
        }
        angles = {"ball_angles_deg": (("ball", "t_s"), self.ball_angles_deg)} if len(balls) else {}
        return dataset({"t_s": self.t_s, "ball": balls}, {**further, **angles}, {"ball_angles_deg": "°"})

    def __repr__(self) -> str:
        return f"<SampledMotion {len(self.t_s)} × {', '.join(self.columns)}>"


def _further(scene: Scene, times: Array, states: Array) -> Iterator[tuple[str, Array]]:
    """Columns of a scene beside axis and balls, in SI by names with the units that they get."""
    support, balls, q = scene.support, len(scene.ball_masses), states[: len(scene.support.names)]
    tilt, turned = support.tilt(q), support.turned(q)
    if tilt is not None:
        about_y, about_minus_x = map(np.asarray, tilt)
        yield from (("tilt_x_mrad", 0.0 - about_minus_x), ("tilt_y_mrad", about_y))
    for k, place in enumerate(support.bearings, 1):
        x, y = scene.axis_place(states, place)
        yield from ((f"bearing{k}_x_mm", x), (f"bearing{k}_y_mm", y))
    if turned is not None:
        yield "arm_angle_mrad", np.asarray(turned)
    if ACROSS in scene.ball_states:
        first = 2 * (len(q) + balls) + scene.ball_states.index(ACROSS) * balls
        for k in range(balls):
            yield f"ball{k + 1}_axial_mm", states[first + k]
    if scene.rotor.states:
        yield "rotor_speed_rpm", scene.rotor.turning(times, states, scene.speed)[1]


def equally_spaced(scene: Scene, samples: int | None) -> NDArray[np.float64]:
    """Times [s] of a run, equally spaced, both ends included; none if none are asked for."""
    if samples is None:
        return np.empty(0)
    fitting = MOST_NUMBERS // (1000 * scene.state_count) * 1000
    replace(SAMPLES, high=min(SAMPLES.high, fitting)).check(samples)
    return np.linspace(0.0, scene.duration, samples)


EVALUATIONS: Final = Range("most evaluations", 1, 10**12, key="most_evaluations")


@record
class SimulateResult(SimulatedScene, Result):
    """One scene that was simulated; beside what is printed, how it moved."""

    command: ClassVar[str] = "simulate"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"description", "start", "motion", "view", "run"}
    optional: ClassVar[frozenset[str]] = SimulatedScene.optional | {"handles", "measured_after"}

    model: SceneModel
    level_at: Annotated[str, Quantity("place of the level")]
    """Place on the axis at which `level_db` holds."""
    handles: tuple[SimulatedLevel, ...] | None
    """Levels where a machine is held, background included; None for what has no places to hold."""
    measured_after: MeasuredAfterRecord | None
    """Measurement of an idling machine, beside the result of this run."""
    description: str
    """Support, races and balls, in a sentence."""
    start: str
    """Start case in words."""
    motion: SampledMotion | None = field(compare=False, repr=False)
    """Axis and balls at the times asked for; None where none were."""
    view: RotorView | None = field(compare=False, repr=False)
    """The way from start to rest, thinned; of too long a run its beginning."""
    run: Simulation = field(compare=False, repr=False)
    """The run itself, in SI: scene, response, trajectory with all its states."""

    def to_xarray(self) -> "Dataset":
        """The motion as an xarray.Dataset. Raises InputError if `simulate` was asked for no samples."""
        if self.motion is None:
            raise InputError(
                "no motion was kept", place=Place(key="samples"), remedy="Call simulate with samples=2000, for example."
            )
        return self.motion.to_xarray()


@checked
def simulate(
    source: Source,
    scene: str | None = None,
    start: str | None = None,
    *,
    race_centre_deg: float | None = None,
    accuracy: float = 0.01,
    duration_s: float | None = None,
    with_effects: Sequence[str] = (),
    without_effects: Sequence[str] = (),
    integrator: str = "auto",
    audit: bool = False,
    samples: int | None = None,
    most_evaluations: int | None = None,
    progress: Progress = silent,
) -> SimulateResult:
    """Integrate one scene to `accuracy`: of amplitude and times relative, of ball angles in rad.

    `scene` and `start` choose among those of a machine (idle; balls bunched), `race_centre_deg` the side to which its
    race is off (180 from the imbalance). The effects there is data for are in as
    far as their weights ask for it, and as `with_effects` and `without_effects` say; with `audit` all of them once
    more. `samples`: equally spaced times to keep the motion at. `most_evaluations` bounds the work, see WORK: by
    counting before it begins, and while it goes on. Raises InputError for what is wrong in file or arguments,
    NotTrustworthyError where the accuracy is not reached, or not within that work.
    """
    ACCURACY.check(accuracy)
    EVALUATIONS.check(1 if most_evaluations is None else most_evaluations)
    refuse_removed(integrator)
    one_of("integrator", integrator, WANTED)
    if isinstance(source, Machine) and source.spindle is not None:
        two: Subject = imported("spindle.start_cases:spindle_subject")(source, scene, start, race_centre_deg)
        subject = two.lasting(duration_s)
    else:
        subject = subject_of(source, scene, start, race_centre_deg=race_centre_deg).lasting(duration_s)
    times = equally_spaced(subject.scene, samples)
    ledger = subject.ledger(accuracy, with_effects, without_effects)
    try:
        ledger, run = simulate_chosen(ledger, accuracy, times, most_evaluations, integrator, progress)
        longest = _followed_until(subject, run) if duration_s is None else None
        while longest is not None:
            subject = subject.lasting(longest)
            times = equally_spaced(subject.scene, samples)
            ledger = subject.ledger(accuracy, with_effects, without_effects)
            ledger, run = simulate_chosen(ledger, accuracy, times, most_evaluations, integrator, progress)
            longest = _followed_until(subject, run)
        audited = None
        if audit:
            audited = with_all_effects(subject.scene, ledger, run, accuracy, most_evaluations, integrator, progress)
    except ChaoticError as error:
        if error.ended is None:
            raise
        run, audited = error.ended, None
    except TooMuchWorkError as error:
        raise TooMuchWorkError(f"{error}; or allow more: --most-evaluations, Python: most_evaluations=") from None
    checks = (
        *_limits(subject, run, ledger.spared, duration_s),
        _reached(run, ledger.spared, accuracy),
        *((_left_out(audited, accuracy),) if audited else ()),
    )
    return SimulateResult(
        **vars(SimulatedScene.of(run, ledger, audit=audited)),
        title=subject.title,
        checks=checks,
        warnings=(*subject.warnings, *_at_rated_speed(subject), *run.warnings),
        model=SceneModel.of(run.scene),
        level_at=_level_at(subject, run.response),
        handles=None if subject.design is None else levels_at_places(subject.design, run.response) or None,
        measured_after=_measured(subject, run.response, progress),
        provenance=subject.provenance,
        description=in_words(run.scene),
        start=subject.start,
        motion=SampledMotion.of(run, times) if len(times) else None,
        view=_view(subject, run),
        run=run,
    )


def _followed_until(subject: Subject, run: Simulation) -> float | None:
    """Time [s] until which a machine's idle scene is followed whose balls are not at rest at its end, as in `size`."""
    whole = len(run.trajectory.t) > settling_count(run.scene)
    if subject.design is None or subject.scene.name not in QUIET or run.rung != "equations" or not whole:
        return None
    return followed_until(subject.design, run.scene, run.response, run.trajectory)


def _at_rated_speed(subject: Subject) -> tuple[str, ...]:
    """A warning where the idle scene turns at the rated speed and the machine's motor idles at another."""
    design = subject.design
    if design is None or subject.scene.name != "idle" or (idle := idle_speed(design.case)) is None:
        return ()
    rated, idling = (from_si(speed, "rpm") for speed in (design.case.speed, idle))
    needed = "" if design.case.table.run_up else "add [run_up]: "
    return (
        f"The motor idles at {idling:.0f} rpm; this scene turns at machine.speed_rpm = {rated:.6g}. For the motion at "
        f"the idle speed {needed}`--scene run-up` lets the motor bring the machine there. `abu size FILE` judges both.",
    )


def _view(subject: Subject, run: Simulation) -> RotorView | None:
    """View of a run, with the levels that the limits of a machine's file are for."""
    if subject.design is None:
        return RotorView.of(run.scene, run.trajectory)
    return RotorView.of(run.scene, run.trajectory, loudest(subject.design, run.response))


def _limits(subject: Subject, run: Simulation, spared: float, duration_s: float | None) -> tuple[Check, ...]:
    """The limits of a machine's file; a scene given outright has none."""
    if subject.design is None:
        return ()
    error = run.error_estimate + spared
    return one_run_checks(subject.design, run.response, subject.start, error, asked=duration_s is not None)


def _level_at(subject: Subject, response: Response) -> str:
    """The place on the axis whose motion the response is about, in words."""
    if subject.design is not None and subject.design.case.body.in_space:
        return "race, forward whirl"
    if subject.design is not None:
        return "race plane" if subject.design.case.race_offset else "wheel plane"
    if response.final.arm_angle is not None:
        return "end of the arm"
    return "axis" if response.final.tilt_x is None else "axis, centre of mass"


def _measured(subject: Subject, response: Response, progress: Progress) -> MeasuredAfterRecord | None:
    """[measured_after] of a machine against the median of the start cases, with the level of this run at its place."""
    design = subject.design
    if design is None or response.scene not in ("idle", "grinding"):
        return None
    table = design.case.table.measured_after
    if table is None or table.shown is None:
        return None
    level = level_at(design, response, measured_place(design.case, table.shown)[1])
    levels = (None, level) if response.scene == "idle" else (level, None)
    return compared_starts(design, starts_for_measurement(design, progress), *levels)


def _reached(run: Simulation, spared: float, accuracy: float) -> Check:
    message = "two runs, a decade of tolerance apart, agree in amplitude, times and ball angles"
    if run.rung == "envelope":
        message = "averages of two orders, and what both leave out, agree in amplitude, times and ball angles"
    message += f"; the effects left out change these by at most {spared:.2g}" if spared else ""
    error = run.error_estimate + spared
    if error <= accuracy:
        return coded("ABU801", "pass", message, error, accuracy)
    message = "the motion is chaotic: no two runs agree, but in all of them the balls come to rest and balance"
    remedy = "What makes it calm: see the warnings. A shorter run, or other places of the balls."
    return coded("ABU801", "fail", message, error if math.isfinite(error) else None, accuracy, remedy)


def _left_out(audited: Audit, accuracy: float) -> Check:
    message = "with every effect in, amplitude, times and ball angles differ by no more than the accuracy"
    remedy = "Ask for more accuracy, or take effects in: --with EFFECT, Python: with_effects=."
    held = audited.difference <= accuracy
    return coded("ABU803", verdict(held), message, audited.difference, accuracy, None if held else remedy)
