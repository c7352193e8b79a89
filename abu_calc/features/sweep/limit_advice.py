"""Advice for limits that fail: changes tried on the same samples, each with the share before and after.

A change is first tried on some samples that fail and some that pass; the best ones then on all samples, up to 512. A
change that does not raise the share is not given.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, Final, NamedTuple, get_args

import numpy as np

from abu_calc.features.sweep.batches import Row
from abu_calc.features.sweep.columns import FLAGS, IMPATIENT
from abu_calc.features.sweep.failed_limits import flags_of
from abu_calc.features.sweep.plan import DRAG, Plan, SweepRequest, planned
from abu_calc.features.sweep.result import FailedLimit, LimitAdvice
from abu_calc.features.sweep.samples import SweepStudy
from abu_calc.features.sweep.store import Store
from abu_calc.features.sweep.tolerance_costs import Compute, Trials
from abu_calc.foundation.errors import AbuError, Place
from abu_calc.foundation.units import from_si
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.oil import Grade
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.variation import Variation, variation
from abu_calc.simulation.start_cases import RUN_UP
from abu_calc.sizing import size as sized
from abu_calc.sizing.balls import Candidate, candidates
from abu_calc.sizing.design import Design

MOST: Final = 512
"""Samples on which the best changes are tried."""
GIVEN: Final = 3
"""Most changes that are given."""
FEWEST: Final = 20
"""Samples of a sweep below which nothing is tried."""
ABU: Final = "autobalancer"
BALLS: Final = (f"{ABU}.ball_count", f"{ABU}.ball_diameter_mm", f"{ABU}.race_radius_mm")


class Change(NamedTuple):
    """A change of the design (`values`) or of the scatter (`vary`)."""

    text: str
    values: Mapping[str, Any]
    vary: Mapping[str, str]


def advice(
    plan: Plan, ask: SweepRequest, machine: Machine, failed: Sequence[FailedLimit], store: Store, compute: Compute
) -> tuple[tuple[LimitAdvice, ...], int]:
    """Changes that raise the share, the best first, and how many were tried."""
    design = plan.design
    if not failed or design is None or plan.study.what != "build" or store.drawn < FEWEST:
        return (), 0
    changes = [
        (change, study)
        for change in _changes(design, ask, plan.study, failed)
        if (study := _study(change, plan, ask, machine)) is not None
    ]
    flags = dict(flags_of(store))
    missing = [member for member in range(store.drawn) if member not in flags]
    if not changes or missing:
        return (), len(changes)
    picked = _screened(changes, flags, store, compute, plan.study.sample.seed)
    members = _members(store.drawn, MOST, plan.study.sample.seed)
    after = _tried([study for _, study in picked], members, store, compute)
    before = [flags[member] for member in members]
    given = [_advice(change, before, its) for (change, _), its in zip(picked, after, strict=True) if its is not None]
    better = sorted((each for each in given if each.after > each.before), key=lambda each: -each.after)
    best = {each.change.partition(" ")[0]: each for each in reversed(better)}
    return tuple(each for each in better if each in best.values())[:GIVEN], len(changes)


def _screened(
    changes: Sequence[tuple[Change, SweepStudy]], flags: Mapping[int, tuple[bool, ...]], store: Store,
    compute: Compute, seed: int,
) -> list[tuple[Change, SweepStudy]]:  # fmt: skip
    """The most promising changes, by some failing and some passing samples."""
    failing = [member for member, its in flags.items() if not its[-1]]
    passing = [member for member, its in flags.items() if its[-1]]
    each = min(max(len(flags) // 8, 8), 32)
    rng = np.random.default_rng(seed)
    bad = sorted(rng.choice(failing, min(each, len(failing)), replace=False).tolist())
    good = sorted(rng.choice(passing, min(each, len(passing)), replace=False).tolist()) if passing else []
    results = _tried([study for _, study in changes], [*bad, *good], store, compute)
    ranked = []
    for place, its in enumerate(results):
        if its is None:
            continue
        mended = np.mean([answer[-1] for answer in its[: len(bad)]])
        kept = np.mean([answer[-1] for answer in its[len(bad) :]]) if good else 0.0
        share = (len(failing) * mended + len(passing) * kept) / len(flags)
        ranked.append((-share, place))
    now = len(passing) / len(flags)
    return [changes[place] for share, place in sorted(ranked)[: GIVEN + 1] if -share > now]


def _members(drawn: int, most: int, seed: int) -> list[int]:
    if drawn <= most:
        return list(range(drawn))
    return sorted(np.random.default_rng(seed).choice(drawn, most, replace=False).tolist())


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


def _advice(change: Change, before: Sequence[tuple[bool, ...]], after: Sequence[tuple[bool, ...]]) -> LimitAdvice:
    count = len(before)
    names = [column.name for column in FLAGS["build"]][:-1]
    limits = {
        name: (sum(not its[k] for its in before), sum(not its[k] for its in after)) for k, name in enumerate(names)
    }
    return LimitAdvice(
        change=change.text, set_=dict(change.values), vary=dict(change.vary), of=count,
        before=sum(its[-1] for its in before) / count, after=sum(its[-1] for its in after) / count,
        limits={name: pair for name, pair in limits.items() if any(pair)},
    )  # fmt: skip


def _study(change: Change, plan: Plan, ask: SweepRequest, machine: Machine) -> SweepStudy | None:
    """The samples with a change; None if the file does not bear it, or the design fails a check it passed before."""
    vary = dict(ask.vary) | {key: variation(text, Place(key=f"vary {key}")) for key, text in change.vary.items()}
    try:
        changed = planned(machine.changed(change.values), replace(ask, vary=tuple(vary.items())), plan.study.accuracy)
    except AbuError:
        return None
    if changed.design is None or plan.design is None or _failing(changed.design) - _failing(plan.design):
        return None
    ours, theirs = plan.study.sample, changed.study.sample
    by_key = {factor.key: factor for factor in theirs.factors}
    if by_key.keys() != {factor.key for factor in ours.factors}:
        return None
    # In the order of the sweep, so that each value keeps its random numbers.
    factors = tuple(by_key[factor.key] for factor in ours.factors)
    return replace(changed.study, sample=replace(ours, factors=factors), until=plan.study.until)


def _failing(design: Design) -> set[str]:
    return {check.code for check in design.checks if check.status == "fail"}


def _changes(design: Design, ask: SweepRequest, study: SweepStudy, failed: Sequence[FailedLimit]) -> Iterator[Change]:
    """Drag, friction, eccentricity, balls, envelope, run-up; and half the scatter of other values that decide."""
    own, pins = design.case.autobalancer, _pins(design.autobalancer)
    varied = dict(ask.vary)
    for key, factors, most in (
        (DRAG, (1.5, 2.5, 6.0, 0.6), 1e5),
        (f"{ABU}.race_eccentricity_mm", (0.5,), 10.0),
        (f"{ABU}.rolling_friction_mm", (0.5,), 1.0),
    ):
        value = float(getattr(own, key.partition(".")[2]))
        for factor in factors:
            if key in varied:
                yield from _scaled(key, varied[key], factor)
            elif value > 0:
                goal = float(f"{min(factor * value, most):.3g}")
                yield Change(f"{key} {value:g} → {goal:g}", {key: goal, **pins}, {})
    oil = design.case.table.oil
    if oil is not None and oil.grade is not None:
        grades: tuple[str, ...] = get_args(Grade)
        place = grades.index(oil.grade)
        for other in (place - 2, place + 2):
            if 0 <= other < len(grades):
                yield Change(f"oil.grade {oil.grade} → {grades[other]}", {"oil.grade": grades[other], **pins}, {})
    yield from _other_balls(design)
    if (run_up := _run_up(design)) is not None:
        for factor in (0.5, 2.0):
            yield Change(
                f"run_up.time_s {run_up:g} → {factor * run_up:g}", {"run_up.time_s": factor * run_up, **pins}, {}
            )
    yield from _tightened(study, failed, varied, pins)


def _scaled(key: str, way: Variation, factor: float) -> Iterator[Change]:
    """A distribution of the user's about another middle."""
    if way.kind in ("lognormal", "normal"):
        spread = way.numbers[1] if way.kind == "lognormal" else way.numbers[1] * factor
        numbers: tuple[float, ...] = (way.numbers[0] * factor, spread)
    elif way.numbers:
        numbers = tuple(number * factor for number in way.numbers)
    else:
        return
    text = f"{way.kind}({', '.join(f'{number:.4g}' for number in numbers)})"
    yield Change(f"{key} {way.text} → {text}", {}, {key: text})


