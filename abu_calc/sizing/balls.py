"""Step 5: which balls, how many, on which race radius."""

from bisect import bisect_left
from dataclasses import replace

from abu_calc.formula import formula
from abu_calc.formulas.ball_ring import best_count, capacity, corrector_mass, half_angle, most_balls
from abu_calc.frozen import dataclass
from abu_calc.sizing.budget import (
    AccuracyBudget,
    Balls,
    budget_where_worst,
    fan,
    oval_rest,
    permitted_displacement,
)
from abu_calc.sizing.capacity import Requirement, required_capacity
from abu_calc.sizing.case import Case, working_speeds
from abu_calc.sizing.housing import Housing, housing
from abu_calc.sizing.pins import ball_counts, ball_diameters, impossible, race_radii
from abu_calc.sizing.roundness import Roundness, roundness
from abu_calc.sizing.strength import Strength, strength
from abu_calc.standards.balls import material
from abu_calc.units import from_si, to_si

RUNNERS_UP = 4
LARGER_RACES = 12
USUAL_PAIRS = 1000
"""Of diameter and count in the envelope of a hand grinder; where there are more, fewer larger races are tried."""
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
    balls: Balls
    budget: AccuracyBudget
    strength: Strength
    roundness: Roundness
    stays_round: bool
    mass_fraction: float

    @property
    def pitch_radius(self) -> float:
        """R − r [m]."""
        return self.race_radius - self.ball_diameter / 2

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
class Choice:
    """The chosen autobalancer, the runners-up, each with the reason why it lost, and how many were looked at."""

    best: Candidate
    runners_up: tuple[tuple[Candidate, str], ...]
    examined: int


@formula(
    "The best of every stock diameter × count up to n* × race radius in the envelope",
    where=(
        "Enough capacity comes first, then strength, a race that stays round, the accuracy budget, the mass fraction, "
        "no more than a dozen balls, and the least mass (ties: the smaller ball). Of each diameter and count the "
        "smallest sufficient race stands for the rest: a larger one is heavier."
    ),
)
def choose(case: Case, imbalance: float) -> Choice:
    found = sorted(candidates(case, imbalance), key=lambda one: _rank(case, one))
    if not found:
        raise impossible("ball_count", case.autobalancer.ball_count or 2, "so many do not fit round any race")
    best, others = found[0], found[1:]
    first = {id(one) for one in _front([one for one in found if sound(case, one)])}
    picked = sorted(others, key=lambda one: id(one) not in first)[:RUNNERS_UP]
    picked.sort(key=lambda one: _rank(case, one))
    return Choice(best, tuple((one, _why_not(case, one, best)) for one in picked), len(found))


def choose_for_motor(case: Case, imbalance: float) -> Choice:
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

    def judged(one: Candidate) -> Candidate:
        return evaluate(case, imbalance, one.ball_count, one.ball_diameter, one.race_radius)

    best = judged(other.best)
    others = [judged(one) for one, _ in other.runners_up]
    return Choice(best, tuple((one, _why_not(case, one, best)) for one in others), choice.examined + other.examined)


