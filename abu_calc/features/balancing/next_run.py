"""Runs that are missing for an answer, and a proposal for the trial mass of the next one.

A trial mass is safe if its centrifugal force is at most a tenth of each bearing's load at rest. It is visible if it
changes an amplitude by 30 % or a phase by 30°.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Final

from abu_calc.features.balancing.case import Taken
from abu_calc.features.balancing.formulas import Matrix, influence
from abu_calc.features.balancing.methods import method_of
from abu_calc.features.balancing.runs import Balancing, RunOnRig
from abu_calc.features.balancing.tables import ReadingsFile
from abu_calc.features.balancing.tolerance import bearing_levers
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import GRAVITY, from_si, to_si

SAFE_SHARE: Final = 0.1
"""Largest centrifugal force of a trial mass over the load of a bearing at rest."""
VISIBLE_CHANGE: Final = 0.3
"""Change of a reading, as a vector over the reading, that shows clearly."""
MARGIN: Final = 1.5
"""Multiple of the mass that is just visible, where that is safe."""
PLACES: Final = (0.0, 120.0, 240.0)
"""Angles of the trial mass without phase [degrees]."""


@dataclass(frozen=True)
class TrialProposal:
    """Trial mass for a plane [kg]: the one proposed, the largest safe one, and the least visible one if the influence
    of the plane is known; `share`: centrifugal force over the bearing load.
    """

    plane: int
    mass: float
    safe: float
    visible: float | None
    share: float

    @property
    def both(self) -> bool | None:
        """Tell whether the mass is safe and visible; None if its effect is not known."""
        return None if self.visible is None else self.visible <= self.safe


@formula(
    "Largest trial mass whose centrifugal force is safe",
    "m_trial = 0.1·F_b/(R_1·Ω²)",
    "kg",
    shown="g",
    where=(
        "F_b is the load of a bearing at rest over the part of the force that this bearing carries, of both bearings "
        "the smaller one. If the lengths of the rotor are not known, each of two planes counts half of the weight, and "
        "a single plane counts all of it."
    ),
    source="practice of field balancing",
)
def safe_trial_mass(load: float, radius: float, speed: float) -> float:
    """
    >>> round(1e3 * safe_trial_mass(100 * GRAVITY, 0.2, 100 * math.pi), 2)
    4.97
    """
    return SAFE_SHARE * load / (radius * speed**2)


def bearing_loads(file: ReadingsFile) -> tuple[float, ...] | None:
    """Force in each plane that equals the load of a bearing at rest [N]; None if the mass is not known."""
    rotor = file.rotor
    if rotor.mass_kg is None:
        return None
    weight = rotor.mass_kg * GRAVITY
    if file.single_plane is not None:
        return (weight,)
    if rotor.lengths is None:
        return (weight / 2, weight / 2)
    a, b, c, d = rotor.lengths
    loads = [abs(arm) / (a + b + c + d) * weight for arm in (c + d, a + b)]
    levers = bearing_levers(rotor.lengths)
    return tuple(
        min(loads[bearing] / abs(levers[bearing][plane]) for bearing in (0, 1) if levers[bearing][plane])
        for plane in (0, 1)
    )


def proposals(
    file: ReadingsFile, runs: Sequence[RunOnRig], matrix: Matrix | None
) -> tuple[TrialProposal, ...]:
    """A trial mass for each plane at the highest speed of the runs; `matrix`: influence of the planes, if known."""
    loads = bearing_loads(file)
    if loads is None or not runs:
        return ()
    speed = max(run.speed for run in runs)
    first = next((run for run in runs if not run.weights), runs[0])
    largest = max(abs(phasor) for phasor in first.motion)
    made = []
    for plane, (load, radius_mm) in enumerate(zip(loads, file.radii_mm, strict=True)):
        radius = to_si(radius_mm, "mm")
        safe = safe_trial_mass(load, radius, speed)
        gain = None if matrix is None else max(abs(row[plane]) for row in matrix)
        visible = VISIBLE_CHANGE * largest / (gain * radius) if gain else None
        mass = _rounded(safe if visible is None else min(safe, MARGIN * visible))
        made.append(TrialProposal(plane, mass, safe, visible, mass * radius * speed**2 / load))
    return tuple(made)


def _rounded(mass: float) -> float:
    """A mass [kg], down to two digits.

    >>> _rounded(0.01789)
    0.017
    """
    if mass <= 0:
        return 0.0
    step = 10.0 ** (math.floor(math.log10(mass) + 1e-12) - 1)
    return round(math.floor(mass / step + 1e-9) * step, 15)


def known_influence(case: Balancing) -> Matrix | None:
    """Influence of the planes by the rig's data at the speed of the first run; None without them."""
    return None if case.roll is None else influence(case.roll, case.runs[0].speed)


