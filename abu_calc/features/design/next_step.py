"""The next step for a machine that does not simply suit: a change of its file, tried by the verdict it leads to.

Each change is a set of entries as `--set` takes them. It is followed literally: the file with them is judged as
`abu size` does it. A change counts only if the verdict gets better and no check gets worse.
"""

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain, combinations, groupby, islice
from operator import attrgetter
from typing import Any, Final, NamedTuple, Protocol

from abu_calc.features.design.changes import changes_for_starts
from abu_calc.features.design.judgement import ACCURACY, Judgement, TrialWatcher
from abu_calc.features.design.judgement import judge as judge_file
from abu_calc.features.design.region import steadier
from abu_calc.features.design.start_rules import FULL, LEVEL, RULES, StartFacts
from abu_calc.features.design.start_rules import OF_STARTS as OF_BALANCE
from abu_calc.features.design.start_search import loudness, slowness
from abu_calc.features.design.verdict import WORDS, Verdict, creeps
from abu_calc.foundation import patience
from abu_calc.foundation.checks import RANK, Action, Check, worst
from abu_calc.foundation.errors import AbuError
from abu_calc.foundation.moved import Moved
from abu_calc.foundation.progress import Progress, within
from abu_calc.foundation.units import from_si
from abu_calc.inputs.read_machine import Machine, variant_of
from abu_calc.reporting.blocks import capitalised
from abu_calc.simulation.ensemble import Once
from abu_calc.simulation.records import finite
from abu_calc.simulation.result import Provenance
from abu_calc.simulation.start_cases import SLACK, Lost, Member, StartOutcome
from abu_calc.sizing.actions import SIMULATED, overrides, pins
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.proposals import ARM, ON_ARM, PINNED, PROPOSED, in_words, mended

Entries = tuple[str, ...]
"""Entries of a file, each as one `--set` takes it."""

MOST_TRIALS: Final = 48
"""Changes that are tried by start cases."""
MOST_PAIRS: Final = 12
"""Two changes together that are tried at the end."""
LEAST_WORK: Final = 2_000_000
"""Evaluations that all trials that do not help may take at least; else half as many as the file as it is."""
NEAR: Final = 0.4
"""Nearness of a start case to its limits above which a run at a tighter tolerance may find that it keeps them."""
PROMISING: Final = 4_000_000
"""Evaluations that a trial may take if the start cases that fail as the file is hold with the change."""
STABLE: Final = "stability"
"""Key of the check of stability."""
REPEATED: Final = 6
"""Start cases that fail as the file is, which run first with a change, the worst ones."""


class Judged(Protocol):
    """What a trial knows of a machine, with one race or two."""

    @property
    def facts(self) -> StartFacts:
        """Design and start cases."""

    @property
    def checks(self) -> tuple[Check, ...]:
        """All checks."""

    @property
    def outcomes(self) -> Iterator[StartOutcome]:
        """Every start case that was simulated."""

    @property
    def level_after(self) -> float | None:
        """Idle level with the autobalancer at the loudest place [dB]."""


class Judge(NamedTuple):
    """How a kind of machine is judged, and how one of its start cases is run; `closer`: at a tighter tolerance.

    `slack`: how far below its limit a start case has to stay for a check of the level to pass [dB].
    """

    judged: Callable[[Machine, Progress, TrialWatcher], Judged]
    once: Once
    slack: float = SLACK


class Tried(NamedTuple):
    """A change that was tried: its entries, and the machine with them as judged."""

    entries: Entries
    after: Judged


def harmless(machine: Machine, before: Iterable[Check], entries: Entries, accuracy: float = ACCURACY) -> bool:
    """True if no check of `abu size` gets worse with a change of a machine with one race."""
    if not entries:
        return True
    try:
        changed = variant_of(machine, ",".join(entries)).whole("size")
        judge_file(changed, accuracy, trial=NoWorse(before))
    except (NotBetterError, AbuError):
        return False
    return True


class NextStep(NamedTuple):
    """The best change of a machine, None if none helps, and the changes that were tried without success, in words.

    `hurried`: whether the work that trials may take was over before all changes were tried.
    """

    best: Tried | None
    without_success: tuple[str, ...] = ()
    hurried: bool = False

    @property
    def futile(self) -> bool:
        """True if all changes were tried and none helps."""
        return self.best is None and not self.hurried

    @property
    def entries(self) -> Entries:
        """Entries of the best change."""
        return () if self.best is None else self.best.entries


