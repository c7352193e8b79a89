"""The mass that really moves: the machine as a rigid body, felt at places along its spindle axis."""

from abu_calc.formula import formula
from abu_calc.frozen import dataclass


@dataclass(frozen=True)
class Body:
    """Machine and wheel without the autobalancer; places [m] from the centre of mass, toward the wheel positive.

    A point mass is the body whose `inverse_inertia` [1/(kg m²)] is zero: every place then moves alike.
    """

    mass: float
    inverse_inertia: float
    wheel: float

    @property
    def is_rigid(self) -> bool:
        """True if transverse inertia and the place of the wheel are known."""
        return self.inverse_inertia > 0

    @formula(
        "Acceleration at one place per force at another",
        "I_a = 1/M + a_p·a_q/J_c",
        "1/kg",
        where=("`added` is what the autobalancer adds to M."),
        assumed="well above the suspension's frequencies",
        source="Newton–Euler of a free rigid body in the plane",
    )
    def inertance(self, at: float, force_at: float, added: float = 0.0) -> float:
        """
        >>> round(1 / Body(6.4, 1 / 0.10, 0.2).inertance(0.2, 0.2), 1)
        1.8
        """
        return 1 / (self.mass + added) + at * force_at * self.inverse_inertia

    @formula(
        "Mass felt at a place, that of the wheel unless another is named",
        "1/m_eff = 1/M + a_p²/J_c",
        "kg",
        assumed="well above the suspension's frequencies",
        source="Newton–Euler of a free rigid body in the plane",
    )
    def effective_mass(self, added: float = 0.0, at: float | None = None) -> float:
        place = self.wheel if at is None else at
        return 1 / self.inertance(place, place, added)

    def transmission(self, at: float, added: float = 0.0) -> float:
        """Motion at a place per motion at the wheel, both caused by a force at the wheel [1]."""
        return abs(self.inertance(at, self.wheel, added)) / self.inertance(self.wheel, self.wheel, added)
