"""Result of `abu optimise`: the front of cost against share, the recommended design, runners-up.

Text of a machine file with the values of a design; comments stay where the text can be edited line by line.

Candidates: all combinations of the options, sized, priced, and without those that closed forms rule out.
"""

import copy
import re
import tomllib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import Annotated, Any, ClassVar, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.optimise.choices import (
    COUNT,
    DIAMETER,
    RADIUS,
    SHARED,
    SIZED,
    Assignment,
    Choice,
    CostEntry,
    Values,
    cost_of,
    sized_values,
)
from abu_calc.foundation.checks import CHECK_CODES
from abu_calc.foundation.errors import AbuError, InputError, Place
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.reading.overrides import Override, apply, overrides_of
from abu_calc.inputs.reading.table import table_at
from abu_calc.inputs.reading.text import shown
from abu_calc.inputs.reading.values_with_units import canonical_keys
from abu_calc.simulation.result import Result
from abu_calc.sizing import size as sized

MOST_CANDIDATES: Final = 20_000
"""Combinations of variants of several machines."""
GEOMETRY: Final = "geometry"
"""Reason of a combination that no geometry allows, beside the codes of checks."""


@record
class RuledOut(Record):
    """Combinations that a closed form rules out."""

    code: Annotated[str, Quantity("check")]
    name: Annotated[str, Quantity("name")]
    combinations: Annotated[int, Quantity("combinations")]


class DesignVariant(NamedTuple):
    """One machine of the series built to one choice: all its chosen and sized values, and their cost."""

    machine: int
    values: Values
    cost: float


class SearchSpace(NamedTuple):
    """Variants of all machines, and candidates as rows of one variant for each machine, with their costs.

    `ruled_out`: combinations without a candidate, by the check that fails; `considered`: all combinations.
    `failing`: checks that every combination fails, which therefore rule out nothing.
    """

    variants: tuple[DesignVariant, ...]
    rows: NDArray[np.int64]
    costs: NDArray[np.float64]
    keys: tuple[str, ...]
    ruled_out: tuple[RuledOut, ...]
    considered: int
    failing: tuple[str, ...]


class _Sized(NamedTuple):
    values: Values
    failing: frozenset[str]


def search_space(
    machines: Sequence[Machine], options: Sequence[tuple[Choice, ...]], parts: Sequence[str], places: Sequence[Place]
) -> SearchSpace:
    """Every combination of the options of each machine that closed forms permit, and all ways to combine machines."""
    reasons: Counter[str] = Counter()
    considered, variants = 0, list[DesignVariant]()
    always: set[str] = set()
    shared = {key for part in parts for key in SHARED[part]} if len(machines) > 1 else set()
    all_sized = [list(_all_sized(machine, its)) for machine, its in zip(machines, options, strict=True)]
    if shared & set(SIZED):
        chosen = {key for its in options for option in its for assignment in option.values for key in assignment}
        all_sized = _with_shared_sizes(machines, all_sized, shared, chosen)
    for number, (machine, entries) in enumerate(zip(machines, all_sized, strict=True)):
        considered += len(entries)
        possible, failing = _possible(entries)
        always |= failing
        reasons.update(min(entry.failing - failing) for entry in entries if entry.failing - failing)
        if not possible:
            raise InputError(
                "no combination of these values can be built", place=places[number],
                remedy=f"Permit other values, or run `abu size {machine.file or 'FILE'}`.",
            )  # fmt: skip
        given = machine.whole("optimise").costs
        place = Place(machine.file or None, machine.lines.get("costs"), "costs")
        variants += [
            DesignVariant(number, entry.values, cost_of(tuple(entry.values), entry.values, given, place))
            for entry in possible
        ]
    rows = _rows(variants, len(machines), shared, places[0])
    kept, renumbered = np.unique(rows, return_inverse=True)
    variants = [variants[k] for k in kept.tolist()]
    rows = renumbered.reshape(rows.shape).astype(np.int64)
    costs = np.array([variant.cost for variant in variants])[rows].sum(axis=1)
    keys = tuple(dict.fromkeys(key for variant in variants for key in variant.values))
    ranked = tuple(
        RuledOut(
            code=code, name="impossible to build" if code == GEOMETRY else CHECK_CODES[code].name, combinations=count
        )
        for code, count in sorted(reasons.items(), key=lambda item: (-item[1], item[0]))
    )
    return SearchSpace(tuple(variants), rows, costs, keys, ranked, considered, tuple(sorted(always - {GEOMETRY})))


def combinations(options: Sequence[Choice]) -> Iterator[Assignment]:
    """All combinations of one machine's options."""
    for values in product(*(option.values for option in options)):
        yield {key: value for assignment in values for key, value in assignment.items()}


