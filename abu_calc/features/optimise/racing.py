"""Race of candidates: the least cost at which a wanted share meets the limits, with as few samples as decide it.

All candidates meet the same samples (common random numbers). A candidate consists of arms, one for each machine; its
share is the least of theirs. Each round doubles the samples of the cheapest open candidates that look good, fewer
from round to round (successive halving: Karnin, Koren & Somekh 2013, ICML 28(3), 1238). The others wait. A candidate is
let go only by a bound:

- its share lies below the wanted one (Clopper & Pearson);
- or a candidate that costs no more meets the limits in more of the same samples (exact sign test);
- or a candidate that costs less is proven.

Rounds end together, so that the number of processes changes nothing. After the race: the front of cost against share,
of which no cheaper design has a higher share, and runners-up of the best one.

Samples of a race: each is one machine of one variant, built and switched on once as a sample of `abu sweep` is.

Number k is sample k % MOST of variant k // MOST; numbers of fresh samples follow behind all others. The store is that
of sweeps; what is there is not computed again.
"""

import dataclasses
import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import field, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.sweep.batches import (
    FLAGS,
    IMPATIENT,
    MEETS,
    MEMBER,
    OUTSIDE,
    QUANTITIES,
    REASON,
    SEED,
    RenewableExecutor,
    Row,
    SampleColumn,
    in_batches,
)
from abu_calc.features.sweep.execution import Attributed, software
from abu_calc.features.sweep.plan import SweepRequest, planned
from abu_calc.features.sweep.samples import SweepStudy
from abu_calc.features.sweep.store import Store
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress
from abu_calc.foundation.shares import chance, compared, lower, middle, upper
from abu_calc.inputs.read_machine import Machine

FIRST: Final = 16
"""Samples of an arm in its first round."""
DROP: Final = 0.001
PROVE: Final = 0.005
"""Risks of one wrong bound, when a candidate is let go and when it is proven."""
RIVALS: Final = 5
"""Best arms of a machine with which each of its others is compared."""
KEEP: Final = 4
"""Part of the arms that goes on from one round to the next is one in so many, and at least so many."""
STEP: Final = 1.25
"""Least growth of an arm's samples in a round."""

Flags = NDArray[np.bool_]
Order = tuple[int, int, int]
"""An arm, the number of its samples there are, and how many there shall be."""
Evaluate = Callable[[Sequence[Order]], Sequence[Flags]]
"""Answers, for each order, which of the further samples meet the limits."""


@dataclasses.dataclass
class CandidateRace:
    """State of the race: `candidates` has a row of arms for each candidate, `costs` its cost.

    `machines[arm]`: the machine of each arm; `most`: samples of one arm; `budget`: samples of all.
    """

    candidates: NDArray[np.int64]
    costs: NDArray[np.float64]
    target: float
    evaluate: Evaluate
    most: int
    budget: int
    met: list[Flags] = field(default_factory=list)
    spent: int = 0
    rounds: int = 0

    def __post_init__(self) -> None:
        arms = int(self.candidates.max()) + 1
        self.met = [np.zeros(0, dtype=np.bool_) for _ in range(arms)]

    def samples(self, arm: int) -> int:
        """Number of samples of an arm."""
        return len(self.met[arm])

    def counts(self, arm: int) -> tuple[int, int]:
        """Samples of an arm that meet the limits, and all."""
        return int(self.met[arm].sum()), len(self.met[arm])

    def sample(self, wanted: dict[int, int]) -> None:
        """Bring each arm to so many samples, as far as the budget goes."""
        orders: list[Order] = []
        for arm in sorted(wanted):
            there = self.samples(arm)
            until = min(wanted[arm], self.most, there + self.budget - self.spent)
            if until > there:
                orders.append((arm, there, until))
                self.spent += until - there
        for (arm, _, until), flags in zip(orders, self.evaluate(orders), strict=True):
            self.met[arm] = np.concatenate([self.met[arm], np.asarray(flags, dtype=np.bool_)])
            if self.samples(arm) != until:
                raise ValueError(f"{until} samples of variant {arm} were ordered, {self.samples(arm)} came")
        self.rounds += bool(orders)

    def least(self, values: Sequence[float]) -> NDArray[np.float64]:
        """The least value of each candidate's arms."""
        least: NDArray[np.float64] = np.asarray(values, dtype=float)[self.candidates].min(axis=1)
        return least

    def shares(self) -> NDArray[np.float64]:
        """Share of each candidate, of its samples; 1 without samples."""
        return self.least([met / of if of else 1.0 for met, of in map(self.counts, range(len(self.met)))])

    def means(self) -> NDArray[np.float64]:
        """Share of each candidate as far as its samples tell: few samples tell little."""
        return self.least([middle(*self.counts(arm)) for arm in range(len(self.met))])

    def proven(self) -> NDArray[np.bool_]:
        """Candidates whose lower bound reaches the wanted share."""
        return self.least([lower(*self.counts(arm), PROVE) for arm in range(len(self.met))]) >= self.target

    def possible(self) -> NDArray[np.bool_]:
        """Candidates whose upper bound reaches the wanted share."""
        return self.least([upper(*self.counts(arm), DROP) for arm in range(len(self.met))]) >= self.target

    def best(self) -> int | None:
        """The cheapest proven candidate, the higher share first among those of one cost."""
        proven = np.flatnonzero(self.proven())
        if not len(proven):
            return None
        means = self.means()
        return int(min(proven, key=lambda k: (self.costs[k], -means[k], k)))


