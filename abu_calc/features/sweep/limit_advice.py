"""Advice for limits that fail: changes tried on the same samples, each with the share before and after.

The changes of the file are those that `abu size` tries, and balls that carry more; half the scatter of what decides
comes beside them. A change is first tried on samples that fail; the best ones then on all samples, up to 512. Given are
those that raise the share and make no check of `abu size` worse.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain, islice
from typing import Final, NamedTuple

import numpy as np

from abu_calc.features.design.changes import changes_for_starts
from abu_calc.features.design.judgement import ACCURACY, Judgement, judge
from abu_calc.features.design.next_step import LESS, Entries, harmless, proposals
from abu_calc.features.sweep.batches import Row
from abu_calc.features.sweep.columns import FLAGS, IMPATIENT
from abu_calc.features.sweep.failed_limits import flags_of
from abu_calc.features.sweep.plan import DRAG, WARMTH, Plan, SweepRequest, planned
from abu_calc.features.sweep.result import FailedLimit, LimitAdvice
from abu_calc.features.sweep.samples import SweepStudy
from abu_calc.features.sweep.store import Store
from abu_calc.features.sweep.tolerance_costs import Compute, Trials, rescaled
from abu_calc.foundation.errors import AbuError, Place
from abu_calc.foundation.escaping import shell_word
from abu_calc.inputs.read_machine import Machine, variant_of
from abu_calc.inputs.reading.overrides import parse_variant
from abu_calc.inputs.variation import Sweep, variation
from abu_calc.reporting.parts import next_command
from abu_calc.simulation.result import Provenance
from abu_calc.sizing.actions import overrides
from abu_calc.sizing.change_words import in_words
from abu_calc.sizing.proposals import carrying_more

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