class NotBetterError(Exception):
    """A change leads to no better verdict, or makes a check worse."""


class EnoughError(Exception):
    """The start cases that decide hold with a change: no more was asked of its trial."""


class TooLongError(Exception):
    """A trial takes more work than is left: nothing is known of the change."""


class NoWorse(TrialWatcher):
    """A trial of one change of a machine: it ends as soon as a check gets worse.

    `worse_than`: rank of a grade that no check may have; by default there is none.
    """

    def __init__(self, before: Iterable[Check], worse_than: int = -1) -> None:
        self.worse_than = worse_than
        self.ranks = {_key(check): RANK.index(check.status) for check in before}

    def checked(self, checks: Iterable[Check]) -> None:
        """Raise NotBetterError for a check that is worse than before, or as bad as the verdict may not be."""
        for check in checks:
            rank = RANK.index(check.status)
            if check.requested and (rank <= self.worse_than or rank < self.ranks.get(_key(check), PASS)):
                raise NotBetterError


class ChangeWatcher(NoWorse):
    """A trial of one change of a machine: it ends as soon as the verdict cannot be better, or a check gets worse.

    `worse_than`: rank of the grade that the verdict has to excel; `most`: the evaluations that it may take, more if
    start cases hold that fail with the `best` change so far; `held`: start cases that held, of the last how nearly.
    `refuting`: start cases that ended other trials, each with its design, the last first.
    """

    def __init__(
        self, before: Judged, worse_than: int, judge: Judge, most: float = math.inf, best: Judged | None = None,
        refuting: list[tuple[Any, Member]] | None = None, *, probe: bool = False,
    ) -> None:  # fmt: skip
        super().__init__(before.checks, worse_than)
        self.judge, self.most, self.best, self.probe = judge, most, best or before, probe
        self.refuting = [] if refuting is None else refuting
        self.work, self.held = 0, 0.0
        self.stable = all(check.status == "pass" for check in before.checks if check.key == STABLE)
        self.every = worse_than == RANK.index("warn")

    def seen(self, design: Any, outcome: StartOutcome | Lost) -> None:
        """Raise NotBetterError for the first start case that does not hold as it has to."""
        self.work += outcome.work
        if self.work > self.most:
            raise TooLongError
        decides = self.every or outcome.member.promised
        if decides and not self._holds(outcome, design):
            if _nearness(outcome, design) > NEAR:
                outcome = self.judge.once(design, outcome.member, closer=True)
                self.work += outcome.work
            if not self._holds(outcome, design):
                self.held += _nearness(outcome, design)
                self.refuting[:] = [(design, outcome.member), *self.refuting][:REPEATED]
                raise NotBetterError
        self.held += 1

    def _holds(self, outcome: StartOutcome | Lost, design: Any) -> bool:
        """True if a start case keeps the limits, all checks pass by it if they must, or it gave no answer."""
        if isinstance(outcome, Lost):
            return True
        limits = design.case.table.limits
        if not self.every:
            return outcome.holds(limits, limits.vibration_level_db + SLACK)
        broken = any(rule.breaks(outcome, design) for rule in OF_BALANCE)
        return not broken and outcome.level + self.judge.slack <= limits.vibration_level_db

    def repeated(self, design: Any) -> None:
        """Run the start cases that ended other trials, then those that fail with the best change so far, or warn where
        all must pass; raise NotBetterError if one does not hold, EnoughError if all hold and no more is wanted.
        """
        own = self.best.facts.design
        decide = (run for run in self.best.outcomes if self.every or run.member.promised)
        bad = [run for run in decide if not self._holds(run, own)]
        bad.sort(key=lambda run: (run.hanging, run.quiet_time_or_inf, run.level), reverse=True)
        again = [*self.refuting, *((own, run.member) for run in bad[:REPEATED])]
        for member in dict.fromkeys(filter(None, (_in_design(design, *each) for each in again))):
            self.seen(design, self.judge.once(design, member))
        if bad:
            self.most = max(self.most, PROMISING)
        if self.probe:
            raise EnoughError


