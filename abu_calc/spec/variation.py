"""Variation of a value among the samples of a sweep: `LOW:HIGH:N`, a list, or a distribution.

The module reads it as it is written.
"""

import re
import tomllib
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Final

from abu_calc.errors import InputError, Place
from abu_calc.frozen import dataclass
from abu_calc.spec.plain import found_as, plain_number

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
    """How one value varies. `kind`: values (each in its turn), choice (one at random), or a distribution's name.

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
