"""Which integrator: SciPy, always there, or heyoka, fast but slow to start; and whether the equations are stiff."""

import importlib.util
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Final, cast

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators import heyoka_, scipy_
from abu_calc.dynamics.integrators.run import Array
from abu_calc.dynamics.switching.modes import watches
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.errors import InputError

COMPILED: Final = "compiled-rk45"
"""Its name as trajectories tell it."""

WANTED: Final = ("auto", "scipy", "compiled", "heyoka")

EVALUATIONS, ORDER = 35.0, 8
"""Of DOP853 per revolution at a tolerance of 1e-6, and the order by which they grow: four balls on a soft planar
support took 18, 33, 78 and 183 at 2e-4, 1e-6, 1e-9 and 1e-12."""

EVALUATION, BALL = 6e-6, 0.6e-6
"""Time of an evaluation [s] with its share of the step, and of each ball in it: 8 µs for 2 to 4 balls, 15 for 16."""

SWITCHING = 1e-3
"""Time [s] that events take in a revolution, for each effect that has modes; balls that gravity shakes loose stick and
slip several times in each."""

RUNS = 2
"""A result is trusted when two tolerances agree."""

START = 0.25
"""Time [s] heyoka takes to be imported (0.05 to 0.13) and to load compiled code from disk (0.02 to 0.1), and some more:
what it gains has to be worth the compilation of the very first run (0.3 to 1)."""


@dataclass(frozen=True)
class Choice:
    """An integrator, ready to run, its name as trajectories tell it, and why it was chosen."""

    name: str
    why: str
    integrate: Callable[..., Trajectory]
    """(equations, tolerance, sample times, most evaluations)"""


def choose(equations: Equations, wanted: str, tolerance: float) -> Choice:
    """The integrator for a scene, `wanted` being auto, scipy, compiled or heyoka; its library is loaded.

    auto takes heyoka where it is installed and SciPy's estimated time is longer than heyoka's start. Stiff equations go
    to SciPy's Radau unless heyoka is asked for. Raises InputError for other words, and for heyoka where it is not
    installed or cannot trace an effect.
    """
    if wanted not in WANTED:
        raise InputError("unknown integrator", found=wanted, allowed=", ".join(WANTED))
    missing = unfit(equations)
    if wanted == "compiled":
        return _compiled(equations)
    if wanted == "heyoka":
        if missing:
            raise InputError(f"heyoka cannot integrate this scene: {missing[0]}", remedy=missing[1])
        return _heyoka("asked for")
    if scipy_.is_stiff(equations):
        return _scipy("scipy-radau", "the equations are stiff: something dies out far faster than anything oscillates")
    if wanted == "scipy":
        return _scipy("scipy-dop853", "asked for")
    seconds = RUNS * scipy_seconds(equations, tolerance)
    if seconds <= START:
        return _scipy("scipy-dop853", f"a short run, about {seconds:.2g} s of work: heyoka would take longer to start")
    if missing:
        return _scipy("scipy-dop853", f"heyoka would be faster, but {missing[0]}")
    more = " and more for its events" if watches(equations) else ""
    return _heyoka(f"a long run, about {seconds:.2g} s of work for SciPy{more}")


def scipy_seconds(equations: Equations, tolerance: float) -> float:
    """About how long SciPy takes for one run [s], by counting: nothing is timed, so that a scene has one answer."""
    scene = equations.scene
    per_revolution = EVALUATIONS * (1e-6 / tolerance) ** (1 / ORDER)
    smooth = per_revolution * (EVALUATION + BALL * len(scene.ball_masses))
    events = SWITCHING * sum(effect.switches for effect in scene.effects)
    return float(scene.duration / scene.revolution * (smooth + events))


def unfit(equations: Equations) -> tuple[str, str] | None:
    """Why heyoka cannot integrate a scene, and the remedy; None when it can."""
    if importlib.util.find_spec("heyoka") is None:
        return "it is not installed", 'pip install "abu-calc[fast]" on Linux; elsewhere from conda-forge; or use scipy'
    for effect in equations.scene.effects:
        if not effect.traceable:
            return f"it cannot trace the effect {effect.name}", "use scipy, or leave the effect out"
    return None


def _compiled(equations: Equations) -> Choice:
    """Compiled code, which is imported and made when it is asked for; InputError where it does not run."""
    from abu_calc.dynamics.integrators.compiled import run, waiting

    if waiting.unfit(equations) is None:
        waiting.load(equations)
    if missing := waiting.unfit(equations):
        raise InputError(f"compiled code cannot integrate this scene: {missing[0]}", remedy=missing[1])
    return Choice(COMPILED, "asked for", run.integrate)


def _heyoka(why: str) -> Choice:
    heyoka_.load()
    return Choice("heyoka", why, heyoka_.integrate)


def _scipy(method: scipy_.Method, why: str) -> Choice:
    scipy_.load()
    return Choice(method, why, partial(scipy_.integrate, method=method))


def available(equations: Equations) -> tuple[str, ...]:
    """Names of all integrators that can take a scene here."""
    names = ("scipy-dop853", "scipy-rk45", "scipy-lsoda", "scipy-radau", "scipy-bdf")
    return names if unfit(equations) else (*names, "heyoka")


def integrate_with(name: str, equations: Equations, tolerance: float, sample_times: Array, most: int) -> Trajectory:
    """The motion by an integrator given by name, within so many evaluations."""
    if name in ("compiled", COMPILED):
        return _compiled(equations).integrate(equations, tolerance, sample_times, most)
    if name == "heyoka":
        return heyoka_.integrate(equations, tolerance, sample_times, most)
    return scipy_.integrate(equations, tolerance, sample_times, most, method=cast(scipy_.Method, name))


def verifiers(equations: Equations, accuracy: float) -> tuple[tuple[str, float], tuple[str, float]]:
    """Two integrators of different kinds, each with a tolerance tight for that accuracy, to hold against each other."""
    tight = min(max(1e-5 * accuracy, 1e-11), 1e-7)
    if not unfit(equations):
        return ("scipy-dop853", tight), ("heyoka", tight / 100)
    # LSODA interpolates too loosely for events; its steps are cheap where there are none.
    return ("scipy-dop853", tight / 10), ("scipy-rk45" if watches(equations) else "scipy-lsoda", tight)
