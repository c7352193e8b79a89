"""A swing arm as results hold it: bounds over all contact angles, changes, forced motion, instability region."""

import math
from typing import TYPE_CHECKING, Annotated, ClassVar, Self

from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import from_si
from abu_calc.simulation.records import finite

if TYPE_CHECKING:
    from abu_calc.features.swing_arm.motion import ForcedArmMotion as Moved
    from abu_calc.features.swing_arm.verdict import ArmJudgement
    from abu_calc.sizing.swing_arm import ArmRepair


@record
class ArmChange(Record):
    """One key of [swing_arm] with another value."""

    key: Annotated[str, Quantity("key")]
    old: Annotated[float, Quantity("as it is")]
    new: Annotated[float, Quantity("changed")]

    @classmethod
    def of(cls, change: "ArmRepair") -> Self:
        """Record of a change, as the file would have it."""
        return cls(key=f"swing_arm.{change.key}", old=change.old, new=change.new)


@record
class SwingArmRecord(Record):
    """Stiffness and damping that the arm must have at any contact angle.

    `changes`: tried changes with which all checks pass. The arm as given stands beside its bounds. None: the
    arm does not stand, or the value is beyond the range of a formula.
    """

    schema_title: ClassVar[str] = "SwingArm"

    advice: Annotated[str, Quantity("what to change")]
    changes: tuple[ArmChange, ...]
    contact_stiffness_N_per_m: Annotated[float, Quantity("contact stiffness given", "c_n")]
    contact_stiffness_limit_N_per_m: Annotated[float, Quantity("contact stiffness limit (series)", "c_n", 5)]
    contact_stiffness_limit_exact_N_per_m: Annotated[float, Quantity("contact stiffness limit (exact)", "c_n", 5)]
    worst_contact_angle_deg: Annotated[float, Quantity("worst contact angle", "Z*")]
    idle_frequency_rpm: Annotated[float, Quantity("natural frequency off the work", "ω₀")]
    cutting_frequency_rpm: Annotated[float | None, Quantity("at work, at its contact angle", "ω₀")]
    resonance_rpm: Annotated[float, Quantity("highest resonance of the arm", "ω₀*")]
    joint_damping_N_s_per_m: Annotated[float, Quantity("joint damping given", "h_sh")]
    damping_limit_N_s_per_m: Annotated[float, Quantity("damping needed", "h_sh")]
    damping_limit_bunched_N_s_per_m: Annotated[float | None, Quantity("with the balls on the heavy side", "h_sh")]
    parametric_growth_rate_per_s: Annotated[float, Quantity("growth rate at Ω = 2ω₀*", "κ_aω₀/2 − h_a")]
    parametric_contact_angles_deg: Annotated[tuple[float, ...], Quantity("rated speed is 2ω₀ at", "Z")]
    contact_angle_deg: Annotated[float, Quantity("contact angle given", "Z")]
    touch_angle_deg: Annotated[float, Quantity("touching angle", "φ₀")]
    arm_length_mm: Annotated[float, Quantity("length of the arm", "l")]
    wheel_diameter_mm: Annotated[float, Quantity("wheel")]
    lifted_contact_angles_deg: Annotated[tuple[float, float] | None, Quantity("does not stand between", "Z", 3)]
    joint_stiffness_standing_N_per_m: Annotated[float, Quantity("joint that always stands", "c_sh")]
    pressing_moment_N_m: Annotated[float, Quantity("pressing torque given", "T_a")]
    least_pressing_moment_N_m: Annotated[float, Quantity("torque from which it presses", "T_a")]
    pressed_angle_deg: Annotated[float | None, Quantity("resting angle while cutting", "φ")]
    press_force_N: Annotated[float | None, Quantity("presses with", "N")]

    @classmethod
    def of(cls, judged: "ArmJudgement") -> Self:
        """Record of a design on an arm, in user units."""
        bounds, arm = judged.bounds, judged.bounds.arm
        lifted, angle = bounds.lifted, bounds.pressed_angle
        return cls(
            advice=judged.advice,
            changes=tuple(map(ArmChange.of, judged.changes)),
            contact_stiffness_N_per_m=arm.contact_stiffness,
            contact_stiffness_limit_N_per_m=bounds.stiffness_limit,
            contact_stiffness_limit_exact_N_per_m=bounds.stiffness_limit_exact,
            worst_contact_angle_deg=from_si(bounds.worst_angle, "deg"),
            idle_frequency_rpm=from_si(bounds.idle_frequency, "rpm"),
            cutting_frequency_rpm=_rpm(bounds.cutting_frequency),
            resonance_rpm=from_si(bounds.resonance, "rpm"),
            joint_damping_N_s_per_m=arm.joint_damping,
            damping_limit_N_s_per_m=bounds.damping_limit,
            damping_limit_bunched_N_s_per_m=bounds.bunched_limit,
            parametric_growth_rate_per_s=bounds.growth_rate,
            parametric_contact_angles_deg=tuple(from_si(direction, "deg") for direction in bounds.parametric_angles),
            contact_angle_deg=from_si(arm.contact_angle, "deg"),
            touch_angle_deg=from_si(arm.touch_angle, "deg"),
            arm_length_mm=from_si(arm.length, "mm"),
            wheel_diameter_mm=from_si(2 * arm.disk_radius, "mm"),
            lifted_contact_angles_deg=None if lifted is None else _degrees(lifted),
            joint_stiffness_standing_N_per_m=bounds.standing_stiffness,
            pressing_moment_N_m=arm.pressing_moment,
            least_pressing_moment_N_m=bounds.least_moment,
            pressed_angle_deg=None if angle is None else from_si(angle, "deg"),
            press_force_N=bounds.press_force,
        )


