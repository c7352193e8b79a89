"""Advice for limits that fail: changes tried on the same samples, each with the share before and after.

The changes of the file are those that `abu size` tries, and balls that carry more; half the scatter of what decides
comes beside them. A change is first tried on samples that fail; the best ones then on all samples, up to 512. Given are
those that raise the share and make no check of `abu size` worse.

Values that decide whether a limit fails: sensitivity of the limit's margin, and where among a value failures lie.

The margin of the level is limit − level [dB], that of the quiet time ln(limit/time); samples that are never quiet take
twice the longest time. For balancing and stalling no margin is stored: there the answer itself, 1 or 0, counts. Where
failures lie is told by comparing failing with passing samples (Spear & Hornberger 1980, Water Res. 14(1), 43).
"""

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain, islice
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.design.changes import changes_for_starts
from abu_calc.features.design.judgement import ACCURACY, Judgement, judge
from abu_calc.features.design.next_step import LESS, Entries, harmless, proposals
from abu_calc.features.sweep.answers import parts_of
from abu_calc.features.sweep.batches import FLAGS, IMPATIENT, LEVEL, QUIET, Row
from abu_calc.features.sweep.plan import DRAG, WARMTH, Plan, SweepRequest, planned
from abu_calc.features.sweep.result import DecidingValue, FailedLimit, LimitAdvice, MeetsLimits
from abu_calc.features.sweep.samples import SweepStudy
from abu_calc.features.sweep.sensitivity import BLOCK, Factor, RegressionSums, Sample, block
from abu_calc.features.sweep.store import Store
from abu_calc.features.sweep.tolerance_costs import Compute, Trials, rescaled
from abu_calc.foundation.errors import AbuError, Place, shell_word
from abu_calc.inputs.read_machine import Machine, variant_of
from abu_calc.inputs.reading.overrides import parse_variant
from abu_calc.inputs.variation import Sweep, variation
from abu_calc.reporting.parts import next_command
from abu_calc.simulation.result import Provenance
from abu_calc.sizing.actions import overrides
from abu_calc.sizing.proposals import carrying_more, in_words

Array = NDArray[np.float64]

LEAST: Final = 0.02
"""Least total index of a value that is named."""
NAMED: Final = 4
SHIFT: Final = 0.05
"""Least difference of the mean places of failing and passing samples in a distribution for a side to be named."""


def failed_limits(
    store: Store, sample: Sample, met: MeetsLimits, limits: Mapping[str, float]
) -> tuple[FailedLimit, ...]:
    """Each limit that a sample fails, the most frequent first, with the values that decide its margin."""
    failing = [name for name, share in met.each.items() if share.met < share.of]
    if not failing or sample.scheme == "saltelli":
        return ()
    places, columns = _samples(store, sample)
    found = [_failed(name, places, columns, sample, limits) for name in failing]
    return tuple(sorted(found, key=lambda each: -each.failed))