def _in_design(design: Any, own: Any, member: Member) -> Member | None:
    """The start case of another design that stands for one of its own; None: there is none."""
    case, other = design.case, own.case
    placed = not member.angles or len(member.angles) == sum(made.ball_count for made in design.autobalancers)
    run_up = not member.run_up or case.table.run_up == other.table.run_up
    if not (placed and run_up and (member.speed is None or case.speed_range == other.speed_range)):
        return None
    known, shares = other.drag_shares, case.drag_shares
    share = member.drag / other.drag if other.drag else 1.0
    near = min(range(len(known)), key=lambda k: abs(math.log(known[k] / share)))
    own_share = shares[near] if math.isclose(known[near], share, rel_tol=ALIKE) else share
    return replace(member, drag=own_share * case.drag)


PASS: Final = RANK.index("pass")


def _nearness(outcome: StartOutcome | Lost, design: Any) -> float:
    """How near a start case that fails comes to its limits, between 0 and 1."""
    if isinstance(outcome, Lost) or outcome.hanging:
        return 0.0
    limits = design.case.table.limits
    late: float = outcome.quiet_time_or_inf / limits.longest_quiet_time
    loud: float = 10 ** ((outcome.level - limits.vibration_level_db) / 20)
    return 1 / (1 + max(late, loud))


def _key(check: Check) -> tuple[str, str]:
    return check.code, check.name


def next_step(
    machine: Machine, before: Judged, proposals: Iterable[Entries], judge: Judge, progress: Progress
) -> NextStep:
    """The first change with which all checks pass, else the one with the best verdict of those tried.

    It costs nothing where nothing is wrong. Where something is, all trials that do not help take half as long as the
    file as it is, or `LEAST_WORK`.
    """
    best, rank, tried, hurried = None, RANK.index(worst(before.checks)), list[str](), False
    held, better, futile = dict[Entries, float](), list[Entries](), set[Entries]()
    refuting = list[tuple[Any, Member]]()
    work = max(sum(run.work for run in before.outcomes) / 2, LEAST_WORK)
    left = math.inf if patience.given() else work
    for entries, probe in _with_pairs(proposals, held, better, futile):
        if rank == PASS or len(held) == MOST_TRIALS:
            break
        if left <= 0 or patience.over():
            hurried = True
            break
        trial = ChangeWatcher(before, rank, judge, left + work, best and best.after, refuting, probe=probe)
        try:
            tell = within(progress, f"with {in_words(entries)}")
            after = judge.judged(variant_of(machine, ",".join(entries)), tell, trial)
            best, rank = Tried(entries, after), RANK.index(worst(after.checks))
            better.insert(0, entries)
            left += trial.work
        except NotBetterError:
            tried.append(in_words(entries))
            futile.add(entries)
        except TooLongError:
            hurried = True
        except EnoughError:
            trial.held = 0
        except AbuError:  # the file refuses it
            continue
        left -= trial.work
        if trial.work:
            held[entries] = trial.held
    return NextStep(best, tuple(tried), hurried)


TRUE: Final = "race_eccentricity_mm"
"""Key of which several values are proposed one after the other, the mildest first."""


def _with_pairs(
    proposals: Iterable[Entries], held: Mapping[Entries, float], better: Sequence[Entries], futile: Collection[Entries]
) -> Iterator[tuple[Entries, bool]]:
    """Changes, each alone and with the first of those that are `better`, then two of them together.

    The first two are those with which the most start cases `held`. Before several race eccentricities the least one is
    probed, which comes with True: if it is `futile`, so are the others.
    """
    known = set[frozenset[str]]()

    def new(entries: Entries) -> bool:
        count = len(known)
        known.add(frozenset(entries))
        return bool(entries) and len(known) > count

    for _, races in groupby(proposals, key=lambda change: tuple(entry for entry in change if TRUE not in entry)):
        alone = list(races)
        for changes in (alone, [_as_one(each, change) for each in better[:1] for change in alone]):
            fresh = list(filter(new, changes))
            if len(fresh) > 2:
                yield fresh[-1], True
            yield from ((entries, False) for entries in fresh if not (len(fresh) > 2 and fresh[-1] in futile))
    for _ in range(MOST_PAIRS):
        by_held = sorted(filter(held.get, held), key=lambda entries: held[entries], reverse=True)
        pairs = sorted(combinations(by_held, 2), key=lambda pair: sum(held[each] for each in pair), reverse=True)
        both = next(filter(new, (_as_one(*pair) for pair in pairs)), None)
        if both is None:
            return
        yield both, False


