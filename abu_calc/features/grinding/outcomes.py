"""Motions that the start cases of grinding end with, sorted into groups; the last classes are those of results."""

import cmath
import math
import statistics
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Annotated, Final, Literal, Self

from abu_calc.features.grinding.start_cases import (
    FEW,
    STEADY,
    LoadedEnsemble,
    LoadedOutcome,
    Pressed,
    loaded_ensemble,
)
from abu_calc.features.grinding.work import LOUDER, Work, below
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.simulation.start_cases import Lost
from abu_calc.sizing.places import handle_levels

State = Literal["balanced", "held by friction", "not balanced", "swinging", "stalled", "bouncing"]

SAME: Final = 10 ** (LOUDER / 20) - 1
"""Imbalances that differ by this share of the smaller one differ by 1 dB."""

HARDLY: Final = 0.02
"""Share of the wheel's imbalance by which friction that is shaken out lets balls rest beside their places."""


@record
class LoadedOutcomeGroup(Record):
    """Start cases of one way of pressing that end with the same motion under load.

    `share`: of the start cases of that way of pressing, those without an answer included. Levels: the median, the
    lowest and the highest of the group.
    """

    pressed: Annotated[
        str, Quantity("pressed", "", 4, "settled: after the balls settled at idle, as one works; or at once")
    ]
    state: Annotated[
        str,
        Quantity("motion", "", 4, "balanced, held by friction, not balanced, swinging, stalled or bouncing"),
    ]
    count: Annotated[int, Quantity("start cases")]
    total: Annotated[int, Quantity("start cases of that way of pressing")]
    share: Annotated[float, Quantity("share", "", 3, "", percent=True)]
    level: Annotated[float, Quantity("level, median", "L", unit="db")]
    lowest: Annotated[float, Quantity("lowest level", "L", unit="db")]
    highest: Annotated[float, Quantity("highest level", "L", unit="db")]
    apart: Annotated[float, Quantity("share of the time without contact, at most", "", 3, "", percent=True)]
    steady: Annotated[bool, Quantity("levels no longer change")]
    loudest_start: Annotated[str, Quantity("loudest start case")]


def state_of(work: Work, outcome: LoadedOutcome) -> State:
    """The motion in one word.

    A machine bounces if wheel and workpiece lose contact in the observed time. Balls at rest balance if the imbalance
    is within 1 dB of the one that steady contact asks for with this place of the race's centre, or within a fiftieth
    of the wheel's imbalance; else dry friction holds them. Without friction, or if no place at this contact is one
    where they balance, they are not balanced.
    """
    if outcome.parts:
        return "bouncing"
    if outcome.stalls:
        return "stalled"
    if outcome.swings:
        return "swinging"
    steady, autobalancer = work.fitted.steady, work.design.autobalancer
    balls = steady.balls
    friction = work.design.case.friction_arm > 0
    if balls is None or balls.places not in ("balanced", "restless"):
        return "held by friction" if balls is not None and balls.places == "turning" and friction else "not balanced"
    wanted = _without_friction(work, outcome)
    near = max(SAME * abs(wanted), HARDLY * abs(work.design.imbalance.value * autobalancer.requirement.plane_ratio))
    if abs(outcome.imbalance - wanted) <= near:
        return "balanced"
    return "held by friction" if friction else "not balanced"


def _without_friction(work: Work, outcome: LoadedOutcome) -> complex:
    """Imbalance [kg m] of wheel and balls in the race plane with which the centre of the race does not whirl forward.

    G·U + runout's part + Δ·e^{iβ} = 0 with the whirl G per imbalance: U = U₀ − Δ·e^{iβ}/G, where U₀ is that of a
    race on the axis. Source: derived, from `formulas.tilting_contact`; race in the plane of the wheel.
    """
    steady, case, autobalancer = work.fitted.steady, work.design.case, work.design.autobalancer
    centre = cmath.rect(case.race_eccentricity, outcome.start.member.eccentricity)
    ratio = autobalancer.requirement.plane_ratio
    on_axis = work.design.imbalance.value * abs(ratio) + (steady.balls.needed if steady.balls else 0j)
    return on_axis - centre / steady.contact.whirl_per_imbalance


def groups_of(work: Work, ensemble: LoadedEnsemble) -> tuple[LoadedOutcomeGroup, ...]:
    """Motions that start cases end with, for each way of pressing, the loudest first.

    Levels of one state that leave a gap of more than 1 dB are two motions, and of more by as much as they still change.
    Balls held by friction may rest anywhere within a band, so that they are one.
    """
    groups: list[LoadedOutcomeGroup] = []
    for when in ("settled", "at once"):
        outcomes = ensemble.pressed(when)
        count = len(outcomes) + len(ensemble.without_answer(when))
        by_state: dict[State, list[LoadedOutcome]] = {}
        for outcome in sorted(outcomes, key=lambda candidate: candidate.level):
            by_state.setdefault(state_of(work, outcome), []).append(outcome)
        own = [_group(when, state, part, count) for state, several in by_state.items()
                  for part in _parts(state, several)]  # fmt: skip
        groups += sorted(own, key=lambda group: -group.highest)
    return tuple(groups)


def _parts(state: State, outcomes: Sequence[LoadedOutcome]) -> list[list[LoadedOutcome]]:
    """Outcomes of one state in ascending level, cut where a gap is."""
    parts = [[outcomes[0]]]
    for before, outcome in pairwise(outcomes):
        if state != "held by friction" and outcome.level - before.level > LOUDER + before.drift + outcome.drift:
            parts.append([])
        parts[-1].append(outcome)
    return parts


