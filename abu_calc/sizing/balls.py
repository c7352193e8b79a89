"""Step 5: choice of the balls, their number and the race radius, among stock sizes that fit the envelope.

Values that the file has pinned are kept.
"""

from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from typing import Final

from abu_calc.formulas.balls import best_count, capacity, corrector_mass, half_angle, most_balls
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, shown
from abu_calc.sizing.budget import (
    CandidateBalls,
    Requirement,
    ResidualBudget,
    budget_where_worst,
    fan,
    ovality_residual,
    permitted_displacement,
    required_capacity,
)
from abu_calc.sizing.case import Case, working_speeds
from abu_calc.sizing.housing import (
    Housing,
    balls_go_in,
    dimensions,
    greatest_race_radius,
    housing,
    least_race_radius,
    width,
)
from abu_calc.sizing.manufacture.bearing_ring import fitting_rings, nearest_ring, pinned_ring, ring_of, sphere_band
from abu_calc.sizing.strength import Roundness, Strength, roundness, strength
from abu_calc.standards.balls import material, stock_diameter, stock_diameters

RADIUS_STEP: Final = 0.5e-3
"""Distance of race radii that are tried [m]."""
MOST_BALLS = 64
"""Nobody counts in more; only very large races would hold them."""


def ball_diameters(case: Case) -> tuple[float, ...]:
    """Stock diameters [m] that fit the envelope, or the pinned one; refused when none fits."""
    abu = case.autobalancer
    if abu.ball_diameter_mm is not None:
        return (_pinned_diameter(case, abu.ball_diameter_mm),)
    stock = stock_diameters(abu.ball_sizes)
    fitting = tuple(d for d in stock if _fits_width(case, d) and race_radii(case, d))
    if fitting:
        return fitting
    if abu.design == "bearing-ring":
        raise _no_ring(case, stock[0])
    if abu.race_radius_mm is not None:
        raise impossible("race_radius_mm", abu.race_radius_mm, "no stock ball runs on this race in this envelope")
    smallest = stock[0]
    if not _fits_width(case, smallest):
        least = f"at least {_mm(width(abu.design, smallest))}"
        raise impossible("max_width_mm", abu.max_width_mm, "too narrow for the smallest ball", least)
    room = least_race_radius(abu.design, abu.bore_diameter, smallest) - _greatest(case)
    least = f"at least {_mm(abu.max_outer_diameter + 2 * room)}"
    raise impossible("max_outer_diameter_mm", abu.max_outer_diameter_mm, "no room for balls round this bore", least)


