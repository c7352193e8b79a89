"""Runs in SI: what the sensors read, and the masses that were on.

Imbalances and motions are complex numbers, as in formulas.py beside it. All runs of a file have the same sensors.
"""

import cmath
from typing import Final

from abu_calc.features.balancing.formulas import Matrix, RollOnRig, Vector, displacement
from abu_calc.foundation.frozen import dataclass

ONE_SPEED: Final = 0.01
"""Relative difference of speeds up to which influence coefficients are one set."""
SEEN: Final = 0.1
"""Part of the largest reading at a speed below which a reading is too small to be a measure.

Smaller readings have the errors of one of this size.
"""


@dataclass(frozen=True)
class TrialMass:
    """A mass that was on: plane (0 left or single, 1 right), mass [kg], radius [m], angle behind the mark [rad]."""

    plane: int
    mass: float
    radius: float
    angle: float

    @property
    def imbalance(self) -> complex:
        """Imbalance as a complex number [kg m]."""
        return self.mass * self.radius * cmath.exp(-1j * self.angle)


def imbalance_of(masses: tuple[TrialMass, ...], planes: int) -> Vector:
    """Imbalance of masses in each plane [kg m]."""
    return tuple(sum((mass.imbalance for mass in masses if mass.plane == k), 0j) for k in range(planes))


@dataclass(frozen=True)
class RunOnRig:
    """Readings of a run: speed [rad/s], amplitudes (SI) and phases [rad] of its sensors, by the mark's sensor, which
    stands `sensor` [rad] from them in the sense of rotation; the masses that were on. No phases: amplitudes alone.
    """

    speed: float
    quantity: str
    amplitudes: tuple[float, ...]
    phases: tuple[float, ...]
    sensor: float = 0.0
    weights: tuple[TrialMass, ...] = ()
    noise: tuple[float, ...] = ()
    """Standard errors of the amplitudes that a record shows of itself (SI)."""
    unsure: float = 0.0
    """Most that all phases of a record may be off together [rad]."""
    planes: int = 2
    """Number of correction planes."""
    read_speed: float | None = None
    """Speed that decides to which set of coefficients the run belongs [rad/s], if its speed is varied."""

    @property
    def set_speed(self) -> float:
        """Speed by which the run belongs to a set of coefficients [rad/s]: an error of the speed changes no set."""
        return self.speed if self.read_speed is None else self.read_speed

    @property
    def motion(self) -> Vector:
        """Displacements by the passage of the mark at the vibration sensors [m]; without phases their amplitudes."""
        phases = self.phases or (0.0,) * len(self.amplitudes)
        quantity = self.quantity if self.phases else "displacement"
        scale = 1.0 if self.phases else abs(displacement(self.quantity, 1.0, 0.0, self.speed))
        return tuple(
            displacement(quantity, amplitude * scale, phase + (self.sensor if self.phases else 0.0), self.speed)
            for amplitude, phase in zip(self.amplitudes, phases, strict=True)
        )

    @property
    def readings(self) -> Vector:
        """The same as if every reading were a displacement, as the published formula takes it."""
        return tuple(
            displacement("displacement", amplitude, phase + self.sensor, self.speed)
            for amplitude, phase in zip(self.amplitudes, self.phases, strict=True)
        )

    @property
    def errors(self) -> tuple[float, ...]:
        """Standard errors of the amplitudes that a record shows (SI); zero without a record."""
        return self.noise or (0.0,) * len(self.amplitudes)

    @property
    def placed(self) -> Vector:
        """Imbalance of the masses that were on, of each plane [kg m]."""
        return imbalance_of(self.weights, self.planes)


@dataclass(frozen=True)
class Coefficients:
    """Influence coefficients at some speeds [m per kg m], with a standard error of each."""

    speeds: tuple[float, ...]
    matrices: tuple[Matrix, ...]
    errors: tuple[tuple[tuple[float, ...], ...], ...]

    def at(self, speed: float) -> int | None:
        """Place of the set at a speed; None if there is none."""
        near = [k for k, own in enumerate(self.speeds) if abs(speed / own - 1) <= ONE_SPEED]
        return min(near, key=lambda k: abs(speed / self.speeds[k] - 1)) if near else None


@dataclass(frozen=True)
class Balancing:
    """Data from which an answer is computed."""

    roll: RollOnRig | None
    runs: tuple[RunOnRig, ...]
    coefficients: Coefficients | None = None

    @property
    def planes(self) -> int:
        """Number of correction planes."""
        return self.runs[0].planes

    @property
    def quantity(self) -> str:
        """Quantity in which the vibration of all sensors is compared: that of the runs, velocity if they differ."""
        named = {run.quantity for run in self.runs}
        return named.pop() if len(named) == 1 else "velocity"

    @property
    def overdetermined(self) -> bool:
        """Tell whether the sensors at all speeds are more than the planes."""
        return len(self.speed_groups) * len(self.runs[0].amplitudes) > self.planes

    def least(self, index: int) -> float:
        """Displacement below which readings of a run are too small to be a measure [m]."""
        (group,) = (group for group in self.speed_groups if index in group)
        return SEEN * max(abs(phasor) for own in group for phasor in self.runs[own].motion)

    @property
    def speed_groups(self) -> tuple[tuple[int, ...], ...]:
        """Indices of the runs at each speed, in the order of their first runs."""
        groups: list[list[int]] = []
        for index, run in enumerate(self.runs):
            for group in groups:
                if abs(run.set_speed / self.runs[group[0]].set_speed - 1) <= ONE_SPEED:
                    group.append(index)
                    break
            else:
                groups.append([index])
        return tuple(map(tuple, groups))
