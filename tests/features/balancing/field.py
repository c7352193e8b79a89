"""Machines in the field, simulated by equations of our own, as a balancer meets them: noise in everything he does.

The casing of a machine moves in the plane of its wheel, as two oscillators that cross-couple. Sensors look in any
direction. Time begins when the mark passes its sensor, which stands at angle 0; the rotor turns counterclockwise, and
angles on it count clockwise, against rotation.
"""

from dataclasses import dataclass, field

import numpy as np

GRAMS_DEGREES = tuple[float, float]


@dataclass
class Fan:
    """A thin rotor on a casing: mass [kg], stiffness and damping of both directions, stiffness of their coupling."""

    mass: float = 40.0
    stiffness: tuple[float, float] = (1.2e6, 2.0e6)
    damping: tuple[float, float] = (900.0, 1200.0)
    coupling: float = 1.5e5
    radius: float = 0.3
    imbalance: GRAMS_DEGREES = (30.0, 130.0)
    sensors_deg: tuple[float, ...] = (0.0,)
    rng: np.random.Generator = field(default_factory=lambda: np.random.default_rng(1))
    reading_error: float = 0.01
    """Relative of each amplitude, and of each phase in rad."""
    placing_error: float = 0.01
    """Relative of each mass that is placed, and of its angle in rad."""

    def motion(self, rpm: float, masses: list[GRAMS_DEGREES]) -> np.ndarray:
        """Displacements [m] along the sensors, factors of e^{iΩt}, with the imbalance and these masses."""
        omega = rpm * np.pi / 30
        unbalance = sum(1e-3 * m * self.radius * np.exp(-1j * np.radians(a)) for m, a in [self.imbalance, *masses])
        dynamic = np.array([
            [self.stiffness[0] - omega**2 * self.mass + 1j * omega * self.damping[0], self.coupling],
            [self.coupling, self.stiffness[1] - omega**2 * self.mass + 1j * omega * self.damping[1]],
        ])  # fmt: skip
        # the heavy spot at angle −a + Ωt pulls along x with the real part, along y with the imaginary part
        x, y = np.linalg.solve(dynamic, omega**2 * unbalance * np.array([1.0, -1j]))
        return np.array([x * np.cos(np.radians(d)) + y * np.sin(np.radians(d)) for d in self.sensors_deg])

    def read(self, rpm: float, masses: list[GRAMS_DEGREES]) -> list[tuple[float, float]]:
        """Amplitude [µm] and lag [degrees] of each sensor, with errors."""
        off = self.reading_error * self.rng.standard_normal((2, len(self.sensors_deg)))
        return [
            (float(1e6 * abs(z) * (1 + a)), float(-np.degrees(np.angle(z) + p)))
            for z, a, p in zip(self.motion(rpm, masses), *off, strict=True)
        ]

    def placed(self, mass: float, angle: float) -> GRAMS_DEGREES:
        """A mass as it is really placed."""
        one, other = self.placing_error * self.rng.standard_normal(2)
        return mass * (1 + one), angle + float(np.degrees(other))

    def run(self, rpm: float, *trials: GRAMS_DEGREES, phases: bool = True, unit: str = "µm 0-peak") -> str:
        """A run as a file has it; the trial masses are placed with errors."""
        shown = self.read(rpm, [self.placed(*trial) for trial in trials])
        values = ", ".join(
            f"{{ amplitude = {a!r}" + (f", phase_deg = {float((p + 180) % 360 - 180)!r}" if phases else "") + " }"
            for a, p in shown
        )
        trial = ", ".join(f"{{ mass_g = {float(m)!r}, angle_deg = {float(a)!r} }}" for m, a in trials)
        return (
            f'[[run]]\nspeed_rpm = {rpm!r}\nunit = "{unit}"\nphase = "lag"\nreadings = [{values}]\ntrial = [{trial}]\n'
        )

    def left_by(self, mass: float, add_at: float) -> float:
        """Imbalance [g·mm] that a correction leaves, placed with errors."""
        masses = [self.imbalance, self.placed(mass, add_at)]
        return abs(sum(1e3 * m * self.radius * np.exp(-1j * np.radians(a)) for m, a in masses))

    @property
    def plane(self) -> str:
        """The table of the single plane."""
        return f"[single_plane]\ncorrection_radius_mm = {1e3 * self.radius!r}\n"


def any_fan(seed: int, sensors: int = 1) -> Fan:
    """A fan of any size, its speeds off resonance."""
    rng = np.random.default_rng(seed)
    mass = float(10 ** rng.uniform(0.5, 2.5))
    low, high = sorted(rng.uniform(0.3, 1.7, 2) * mass * (2 * np.pi * 25) ** 2)
    damping = tuple(0.1 * np.sqrt(k * mass) for k in (low, high))
    return Fan(
        mass, (low, high), damping, 0.05 * low, float(rng.uniform(0.05, 0.6)),
        (float(rng.uniform(1, 50)), float(rng.uniform(0, 360))), tuple(rng.uniform(-60, 60, sensors)), rng,
    )  # fmt: skip
