"""The table [sweep] of a file: many machines like this one, and the variation of each value among them.

A variation is written as `LOW:HIGH:N`, a list, or a distribution; it is read here as it is written. `Variants` puts
values into a file again and again: the file is read once, its tables are checked each time.
"""

import copy
import re
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Annotated, Any, Final, Generic, Literal

from pydantic import BeforeValidator, ValidationError, WithJsonSchema

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.reading.document import Document, FileReading, Model
from abu_calc.inputs.reading.errors import Origin, input_error
from abu_calc.inputs.reading.overrides import Override, apply, parse_override
from abu_calc.inputs.reading.table import Many, Table, entry, problem
from abu_calc.inputs.reading.text import Part, key_path
from abu_calc.inputs.reading.values_with_units import canonical_path, convert, convert_entry, found_as, plain_number

GRAMMAR: Final = (
    "LOW:HIGH:N, a list A,B,…, uniform(LOW,HIGH), normal(MEAN,SD), lognormal(MEDIAN,SIGMA), triangular(LOW,MODE,HIGH), "
    "choice(A,B,…)"
)
COUNTS: Final = {"uniform": 2, "normal": 2, "lognormal": 2, "triangular": 3}
"""Numbers that each distribution takes."""
MOST_VALUES: Final = 100_000

_NUMBER: Final = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
_CALL: Final = re.compile(r"([A-Za-z_]+)\s*\((.*)\)", re.DOTALL)


