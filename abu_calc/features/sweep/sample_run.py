"""Run of one sample: one machine built and switched on once, or one scene, within a time limit.

Work that takes too long is given up, in any thread and on any system, and the next sample goes on.
"""

import ctypes
import faulthandler
import os
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Final

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.integrators.run import MOST_EVALUATIONS
from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.dynamics.supports.receptance import reference_imbalance
from abu_calc.formulas.friction_band import friction_band
from abu_calc.formulas.motion import SETTLED
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.interruption import importing
from abu_calc.simulation.ensemble import WORK, outcome_of
from abu_calc.simulation.ensemble_results import StartOutcome
from abu_calc.simulation.response import HALF, Response, allowed_imbalance, balances, evaluate, needed_times, slip
from abu_calc.simulation.start_cases import SwitchedOn, scene_switched_on
from abu_calc.sizing.design import Design, with_worst

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


def machine_started(design: Design, start: SwitchedOn, lighter: tuple[float, ...], tolerance: float) -> StartOutcome:
    """One start of one machine, by one run with every effect there is data for. Raises NotTrustworthyError."""
    scene, _ = with_parted_balls(scene_switched_on(design, start, lighter))
    response = _response(scene, tolerance, WORK)
    outcome = outcome_of(design, start.member(design), scene, response)
    if outcome.balanced or outcome.hanging or outcome.imbalance > HALF * scene.imbalance:
        return outcome
    # Only where it decides: the worst arrangement of balls that friction holds takes longer than all the rest.
    return replace(outcome, allowed=allowed_imbalance(with_worst(design), scene.imbalance))


@dataclass(frozen=True)
class SceneOutcome:
    """A scene given outright, run once, and whether its balls balance."""

    response: Response
    slip: float
    balanced: bool


def scene_once(scene: Scene, tolerance: float) -> SceneOutcome:
    """One run of a scene. It balances as a machine does: see `balanced`. Raises NotTrustworthyError."""
    scene, _ = with_parted_balls(scene)
    response = _response(scene, tolerance, MOST_EVALUATIONS)
    slipping = slip(response, abs(response.final.speed) or scene.speed)
    balanced = balances(response.residual_imbalance, _allowed(scene, response), slipping)
    return SceneOutcome(response, slipping, balanced)


def _allowed(scene: Scene, response: Response) -> float:
    """A tenth of the imbalance, and what eccentricity and dry friction leave; with friction at most half of it."""
    mass = scene.support.felt_mass
    eccentric, rolling = scene.effect("race_eccentricity"), scene.effect("dry_rolling_friction")
    tenth = SETTLED * reference_imbalance(scene) + mass * getattr(eccentric, "magnitude", 0.0)
    if rolling is None:
        return tenth
    arm, radius = getattr(rolling, "lever_arm", 0.0), getattr(rolling, "ball_radius", 1.0)
    first, held = 0, 0.0
    for race in scene.races:
        angles = response.ball_angles[first : first + len(race.ball_masses)]
        held, first = max(held, friction_band(arm, race.pitch_radius, radius, angles)), first + len(angles)
    return max(tenth, min(tenth + mass * held, HALF * scene.imbalance))


def _response(scene: Scene, tolerance: float, work: int) -> Response:
    equations = assemble(scene)
    choice = choose(equations, "auto", tolerance)
    run = choice.integrate(equations, tolerance, needed_times(scene), choice.evaluations(work))
    return evaluate(scene, run)