def missing_runs(file: ReadingsFile, taken: Sequence[Taken], case: Balancing) -> tuple[str, ...]:
    """Sentences on what is missing for an answer, the next run first; empty if nothing is."""
    try:
        method_of(case)
    except InputError as lack:
        return (*_next(file, case), f"Then: {_rest_of(case)}" if _rest_of(case) else "", _reason(lack))
    return ()


def _reason(lack: InputError) -> str:
    found = f" ({lack.found})" if lack.found else ""
    return f"Now `abu balance` would say: {lack.message}{found}."


def _rest_of(case: Balancing) -> str:
    """Number of runs behind the next one, in words."""
    count = len(list(_wanted(case))) - 1
    return f"{count} more run{'s' * (count > 1)}." if count > 0 else ""


def _wanted(case: Balancing) -> Iterator[tuple[int | None, float]]:
    """Runs that are missing: plane of the trial mass (None: none) and its angle [degrees], at the first speed that
    lacks one.
    """
    for group in case.speed_groups:
        runs = [case.runs[index] for index in group]
        if all(run.weights for run in runs) and not case.runs[0].phases:
            yield None, 0.0
        if not case.runs[0].phases:
            used = {round(math.degrees(mass.angle)) % 360 for run in runs for mass in run.weights}
            lacking = 3 - min(3, len({frozenset(run.weights) for run in runs if run.weights}))
            free = [angle for angle in PLACES if round(angle) not in used] or [60.0]
            yield from ((0, angle) for angle in free[: max(lacking, 1)])
            return
        placed = [plane for plane in range(case.planes) if any(run.placed[plane] for run in runs)]
        if len(runs) <= len(placed) and all(run.weights for run in runs):
            yield None, 0.0
        yield from ((plane, 0.0) for plane in range(case.planes) if plane not in placed)
        if len(placed) == case.planes and len(runs) > case.planes:
            yield 0, 90.0


def _next(file: ReadingsFile, case: Balancing) -> Iterator[str]:
    """The next run, with its trial mass."""
    wanted = next(_wanted(case), None)
    if wanted is None:
        return
    plane, angle = wanted
    rpm = f"{from_si(case.runs[0].speed, 'rpm'):.0f} rpm"
    if plane is None:
        yield f"Next run: {rpm}, without a trial mass."
        return
    name = "" if file.single_plane is not None else f"{file.planes[plane]} plane, "
    proposed = next((each for each in proposals(file, case.runs, known_influence(case)) if each.plane == plane), None)
    if proposed is None:
        yield f"Next run: {rpm}, {name}a trial mass at {angle:.0f}°."
        yield "Give rotor.mass_kg to have a safe trial mass proposed."
        return
    radius = file.radii_mm[plane]
    yield (
        f"Next run: {rpm}, {name}trial mass {from_si(proposed.mass, 'g'):.3g} g at {angle:.0f}°, radius {radius:g} mm. "
        f"Its centrifugal force is {100 * proposed.share:.2g} % of the bearing load (limit {100 * SAFE_SHARE:.0f} %)."
    )
    if proposed.both is False and proposed.visible is not None:
        yield (
            f"A clear change of 30 % needs {from_si(proposed.visible, 'g'):.3g} g, which is more than the safe mass. "
            "Repeat the runs and average them, or run at a lower speed."
        )
    elif proposed.visible is None:
        yield (
            "If no amplitude changes by 30 % and no phase by 30°, use more mass at a lower speed. If the vibration "
            "rises, move the trial mass to the opposite side."
        )