def candidates(case: Case, imbalance: float) -> list[Candidate]:
    """For every diameter and count the smallest race that suffices; where none does at all, the largest there is."""
    tried = [
        (diameter, count, radii)
        for diameter in ball_diameters(case)
        if (radii := race_radii(case, diameter))
        for count in ball_counts(case, diameter, radii[-1])
    ]
    larger = max(1, LARGER_RACES * USUAL_PAIRS // max(len(tried), USUAL_PAIRS))
    found = [_smallest(case, imbalance, *each, larger) for each in tried]
    return [one for one in found if one] or [
        evaluate(case, imbalance, count, diameter, radii[-1]) for diameter, count, radii in tried
    ]


def evaluate(case: Case, imbalance: float, count: int, diameter: float, race_radius: float) -> Candidate:
    """One candidate in full: the need is that of the machine which carries it, so no iteration is left over."""
    ball_mass, body = _ball_mass(case, diameter), _housing(case, diameter, race_radius)
    pitch = race_radius - diameter / 2
    beta = half_angle(diameter / 2, pitch)
    mass = body.mass + count * ball_mass
    need = required_capacity(case, imbalance, mass)
    held = capacity(count, ball_mass, pitch, beta)
    angles = fan(count, imbalance * abs(need.plane_ratio) / (ball_mass * pitch), beta)
    stress = strength(case, ball_mass, diameter, race_radius, body.outer_diameter)
    oval = roundness(case, stress.ball_force, race_radius, diameter)
    balls = Balls(count, ball_mass, diameter / 2, pitch, held, oval.lobes)
    budget = budget_where_worst(case, imbalance, need, balls, angles)
    stays_round = oval_rest(oval.unaided) <= permitted_displacement(case, mass, case.speed_range[1])
    share = mass / case.machine_mass
    return Candidate(
        count, diameter, ball_mass, race_radius, held, need, body, balls, budget, stress, oval, stays_round, share
    )


def _smallest(
    case: Case, imbalance: float, diameter: float, count: int, radii: tuple[float, ...], most: int
) -> Candidate | None:
    """The smallest race with enough capacity; if it rests too far off, one of `most` larger ones that does not.

    The band of friction may narrow at first with the race, while the balls open.
    """
    free = case.autobalancer.ball_count is None

    def suffices(radius: float) -> bool:
        beta = half_angle(diameter / 2, radius - diameter / 2)
        if count > (best_count(beta) if free else most_balls(beta)):
            return False
        held = capacity(count, _ball_mass(case, diameter), radius - diameter / 2, beta)
        need = required_capacity(case, imbalance, _mass(case, count, diameter, radius)).required
        return held >= case.autobalancer.capacity_margin * need

    if not suffices(radii[-1]):
        return None
    first = bisect_left(radii, True, key=suffices)
    smallest = evaluate(case, imbalance, count, diameter, radii[first])
    if smallest.budget.within:
        return smallest
    larger = radii[first + 1 :]
    tried = (evaluate(case, imbalance, count, diameter, each) for each in larger[:: len(larger) // most + 1])
    return next((one for one in tried if one.budget.within), smallest)


def _ball_mass(case: Case, diameter: float) -> float:
    return corrector_mass(case.autobalancer.corrector, diameter, material(case.autobalancer.ball_material).density)


def _housing(case: Case, diameter: float, radius: float) -> Housing:
    abu = case.autobalancer
    bore, wall = to_si(abu.bore_diameter_mm, "mm"), to_si(abu.min_wall_mm, "mm")
    return housing(abu.design, radius, diameter, bore, wall, grooved=abu.corrector == "ball")


def _mass(case: Case, count: int, diameter: float, radius: float) -> float:
    return _housing(case, diameter, radius).mass + count * _ball_mass(case, diameter)


def enough(case: Case, one: Candidate) -> bool:
    """Whether it carries the need with the margin asked for."""
    return one.capacity_ratio >= case.autobalancer.capacity_margin


def light(case: Case, one: Candidate) -> bool:
    """Whether it weighs no more than allowed."""
    return one.mass_fraction <= case.autobalancer.max_mass_fraction


def sound(case: Case, one: Candidate) -> bool:
    """Whether it falls short of nothing."""
    return enough(case, one) and one.strength.enough and one.stays_round and one.budget.within and light(case, one)


def _rank(case: Case, one: Candidate) -> tuple[float, ...]:
    """Sorts the best first: what is short of something is ranked by how short it is."""
    shortage = max(0.0, case.autobalancer.capacity_margin - one.capacity_ratio)
    excess = 0.0 if one.budget.within else one.budget.residual
    bad = shortage, not one.strength.enough, not one.stays_round, excess, not light(case, one)
    return (*bad, one.ball_count > DOZEN, round(one.mass, 9), one.ball_diameter)


def _front(sound: list[Candidate]) -> list[Candidate]:
    """Those than which no other is both lighter and more accurate; `sound` comes sorted by mass."""
    front: list[Candidate] = []
    for one in sound:
        if not front or one.budget.residual < front[-1].budget.residual:
            front.append(one)
    return front


def _why_not(case: Case, one: Candidate, best: Candidate) -> str:
    if not enough(case, one):
        return f"carries only {one.capacity_ratio:.2f} of the need, {case.autobalancer.capacity_margin:g} asked for"
    if not one.strength.enough:
        return "stressed more than its material bears"
    if not one.stays_round:
        return "its race would go oval"
    if not one.budget.within:
        return f"rests at {from_si(one.budget.residual, 'um'):.1f} µm, more than the limit permits"
    if not light(case, one):
        return f"weighs {100 * one.mass_fraction:.1f} % of the machine"
    heavier = from_si(one.mass - best.mass, "g")
    finer = from_si(best.budget.residual - one.budget.residual, "um")
    gain = f", though it rests {finer:.1f} µm nearer" if finer > 0.05 else ""
    return f"{heavier:.1f} g heavier{gain}" if heavier > 0.05 else "equally heavy, with larger balls"
