"""A machine with two races as the subject of `abu simulate` and `abu stability`: one of its start cases."""

from typing import Final

from abu_calc.features.two_races.case import read_case
from abu_calc.features.two_races.choice import choose_both
from abu_calc.features.two_races.start_cases import scene_of
from abu_calc.features.two_races.start_cases import start as start_of
from abu_calc.formulas.balls import half_angle
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.units import to_si
from abu_calc.inputs.read_machine import Machine
from abu_calc.simulation.start_cases import ALIKE, KINDS
from abu_calc.simulation.subject import RACE_CENTRE, Subject

SCENE: Final = "idle"
IN_WORDS: Final = {
    "bunched": "balls at rest in both races, neighbours touching, their middle 20° ahead of what the race balances",
    "spread": "balls at rest in both races, evenly round them, the first at what the race balances",
    "standstill": "balls not turning at all, neighbours touching, their middle 20° ahead of what the race balances",
    "run-up": "rotor and balls at standstill; the rotor runs up",
}


def two_race_subject(
    machine: Machine, scene: str | None = None, start: str | None = None, race_centre_deg: float | None = None
) -> Subject:
    """Subject of a machine with two races: its idle scene in a start case, by default with bunched balls.

    Imbalances of unknown phase take the phase 0. The race centres are off toward the resultant of the imbalances, or by
    `race_centre_deg` from it. The balls start where [start] of the file places them, unless another start is asked for.
    Raises InputError for another scene or start, and for what cannot be sized.
    """
    table = machine.two_races
    if table is None:
        raise InputError("this file has one race")
    for key, given, allowed in (("scene", scene, (SCENE,)), ("start", start, KINDS)):
        if given is not None and given not in allowed:
            raise InputError(
                f"a machine with two races has no such {key}", place=Place(machine.file, key=key), found=given,
                allowed=", ".join(allowed),
            )  # fmt: skip
    centre = ALIKE if race_centre_deg is None else to_si(RACE_CENTRE.check(race_centre_deg), "deg")
    with machine.located():
        design = choose_both(read_case(table))
    unknown = design.case.unknown_phases
    kind = next(each for each in KINDS if each == (start or "bunched"))
    sized = [race.design.autobalancer for race in design.races]
    placed = table.start if start in (None, "run-up") else None
    balls = sum(abu.ball_count for abu in sized)
    if placed is not None and (len(placed.angles_deg) != balls or placed.speeds_rpm is not None):
        with machine.located():
            raise InputError(
                "one angle for each ball, those of the first race first, without speeds",
                place=Place(key="start.angles_deg"), found=f"{len(placed.angles_deg)}", allowed=f"{balls}",
            )  # fmt: skip
    angles = () if placed is None else tuple(to_si(angle, "deg") for angle in placed.angles_deg)
    notes = ("Imbalances of unknown phase are taken in phase; `abu size` simulates four phases",) if unknown else ()
    return Subject(
        title=table.machine.name,
        reading=machine,
        scene=scene_of(design, start_of(design, kind, eccentricity=centre, angles=angles)),
        start="as the file places the balls" if placed else IN_WORDS[kind],
        half_angle=max(half_angle(abu.ball_diameter / 2, abu.pitch_radius) for abu in sized),
        warnings=(*machine.warnings, *notes),
    )
