"""Parts of the result of `abu grinding`, in user units."""

import cmath
import math
from collections.abc import Mapping
from typing import Annotated, Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.grinding.curves import AtAngle, Friction, Shaken, SpeedResponse, largest_runout
from abu_calc.features.grinding.simulation import WorkSimulation
from abu_calc.features.grinding.steady_contact import SteadyWork
from abu_calc.features.grinding.work import Remedy
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import from_si, wrapped_deg
from abu_calc.sizing.case import Case

SIDES: Final = 60
"""Sides of the polygon that stands for an ellipse."""


@record
class AxisMotion(Record):
    """Amplitudes of the axis; None where balls come to no rest."""

    x_amplitude_mm: Annotated[float | None, Quantity("along the work", "|X|")]
    y_amplitude_mm: Annotated[float | None, Quantity("normal to the work", "|Y|")]

    @classmethod
    def of(cls, axis: tuple[complex, complex] | None) -> Self:
        """Amplitudes of a motion given by its phasors."""
        x, y = (None, None) if axis is None else (from_si(abs(each), "mm") for each in axis)
        return cls(x_amplitude_mm=x, y_amplitude_mm=y)


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
class Reaction(Record):
    """Force of wheel and work, N₀ + amplitude·cos(Ωt + angle), as if they never parted."""

    mean_N: Annotated[float, Quantity("mean force", "N₀")]
    amplitude_N: Annotated[float | None, Quantity("variable part", "|N_c|")]
    angle_deg: Annotated[float | None, Quantity("its angle", "arg N_c")]
    hardest_at_deg: Annotated[float | None, Quantity("point of the wheel pressed hardest, from the imbalance")]
    separates: Annotated[bool, Quantity("wheel and work part")]
    largest_runout_mm: Annotated[float | None, Quantity("largest runout without parting", "ε")]

    @classmethod
    def of(cls, case: Case, steady: SteadyWork) -> Self:
        """Reaction of a steady motion."""
        force, press = steady.reaction, case.contact.press_force if case.contact else 0.0
        limit, known = largest_runout(case, steady), force is not None and abs(force) > 0
        return cls(
            mean_N=press,
            amplitude_N=None if force is None else abs(force),
            angle_deg=wrapped_deg(cmath.phase(force)) if force is not None and known else None,
            hardest_at_deg=wrapped_deg(cmath.phase(-1j * force)) if force is not None and known else None,
            separates=known and case.contact is not None and abs(force or 0j) > press,
            largest_runout_mm=None if limit is None else from_si(limit, "mm"),
        )


@record
class Printed(Record):
    """Demand on the balls by the source's formula as published, its places of two, and its error here."""

    resultant_g_mm: Annotated[float, Quantity("imbalance of the balls, printed formula", "|V|")]
    resultant_angle_deg: Annotated[float, Quantity("its angle", "arg V")]
    ball_angles_deg: Annotated[tuple[float, float] | None, Quantity("balls by the printed formula", "θ", 5)]
    error_deg: Annotated[float | None, Quantity("the printed formula is off by")]
    open_g_mm: Annotated[float | None, Quantity("imbalance it would leave of what is to be carried")]


@record
class FrictionBand(Record):
    """Dry friction of the balls, and whether work shakes it out."""

    typical_um: Annotated[float, Quantity("friction holds the axis off by, typically")]
    worst_um: Annotated[float | None, Quantity("at the worst")]
    threshold_um: Annotated[float, Quantity("shaken out by more than", "k_r·R_p/r")]
    axial_um: Annotated[float, Quantity("shaking across the race, by axial runout", "a_s")]
    axial_shakes: Annotated[bool, Quantity("axial runout shakes it out")]
    whirl_um: Annotated[float | None, Quantity("shaking along the race, by runout in the plane", "|X − iY|/2")]
    whirl_shakes: Annotated[bool, Quantity("runout in the plane shakes it out")]
    creep_s: Annotated[float | None, Quantity("balls then creep to their places within")]
    simulated_way: Annotated[str | None, Quantity("shaken in the simulation", "", 4, "across the race or along it")]
    simulated_um: Annotated[float | None, Quantity("by an amplitude of")]
    simulated_given: Annotated[bool | None, Quantity("that of the file")]
    simulated_s: Annotated[float | None, Quantity("for")]
    unshaken_um: Annotated[float | None, Quantity("simulated: left without it", "", 3)]
    shaken_um: Annotated[float | None, Quantity("simulated: left with it", "", 3)]

    @classmethod
    def of(cls, friction: Friction, run: Shaken | None) -> Self:
        """Record in user units."""
        unshaken = None if run is None else run.unshaken
        left = None if run is None else run.shaken
        return cls.read(
            friction,
            axial_shakes=friction.axial > friction.threshold > 0,
            whirl_shakes=friction.creep is not None,
            simulated_way=None if run is None else run.way,
            simulated_um=None if run is None else from_si(run.amplitude, "um"),
            simulated_given=None if run is None else run.given,
            simulated_s=None if run is None else run.seconds,
            unshaken_um=None if unshaken is None else from_si(unshaken, "um"),
            shaken_um=None if left is None else from_si(left, "um"),
        )


@record
class HodographPoint(Record):
    """Axis with the runout at another angle from the imbalance."""

    runout_angle_deg: Annotated[float, Quantity("runout from the imbalance", "φ_ε")]
    without: AxisMotion
    fitted: AxisMotion

    @classmethod
    def of(cls, point: AtAngle) -> Self:
        """Record in user units."""
        return cls(
            runout_angle_deg=math.degrees(point.angle),
            without=AxisMotion.of(point.without),
            fitted=AxisMotion.of(point.fitted),
        )