def race_radii(case: Case, diameter: float) -> tuple[float, ...]:
    """Race radii [m] to try for one ball: every half millimetre in the envelope and its largest, or the pinned one."""
    abu = case.autobalancer
    if abu.design == "bearing-ring":
        return _ring_radii(case, diameter)
    least = least_race_radius(abu.design, abu.bore_diameter, diameter)
    greatest = _greatest(case)
    if abu.race_radius_mm is not None:
        pinned = abu.race_radius
        return (pinned,) if least - 1e-9 <= pinned <= greatest + 1e-9 else ()
    if least > greatest:
        return ()
    first, last = int(least // RADIUS_STEP) + 1, int(greatest // RADIUS_STEP)
    return tuple(sorted({*(k * RADIUS_STEP for k in range(first, last + 1)), greatest}))


def _ring_radii(case: Case, diameter: float) -> tuple[float, ...]:
    """Radii [m] of the spheres of bearings' rings that fit; the pinned one, as measured, if it is one of them."""
    rings, given = fitting_rings(case, diameter), case.autobalancer.race_radius
    if given is None:
        return tuple(dict.fromkeys(ring.sphere_radius for ring in rings))
    return (given,) if pinned_ring(case, given) in rings else ()


def _no_ring(case: Case, diameter: float) -> InputError:
    """The refusal of the design "bearing-ring" where no ring of a bearing fits, or none has the pinned race."""
    given, fitting = case.autobalancer.race_radius_mm, fitting_rings(case, diameter)
    if given is not None and fitting:
        ring = min(fitting, key=lambda each: abs(each.sphere_radius - case.autobalancer.race_radius))
        return impossible(
            "race_radius_mm", given, f"no ring of a bearing in this envelope has this sphere; the nearest is "
            f"{ring.designation}", " … ".join(_mm(radius, 2) for radius in sphere_band(ring)),
        )  # fmt: skip
    return InputError(
        "no outer ring of a self-aligning ball bearing (series 12, 13, 22, 23) fits the envelope, bore, wall and race",
        place=Place(key="autobalancer.design"),
        found="bearing-ring",
        allowed="one-piece, light",
        remedy=f"{nearest_ring(case, diameter)} Or specify another design.",
    )


def ball_counts(case: Case, diameter: float, race_radius: float) -> range:
    """Counts to try on the largest race: 2 … n*, or the pinned one; refused when that many do not fit."""
    beta = half_angle(diameter / 2, race_radius - diameter / 2)
    count = case.autobalancer.ball_count
    if count is None:
        return range(2, min(MOST_BALLS, max(2, best_count(beta))) + 1)
    if count <= most_balls(beta):
        return range(count, count + 1)
    if case.autobalancer.ball_diameter_mm is None:
        return range(0)
    raise impossible("ball_count", count, "so many do not fit round the race", f"2 … {most_balls(beta)}")


def _greatest(case: Case) -> float:
    abu = case.autobalancer
    return greatest_race_radius(abu.design, abu.max_outer_diameter, abu.min_wall)


def _fits_width(case: Case, diameter: float) -> bool:
    return bool(width(case.autobalancer.design, diameter) <= case.autobalancer.max_width + 1e-9)


def _mm(length: float, decimals: int = 1) -> str:
    return f"{from_si(length, 'mm'):.{decimals}f}"


def _pinned_diameter(case: Case, given_mm: float) -> float:
    """The stock size meant by the pinned one (sources round 19.844 to 19.84), or itself when it is no stock size."""
    abu = case.autobalancer
    diameter: float = stock_diameter(abu.ball_diameter) or abu.ball_diameter
    if not _fits_width(case, diameter):
        allowed = f"up to {_mm(abu.max_width - (width(abu.design, diameter) - diameter))}"
        raise impossible("ball_diameter_mm", given_mm, "wider than the envelope", allowed)
    if not race_radii(case, diameter):
        if abu.design == "bearing-ring":
            raise _no_ring(case, diameter)
        least, greatest = least_race_radius(abu.design, abu.bore_diameter, diameter), _greatest(case)
        key = "race_radius_mm" if abu.race_radius_mm is not None else "ball_diameter_mm"
        radii = f"race radius {_mm(least, 2)} … {_mm(greatest, 2)}" if least <= greatest else "a smaller ball"
        raise impossible(key, getattr(abu, key), "hub, ball and wall do not fit one inside the other", radii)
    return diameter


def impossible(key: str, given: float, message: str, allowed: str | None = None) -> InputError:
    """The error that refuses a choice that no geometry allows; its action names other keys than `key`."""
    smaller = "reduce autobalancer.bore_diameter_mm or min_wall_mm"
    remedies = {
        "max_outer_diameter_mm": f"Increase it, or {smaller}.",
        "max_width_mm": "Increase it.",
        "ball_count": "Reduce it, or specify smaller balls or a larger race.",
    }
    larger = "increase autobalancer.max_outer_diameter_mm or max_width_mm"
    return InputError(
        f"geometrically impossible: {message}",
        place=Place(key=f"autobalancer.{key}"),
        found=f"{given:g}",
        allowed=allowed,
        remedy=remedies.get(key, f"Change or remove it, or {larger}."),
    )


RUNNERS_UP = 4
LARGER_RACES = 12
USUAL_PAIRS = 1000
"""Pairs of diameter and count in the envelope of a hand grinder.

If there are more, fewer larger races are tried.
"""
DOZEN = 12
"""More balls than this are proposed where nothing else fits only: they touch often, cost much, and settle late."""


@dataclass(frozen=True)
class Candidate:
    """One autobalancer that could be made [SI]; `budget`: at that speed of the range where it is worst."""

    ball_count: int
    ball_diameter: float
    ball_mass: float
    race_radius: float
    capacity: float
    requirement: Requirement
    housing: Housing
    balls: CandidateBalls
    budget: ResidualBudget
    strength: Strength
    roundness: Roundness
    stays_round: bool
    fillable: bool
    mass_fraction: float

    @property
    def pitch_radius(self) -> float:
        """R − r [m]."""
        return self.race_radius - self.ball_diameter / 2

    @property
    def half_angle(self) -> float:
        """Half the angle between touching balls [rad]."""
        return half_angle(self.ball_diameter / 2, self.pitch_radius)

    @property
    def balls_mass(self) -> float:
        """Mass of all balls [kg]."""
        return self.ball_count * self.ball_mass

    @property
    def ball_moment(self) -> float:
        """m·R_p [kg m] of one ball."""
        return self.ball_mass * self.pitch_radius

    @property
    def static_moment(self) -> float:
        """Σ m·R_p [kg m]: what all balls in one place would cause."""
        return self.ball_count * self.ball_mass * self.pitch_radius

    @property
    def mass(self) -> float:
        """Housing and balls [kg]."""
        return self.requirement.added_mass

    @property
    def capacity_ratio(self) -> float:
        """Capacity over need."""
        return self.capacity / self.requirement.required if self.requirement.required else float("inf")


@dataclass(frozen=True)
class AutobalancerChoice:
    """The chosen autobalancer, the runners-up, each with the reason why it lost, and how many were looked at."""

    best: Candidate
    runners_up: tuple[tuple[Candidate, str], ...]
    examined: int


@formula(
    "Best of all combinations of stock diameter, number of balls up to n* and race radius in the envelope",
    where=(
        "The criteria rank in this order: capacity, strength, roundness of the race, residual-displacement budget, "
        "mass fraction, at most a dozen balls, least mass. At equal mass the smaller ball ranks first. For each "
        "diameter and number, only the smallest sufficient race is ranked, because a larger one is heavier. A "
        "runner-up that keeps the limits of vibration is preferred to a lighter candidate that exceeds one. It has "
        "four balls or more unless gravity shakes all friction out."
    ),
)
def choose(case: Case, imbalance: float) -> AutobalancerChoice:
    ranking = sorted(candidates(case, imbalance), key=lambda candidate: _rank(case, candidate))
    if not ranking:
        raise impossible("ball_count", case.autobalancer.ball_count or 2, "so many do not fit round any race")
    best, others = ranking[0], ranking[1:]
    first = {id(candidate) for candidate in _front([candidate for candidate in ranking if sound(case, candidate)])}
    picked = sorted(others, key=lambda candidate: id(candidate) not in first)[:RUNNERS_UP]
    picked.sort(key=lambda candidate: _rank(case, candidate))
    return AutobalancerChoice(
        best, tuple((candidate, why_not(case, candidate, best)) for candidate in picked), len(ranking)
    )


def choose_for_motor(case: Case, imbalance: float) -> AutobalancerChoice:
    """The choice for all speeds judged, or, if none of these candidates is sound, that for the working speeds alone.

    A motor may idle so far above the working speeds that no candidate holds there. Then the one that holds at the
    working speeds is judged at the idle speed, so that its checks name what fails only there.
    """
    choice, working = choose(case, imbalance), working_speeds(case.table)
    if case.speed_range == working or sound(case, choice.best):
        return choice
    rated = replace(case, speed_range=working)
    other = choose(rated, imbalance)
    if not sound(rated, other.best):
        return choice

    def judged(candidate: Candidate) -> Candidate:
        """The same balls in the same race, with this imbalance and case."""
        return evaluate(case, imbalance, candidate.ball_count, candidate.ball_diameter, candidate.race_radius)

    best = judged(other.best)
    others = [judged(runner_up) for runner_up, _ in other.runners_up]
    return AutobalancerChoice(
        best,
        tuple((runner_up, why_not(case, runner_up, best)) for runner_up in others),
        choice.examined + other.examined,
    )


def candidates(case: Case, imbalance: float) -> list[Candidate]:
    """Smallest race that suffices, for every diameter and count.

    If none suffices at all, the largest race there is.
    """
    tried = [
        (diameter, count, radii)
        for diameter in ball_diameters(case)
        if (radii := race_radii(case, diameter))
        for count in ball_counts(case, diameter, radii[-1])
    ]
    larger = max(1, LARGER_RACES * USUAL_PAIRS // max(len(tried), USUAL_PAIRS))
    sufficient = [_smallest(case, imbalance, *each, larger) for each in tried]
    return [candidate for candidate in sufficient if candidate] or [
        evaluate(case, imbalance, count, diameter, radii[-1]) for diameter, count, radii in tried
    ]


def evaluate(case: Case, imbalance: float, count: int, diameter: float, race_radius: float) -> Candidate:
    """One candidate in full; its required capacity is that of the machine which carries it, so nothing is iterated."""
    ball_mass, body = _ball_mass(case, diameter), _housing(case, diameter, race_radius)
    pitch = race_radius - diameter / 2
    beta = half_angle(diameter / 2, pitch)
    mass = body.mass + count * ball_mass
    need = required_capacity(case, imbalance, mass)
    held = capacity(count, ball_mass, pitch, beta)
    angles = fan(count, imbalance * abs(need.plane_ratio) / (ball_mass * pitch), beta)
    stress = strength(case, ball_mass, diameter, race_radius, body.outer_diameter)
    oval = roundness(case, stress.ball_force, race_radius, diameter)
    balls = CandidateBalls(count, ball_mass, diameter / 2, pitch, held, oval.lobes)
    budget = budget_where_worst(case, imbalance, need, balls, angles)
    stays_round = ovality_residual(oval.unaided) <= permitted_displacement(case, mass, case.speed_range[1])
    share, fillable = mass / case.machine_mass, _fills(case, count, diameter, race_radius)
    return Candidate(
        count,
        diameter,
        ball_mass,
        race_radius,
        held,
        need,
        body,
        balls,
        budget,
        stress,
        oval,
        stays_round,
        fillable,
        share,
    )


def _smallest(
    case: Case, imbalance: float, diameter: float, count: int, radii: tuple[float, ...], most: int
) -> Candidate | None:
    """The smallest race with enough capacity; if it rests too far off, one of `most` larger ones that does not.

    The band of friction may narrow at first with the race, while the balls open.
    """
    free, ball_mass = case.autobalancer.ball_count is None, _ball_mass(case, diameter)

    def suffices(radius: float) -> bool:
        beta = half_angle(diameter / 2, radius - diameter / 2)
        if count > (best_count(beta) if free else most_balls(beta)):
            return False
        held = capacity(count, ball_mass, radius - diameter / 2, beta)
        need = required_capacity(case, imbalance, _housing(case, diameter, radius).mass + count * ball_mass).required
        return held >= case.autobalancer.capacity_margin * need

    if not suffices(radii[-1]):
        return None
    first = bisect_left(radii, True, key=suffices)
    smallest = evaluate(case, imbalance, count, diameter, radii[first])
    if smallest.budget.within and smallest.fillable:
        return smallest
    larger = radii[first + 1 :]
    tried = (evaluate(case, imbalance, count, diameter, each) for each in larger[:: len(larger) // most + 1])
    return next((candidate for candidate in tried if candidate.budget.within and candidate.fillable), smallest)


def _ball_mass(case: Case, diameter: float) -> float:
    return corrector_mass(case.autobalancer.corrector, diameter, material(case.autobalancer.ball_material).density)


def _housing(case: Case, diameter: float, radius: float) -> Housing:
    abu = case.autobalancer
    bore, wall = abu.bore_diameter, abu.min_wall
    return _known_housing(abu.design, radius, diameter, bore, wall, abu.corrector == "ball", ring_of(case, radius))


_known_housing = lru_cache(4096)(housing)
"""Candidates of one diameter ask for the same housings, whatever their number of balls."""


def _fills(case: Case, count: int, diameter: float, radius: float) -> bool:
    """True if the balls go into the race through the open side."""
    abu = case.autobalancer
    bore, wall = abu.bore_diameter, abu.min_wall
    size = dimensions(abu.design, radius, diameter, bore, wall, abu.corrector == "ball", ring_of(case, radius))
    return balls_go_in(size, count, diameter)


def enough(case: Case, candidate: Candidate) -> bool:
    """True if the autobalancer carries the required capacity with the margin asked for."""
    return candidate.capacity_ratio >= case.autobalancer.capacity_margin


def light(case: Case, candidate: Candidate) -> bool:
    """True if the autobalancer weighs no more than allowed."""
    return candidate.mass_fraction <= case.autobalancer.max_mass_fraction


def sound(case: Case, candidate: Candidate) -> bool:
    """True if the candidate falls short of nothing."""
    return not any(_shortfalls(case, candidate))


CAPACITY, MASS = "capacity", "mass of the autobalancer"


def shortfalls(case: Case, candidate: Candidate) -> tuple[str, ...]:
    """Names of the requirements that the candidate falls short of."""
    named = (CAPACITY, "strength", "roundness of the race", "way of the balls into the race", "accuracy of the race",
             MASS)  # fmt: skip
    return tuple(name for name, bad in zip(named, _shortfalls(case, candidate), strict=True) if bad)


def _shortfalls(case: Case, candidate: Candidate) -> Iterator[bool]:
    yield not enough(case, candidate)
    yield not candidate.strength.enough
    yield not candidate.stays_round
    yield not candidate.fillable
    yield not candidate.budget.within
    yield not light(case, candidate)


def _rank(case: Case, candidate: Candidate) -> tuple[float, ...]:
    """Sorts the best first: what is short of something is ranked by how short it is."""
    shortage = max(0.0, case.autobalancer.capacity_margin - candidate.capacity_ratio)
    excess = 0.0 if candidate.budget.within else candidate.budget.residual
    bad = (shortage, not candidate.strength.enough, not candidate.stays_round, not candidate.fillable, excess,
           not light(case, candidate))  # fmt: skip
    return (*bad, candidate.ball_count > DOZEN, round(candidate.mass, 9), candidate.ball_diameter)


def _front(sound: list[Candidate]) -> list[Candidate]:
    """Candidates than which no other is both lighter and more accurate; `sound` comes sorted by mass."""
    front: list[Candidate] = []
    for candidate in sound:
        if not front or candidate.budget.residual < front[-1].budget.residual:
            front.append(candidate)
    return front


def why_not(case: Case, candidate: Candidate, best: Candidate) -> str:
    """What a candidate falls short of, or in what it loses against the one that was chosen."""
    if not enough(case, candidate):
        return (
            f"capacity {candidate.capacity_ratio:.2f} times the required one; the margin is "
            f"{case.autobalancer.capacity_margin:g} times"
        )
    if not candidate.strength.enough:
        return "stress above the limit"
    if not candidate.stays_round:
        return "two-lobe ovality of the race too large"
    if not candidate.fillable:
        return "the balls do not go into the race"
    if not candidate.budget.within:
        return f"expected residual {shown(candidate.budget.residual, 'um', '.1f')}, above the limit"
    if not light(case, candidate):
        return f"weighs {100 * candidate.mass_fraction:.1f} % of the machine"
    heavier, finer = candidate.mass - best.mass, best.budget.residual - candidate.budget.residual
    gain = f"; residual {shown(finer, 'um', '.1f')} less" if finer > 0.05e-6 else ""
    if abs(heavier) > 0.05e-3:
        return f"{shown(abs(heavier), 'g', '.1f')} {'heavier' if heavier > 0 else 'lighter'}{gain}"
    return "equally heavy, with larger balls"
