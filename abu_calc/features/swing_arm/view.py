"""Report text of a swing arm: first changes, bounds, forced motion, and the instability region, drawn.

Sketch of the swing arm: its pivot, the wheel, the workpiece, and the angles between them.

A swing arm as results hold it: bounds over all contact angles, changes, forced motion, instability region.
"""

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Annotated, ClassVar, Final, Self

from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.validity import bounded
from abu_calc.reporting.blocks import Block, Facts, Grid, Heading, Paragraph, Picture, number
from abu_calc.reporting.drawings.dimensions import leader, scale_for, sketch
from abu_calc.reporting.drawings.shapes import (
    HEIGHT,
    SCALES,
    Arc,
    Drawing,
    Length,
    Line,
    Point,
    Radius,
    Shape,
    Text,
    digits,
)
from abu_calc.reporting.parts import facts
from abu_calc.simulation.result import Result

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


def swing_arm_sketch(result: Result, arm: SwingArmRecord, radius_mm: float) -> Drawing:
    """The arm where its wheel touches the work, to scale in its length, wheel and angles."""
    wheel = arm.wheel_diameter_mm / 2
    scale = scale_for(arm.arm_length_mm + wheel, SCALES)
    shapes = (
        *_joint(scale),
        *_arm(arm, radius_mm),
        *_work(arm, scale),
        *_dimensions(arm, scale),
        *_bounds(arm, scale),
    )
    return sketch("swing-arm", "Swing arm", _described(arm), result, shapes, scale)


def _described(arm: SwingArmRecord) -> str:
    return (
        f"An arm of {digits(arm.arm_length_mm)} mm from its joint to the axis of a wheel of "
        f"{digits(arm.wheel_diameter_mm)} mm. The radius to the contact stands at {digits(arm.contact_angle_deg)}° to "
        f"the arm; the wheel touches the work when the arm has turned by {digits(arm.touch_angle_deg)}°."
    )


def _turned(radius: float, degrees: float, about: Point = (0.0, 0.0)) -> Point:
    return about[0] + radius * math.cos(math.radians(degrees)), about[1] + radius * math.sin(math.radians(degrees))


def _joint(scale: float) -> Iterator[Shape]:
    """A pivot on firm ground."""
    size = 4 / scale
    yield Arc("outline", (0, 0), size / 2)
    yield Line("outline", (0, -size / 2), (-size, -2 * size))
    yield Line("outline", (0, -size / 2), (size, -2 * size))
    yield from _ground((-1.5 * size, -2 * size), (1.5 * size, -2 * size), scale)


def _ground(start: Point, end: Point, scale: float) -> Iterator[Shape]:
    """A line with strokes on its right side."""
    long = math.dist(start, end)
    along = (end[0] - start[0]) / long, (end[1] - start[1]) / long
    step = 3 / scale
    yield Line("outline", start, end)
    for index in range(1, int(long / step) + 1):
        x, y = start[0] + along[0] * step * index, start[1] + along[1] * step * index
        yield Line("hatch", (x, y), (x + step * (along[1] - along[0]), y - step * (along[0] + along[1])))


def _arm(arm: SwingArmRecord, autobalancer: float) -> Iterator[Shape]:
    """The arm, where it stands before the wheel touches, the wheel with the autobalancer on it."""
    wheel, length = arm.wheel_diameter_mm / 2, arm.arm_length_mm
    centre = (length, 0.0)
    yield Line("outline", (0, 0), centre)
    yield Line("hidden", (0, 0), _turned(length, arm.touch_angle_deg))
    yield Arc("dimension", (0, 0), 0.7 * length, *sorted((0.0, arm.touch_angle_deg)))
    yield Arc("outline", centre, wheel)
    yield Arc("hidden", centre, min(autobalancer, 0.98 * wheel))
    reach = 1.1 * wheel
    yield Line("centre", (length - reach, 0), (length + reach, 0))
    yield Line("centre", (length, -reach), (length, reach))


def _work(arm: SwingArmRecord, scale: float) -> Iterator[Shape]:
    """The radius to the contact, at its angle to the arm, and the surface across it."""
    wheel, centre = arm.wheel_diameter_mm / 2, (arm.arm_length_mm, 0.0)
    towards = 180 + arm.contact_angle_deg
    touch = _turned(wheel, towards, centre)
    yield Line("dimension", centre, touch)
    if arm.contact_angle_deg:
        yield Arc("dimension", centre, 0.55 * wheel, 180, towards)
    half = _half_work(arm, scale)
    # Seen from the wheel the strokes lie beyond the surface.
    yield from _ground(_turned(half, towards - 90, touch), _turned(half, towards + 90, touch), scale)


def _half_work(arm: SwingArmRecord, scale: float) -> float:
    """Half of the surface that is drawn."""
    return float(max(0.45 * arm.wheel_diameter_mm, 12 / scale))


def _dimensions(arm: SwingArmRecord, scale: float) -> Iterator[Shape]:
    wheel, length, unit = arm.wheel_diameter_mm / 2, arm.arm_length_mm, 1 / scale
    top, right = wheel + 14 * unit, length + max(wheel, _half_work(arm, scale)) + 10 * unit
    yield Length((0, 0), (length, 0), top, f"l = {digits(length)}")
    yield Radius((length, 0), wheel, 45, (right, wheel + 4 * unit), f"wheel R{digits(wheel)}")
    angle = _turned(0.55 * wheel, 180 + arm.contact_angle_deg / 2, (length, 0.0))
    yield from leader(angle, (right, -4 * unit), f"Z = {digits(arm.contact_angle_deg)}°", scale)
    rest = _turned(0.7 * length, arm.touch_angle_deg / 2)
    yield from leader(rest, (-10 * unit, 6 * unit), f"φ₀ = {digits(arm.touch_angle_deg)}°", scale)


def _bounds(arm: SwingArmRecord, scale: float) -> Iterator[Text]:
    """Requirements on the arm, as text under the pivot."""
    lines = (
        f"contact stiffness < {number(arm.contact_stiffness_limit_N_per_m, 5)} N/m",
        f"worst contact angle {number(arm.worst_contact_angle_deg)}°",
        f"highest resonance {number(arm.resonance_rpm)} rpm",
        f"damping > {number(arm.damping_limit_N_s_per_m, 3)} N·s/m",
    )
    low = -1.4 * max(arm.wheel_diameter_mm / 2, _half_work(arm, scale)) - 14 / scale
    for index, line in enumerate(lines):
        yield Text((-10 / scale, low - 1.7 * HEIGHT * index / scale), line)
