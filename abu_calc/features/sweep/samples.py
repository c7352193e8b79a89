"""Samples of a sweep, each from its number: values put in, the machine built or designed, and run.

Time limit of a sample: work that takes too long is given up, in any thread and on any system.
"""

import cmath
import ctypes
import faulthandler
import math
import os
import sys
import threading
import time
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import field, replace
from typing import Any, ClassVar, Final

import numpy as np

from abu_calc.dynamics.integrators.run import MOST_EVALUATIONS
from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.features.design.study import size
from abu_calc.features.spindle.case import SpindleCase, SpindleDesign
from abu_calc.features.spindle.start_cases import FIRST_TOLERANCE, race_centre, race_needs, start_of, start_once
from abu_calc.features.sweep.batches import FLAGS, IMPATIENT, OUTSIDE, OVERTIME, QUANTITIES, Row, What, drag_ratio
from abu_calc.features.sweep.sensitivity import Sample
from abu_calc.formulas.tilting_rotor import eccentricity_resultants
from abu_calc.foundation import patience
from abu_calc.foundation.errors import AbuError, NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.parallel import importing, raise_pending
from abu_calc.foundation.units import from_si, to_si
from abu_calc.inputs.bearing_file import Limits
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.variation import Variants, in_all_races
from abu_calc.simulation.ensemble import MORE, TOLERANCE, WORK, first_tolerance, integrated, run_of_start
from abu_calc.simulation.response import Response, evaluate, needed_times
from abu_calc.simulation.run_checks import HALF, allowed_imbalance, allowed_of_scene, balances, slip
from abu_calc.simulation.scene_file import SceneFile
from abu_calc.simulation.scene_of_design import AHEAD
from abu_calc.simulation.scene_of_file import scene_from
from abu_calc.simulation.start_cases import (
    OPPOSITE,
    Lost,
    Member,
    StartOutcome,
    Variation,
    idle_speed,
    turned,
    usual_run_up,
)
from abu_calc.sizing.design import Design, built, with_worst
from abu_calc.sizing.oil import drag_share

GRACE: Final = 5.0
"""Seconds after which a process whose work does not give up is ended, where it may be."""
AGAIN_S: Final = 0.5
"""Seconds after which it is raised again: what runs for the garbage collector swallows whatever is raised in it."""
IMPORTS_S: Final = 0.05
"""Seconds between two looks at a thread that imports: a module whose import is broken off is broken for good."""


class Overtime(BaseException):
    """The time is over."""

    comes_again = True


@contextmanager
def limited(seconds: float, *, may_end_process: bool = False) -> Iterator[None]:
    """Raise Overtime inside once the time is over, as soon as Python code runs there that is no import.

    `may_end_process`: what never returns to Python takes the process with it; only for processes that were made to
    compute, whose owner notices.
    """
    thread, lock, inside = threading.get_ident(), threading.Lock(), True

    def stop() -> None:
        """Raise Overtime in the thread until it leaves, but in no import."""
        while True:
            with lock:
                if not inside:
                    return
                raised = not importing(sys._current_frames().get(thread))
                if raised:
                    _raise_in(thread, Overtime)
            time.sleep(AGAIN_S if raised else IMPORTS_S)

    timer = threading.Timer(seconds, stop)
    timer.daemon = True
    try:
        timer.start()
    except RuntimeError as error:  # no room for another thread
        raise OSError(str(error)) from None
    if may_end_process:
        _end_at(thread, time.monotonic() + seconds + GRACE)
    try:
        yield
    finally:
        timer.cancel()
        with lock:
            inside = False
        _raise_in(thread, None)  # one that was raised, but did not arrive in time
        if may_end_process:
            _end_at(thread, None)


_ends: dict[int, float] = {}
_ending: Final = threading.Lock()


def _end_at(thread: int, when: float | None) -> None:
    """The process ends at the first of what its threads ask for: faulthandler has one clock for all of them."""
    with _ending:
        if when is None:
            _ends.pop(thread, None)
        else:
            _ends[thread] = when
        if _ends:
            left = max(min(_ends.values()) - time.monotonic(), 1e-3)
            faulthandler.dump_traceback_later(left, exit=True, file=_nowhere())
        else:
            faulthandler.cancel_dump_traceback_later()