def _all_sized(machine: Machine, options: Sequence[Choice]) -> Iterator[_Sized]:
    """Each combination with the balls and the race that `abu size` gives it; equal ones once."""
    seen = set[str]()
    for assignment in combinations(options):
        entry = _sized(machine, assignment)
        if (text := repr(sorted(entry.values.items()))) not in seen:
            seen.add(text)
            yield entry


def _sized(machine: Machine, assignment: Assignment) -> _Sized:
    try:
        design = sized(machine.changed(assignment).whole("optimise"))
    except (AbuError, ValueError, ArithmeticError):
        return _Sized(dict(assignment), frozenset({GEOMETRY}))
    failing = frozenset(check.code for check in design.checks if check.status == "fail")
    return _Sized({**assignment, **sized_values(design.autobalancer)}, failing)


def _with_shared_sizes(
    machines: Sequence[Machine], entries: Sequence[Sequence[_Sized]], shared: set[str], chosen: set[str]
) -> list[list[_Sized]]:
    """Each combination also with the shared sizes that other machines need: a larger race, a larger ball."""
    keys = [key for key in (DIAMETER, RADIUS) if key in shared]
    pairs = sorted({
        tuple(entry.values[key] for key in keys)
        for its in entries for entry in its if GEOMETRY not in entry.failing
    })  # fmt: skip
    return [
        list(_further(machine, its, [dict(zip(keys, pair, strict=True)) for pair in pairs], chosen))
        for machine, its in zip(machines, entries, strict=True)
    ]


def _further(
    machine: Machine, entries: Sequence[_Sized], sizes: Sequence[Values], chosen: set[str]
) -> Iterator[_Sized]:
    """The combinations, then each with further sizes as far as it did not choose others."""
    yield from entries
    seen = {repr(sorted(entry.values.items())) for entry in entries}
    for entry in entries:
        for size in sizes:
            if any(key in chosen and entry.values.get(key) != value for key, value in size.items()):
                continue
            own = {key: value for key, value in entry.values.items() if key != COUNT or COUNT in chosen}
            further = _sized(machine, own | dict(size))
            if (text := repr(sorted(further.values.items()))) not in seen:
                seen.add(text)
                yield further


def _possible(entries: Sequence[_Sized]) -> tuple[list[_Sized], set[str]]:
    """Combinations that fail no closed check, and the checks that all fail, which do not count."""
    buildable = [entry for entry in entries if GEOMETRY not in entry.failing]
    always = set(frozenset.intersection(*(entry.failing for entry in buildable))) if buildable else set()
    possible = [entry for entry in buildable if entry.failing <= always]
    if not possible and buildable:
        fewest = min(len(entry.failing) for entry in buildable)
        possible = [entry for entry in buildable if len(entry.failing) == fewest]
        always = set().union(*(entry.failing for entry in possible))
    return possible, always


def _rows(variants: Sequence[DesignVariant], machines: int, shared: set[str], place: Place) -> NDArray[np.int64]:
    """One variant of each machine in every way that agrees on the shared keys."""
    groups: dict[str, list[list[int]]] = {}
    for number, variant in enumerate(variants):
        common = repr([(key, variant.values.get(key)) for key in sorted(shared)])
        groups.setdefault(common, [[] for _ in range(machines)])[variant.machine].append(number)
    whole = [group for group in groups.values() if all(group)]
    count = sum(int(np.prod([len(its) for its in group], dtype=np.int64)) for group in whole)
    if not count:
        raise InputError(
            "no shared part fits all machines", place=place,
            remedy="Share fewer parts (--share-parts), or permit more values.",
        )  # fmt: skip
    if count > MOST_CANDIDATES:
        raise InputError(
            "too many combinations of machines", place=place, found=f"{count}", allowed=f"at most {MOST_CANDIDATES}",
            remedy="Share more parts (--share-parts), or list fewer values.",
        )  # fmt: skip
    return np.array([row for group in whole for row in product(*group)], dtype=np.int64)


def changes(before: Mapping[str, Any], after: Mapping[str, Any]) -> tuple[str, ...]:
    """Keys whose values differ."""
    return tuple(key for key in dict.fromkeys((*before, *after)) if before.get(key) != after.get(key))


SHARE = Quantity("share", "", 4, "share of samples that meet all limits", percent=True)
LOW = Quantity("from", "", 4, "95 % confidence", percent=True)
HIGH = Quantity("to", "", 4, "95 % confidence", percent=True)


@record
class SampledShare(Record):
    """Share of samples that meet all limits, with its 95 % confidence interval (Clopper and Pearson)."""

    value: Annotated[float, SHARE]
    low: Annotated[float, LOW]
    high: Annotated[float, HIGH]
    of: Annotated[int, Quantity("samples")]
    seed: Annotated[int, Quantity("seed", "", 4, "of the samples, as `abu sweep --seed` takes it")]


