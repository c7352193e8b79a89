"""Runs that are missing for an answer, and a proposal for the trial mass of the next one.

A trial mass is safe if its centrifugal force is at most a tenth of each bearing's load at rest. It is visible if it
changes an amplitude by 30 % or a phase by 30°.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Annotated, Final

from abu_calc.features.balancing.case import balancing, taken_runs
from abu_calc.features.balancing.formulas import Matrix, influence
from abu_calc.features.balancing.methods import lacking_at, method_of
from abu_calc.features.balancing.read import Readings
from abu_calc.features.balancing.runs import Balancing, RunOnRig, TrialMass
from abu_calc.features.balancing.tables import ReadingsFile
from abu_calc.features.balancing.tolerance import bearing_levers
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import GRAVITY, shown

SAFE_SHARE: Final = 0.1
"""Largest centrifugal force of a trial mass over the load of a bearing at rest."""
VISIBLE_CHANGE: Final = 0.3
"""Change of a reading, as a vector over the reading, that shows clearly."""
MARGIN: Final = 1.5
"""Multiple of the mass that is just visible, where that is safe."""
PLACES: Final = (0.0, 120.0, 240.0)
"""Angles of the trial mass without phase [degrees]."""


@record
class TrialMassResult(Record):
    """Trial mass proposed for a plane, for the next time."""

    plane: Annotated[str, Quantity("plane")]
    mass: Annotated[float, Quantity("trial mass", "", 3, unit="g")]
    safe: Annotated[float, Quantity("largest safe one", "", 3, "a tenth of the bearing load", unit="g")]
    visible: Annotated[float | None, Quantity("least visible one", "", 3, "changes a reading by 30 %", unit="g")]
    force: Annotated[float, Quantity("centrifugal force", "", 2, "of the bearing load", unit="percent")]


@formula(
    "Largest trial mass whose centrifugal force is safe",
    "m_trial = 0.1·F_b/(R_1·Ω²)",
    "kg",
    shown="g",
    where=(
        "F_b is the load of a bearing at rest over the part of the force that this bearing carries, of both bearings "
        "the smaller one. If the lengths of the rotor are not known, each of two planes counts half of the weight. A "
        "single plane counts all of it."
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


def proposals(file: ReadingsFile, runs: Sequence[RunOnRig], matrix: Matrix | None) -> tuple[TrialMassResult, ...]:
    """A trial mass for each plane at the highest speed of the runs; `matrix`: influence of the planes, if known."""
    loads = bearing_loads(file)
    if loads is None or not runs:
        return ()
    speed = max(run.speed for run in runs)
    first = next((run for run in runs if not run.weights), runs[0])
    largest = max(abs(phasor) for phasor in first.motion)
    made = []
    for plane, (name, load, radius) in enumerate(zip(file.planes, loads, file.radii, strict=True)):
        safe = safe_trial_mass(load, radius, speed)
        gain = None if matrix is None else max(abs(row[plane]) for row in matrix)
        visible = VISIBLE_CHANGE * largest / (gain * radius) if gain else None
        mass = _rounded(safe if visible is None else min(safe, MARGIN * visible))
        force = mass * radius * speed**2 / load
        made.append(TrialMassResult(plane=name, mass=mass, safe=safe, visible=visible, force=force))
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


@dataclass(frozen=True)
class WantedRun:
    """A run that is missing: its speed [rad/s], the plane of its trial mass (None: none), its angle [degrees], and the
    trial mass that was used before in that plane.
    """

    speed: float
    plane: int | None = None
    angle: float = 0.0
    before: TrialMass | None = None


def missing_from(readings: Readings) -> tuple[str, ...]:
    """Sentences on what is missing for an answer, the next run first; empty if nothing is."""
    file, taken = readings.tables, taken_runs(readings)
    case = balancing(file, taken)
    try:
        method_of(case)
    except InputError as lack:
        wanted = list(_wanted(case))
        count = len(wanted) - 1
        then = [f"Then {count} more run{'s' * (count > 1)}."] if count > 0 else []
        stored = (
            ["Stored coefficients need no trial runs: `abu balance --coefficients`."] if case.runs[0].phases else []
        )
        found = f" ({lack.found})" if lack.found else ""
        reason = f"`abu balance` cannot answer yet: {lack.message}{found}."
        return (*(line for run in wanted[:1] for line in _next(file, case, run)), *then, *stored, reason)
    return ()


def _wanted(case: Balancing) -> Iterator[WantedRun]:
    """Runs that are missing, speed by speed."""
    if not case.runs[0].phases:
        yield from _wanted_without_phase(case)
        return
    for group in case.speed_groups:
        runs = [case.runs[index] for index in group]
        if lacking_at(case, group) is None:
            continue
        speed = runs[0].speed
        placed = [plane for plane in range(case.planes) if any(run.placed[plane] for run in runs)]
        if all(run.weights for run in runs):
            yield WantedRun(speed)
        yield from (WantedRun(speed, plane) for plane in range(case.planes) if plane not in placed)
        if len(placed) == case.planes and not all(run.weights for run in runs):  # one fixed ratio of the planes
            yield WantedRun(speed, 0, 90.0)


def _wanted_without_phase(case: Balancing) -> Iterator[WantedRun]:
    """Runs that are missing at the speed that has the most."""
    runs = max(([case.runs[index] for index in group] for group in case.speed_groups), key=len)
    speed = runs[0].speed
    if all(run.weights for run in runs):
        yield WantedRun(speed)
    masses = [run.weights[0] for run in runs if run.weights]
    start = math.degrees(masses[0].angle) if masses else 0.0
    used = {round(math.degrees(mass.angle) - start) % 360 for mass in masses}
    free = [angle for angle in PLACES if round(angle) not in used]
    lacking = max(3 - len({(mass.mass, mass.angle) for mass in masses}), 0) or int(bool(masses and not free)) or 1
    before = masses[0] if masses else None
    for angle in (free or [60.0])[:lacking]:
        yield WantedRun(speed, 0, (start + angle) % 360, before)


def _next(file: ReadingsFile, case: Balancing, wanted: WantedRun) -> Iterator[str]:
    rpm = shown(wanted.speed, "rpm", ".0f")
    if wanted.plane is None:
        yield f"Next run: {rpm}, without a trial mass."
        return
    plane = file.planes[wanted.plane]
    name = "" if file.single_plane is not None else f"{plane} plane, "
    angle = wanted.angle if file.rotor.angle_marks == "against" else -wanted.angle % 360
    at = f"at {angle:.0f}°"
    if wanted.before is not None:
        yield f"Next run: {rpm}, {name}the trial mass of {shown(wanted.before.mass, 'g')} {at}."
        return
    own = [run for run in case.runs if run.speed == wanted.speed]
    matrix = influence(case.roll, case.runs[0].speed) if case.roll else None
    proposed = next((each for each in proposals(file, own, matrix) if each.plane == plane), None)
    if proposed is None:
        yield f"Next run: {rpm}, {name}a trial mass {at}."
        yield "Give rotor.mass_kg to have a safe trial mass proposed."
        return
    yield (
        f"Next run: {rpm}, {name}trial mass {proposed.mass_g:.3g} g {at}, radius "
        f"{shown(file.radii[wanted.plane], 'mm', 'g')}. Its centrifugal force is {proposed.force_percent:.2g} % of the "
        f"bearing load (limit {100 * SAFE_SHARE:.0f} %)."
    )
    yield (
        "The mass is visible if an amplitude changes by 30 % or a phase by 30°. If the vibration rises much, stop and "
        "move the mass to the opposite side."
    )
