"""One wheel of a spindle with two races pressed to its workpiece: steady contact without separation.

Motion at a place p is w = W₊·e^{iΩt} + W₋·e^{−iΩt}, x along the work, y away from it. The contact at the wheel's place
gives the force (s·f + i)·N along x + iy, N = N₀ + Re(N_c e^{iΩt}). Balls feel the forward whirl W₊ alone. Where balls
of both races balance, W₊ vanishes at every place of a rigid spindle: the contact force acts on them as an imbalance at
the wheel's place would, and what is left is the backward whirl.

Steady contact of wheel and workpiece: phasors of axis and force; rigid contact is one without compliance.

Conventions: x = Re(X e^{iΩt}), y = Re(Y e^{iΩt}); U total imbalance [kg m] and E runout [m] in the rotor, the real axis
along the imbalance; D dynamic stiffness per axis [N/m]; q = 1/c_n compliance [m/N]; T = s·f·N friction along x.
"""

from collections.abc import Sequence
from dataclasses import replace

from abu_calc.formulas.tilting_rotor import PlacedImbalance, TiltingRotor
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass


@dataclass(frozen=True)
class TiltingContact:
    """A rotor pressed to the work at a place [m], at a speed [rad/s]; runout E [m] complex in the rotor's frame.

    `compliance` q_n [m/N], 0 for a rigid contact; `friction` s·f; `pressing`: False for a face wheel, whose runout does
    not press in the plane.
    """

    rotor: TiltingRotor
    backward: TiltingRotor
    """The rotor as its backward whirl feels it: inertia J_t + J_p, the balls' mass carried."""
    place: float
    speed: float
    compliance: float
    friction: float
    runout: complex
    pressing: bool = True

    @classmethod
    def of(
        cls, rotor: TiltingRotor, place: float, speed: float, compliance: float, friction: float, runout: complex,
        balls: Sequence[PlacedImbalance] = (), pressing: bool = True,
    ) -> "TiltingContact":  # fmt: skip
        """`balls`: mass [kg] that the balls of each race add to a backward whirl, n·m·(1 − 1/(8·J)), at its place."""
        added = sum(mass.imbalance.real for mass in balls)
        inertia = sum(mass.imbalance.real * mass.place**2 for mass in balls)
        # K − Ω²·diag(M, J_t + J_p): the gyroscopic moment of a backward whirl has the other sign.
        backward = replace(
            rotor, mass=rotor.mass + added, polar_inertia=0.0,
            transverse_inertia=rotor.transverse_inertia + rotor.polar_inertia + inertia,
        )  # fmt: skip
        return cls(rotor, backward, place, speed, compliance, friction, runout, pressing)

    def _forward(self, at: float, force_at: float) -> complex:
        return self.rotor.receptance(at, force_at, self.speed)

    def _backward(self, at: float, force_at: float) -> complex:
        """Receptance of the backward whirl, complex conjugate."""
        return self.backward.receptance(at, force_at, self.speed)

    def force(self, imbalances: Sequence[PlacedImbalance]) -> complex:
        """Phasor N_c [N] with these imbalances: without autobalancers, or with balls at given places."""
        if not self.pressing:
            return 0j
        sf, at = 1j * self.friction, self.place
        forced = self.rotor.whirl(at, imbalances, self.speed)
        both = (1 - sf) * self._forward(at, at) + (1 + sf) * self._backward(at, at)
        return 1j * (forced + self.runout) / (self.compliance + both / 2)

    @formula(
        "Contact force at the wheel at work, balls of two races balancing",
        "N_c = i·ε/(q_n + (1 + i·s·f)·h_b/2)",
        "N",
        where=(
            "ε is complex, with the angle of the runout. h_b is that of the wheel's place. Neither the imbalances nor "
            "the places of the races matter."
        ),
        assumed="no separation; both races balance; races without eccentricity",
        source="derived: with both races still in the forward sense the spindle whirls backward only",
    )
    def balanced_force(self) -> complex:
        """
        >>> free = TiltingRotor(5.6, 1e9, 0.0, ())
        >>> rigid = TiltingContact.of(free, 0.0, 607.3746, 0.0, -0.35, 4e-5 + 0j)
        >>> round(abs(rigid.balanced_force()), 1)  # 2·M·Ω²·ε·cos(arctan f), twice that of fixed balls
        156.0
        """
        if not self.pressing:
            return 0j
        turned = (1 + 1j * self.friction) * self._backward(self.place, self.place)
        return 1j * self.runout / (self.compliance + turned / 2)

    @formula(
        "Imbalance at the wheel's place that acts on the balls as the contact force does",
        "U_N = (s·f + i)·N_c/(2·Ω²)",
        "kg m",
        where="Each race carries its share of it, as of an imbalance of the wheel.",
        assumed="no separation; both races balance",
        source="derived; with one race in the wheel's plane it is −U of free balls that settle in contact",
    )
    def acting_imbalance(self) -> complex:
        """
        >>> free = TiltingRotor(5.6, 1e9, 0.0, ())
        >>> rigid = TiltingContact.of(free, 0.0, 607.3746, 0.0, 0.0, 4e-5 + 0j)
        >>> round(1e6 * abs(rigid.acting_imbalance()), 3)  # M·ε
        224.0
        """
        return (self.friction + 1j) * self.balanced_force() / (2 * self.speed**2)

    def motion(self, at: float, imbalances: Sequence[PlacedImbalance]) -> tuple[complex, complex]:
        """Phasors X, Y [m] at a place with these imbalances."""
        force = self.force(imbalances)
        forward = self.rotor.whirl(at, imbalances, self.speed)
        forward += self._forward(at, self.place) * (self.friction + 1j) * force / 2
        return _axes(forward, self._left(at, force))

    def balanced_motion(self, at: float) -> tuple[complex, complex]:
        """Phasors X, Y [m] at a place where both races balance: a backward whirl."""
        return _axes(0j, self._left(at, self.balanced_force()))

    def _left(self, at: float, force: complex) -> complex:
        """Complex conjugate of the backward whirl W₋ at a place."""
        return self._backward(at, self.place) * (self.friction - 1j) * force / 2

    def whirl_per_imbalance(self, at: float, force_at: float) -> complex:
        """Forward whirl at a place per imbalance at another [1/kg], the contact included."""
        own = self._forward(at, force_at)
        if not self.pressing:
            return self.speed**2 * own
        sf, wheel = 1j * self.friction, self.place
        both = (1 - sf) * self._forward(wheel, wheel) + (1 + sf) * self._backward(wheel, wheel)
        per_whirl = 1j / (self.compliance + both / 2)
        through = self._forward(at, wheel) * (self.friction + 1j) / 2 * per_whirl * self._forward(wheel, force_at)
        return self.speed**2 * (own + through)


def _axes(forward: complex, backward: complex) -> tuple[complex, complex]:
    """X, Y of Re(X e^{iΩt}), Re(Y e^{iΩt}) from W₊ and the conjugate of W₋."""
    return forward + backward, -1j * (forward - backward)


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
