"""Permissible residual imbalance of a rotor, shared to its tolerance planes, and imbalances transformed to them.

The tolerance planes are the bearing planes. If the lengths of the rotor are not known, the correction planes serve.

Runs that are missing for an answer, and a proposal for the trial mass of the next one.

A trial mass is safe if its centrifugal force is at most a tenth of each bearing's load at rest. It is visible if it
changes an amplitude by 30 % or a phase by 30°.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import Annotated, ClassVar, Final, Literal

from abu_calc.features.balancing.case import balancing, taken_runs
from abu_calc.features.balancing.errors import size
from abu_calc.features.balancing.formulas import Matrix, Vector, influence
from abu_calc.features.balancing.methods import lacking_at, method_of
from abu_calc.features.balancing.read import Readings
from abu_calc.features.balancing.runs import Balancing, RunOnRig, TrialMass
from abu_calc.features.balancing.tables import ReadingsFile
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import GRAVITY, shown
from abu_calc.foundation.validity import Range
from abu_calc.standards.vibration import permissible_imbalance

Planes = Literal["bearing planes", "correction planes"]

INBOARD: Final = (0.3, 0.7)
"""Limits of a share if the centre of mass is between the bearings."""
OUTBOARD: Final = (0.3, 1.3)
"""Limits of a share if the centre of mass is outside the bearings; from a secondary source, unverified."""
_SPAN = Range("distance of the bearings", 0.0, 1e3, "m", open_low=True)


@formula(
    "Permissible residual imbalance of the bearing planes",
    "U_A = U_per·L_B/L_AB, U_B = U_per·L_A/L_AB",
    "kg m",
    where=(
        "With the centre of mass between the bearings each share is held within 0.3 … 0.7 of U_per. If it is outside, "
        "as in many overhung rotors, each share is held within 0.3 … 1.3 of U_per. The bearing next to it then carries "
        "more than the whole weight."
    ),
    checked=(_SPAN,),
    source="ISO 21940-11:2016, allocation to tolerance planes; limits of overhung rotors: ISO 1940-1:2003, unverified",
)
def tolerance_shares(permitted: float, left: float, right: float) -> tuple[float, float]:
    """Shares of the left and the right bearing; `left`, `right`: from each bearing to the centre of mass, negative if
    it is outside.

    >>> [round(share, 1) for share in tolerance_shares(238.7, 0.12, 0.68)]
    [167.1, 71.6]
    >>> [round(share, 2) for share in tolerance_shares(1.0, 0.5, -0.1)]
    [0.3, 1.25]
    """
    span = _SPAN.check(left + right)
    low, high = INBOARD if left >= 0 and right >= 0 else OUTBOARD
    first, second = (min(max(abs(arm) / span, low), high) * permitted for arm in (right, left))
    return first, second


@record
class ToleranceResult(Record):
    """Permitted residual imbalance and the imbalance of each tolerance plane; null for the planes there are not."""

    optional: ClassVar[frozenset[str]] = frozenset(
        {"left_g_mm", "right_g_mm", "left_now_g_mm", "right_now_g_mm", "left_rest_g_mm", "right_rest_g_mm",
         "single_plane_g_mm", "single_plane_now_g_mm", "single_plane_rest_g_mm"}
    )  # fmt: skip

    planes: Annotated[str, Quantity("tolerance planes", "", 4, "bearing planes, or correction planes")]
    rule: Annotated[str, Quantity("rule")]
    whole: Annotated[float, Quantity("permitted imbalance of the rotor", "U_per", unit="g_mm")]
    left: Annotated[float | None, Quantity("left, permitted", "U_A", unit="g_mm")] = None
    right: Annotated[float | None, Quantity("right, permitted", "U_B", unit="g_mm")] = None
    left_now: Annotated[float | None, Quantity("left, now", unit="g_mm")] = None
    right_now: Annotated[float | None, Quantity("right, now", unit="g_mm")] = None
    left_rest: Annotated[float | None, Quantity("left, expected", "", 2, "rms over the errors", unit="g_mm")] = None
    right_rest: Annotated[float | None, Quantity("right, expected", "", 2, "rms over the errors", unit="g_mm")] = None
    single_plane: Annotated[float | None, Quantity("permitted", "U_per", unit="g_mm")] = None
    single_plane_now: Annotated[float | None, Quantity("now", unit="g_mm")] = None
    single_plane_rest: Annotated[float | None, Quantity("expected", "", 2, "rms over the errors", unit="g_mm")] = None


@dataclass(frozen=True)
class TolerancePlanes:
    """Permitted imbalance in all and of each tolerance plane [kg m]; `levers`: rows by which imbalances of the
    correction planes act in the tolerance planes.
    """

    whole: float
    permitted: tuple[float, ...]
    planes: Planes
    levers: tuple[tuple[float, ...], ...]
    overhung: bool = False

    def transformed(self, imbalance: Vector) -> Vector:
        """Imbalances of the correction planes as those of the tolerance planes [kg m]."""
        return tuple(sum((lever * q for lever, q in zip(row, imbalance, strict=True)), 0j) for row in self.levers)

    def result(self, names: Sequence[str], imbalance: Vector, rest: Sequence[float]) -> ToleranceResult:
        """Permitted imbalance, that now and that expected in the tolerance planes, by the names of the planes."""
        parts = {"": self.permitted, "_now": map(abs, self.transformed(imbalance)), "_rest": rest}
        values = {
            f"{'single_plane' if name == 'single' else name}{what}": value
            for what, planes in parts.items()
            for name, value in zip(names, planes, strict=True)
        }
        if self.planes == "correction planes":
            single = len(names) == 1
            rule = "all in the single plane" if single else "half in each plane, since the lengths are not known"
        elif self.overhung:
            rule = "lever rule, centre of mass outside the bearings, each share within 0.3 … 1.3 (unverified)"
        else:
            rule = "lever rule, each share within 0.3 … 0.7"
        return ToleranceResult(planes=self.planes, rule=rule, whole=self.whole, **values)

    def sizes(self, deltas: Iterable[Vector]) -> tuple[float, ...]:
        """Imbalances of the tolerance planes, rms over independent changes [kg m]."""
        moved = [self.transformed(delta) for delta in deltas]
        return tuple(size(each[plane] for each in moved) for plane in range(len(self.levers)))


def bearing_levers(lengths: tuple[float, float, float, float]) -> tuple[tuple[float, float], tuple[float, float]]:
    """Part of a force in the left and the right correction plane that each bearing carries.

    >>> bearing_levers((0.0, 0.5, 0.5, 0.0))
    ((1.0, 0.0), (0.0, 1.0))
    """
    a, b, c, d = lengths
    whole = a + b + c + d
    return (1 - a / whole, d / whole), (a / whole, 1 - d / whole)


def tolerance_of(file: ReadingsFile, speed: float) -> TolerancePlanes | None:
    """Tolerance planes of a file at the speed in service [rad/s]; None without a grade."""
    grade, rotor = file.tolerance.balance_grade, file.rotor
    if grade is None or rotor.mass_kg is None:
        return None
    whole = permissible_imbalance(grade, rotor.mass_kg, speed)
    if file.single_plane is not None:
        return TolerancePlanes(whole, (whole,), "correction planes", ((1.0,),))
    if rotor.lengths is None:
        return TolerancePlanes(whole, (whole / 2, whole / 2), "correction planes", ((1.0, 0.0), (0.0, 1.0)))
    a, b, c, d = rotor.lengths
    shares = tolerance_shares(whole, a + b, c + d)
    return TolerancePlanes(whole, shares, "bearing planes", bearing_levers(rotor.lengths), min(a + b, c + d) < 0)


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