def run(race: CandidateRace) -> int | None:
    """Race until the cheapest candidate is found, or the samples are spent; its number, None if none is proven."""
    group = len(race.met)
    while race.spent < race.budget:
        group = max(group // KEEP, KEEP)
        looks_bad = race.shares() < race.target
        order = np.lexsort((-race.means(), race.costs, looks_bad))
        wanted = _next_samples(race, _open(race), order.tolist(), group)
        if not wanted:
            break
        race.sample(wanted)
    return race.best()


def highest(race: CandidateRace) -> int:
    """Race on for the highest share, whatever it costs; the cheapest of those that are highest."""
    race.sample({arm: FIRST for arm in range(len(race.met)) if race.samples(arm) < FIRST})
    while race.spent < race.budget:
        means = race.means()
        first = int(np.argmax(means))
        alive = np.array([k == first or not _beaten(race, k, first) for k in range(len(means))])
        order = np.lexsort((race.costs, -means))
        wanted = _next_samples(race, alive, order.tolist(), max(int(alive.sum()) // KEEP, KEEP))
        if not wanted:
            break
        race.sample(wanted)
    return int(np.lexsort((race.costs, -race.means()))[0])


def _open(race: CandidateRace) -> NDArray[np.bool_]:
    """Candidates that may still be the answer, without those that are proven."""
    alive = race.possible()
    best = race.best()
    if best is not None:
        alive &= race.costs < race.costs[best] - 1e-12
    alive &= ~race.proven()
    order = np.argsort(-race.means(), kind="stable")
    for rival in order[:RIVALS].tolist():
        for k in np.flatnonzero(alive & (race.costs >= race.costs[rival])).tolist():
            if k != rival and _beaten(race, k, rival):
                alive[k] = False
    return alive


def _beaten(race: CandidateRace, candidate: int, rival: int) -> bool:
    """True if the rival is better by an exact sign test on common samples, and nowhere worse by chance alone."""
    pairs = [
        compared(race.met[theirs], race.met[own])
        for own, theirs in zip(race.candidates[candidate], race.candidates[rival], strict=True)
    ]
    if any(chance(losses, wins) < 0.5 and losses > wins for wins, losses in pairs):
        return False
    return any(chance(wins, losses) < DROP for wins, losses in pairs)


def _next_samples(race: CandidateRace, alive: NDArray[np.bool_], order: Sequence[int], group: int) -> dict[int, int]:
    """Samples of the next round: of the first candidates that are alive, until there are arms enough."""
    wanted: dict[int, int] = {}
    for k in order:
        if len(wanted) >= group:
            break
        if alive[k]:
            unfinished = {arm for arm in race.candidates[k].tolist() if race.samples(arm) < race.most}
            open_arms = {arm for arm in unfinished if not _proven(race, arm)} or unfinished
            wanted |= {arm: _next(race, arm) for arm in open_arms}
    return wanted


def _proven(race: CandidateRace, arm: int) -> bool:
    return lower(*race.counts(arm), PROVE) >= race.target


def _next(race: CandidateRace, arm: int) -> int:
    """Twice as many samples, or as many as prove the share if no more fail."""
    met, of = race.counts(arm)
    if not of:
        return FIRST
    low, high = round(STEP * of), 2 * of
    if lower(met + high - of, high, PROVE) < race.target:
        return high
    while low < high:
        half = (low + high) // 2
        if lower(met + half - of, half, PROVE) >= race.target:
            high = half
        else:
            low = half + 1
    return max(high, round(STEP * of))


ENOUGH: Final = 256
"""Samples of a design on the front."""
LONGEST: Final = 7
"""Designs on the front."""
RUNNERS_UP: Final = 2
FURTHER: Final = 4
"""Designs dearer than the best that are tried for a higher share."""


def front(race: CandidateRace, best: int) -> tuple[int, ...]:
    """Numbers of the candidates on the front by their cost, each with enough samples as far as the budget goes."""
    dearer = [k for k in np.lexsort((-race.means(), race.costs)).tolist() if race.costs[k] > race.costs[best] + 1e-12]
    pool = {k for k in range(len(race.costs)) if race.costs[k] <= race.costs[best] + 1e-12 and _sampled(race, k)}
    for k in (best, *dearer[:FURTHER]) if race.shares()[best] < 1 else (best,):
        _to_enough(race, k)
        pool.add(k)
    while True:
        found = _front(race, best, pool)
        before = race.spent
        for k in found:
            _to_enough(race, k)
        if race.spent == before:
            return _thinned(found, best)


def _sampled(race: CandidateRace, candidate: int) -> bool:
    return all(race.samples(arm) for arm in race.candidates[candidate].tolist())


def _to_enough(race: CandidateRace, candidate: int) -> None:
    arms = race.candidates[candidate].tolist()
    race.sample({arm: ENOUGH for arm in arms if race.samples(arm) < ENOUGH})


def _front(race: CandidateRace, best: int, pool: set[int]) -> list[int]:
    """The best one, cheaper ones that raise the share above all before, and dearer ones above the best one's."""
    shares, found, highest = race.shares(), list[int](), -1.0
    for k in np.lexsort((-race.means(), race.costs)).tolist():
        if k == best or (k in pool and _sampled(race, k) and shares[k] > highest):
            found.append(k)
            highest = max(highest, shares[k])
    return found


def _thinned(found: Sequence[int], best: int) -> tuple[int, ...]:
    """At most so many, with both ends and the best one."""
    if len(found) <= LONGEST:
        return tuple(found)
    places = {round(k * (len(found) - 1) / (LONGEST - 1)) for k in range(LONGEST)}
    return tuple(k for place, k in enumerate(found) if place in places or k == best)


def runners_up(race: CandidateRace, best: int) -> tuple[int, ...]:
    """The two candidates next in cost whose share may reach the wanted one."""
    possible = race.possible()
    others = [k for k in np.flatnonzero(possible).tolist() if k != best]
    means = race.means()
    others.sort(key=lambda k: (abs(race.costs[k] - race.costs[best]), -means[k], k))
    if len(others) < RUNNERS_UP:
        rest = [k for k in np.argsort(-means, kind="stable").tolist() if k != best and k not in others]
        others += rest
    for k in others[:RUNNERS_UP]:
        _to_enough(race, k)
    return tuple(k for k in others[:RUNNERS_UP] if _sampled(race, k))


MOST: Final = 8192
"""Samples of one variant, in the race and fresh."""
COLUMNS: Final = (
    MEMBER, SEED, SampleColumn("variant", "number of the variant, from 0"), SampleColumn("sample", "its sample"),
    *QUANTITIES["build"], *FLAGS["build"], REASON,
)  # fmt: skip
NAMES: Final = tuple(column.name for column in COLUMNS)
KEPT: Final = len(QUANTITIES["build"]) + len(FLAGS["build"]) + 1
"""Last columns, which the rows of a sweep have alike."""
_STUDIES: Final[dict[tuple[str, int], SweepStudy]] = {}
MOST_STUDIES: Final = 4096


@dataclass(frozen=True)
class VariantStudy:
    """All samples of all variants, sent to the workers; `key`: under which a process keeps what it has sized."""

    machines: tuple[Machine, ...]
    variants: tuple[tuple[int, tuple[tuple[str, Any], ...]], ...]
    """Machine of each variant, and its values."""
    requests: tuple[SweepRequest, ...]
    fresh: tuple[SweepRequest, ...]
    """Sampling of the race and of fresh samples, for each machine."""
    accuracy: float
    key: str
    until: float = field(default=math.inf, kw_only=True)

    def rows(self, numbers: tuple[int, ...], may_end_process: bool = False) -> tuple[list[Row], float]:
        """Rows of these samples, and the time for all [s]."""
        begun = time.perf_counter()
        rows = []
        for number in numbers:
            entry, sample = divmod(number, MOST)
            study = replace(self._study(entry), until=self.until)
            ((_, *row),), _ = study.rows((sample,), may_end_process)
            rows.append((number, row[0], entry % len(self.variants), sample, *row[-KEPT:]))
        return rows, time.perf_counter() - begun

    def lost(self, number: int, reason: str) -> Row:
        """The row of one that gave no numbers."""
        entry, sample = divmod(number, MOST)
        return (number, 0, entry % len(self.variants), sample, *(None,) * (KEPT - 1), reason)

    def _study(self, entry: int) -> SweepStudy:
        known = _STUDIES.get((self.key, entry))
        if known is None:
            if len(_STUDIES) >= MOST_STUDIES:
                _STUDIES.clear()
            machine, values = self.variants[entry % len(self.variants)]
            request = (self.fresh if entry >= len(self.variants) else self.requests)[machine]
            plan = planned(self.machines[machine].changed(dict(values)), request, self.accuracy)
            known = _STUDIES[self.key, entry] = plan.study
        return known


class SampleSource:
    """Answers which samples meet the limits, from the store or computed; all are kept in the store."""

    def __init__(self, study: VariantStudy, store: Store, workers: RenewableExecutor, progress: Progress) -> None:
        self.study, self.store, self.workers, self.progress = study, store, workers, progress
        self.computed = 0
        self.impatient = False
        self._meets = NAMES.index(MEETS.name)

    def __call__(self, orders: Sequence[tuple[int, int, int]]) -> list[Flags]:
        """The flags of samples first … last of variants."""
        return self._flags([(arm * MOST + first, arm * MOST + last) for arm, first, last in orders])

    def fresh(self, arm: int, count: int) -> Flags:
        """The flags of fresh samples of a variant."""
        first = (len(self.study.variants) + arm) * MOST
        return self._flags([(first, first + count)])[0]

    def _flags(self, ranges: Sequence[tuple[int, int]]) -> list[Flags]:
        missing = [number for first, last in ranges for number in self._missing(first, last)]
        if missing and not self.impatient:
            self._compute(missing)
        return [self._there(first, last) for first, last in ranges]

    def _missing(self, first: int, last: int) -> Iterator[int]:
        query = "SELECT member FROM members WHERE member >= ? AND member < ? AND COALESCE(reason, '') NOT LIKE ?"
        there = {row[0] for row in self.store.ask(query, (first, last, f"{OUTSIDE}%"))}
        return (number for number in range(first, last) if number not in there)

    def _there(self, first: int, last: int) -> Flags:
        query = "SELECT member, meets_limits, reason FROM members WHERE member >= ? AND member < ?"
        flags = np.zeros(last - first, dtype=np.bool_)
        for number, met, reason in self.store.ask(query, (first, last)):
            flags[number - first] = bool(met)
            self.impatient |= reason == IMPATIENT
        return flags

    def _compute(self, numbers: list[int]) -> None:
        before, total = self.computed, len(numbers)

        def take(entries: list[Row]) -> None:
            """Keep the rows of a batch, with who computed them."""
            for worker, its_software, rows in entries:
                self.store.put(rows, worker, its_software)
                self.computed += len(rows)
            done = self.computed - before
            self.progress(f"optimise: {done} of {total} samples of this round, {self.computed} in all")

        in_batches(Attributed(self.study, software()), iter(numbers), self.workers, take, size=4)
        if self.store.ask("SELECT COUNT(*) FROM members")[0][0] < total:
            raise NotTrustworthyError(f"{self.store.path}: another program removed samples")
