"""Study to compute, planned from a file and a request: the variations, the design, the integrators."""

from typing import Final

from abu_calc.analysis.sampling import Factor, Sample
from abu_calc.errors import InputError, Place
from abu_calc.formulas.oil import TEMPERATURE
from abu_calc.frozen import dataclass
from abu_calc.scenes.from_scene import scene_from
from abu_calc.scenes.switched_on import KINDS
from abu_calc.sizing import size as sized
from abu_calc.sizing.design import Design
from abu_calc.spec.machine import MachineFile
from abu_calc.spec.read import Machine
from abu_calc.spec.read_scene import SceneDescription
from abu_calc.spec.scene import SceneFile
from abu_calc.spec.sweep import MOST_RUNS
from abu_calc.spec.sweep import RUNS as USUAL
from abu_calc.spec.variants import Variants, path_of
from abu_calc.spec.variation import Variation
from abu_calc.studies.sweeping.asked import Asked
from abu_calc.studies.sweeping.members import Builds, Designs, Scenes, Study
from abu_calc.studies.sweeping.scatter import of_starts, of_tolerances

START: Final = "start."
KEYS: Final = {
    "build": ("start.kind", "start.angle_deg", "start.eccentricity_deg", "start.temperature_C"),
    "design": (),
    "scene": ("start.angle_deg", "start.temperature_C"),
}
"""Keys of the start, which no file has."""
CHECKED: Final = 50
"""Listed values that are tried in the file before anything is computed."""
ROWS: Final = 64
"""Rows of Saltelli's matrices, if no number is given."""


@dataclass(frozen=True)
class Plan:
    """The study, and what there is to say of it before it begins."""

    study: Study
    content: dict[str, object]
    """Content of the file, with its overrides."""
    design: Design | None
    grid: tuple[str, str] | None
    warnings: tuple[str, ...]


def planned(source: Machine | SceneDescription, ask: Asked, accuracy: float) -> Plan:
    """The study of a file. Raises InputError for keys and values that the file does not bear."""
    try:
        return _planned(source, ask, accuracy)
    except InputError as error:
        if place := ask.of_table.get(error.place.key or ""):
            raise error.at(place) from None
        raise


def _planned(source: Machine | SceneDescription, ask: Asked, accuracy: float) -> Plan:
    if isinstance(source, SceneDescription):
        return _of_scene(source, ask, accuracy)
    tables = source.whole("sweep")
    with source.located():
        design = sized(tables)
    variants = Variants.of(source, MachineFile)
    building = ask.what == "build"
    ways = dict(of_tolerances(design, building=building)) if ask.tolerances else {}
    ways |= dict(ask.vary)
    if building:
        ways |= dict(of_starts(tables, frozenset(ways)))
    sample = _sample(ways, ask, ask.what)
    warnings = _tried(variants, sample)
    if not building:
        return Plan(
            Designs(sample, accuracy, ask.time_limit, source), variants.content, design, _grid(ask, sample), warnings
        )
    study = Builds(sample, accuracy, ask.time_limit, variants, design)
    return Plan(study, variants.content, design, _grid(ask, sample), warnings)


def _of_scene(source: SceneDescription, ask: Asked, accuracy: float) -> Plan:
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


def _sample(ways: dict[str, Variation], ask: Asked, what: str) -> Sample:
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
    if key.split(".")[0] in ("sweep", "expected"):
        raise InputError("no value of a machine", place=Place(key=f"vary {key}"))
    return path_of(key)


def _tried(variants: Variants[MachineFile] | Variants[SceneFile], sample: Sample) -> tuple[str, ...]:
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


def _grid(ask: Asked, sample: Sample) -> tuple[str, str] | None:
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
