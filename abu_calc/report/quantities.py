"""The one table of quantities: what a key of a result is called, its symbol, and its digits, wherever it is shown."""

from collections.abc import Mapping
from typing import Final, NamedTuple

from abu_calc.units import SI_PER_UNIT, SYMBOLS


class Quantity(NamedTuple):
    """Label, symbol and significant digits of a key; the unit stands in the key."""

    label: str
    symbol: str = ""
    digits: int = 4


QUANTITIES: Final[Mapping[str, Quantity]] = {
    "system_mass_kg": Quantity("mass with wheel and autobalancer", "M"),
    "effective_mass_kg": Quantity("mass felt at the wheel", "m_eff"),
    "speed_hz": Quantity("rated speed", "Ω/2π"),
    "natural_frequencies_hz": Quantity("natural frequencies x, y", "ω/2π"),
    "region": Quantity("region"),
    "balancing_possible": Quantity("balancing possible"),
    "finite_mass_gap": Quantity("finite-mass gap", "(2m/JM)^⅓", 3),
    "imbalance_g_mm": Quantity("imbalance", "m₀e"),
    "required_capacity_g_mm": Quantity("required capacity", "m₀e + Mε√{…} + MΔ"),
    "required_capacity_limit_g_mm": Quantity("as printed in the source", "m₀e + Mε"),
    "required_capacity_compliant_g_mm": Quantity("for the compliant contact"),
    "ball_count": Quantity("number of balls", "n"),
    "ball_diameter_mm": Quantity("ball diameter", "2r", 5),
    "ball_mass_g": Quantity("mass of one ball", "m"),
    "race_radius_mm": Quantity("race radius", "R"),
    "pitch_radius_mm": Quantity("pitch radius", "R − r"),
    "groove_radius_mm": Quantity("groove radius (± 0.2)", "ρ"),
    "capacity_g_mm": Quantity("capacity, balls touching", "mR_p·sin nβ/sin β"),
    "capacity_ratio": Quantity("capacity / need", "", 3),
    "outer_diameter_mm": Quantity("outer diameter", "", 4),
    "width_mm": Quantity("width", "", 4),
    "mass_g": Quantity("mass with balls", "", 4),
    "mass_fraction": Quantity("share of the machine's mass", "", 3),
    "ball_force_N": Quantity("force of one ball at top speed", "F", 3),
    "contact_pressure_MPa": Quantity("Hertz pressure", "p₀", 4),
    "hoop_stress_MPa": Quantity("hoop stress", "ρv²", 3),
    "optimum_drag_per_s": Quantity("optimum rolling drag", "2√(Jκ)", 3),
    "carry_over_rpm": Quantity("least speed that carries balls over", "√(g/R_p)", 3),
    "race_eccentricity_um": Quantity("race eccentricity", "Δ", 3),
    "rolling_friction_um": Quantity("dry friction band", "k_r·R_p/r", 3),
    "plane_offset_um": Quantity("race plane off the wheel's", "", 3),
    "capacity_shortfall_um": Quantity("imbalance beyond the capacity", "", 3),
    "rolling_friction_reached_um": Quantity("friction band where balls came to rest", "", 3),
    "residual_um": Quantity("expected residual (root of squares)", "", 3),
    "worst_um": Quantity("worst residual (plain sum)", "", 3),
    "permitted_um": Quantity("permitted by the limit", "", 3),
    "level_before_db": Quantity("level before", "L", 4),
    "level_after_db": Quantity("level after", "L", 4),
    "reduction_db": Quantity("reduction", "ΔL", 3),
    "contact_stiffness_limit_N_per_m": Quantity("contact stiffness limit (series)", "c_n", 5),
    "contact_stiffness_limit_exact_N_per_m": Quantity("contact stiffness limit (exact)", "c_n", 5),
    "worst_contact_angle_deg": Quantity("worst contact angle", "Z*", 4),
    "resonance_rpm": Quantity("highest resonance of the arm", "ω₀*", 4),
    "damping_limit_N_s_per_m": Quantity("damping needed", "h_sh", 3),
    "parametric_growth_rate_per_s": Quantity("growth rate at Ω = 2ω₀*", "κω₀/2 − h", 3),
    "pressed_angle_deg": Quantity("resting angle while cutting", "", 3),
    "scene": Quantity("scene"),
    "duration_s": Quantity("simulated time", "", 3),
    "settling_time_s": Quantity("settling time", "", 3),
    "residual_imbalance_g_mm": Quantity("imbalance left", "", 3),
    "axis_amplitude_mm": Quantity("axis amplitude 0–peak", "", 3),
    "velocity_rms_mm_per_s": Quantity("velocity rms", "v", 3),
    "level_db": Quantity("level", "L", 4),
    "error_estimate": Quantity("error estimate", "", 2),
    "largest_amplitude_mm": Quantity("largest since the start", "", 3),
    "bearing_amplitudes_mm": Quantity("amplitudes at the bearings", "", 3),
    "tilt_x_mrad": Quantity("tilt about x", "θ_x", 3),
    "tilt_y_mrad": Quantity("tilt about y", "θ_y", 3),
    "arm_angle_mrad": Quantity("angle of the arm", "φ", 4),
    "rotor_speed_rpm": Quantity("speed of the rotor", "", 6),
    "unbalanced_amplitude_mm": Quantity("axis amplitude without balls", "A₀", 3),
    "t_s": Quantity("time", "t"),
    "x_mm": Quantity("axis, along the work", "x", 3),
    "y_mm": Quantity("axis, away from the work", "y", 3),
    "vx_mm_per_s": Quantity("velocity along the work", "x'", 3),
    "vy_mm_per_s": Quantity("velocity away from the work", "y'", 3),
    "speed_rpm": Quantity("speed", "Ω", 6),
    "growth_rate_per_s": Quantity("growth rate of a disturbance", "max Re λ", 4),
    "critical_damping_N_s_per_m": Quantity("damping against parametric resonance", "h_sh", 4),
    "resting_angles_deg": Quantity("balls rest at", "θ", 5),
}

