"""Request of a sweep: the table [sweep] of the file, and the arguments that replace its entries."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

from abu_calc.errors import InputError, Place
from abu_calc.frozen import dataclass
from abu_calc.spec.read import Machine
from abu_calc.spec.read_scene import SceneDescription
from abu_calc.spec.sweep import MOST_RUNS, Sweep
from abu_calc.spec.variation import Variation, variation
from abu_calc.studies.arguments import one_of
from abu_calc.validity import Range

Vary = Mapping[str, Any] | Sequence[str] | None

RUNS: Final = Range("number of members", 1, MOST_RUNS, key="runs")
SEED: Final = Range("seed", 0, 2**31 - 1, key="seed")
TIME_LIMIT: Final = Range("time limit of a member", 0, 1e6, unit="s", open_low=True, key="time_limit_s")
SCHEMES: Final = ("latin-hypercube", "sobol")
WHAT: Final = ("build", "design")


@dataclass(frozen=True)
class Asked:
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


def asked(source: Machine | SceneDescription, vary: Vary, **options: Any) -> Asked:
    """The table of the file, with the arguments that are not None in its place; keys of `vary` add to those there."""
    table = _table(source)
    chosen = {name: getattr(table, name) if options.get(name) is None else options[name] for name in NAMES}
    one_of("what", chosen["what"], WHAT)
    one_of("sampling", chosen["sampling"], SCHEMES)
    if chosen["runs"] is not None:
        RUNS.check(chosen["runs"])
    SEED.check(chosen["seed"])
    here = Place(source.file or None, source.lines.get("sweep.vary"), "sweep.vary")
    ways, given = _ways(table.vary, here), _ways(vary, Place(key="vary"))
    of_table = {f"vary {key}": replace(here, key=f"sweep.vary {key}") for key in ways if key not in given}
    ways |= given
    nothing = not ways and all(options.get(name) is None for name in ("runs", "tolerances", "sensitivity", "seed"))
    return Asked(
        vary=tuple(ways.items()),
        runs=chosen["runs"],
        what=chosen["what"],
        tolerances=chosen["tolerances"],
        grid=None if chosen["grid"] is None else (chosen["grid"][0], chosen["grid"][1]),
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
    return source.sweep if isinstance(source, SceneDescription) else source.whole("sweep").sweep


def _table(source: Machine | SceneDescription) -> Sweep:
    return _given(source) or Sweep()


def _ways(vary: Vary, place: Place) -> dict[str, Variation]:
    """Variation of each key; a list has entries KEY=…, each key once."""
    if vary is None:
        return {}
    pairs = list(vary.items()) if isinstance(vary, Mapping) else [_pair(text, place) for text in vary]
    variations: dict[str, Variation] = {}
    for key, how in pairs:
        here = Place(place.file, place.line, f"{place.key} {key}")
        if key in variations:
            raise InputError("it varies twice", place=here, remedy="Give each key once.")
        variations[key] = variation(how, here)
    return variations


def _pair(text: object, place: Place) -> tuple[str, str]:
    key, equals, how = text.partition("=") if isinstance(text, str) else ("", "", "")
    if not equals or not key.strip():
        raise InputError(
            "not KEY=…", place=place, found=str(text), allowed="wheel.imbalance_g_mm=normal(265,40), in quotes"
        )
    return key.strip(), how.strip()
