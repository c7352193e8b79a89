"""Step 4: residual-displacement budget: race eccentricity, friction, two-lobe ovality, distance from the wheel.

Motion of a place when balls have settled: by the race's displacement, and by a race off the wheel's plane.

Two motions shake a place p. The race keeps a displacement, which forces at the race cause: p moves by A_pr/g_rr of it.
And balls that still the race leave the couple of imbalance and balls, which turns the body about the race.

Step 3: required capacity of the balls, m(R−r)·… ≥ m₀e + Mε, exactly.
"""

import math
from bisect import bisect_left
from dataclasses import replace

from abu_calc.formulas.friction_band import friction_band
from abu_calc.formulas.rigid_body import Vector
from abu_calc.formulas.suspension import dynamic_stiffness, resonance_factor
from abu_calc.formulas.tilting_contact import SteadyContact
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import level_from_velocity, velocity_from_level
from abu_calc.foundation.validity import Range
from abu_calc.sizing.case import Case

FRICTION = Range("cutting coefficient f", 0.0, 2.0, key="grinding.cutting_coefficient")


@dataclass(frozen=True)
class Requirement:
    """Needed capacity [kg m] and its parts, for a machine that carries an autobalancer of `added_mass`."""

    added_mass: float
    effective_mass: float
    imbalance_part: float
    runout_factor: float
    runout_part: float
    eccentricity_part: float
    plane_ratio: float
    required: float
    published_limit: float
    compliant: float | None


@formula(
    "Share of Mε that a rigid contact requires",
    "√{[(1−ω_x²/Ω²)² + f²(1−ω_y²/Ω²)²]/(1+f²)}",
    "1",
    where="The runout has its least favourable angle to the imbalance. Far above resonance the factor tends to 1.",
    checked=(FRICTION,),
    assumed="rigid contact without separation",
    source="derived by averaging",
    published="Kladiev 1996, (6), uses the limit 1, which is on the safe side above resonance",
)
def runout_factor(speed: float, natural_frequencies: tuple[float, float], friction: float) -> float:
    """
    >>> round(runout_factor(607.37, (80.0, 120.0), 0.35), 4)
    0.9803
    """
    f = FRICTION.check(friction)
    x, y = (1 - (w / speed) ** 2 for w in natural_frequencies)
    return float(((x**2 + f**2 * y**2) / (1 + f**2)) ** 0.5)


@formula(
    "Imbalance of the balls in the race plane that stills the race, per imbalance in the wheel plane",
    "(1/M + a_r·a_w/J_c)/(1/M + a_r²/J_c)",
    "1",
    where=(
        "The ratio is 1 if both planes coincide. It is negative for a race beyond the node of the wheel: there the "
        "balls gather on the other side. The displacement that remains at the wheel is part of the "
        "residual-displacement budget."
    ),
    assumed="rigid body well above its suspension",
    source="derived",
)
def plane_ratio(case: Case, added_mass: float = 0.0) -> float:
    body, race = case.body, case.race_place
    return body.inertance(race, body.wheel, added_mass) / body.inertance(race, race, added_mass)


def steady_contact(case: Case, added_mass: float, *, damped: bool) -> SteadyContact | None:
    """The machine pressed to the work, or nothing when the contact does not press radially."""
    contact = case.contact
    if contact is None or contact.contact == "face":
        return None
    mass = case.body.effective_mass(added_mass)
    dx, dy = (dynamic_stiffness(case.suspension, axis, case.speed, mass) for axis in (0, 1))
    stiffness = (dx, dy) if damped else (complex(dx.real), complex(dy.real))
    compliance = 1 / contact.contact_stiffness if contact.contact == "compliant" else 0.0
    return SteadyContact(case.speed, stiffness, compliance, contact.rotation_sense * contact.cutting_coefficient)