def _pins(chosen: Candidate) -> dict[str, Any]:
    diameter, radius = from_si(chosen.ball_diameter, "mm"), from_si(chosen.race_radius, "mm")
    return dict(zip(BALLS, (chosen.ball_count, round(diameter, 6), round(radius, 6)), strict=True))


def _other_balls(design: Design) -> Iterator[Change]:
    """Balls that carry more in the same envelope, and in a larger one."""
    own, best, case = design.case.autobalancer, design.autobalancer, design.case
    free = case.table.model_copy(update={ABU: own.model_copy(update=dict.fromkeys(
        ("ball_count", "ball_diameter_mm", "race_radius_mm")))})  # fmt: skip
    larger = {
        f"{ABU}.max_outer_diameter_mm": round(1.12 * own.max_outer_diameter_mm, 1),
        f"{ABU}.max_width_mm": round(1.12 * own.max_width_mm, 1),
        f"{ABU}.max_mass_fraction": round(min(1.5 * own.max_mass_fraction, 1.0), 4),
    }
    diameters = f"Ø{own.max_outer_diameter_mm:g} → Ø{larger[f'{ABU}.max_outer_diameter_mm']:g} mm"
    for text, values in (("", {}), (f"envelope {diameters}, ", larger)):
        chosen = _strongest(free, values)
        if chosen is not None and _pins(chosen) != _pins(best):
            pins = _pins(chosen)
            was, now = ("{} × Ø{:g} in R {:g}".format(*each.values()) for each in (_pins(best), pins))
            yield Change(f"{text}balls {was} → {now}", {**values, **pins}, {})


