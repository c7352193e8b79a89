"""Choice of the integrator: one loop of steps for nearly all scenes, SciPy's methods for stiff ones.

A stiff scene that switches is tried in the loop for some turns, and goes to SciPy only if that takes more work. SciPy's
methods are also used on request. The loop runs as compiled code. It runs as plain Python if there is no compiler, or
as long as a run seems to be over before compiled code is loaded; the numbers are the same. Its method depends on the
scene and the tolerance alone: order 8 (DOP853) for smooth scenes and for tight tolerances, order 5 (RK45) for looser
ones if events cut the steps short anyway.
"""

import math
from collections.abc import Callable
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Final, cast

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.integrators.run import EVENT, LOOP_EVENT, TooMuchWorkError, decision_work, work
from abu_calc.dynamics.integrators.work_estimates import RUNS, counts, stiff
from abu_calc.dynamics.switching.modes import watches
from abu_calc.dynamics.trajectory import Times, Trajectory
from abu_calc.foundation.errors import InputError, NotTrustworthyError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent

if TYPE_CHECKING:
    from abu_calc.dynamics.integrators.compiled.kernels import Method
    from abu_calc.dynamics.integrators.compiled.run import Loader

LOOP: Final = ("compiled-dop853", "compiled-rk45", "plain-dop853", "plain-rk45")
"""Names of the loop, as trajectories give them."""

WANTED: Final = ("auto", "scipy", "plain", "compiled")

REMOVED: Final = "heyoka"
"""An integrator of earlier versions."""

TIGHT: Final = 3e-6
"""Tolerance from which on order 8 costs less than order 5 in scenes that switch: between 2e-4 for the presets with few
events and 1e-6 for those with many."""

LOOP_WORK: Final = 1 / 5
"""Work of an evaluation in the loop, that of SciPy's being one; compiled or not, so that what is refused does not hang
on it either: compiled it takes a hundredth of SciPy's time, in plain Python some times as long."""

FEW, MANY = 6, 1.15
"""Number of balls up to which an evaluation in the loop counts LOOP_WORK. With more it counts as this power of their
number: the code no longer fits into what is nearest to the processor. An evaluation of SciPy's hardly depends on them.
"""

COMPILED_TIME: Final = 1 / 100
"""Time of a compiled evaluation in units of one of SciPy's, at most: three balls with friction take 1/300."""

IMPLICIT_EVENT: Final = 4 * EVENT
"""Evaluations that an event is worth in an implicit method of SciPy's, whose first steps after it are small."""

TRIAL: Final = 3
"""Revolutions for which a stiff scene that switches is tried in the loop."""

LEAST_DECISIONS: Final = 5
"""Number of events decided by Python from which on they are compared with those expected."""

SHORT: Final = 15_000
"""Evaluations, times one more than the balls, that plain Python does before compiled code is loaded: a tenth of a
second."""


@dataclass(frozen=True)
class IntegratorChoice:
    """An integrator, ready to run, its name as trajectories tell it, and why it was chosen."""

    name: str
    why: str
    integrate: Callable[..., Trajectory]
    """(equations, tolerance, sample times, most evaluations)"""
    share: float = 1.0
    """Work of one of its evaluations."""
    event: int = EVENT
    """Evaluations that an event is worth."""

    def evaluations(self, work: int) -> int:
        """Number of evaluations that make up this much work."""
        return int(work / self.share)

    def expected(self, equations: Equations, tolerance: float) -> float:
        """About the work of the two runs that a result takes, by counting."""
        about = counts(equations, tolerance)
        return self.share * ((about.loop if self.name in LOOP else about.scipy) + self.event * about.events)

    def work(self, run: Trajectory) -> int:
        """Work of a run."""
        return math.ceil(self.share * work(run, self.event))


