"""Step 4: residual-displacement budget: race eccentricity, friction, two-lobe ovality, distance from the wheel."""

import math
from bisect import bisect_left
from dataclasses import replace

from abu_calc.formulas.friction_band import friction_band
from abu_calc.formulas.suspension import resonance_factor
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import level_from_velocity, velocity_from_level
from abu_calc.sizing.capacity import Requirement
from abu_calc.sizing.case import Case
from abu_calc.sizing.place_response import place_response

FAN_STEPS = 512


@dataclass(frozen=True)
class ResidualBudget:
    """Displacements 0–peak of the race [m] that stay when the balls have settled, and what the limit permits.

    `speed`: at which [rad/s]; `rolling_friction` of balls fanned evenly, which is typical. `plane_offset`: what a race
    off the wheel's plane leaves at the loudest place, as the displacement of the race that moves this place as much.
    """

    speed: float
    race_eccentricity: float
    rolling_friction: float
    race_ovality: float
    plane_offset: float
    capacity_shortfall: float
    permitted: float
    resting_angles: tuple[float, ...]

    @property
    def residual(self) -> float:
        """Expected residual displacement: `at_race` and that of the plane offset, as the root of the sum of squares."""
        return math.hypot(self.at_race, self.plane_offset)

    @property
    def at_race(self) -> float:
        """Expected displacement of the race: the root of the sum of squares, plus what the balls cannot carry."""
        parts = self.race_eccentricity, self.rolling_friction, self.race_ovality
        return math.hypot(*parts) + self.capacity_shortfall

    @property
    def within(self) -> bool:
        """True if the expected residual displacement is permitted."""
        return self.residual <= self.permitted


@dataclass(frozen=True)
class CandidateBalls:
    """The balls of one candidate [SI]: how many, mass and radius of one, pitch radius, what they can carry [kg m].

    `lobes`: amplitude [m] of the race's two lobes under two opposite balls at the top of the speed range.
    """

    count: int
    mass: float
    radius: float
    pitch_radius: float
    capacity: float
    lobes: float

    @property
    def moment(self) -> float:
        """m·R_p of one ball [kg m]."""
        return self.mass * self.pitch_radius


def fan(count: int, resultant: float, contact_half_angle: float) -> tuple[float, ...]:
    """Angles [rad] of n balls spread evenly about one direction whose unit vectors add up to `resultant`.

    sin(nδ/2)/sin(δ/2) = |Σe^{iθ}| for the spacing δ between touching (2β) and even round the race (2π/n), to 1/512 of
    that span; for two balls it is the only stationary arrangement, for more a typical one (n−2 angles are free).
    """
    low, high = 2 * contact_half_angle, 2 * math.pi / count
    if count == 2:
        half = max(contact_half_angle, math.acos(min(1.0, resultant / 2)))
        return (-half, half)

    def closing(step: int) -> float:
        spacing = low + (high - low) * step / FAN_STEPS
        return -math.sin(count * spacing / 2) / math.sin(spacing / 2)

    step = bisect_left(range(FAN_STEPS), -resultant, key=closing)
    spacing = low + (high - low) * step / FAN_STEPS
    return tuple((k - (count - 1) / 2) * spacing for k in range(count))


@formula(
    "Permitted displacement of the race, 0–peak, at which every handle keeps the limit",
    "√2·v/Ω",
    "m",
    shown="um",
    where=(
        "v is the velocity of the limit. The program first subtracts the background as energy. It then divides by the "
        "largest motion of a handle per motion of the race."
    ),
    source="Kladiev 1996 (limit)",
)
def permitted_displacement(case: Case, added_mass: float, speed: float) -> float:
    allowed = velocity_from_level(case.level_limit) ** 2
    background = case.background_level
    if background is not None:
        allowed -= velocity_from_level(background) ** 2
    return math.sqrt(2 * max(allowed, 0.0)) / (speed * loudest_transmission(case, added_mass))


