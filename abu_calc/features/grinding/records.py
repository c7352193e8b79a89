"""Parts of the result of `abu grinding`, in user units."""

import cmath
import math
from collections.abc import Mapping
from typing import Annotated, Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.grinding.steady_contact import SteadyWork
from abu_calc.features.grinding.work import Side
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import from_si, wrapped_deg

SIDES: Final = 60
"""Sides of the polygon that stands for an ellipse."""


@record
class AxisMotion(Record):
    """Amplitudes of the axis; None where balls come to no rest."""

    x_amplitude: Annotated[float | None, Quantity("along the work", "|X|", unit="mm")]
    y_amplitude: Annotated[float | None, Quantity("normal to the work", "|Y|", unit="mm")]

    @classmethod
    def of(cls, axis: tuple[complex, complex] | None) -> Self:
        """Amplitudes of a motion given by its phasors."""
        x, y = (None, None) if axis is None else map(abs, axis)
        return cls(x_amplitude=x, y_amplitude=y)

    @property
    def largest(self) -> float | None:
        """The larger of both."""
        return max((each for each in (self.x_amplitude, self.y_amplitude) if each is not None), default=None)


@dataclass(frozen=True, eq=False)
class Orbit:
    """Orbit of the axis over one turn: points from its mean place [µm].

    x is along the workpiece, y away from it. `name` says with which balls. `simulated`: with every effect that
    counts, else as if wheel and workpiece never lost contact.
    """

    name: str
    simulated: bool
    points_um: tuple[tuple[float, float], ...]

    @classmethod
    def steady(cls, name: str, steady: SteadyWork) -> Self | None:
        """The ellipse of phasors; None where balls come to no rest."""
        if steady.axis is None:
            return None
        turn = np.exp(2j * np.pi * np.arange(SIDES + 1) / SIDES)
        return cls.through(name, np.array([(phasor * turn).real for phasor in steady.axis]), simulated=False)

    @classmethod
    def through(cls, name: str, path: NDArray[np.float64], *, simulated: bool = True) -> Self:
        """Orbit through places x, y [m]."""
        points = (from_si(1.0, "um") * path).T.tolist()
        return cls(name, simulated, tuple((x, y) for x, y in points))


@record
class Printed(Record):
    """Demand on the balls by the source's formula as published, its places of two, and its error here."""

    resultant: Annotated[float, Quantity("imbalance of the balls, printed formula", "|V|", unit="g_mm")]
    resultant_angle_deg: Annotated[float, Quantity("its angle", "arg V")]
    ball_angles_deg: Annotated[tuple[float, float] | None, Quantity("balls by the printed formula", "θ", 5)]
    error_deg: Annotated[float | None, Quantity("the printed formula is off by")]
    open: Annotated[float | None, Quantity("imbalance it would leave of what is to be carried", unit="g_mm")]


@record
class Simulated(Record):
    """The end of a run with every effect that counts."""

    x_amplitude: Annotated[float, Quantity("along the work, from the mean place", unit="mm")]
    y_amplitude: Annotated[float, Quantity("normal to the work", unit="mm")]
    velocity_rms: Annotated[float, Quantity("velocity, rms", unit="mm_per_s")]
    imbalance: Annotated[float, Quantity("imbalance of wheel and balls", unit="g_mm")]
    force_amplitude: Annotated[float | None, Quantity("variable force, once per turn", unit="N")]
    largest_force: Annotated[float | None, Quantity("largest force", unit="N")]
    apart: Annotated[float, Quantity("share of the time apart", "", 3, "", percent=True)]
    hardest_at_deg: Annotated[float | None, Quantity("pressed hardest, from the imbalance")]
    ball_angles_deg: Annotated[tuple[float, ...], Quantity("balls end at", "θ", 5)]
    duration: Annotated[float, Quantity("duration of the run", unit="s")]
    scatter_db: Annotated[float, Quantity("level known to", "±", 2, "0 unless it is the mean of chaotic runs")]

    @classmethod
    def of(cls, side: Side) -> Self | None:
        """None without a run."""
        if (run := side.run) is None:
            return None
        presses = len(run.force) > 0
        return cls(
            x_amplitude=run.x,
            y_amplitude=run.y,
            velocity_rms=run.velocity,
            imbalance=abs(run.imbalance),
            force_amplitude=abs(run.reaction) if presses else None,
            largest_force=float(run.force.max()) if presses else None,
            apart=run.apart,
            hardest_at_deg=wrapped_deg(cmath.phase(run.pressure)) if presses and run.reaction else None,
            ball_angles_deg=tuple(map(wrapped_deg, run.ball_angles)),
            duration=run.duration,
            scatter_db=run.scatter,
        )


@record
class ProfilePoint(Record):
    """Force on a point of the wheel, from its imbalance: with and without autobalancer, as if never parting; and as
    simulated, where that was done.
    """

    wheel_angle: Annotated[float, Quantity("point of the wheel", "ψ", unit="deg")]
    with_: Annotated[float | None, Quantity("force with the autobalancer", "N", unit="N")]
    without: Annotated[float | None, Quantity("force without", "N", unit="N")]
    simulated: Annotated[float | None, Quantity("simulated with", "N", unit="N")]
    simulated_without: Annotated[float | None, Quantity("simulated without", "N", unit="N")]

    @classmethod
    def round(
        cls, press: float, free: SteadyWork, bare: SteadyWork, run: Mapping[float, float], alone: Mapping[float, float]
    ) -> tuple["ProfilePoint", ...]:
        """Force profile round the wheel, in 24 points; simulated values are those of the nearest angle."""
        angles = [2 * math.pi * step / 24 for step in range(24)]

        def steady(state: SteadyWork, angle: float) -> float | None:
            """Force [N] at a place of the wheel [rad]: N₀ + Re(N e^{−iα})."""
            return None if state.pressure is None else press + (state.pressure * cmath.exp(-1j * angle)).real

        return tuple(
            cls(wheel_angle=angle, with_=steady(free, angle), without=steady(bare, angle),
                simulated=_nearest(run, angle), simulated_without=_nearest(alone, angle))
            for angle in angles
        )  # fmt: skip


def _nearest(forces: Mapping[float, float], angle: float) -> float | None:
    if not forces:
        return None
    return forces[min(forces, key=lambda sample_angle: abs(math.remainder(sample_angle - angle, 2 * math.pi)))]
