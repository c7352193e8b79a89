"""Velocity levels of a motion by octaves, weighted overall level and weighted acceleration, axis by axis.

The motion is a recording, or a simulated one: at the axis of a scene, or where a machine is held.

Checks of levels against limits, and loads on each hand of a machine that is held still in the air.

Limits: octaves, the weighted overall level (GOST 17770-86) and the daily exposure (Directive 2002/44/EC).
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Annotated, ClassVar, Final, Generic, TypeVar

import numpy as np

from abu_calc.dynamics.scene import Scene
from abu_calc.features.levels.octaves import (
    LEAST,
    RAMP,
    SETTLED,
    Array,
    AxisSignal,
    acceleration_filter,
    band_rms,
    hand_arm_filter,
    octave_filter,
    place_filter,
    weighted_rms,
    why_not,
)
from abu_calc.formulas.rigid_body import Vector
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import GRAVITY, level_from_velocity
from abu_calc.simulation.simulate import Simulation
from abu_calc.sizing.design import Design
from abu_calc.standards.vibration import (
    Octave,
    ThirdOctave,
    corrected_limit,
    daily_exposure,
    exposure_action_value,
    exposure_limit_value,
    hand_arm_response,
    largest_total_of_one_axis,
    octaves,
    third_octaves,
)

ENDS: Final = 0.1
"""Share of a record at either end over which its mean rises and falls: parts of periods count for less."""


Width = TypeVar("Width", Octave, ThirdOctave)


@dataclass(frozen=True)
class Band(Generic[Width]):
    """Rms velocity [m/s] in an octave or a third octave; None with the reason why it is not known."""

    octave: Width
    velocity: float | None
    reason: str | None = None


@record
class AxisLevel(Record):
    """One axis of a place."""

    left_out: ClassVar[frozenset[str]] = frozenset({"bands", "thirds", "reason"})
    optional: ClassVar[frozenset[str]] = frozenset({"third_octave_levels_db"})

    bands: tuple[Band[Octave], ...]
    thirds: tuple[Band[ThirdOctave], ...]
    reason: str | None
    """Reason why displacement and accelerations are not known."""
    name: Annotated[str, Quantity("axis")]
    level_db: Annotated[float | None, Quantity("level", "L")]
    velocity_rms: Annotated[float | None, Quantity("velocity rms", "v", unit="mm_per_s")]
    octave_levels_db: Annotated[tuple[float | None, ...], Quantity("octaves 8 … 1000 Hz", "L")]
    third_octave_levels_db: Annotated[
        tuple[float | None, ...] | None, Quantity("third octaves 6.3 … 1250 Hz", "L", 4, "with --third-octaves")
    ]
    displacement_rms: Annotated[float | None, Quantity("displacement rms", "s_v", 3, unit="um")]
    acceleration: Annotated[float | None, Quantity("acceleration", "a", 3, "rms, not weighted", unit="m_per_s2")]
    weighted_acceleration: Annotated[float | None, Quantity("weighted acceleration", "a_h", 3, unit="m_per_s2")]

    @property
    def corrected(self) -> float | None:
        """Corrected rms velocity [m/s] of the octaves that are known; None where none is."""
        parts = [band.octave.share * band.velocity for band in self.bands if band.velocity is not None]
        return math.hypot(*parts) if parts else None


def axis_level(
    name: str, velocity: float | None, bands: tuple[Band[Octave], ...], displacement: float | None,
    acceleration: float | None, weighted: float | None, reason: str | None = None,
    thirds: tuple[Band[ThirdOctave], ...] = (),
) -> AxisLevel:  # fmt: skip
    """One axis, rms: velocity of the whole motion [m/s], by octaves; displacement [m], acceleration [m/s²] and weighted
    acceleration a_h [m/s²] within 6 to 1260 Hz, as instruments take them; None with the reason. `thirds`: velocity by
    third octaves, if they are asked for.
    """
    return AxisLevel(
        bands=bands, thirds=thirds, reason=reason, name=name, level_db=level(velocity), velocity_rms=velocity,
        octave_levels_db=tuple(level(band.velocity) for band in bands),
        third_octave_levels_db=tuple(level(band.velocity) for band in thirds) or None,
        displacement_rms=displacement, acceleration=acceleration, weighted_acceleration=weighted,
    )  # fmt: skip


@dataclass(frozen=True)
class PlaceLevels:
    """The axes of one place."""

    name: str
    axes: tuple[AxisLevel, ...]

    @property
    def velocity(self) -> float | None:
        """Rms of the louder axis [m/s]."""
        return largest(axis.velocity_rms for axis in self.axes)

    @property
    def corrected(self) -> float | None:
        """Weighted velocity of the axis where it is largest [m/s]."""
        return largest(axis.corrected for axis in self.axes)

    @property
    def total(self) -> float | None:
        """a_hv [m/s²]: vector sum of the weighted accelerations of the axes that there are."""
        parts = [axis.weighted_acceleration for axis in self.axes if axis.weighted_acceleration is not None]
        return math.hypot(*parts) if len(parts) == len(self.axes) else None

    def louder(self, part: str) -> float | None:
        """The largest of the axes: displacement_rms, acceleration or weighted_acceleration."""
        return largest(getattr(axis, part) for axis in self.axes)

    @property
    def complete(self) -> bool:
        """True if every octave is known."""
        return all(band.velocity is not None for axis in self.axes for band in axis.bands)

    @property
    def loudest(self) -> tuple[Band[Octave], ...]:
        """Each octave on the axis where it is loudest."""
        return _loudest([axis.bands for axis in self.axes])

    @property
    def loudest_thirds(self) -> tuple[Band[ThirdOctave], ...]:
        """Each third octave on the axis where it is loudest."""
        return _loudest([axis.thirds for axis in self.axes])


def _loudest(axes: Sequence[tuple[Band[Width], ...]]) -> tuple[Band[Width], ...]:
    return tuple(max(bands, key=lambda band: band.velocity or -1.0) for bands in zip(*axes, strict=True))


def largest(values: Iterable[float | None]) -> float | None:
    """Largest of the known values; None if there is none."""
    return max((value for value in values if value is not None), default=None)


def level(velocity: float | None) -> float | None:
    """The level [dB] of an rms velocity; None where there is none."""
    return level_from_velocity(velocity) if velocity else None


def axis_levels(name: str, signal: AxisSignal, *, thirds: bool = False) -> AxisLevel:
    """Levels of a signal along one axis, and by third octaves if they are asked for.

    The whole velocity is the rms about the mean from the signal's start on; for accelerations it is that of
    the octaves.
    """
    bands = tuple(_band(signal, octave) for octave in octaves())
    wide = place_filter(), acceleration_filter(), hand_arm_filter()
    reason = why_not(signal, wide[0])
    place, acceleration, weighted = (band_rms(signal, weighting) if reason is None else None for weighting in wide)
    narrow = tuple(_band(signal, third) for third in third_octaves()) if thirds else ()
    return axis_level(name, _whole(signal, bands), bands, place, acceleration, weighted, reason, narrow)


def _band(signal: AxisSignal, octave: Width) -> Band[Width]:
    band = octave_filter(octave)
    reason = why_not(signal, band)
    return Band(octave, band_rms(signal, band) if reason is None else None, reason)


def _whole(signal: AxisSignal, bands: Sequence[Band[Octave]]) -> float | None:
    """Rms velocity [m/s]; of places by a spline of the fifth degree, its slope within 0.1 % at 8 samples a turn."""
    first = min(math.ceil(signal.start * signal.rate), len(signal.samples) - 2)
    if signal.derivative == 1:
        known = [band.velocity for band in bands if band.velocity is not None]
        return math.hypot(*known) if known else None
    values = np.asarray(signal.samples, dtype=float)
    if signal.derivative == -1:
        if len(values) < 8:
            return None
        from scipy.interpolate import make_interp_spline

        values = make_interp_spline(np.arange(len(values)), values, k=5).derivative()(np.arange(len(values)))
        values = values * signal.rate
    # A simulated window is of few turns, all alike.
    return weighted_rms(values[first:], 0.5 if signal.whole and signal.start else ENDS)


def halves_differ(signal: AxisSignal) -> float | None:
    """Level of the second half of the averaged signal over the first half [dB]; None if a half is silent."""
    values = np.asarray(signal.samples[math.ceil(signal.start * signal.rate) :], dtype=float)
    first, second = (float(np.std(half)) for half in np.array_split(values, 2))
    return 20 * math.log10(second / first) if first > 0 and second > 0 else None


def carried(place: PlaceLevels, name: str, share: float) -> PlaceLevels:
    """The levels of another place, which moves `share` times as much."""
    axes = tuple(_each(axis, lambda value, _: share * value) for axis in place.axes)
    return PlaceLevels(name, axes)


def with_tone(place: PlaceLevels, velocity: float, weight: float, frequency: float) -> PlaceLevels:
    """The levels with a tone of a frequency [rad/s] added as energy to every axis: rms velocity [m/s], `weight` W_h."""
    parts = {
        "velocity": velocity,
        "displacement": velocity / frequency,
        "acceleration": velocity * frequency,
        "weighted": weight * velocity * frequency,
    }

    def added(value: float, part: str | Octave | ThirdOctave) -> float:
        if not isinstance(part, str):
            return math.hypot(value, velocity if part.low <= frequency < part.high else 0.0)
        return math.hypot(value, parts[part])

    return PlaceLevels(place.name, tuple(_each(axis, added) for axis in place.axes))


def _each(axis: AxisLevel, change: Callable[[float, str | Octave | ThirdOctave], float]) -> AxisLevel:
    """An axis with all that is known of it changed."""

    def changed(value: float | None, part: str | Octave | ThirdOctave) -> float | None:
        return None if value is None else change(value, part)

    bands = tuple(replace(band, velocity=changed(band.velocity, band.octave)) for band in axis.bands)
    thirds = tuple(replace(band, velocity=changed(band.velocity, band.octave)) for band in axis.thirds)
    return axis_level(
        axis.name, changed(axis.velocity_rms, "velocity"), bands, changed(axis.displacement_rms, "displacement"),
        changed(axis.acceleration, "acceleration"), changed(axis.weighted_acceleration, "weighted"), axis.reason,
        thirds,
    )  # fmt: skip


SLOWEST: Final = 4096.0
"""Samples a second at least: enough for all octaves."""
PER_REVOLUTION: Final = 40
LAST: Final = 0.95
"""Share of a run from which on means are taken: the amplitude window is the last twentieth."""


def duration_for(scene: Scene) -> float:
    """Time [s] to simulate so that every octave of the motion left after the scene's own time is known."""
    return scene.duration + LEAST * _slowest_period()