def _group(when: Pressed, state: State, outcomes: Sequence[LoadedOutcome], count: int) -> LoadedOutcomeGroup:
    return LoadedOutcomeGroup(
        pressed=when,
        state=state,
        count=len(outcomes),
        total=count,
        share=len(outcomes) / count,
        level=statistics.median(outcome.level for outcome in outcomes),
        lowest=outcomes[0].level,
        highest=outcomes[-1].level,
        apart=max(outcome.apart for outcome in outcomes),
        steady=all(outcome.drift <= STEADY for outcome in outcomes),
        loudest_start=outcomes[-1].start.name,
    )


@dataclass(frozen=True)
class GrindingOutcomes:
    """The start cases of a machine at its workpiece, sorted, and whether each is below the level without.

    `before` [dB]: that level; `scatter` [dB]: how far it may be off; `bouncing` [dB]: how far the level of a start case
    that bounces may be off, by the scatter of the chaotic runs with the autobalancer.
    """

    ensemble: LoadedEnsemble
    groups: tuple[LoadedOutcomeGroup, ...]
    before: float | None
    scatter: float = 0.0
    bouncing: float = 0.0

    @property
    def worst(self) -> float | None:
        """The highest level of all start cases [dB]."""
        return max((outcome.level for outcome in self.ensemble.outcomes), default=None)

    @property
    def loudest(self) -> LoadedOutcomeGroup | None:
        """The group with the highest level."""
        return max(self.groups, key=lambda group: group.highest, default=None)

    def lowered(self, when: Pressed) -> bool | None:
        """True if every start case of one way of pressing ends below the level without the autobalancer.

        False if one does not. None if one has no answer, or its level is too near to tell: they differ by no more than
        chaotic runs scatter.
        """
        answers = [below(outcome.level, self.before, self._doubt(outcome)) for outcome in self.ensemble.pressed(when)]
        if False in answers:
            return False
        return None if None in answers or not answers or self.ensemble.without_answer(when) else True

    def count(self, when: Pressed) -> int:
        """Number of start cases of one way of pressing, those without an answer included."""
        return len(self.ensemble.pressed(when)) + len(self.ensemble.without_answer(when))

    def louder(self, when: Pressed) -> tuple[LoadedOutcome, ...]:
        """The start cases that do not end below the level without the autobalancer, the loudest last."""
        outcomes = sorted(self.ensemble.pressed(when), key=lambda outcome: outcome.level)
        return tuple(
            outcome for outcome in outcomes if below(outcome.level, self.before, self._doubt(outcome)) is False
        )

    def _doubt(self, outcome: LoadedOutcome) -> float:
        own = max(outcome.drift if outcome.drift > STEADY else 0.0, self.bouncing if outcome.parts else 0.0)
        return self.scatter + own

    @property
    def lost(self) -> tuple[Lost, ...]:
        """The start cases without an answer."""
        return self.ensemble.lost


def with_starts(work: Work, ensemble: LoadedEnsemble | None) -> tuple[Work, GrindingOutcomes | None]:
    """The machine with the start cases of its grinding, sorted; None for a machine without such.

    The level of the usual case, pressed when the balls have settled, stays what it was, unless the median of the start
    cases pressed so is more than 1 dB above it: then it was that of an easier case, and the median takes its place. So
    it does if the usual case has no level, its motion depending on the start, and every start case has one.
    """
    if ensemble is None:
        return work, None
    settled, usual = ensemble.pressed("settled"), work.levels.after
    if settled and (usual is not None or not ensemble.without_answer("settled")):
        typical = statistics.median_high(sorted(outcome.velocity for outcome in settled))
        moved = math.sqrt(2) * typical / work.design.case.speed
        raised = handle_levels(work.design.case, work.moved_without, moved, work.design.autobalancer.mass)
        if usual is None or (raised.worst.after or -math.inf) > usual + LOUDER:
            work = replace(work, settled=raised, moved=moved)
    bouncing = max(work.fitted.scatter, work.at_once.scatter)
    return work, GrindingOutcomes(
        ensemble, groups_of(work, ensemble), work.levels.before, work.without.scatter, bouncing
    )


def loudest_start(work: Work, accuracy: float) -> float | None:
    """The highest level [dB] of all start cases of grinding; None unless each is below the level without.

    A few are run first, since one that is not below is enough.
    """
    worst = work.levels.after
    for most in (FEW, None):
        _, loads = with_starts(work, loaded_ensemble(work.design, accuracy, most=most))
        if loads is None:
            return worst
        if not (loads.lowered("settled") and loads.lowered("at once")):
            return None
        worst = loads.worst
    return worst


@record
class LoadedStarts(Record):
    """The start cases of grinding: how many there are, how many gave no answer, the highest level, and the outcomes."""

    count: Annotated[int, Quantity("start cases")]
    without_answer: Annotated[int, Quantity("without an answer")]
    worst: Annotated[float | None, Quantity("highest level", "L", unit="db")]
    outcomes: tuple[LoadedOutcomeGroup, ...]

    @classmethod
    def of(cls, loads: GrindingOutcomes | None) -> Self | None:
        """None for a machine whose contact does not press in the plane of the wheel."""
        if loads is None:
            return None
        return cls(count=loads.ensemble.count, without_answer=len(loads.lost), worst=loads.worst, outcomes=loads.groups)
