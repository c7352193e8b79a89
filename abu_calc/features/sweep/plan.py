"""Plan of a sweep from a file and a request: the variations, the design, the integrators.

`SweepRequest` is the table [sweep] of the file with the arguments that replace its entries. Two kinds of scatter are
there for every machine: its start-up (`of_starts`), and the drawing's tolerances and use (`of_tolerances`).
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

from abu_calc.features.spindle.case import SpindleDesign, size_races
from abu_calc.features.sweep.batches import TEMPERATURE
from abu_calc.features.sweep.samples import PHASE, Builds, Designs, Scenes, SpindleBuilds, SweepStudy, phase_keys
from abu_calc.features.sweep.sensitivity import Factor, Sample
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import in_file
from abu_calc.foundation.validity import Range
from abu_calc.inputs.autobalancer import Oil
from abu_calc.inputs.bearing_file import Limits
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.spindle import MOST_WHEELS
from abu_calc.inputs.variation import (
    MOST_RUNS,
    NOT_OF_THE_MACHINE,
    Sweep,
    Variants,
    Variation,
    canonical_key,
    path_of,
    variation,
    ways_of,
)  # fmt: skip
from abu_calc.inputs.variation import RUNS as USUAL
from abu_calc.simulation.arguments import one_of
from abu_calc.simulation.scene_file import SceneDescription, SceneFile
from abu_calc.simulation.scene_of_file import scene_from
from abu_calc.simulation.start_cases import KINDS
from abu_calc.sizing import size as sized
from abu_calc.sizing.design import Design

Vary = Mapping[str, Any] | Sequence[str] | None

RUNS: Final = Range("number of members", 1, MOST_RUNS, key="runs")
SEED: Final = Range("seed", 0, 2**31 - 1, key="seed")
TIME_LIMIT: Final = Range("time limit of a member", 0, 1e6, unit="s", open_low=True, key="time_limit_s")
SCHEMES: Final = ("latin-hypercube", "sobol")
WHAT: Final = ("build", "design")


@dataclass(frozen=True)
class SweepRequest:
    """A study of many machines, before it is known which values a file leaves to be drawn."""

    vary: tuple[tuple[str, Variation], ...]
    runs: int | None
    what: str
    tolerances: bool
    grid: tuple[str, str] | None
    sensitivity: bool
    sampling: str
    seed: int
    time_limit: float
    least_share: float | None
    of_table: dict[str, Place]
    """Keys that vary as the table of the file says, and where it does."""
    nothing: bool
    """True if neither the file nor arguments say what to vary."""


def asked(source: Machine | SceneDescription, vary: Vary, **options: Any) -> SweepRequest:
    """The table of the file, with the arguments that are not None in its place; keys of `vary` add to those there."""
    table = _given(source) or Sweep()
    chosen = {name: getattr(table, name) if options.get(name) is None else options[name] for name in NAMES}
    one_of("what", chosen["what"], WHAT)
    one_of("sampling", chosen["sampling"], SCHEMES)
    if chosen["runs"] is not None:
        RUNS.check(chosen["runs"])
    SEED.check(chosen["seed"])
    here = Place(source.file or None, source.lines.get("sweep.vary"), "sweep.vary")
    model = SceneFile if isinstance(source, SceneDescription) else type(source.tables)
    ways, given = ways_of(table.vary, model, here, EXAMPLE), ways_of(vary, model, Place(key="vary"), EXAMPLE)
    of_table = {f"vary {key}": replace(here, key=f"sweep.vary {key}") for key in ways if key not in given}
    ways |= given
    grid = chosen["grid"]
    nothing = not ways and all(options.get(name) is None for name in ("runs", "tolerances", "sensitivity", "seed"))
    return SweepRequest(
        vary=tuple(ways.items()),
        runs=chosen["runs"],
        what=chosen["what"],
        tolerances=chosen["tolerances"],
        grid=None if grid is None else (canonical_key(grid[0], model), canonical_key(grid[1], model)),
        sensitivity=chosen["sensitivity"],
        sampling=chosen["sampling"],
        seed=chosen["seed"],
        time_limit=TIME_LIMIT.check(chosen["time_limit_s"]),
        least_share=table.least_share,
        of_table=of_table,
        nothing=nothing and _given(source) is None,
    )


NAMES: Final = ("runs", "what", "tolerances", "grid", "sensitivity", "sampling", "seed", "time_limit_s")


def _given(source: Machine | SceneDescription) -> Sweep | None:
    if isinstance(source, SceneDescription):
        return source.sweep
    return (source.spindle or source.whole("sweep")).sweep


EXAMPLE: Final = "wheel.imbalance_g_mm=normal(265,40), in quotes"
DRAG_RATE: Final = "rolling_drag_per_s"
DRAG, WARMTH = f"autobalancer.{DRAG_RATE}", "start.temperature_C"
ECCENTRICITY: Final = "autobalancer.race_eccentricity_mm"
WARM: Final = 0.55
"""ln 3 / 2: drags of a third and of three times the one given, oil hot and cold, are two standard deviations off."""

SIDES: Final = 1.96
"""Standard deviations from the middle of an interval of 95 % to its end."""

GAUGE, BOTTOM = 0.010, 0.05
"""Half the spread [mm] of diameters in which balls are stocked (assumed), and of the race radius on the drawing."""
ROUGH, WORN, HELD = 0.5, 0.2, 0.2
"""Standard deviation of the logarithm (assumed): of the lever arm, which is 0.5 to 5 µm on hard races; of the imbalance
from wheel to wheel; of the frequencies of hands."""


def of_starts(machine: Machine, varied: frozenset[str], phases: Sequence[str] = ()) -> Iterator[tuple[str, Variation]]:
    """Start, unknown phases of imbalances, drag and the side to which races stand off, unless these vary as asked."""
    tables, races, turn = machine.spindle or machine.whole("sweep"), machine.autobalancers, "uniform(-180, 180)"
    ways = {"start.kind": f"choice({','.join(KINDS)})", "start.angle_deg": turn, **dict.fromkeys(phases, turn)}
    if not races or races[0].race_eccentricity_mm > 0 or ECCENTRICITY in varied:
        ways["start.eccentricity_deg"] = turn
    drags = {race.rolling_drag_per_s for race in races}
    if min(drags, default=0.0) > 0 and not any(key == WARMTH or key.endswith(DRAG_RATE) for key in varied):
        if tables.oil is None and len(drags) == 1:
            known = _identified(tables).get(DRAG_RATE, 0.0)
            ways[DRAG] = f"lognormal({drags.pop()!r}, {math.hypot(WARM, known) if known else WARM})"
        elif warmth := _warmth(tables.oil):
            ways[WARMTH] = warmth
    yield from _scatter_ways({key: way for key, way in ways.items() if key not in varied})


def _identified(tables: Any) -> dict[str, float]:
    """Standard deviation of the logarithm of identified values: their intervals hold 95 %."""
    known = {} if tables.identified is None else tables.identified.in_force(tables.autobalancer)
    return {key: max(math.log(high / low) / (2 * SIDES), 1e-6) for key, (low, high) in known.items()}


def _warmth(oil: Oil | None) -> str:
    """Scatter of the temperature of the oil [°C]: that of the file, or the usual one; empty if it has none."""
    if oil is None:
        return "triangular(15, 40, 70)"
    if oil.cold_temperature_C == oil.hot_temperature_C:
        return ""
    return f"triangular({oil.cold_temperature_C!r}, {oil.temperature_C!r}, {oil.hot_temperature_C!r})"


def of_tolerances(design: Design | SpindleDesign, *, building: bool) -> Iterator[tuple[str, Variation]]:
    """Balls and races as the drawing permits them; eccentricity, friction, wheels, hands and oil as is usual.

    `building`: the design is fixed; one that is made anew has no balls or race yet that could be off, and no start.
    """
    case, tables, made, ways = design.case, design.case.table, design.autobalancers, dict[str, str]()
    if building:
        key, diameter = in_file("autobalancer.ball_diameter_mm", made[0].ball_diameter)
        ways[key] = f"uniform({diameter - GAUGE!r}, {diameter + GAUGE!r})"
        for race, own in zip(case.race_keys, made, strict=True):
            key, radius = in_file(f"{race}.race_radius_mm", own.race_radius)
            ways[key] = f"uniform({radius - BOTTOM!r}, {radius + BOTTOM!r})"
        if warmth := _warmth(tables.oil):
            ways[WARMTH] = warmth
    if (off := case.autobalancer.race_eccentricity_mm) > 0:
        ways[ECCENTRICITY] = f"triangular(0, {off / 3!r}, {off!r})"
    if (arm := case.autobalancer.rolling_friction_mm) > 0:
        ways["autobalancer.rolling_friction_mm"] = f"lognormal({arm!r}, {ROUGH})"
    for key, spread in _identified(tables).items():
        value = getattr(case.autobalancer, key)
        if value > 0 and (building or key != DRAG_RATE):
            ways[f"autobalancer.{key}"] = f"lognormal({value!r}, {spread:.6g})"
    for wheel, imbalance in zip(case.wheel_keys, design.imbalances, strict=True):
        if imbalance > 0:
            key, usual = in_file(f"{wheel}.imbalance_g_mm", imbalance)
            ways[key] = f"lognormal({usual:.6g}, {WORN})"
    ways |= _hands(tables.suspension.frequencies)
    low, high = tables.machine.speeds_rpm
    if low < high:
        ways["machine.speed_rpm"] = f"uniform({low!r}, {high!r})"
    yield from _scatter_ways(ways)


def _hands(frequencies: tuple[float, float] | None) -> dict[str, str]:
    """The natural frequencies of springs that stand for hands; both alike where the file has both alike."""
    key = "suspension.natural_frequencies_hz"
    if frequencies is None:
        return {}
    if frequencies[0] == frequencies[1]:
        return {key: f"lognormal({frequencies[0]!r}, {HELD})"}
    return {f"{key}[{k}]": f"lognormal({frequency!r}, {HELD})" for k, frequency in enumerate(frequencies)}


def _scatter_ways(ways: dict[str, str]) -> Iterator[tuple[str, Variation]]:
    for key, text in ways.items():
        yield key, variation(text, Place(key=f"vary {key}"))


START: Final = "start."
OF_BUILD: Final = ("start.kind", "start.angle_deg", "start.eccentricity_deg", "start.temperature_C")
KEYS: Final = {
    "build": OF_BUILD,
    "design": (),
    "scene": ("start.angle_deg", "start.temperature_C"),
    "several races": (*OF_BUILD, *(PHASE.format(number) for number in range(1, MOST_WHEELS + 1))),
}
"""Keys of the start, which no file has."""
CHECKED: Final = 50
"""Listed values that are tried in the file before anything is computed."""
ROWS: Final = 64
"""Rows of Saltelli's matrices, if no number is given."""