def choose(equations: Equations, wanted: str, tolerance: float, progress: Progress = silent) -> IntegratorChoice:
    """The integrator for a scene, `wanted` being auto, scipy, plain or compiled; its code or library is loaded.

    Stiff equations go to SciPy's Radau, unless the loop goes through the events sooner or another integrator is asked
    for; all others go to the loop. `progress` gets what one waits for. Raises InputError for other words, and for what
    is not installed or cannot trace an effect.
    """
    refuse_removed(wanted)
    if wanted not in WANTED:
        raise InputError("unknown integrator", found=wanted, allowed=", ".join(WANTED))
    if wanted in ("plain", "compiled"):
        return loop(equations, tolerance, compiled=wanted == "compiled")
    if stiff(equations) and (wanted == "scipy" or not _loop_copes(equations, tolerance)):
        return _scipy("scipy-radau", "the equations are stiff: something dies out far faster than anything oscillates")
    if wanted == "scipy":
        return _scipy("scipy-dop853", "asked for")
    if effect := untraceable(equations):
        return _scipy("scipy-dop853", f"the loop cannot trace the effect {effect}")
    return quickest_loop(equations, tolerance, progress)


def refuse_removed(wanted: str) -> None:
    """Raise InputError for an integrator that earlier versions had, naming what replaces it."""
    if wanted == REMOVED:
        raise InputError(
            "heyoka is not an integrator of this version", place=Place(key="integrator"), found=REMOVED,
            allowed=", ".join(WANTED), remedy="Use auto or compiled: the compiled loop of order 8 replaces it.",
        )  # fmt: skip


def loop(equations: Equations, tolerance: float, compiled: bool) -> IntegratorChoice:
    """The loop, compiled or as plain Python, for those who ask for it. Raises InputError where it cannot run."""
    from abu_calc.dynamics.integrators.compiled import availability as ready

    name = "compiled code" if compiled else "plain code"
    if effect := untraceable(equations):
        raise InputError(f"{name} cannot trace the effect {effect}", remedy="use scipy, or leave the effect out")
    if compiled and not ready.load(equations, loop_method(equations, tolerance)):
        raise InputError(f"there is no compiled code: {ready.missing()}", remedy="use plain or scipy")
    return _loop_of(equations, compiled, loop_method(equations, tolerance), "; asked for")


def loop_method(equations: Equations, tolerance: float) -> "Method":
    """The method of the loop: dop853 or rk45."""
    return "rk45" if watches(equations) and tolerance > TIGHT else "dop853"


def quickest_loop(equations: Equations, tolerance: float, progress: Progress = silent) -> IntegratorChoice:
    """The loop, compiled where that is done sooner; stiff or not."""
    from abu_calc.dynamics.integrators.compiled import availability as ready

    method = loop_method(equations, tolerance)
    if ready.loaded(equations, method):
        return _loop_of(equations, True, method)
    about = counts(equations, tolerance)
    if (about.loop + LOOP_EVENT * about.events) * (1 + len(equations.scene.ball_masses)) < SHORT:
        why = "; a short run, over before compiled code would be loaded"
        return _loop_of(equations, False, method, why, ready.load)
    progress(f"{equations.scene.name}: loading compiled code")
    if ready.load(equations, method):
        return _loop_of(equations, True, method)
    return _loop_of(equations, False, method, f"; compiled code would be faster, but {ready.missing()}")


def _loop_of(
    equations: Equations, compiled: bool, method: "Method", more: str = "", long: "Loader | None" = None
) -> IntegratorChoice:
    """The loop, why it has this method, and whatever more there is to say; `long` compiles a run that proves long."""
    name = f"{'compiled' if compiled else 'plain'}-{method}"
    scene = "a tight tolerance" if method == "dop853" else "a scene that switches"
    order = f"order {5 if method == 'rk45' else 8} for {scene if watches(equations) else 'a smooth scene'}"
    why = f"the loop{'' if compiled else ' as plain Python'}, {order}{more}"
    share = LOOP_WORK * max(1.0, (1 + len(equations.scene.ball_masses)) / (1 + FEW)) ** MANY
    return IntegratorChoice(name, why, partial(_through, compiled=compiled, long=long), share, LOOP_EVENT)