def _samples(store: Store, sample: Sample) -> tuple[Array, dict[str, Array]]:
    """Places of all samples in the distributions, and their numbers and flags; NaN where one is none."""
    names = [LEVEL.name, QUIET.name, *(column.name for column in FLAGS["build"])]
    numbers, places = list[Array](), list[Array]()
    for members, columns in parts_of(store, names):
        its = np.empty((len(members), len(sample.factors)))
        for first in np.unique(members // BLOCK).tolist():
            inside = members // BLOCK == first
            its[inside] = block(sample, first)[members[inside] - first * BLOCK]
        places.append(its)
        numbers.append(columns)
    whole = np.concatenate(numbers, axis=1)
    return np.concatenate(places), dict(zip(names, whole, strict=True))


def _failed(
    name: str, places: Array, columns: Mapping[str, Array], sample: Sample, limits: Mapping[str, float]
) -> FailedLimit:
    fails = columns[name] == 0
    margin = MARGINS.get(name, _answer)(columns, limits, name)
    fit = RegressionSums(sample.factors, len(margin))
    fit.add(fit.products(places), margin, np.arange(len(margin)))
    indices = fit.indices()
    rows = [] if indices is None else [
        DecidingValue(key=factor.key, total=index.total, fails_at=_side(factor, places[:, k], fails))
        for k, (factor, index) in enumerate(zip(sample.factors, indices.each, strict=True))
        if index.total >= LEAST
    ]  # fmt: skip
    rows.sort(key=lambda row: -row.total)
    return FailedLimit(limit=name, failed=int(fails.sum()), of=len(fails), decides=tuple(rows[:NAMED]))


def _level(columns: Mapping[str, Array], limits: Mapping[str, float], _: str) -> Array:
    return limits[LEVEL.name] - columns[LEVEL.name]


def _quiet(columns: Mapping[str, Array], limits: Mapping[str, float], _: str) -> Array:
    times, limit = columns[QUIET.name], limits[QUIET.name]
    longest = max(limit, float(np.nanmax(times)) if np.isfinite(times).any() else 0.0)
    times = np.clip(np.where(np.isfinite(times), times, 2 * longest), 1e-3 * limit, None)
    return np.asarray(math.log(limit) - np.log(times))


def _answer(columns: Mapping[str, Array], _: Mapping[str, float], name: str) -> Array:
    return columns[name]


Margin = Callable[[Mapping[str, Array], Mapping[str, float], str], Array]
MARGINS: Final[dict[str, Margin]] = {"meets_level": _level, "meets_settling": _quiet}


def _side(factor: Factor, places: Array, fails: NDArray[Any]) -> str:
    """Part of a distribution in which failing samples lie: high, low, a choice; empty if it cannot be told."""
    if not fails.any() or fails.all():
        return ""
    if values := factor.variation.values:
        index = np.minimum((places * len(values)).astype(int), len(values) - 1)
        shares = [float(fails[index == k].mean()) if (index == k).any() else 0.0 for k in range(len(values))]
        return str(values[int(np.argmax(shares))])
    shift = float(places[fails].mean() - places[~fails].mean())
    return "" if abs(shift) < SHIFT else "high values" if shift > 0 else "low values"


def flags_of(store: Store) -> Iterator[tuple[int, tuple[bool, ...]]]:
    """Number of each sample with its flags; one without numbers meets none."""
    names = ", ".join(column.name for column in FLAGS["build"])
    for member, *flags in store.ask(f"SELECT member, {names} FROM members WHERE member < ?", (store.drawn,)):
        yield member, tuple(map(bool, flags))


MOST: Final = 512
"""Samples on which the best changes are tried."""
CHANGES, FAILING = 24, 16
"""Changes that are tried, and the failing samples on which they are."""
JUDGED, PICKED = 8, 4
"""Changes of these that are judged as `abu size` does it, and that are then tried on all samples."""
GIVEN: Final = 3
"""Most changes that are given."""
FEWEST: Final = 20
"""Samples of a sweep below which nothing is tried."""


class Change(NamedTuple):
    """A change of the file (`entries`) or of the scatter (`vary`)."""

    text: str
    entries: Entries
    vary: Mapping[str, str]


def advice(
    plan: Plan, ask: SweepRequest, machine: Machine, failed: Sequence[FailedLimit], store: Store, compute: Compute
) -> tuple[tuple[LimitAdvice, ...], int]:
    """Changes that raise the share, the best first, and how many were tried."""
    if not failed or plan.design is None or plan.study.what != "build":  # only builds have all flags in the store
        return (), 0
    flags, accuracy = dict(flags_of(store)), plan.study.accuracy
    if not FEWEST <= store.drawn == len(flags):
        return (), 0
    try:
        before = judge(machine.whole("sweep"), accuracy)
    except AbuError:  # `abu size` says why
        return (), 0
    changes = [
        (change, study)
        for change in islice(_changes(before, plan.study, failed, dict(ask.vary)), CHANGES)
        if (study := _study(change, plan, ask, machine)) is not None
    ]
    ranked = _screened(changes, flags, store, compute, plan.study.sample.seed)
    kept = (each for each in ranked[:JUDGED] if harmless(machine, before.checks, each[0].entries, accuracy))
    picked = list(islice(kept, PICKED))
    members = _members(range(store.drawn), MOST, plan.study.sample.seed)
    after = _tried([study for _, study in picked], members, store, compute)
    was = [flags[member] for member in members]
    tried = [
        _advice(change, was, its, _command(change, machine, ask, accuracy))
        for (change, _), its in zip(picked, after, strict=True) if its is not None
    ]  # fmt: skip
    better = sorted(
        (each for each in tried if each.after > each.before), key=lambda each: (-each.after, len(each.set_))
    )
    best = {each.change.partition(" ")[0]: each for each in reversed(better)}
    return tuple(each for each in better if each in best.values())[:GIVEN], len(changes)


def _screened(
    changes: Sequence[tuple[Change, SweepStudy]], flags: Mapping[int, tuple[bool, ...]], store: Store,
    compute: Compute, seed: int,
) -> list[tuple[Change, SweepStudy]]:  # fmt: skip
    """The changes that mend some of the failing samples, those that mend most first."""
    failing = _members([member for member, its in flags.items() if not its[-1]], FAILING, seed)
    results = _tried([study for _, study in changes], failing, store, compute)
    mended = [sum(flag[-1] for flag in its or ()) for its in results]
    ranked = sorted((place for place, count in enumerate(mended) if count), key=lambda place: -mended[place])
    return [changes[place] for place in ranked]


def _members(of: Sequence[int], most: int, seed: int) -> list[int]:
    if len(of) <= most:
        return list(of)
    return sorted(np.random.default_rng(seed).choice(of, most, replace=False).tolist())


def _tried(
    studies: Sequence[SweepStudy], members: Sequence[int], store: Store, compute: Compute
) -> list[list[tuple[bool, ...]] | None]:
    """Flags of these samples with each change; None of a change that patience left out."""
    if not studies:
        return []
    rows: dict[int, Row] = {}
    count = len(members)
    numbers = iter(range(len(studies) * count))
    compute(Trials(tuple(studies), tuple(members)), numbers, lambda some: rows.update({row[0]: row for row in some}))
    places = [store.names.index(column.name) for column in FLAGS["build"]]
    answers: list[list[tuple[bool, ...]] | None] = []
    for first in range(0, len(studies) * count, count):
        its = [rows[number] for number in range(first, first + count)]
        late = any(row[-1] == IMPATIENT for row in its)
        answers.append(None if late else [tuple(bool(row[place]) for place in places) for row in its])
    return answers


def _command(change: Change, machine: Machine, ask: SweepRequest, accuracy: float) -> str:
    """The same sweep with a change: as it was asked for, with every option that moves its samples."""
    usual, vary = Sweep(), {key: way.text for key, way in ask.vary} | dict(change.vary)
    given = (
        None if ask.runs is None else f"--runs {ask.runs}", f"--seed {ask.seed}",
        "--tolerances" if ask.tolerances else None, "--sensitivity" if ask.sensitivity else None,
        None if ask.sampling == usual.sampling else f"--sampling {ask.sampling}",
        None if accuracy == ACCURACY else f"--accuracy {accuracy:g}",
    )  # fmt: skip
    ways = (f"--vary {shell_word(f'{key}={way}')}" for key, way in vary.items())
    return next_command("abu sweep", Provenance.of(machine), change.entries, *filter(None, given), *ways)


def _advice(
    change: Change, before: Sequence[tuple[bool, ...]], after: Sequence[tuple[bool, ...]], command: str
) -> LimitAdvice:
    count = len(before)
    names = [column.name for column in FLAGS["build"]][:-1]
    limits = {
        name: (sum(not its[k] for its in before), sum(not its[k] for its in after)) for k, name in enumerate(names)
    }
    entries = parse_variant(",".join(change.entries)) if change.entries else ()
    return LimitAdvice(
        change=change.text, set_={entry.key: entry.value for entry in entries}, vary=dict(change.vary), of=count,
        before=sum(its[-1] for its in before) / count, after=sum(its[-1] for its in after) / count,
        limits={name: pair for name, pair in limits.items() if any(pair)}, next=command,
    )  # fmt: skip


def _study(change: Change, plan: Plan, ask: SweepRequest, machine: Machine) -> SweepStudy | None:
    """The samples with a change, as a sweep with its options draws them.

    None if the file does not bear it, or if it leaves other values to be drawn.
    """
    vary = dict(ask.vary) | {key: variation(text, Place(key=f"vary {key}")) for key, text in change.vary.items()}
    try:
        changed = variant_of(machine, ",".join(change.entries)) if change.entries else machine
        study = planned(changed, replace(ask, vary=tuple(vary.items())), plan.study.accuracy).study
    except AbuError:
        return None
    keys = [[WARMTH if factor.key == DRAG else factor.key for factor in its.sample.factors]
            for its in (plan.study, study)]  # fmt: skip
    return replace(study, until=plan.study.until) if keys[0] == keys[1] else None


def _changes(
    before: Judgement, study: SweepStudy, failed: Sequence[FailedLimit], varied: Collection[str]
) -> Iterator[Change]:
    """Changes of the file, without repetition; and half the scatter of other values that decide."""
    loud = failed[0].limit == "meets_level"
    for_starts = map(overrides, changes_for_starts(before.facts, loud=loud))
    more = map(overrides, carrying_more(before.design))
    yield from _tightened(study, failed, varied)
    entries = dict.fromkeys(chain(for_starts, more, proposals(before)))
    yield from (Change(in_words(its), its, {}) for its in entries)


def _tightened(study: SweepStudy, failed: Sequence[FailedLimit], varied: Collection[str]) -> Iterator[Change]:
    """Half the scatter of the values that decide the margins, as far as they belong to the file.

    Half the value itself of a race that is as asked: truer, or rolling more easily.
    """
    keys = dict.fromkeys(row.key for limit in failed for row in limit.decides)
    for factor in study.sample.factors:
        key, way = factor.key, factor.variation
        if key not in keys or not factor.path or key == DRAG or not way.numbers:
            continue
        half = rescaled(way, 0.5).text
        yield Change(f"scatter of {key} halved: {half}", (), {key: half})
        if key in varied and key in LESS:
            half = rescaled(way, 0.5, about_zero=True).text
            yield Change(f"{key} halved: {half}", (), {key: half})
