"""A swing arm as results hold it: bounds over all contact angles, changes, forced motion, instability region."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, ClassVar, Final, Self

from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.validity import bounded

if TYPE_CHECKING:
    from abu_calc.features.swing_arm.verdict import ArmJudgement

ARM: Final = "swing_arm."
"""Start of the keys of the table."""


@record
class ArmChange(Record):
    """One key of [swing_arm] with another value."""

    key: Annotated[str, Quantity("key")]
    old: Annotated[float, Quantity("as it is")]
    new: Annotated[float, Quantity("changed")]

    @property
    def text(self) -> str:
        """Change in words, with the old value.

        >>> ArmChange(key="swing_arm.joint_damping_N_s_per_m", old=2.0, new=2.5).text
        'joint_damping_N_s_per_m = 2.5 (from 2)'
        """
        return f"{self.key.removeprefix(ARM)} = {bounded(self.new)} (from {bounded(self.old)})"


@record
class SwingArmRecord(Record):
    """Stiffness and damping that the arm must have at any contact angle.

    `changes`: those of the next step, which was tried as a whole. The arm as given stands beside its bounds. None: the
    arm does not stand, or the value is beyond the range of a formula.
    """

    schema_title: ClassVar[str] = "SwingArm"

    advice: Annotated[str, Quantity("what to change")]
    changes: tuple[ArmChange, ...]
    contact_stiffness_N_per_m: Annotated[float, Quantity("contact stiffness given", "c_n")]
    contact_stiffness_limit_N_per_m: Annotated[float, Quantity("contact stiffness limit (series)", "c_n", 5)]
    contact_stiffness_limit_exact_N_per_m: Annotated[float, Quantity("contact stiffness limit (exact)", "c_n", 5)]
    worst_contact_angle_deg: Annotated[float, Quantity("worst contact angle", "Z*")]
    idle_frequency_rpm: Annotated[float, Quantity("natural frequency off the workpiece", "ω₀")]
    cutting_frequency_rpm: Annotated[float | None, Quantity("on the workpiece, at its contact angle", "ω₀")]
    resonance_rpm: Annotated[float, Quantity("highest resonance of the arm", "ω₀*")]
    joint_damping_N_s_per_m: Annotated[float, Quantity("pivot damping given", "h_sh")]
    damping_limit_N_s_per_m: Annotated[float, Quantity("pivot damping required", "h_sh")]
    damping_limit_bunched_N_s_per_m: Annotated[float | None, Quantity("  with balls together", "h_sh")]
    parametric_growth_rate_per_s: Annotated[float, Quantity("growth rate at Ω = 2ω₀*", "κ_aω₀/2 − h_a")]
    parametric_contact_angles_deg: Annotated[tuple[float, ...], Quantity("rated speed is 2ω₀ at", "Z")]
    contact_angle_deg: Annotated[float, Quantity("contact angle given", "Z")]
    touch_angle_deg: Annotated[float, Quantity("touching angle", "φ₀")]
    arm_length: Annotated[float, Quantity("length of the arm", "l", unit="mm")]
    wheel_diameter: Annotated[float, Quantity("wheel", unit="mm")]
    lifted_contact_angles_deg: Annotated[tuple[float, float] | None, Quantity("does not stand between", "Z", 3)]
    joint_stiffness_standing_N_per_m: Annotated[float, Quantity("pivot stiffness that always stands", "c_sh")]
    pressing_moment_N_m: Annotated[float, Quantity("pressing torque given", "T_a")]
    least_pressing_moment_N_m: Annotated[float, Quantity("torque from which it presses", "T_a")]
    pressed_angle_deg: Annotated[float | None, Quantity("resting angle while cutting", "φ")]
    press_force_N: Annotated[float | None, Quantity("normal force", "N")]

    @classmethod
    def of(cls, judged: "ArmJudgement", entries: Iterable[str] = ()) -> Self:
        """Record of a design on an arm, in user units; `entries`: those of the next step."""
        arm, table = judged.bounds.arm, judged.table
        pairs = (entry.split("=") for entry in entries if entry.startswith(ARM))
        changes = tuple(
            ArmChange(key=key, old=getattr(table, key.removeprefix(ARM)), new=float(value)) for key, value in pairs
        )
        return cls.read(
            judged.bounds,
            arm,
            advice=judged.advice(change.text for change in changes),
            changes=changes,
            arm_length=arm.length,
            wheel_diameter=2 * arm.disk_radius,
        )


@record
class ArmHarmonic(Record):
    """One order of the forced motion, 0–peak at the wheel; None: infinite, or no periodic motion was found."""

    order: Annotated[int, Quantity("order")]
    resonance: Annotated[float, Quantity("forced resonance", "ω₀/j", 5, unit="rpm")]
    perturbation: Annotated[float | None, Quantity("by perturbation", unit="um")]
    simulation: Annotated[float | None, Quantity("by simulation", unit="um")]


@record
class TongueEdge(Record):
    """Joint damping below which the arm's free motion grows, at one speed."""

    speed: Annotated[float, Quantity("speed", "Ω", 8, unit="rpm")]
    averaged: Annotated[float, Quantity("averaged", "h_sh", unit="N_s_per_m")]
    floquet: Annotated[float, Quantity("by Floquet multipliers", "h_sh", unit="N_s_per_m")]


@record
class ArmMotion(Record):
    """The arm of a scene while nothing balances its imbalance; rates: how fast its free motions grow or die out."""

    speed: Annotated[float, Quantity("speed", "Ω", 6, unit="rpm")]
    modulation: Annotated[float, Quantity("modulation", "κ_a")]
    natural_frequency: Annotated[float, Quantity("natural frequency", "ω₀", 6, unit="rpm")]
    parametric_speed: Annotated[float, Quantity("parametric resonance", "2ω₀", 6, unit="rpm")]
    joint_damping: Annotated[float, Quantity("joint damping", "h_sh", unit="N_s_per_m")]
    rate: Annotated[float, Quantity("rate away from it", "−h_a", unit="per_s")]
    parametric_rates: Annotated[tuple[float, float], Quantity("rates at 2ω₀", "−h_a ± κ_aω₀/2", unit="per_s")]
    simulated_rates: Annotated[tuple[float, float] | None, Quantity("simulated at this speed", "ln|μ|/T", unit="per_s")]
    harmonics: tuple[ArmHarmonic, ...]
    tongue: tuple[TongueEdge, ...]
