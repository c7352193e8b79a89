"""Step 3: required capacity of the balls, m(R−r)·… ≥ m₀e + Mε, exactly."""

from abu_calc.formulas.steady_contact import SteadyContact
from abu_calc.formulas.suspension import dynamic_stiffness
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
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