@dataclass(frozen=True)
class Variation:
    """Variation of one value. `kind`: values (each in its turn), choice (one at random), or a distribution's name.

    `numbers` of a distribution; `values` of the other two; `text` as it was written.
    """

    kind: str
    numbers: tuple[float, ...]
    values: tuple[object, ...]
    text: str

    @property
    def listed(self) -> bool:
        """True if the values come each in its turn, so that they count samples."""
        return self.kind == "values"

    @property
    def extremes(self) -> tuple[object, ...]:
        """Values that a file must bear for all members to be right; of what has no bounds a typical one."""
        if self.values:
            return self.values
        return self.numbers[:1] if self.kind in ("normal", "lognormal") else (self.numbers[0], self.numbers[-1])

    @property
    def typical(self) -> object:
        """A value amid the others."""
        if self.values:
            return self.values[len(self.values) // 2]
        return self.numbers[0] if self.kind in ("normal", "lognormal") else sum(self.numbers) / len(self.numbers)


def variation(value: object, place: Place) -> Variation:
    """Variation of a value, given as text on the command line and in a file, or as a list of values.

    >>> variation("1:2:3", Place()).values
    (1.0, 1.5, 2.0)
    >>> variation("normal(265, 40)", Place()).numbers
    (265.0, 40.0)

    Raises InputError at that place.
    """
    if isinstance(value, (list, tuple)):
        return Variation("values", (), _several(tuple(value), place, value), ", ".join(map(str, value)))
    if not isinstance(value, str):
        raise InputError("not a way to vary a value", place=place, found=found_as(value), allowed=GRAMMAR)
    text = value.strip()
    if call := _CALL.fullmatch(text):
        return _distribution(call[1].lower(), call[2], text, place)
    if re.match(r"[A-Za-z_]+\s*\(", text):
        raise _refused(text, place, "a bracket is not closed")
    if text.count(":") == 2:
        return Variation("values", (), _spaced(text, place), text)
    if "," in text or _NUMBER.fullmatch(text):
        return Variation("values", (), _several(_listed(text, place), place, text), text)
    raise _refused(text, place)


def in_key_units(key: str, way: Variation, model: type[Table], place: Place) -> tuple[str, Variation]:
    """Key and variation with the file's own key and its unit: race_eccentricity=5 µm is race_eccentricity_mm=0.005."""
    path = path_of(key)
    done = [convert_entry(path, value, model, lambda _: place) for value in way.values]
    if not any(converted for *_, converted in done):
        return key, way
    if len({own for own, *_ in done}) > 1:
        raise InputError("a number without its unit in a list with units", place=place, found=way.text)
    values = tuple(value for _, value, _ in done)
    listed = ", ".join(map(str, values))
    return key_path(done[0][0]), replace(way, values=values, text=listed if way.listed else f"{way.kind}({listed})")


def ways_of(given: Any, model: type[Table], place: Place, example: str) -> dict[str, Variation]:
    """Variation by the file's own key, of KEY=HOW as on the command line, or of a table by key; each key once."""
    pairs = given.items() if isinstance(given, Mapping) else [_assigned(text, place, example) for text in given or ()]
    ways: dict[str, Variation] = {}
    for key, how in pairs:
        here = Place(place.file, place.line, f"{place.key} {key}")
        own, way = in_key_units(str(key), variation(how, here), model, here)
        if own in ways:
            raise InputError("the key stands twice", place=here, remedy="Give each key once.")
        ways[own] = way
    return ways


def _assigned(text: object, place: Place, example: str) -> tuple[str, str]:
    key, equals, how = text.partition("=") if isinstance(text, str) else ("", "", "")
    if not equals or not key.strip():
        raise InputError("not KEY=…", place=place, found=str(text), allowed=example)
    return key.strip(), how.strip()


def canonical_key(key: str, model: type[Table]) -> str:
    """The file's own key, however its unit is written; the key itself if the file has none like it."""
    own = canonical_path(path_of(key), model)
    return key if own in (None, path_of(key)) else key_path(own or ())


def _refused(
    text: str, place: Place, message: str = "not a way to vary a value", remedy: str | None = None
) -> InputError:
    return InputError(message, place=place, found=text or "nothing", allowed=GRAMMAR, remedy=remedy)


def _distribution(kind: str, inner: str, text: str, place: Place) -> Variation:
    if kind == "choice":
        return Variation("choice", (), _several(_listed(inner, place), place, text), text)
    if kind not in COUNTS:
        raise _refused(text, place, "an unknown distribution")
    numbers = tuple(_number(part, text, place) for part in inner.split(","))
    if len(numbers) != COUNTS[kind]:
        raise _refused(text, place, f"{kind} takes {COUNTS[kind]} numbers")
    if problem := CHECKS[kind](numbers):
        raise _refused(text, place, f"{kind}: {problem}")
    return Variation(kind, numbers, (), text)


def _ascending(numbers: Sequence[float]) -> str | None:
    rises = all(a <= b for a, b in pairwise(numbers)) and numbers[0] < numbers[-1]
    return None if rises else "its numbers must ascend"


def _spread(numbers: Sequence[float]) -> str | None:
    return None if numbers[1] >= 0 else "the standard deviation is negative"


def _scaled(numbers: Sequence[float]) -> str | None:
    return "the median must be above 0" if numbers[0] <= 0 else _spread(numbers)


CHECKS: Final[dict[str, Callable[[Sequence[float]], str | None]]] = {
    "uniform": _ascending,
    "normal": _spread,
    "lognormal": _scaled,
    "triangular": _ascending,
}


def _spaced(text: str, place: Place) -> tuple[object, ...]:
    """LOW:HIGH:N as N values, equally spaced, both ends among them; whole ones where all are."""
    low, high, many = text.split(":")
    first, last = _number(low, text, place), _number(high, text, place)
    if not re.fullmatch(r"\s*\d{1,9}\s*", many) or not 1 <= int(many) <= MOST_VALUES:
        raise _refused(text, place, f"N is a whole number from 1 to {MOST_VALUES}")
    count = int(many)
    if count == 1 and first != last:
        raise _refused(text, place, "one value cannot be both ends")
    values = [first + (last - first) * k / max(count - 1, 1) for k in range(count)]
    whole = all(re.fullmatch(r"\s*[+-]?\d+\s*", part) for part in (low, high)) and all(v == int(v) for v in values)
    return tuple(int(value) if whole else value for value in values)


def _listed(text: str, place: Place) -> tuple[object, ...]:
    """Values parted by commas, each typed as TOML; bare words are text."""
    return tuple(_one(part.strip(), text, place) for part in text.split(","))


def _one(part: str, text: str, place: Place) -> object:
    if not part:
        raise _refused(text, place, "a value is missing")
    try:
        return tomllib.loads(f"value = {part}")["value"]
    except (ValueError, RecursionError):  # no TOML, or brackets without end
        return part


def _several(values: tuple[object, ...], place: Place, given: object) -> tuple[object, ...]:
    """Values of a list, of which there are some, and finite."""
    for value in values:
        number = plain_number(value)
        if number is not None and not -1e300 < number < 1e300:
            raise InputError("a finite number is expected", place=place, found=found_as(value))
    if not values or len(values) > MOST_VALUES:
        raise InputError("the list has no values, or too many", place=place, found=found_as(given))
    return tuple(tuple(value) if isinstance(value, list) else value for value in values)


def _number(part: str, text: str, place: Place) -> float:
    try:
        number = float(part)
    except ValueError:
        raise _refused(text, place, f'"{part.strip()}" is no number') from None
    if not -1e300 < number < 1e300:
        raise _refused(text, place, "a finite number is expected")
    return number


MOST_RUNS: Final = 100_000_000
RUNS: Final = 100
"""Members where nothing says how many."""


def _by_key(value: object) -> object:
    """KEY=… as on the command line, a list of them, as a table by key."""
    if not isinstance(value, list) or not all(isinstance(entry, str) for entry in value):
        return value
    variations = {}
    for assignment in value:
        key, equals, how = assignment.partition("=")
        if not equals:
            raise problem("not KEY=…", found=assignment, allowed='"wheel.imbalance_g_mm=normal(265, 40)"')
        variations[key.strip()] = how.strip()
    return variations


def _texts(value: object) -> object:
    """Ways to vary are texts or lists of values; what each says is read where it is used."""
    for key, how in value.items() if isinstance(value, dict) else ():
        if not isinstance(how, (str, list)) or plain_number(how) is not None:
            raise problem("text or a list of values is expected", key, found=str(how), allowed='"normal(265, 40)"')
    return value


Vary = Annotated[
    dict[str, str | list[object]],
    BeforeValidator(_texts),
    BeforeValidator(_by_key),
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "object", "additionalProperties": {"anyOf": [{"type": "string"}, {"type": "array"}]}},
                {"type": "array", "items": {"type": "string"}},
            ]
        }
    ),
]