class Number(NamedTuple):
    """A number of the result that decides a check: its path, its name and unit, and how it is read.

    `per`: the check's value over it.
    """

    path: str
    name: str
    unit: str
    of: Callable[[Judged], float | None]
    per: float = 1.0


def _of_starts(value: Callable[[StartOutcome], float], *, further: bool = False) -> Callable[[Judged], float | None]:
    """The largest of the listed or of the further start cases; None for one that never is, NaN without any."""

    def largest(judged: Judged) -> float | None:
        facts = judged.facts
        starts = facts.searched if further else facts.ensemble
        return math.nan if starts is None else finite(max(map(value, starts.outcomes), default=math.inf))

    return largest


def _rare(judged: Judged) -> float | None:
    """Quiet time that one start case of 1000 exceeds; NaN where none was searched."""
    searched = judged.facts.searched
    return math.nan if searched is None else finite(searched.foreseen)


def _of_one(judged: Judged) -> bool:
    """True of a machine with one race."""
    return len(judged.facts.design.autobalancers) == 1


def _number(value: Callable[[Candidate], float | None]) -> Callable[[Judged], float | None]:
    return lambda judged: value(judged.facts.design.autobalancer) if _of_one(judged) else None


NUMBERS: Final[Mapping[str, tuple[Number, ...]]] = {
    "capacity": (
        Number("autobalancer.capacity_g_mm", "the capacity", "g·mm",
               _number(lambda candidate: from_si(candidate.capacity, "g_mm"))),
    ),
    "mass": (
        Number("autobalancer.mass_fraction", "the share of the mass", "%", _number(attrgetter("mass_fraction")), 100.0),
    ),
    "idle_level": (
        Number("vibration.level_after_db", "the expected level", "dB", attrgetter("level_after")),
        Number("ensemble.level_db.worst", "the loudest listed start case", "dB", _of_starts(attrgetter("level"))),
        Number("ensemble.further_starts.level_db", "the loudest further start case", "dB",
               _of_starts(loudness, further=True)),
    ),
    "quiet_time": (
        Number("ensemble.quiet_time_s.worst", "the slowest listed start case", "s", _of_starts(slowness)),
        Number("ensemble.further_starts.quiet_time_s", "the slowest further start case", "s",
               _of_starts(slowness, further=True)),
        Number("ensemble.further_starts.rare_quiet_time_s", "the quiet time of one start in 1000", "s", _rare),
    ),
}  # fmt: skip
"""Numbers by which checks are decided, by their keys."""


def _moved(check: Check, before: Judged, after: Judged) -> tuple[Number, float | None, float] | None:
    """The number that breaks the limit of a check and keeps it with a change, before and after; None: there is none."""
    for number in NUMBERS.get(check.key, ()):
        old, new = number.of(before), number.of(after)
        limit, sign = (check.limit or 0.0) / number.per, 1 if check.bound == "most" else -1
        kept = [value is not None and sign * value <= sign * limit for value in (old, new)]
        known = check.limit is not None and not (old is not None and math.isnan(old))
        if known and new is not None and kept == [False, True]:
            return number, old, new
    return None


def promise(before: Judged, step: NextStep) -> dict[str, str | float | None] | None:
    """What the change moves: the path of a number of the result that breaks a limit, from what and to what.

    By the first check that decides the verdict; where no such number does, the word of the verdict. None: no change.
    """
    if step.best is None:
        return None
    after, grade = step.best.after, worst(before.checks)
    deciding = (check for check in before.checks if check.requested and check.status == grade)
    for number, old, new in filter(None, (_moved(check, before, after) for check in deciding)):
        return {"path": number.path, "from": old, "to": new}
    return {"path": "verdict.word", "from": WORDS[grade], "to": WORDS[worst(after.checks)]}