@record
class ArmHarmonic(Record):
    """One order of the forced motion, 0–peak at the wheel; None: infinite, or no periodic motion was found."""

    order: Annotated[int, Quantity("order")]
    resonance_rpm: Annotated[float, Quantity("forced resonance", "ω₀/j", 5)]
    perturbation_um: Annotated[float | None, Quantity("by perturbation")]
    simulation_um: Annotated[float | None, Quantity("by simulation")]


@record
class TongueEdge(Record):
    """Joint damping below which the arm's free motion grows, at one speed."""

    speed_rpm: Annotated[float, Quantity("speed", "Ω", 8)]
    averaged_N_s_per_m: Annotated[float, Quantity("averaged", "h_sh")]
    floquet_N_s_per_m: Annotated[float, Quantity("by Floquet multipliers", "h_sh")]


@record
class ArmMotion(Record):
    """The arm of a scene while nothing balances its imbalance; rates: how fast its free motions grow or die out."""

    speed_rpm: Annotated[float, Quantity("speed", "Ω", 6)]
    modulation: Annotated[float, Quantity("modulation", "κ_a")]
    natural_frequency_rpm: Annotated[float, Quantity("natural frequency", "ω₀", 6)]
    parametric_speed_rpm: Annotated[float, Quantity("parametric resonance", "2ω₀", 6)]
    joint_damping_N_s_per_m: Annotated[float, Quantity("joint damping", "h_sh")]
    rate_per_s: Annotated[float, Quantity("rate away from it", "−h_a")]
    parametric_rates_per_s: Annotated[tuple[float, float], Quantity("rates at 2ω₀", "−h_a ± κ_aω₀/2")]
    simulated_rates_per_s: Annotated[tuple[float, float] | None, Quantity("simulated at this speed", "ln|μ|/T")]
    harmonics: tuple[ArmHarmonic, ...]
    tongue: tuple[TongueEdge, ...]

    @classmethod
    def of(cls, moved: "Moved") -> Self:
        """Record of an arm's motion, in user units."""
        simulated = moved.simulated
        amplitudes = simulated.harmonics if simulated else (math.nan,) * len(moved.perturbation)
        pairs = zip(moved.perturbation, amplitudes, strict=True)
        return cls(
            speed_rpm=from_si(moved.speed, "rpm"),
            modulation=moved.kappa,
            natural_frequency_rpm=from_si(moved.natural, "rpm"),
            parametric_speed_rpm=from_si(2 * moved.natural, "rpm"),
            joint_damping_N_s_per_m=moved.damping,
            rate_per_s=0.0 - moved.decay,
            parametric_rates_per_s=moved.free,
            simulated_rates_per_s=simulated.rates if simulated else None,
            harmonics=tuple(
                ArmHarmonic(
                    order=order,
                    resonance_rpm=from_si(moved.natural / order, "rpm"),
                    perturbation_um=finite(from_si(moved.length * abs(predicted), "um")),
                    simulation_um=finite(from_si(moved.length * abs(other), "um")),
                )
                for order, (predicted, other) in enumerate(pairs, 1)
            ),
            tongue=tuple(
                TongueEdge(
                    speed_rpm=from_si(edge.speed, "rpm"),
                    averaged_N_s_per_m=edge.averaged,
                    floquet_N_s_per_m=edge.floquet,
                )
                for edge in moved.tongue
            ),
        )


def _degrees(angles: tuple[float, float]) -> tuple[float, float]:
    return from_si(angles[0], "deg"), from_si(angles[1], "deg")


def _rpm(frequency: float | None) -> float | None:
    return None if frequency is None else from_si(frequency, "rpm")
