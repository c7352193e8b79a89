"""Sketch of the swing arm: its pivot, the wheel, the workpiece, and the angles between them."""

import math
from collections.abc import Iterator

from abu_calc.features.swing_arm.records import SwingArmRecord
from abu_calc.reporting.blocks import number
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
from abu_calc.simulation.result import Result


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