@record
class ResponsePoint(Record):
    """Axis and variable force at a speed."""

    speed_rpm: Annotated[float, Quantity("speed", "Ω", 6)]
    without: AxisMotion
    fitted: AxisMotion
    force_without_N: Annotated[float | None, Quantity("variable force without autobalancer")]
    force_with_N: Annotated[float | None, Quantity("variable force with it")]
    balls: Annotated[str | None, Quantity("balls", "", 4, "balanced, restless, short, gathered or turning")]

    @classmethod
    def of(cls, point: SpeedResponse) -> Self:
        """Record in user units."""
        bare, free = point.without, point.fitted
        force = [None if each is None or each.reaction is None else abs(each.reaction) for each in (bare, free)]
        return cls(
            speed_rpm=from_si(point.speed, "rpm"),
            without=AxisMotion.of(bare.axis if bare else None),
            fitted=AxisMotion.of(free.axis if free else None),
            force_without_N=force[0],
            force_with_N=force[1],
            balls=free.balls.places if free and free.balls else None,
        )


@record
class Simulated(Record):
    """The end of a run with every effect that counts."""

    x_amplitude_mm: Annotated[float, Quantity("along the work, from the mean place")]
    y_amplitude_mm: Annotated[float, Quantity("normal to the work")]
    velocity_rms_mm_per_s: Annotated[float, Quantity("velocity, rms")]
    imbalance_g_mm: Annotated[float, Quantity("imbalance of wheel and balls")]
    force_amplitude_N: Annotated[float | None, Quantity("variable force, once per turn")]
    largest_force_N: Annotated[float | None, Quantity("largest force")]
    apart: Annotated[float, Quantity("share of the time apart", "", 3, "", percent=True)]
    hardest_at_deg: Annotated[float | None, Quantity("pressed hardest, from the imbalance")]
    ball_angles_deg: Annotated[tuple[float, ...], Quantity("balls end at", "θ", 5)]
    duration_s: Annotated[float, Quantity("duration of the run")]
    scatter_db: Annotated[float, Quantity("level known to", "±", 2, "0 unless it is the mean of chaotic runs")]

    @classmethod
    def of(cls, run: WorkSimulation) -> Self:
        """Record in user units."""
        presses = len(run.force) > 0
        return cls.read(
            run,
            x_amplitude_mm=from_si(run.x, "mm"),
            y_amplitude_mm=from_si(run.y, "mm"),
            imbalance_g_mm=from_si(abs(run.imbalance), "g_mm"),
            force_amplitude_N=abs(run.reaction) if presses else None,
            largest_force_N=float(run.force.max()) if presses else None,
            hardest_at_deg=wrapped_deg(cmath.phase(run.pressure)) if presses and run.reaction else None,
            ball_angles_deg=tuple(map(wrapped_deg, run.ball_angles)),
            velocity_rms_mm_per_s=from_si(run.velocity, "mm_per_s"),
        )


@record
class Comparison(Record):
    """Difference between the simulation of the contact alone and the closed form, relative."""

    axis: Annotated[float | None, Quantity("axis", "", 3)]
    reaction: Annotated[float | None, Quantity("variable force", "", 3)]
    imbalance: Annotated[float | None, Quantity("imbalance", "", 3)]
    from_idle: Annotated[bool, Quantity("balls get there from where they stand at idle")]


@record
class TriedRemedy(Record):
    """Change that was tried and lowers the level under load, and the levels it gave."""

    runout_mm: Annotated[float | None, Quantity("runout", "ε")]
    contact_stiffness_N_per_m: Annotated[float | None, Quantity("contact stiffness", "c_n")]
    press_force_N: Annotated[float | None, Quantity("press force", "N₀")]
    level_before_db: Annotated[float | None, Quantity("level without autobalancer")]
    level_after_db: Annotated[float | None, Quantity("level with it")]

    @classmethod
    def of(cls, remedy: Remedy) -> Self:
        """Record in user units."""
        return cls(
            runout_mm=from_si(remedy.value, "mm") if remedy.what == "runout" else None,
            contact_stiffness_N_per_m=remedy.value if remedy.what == "stiffness" else None,
            press_force_N=remedy.value if remedy.what == "press" else None,
            level_before_db=remedy.levels.before,
            level_after_db=remedy.levels.after,
        )


@record
class ProfilePoint(Record):
    """Force on a point of the wheel, from its imbalance: with and without autobalancer, as if never parting; and as
    simulated, where that was done.
    """

    wheel_angle_deg: Annotated[float, Quantity("point of the wheel", "ψ")]
    with_N: Annotated[float | None, Quantity("force with the autobalancer", "N")]
    without_N: Annotated[float | None, Quantity("force without", "N")]
    simulated_N: Annotated[float | None, Quantity("simulated with", "N")]
    simulated_without_N: Annotated[float | None, Quantity("simulated without", "N")]

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
            cls(wheel_angle_deg=math.degrees(angle), with_N=steady(free, angle), without_N=steady(bare, angle),
                simulated_N=_nearest(run, angle), simulated_without_N=_nearest(alone, angle))
            for angle in angles
        )  # fmt: skip


def _nearest(forces: Mapping[float, float], angle: float) -> float | None:
    if not forces:
        return None
    return forces[min(forces, key=lambda sample_angle: abs(math.remainder(sample_angle - angle, 2 * math.pi)))]