def _raise_in(thread: int, kind: type[BaseException] | None) -> None:
    raised = ctypes.py_object(kind) if kind else None
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), raised)


_open: list[int] = []


def _nowhere() -> int:
    """A file that swallows what is written."""
    if not _open:
        _open.append(os.open(os.devnull, os.O_WRONLY))
    return _open[0]


LOT: Final = 0.5e-6
"""Diameters of balls of one lot differ by this much [m] (grade 20 of ISO 3290, by practice)."""

USUAL: Final = 0.01
"""Accuracy at which the run of a sample has the tolerance of the first run of a start case."""

Values = Mapping[str, Any]


@dataclass(frozen=True)
class SweepStudy(ABC):
    """Variation of the samples, and the numbers computed of each.

    A study is sent to workers: it is small, and made of plain data.
    """

    what: ClassVar[What]

    sample: Sample
    accuracy: float
    time_limit: float
    until: float = field(default=math.inf, kw_only=True)
    """Time [s since 1970] at which the patience with the whole sweep is over, also on other computers."""

    @abstractmethod
    def numbers(self, values: Values, seed: int) -> tuple[float | None, ...]:
        """The quantities of a member, then what it meets. Raises AbuError where there are none."""

    def rows(self, members: tuple[int, ...], may_end_process: bool = False) -> tuple[list[Row], float]:
        """Rows of the samples' results, and the time for all [s]."""
        begun = time.perf_counter()
        rows = [self._row(member, may_end_process) for member in members]
        return rows, time.perf_counter() - begun

    def lost(self, member: int, reason: str) -> Row:
        """The row of one that gave no numbers."""
        given = self.sample.values(member)
        width = len(QUANTITIES[self.what]) + len(FLAGS[self.what])
        return (member, self.sample.member_seed(member), *map(_plain, given), *(None,) * width, reason)

    def _row(self, member: int, may_end_process: bool) -> Row:
        values, seed = self.sample.values(member), self.sample.member_seed(member)
        named = {factor.key: value for factor, value in zip(self.sample.factors, values, strict=True)}
        left = self.until - time.time()
        if left <= 0:
            return self.lost(member, IMPATIENT)
        try:
            # The wall of seconds would take the place of counts of work, and a member must not depend on it.
            with patience.aside(), limited(min(self.time_limit, left), may_end_process=may_end_process):
                numbers = self.numbers(named, seed)
        except Overtime:
            if left < self.time_limit:
                return self.lost(member, IMPATIENT)
            return self.lost(member, f"{OVERTIME}{self.time_limit:g} s")
        except ImportError:  # of all members, and of this computer: no result of any
            raise_pending()
            raise
        except Exception as error:  # one member must not end the others
            raise_pending()
            if isinstance(error, AbuError):
                return self.lost(member, _line(str(error)))
            outside = OUTSIDE if isinstance(error, (OSError, MemoryError)) else ""
            return self.lost(member, _line(f"{outside}{type(error).__name__}: {error}"))
        return (member, seed, *map(_plain, values), *map(_finite, numbers), None)

    def _in_file(self, values: Values) -> dict[Any, object]:
        """Values that are entries of the file, by path."""
        return {factor.path: values[factor.key] for factor in self.sample.factors if factor.path}


@dataclass(frozen=True)
class Builds(SweepStudy):
    """The design is fixed: each member is one machine built and switched on once."""

    what: ClassVar[What] = "build"

    variants: Variants[MachineFile]
    design: Design

    def numbers(self, values: Values, seed: int) -> tuple[float | None, ...]:
        """One start of one machine."""
        made = built(self.design, self.variants.table(self._in_file(values)))
        lot = np.random.default_rng(seed).uniform(-LOT, LOT, made.autobalancer.ball_count)
        masses = tuple((1 + 3 * lot / made.autobalancer.ball_diameter).tolist())
        outcome = machine_started(made, started(made, values, masses), self.accuracy)
        return numbers_of(outcome, made.case.table.limits, made.autobalancer.capacity_ratio)


