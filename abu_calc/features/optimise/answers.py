"""Answers of a race: designs with their shares, changes from one to the next, and the checks.

Request of an optimisation: the tables [optimise] and [sweep] of the files, with the arguments in their place.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.design.judgement import judge
from abu_calc.features.optimise.choices import Choice, cost_entries
from abu_calc.features.optimise.racing import CandidateRace, SampleSource
from abu_calc.features.optimise.result import (
    ChosenKey,
    FrontPoint,
    OptimiseResult,
    RecommendedDesign,
    RunnerUp,
    SampledShare,
    SearchSpace,
    changes,
)
from abu_calc.features.sweep.plan import SweepRequest, asked, planned
from abu_calc.foundation.checks import CHECK_CODES, Check, coded
from abu_calc.foundation.errors import AbuError, InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.shares import interval
from abu_calc.foundation.validity import Range
from abu_calc.inputs.machine import PARTS, Optimise
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.reading.text import shown_short
from abu_calc.simulation.result import Provenance

TARGET = Range("wanted share", 0.5, 0.9999, key="share")
SEED = Range("seed", 0, 2**31 - 2, key="seed")
MOST_MACHINES = 20


@dataclass(frozen=True)
class OptimiseRequest:
    """What is asked, of which machines, with the sampling of each."""

    machines: tuple[Machine, ...]
    places: tuple[Place, ...]
    choose: Any
    choose_place: Place
    share: float
    share_parts: tuple[str, ...]
    seed: int
    requests: tuple[SweepRequest, ...]

    def refuse_scattered(self, machine: int, values: Mapping[str, Any]) -> None:
        """Raise InputError for a chosen value that [sweep] scatters: the choice would change nothing."""
        for key, _ in self.requests[machine].vary:
            if key in values:
                raise InputError(
                    "[sweep] scatters a value that is to be chosen, so that the choice would change nothing",
                    place=self.places[machine], found=key, remedy="Remove it from [sweep] vary, or pin it.",
                )  # fmt: skip


def asked_of(
    machines: Machine | Sequence[Machine], choose: Any, *, share: float | None, share_parts: Any,
    tolerances: bool | None, seed: int | None, most: int,
) -> OptimiseRequest:  # fmt: skip
    """The request, checked. Raises InputError."""
    several = (machines,) if isinstance(machines, Machine) else tuple(machines)
    if not 0 < len(several) <= MOST_MACHINES or not all(isinstance(each, Machine) for each in several):
        raise InputError(
            "machines are expected", place=Place(key="machines"), found=f"{len(several)}",
            allowed=f"1 … {MOST_MACHINES} machines",
        )  # fmt: skip
    first = several[0]
    table = first.whole("optimise").optimise or Optimise()
    in_file = choose is None and table.choose is not None
    lines = first.lines.get("optimise.choose")
    place = Place(first.file or None, lines, "optimise.choose") if in_file else Place(key="choose")
    own_seed = int(SEED.check(table.seed if seed is None else seed))
    return OptimiseRequest(
        machines=several,
        places=tuple(Place(machine.file or None) for machine in several),
        choose=table.choose if choose is None else choose,
        choose_place=place,
        share=TARGET.check(table.share if share is None else share),
        share_parts=_parts(table.share_parts if share_parts is None else share_parts, len(several)),
        seed=own_seed,
        requests=tuple(_request(machine, tolerances, own_seed, most) for machine in several),
    )


def _parts(given: Any, machines: int) -> tuple[str, ...]:
    if given is None:
        return ("balls", "race") if machines > 1 else ()
    parts = [part.strip() for part in given.split(",")] if isinstance(given, str) else list(given)
    for part in parts:
        if part not in PARTS:
            raise InputError(
                "no part that machines can share", place=Place(key="share_parts"), found=str(part),
                allowed=", ".join(PARTS),
            )  # fmt: skip
    return tuple(dict.fromkeys(parts)) if machines > 1 else ()


def _request(machine: Machine, tolerances: bool | None, seed: int, most: int) -> SweepRequest:
    """Scatter of a machine as `abu sweep` takes it; listed values are drawn at random, not in turn."""
    known = machine.whole("optimise").sweep
    wanted = (known is None or None) if tolerances is None else tolerances
    request = asked(machine, None, runs=most, what="build", tolerances=wanted, sampling="sobol", seed=seed)
    vary = tuple((key, replace(way, kind="choice") if way.listed else way) for key, way in request.vary)
    return replace(request, vary=vary, grid=None, sensitivity=False)


Flags = NDArray[np.bool_]


def answered(
    ask: OptimiseRequest, options: Sequence[tuple[Choice, ...]], space: SearchSpace, race: CandidateRace,
    source: SampleSource, best: int, proven: bool, on_front: Sequence[int], others: Sequence[int],
    fresh: Sequence[Flags], path: Path | None,
) -> OptimiseResult:  # fmt: skip
    """The result of a race that is over; `fresh`: flags of fresh samples of each machine of the best candidate."""
    designs = DesignPoints(ask, space, race)
    fresh_share = None if source.impatient else _fresh(fresh, ask.seed + 1)
    undecided = _undecided(race, best) if proven else 0
    point = designs.point(best)
    front = tuple(designs.point(k, on_front[place - 1] if place else None) for place, k in enumerate(on_front))
    given = {key: cost for machine in ask.machines for key, cost in machine.whole("optimise").costs.items()}
    first = ask.machines[0]
    title = first.title if len(ask.machines) == 1 else f"{len(ask.machines)} machines"
    return OptimiseResult(
        title=title,
        checks=(
            _share_check(ask.share, fresh_share, proven),
            _least_cost_check(race, best, proven, undecided, source.impatient),
        ),
        warnings=(
            *_warnings(ask, space),
            *_judged(ask, space, best),
            *dict.fromkeys(w for machine in ask.machines for w in machine.warnings),
        ),
        provenance=Provenance.of(first),
        files=tuple(machine.file for machine in ask.machines),
        share=ask.share,
        share_parts=ask.share_parts,
        options=_options(options, default=ask.choose is None),
        costs=cost_entries(space.keys, given),
        scatter=_scatter(ask, space, best),
        considered=space.considered,
        ruled_out=space.ruled_out,
        evaluated=len(space.rows),
        samples=race.spent + sum(map(len, fresh)),
        rounds=race.rounds,
        seed=ask.seed,
        front=front,
        recommended=RecommendedDesign(**vars(point), fresh_share=fresh_share, proven=proven),
        runners_up=tuple(
            RunnerUp(**vars(designs.point(k, best)), why_not=_why_not(race, k, best, proven)) for k in others
        ),
        written_tolerances=ask.requests[0].tolerances,
        store=None if path is None else str(path),
    )


class DesignPoints:
    """Candidates as points of the result."""

    def __init__(self, ask: OptimiseRequest, space: SearchSpace, race: CandidateRace) -> None:
        self.ask, self.space, self.race = ask, space, race

    def point(self, number: int, before: int | None = None) -> FrontPoint:
        """One candidate, with its changes from another."""
        row = self.race.candidates[number].tolist()
        least = min(row, key=lambda arm: (self.race.counts(arm)[0] / max(self.race.samples(arm), 1), arm))
        met, of = self.race.counts(least)
        low, high = interval(met, of)
        return FrontPoint(
            cost=float(self.race.costs[number]), share=met / of, low=low, high=high, samples=of,
            set_=self.values(number), changes=() if before is None else self.differences(before, number),
        )  # fmt: skip

    def values(self, number: int) -> dict[str, Any]:
        """Values by key; of several machines by file."""
        variants = [self.space.variants[arm] for arm in self.race.candidates[number].tolist()]
        if len(variants) == 1:
            return dict(variants[0].values)
        return {name: dict(variant.values) for name, variant in zip(names_of(self.ask), variants, strict=True)}

    def differences(self, before: int, after: int) -> tuple[str, ...]:
        """Changes from one candidate to another, in words; those of all machines once."""
        was, now = ([self.space.variants[arm] for arm in self.race.candidates[k].tolist()] for k in (before, after))
        several, texts = len(was) > 1, dict[str, list[str]]()
        for name, one, other in zip(names_of(self.ask), was, now, strict=True):
            for key in changes(one.values, other.values):
                text = f"{short(key)} {shown(one.values, key)} → {shown(other.values, key)}"
                texts.setdefault(text, []).append(name)
        return tuple(
            text if not several or len(its) == len(was) else f"{', '.join(its)}: {text}" for text, its in texts.items()
        )


def names_of(ask: OptimiseRequest) -> tuple[str, ...]:
    """Name of each machine, by which results list it: its file, numbered if two have the same."""
    files = [machine.file or "machine" for machine in ask.machines]
    return tuple(f"{file} ({k + 1})" if files.count(file) > 1 else file for k, file in enumerate(files))


def short(key: str) -> str:
    """Last part of a key."""
    return key.rpartition(".")[2]


def shown(values: Mapping[str, Any], key: str) -> str:
    """A value as a file has it; – for one that a design does not choose."""
    return shown_short(values[key]) if key in values else "–"


def _fresh(fresh: Sequence[Flags], seed: int) -> SampledShare:
    least = min(fresh, key=lambda flags: int(flags.sum()))
    met, of = int(least.sum()), len(least)
    low, high = interval(met, of)
    return SampledShare(value=met / of, low=low, high=high, of=of, seed=seed)


def _undecided(race: CandidateRace, best: int) -> int:
    """Cheaper candidates whose share neither is proven nor lies below the wanted one by its bound."""
    cheaper = race.costs < race.costs[best] - 1e-12
    return int((cheaper & race.possible()).sum())


def _share_check(target: float, fresh: SampledShare | None, proven: bool) -> Check:
    if fresh is None:
        message = "the seconds of --patience were over before fresh samples were computed"
        return coded("ABU831", "not-done", message, None, target, "Raise --patience.")
    message = (
        f"{round(fresh.value * fresh.of)} of {fresh.of} fresh samples meet all limits, by 95 % confidence "
        f"{100 * fresh.low:.4g} to {100 * fresh.high:.4g} %"
    )
    if fresh.low >= target:
        return coded("ABU831", "pass", message, fresh.value, target)
    if fresh.value >= target:
        more = "More fresh samples (--runs) narrow the interval."
        return coded("ABU831", "warn", message, fresh.value, target, more)
    if not proven:
        message = f"no design reaches it; the highest share found: {message}"
    more = "Permit better values (--choose), or narrow the scatter: `abu sweep FILE` names what fails."
    return coded("ABU831", "fail", message, fresh.value, target, more)


def _least_cost_check(race: CandidateRace, best: int, proven: bool, undecided: int, impatient: bool) -> Check:
    if impatient:
        return coded("ABU832", "not-done", "the seconds of --patience were over before the race was decided",
            remedy="Raise --patience. A store goes on with --resume.",
        )  # fmt: skip
    if not proven:
        possible = int(race.possible().sum())
        message = f"no share is proven; that of {possible} of {len(race.costs)} candidates may reach it"
        more = "More samples (--samples) decide more." if possible else None
        return coded("ABU832", "warn", message, remedy=more)
    if undecided:
        message = f"the share of {undecided} cheaper candidates lies too near the wanted one to tell"
        return coded("ABU832", "warn", message, remedy="More samples (--samples) decide more.")
    cheaper = int((race.costs < race.costs[best]).sum())
    return coded("ABU832", "pass", f"the shares of all {cheaper} cheaper candidates lie below the wanted one")


def _why_not(race: CandidateRace, number: int, best: int, proven: bool) -> str:
    more = race.costs[number] - race.costs[best]
    if not proven:
        return "lower share" if race.means()[number] < race.means()[best] else f"dearer by {more:.3g}"
    if more > 1e-9:
        return f"dearer by {more:.3g}"
    if not race.possible()[number]:
        return "share below the wanted one"
    if not race.proven()[number]:
        return f"cheaper by {-more:.3g}, not proven" if more < -1e-9 else "as dear, not proven"
    return "as dear, lower share"


def _options(options: Sequence[tuple[Choice, ...]], *, default: bool) -> tuple[ChosenKey, ...]:
    values: dict[str, dict[str, None]] = {}
    for option in (option for its in options for option in its):
        texts = ["×".join(shown_short(v) for v in assignment.values()) for assignment in option.values]
        values.setdefault(option.name, {}).update(dict.fromkeys(texts))
    return tuple(ChosenKey(name=name, values=tuple(texts), default=default) for name, texts in values.items())


def _judged(ask: OptimiseRequest, space: SearchSpace, best: int) -> Iterator[str]:
    """Checks that `abu size` fails with the recommended values, for each machine."""
    for arm, name in zip(space.rows[best].tolist(), names_of(ask), strict=True):
        variant = space.variants[arm]
        tables = ask.machines[variant.machine].changed(dict(variant.values)).whole("optimise")
        try:
            checks = judge(tables).checks
        except AbuError:  # `abu size` says why
            continue
        codes = dict.fromkeys(check.code for check in checks if check.requested and check.status == "fail")
        if codes:
            yield f"With the recommended values `abu size` still fails {', '.join(codes)} of {name}."


def _scatter(ask: OptimiseRequest, space: SearchSpace, best: int) -> dict[str, str]:
    """Scatter of the first machine of the best candidate."""
    variant = space.variants[int(space.rows[best][0])]
    machine = ask.machines[variant.machine].changed(dict(variant.values))
    plan = planned(machine, ask.requests[variant.machine], 0.01)
    return {factor.key: factor.variation.text for factor in plan.study.sample.factors}


def _warnings(ask: OptimiseRequest, space: SearchSpace) -> list[str]:
    notes = []
    if space.failing:
        codes = ", ".join(f"{code} {CHECK_CODES[code].name}" for code in space.failing)
        notes.append(f"Every candidate fails {codes}: run `abu size FILE`.")
    for machine in ask.machines:
        unused = [key for key in machine.whole("optimise").costs if key not in space.keys]
        if unused:
            notes.append(f"[costs] of {machine.file} prices {', '.join(unused)}, which nobody chooses here.")
    free = [item.key for item in cost_entries(space.keys, {}) if item.source.startswith("no cost")]
    given = {key for machine in ask.machines for key in machine.whole("optimise").costs}
    notes += [f"{key} costs nothing: specify its cost in [costs]." for key in free if key not in given]
    return notes