class Sweep(Table):
    """Many machines like this one, for `abu sweep`: what varies among them, and how many there are."""

    vary: Vary | None = entry(None, example=["autobalancer.race_eccentricity_mm=triangular(0, 0.005, 0.015)"]).means(
        "Distributions. Each is KEY=HOW. HOW: LOW:HIGH:N, A,B,…, uniform(LOW, HIGH), normal(MEAN, SD), "
        "lognormal(MEDIAN, SIGMA), triangular(LOW, MODE, HIGH) or choice(A, B, …). KEY is one of this file, or "
        "start.kind, start.angle_deg, start.eccentricity_deg, start.temperature_C. Or a table by key."
    )
    runs: int | None = entry(None, ge=1, le=MOST_RUNS, example=1000).means(
        f"Number of samples; {{range}}. Without it as many as there are combinations of listed values, or {RUNS}."
    )
    what: Literal["build", "design"] = entry("build").means(
        "build: the design is fixed, each member is one machine built and switched on once; design: it is sized anew "
        "for each. Default: {default}."
    )
    tolerances: bool = entry(False).means(
        "true: also the drawing's own tolerances and the usual scatter of use. Default: {default}."
    )
    grid: Many[str] | None = entry(
        None, example=["wheel.imbalance_g_mm", "machine.speed_rpm"], min_length=2, max_length=2
    ).means("Two of the keys with listed values, for a chart over them: across and upward.")
    sensitivity: bool = entry(False).means(
        "true: spend the runs that a Saltelli design needs on sensitivities. Default: {default}."
    )
    sampling: Literal["latin-hypercube", "sobol"] = entry("latin-hypercube").means(
        "Sampling method: latin-hypercube or sobol. Default: {default}."
    )
    seed: int = entry(0, ge=0, le=2**31 - 1).means("Seed of the random numbers; {range}. Default: {default}.")
    time_limit_s: float = entry(60.0, gt=0, le=1e6).means(
        "Longest time for one member [s]; {range}. Default: {default}; the next one follows."
    )
    least_share: float | None = entry(None, ge=0, le=1, example=0.95).means(
        "Share of samples that must meet the limits; {range}. Without it nothing is asked."
    )


