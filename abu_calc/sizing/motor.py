"""Check of the working speeds against the motor's torque curve."""

from typing import Literal

from abu_calc.checks import Check, coded, verdict
from abu_calc.formulas.motor import working_speed
from abu_calc.sizing.case import Case, working_speeds
from abu_calc.units import from_si, to_si


def motor_checks(case: Case) -> tuple[Check, ...]:
    """Checks of the motor: idling at a working speed of the file, turning under load.

    There is none without a motor.

    A missed working speed is a warning, not a failure: the speeds judged include the idle speed, see
    `Case.speed_range`.
    """
    if case.idle_speed is None:
        return ()
    (low, high), idle = case.table.machine.speed_range, from_si(case.idle_speed, "rpm")
    bound: Literal["least", "most"] = "least" if idle < low else "most"
    limit = low if bound == "least" else high
    kept = case.speed_range == working_speeds(case.table)
    messages, remedies = ["the motor idles at a working speed of the file"], []
    if not kept:
        side = "above" if idle > limit else "below"
        messages = [
            f"the motor idles {100 * abs(idle / limit - 1):.1f} % {side} the working speeds of the file",
            "idle levels, stresses and stability are judged at this speed, too",
        ]
        remedies = [_remedy(low, high, idle)]
    loaded = _speed_under_load(case)
    if loaded is not None:
        messages.append(f"the cutting torque slows it to {_rpm(loaded)}" if loaded else "the cutting torque stops it")
    if loaded == 0:
        remedies.append("Give a motor.stall_torque_N_m above the cutting torque, or reduce grinding.press_force_N.")
    return (
        coded("ABU104", verdict(True, kept and loaded != 0), "; ".join(messages), idle, limit, "rpm",
              " ".join(remedies) or None, bound),
    )  # fmt: skip


def _remedy(low: float, high: float, idle: float) -> str:
    """Entries of the file [rpm] that agree with the idle speed."""
    widened = f"[{min(low, idle):.0f}, {max(high, idle):.0f}]"
    return (
        f"If machine.speed_rpm is the speed under load, set machine.speed_range_rpm = {widened}. If it is the idle "
        f"speed, correct motor.no_load_speed_rpm. If the machine is used at {idle:.0f} rpm, set machine.speed_rpm."
    )


def _speed_under_load(case: Case) -> float | None:
    """Speed [rad/s] at which the motor gives the cutting torque f·N·R_w; None without motor or [grinding]."""
    motor, contact = case.table.motor, case.contact
    if motor is None or contact is None:
        return None
    torque = contact.cutting_coefficient * contact.press_force * case.wheel_radius
    return working_speed(motor.stall_torque_N_m, to_si(motor.no_load_speed_rpm, "rpm"), torque)


def _rpm(speed: float) -> str:
    return f"{from_si(speed, 'rpm'):.0f} rpm"
