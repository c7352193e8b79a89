"""Which integrator: SciPy, always there; a loop of its own for scenes that switch; heyoka, quick but slow to start."""

import importlib.util
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Final, cast

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators import heyoka_, scipy_
from abu_calc.dynamics.integrators.estimates import START, Seconds, counts, held_by_decay, seconds
from abu_calc.dynamics.integrators.rates import stiff_decay
from abu_calc.dynamics.integrators.run import EVENT, Array, work
from abu_calc.dynamics.switching.modes import watches
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.errors import InputError
from abu_calc.progress import Progress, silent

COMPILED, PLAIN = "compiled-rk45", "plain-rk45"
"""Names as trajectories tell them."""

WANTED: Final = ("auto", "scipy", "plain", "compiled", "heyoka")

LOOP_WORK = 1 / 5
"""Work of an evaluation in the loop, that of SciPy's being one; compiled or not, so that what is refused does not hang
on it either: compiled it takes a twentieth of SciPy's time, in plain Python some times as long."""


@dataclass(frozen=True)
class Choice:
    """An integrator, ready to run, its name as trajectories tell it, and why it was chosen."""

    name: str
    why: str
    integrate: Callable[..., Trajectory]
    """(equations, tolerance, sample times, most evaluations)"""
    share: float = 1.0
    """Work of one of its evaluations, in SciPy's."""

    def evaluations(self, work: int) -> int:
        """How many make up so much work."""
        return int(work / self.share)

    def expected(self, equations: Equations, tolerance: float) -> float:
        """About the work of the two runs that a result takes, in SciPy's evaluations, by counting."""
        about = counts(equations, tolerance)
        return self.share * ((about.loop if self.name in (COMPILED, PLAIN) else about.scipy) + EVENT * about.events)

    def work(self, run: Trajectory) -> int:
        """What a run took, counted in SciPy's evaluations."""
        return math.ceil(self.share * work(run))


def choose(equations: Equations, wanted: str, tolerance: float, progress: Progress = silent) -> Choice:
    """The integrator for a scene, `wanted` being auto, scipy, plain, compiled or heyoka; its library is loaded.

    auto takes what is done first, by `estimates`, compilation counted in: SciPy; heyoka; the loop through scenes that
    switch, compiled or as plain Python. Stiff equations go to SciPy's Radau unless another is asked for, or
    compiled code bears their short steps.
    `progress` gets what one waits for. Raises InputError for other words, and for what is not installed or cannot trace
    an effect.
    """
    if wanted not in WANTED:
        raise InputError("unknown integrator", found=wanted, allowed=", ".join(WANTED))
    if wanted == "compiled":
        return _compiled_or_refused(equations)
    if wanted == "heyoka":
        if missing := unfit(equations):
            raise InputError(f"heyoka cannot integrate this scene: {missing[0]}", remedy=missing[1])
        return _heyoka("asked for")
    if wanted == "plain":
        if missing := untraceable(equations):
            raise InputError(f"plain code cannot be written for this scene: {missing[0]}", remedy=missing[1])
        return _plain("asked for")
    if decay := stiff_decay(equations):
        if wanted == "auto" and _bears(equations, tolerance, decay):
            return _compiled("stiff equations that switch: short steps in compiled code are done sooner than long ones")
        return _scipy("scipy-radau", "the equations are stiff: something dies out far faster than anything oscillates")
    if wanted == "scipy":
        return _scipy("scipy-dop853", "asked for")
    return _quickest(equations, seconds(equations, tolerance), progress)


def _bears(equations: Equations, tolerance: float, decay: float) -> bool:
    """Whether the compiled loop goes through a stiff scene that switches sooner than an implicit method."""
    from abu_calc.dynamics.integrators.compiled import waiting

    about = seconds(equations, tolerance)
    if not about.switches or untraceable(equations) or waiting.unfit(equations):
        return False
    own = about.compiled + held_by_decay(equations, decay) + waiting.waiting(equations)
    return own < about.scipy and waiting.load(equations)


def _quickest(equations: Equations, about: Seconds, progress: Progress) -> Choice:
    """What is done first, with what is installed. Numbers must not hang on what is on disk: the loop's never do."""
    if about.switches and not untraceable(equations):
        return _loop(equations, about, progress)
    from abu_calc.dynamics.integrators.compiled import waiting

    work = f"about {about.scipy:.2g} s of work"
    missing, lacks = unfit(equations), waiting.unfit(equations)
    if about.scipy <= START:
        return _scipy("scipy-dop853", f"a short run, {work}: anything else would take longer to start")
    if not missing:
        return _heyoka(f"a long run, {work} for SciPy")
    if not lacks and about.compiled + waiting.compiling(equations) < about.scipy and waiting.load(equations):
        return _compiled(f"a long run, {work} for SciPy")
    return _scipy("scipy-dop853", f"a long run, {work}; heyoka would be faster, but {missing[0]}")