SEATS: Final = "6"
"""First digit of the codes of bearing seats, whose actions are followed where they are judged and move nothing else."""


def actions(before: Judged, step: NextStep) -> tuple[Check, ...]:
    """The checks with their actions: the change that was tried where it helps; no other change is proposed."""
    keys = SEARCHED if _of_one(before) else OF_STARTS
    bad = [check for check in before.checks
           if check.requested and check.status != "pass" and (_searched(check, keys) or not check.remedy)]  # fmt: skip
    first, checks = min(bad, key=lambda check: RANK.index(check.status), default=None), list[Check]()
    for check in before.checks:
        if check.status == "pass" or not check.requested:
            checks.append(check)
            continue
        known = bool(check.remedy) and not _searched(check, keys)
        action: Action | str | None = Action(check.remedy or "", check.overrides) if known else None
        if step.best is not None:
            after = next((each for each in step.best.after.checks if _key(each) == _key(check)), None)
            if after is None or RANK.index(after.status) > RANK.index(check.status):
                action = _action(check, before, step.best)
        elif action is None:
            own = first is None or check.code == first.code
            action = _no_change(step) if own or first is None else f"See the action of {first.code}."
        checks.append(check.with_action(action))
    return tuple(checks)


def _searched(check: Check, keys: Collection[str]) -> bool:
    """True if changes are tried for a check that is beyond its limit, by its key: then no other one is proposed."""
    if check.code[3] == SEATS:
        return False
    return bool(check.overrides) or (check.key in keys and check.value is not None and check.limit is not None)


OF_STARTS: Final = frozenset(rule.key for rule in RULES)
SEARCHED: Final = (PROPOSED.keys() - ON_ARM) | OF_STARTS | {STABLE}
"""Keys of the checks for which changes are tried; those of an arm have a remedy for example data alone."""


def _no_change(step: NextStep) -> str:
    untried = " Others were not tried, since that takes long (--patience 300 tries them)." if step.hurried else ""
    if not step.without_success:
        return f"No change of the file was found that mends this.{untried}"
    tried, more = step.without_success[:TOLD], len(step.without_success) - TOLD
    also = f"; and {more} more" if more > 0 else ""
    return f"No change was found with which the machine suits. Tried: {'; '.join(tried)}{also}.{untried}"


ALIKE: Final = 1e-3
"""Relative change of a value that is not told."""
TOLD: Final = 6
"""Changes without success that are told."""


def _action(check: Check, before: Judged, best: Tried) -> Action:
    """The change with what it does to the number that decides this check, and to all other checks."""
    left = dict.fromkeys(each.code for each in best.after.checks if each.requested and each.status != "pass")
    then = f"Then {', '.join(left)} still warn{'s' * (len(left) == 1)}." if left else "All checks then pass."
    found, text = _moved(check, before, best.after), f"{check.name} then passes"
    now = next((each for each in best.after.checks if _key(each) == _key(check)), check)
    if check.code in left:
        text = f"{check.name} then warns"
    elif creeps(check):
        text = "the balls then come to rest"
    elif found is not None:
        number, old, new = found
        from_, to = (math.inf if value is None else value * number.per for value in (old, new))
        text = Moved(number.name, from_, to, number.unit, check.limit).text
    elif check.key not in OF_STARTS | NUMBERS.keys() and _apart(check.value, now.value):
        text = Moved(f'"{check.name}"', check.value or 0.0, now.value or 0.0, check.unit or "", now.limit).text
    own = _own(before)
    change = in_words(best.entries, before.facts.design.case.table, own)
    kept = " Keep balls and race." if own and set(own) <= set(best.entries) else ""
    return Action(f"{capitalised(change)}: {text} ({SIMULATED}).{kept} {then}", best.entries)


def _own(before: Judged) -> Entries:
    """Entries that pin the present balls and race; none of two races."""
    return overrides(pins(before.facts.design.autobalancer)) if _of_one(before) else ()


def verdict_of(judged: Judged, checks: Sequence[Check], step: NextStep, told: str, reading: Provenance) -> Verdict:
    """The verdict with what the autobalancer does, as it is `told`, and the change that mends the machine."""
    sought = judged.facts.starts == FULL and not patience.over()
    return Verdict.of(
        checks, told, reading, step.entries, promise(judged, step), incurable=sought and step.futile,
        change=_in_short(judged, step),
    )  # fmt: skip