def _strongest(table: MachineFile, values: Mapping[str, Any]) -> Candidate | None:
    """The autobalancer that carries most within the envelope and mass of a file with these values."""
    own = table.autobalancer
    if own is None:
        return None
    given = {key.partition(".")[2]: value for key, value in values.items()}
    try:
        design = sized(table.model_copy(update={ABU: own.model_copy(update=given)}))
        there = candidates(design.case, design.imbalance.value)
    except AbuError:
        return None
    fit = [each for each in there if each.mass_fraction <= design.case.autobalancer.max_mass_fraction]
    return max(fit, key=lambda each: each.capacity_ratio, default=None)


def _run_up(design: Design) -> float | None:
    """Run-up time that can be set; None if the motor decides it."""
    if design.case.table.motor is not None:
        return None
    given = design.case.table.run_up
    return given.time_s if given else RUN_UP


def _tightened(
    study: SweepStudy, failed: Sequence[FailedLimit], varied: Mapping[str, Variation], pins: Mapping[str, Any]
) -> Iterator[Change]:
    """Half the scatter of the values that decide the margins, as far as they belong to the file."""
    keys = dict.fromkeys(row.key for limit in failed for row in limit.decides)
    skip = {DRAG, f"{ABU}.race_eccentricity_mm", f"{ABU}.rolling_friction_mm"} - varied.keys()
    for factor in study.sample.factors:
        if factor.key in keys and factor.path and factor.key not in skip and factor.variation.numbers:
            text = halved(factor.variation)
            if text != factor.variation.text:
                yield Change(f"scatter of {factor.key} halved: {text}", dict(pins), {factor.key: text})


def halved(way: Variation) -> str:
    """Half the scatter about the same middle, as text.

    >>> from abu_calc.inputs.variation import variation
    >>> [halved(variation(text, Place())) for text in ("lognormal(256, 0.2)", "uniform(2, 4)", "triangular(0, 1, 3)")]
    ['lognormal(256, 0.1)', 'uniform(2.5, 3.5)', 'triangular(0, 0.5, 1.5)']
    """
    first, *rest = way.numbers
    if way.kind in ("normal", "lognormal"):
        return f"{way.kind}({first:.6g}, {rest[0] / 2:.6g})"
    middle = 0.0 if first == 0 else (first + rest[-1]) / 2 if way.kind == "uniform" else rest[0]
    numbers = (middle + (number - middle) / 2 for number in way.numbers)
    return f"{way.kind}({', '.join(f'{number:.6g}' for number in numbers)})"