def _loop(equations: Equations, about: Seconds, progress: Progress) -> Choice:
    """Through a scene that switches: compiled where that is done sooner, with the same numbers."""
    from abu_calc.dynamics.integrators.compiled import waiting

    work, lacks = f"a scene that switches, about {about.scipy:.2g} s of work for SciPy", waiting.unfit(equations)
    if about.plain <= waiting.LEAST:
        return _plain(f"a short run, about {about.plain:.2g} s of work: anything else would take longer to start")
    if lacks:
        return _plain(f"{work}; compiled code would be faster, but {lacks[0]}")
    wait = waiting.waiting(equations)
    if wait + about.compiled > about.plain:
        return _plain(f"{work}; compiling would take longer")
    if wait > waiting.LEAST:
        progress(f"{equations.scene.name}: compiling, about {wait:.1g} s")
    return _compiled(work) if waiting.load(equations) else _plain(f"{work}; compiled code does not run here")


def untraceable(equations: Equations) -> tuple[str, str] | None:
    """The effect that cannot be written in another language, and the remedy; None when all can."""
    for effect in equations.scene.effects:
        if not effect.traceable:
            return f"it cannot trace the effect {effect.name}", "use scipy, or leave the effect out"
    return None


def unfit(equations: Equations) -> tuple[str, str] | None:
    """Why heyoka cannot integrate a scene, and the remedy; None when it can."""
    if importlib.util.find_spec("heyoka") is None:
        return "it is not installed", 'pip install "abu-calc[fast]" on Linux; elsewhere from conda-forge; or use scipy'
    return untraceable(equations)


def _compiled_or_refused(equations: Equations) -> Choice:
    """Compiled code, which is made when it is asked for; InputError where it does not run."""
    from abu_calc.dynamics.integrators.compiled import waiting

    if waiting.unfit(equations) is None:
        waiting.load(equations)
    if missing := waiting.unfit(equations):
        raise InputError(f"compiled code cannot integrate this scene: {missing[0]}", remedy=missing[1])
    return _compiled("asked for")


def _compiled(why: str) -> Choice:
    from abu_calc.dynamics.integrators.compiled import run  # some twenty modules, which not every command needs

    return Choice(COMPILED, why, run.integrate, LOOP_WORK)


def _plain(why: str) -> Choice:
    from abu_calc.dynamics.integrators.compiled import run

    return Choice(PLAIN, why, partial(run.integrate, compiled=False), LOOP_WORK)


def _heyoka(why: str) -> Choice:
    heyoka_.load()
    return Choice("heyoka", why, heyoka_.integrate)


def _scipy(method: scipy_.Method, why: str) -> Choice:
    scipy_.load()
    return Choice(method, why, partial(scipy_.integrate, method=method))


def available(equations: Equations) -> tuple[str, ...]:
    """Names of all integrators that can take a scene here."""
    from abu_calc.dynamics.integrators.compiled import waiting

    names = ("scipy-dop853", "scipy-rk45", "scipy-lsoda", "scipy-radau", "scipy-bdf")
    plain = () if untraceable(equations) else (PLAIN,)
    compiled = () if waiting.unfit(equations) else (COMPILED,)
    return (*names, *plain, *compiled, *(() if unfit(equations) else ("heyoka",)))


def integrate_with(name: str, equations: Equations, tolerance: float, sample_times: Array, most: int) -> Trajectory:
    """The motion by an integrator given by name, within so many evaluations."""
    if name in ("compiled", COMPILED):
        return _compiled_or_refused(equations).integrate(equations, tolerance, sample_times, most)
    if name == PLAIN:
        return _plain("asked for").integrate(equations, tolerance, sample_times, most)
    if name == "heyoka":
        return heyoka_.integrate(equations, tolerance, sample_times, most)
    return scipy_.integrate(equations, tolerance, sample_times, most, method=cast(scipy_.Method, name))


def verifiers(equations: Equations, accuracy: float) -> tuple[tuple[str, float], tuple[str, float]]:
    """Two integrators of different kinds, each with a tolerance tight for that accuracy, to hold against each other."""
    tight = min(max(1e-5 * accuracy, 1e-11), 1e-7)
    names = available(equations)
    if watches(equations) and COMPILED in names:
        return (COMPILED, tight), ("heyoka", tight / 100) if "heyoka" in names else ("scipy-dop853", tight / 10)
    if "heyoka" in names:
        return ("scipy-dop853", tight), ("heyoka", tight / 100)
    # LSODA interpolates too loosely for events; its steps are cheap where there are none.
    return ("scipy-dop853", tight / 10), ("scipy-rk45" if watches(equations) else "scipy-lsoda", tight)