def started(design: Design, values: Values, masses: tuple[float, ...]) -> Member:
    """The start case of a sample; values that do not vary are usual. `masses`: factors on those of the balls."""
    kind, warm = values.get("start.kind"), values.get("start.temperature_C")
    angle, side = _angle(values, "start.angle_deg"), _angle(values, "start.eccentricity_deg")
    case, drag = design.case, design.case.drag
    if warm is not None:
        drag *= drag_ratio(warm) if case.oil is None else drag_share(case, design.autobalancer, warm)
    usual = usual_run_up(design) if kind == "run-up" else Member(kind or "bunched", drag, speed=idle_speed(case))
    turned_by, eccentricity = 0.0 if angle is None else angle - AHEAD, OPPOSITE if side is None else side
    return replace(
        usual, drag=drag, eccentricity=eccentricity, turned=turned_by, varied=Variation(ball_masses=masses)
    )  # fmt: skip


def _angle(values: Values, key: str) -> float | None:
    """An angle of a sample [rad]; None if it does not vary."""
    angle = values.get(key)
    return None if angle is None else to_si(angle, "deg")


def machine_started(design: Design, member: Member, accuracy: float) -> StartOutcome:
    """One start of one machine, run as `abu size` does, but to its end. Raises NotTrustworthyError.

    A run that ends early has the times of the whole run, but not its amplitude at the end.
    """
    outcome = run_of_start(design, member, accuracy, first_tolerance(design) * accuracy / USUAL, MORE * WORK).outcome
    if outcome.balanced or outcome.hanging or outcome.imbalance > HALF * outcome.moved:
        return outcome
    # Only where it decides: the worst arrangement of balls that friction holds takes longer than all the rest.
    return replace(outcome, allowed=allowed_imbalance(with_worst(design), outcome.moved))


def numbers_of(outcome: StartOutcome, limits: Limits, capacity_ratio: float) -> tuple[float | None, ...]:
    """Quantities of a machine switched on once, then which limits it meets."""
    flags = (
        outcome.balanced, not outcome.hanging, outcome.level <= limits.vibration_level_db, outcome.in_time(limits),
    )  # fmt: skip
    return (
        outcome.level, outcome.quiet_time, outcome.rest_time, outcome.settling_time, from_si(outcome.residual, "um"),
        from_si(outcome.imbalance, "g_mm"), capacity_ratio, *flags, all(flags),
    )  # fmt: skip


PHASE: Final = "start.phase_{}_deg"
"""Key of the phase of a wheel's imbalance, by the number of the wheel."""


@dataclass(frozen=True)
class SpindleBuilds(SweepStudy):
    """The design is fixed: each member is one machine built and switched on once, at phases of its own."""

    what: ClassVar[What] = "build"

    variants: Variants[Any]
    design: SpindleDesign

    def numbers(self, values: Values, seed: int) -> tuple[float | None, ...]:
        """One start of one machine. Raises NotTrustworthyError if the run gives no answer."""
        made = self.design.built(self.variants.table(self._in_file(values)))
        member = start_on_spindle(made, values)
        run = start_once(made, member, self.accuracy, FIRST_TOLERANCE, MORE * WORK)
        if isinstance(run, Lost):
            raise NotTrustworthyError(run.reason)
        return numbers_of(run, made.case.table.limits, capacity_ratio(made, member))


def phase_keys(case: SpindleCase) -> tuple[str, ...]:
    """Keys of the phases that are not known; without any known one, the first imbalance is the zero mark."""
    wheels = [number for number, angle in enumerate(case.angles, 1) if angle is None]
    return tuple(PHASE.format(number) for number in wheels[len(wheels) - case.unknown_phases :])


def start_on_spindle(design: SpindleDesign, values: Values) -> Member:
    """The start case of a sample; values that do not vary are usual, phases that do not vary 0."""
    kind, warm, angle = values.get("start.kind"), values.get("start.temperature_C"), _angle(values, "start.angle_deg")
    phases = tuple(_angle(values, key) or 0.0 for key in phase_keys(design.case))
    member = start_of(
        design, kind or "bunched", phases, drag=(drag_ratio(warm) if warm is not None else 1.0) * design.case.drag
    )
    ahead = 0.0 if angle is None else angle - (AHEAD if member.start != "spread" else 0.0)
    return replace(member, turned=ahead, eccentricity=_angle(values, "start.eccentricity_deg") or 0.0)


