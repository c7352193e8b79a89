"""Levels under load: by steady contact, or by the simulation of grinding where wheel and work part."""

import math
from collections.abc import Sequence
from dataclasses import replace

from abu_calc.analysis.machine import Run
from abu_calc.sizing.design import Design
from abu_calc.sizing.vibration import Loaded, handle_levels


def loaded_levels(design: Design, runs: Sequence[Run]) -> Loaded | None:
    """What steady contact says of the design; where that is not valid after, what the run of grinding shows.

    The level after is not known where wheel and work part and no run tells: that of a rigid contact cannot part.
    """
    steady, contact = design.loaded, design.case.contact
    if steady is None or contact is None or not steady.parts_after:
        return steady
    run = next((run.simulation for run in runs if run.ledger.scene.name == "grinding"), None)
    told = run is not None and contact.kind == "compliant"
    after = math.sqrt(2) * run.response.velocity_rms / design.case.speed if run and told else None
    levels = handle_levels(design.case, steady.before, after, design.autobalancer.mass)
    return replace(steady, levels=levels, simulated=told)