def _through(
    equations: Equations, tolerance: float, sample_times: Times, most: int, *, compiled: bool,
    method: "Method | None" = None, long: "Loader | None" = None,
) -> Trajectory:  # fmt: skip
    """The motion by the loop, whose method follows the tolerance of each run where none is given."""
    from abu_calc.dynamics.integrators.compiled import run

    method = method or loop_method(equations, tolerance)
    return run.integrate(equations, tolerance, sample_times, most, compiled=compiled, method=method, long=long)


@lru_cache(maxsize=8)
def _loop_copes(equations: Equations, tolerance: float) -> bool:
    """True if the loop takes a stiff scene through its first turns sooner than an implicit method would.

    That method begins anew at each event. The loop is tried, since the decay at the start tells little of the motion
    to come: friction holds a ball that has hardly begun to move ten thousand times as fast as one that rolls.

    A trial may end early by events that Python has to decide. The implicit method would meet the same events, so the
    loop keeps the scene if there are more of them than expected. Other events do not count: the loop may make them
    itself, by steps that are too long for what dies out.
    """
    scene = equations.scene
    if not watches(equations) or untraceable(equations):
        return False
    about, until = counts(equations, tolerance), min(TRIAL * scene.revolution, scene.duration)
    implicit = (about.scipy + EVENT * about.events) / RUNS * until / scene.duration
    choice, decision = quickest_loop(equations, tolerance), decision_work(equations)
    most = max(math.ceil(implicit / COMPILED_TIME), (LEAST_DECISIONS + 1) * decision)
    try:
        choice.integrate(equations, tolerance, [until], most)
    except TooMuchWorkError as error:
        decisions = math.ceil((most - error.evaluations - LOOP_EVENT * error.events) / decision)
        same = about.scipy / RUNS * error.reached / scene.duration + IMPLICIT_EVENT * decisions
        return decisions >= LEAST_DECISIONS and same > implicit
    except NotTrustworthyError:  # the whole run tells what is wrong
        return True
    return True


def untraceable(equations: Equations) -> str | None:
    """The name of an effect that cannot be traced; None where all can."""
    return next((effect.name for effect in equations.scene.effects if not effect.traceable), None)


def _scipy(method: scipy_.Method, why: str) -> IntegratorChoice:
    scipy_.load()
    return IntegratorChoice(method, why, partial(scipy_.integrate, method=method))


def available(equations: Equations) -> tuple[str, ...]:
    """Names of all integrators that can take a scene here; the loop as plain Python only where nothing is compiled."""
    from abu_calc.dynamics.integrators.compiled import availability as ready

    names = ("scipy-dop853", "scipy-rk45", "scipy-lsoda", "scipy-radau", "scipy-bdf")
    if untraceable(equations):
        return names
    way = "plain" if ready.missing() else "compiled"
    return (f"{way}-dop853", f"{way}-rk45", *names)


def integrate_with(name: str, equations: Equations, tolerance: float, sample_times: Times, most: int) -> Trajectory:
    """The motion by an integrator given by name, within so many evaluations."""
    if name in LOOP:
        way, method = name.split("-")
        if way == "compiled":
            loop(equations, tolerance, compiled=True)  # raises where there is none
        return _through(
            equations, tolerance, sample_times, most, compiled=way == "compiled", method=cast("Method", method)
        )
    return scipy_.integrate(equations, tolerance, sample_times, most, method=cast(scipy_.Method, name))


def verifiers(equations: Equations, accuracy: float, quick: bool = False) -> tuple[tuple[str, float], ...]:
    """Two integrators of different kinds, at tolerances tight for that accuracy; the second is the better one.

    `quick`: both methods of the loop, order 5 and 8, which share how events are located, for scenes whose events would
    take SciPy's too long.
    """
    tight = min(max(1e-5 * accuracy, 1e-11), 1e-7)
    own = [name for name in available(equations) if name in LOOP]
    if watches(equations) and quick and len(own) > 1:
        return (own[1], tight), (own[0], tight / 10)
    if watches(equations):
        # LSODA interpolates too loosely for events; its steps are cheap where there are none.
        return (own[1] if own else "scipy-rk45", tight), ("scipy-dop853", tight / 10)
    return ("scipy-lsoda", tight), (own[0] if own else "scipy-dop853", tight / 10)
