"""Report text of a swing arm: first changes, bounds, forced motion, and the instability region, drawn."""

from typing import Final

from abu_calc.features.swing_arm.records import ArmMotion, SwingArmRecord
from abu_calc.foundation.validity import bounded
from abu_calc.reporting.blocks import Block, Facts, Grid, Heading, Paragraph, Picture, number
from abu_calc.reporting.parts import facts

BOUNDS: Final = Heading("Swing arm", "swing-arm")
"""Heading of the bounds of the arm."""
ROWS: Final = 7
LEAST: Final = 1e-4
"""Smallest motion [µm] that is stated as a number."""
MARGIN: Final = 12
BOTH, FLOQUET, AVERAGED, HERE = "#", "o", ".", "X"
LEGEND: Final = (
    f"Below {BOTH} the motion grows ({FLOQUET} by Floquet multipliers only, {AVERAGED} averaged only); {HERE} this arm."
)
TOO_NARROW: Final = "Too narrow to be drawn: the imbalance is negligible against the arm's inertia."
FORCED_ONLY: Final = (
    "At ω₀/j the motion of the arm is large but does not grow: these are forced resonances, though Kovalenko 2010 "
    "calls them unstable. Motion grows only about 2ω₀."
)
"""Published otherwise in Kovalenko 2010."""


def arm_line(advice: str | None) -> list[Block]:
    """The line that says what to change on the arm, and by how much."""
    if advice is None:
        return []
    return [Paragraph(f"Arm: {advice}", None if advice.startswith("nothing") else "fail", hang=2)]


def arm_bounds(arm: SwingArmRecord) -> Grid:
    """Each number given beside its bound over all contact angles: stiffness first, damping second."""
    stiffness = min(arm.contact_stiffness_limit_N_per_m, arm.contact_stiffness_limit_exact_N_per_m)
    bunched = arm.damping_limit_bunched_N_s_per_m
    heavy = "" if bunched is None else f", {number(bunched, 3)} with balls together"
    at_work = "none on it" if arm.cutting_frequency_rpm is None else f"{number(arm.cutting_frequency_rpm)} on it"
    rows = (
        ("contact stiffness, N/m", bounded(arm.contact_stiffness_N_per_m),
         f"below {number(stiffness)}, worst at {number(arm.worst_contact_angle_deg)}°"),
        ("pivot damping, N·s/m", f"{arm.joint_damping_N_s_per_m:g}",
         f"above {number(arm.damping_limit_N_s_per_m)}{heavy}"),
        ("contact angle, °", f"{arm.contact_angle_deg:g}", _angles(arm)),
        ("pressing torque, N·m", f"{arm.pressing_moment_N_m:g}",
         f"above {number(arm.least_pressing_moment_N_m)}{_force(arm)}"),
        ("natural frequency, rpm", number(arm.idle_frequency_rpm),
         f"off the workpiece; {at_work}, {number(arm.resonance_rpm)} at most"),
    )  # fmt: skip
    return Grid(("swing arm", "given", "bound at any contact angle"), rows, frozenset({1}))


def _angles(arm: SwingArmRecord) -> str:
    if arm.lifted_contact_angles_deg is None:
        return "stands at every angle"
    low, high = arm.lifted_contact_angles_deg
    return f"not {number(low, 3)} to {number(high, 3)}: friction lifts the arm"


def _force(arm: SwingArmRecord) -> str:
    if arm.press_force_N is None or arm.press_force_N <= 0:
        return ""
    return f"; normal force {number(arm.press_force_N, 3)} N"


def arm_facts(arm: SwingArmRecord) -> list[Block]:
    """All its numbers."""
    rows = facts(arm).rows[1:]
    return [BOUNDS, Paragraph(f"Arm: {arm.advice}"), arm_bounds(arm), Paragraph(""), Facts(rows)]