@formula(
    "Imbalance that the balls must be able to balance",
    "m₀e + M·ε·√{…} + M·Δ, the first two times the plane ratio",
    "kg m",
    where=(
        "If the machine tilts, M stands for its effective mass with the autobalancer: at the wheel, and in M·Δ at the "
        "race. ε counts only if the contact presses radially. √{…} is the runout factor. The published limit m₀e + "
        "Mε (Kladiev 1996, (6)) is given for comparison. A compliant contact requires m₀e + ε·c_n·|D_x − "
        "i·s·f·D_y|/(Ω²·|D_x + D_y + c_n(1 + i·s·f)|) + M·Δ, the first two times the plane ratio."
    ),
    assumed="above resonance",
    source="derived; Δ from workshop practice",
    published="(6) leaves out race eccentricity, plane ratio and the size of the balls (see `abu explain balls`)",
)
def required_capacity(case: Case, imbalance: float, added_mass: float) -> Requirement:
    mass = case.body.effective_mass(added_mass)
    ratio = plane_ratio(case, added_mass)
    eccentricity = case.body.effective_mass(added_mass, case.race_place) * case.race_eccentricity
    steady = steady_contact(case, added_mass, damped=False)
    factor = compliant = None
    if steady is not None and case.contact is not None:
        dx, dy = steady.dynamic_stiffness
        frequencies = tuple(max(0.0, 1 + d.real / (mass * case.speed**2)) ** 0.5 * case.speed for d in (dx, dy))
        factor = runout_factor(case.speed, (frequencies[0], frequencies[1]), case.contact.cutting_coefficient)
        if case.contact.contact == "compliant":
            compliant = (imbalance + abs(steady.balancing_imbalance(case.runout))) * abs(ratio) + eccentricity
    runout = mass * case.runout * (factor or 0.0)
    return Requirement(
        added_mass=added_mass,
        effective_mass=mass,
        imbalance_part=imbalance,
        runout_factor=factor or 0.0,
        runout_part=runout,
        eccentricity_part=eccentricity,
        plane_ratio=ratio,
        required=(imbalance + runout) * abs(ratio) + eccentricity,
        published_limit=imbalance + mass * case.runout,
        compliant=compliant,
    )


@dataclass(frozen=True)
class PlaceResponse:
    """Motion of a place along x, y and z: `by_race` per displacement of the race [1], `rest` per imbalance [1/kg].

    `judged`: how many of the axes a level is judged by; in the wheel plane x and y, elsewhere all three.
    """

    by_race: Vector
    rest: Vector
    judged: int = 3

    @property
    def transmission(self) -> float:
        """Motion of the loudest axis per displacement of the race [1]."""
        return max(self.by_race[: self.judged])

    def displacements(self, at_race: float, imbalance: float, *, in_line: bool = False) -> Vector:
        """Displacements 0–peak [m] of the axes; `in_line`: both motions add up, else they are added as squares."""
        parts = ((by_race * at_race, rest * imbalance) for by_race, rest in zip(self.by_race, self.rest, strict=True))
        x, y, z = (sum(pair) if in_line else math.hypot(*pair) for pair in parts)
        return x, y, z

    def loudest(self, at_race: float, imbalance: float, *, in_line: bool = False) -> float:
        """Displacement 0–peak [m] of the loudest axis."""
        return max(self.displacements(at_race, imbalance, in_line=in_line)[: self.judged])


def place_response(case: Case, place: Vector, added_mass: float = 0.0) -> PlaceResponse:
    """Response of a place [m] of the machine that carries an autobalancer of `added_mass` [kg]."""
    body, race = case.body, case.race_place
    still = body.inertance(race, race, added_mass)
    x, y, z = (axis / still for axis in body.axes(place, added_mass, race))
    return PlaceResponse((x, y, z), plane_rest(case, place, added_mass), 2 if place == body.wheel else 3)


@formula(
    "Displacement that remains at a place if balls in another plane have stilled the race, per imbalance",
    "A_pw − A_pr·g_rw/g_rr",
    "1/kg",
    where=(
        "A_pw and A_pr are the motions of the place per rotating force at wheel and race, axis by axis. For places on "
        "the spindle it is (a_w − a_r)·(a_p − a_r)/(J_c + M·a_r²). It is zero for a race in the wheel plane."
    ),
    assumed="as for the plane ratio",
    source="derived; checked by integration of six degrees of freedom with balls",
)
def plane_rest(case: Case, place: Vector, added_mass: float) -> Vector:
    if not case.race_offset:
        return 0.0, 0.0, 0.0
    body, ratio = case.body, plane_ratio(case, added_mass)
    by_imbalance = body.body.acceleration(place, body.wheel, added=added_mass)
    by_balls = body.body.acceleration(place, case.race_place, added=added_mass)
    x, y, z = (abs(wheel - ratio * race) for wheel, race in zip(by_imbalance, by_balls, strict=True))
    return x, y, z


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