VARIED = "vary {}"
"""Name in messages of a value that a sweep gave."""


NOT_OF_THE_MACHINE: Final = ("sweep", "optimise", "costs", "expected")
"""Tables that say nothing of the machine itself."""


RACES: Final = "autobalancer"
"""Table of a race, or list of several."""


@dataclass(frozen=True)
class Variants(Generic[Model]):
    """A file with its overrides put in, as data that processes can hand on; `model`: its tables."""

    content: dict[str, object]
    model: type[Model]

    @classmethod
    def of(cls, reading: FileReading, model: type[Model]) -> "Variants[Model]":
        """Variants of a file that was read, without the tables that say nothing of the machine."""
        content = cls.whole(reading, model).content
        return cls({name: table for name, table in content.items() if name not in NOT_OF_THE_MACHINE}, model)

    @classmethod
    def whole(cls, reading: FileReading, model: type[Model]) -> "Variants[Model]":
        """All entries of a file that are in force, in the units of the keys."""
        content = reading.document.content
        convert(content, model, lambda path: Place(reading.file, key=key_path(path)))
        apply(content, reading.overrides, model)
        return cls(content, model)

    def table(self, values: Mapping[tuple[Part, ...], object]) -> Model:
        """The tables with these values. Raises InputError that names the key."""
        overrides = self._put_in(values.items())
        content = copy.deepcopy(self.content)
        apply(content, overrides, self.model)
        try:
            return self.model.model_validate(content)
        except ValidationError as error:
            options = {override.path: override.option for override in overrides}
            raise input_error(error, Origin("", content, {}, options, self.model)) from None

    def notes(self, paths: "tuple[tuple[Part, ...], ...]", values: tuple[object, ...]) -> list[str]:
        """Entries of the file whose place the values take, in words."""
        return apply(copy.deepcopy(self.content), self._put_in(zip(paths, values, strict=True)), self.model)

    def _put_in(self, values: Iterable[tuple[tuple[Part, ...], object]]) -> list[Override]:
        races = self.content.get(RACES)
        return [Override(own, value, VARIED) for path, value in values for own in in_all_races(path, races)]


def in_all_races(path: tuple[Part, ...], races: object) -> list[tuple[Part, ...]]:
    """The paths of a key in each of several [[autobalancer]], unless it names one of them; else the path itself."""
    whole = path[0] != RACES or len(path) < 2 or isinstance(path[1], int)
    if whole or not isinstance(races, (list, tuple)) or len(races) < 2:
        return [path]
    return [(RACES, number, *path[1:]) for number in range(len(races))]


def path_of(key: str) -> tuple[Part, ...]:
    """The path of a key as TOML writes it. Raises InputError for what is none.

    >>> path_of("suspension.natural_frequencies_hz[0]")
    ('suspension', 'natural_frequencies_hz', 0)
    """
    try:
        return parse_override(f"{key}=0").path
    except InputError as error:
        raise error.at(error.place) from None


__all__ = ["Document", "Variants", "path_of"]
