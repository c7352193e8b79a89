"""What each rung of the ladder says of every preset: closed form, envelope, equations, and what each costs.

    python -m tests.studies.rungs

The idle scene, its race eccentricity in; what switches, and gravity, is out: averages know nothing of it. The equations
are at a tolerance of 1e-10; their cost is that of the loosest tolerance which does for one per cent.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.scene import Scene, only, with_parted_balls
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.units import level_from_velocity
from abu_calc.inputs.read_machine import read_machine
from abu_calc.inputs.reading import sources as presets
from abu_calc.simulation.model_level import (
    WIDEST,
    Measures,
    ModelEstimate,
    amplitude,
    angles,
    averaged,
    closed_form,
    level,
    offer,
    settling,
)
from abu_calc.simulation.response import evaluate, needed_times
from abu_calc.simulation.subject import subject_of

ACCURACY = 0.01
REFERENCE = 1e-10
ENVELOPE = 1e-4
"""Tolerance of the envelope."""
LOOSE = (2e-3, 1e-3, 5e-4, 2e-4, 1e-4)
PAIRS = 5


@dataclass(frozen=True)
class Ladder:
    """What the rungs say of one preset; `stated`: the error the envelope claims of itself."""

    name: str
    scene: Scene
    closed: ModelEstimate
    slow: ModelEstimate
    full: Measures
    stated: float


def machines() -> list[str]:
    """The presets that are whole machines."""
    found = []
    for name in presets.names():
        try:
            subject_of(read_machine(name))
        except InputError:
            continue
        found.append(name)
    return found


def smooth(name: str) -> Scene:
    """The idle scene of a preset with what averages know of."""
    return with_parted_balls(only(subject_of(read_machine(name)).scene, ["race_eccentricity"]))[0]


def integrated(scene: Scene, tolerance: float) -> Measures:
    """The equations."""
    return evaluate(scene, scipy_.integrate(assemble(scene), tolerance, needed_times(scene)))


def ladder(name: str) -> Ladder:
    """All rungs of one preset."""
    scene = smooth(name)
    # Asked for little, it is run and tells its error.
    stated = offer(scene, WIDEST, needed_times(scene)).error or 0.0
    return Ladder(name, scene, closed_form(scene), averaged(scene, ENVELOPE), integrated(scene, REFERENCE), stated)


def off(scene: Scene, told: Measures, full: Measures) -> float:
    """The largest of the errors in amplitude, level and settling time."""
    return max(measure(scene, told, full) for measure in (amplitude, level, settling))


def cost(one: Ladder) -> tuple[float, float]:
    """CPU time [s] of the envelope and of the loosest equations that do for one per cent; the best of pairs."""
    scene = one.scene
    enough = next(t for t in LOOSE if off(scene, integrated(scene, t), one.full) <= ACCURACY)
    pairs = [(_cpu(lambda: averaged(scene, ENVELOPE)), _cpu(lambda: integrated(scene, enough))) for _ in range(PAIRS)]
    quick, long = zip(*pairs, strict=True)
    return min(quick), min(long)


def _cpu(work: Callable[[], Any]) -> float:
    started = time.process_time()
    work()
    return time.process_time() - started


def table(ladders: list[Ladder]) -> list[str]:
    """As text, 80 columns."""
    lines = [
        f"{'preset':18} {'rung':11} {'amplitude':>9} {'level':>7} {'settling':>8} {'angles':>7} {'CPU':>7}",
        f"{'':18} {'':11} {'µm':>9} {'dB':>7} {'s':>8} {'rad':>7} {'ms':>7}",
    ]
    for one in ladders:
        quick, long = cost(one)
        rows = (("closed form", one.closed, None), ("envelope", one.slow, quick), ("equations", one.full, long))
        for rung, told, seconds in rows:
            apart = angles(one.scene, told, one.full)
            settled = "-" if told.settling_time is None else f"{told.settling_time:.3f}"
            lines.append(
                f"{one.name if rung == 'closed form' else '':18} {rung:11} {1e6 * told.axis_amplitude:9.3f} "
                f"{level_from_velocity(told.velocity_rms):7.2f} {settled:>8} "
                f"{'' if rung == 'equations' else f'{apart:.3f}':>7} "
                f"{'' if seconds is None else f'{1e3 * seconds:.1f}':>7}"
            )
        lines.append(f"{'':18} the envelope's own estimate of its error: {one.stated:.2g}")
    return lines


if __name__ == "__main__":
    print("\n".join(table([ladder(name) for name in machines()])))