@dataclass(frozen=True)
class Plan:
    """The study, and what there is to say of it before it begins."""

    study: SweepStudy
    content: dict[str, object]
    """Content of the file, with its overrides."""
    design: Design | None
    grid: tuple[str, str] | None
    warnings: tuple[str, ...]
    limits: Limits | None = None
    """Limits of the file; a scene has none."""


def planned(source: Machine | SceneDescription, ask: SweepRequest, accuracy: float) -> Plan:
    """The study of a file. Raises InputError for keys and values that the file does not bear."""
    try:
        return _planned(source, ask, accuracy)
    except InputError as error:
        if place := ask.of_table.get(error.place.key or ""):
            raise error.at(place) from None
        raise


def _planned(source: Machine | SceneDescription, ask: SweepRequest, accuracy: float) -> Plan:
    if isinstance(source, SceneDescription):
        return _of_scene(source, ask, accuracy)
    building, spindle = ask.what == "build", source.spindle
    tables = source.whole("sweep") if spindle is None else spindle
    with source.located():
        design = sized(tables) if isinstance(tables, MachineFile) else size_races(source)
    phases = phase_keys(design.case) if isinstance(design, SpindleDesign) else ()
    ways = dict(of_tolerances(design, building=building)) if ask.tolerances else {}
    ways |= dict(ask.vary)
    if building:
        ways |= dict(of_starts(source, frozenset(ways), phases))
    sample = _sample(ways, ask, "several races" if building and spindle is not None else ask.what)
    known = {key for key in ways if key.startswith(PHASE.partition("{")[0])} - set(phases)
    if known:
        raise InputError(
            "the phase of this imbalance is known, or it is the one that others are measured from",
            place=Place(key=f"vary {min(known)}"), allowed=", ".join(phases) or "none",
        )  # fmt: skip
    variants = Variants[Any].of(source, type(tables))
    warnings = _tried(variants, sample)
    study: SweepStudy
    if not building:
        study = Designs(sample, accuracy, ask.time_limit, source)
    elif isinstance(design, Design):
        study = Builds(sample, accuracy, ask.time_limit, variants, design)
    else:
        study = SpindleBuilds(sample, accuracy, ask.time_limit, variants, design)
    of_one = design if isinstance(design, Design) else None
    return Plan(study, variants.content, of_one, _grid(ask, sample), warnings, tables.limits)