def _in_short(before: Judged, step: NextStep) -> str | None:
    """The change that was tried, without what it replaces: balls come last."""
    return in_words(step.entries, None, _own(before)).partition(" instead of ")[0] if step.entries else None


def _apart(before: float | None, after: float | None) -> bool:
    """Whether two values differ as a reader sees them."""
    return before is not None and after is not None and not math.isclose(before, after, rel_tol=ALIKE)


def proposals(before: Judgement) -> Iterator[Entries]:
    """Changes that are worth a trial, without repetition: those that mend checks, each and all together, then those for
    start cases, each by itself and with these.
    """
    bad = sorted((check for check in before.checks if check.requested and check.status != "pass"),
                 key=lambda check: RANK.index(check.status))  # fmt: skip
    design = before.facts.design
    mending, keys = mended(design), {check.key for check in bad}
    outside = before.arm is not None and any(check.status in ("fail", "not-done") for check in before.arm.checks)
    on_arm = _changes_on_arm(before, mending[0] if mending and outside else {})
    arm = [*islice(on_arm, 1)]
    calculated = [overrides(entries) for entries in (*(arm if outside else ()), *mending)]
    others = dict.fromkeys(check.overrides for check in bad if check.overrides)
    steady = steadier(design, before.region.boundaries or ()) if STABLE in keys else None
    first = {} if steady is None else {**steady, **pins(design.autobalancer)}
    others |= dict.fromkeys([overrides(first)] if first else ())
    of_starts: list[Mapping[str, object]] = []
    if keys & OF_STARTS and design.frequency.balancing_possible:
        of_starts = [*changes_for_starts(before.facts, loud=LEVEL.key in keys)]
    if outside and arm:  # nothing else helps without
        held = {key: value for key, value in arm[0].items() if key.startswith(ARM)}
        of_starts = [{**held, **entries} for entries in of_starts]
    elif arm:
        of_starts[2:2] = arm
    starts = [_as_one(overrides(first), overrides(entries)) for entries in of_starts]  # unstable, all would fail
    yield from together([*calculated[:1], *others], starts, calculated[1:])
    yield from map(overrides, on_arm)


def _changes_on_arm(before: Judgement, mending: Mapping[str, object]) -> Iterator[Mapping[str, object]]:
    """Changes of the swing arm beyond its bounds, on top of what mends the checks of sizing."""
    if before.arm is None:
        return
    from abu_calc.features.swing_arm.proposals import changes_on_arm

    limits, lost = before.design.case.table.limits, {fault.scene for fault in before.failures}
    late = [run.member.on_arm for run in before.outcomes if not run.holds(limits, limits.vibration_level_db)]
    strict = worst(before.checks) == "warn"
    yield from changes_on_arm(before.design, before.arm, mending, lost, late=bool(late) and all(late), strict=strict)


def together(
    calculated: Sequence[Entries], of_starts: Sequence[Entries], partly: Sequence[Entries] = ()
) -> Iterator[Entries]:
    """Changes of either kind, each alone, those calculated as one, and those for start cases with these as one.

    `partly`: changes that come before those for start cases.
    """
    whole = _as_one(*calculated)
    paired = (_as_one(whole, entries) for entries in of_starts) if whole else ()
    known = set[frozenset[str]]()
    for entries in filter(None, chain(calculated, [whole], partly, of_starts, paired)):
        if frozenset(entries) not in known:
            known.add(frozenset(entries))
            yield entries


LESS: Final = ("autobalancer.race_eccentricity_mm", "autobalancer.rolling_friction_mm")
"""Values that are the better, the less they are."""


def _as_one(*changes: Entries) -> Entries:
    """Several changes as one, with the balls and the race of the first that pins any, and the truest of the races; none
    if they set another key to different values.
    """
    entries = dict[str, str]()
    for entry in chain.from_iterable(changes):
        key = entry.partition("=")[0]
        if entries.setdefault(key, entry) == entry or key in PINNED:
            continue
        if key not in LESS:
            return ()
        entries[key] = min(entry, entries[key], key=lambda text: float(text.partition("=")[2]))
    return tuple(entries.values())