UNITLESS: Final = frozenset({"mass_fraction", "capacity_ratio", "region", "scene"})


def unit_of(key: str) -> str:
    """The unit a key carries, as printed: the longest known suffix ("" for none).

    >>> unit_of("damping_limit_N_s_per_m"), unit_of("imbalance_g_mm"), unit_of("ball_count")
    ('N·s/m', 'g·mm', '')
    """
    if key in UNITLESS:
        return ""
    parts = key.split("_")
    for start in range(1, len(parts)):
        suffix = "_".join(parts[start:])
        if suffix in SI_PER_UNIT or suffix in SYMBOLS:
            return SYMBOLS.get(suffix, suffix)
    return ""


def number(value: float, digits: int = 4) -> str:
    """A number with so many significant digits, never in exponents between 1e-4 and 1e7.

    >>> number(1135.91, 4), number(0.0412345, 3), number(2.0, 3), number(1957172.0, 5), number(3.2e-9, 2)
    ('1136', '0.0412', '2.00', '1957200', '3.2e-09')
    """
    if value == 0:
        return "0"
    if not 1e-4 <= abs(value) < 1e7:
        return f"{value:.{digits - 1}e}"
    rounded = float(f"{value:.{digits - 1}e}")
    whole = len(str(int(abs(rounded)))) if abs(rounded) >= 1 else 0
    if whole:
        return f"{rounded:.{max(0, digits - whole)}f}"
    return f"{rounded:#.{digits}g}"


def shown(key: str, value: object) -> str:
    """A value of a result with its unit, as text."""
    if value is None:
        return "not computed"
    if isinstance(value, bool):
        return "yes" if value else "no"
    quantity, unit = QUANTITIES.get(key, Quantity(key)), unit_of(key)
    if key == "mass_fraction" and isinstance(value, float):
        return f"{number(100 * value, quantity.digits)} %"
    if isinstance(value, (list, tuple)):
        text = ", ".join(number(float(each), quantity.digits) for each in value)
    elif isinstance(value, int):
        text = str(value)
    else:
        text = number(value, quantity.digits) if isinstance(value, float) else str(value)
    return f"{text} {unit}".rstrip()