@record
class FrontPoint(Record):
    """A design: its cost, and the share of its samples that meets the limits; of several machines the least share.

    `set`: its values by key; of several machines by file, then by key. `changes`: from the design before it.
    """

    cost: Annotated[float, Quantity("cost", "", 4, "in the units of [costs]")]
    share: Annotated[float, SHARE]
    low: Annotated[float, LOW]
    high: Annotated[float, HIGH]
    samples: Annotated[int, Quantity("samples", "", 4, "common to all designs, which chose among them")]
    set_: Annotated[dict[str, Any], Quantity("values")]
    changes: Annotated[tuple[str, ...], Quantity("changes", "", 4, "from the design before it on the front")]


@record
class RecommendedDesign(FrontPoint):
    """The recommended design; `fresh_share` rests on samples that had no part in the choice."""

    fresh_share: SampledShare | None
    proven: Annotated[bool, Quantity("proven in the race")]


@record
class RunnerUp(FrontPoint):
    """A design that was nearly recommended, and why it was not."""

    why_not: Annotated[str, Quantity("why not")]


@record
class ChosenKey(Record):
    """One option: the values among which the race chose."""

    name: Annotated[str, Quantity("option")]
    values: Annotated[tuple[str, ...], Quantity("values")]
    default: Annotated[bool, Quantity("by default")]


@record
class OptimiseResult(Result):
    """The cheapest design of which the wanted share of all machines built meets the limits."""

    command: ClassVar[str] = "optimise"

    files: Annotated[tuple[str, ...], Quantity("machines")]
    share: Annotated[float, Quantity("wanted share", "", 4, "", percent=True)]
    share_parts: Annotated[tuple[str, ...], Quantity("shared parts")]
    options: tuple[ChosenKey, ...]
    costs: tuple[CostEntry, ...]
    scatter: Annotated[dict[str, str], Quantity("scatter", "", 4, "of each value that varies among machines built")]
    considered: Annotated[int, Quantity("combinations")]
    ruled_out: tuple[RuledOut, ...]
    evaluated: Annotated[int, Quantity("candidates that were sampled")]
    samples: Annotated[int, Quantity("samples")]
    rounds: Annotated[int, Quantity("rounds of the race")]
    seed: Annotated[int, Quantity("seed")]
    front: tuple[FrontPoint, ...]
    recommended: RecommendedDesign
    runners_up: tuple[RunnerUp, ...]
    written_tolerances: Annotated[bool, Quantity("tolerances", "", 4, "true: the drawing's tolerances scatter, too")]
    store: Annotated[str | None, Quantity("store")]


HEADER: Final = r"(?m)^\[{}\][^\n]*$"
DROPPED: Final = ("expected",)
"""Tables that hold for the old design alone."""


def written_text(machine: Machine, values: Mapping[str, Any], result: OptimiseResult) -> str:
    """The file with these values, scattering as the samples of the race did."""
    scatter = dict(values)
    if result.written_tolerances:
        scatter["sweep.tolerances"] = True
    content = copy.deepcopy(machine.document.content)
    for name in DROPPED:
        content.pop(name, None)
    overrides = (*machine.overrides, *overrides_of(scatter))
    for override in overrides:
        if len(override.path) == 2 and isinstance(held := content.get(str(override.path[0])), dict):
            held.pop(_without_unit(override), None)
    apply(content, overrides, MachineFile)
    text = machine.document.text
    for name in DROPPED:
        text = re.sub(rf"(?ms)^\[{name}[.\]].*?(?=^\[|\Z)", "", text)
    for override in overrides:
        text = _put(text, override)
    try:
        same = tomllib.loads(text) == content
    except ValueError:
        same = False
    if same:
        return text
    import tomli_w

    return tomli_w.dumps(content)


def _without_unit(override: Override) -> str:
    """The key of an override as it stands beside a value with its unit."""
    *above, key = override.path
    table = table_at(MachineFile, tuple(above))
    written = {} if table is None else {own: stem for stem, own in canonical_keys(table).items()}
    return written.get(str(key), str(key))


def _put(text: str, override: Override) -> str:
    """The text with one entry of a table set."""
    if len(override.path) != 2 or not all(isinstance(part, str) for part in override.path):
        return text
    table, key = map(str, override.path)
    line = f"{key} = {shown(override.value)}"
    header = re.search(HEADER.format(re.escape(table)), text)
    if header is None:
        return f"{text.rstrip()}\n\n[{table}]\n{line}\n"
    following = re.search(r"(?m)^\[", text[header.end() :])
    end = header.end() + following.start() if following else len(text)
    body = text[header.end() : end]
    replaced, count = re.subn(
        rf"(?m)^(?:{key}|{_without_unit(override)})\s*=[^#\n]*?(?=\s*(#|$))", lambda _: line, body, count=1
    )
    if not count:
        replaced = f"\n{line}{body}"
    else:
        replaced = re.sub(rf"(?m)^({re.escape(line)})\s+#.*$", r"\1  # chosen by abu optimise", replaced)
    return text[: header.end()] + replaced + text[end:]
