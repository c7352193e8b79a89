"""Steady contact of wheel and workpiece: phasors of axis and force; rigid contact is one without compliance.

Conventions: x = Re(X e^{iΩt}), y = Re(Y e^{iΩt}); U total imbalance [kg m] and E runout [m] in the rotor, the real axis
along the imbalance; D dynamic stiffness per axis [N/m]; q = 1/c_n compliance [m/N]; T = s·f·N friction along x.
"""

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass


@dataclass(frozen=True)
class SteadyContact:
    """A machine pressed to the work without separation; s = −1: friction opposes the rim, work on the −y side.

    `pressing` p: 1, or 0 for a face wheel, whose contact does not press in the plane (then with a compliance of 1).
    """

    speed: float
    dynamic_stiffness: tuple[complex, complex]
    compliance: float
    friction: float
    pressing: float = 1.0

    @formula(
        "Imbalance U at which free balls settle in contact",
        "Ω²U = ε·(D_x − i·s·f·D_y)/(1 + i·s·f + q_n·(D_x + D_y))",
        "kg m",
        where=(
            "ε is complex, with the angle of the runout. At this U the spindle has no forward whirl, (X + iY)/2 = 0; a "
            "forward whirl moves balls."
        ),
        assumed="above resonance, no separation, two or more balls with capacity to spare",
        source="derived; for a rigid contact without friction it is Kladiev 1996, (4)",
        published=(
            "(4) leaves friction out, and its arctan loses the quadrant. Its ball angles are wrong by about 30° at f = "
            "0.35"
        ),
    )
    def balancing_imbalance(self, runout: complex) -> complex:
        dx, dy = self.dynamic_stiffness
        sf = 1j * self.friction
        p = self.pressing
        return p * runout * (dx - sf * dy) / (p * (1 + sf) + self.compliance * (dx + dy)) / self.speed**2

    def normal_force(self, imbalance: complex, runout: complex) -> complex:
        """Phasor of the contact force [N]: p·i·(D_y·E + Ω²U)/(p + q·D_y) (rigid: Kladiev 1996, (11))."""
        dy, p = self.dynamic_stiffness[1], self.pressing
        return p * 1j * (dy * runout + self.speed**2 * imbalance) / (p + self.compliance * dy)

    def axis(self, imbalance: complex, runout: complex) -> tuple[complex, complex]:
        """Phasors X, Y of the axis [m]: X = (Ω²U + sf·N)/D_x, Y = i·(p·E − q·Ω²U)/(p + q·D_y)."""
        dx, dy = self.dynamic_stiffness
        x = (self.speed**2 * imbalance + self.friction * self.normal_force(imbalance, runout)) / dx
        y = 1j * (self.pressing * runout - self.compliance * self.speed**2 * imbalance)
        return x, y / (self.pressing + self.compliance * dy)

    @property
    def whirl_per_imbalance(self) -> complex:
        """G = dF/dU [m/(kg m)], F = (X + iY)/2 the forward whirl: Ω²/2·[(1 + isf·p/(p + qD_y))/D_x + q/(p + qD_y)].

        Balls go where F = 0 when Re G < 0, and away from there when Re G > 0. Source: derived.
        """
        return self.whirl_at(self.speed, self.dynamic_stiffness)

    def whirl_at(self, speed: complex, dynamic_stiffness: tuple[complex, complex]) -> complex:
        """The same for an imbalance that grows meanwhile, e^{st}: at the speed Ω − is, and D there."""
        (dx, dy), p = dynamic_stiffness, self.pressing
        held = 1 / (p + self.compliance * dy)
        return speed**2 / 2 * ((1 + 1j * self.friction * p * held) / dx + self.compliance * held)

    @property
    def balls_increase_imbalance(self) -> bool:
        """True if the contact is in the stiffness band where balanced positions are unstable.

        Friction is left out.

        1/D_x + 1/(D_y + c_n) > 0 with real parts: M Ω² − c_y < c_n < 2 M Ω² − c_x − c_y. Source: derived.
        """
        dx, dy = (d.real for d in self.dynamic_stiffness)
        if self.compliance == 0:
            return False
        return 1 / dx + 1 / (dy + 1 / self.compliance) > 0