def _of_scene(source: SceneDescription, ask: SweepRequest, accuracy: float) -> Plan:
    if ask.what == "design" or ask.tolerances:
        asked = "what" if ask.what == "design" else "tolerances"
        raise InputError("for machines only; a scene is given outright", place=Place(key=asked), remedy="Leave it out.")
    if not ask.vary:
        raise InputError(
            "nothing varies", place=Place(key="vary"), remedy='Give --vary "scene.speed_rpm=uniform(1000, 6000)".'
        )
    with source.located():
        scene_from(source.scene)
    variants, sample = Variants.of(source, SceneFile), _sample(dict(ask.vary), ask, "scene")
    warnings = _tried(variants, sample)
    study = Scenes(sample, accuracy, ask.time_limit, variants)
    return Plan(study, variants.content, None, _grid(ask, sample), warnings)


def _sample(ways: dict[str, Variation], ask: SweepRequest, what: str) -> Sample:
    """The factors, and how many members that makes."""
    factors = tuple(Factor(key, _path(key, what), way) for key, way in ways.items())
    if not factors:
        raise InputError("nothing varies", place=Place(key="vary"), remedy="Give --vary KEY=…, or --tolerances.")
    listed = [way.values for way in ways.values() if way.listed]
    points = Sample(factors, 1, ask.seed).points if listed else 0
    if points > MOST_RUNS:
        raise InputError("too many combinations of listed values", found=f"{points}", allowed=f"at most {MOST_RUNS}")
    if ask.sensitivity:
        base = 1 << max((ask.runs or ROWS) - 1, 1).bit_length()
        return Sample(factors, base * (len(factors) + 2), ask.seed, "saltelli", base)
    runs = ask.runs or points or USUAL
    if runs < points:
        raise InputError(
            "fewer members than combinations of listed values",
            place=Place(key="runs"),
            found=f"{runs}",
            allowed=f"at least {points}",
        )
    return Sample(factors, runs, ask.seed, "sobol" if ask.sampling == "sobol" else "latin-hypercube")