def capacity_ratio(design: SpindleDesign, member: Member) -> float:
    """Smaller ratio of capacity to what a race needs at the phases and eccentricities of this start."""
    case = design.case
    whirl = cmath.rect(case.eccentricity, race_centre(design, member))
    eccentric = eccentricity_resultants(case.rotor, case.races, (whirl, whirl), case.speed)
    needs = (abs(off - idle) for off, idle in zip(eccentric, race_needs(design, member), strict=True))
    ratios = (made.capacity / need for made, need in zip(design.autobalancers, needs, strict=True) if need > 0)
    return min(ratios, default=math.inf)


@dataclass(frozen=True)
class Designs(SweepStudy):
    """Each member is a machine for which all autobalancers are designed anew."""

    what: ClassVar[What] = "design"

    machine: Machine

    def numbers(self, values: Values, seed: int) -> tuple[float | None, ...]:
        """Numbers that `abu size` gives; of several autobalancers the least capacity ratio and the mass of all."""
        races = self.machine.autobalancers
        paths = {own: values[item.key] for item in self.sample.factors for own in in_all_races(item.path, races)}
        sizing = size(self.machine.changed({".".join(map(str, own)): paths[own] for own in paths}), self.accuracy)
        every, many = sizing.autobalancers, sizing.ensemble
        times = () if many is None else (many.quiet_time_s, many.rest_time_s, many.settling_time_s)
        return (
            sizing.vibration.level_after_db, sizing.worst_level_db,
            *((each.worst for each in times) if times else (None,) * 3),
            every[0].ball_count, every[0].ball_diameter_mm, every[0].race_radius_mm, sum(race.mass_g for race in every),
            min((race.capacity_ratio for race in every if race.capacity_ratio is not None), default=None),
            sizing.status == "pass",
        )  # fmt: skip


@dataclass(frozen=True)
class Scenes(SweepStudy):
    """Each member is a scene given outright."""

    what: ClassVar[What] = "scene"

    variants: Variants[SceneFile]

    def numbers(self, values: Values, seed: int) -> tuple[float | None, ...]:
        """One run."""
        scene = scene_from(self.variants.table(self._in_file(values)).scene)
        warm = values.get("start.temperature_C")
        angle = _angle(values, "start.angle_deg") or 0.0
        scene = turned(scene, angle, 1.0 if warm is None else drag_ratio(warm))
        response, balanced = scene_once(scene, TOLERANCE * self.accuracy / USUAL)
        return (
            response.level, response.quiet_time, response.rest_time, response.settling_time,
            from_si(response.axis_amplitude, "mm"),
            from_si(response.residual_imbalance, "g_mm"), balanced, balanced,
        )  # fmt: skip


def scene_once(scene: Scene, tolerance: float) -> tuple[Response, bool]:
    """One run of a scene given outright, and whether its balls balance, as those of a machine do.

    Raises NotTrustworthyError.
    """
    scene, _ = with_parted_balls(scene)
    response = evaluate(scene, integrated(scene, needed_times(scene), tolerance, MOST_EVALUATIONS)[0])
    slipping = slip(response, abs(response.final.rotor_speed) or scene.speed)
    return response, balances(response.residual_imbalance, allowed_of_scene(scene, response.ball_angles), slipping)


def _line(text: str) -> str:
    return text.splitlines()[0] if text else text


def _finite(value: float | None) -> float | None:
    """A number for a store, which knows no infinities; True and False as 1 and 0."""
    if value is None or not math.isfinite(value):
        return None
    return int(value) if isinstance(value, (bool, int)) else float(value)


def _plain(value: object) -> object:
    """A value for a store: numbers and text as they are, all else as text."""
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        return str(list(value) if isinstance(value, tuple) else value)
    return value
