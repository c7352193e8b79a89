"""Wheel and work in steady contact: phasors of axis and force, rigid contact being one without compliance.

Conventions: x = Re(X e^{iΩt}), y = Re(Y e^{iΩt}); U total imbalance [kg m] and E runout [m] in the rotor, the real axis
along the imbalance; D dynamic stiffness per axis [N/m]; q = 1/c_n compliance [m/N]; T = s·f·N friction along x.
"""

from dataclasses import dataclass

from abu_calc.formula import formula


@dataclass(frozen=True)
class SteadyContact:
    """A machine pressed to the work without separation; s = −1: friction opposes the rim, work on the −y side."""

    speed: float
    dynamic_stiffness: tuple[complex, complex]
    compliance: float
    friction: float

    @formula(
        "Imbalance U that free balls settle at",
        "Ω²U = E·(D_x − isf·D_y)/(1 + isf + q·(D_x + D_y))",
        "kg m",
        where=(
            "E runout [m], D dynamic stiffness of each axis [N/m], q compliance of the contact [m/N], s sense of "
            "rotation, f cutting coefficient. From F = (X + iY)/2 = 0, the forward whirl that moves balls."
        ),
        assumed="above resonance, no separation, two or more balls with capacity to spare",
        source="derived; rigid and frictionless it is Kladiev 1996, (4)",
        printed=(
            "(4) leaves friction out and finds the angles by arctan, which loses the quadrant; its ball angles are "
            "wrong by about 30° at f = 0.35"
        ),
    )
    def balancing_imbalance(self, runout: complex) -> complex:
        dx, dy = self.dynamic_stiffness
        sf = 1j * self.friction
        return runout * (dx - sf * dy) / (1 + sf + self.compliance * (dx + dy)) / self.speed**2

    def normal_force(self, imbalance: complex, runout: complex) -> complex:
        """Phasor of the contact force [N]: i·(D_y·E + Ω²U)/(1 + q·D_y) (rigid: Kladiev 1996, (11))."""
        dy = self.dynamic_stiffness[1]
        return 1j * (dy * runout + self.speed**2 * imbalance) / (1 + self.compliance * dy)

    def axis(self, imbalance: complex, runout: complex) -> tuple[complex, complex]:
        """Phasors X, Y of the axis [m]: X = (Ω²U + sf·N)/D_x, Y = i·(E − q·Ω²U)/(1 + q·D_y)."""
        dx, dy = self.dynamic_stiffness
        x = (self.speed**2 * imbalance + self.friction * self.normal_force(imbalance, runout)) / dx
        y = 1j * (runout - self.compliance * self.speed**2 * imbalance) / (1 + self.compliance * dy)
        return x, y

    @property
    def balls_increase_imbalance(self) -> bool:
        """Whether the contact is in the stiffness band where balanced positions are unstable (friction left out).

        1/D_x + 1/(D_y + c_n) > 0 with real parts: M Ω² − c_y < c_n < 2 M Ω² − c_x − c_y. Source: derived.
        """
        dx, dy = (d.real for d in self.dynamic_stiffness)
        if self.compliance == 0:
            return False
        return 1 / dx + 1 / (dy + 1 / self.compliance) > 0