def loudest_transmission(case: Case, added_mass: float) -> float:
    """Largest motion of a handle per motion of the race [1]."""
    return max(place_response(case, held.place, added_mass).transmission for held in case.judged_places)


def accuracy_budget(
    case: Case,
    imbalance: float,
    need: Requirement,
    balls: CandidateBalls,
    angles: tuple[float, ...],
    speed: float,
) -> ResidualBudget:
    """The parts of the residual at one speed [rad/s] where balls rest at these angles.

    Friction can hold no more than all balls in one place would cause. The race's ovality is that of two opposite balls.
    """
    carried = imbalance * abs(need.plane_ratio)
    band = friction_band(case.friction_arm, balls.pitch_radius, balls.radius, angles)
    missing = max(0.0, carried - balls.capacity) / need.effective_mass
    budget = ResidualBudget(
        speed=speed,
        race_eccentricity=case.race_eccentricity,
        rolling_friction=min(band, (balls.count * balls.moment + carried) / need.effective_mass),
        race_ovality=ovality_residual(balls.lobes) * (speed / case.speed_range[1]) ** 2,
        plane_offset=0.0,
        capacity_shortfall=missing * resonance_factor(case.suspension, speed, need.effective_mass) if missing else 0.0,
        permitted=permitted_displacement(case, need.added_mass, speed),
        resting_angles=angles,
    )
    if not case.race_offset:
        return budget
    loudest = loudest_displacement(case, imbalance, need.added_mass, budget.at_race)
    moved = loudest / loudest_transmission(case, need.added_mass)
    return replace(budget, plane_offset=math.sqrt(max(moved**2 - budget.at_race**2, 0.0)))


def loudest_displacement(
    case: Case, imbalance: float, added_mass: float, at_race: float, *, in_line: bool = False
) -> float:
    """Displacement 0–peak [m] of the loudest limited place, where the race keeps the displacement `at_race` [m]."""
    responses = (place_response(case, held.place, added_mass) for held in case.judged_places)
    return max(response.loudest(at_race, imbalance, in_line=in_line) for response in responses)


def budget_where_worst(
    case: Case, imbalance: float, need: Requirement, balls: CandidateBalls, angles: tuple[float, ...]
) -> ResidualBudget:
    """Budget at the judged speed whose residual is nearest to the limit's permitted one, or most above it."""
    budgets = [accuracy_budget(case, imbalance, need, balls, angles, speed) for speed in judged_speeds(case)]
    return max(budgets, key=lambda budget: budget.residual * budget.speed)


def judged_speeds(case: Case) -> tuple[float, ...]:
    """Speeds [rad/s] at which levels are judged: the ends of the range and the rated one.

    What stays grows with the speed, but for imbalance beyond the capacity, which grows toward a resonance, outside the
    range: so the ends are worst.
    """
    return tuple(sorted({*case.speed_range, case.speed}))


@formula(
    "Spindle displacement that two-lobe ovality of the race can leave",
    "n_k·a_k, n_k = 2",
    "m",
    shown="um",
    where=(
        "A ball rests if the slope of its race is at most the pull of the displacement. The slope of n_k lobes is "
        "n_k·a_k/R_p."
    ),
    source="derived",
)
def ovality_residual(lobes: float) -> float:
    return 2 * lobes


@formula(
    "Velocity level of a displacement at a speed",
    "v = w·Ω/√2",
    "dB",
    where="A background level is added as energy. A place at rest has the floor of 0 dB.",
)
def displacement_level(displacement: float, speed: float, background: float | None = None) -> float:
    """
    >>> round(displacement_level(12e-6, 5800 * math.pi / 30), 1)
    100.3
    """
    noise = 0.0 if background is None else velocity_from_level(background)
    velocity = math.hypot(displacement * speed / math.sqrt(2), noise)
    return level_from_velocity(max(velocity, velocity_from_level(0.0)))