def motion_blocks(motion: ArmMotion, where: str = "") -> list[Block]:
    """The forced motion by perturbation beside that by simulation, the rates, and the instability region."""
    rows = tuple(
        (f"{row.order}", number(row.resonance_rpm, 5), _or_none(row.perturbation_um), _or_none(row.simulation_um))
        for row in motion.harmonics
    )
    header = ("order i", "resonance ω₀/i, rpm", "perturbation, µm", "simulation, µm")
    return [
        Heading(f"Arm with its imbalance, nothing balanced{where}: motion of the wheel"),
        Grid(header, rows, frozenset({1, 2, 3})),
        Paragraph(_rates(motion)),
        Heading(f"Instability region: pivot damping against speed about 2ω₀{where}"),
        Picture(tuple(tongue_lines(motion)), _legend(motion), indent=2) if motion.tongue else Paragraph(TOO_NARROW),
    ]


def printed_otherwise() -> list[Block]:
    """Paragraph on the error of the source."""
    return [Paragraph(FORCED_ONLY)]


def _or_none(value: float | None) -> str:
    if value is None:
        return "none"
    return number(value) if value >= LEAST else f"below {LEAST:g}"


def _rates(motion: ArmMotion) -> str:
    """Averaged and simulated."""
    high, low = (number(rate) for rate in motion.parametric_rates_per_s)
    simulated = motion.simulated_rates_per_s
    simulation = "no periodic motion found" if simulated is None else f"simulated {number(simulated[0])}"
    if simulated is not None and simulated[0] != simulated[1]:
        simulation += f" and {number(simulated[1])}"
    return (
        f"A free motion varies as e^(λt): λ = {number(motion.rate_per_s)} 1/s by averaging, {simulation} at "
        f"{number(motion.speed_rpm, 6)} rpm; {high} and {low} at 2ω₀."
    )


def tongue_lines(motion: ArmMotion) -> list[str]:
    """The instability region in characters: damping upward, speed to the right, two columns a speed."""
    edges = motion.tongue
    top = 1.1 * max(max(point.averaged_N_s_per_m, point.floquet_N_s_per_m) for point in edges)
    cells = [[" "] * (2 * len(edges)) for _ in range(ROWS)]
    for column, edge in enumerate(edges):
        for damping, mark in ((edge.averaged_N_s_per_m, AVERAGED), (edge.floquet_N_s_per_m, FLOQUET)):
            row = _row(damping, top)
            if damping > 0 and row is not None:
                other = cells[row][2 * column]
                cells[row][2 * column] = BOTH if other == AVERAGED and mark == FLOQUET else mark
    here = _column(motion), _row(motion.joint_damping_N_s_per_m, top)
    if here[0] is not None and here[1] is not None:
        cells[here[1]][here[0]] = HERE
    labels = {0: f"{number(top, 3)} N·s/m", ROWS - 1: "0"}
    lines = [f"{labels.get(k, ''):>{MARGIN}} |{''.join(row)}".rstrip() for k, row in enumerate(cells)]
    middle, width = edges[len(edges) // 2].speed_rpm, 2 * len(edges) - 1
    low, high = (f"{end.speed_rpm - middle:+.3g}" for end in (edges[0], edges[-1]))
    scale = f"{low}{number(middle, 6):^{max(0, width - len(low) - len(high))}}{high}"
    return [*lines, f"{'':>{MARGIN}} +{'-' * width}", f"{'rpm':>{MARGIN}}  {scale}"]


def _row(damping: float, top: float) -> int | None:
    """None above the drawing."""
    row = ROWS - 1 - int(damping / top * ROWS)
    return row if row >= 0 else None


def _column(motion: ArmMotion) -> int | None:
    """Column of the speed in the drawing; None if the speed is beside the drawing."""
    speeds = [edge.speed_rpm for edge in motion.tongue]
    if not speeds[0] <= motion.speed_rpm <= speeds[-1]:
        return None
    return 2 * min(range(len(speeds)), key=lambda k: abs(speeds[k] - motion.speed_rpm))


def _legend(motion: ArmMotion) -> str:
    """Legend of the characters, with the place of the arm if it is off the drawing."""
    top = 1.1 * max(edge.averaged_N_s_per_m for edge in motion.tongue)
    if _column(motion) is not None and _row(motion.joint_damping_N_s_per_m, top) is not None:
        return LEGEND
    share = motion.speed_rpm / motion.parametric_speed_rpm
    here = f"This arm is off the drawing: {number(motion.speed_rpm, 6)} rpm, {number(share, 5)} of 2ω₀"
    return f"{LEGEND.split(';')[0]}. {here}; damping {motion.joint_damping_N_s_per_m:g} N·s/m."