def times_for(scene: Scene) -> Array:
    """Equally spaced times [s] of a run, often enough for its fastest octave and its revolutions; as much of its end
    as the slowest octave asks for.
    """
    rate, end, period = max(SLOWEST, PER_REVOLUTION / scene.revolution), scene.duration, _slowest_period()
    begin = max(0.0, min(LAST * end, end - 2 * RAMP * period) - SETTLED * period)
    return np.linspace(begin, end, math.ceil((end - begin) * rate) + 1)


def _slowest_period() -> float:
    return 2 * math.pi / octaves()[0].centre


def axis_place_levels(run: Simulation, times: Array, name: str, *, thirds: bool = False) -> PlaceLevels:
    """Levels of the axis along x and y, from the states of a run sampled at these times."""
    velocities = run.scene.axis_velocity(run.trajectory.at(times))
    rate, start = (len(times) - 1) / float(times[-1] - times[0]), LAST * run.scene.duration - float(times[0])
    signals = [AxisSignal(np.asarray(values), rate, 0, start, whole=True) for values in velocities]
    return PlaceLevels(
        name, tuple(axis_levels(x, signal, thirds=thirds) for x, signal in zip("xy", signals, strict=True))
    )


def held_levels(design: Design, at_race: PlaceLevels) -> tuple[PlaceLevels, ...]:
    """Levels at the handles, or in the wheel plane, carried there from the race as by a free rigid body.

    Balls in another plane than the imbalance leave a tone of the spindle. It is added as energy, as in
    sizing. The background is left out, since its octaves are not known.
    """
    return tuple(moved_at(design, at_race, held.name, held.place) for held in design.case.places)


