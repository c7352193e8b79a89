"""Numbers of a machine that do not go together, though each may stand alone."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from abu_calc.spec.usual import Usual
from abu_calc.units import to_si
from abu_calc.validity import bounded

if TYPE_CHECKING:
    from abu_calc.spec.autobalancer import Autobalancer
    from abu_calc.spec.body import MachineTable
    from abu_calc.spec.duty import Motor
    from abu_calc.spec.wheel import Wheel

FASTEST_RIM: Final = 160.0
"""Few wheels may run faster [m/s]; hand grinders stay below 80, machines below 125 (EN 12413)."""
LARGEST_HAND_HELD: Final = 300.0
"""Diameter [mm] of the largest wheels on hand grinders."""


def larger_than_its_wheel(abu: "Autobalancer", wheel: "Wheel") -> Iterator[tuple[tuple[str, ...], str]]:
    """An autobalancer that may be larger than the wheel beside which it must vanish."""
    envelope, diameter = abu.max_outer_diameter_mm, wheel.diameter_mm
    if envelope <= diameter:
        return
    meant = ""
    if envelope <= LARGEST_HAND_HELD:
        from abu_calc.spec.mistaken_units import guesses, meant_in

        meant = meant_in(guesses("diameter_mm", [diameter], Usual(envelope, LARGEST_HAND_HELD)), " mm")
    yield (
        ("autobalancer", "max_outer_diameter_mm"),
        f"is unusual, larger than the wheel: wheel.diameter_mm = {bounded(diameter)}."
        + (f" The wheel's {meant}?" if meant else ""),
    )


def rim_too_fast(
    machine: "MachineTable", wheel: "Wheel", motor: "Motor | None"
) -> Iterator[tuple[tuple[str, ...], str]]:
    """A rim that runs faster than wheels bear, at the highest working speed or at the motor's no-load speed."""
    key = "speed_rpm" if machine.speed_range_rpm is None else "speed_range_rpm"
    path, speed = ("machine", key), machine.speed_range[1]
    if motor is not None and motor.no_load_speed_rpm > speed:
        path, speed = ("motor", "no_load_speed_rpm"), motor.no_load_speed_rpm
    rim = to_si(speed, "rpm") * to_si(wheel.diameter_mm, "mm") / 2
    if rim <= FASTEST_RIM:
        return
    yield (
        path,
        f"is unusual with wheel.diameter_mm = {bounded(wheel.diameter_mm)}: the rim would run at {rim:.0f} m/s, up to "
        f"{FASTEST_RIM:g} m/s is usual.",
    )