def _path(key: str, what: str) -> tuple[str | int, ...]:
    """Path of a key in the file; empty for a key of the start."""
    if key.startswith(START):
        if key not in KEYS[what]:
            known = ", ".join(KEYS[what]) or "none: each machine is judged from all of its starts"
            raise InputError("no such key of the start", place=Place(key=f"vary {key}"), allowed=known)
        return ()
    if key.split(".")[0] in NOT_OF_THE_MACHINE:
        raise InputError("no value of a machine", place=Place(key=f"vary {key}"))
    return path_of(key)


def _tried(variants: Variants[Any], sample: Sample) -> tuple[str, ...]:
    """Puts the ends of each value into the file, one at a time; notes of entries whose place they take."""
    notes: list[str] = []
    for factor in sample.factors:
        values = factor.variation.extremes
        step = max(1, len(values) // CHECKED)
        for value in (*values[::step], values[-1]):
            if factor.path:
                variants.table({factor.path: value})
            else:
                _check_start(factor.key, value)
        if factor.path:
            notes += variants.notes((factor.path,), (factor.variation.typical,))
    return tuple(dict.fromkeys(notes))


def _check_start(key: str, value: object) -> None:
    """A value of the start, which no file checks."""
    place = Place(key=f"vary {key}")
    if key == "start.kind":
        if value not in KINDS:
            raise InputError("no such start", place=place, found=f"{value}", allowed=", ".join(KINDS))
    elif isinstance(value, bool) or not isinstance(value, (int, float)):
        raise InputError("a number is expected", place=place, found=f"{value}")
    elif key == "start.temperature_C":
        TEMPERATURE.check(float(value))
    elif not -360 <= value <= 360:
        raise InputError("out of range", place=place, found=f"{value:g}°", allowed="-360 … 360")


def _grid(ask: SweepRequest, sample: Sample) -> tuple[str, str] | None:
    """The two keys of a chart, whose values are listed."""
    if ask.grid is None:
        return None
    listed = [factor.key for factor in sample.factors if factor.variation.listed]
    for key in ask.grid:
        if key not in listed:
            raise InputError(
                "a chart needs listed values of both keys",
                place=Place(key="grid"),
                found=key,
                allowed=", ".join(listed) or "none varies by a list",
                remedy=f"Give --vary {key}=LOW:HIGH:N.",
            )
    if ask.grid[0] == ask.grid[1]:
        raise InputError("a chart needs two keys", place=Place(key="grid"), found=ask.grid[0])
    return ask.grid