def moved_at(design: Design, at_race: PlaceLevels, name: str, place: Vector) -> PlaceLevels:
    """Levels at one place [m] from the centre of mass, computed like `held_levels`.

    Its z axis, if it moves, has the spectrum of the race's x axis.
    """
    case, added = design.case, design.autobalancer.mass
    body, race = case.body, case.race_place
    imbalance, balls = design.imbalance.value, design.imbalance.value * design.autobalancer.requirement.plane_ratio
    by_race = body.body.acceleration(place, race, added=added)
    by_wheel = body.body.acceleration(place, body.wheel, added=added)
    sources = (*at_race.axes, at_race.axes[0])
    axes = list[AxisLevel]()
    for axis, source, at, wheel in zip("xyz", sources, by_race, by_wheel, strict=True):
        share, rest = abs(at) / body.inertance(race, race, added), abs(imbalance * wheel - balls * at)
        if axis == "z" and not share:
            continue
        moved = carried(PlaceLevels(name, (replace(source, name=axis),)), name, share)
        tone = rest * case.speed / math.sqrt(2)
        axes += (with_tone(moved, tone, abs(hand_arm_response(1j * case.speed)), case.speed) if tone else moved).axes
    return PlaceLevels(name, tuple(axes))


SAY_UNIT: Final = "Say the unit: --scale 9.80665 for numbers in g, --scale 1 for SI."
LONGER: Final = "Record for longer, or sample faster."


def level_checks(places: Sequence[PlaceLevels], minutes: float | None, assumed: str = "") -> tuple[Check, ...]:
    """Checks of the loudest place: each octave, the weighted overall level, and the daily exposure.

    The daily exposure is checked if its minutes are given; `assumed`: a unit that nothing in the file tells.
    """
    octaves = (_octave(places, index) for index in range(len(places[0].loudest)))
    exposure = [] if minutes is None else [_exposure(places, minutes)]
    unit = [coded("ABU414", "warn", assumed.partition(";")[0], remedy=SAY_UNIT)] if assumed else []
    return (*octaves, _corrected(places), *exposure, *unit)


