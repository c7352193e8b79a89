"""Dimensionless numbers of a design, by which its place on the charts of the atlas is found."""

import math

from abu_calc.formulas.type_test import acceleration_per_displacement
from abu_calc.foundation.units import GRAVITY, to_si
from abu_calc.sizing.design import Design
from abu_calc.sizing.type_test import background, band, chosen_wheel, type_test_body, upright_band, weighted_speed

Numbers = dict[str, float | str]


def machine_numbers(design: Design) -> Numbers:
    """Numbers by name; those that the machine does not have are missing. A body in space and a swing arm have none."""
    case, balls = design.case, design.autobalancer
    if case.body.in_space or case.table.swing_arm is not None:
        return {}
    mass, imbalance, speed = balls.requirement.effective_mass, design.imbalance.value, case.speed
    moment, radius = balls.ball_count * balls.ball_mass * balls.pitch_radius, balls.ball_diameter / 2
    numbers: Numbers = {
        "balls": float(balls.ball_count),
        "spindle": case.table.machine.spindle_axis,
        "start": "full speed" if case.table.run_up is None and case.table.motor is None else "run-up",
        "inertia_factor": case.inertia_factor,
        "ball_size": radius / balls.pitch_radius,
        "friction_ratio": case.friction_arm / radius,
        "eccentricity_ratio": case.race_eccentricity / balls.pitch_radius,
        "plane_offset": abs(case.race_offset) / balls.pitch_radius,
        "mass_ratio": balls.ball_count * balls.ball_mass / mass,
        "mass_over_balls": mass / (balls.ball_count * balls.ball_mass),
        "imbalance_share": imbalance / moment,
    }
    if imbalance > 0:
        displaced = imbalance / case.body.effective_mass()
        numbers |= {
            "eccentricity": case.race_eccentricity / displaced,
            "friction": upright_band(case, balls) / displaced,
            "ovality": balls.budget.race_ovality / displaced,
            "acceleration": displaced * speed**2 / GRAVITY,
        }
    return numbers | _support(design, mass) | _type_test(design, moment) | _work(design)


def _support(design: Design, mass: float) -> Numbers:
    """Numbers that stand on the natural frequencies."""
    case, (along, across) = design.case, design.frequency.natural_frequencies
    if not along or not across:
        return {}
    numbers: Numbers = {
        "speed_ratio": case.speed / along,
        "isotropy": (across / along) ** 2,
        "damping": case.suspension.reaction(0, along).imag / (2 * mass * along**2),
        "drag_ratio": case.drag / along,
    }
    if case.table.run_up is not None:
        numbers["run_up"] = case.table.run_up.time_s * along
    if (motor := case.table.motor) is not None:
        unloaded = to_si(motor.no_load_speed_rpm, "rpm")
        numbers["motor"] = motor.stall_torque_N_m / (motor.rotor_inertia_kg_m2 * unloaded * along)
        numbers["no_load"] = unloaded / case.speed
        numbers["rotor_inertia"] = motor.rotor_inertia_kg_m2 / (mass * design.autobalancer.pitch_radius**2)
    return numbers


def _type_test(design: Design, moment: float) -> Numbers:
    """Numbers that stand on the imbalance of the test wheel."""
    case, wheel = design.case, chosen_wheel(design.case.table)
    if wheel is None or not weighted_speed(case.speed):
        return {}
    bare = max(gain.without(wheel.imbalance) for gain in type_test_body(case).gains)
    return {
        "test_friction": band(case, design.autobalancer) * case.body.effective_mass() / wheel.imbalance,
        "test_background": background(case.table) / (acceleration_per_displacement(case.speed) * bare),
        "test_imbalance_share": wheel.imbalance / moment,
    }


def _work(design: Design) -> Numbers:
    """Numbers of grinding with a compliant contact."""
    case, imbalance = design.case, design.imbalance.value
    if case.contact is None or case.contact.kind != "compliant" or not imbalance:
        return {}
    mass = case.body.effective_mass()
    return {
        "contact_stiffness": case.contact.stiffness / (mass * case.speed**2),
        "runout": case.runout * mass / imbalance,
        "press_force": case.contact.press_force / (imbalance * case.speed**2),
        "cutting": case.contact.cutting_coefficient * -case.contact.sense,
        "runout_angle": math.cos(to_si(case.table.wheel.runout_angle_deg, "deg")),
    }