def _octave(places: Sequence[PlaceLevels], index: int) -> Check:
    place, band = max(((point, point.loudest[index]) for point in places), key=lambda pair: pair[1].velocity or -1.0)
    name, limit = f"{band.octave.nominal:g} Hz", band.octave.limit.level
    if band.velocity is None:
        return coded("ABU411", "not-done", band.reason or "not known", None, limit, LONGER, of=name)
    actual = level(band.velocity)
    kept = actual is None or actual <= limit
    return coded("ABU411", verdict(kept), f"rms velocity, {_axis_of(place, band, index)}", actual, limit, of=name)


def _axis_of(place: PlaceLevels, band: Band[Octave], index: int) -> str:
    axis = next(candidate for candidate in place.axes if candidate.bands[index] is band)
    return axis.name if place.name == axis.name or len(place.axes) == 1 else f"{place.name}, {axis.name}"


def _corrected(places: Sequence[PlaceLevels]) -> Check:
    """A total that lacks octaves is at least so high: it can fail, not pass."""
    limit, total_level = corrected_limit().level, level(largest(place.corrected for place in places))
    if total_level is not None and total_level > limit:
        return coded("ABU412", "fail", "all octaves together, 8 Hz at half its velocity", total_level, limit)
    if not all(place.complete for place in places):
        return coded("ABU412", "not-done", "octaves are missing", total_level, limit, LONGER)
    return coded("ABU412", "pass", "all octaves together, 8 Hz at half its velocity", total_level, limit)


def _exposure(places: Sequence[PlaceLevels], minutes: float) -> Check:
    """Against the limit; a warning above the action value, or where axes that were not measured leave it open."""
    limit, action = exposure_limit_value(), exposure_action_value()
    totals = [place.total for place in places]
    largest_total = largest(totals)
    if largest_total is None or None in totals:
        reason = next(axis.reason for place in places for axis in place.axes if axis.weighted_acceleration is None)
        return coded("ABU413", "not-done", reason or "not known", None, limit, LONGER)
    exposure = daily_exposure(largest_total, 60 * minutes)
    highest = daily_exposure(max(map(_highest_total, places)), 60 * minutes)
    message = f"A(8) of {minutes:g} minutes a day; the action value is {action:g} m/s²"
    if highest > exposure * (1 + 1e-9):
        message += f"; axes that were not measured may raise it to {highest:.3g} m/s²"
    passed, safe = exposure <= limit, highest <= action
    reach = min(minutes * (action / exposure) ** 2, 1440.0) if exposure > 0 else 1440.0
    remedy = None
    if exposure > action:
        remedy = f"Limit the use to {reach:.3g} minutes a day: A(8) falls from {exposure:.3g} to {action:g} m/s² "
        remedy += "(calculated)."
    return coded("ABU413", verdict(passed, safe), message, exposure, limit, remedy)


def _highest_total(place: PlaceLevels) -> float:
    """The most that three axes can come to where fewer were measured, none of the others above these."""
    parts = [axis.weighted_acceleration or 0.0 for axis in place.axes]
    if len(parts) == 1:
        return largest_total_of_one_axis() * parts[0]
    return math.hypot(*parts, max(parts)) if len(parts) == 2 else math.hypot(*parts)


def held_loads(design: Design) -> dict[str, tuple[float, float]]:
    """Static load [N] of the hand at each handle, without and with the autobalancer, upward; negative: it must press
    down. Empty if the lever of two handles does not give it.

    The machine's centre of mass may lie between or outside the handles. Equilibrium of a horizontal
    spindle: F₁ + F₂ = (M + m)g, F₁p₁ + F₂p₂ = m·g·a_r, places from the centre of mass of machine and wheel,
    the autobalancer in the plane of its race. One handle carries all; three are statically indeterminate.
    """
    case, added = design.case, design.autobalancer.mass
    handles = case.handles
    if len(handles) == 1:
        return {handles[0].name: (case.body.mass * GRAVITY, (case.body.mass + added) * GRAVITY)}
    known = case.table.machine.spindle_axis == "horizontal" and case.body.is_rigid and not case.body.in_space
    if len(handles) != 2 or not known or handles[0].place[2] == handles[1].place[2]:
        return {}
    first, second = handles
    at, other = first.place[2], second.place[2]
    span = at - other

    def share(mass: float) -> tuple[float, float]:
        weight, moment = (case.body.mass + mass) * GRAVITY, mass * GRAVITY * case.race_place[2]
        at_first = (moment - weight * other) / span
        return at_first, weight - at_first

    loads = zip(share(0.0), share(added), strict=True)
    return {handle.name: load for handle, load in zip(handles, loads, strict=True)}
