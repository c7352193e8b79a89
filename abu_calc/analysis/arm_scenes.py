"""The joint damping with which the scenes of a swing arm can be simulated, where with less they give no answer."""

from typing import Final

from abu_calc.analysis.arm import CUTTING, IDLE, ArmJudgement, changed
from abu_calc.analysis.machine import simulated
from abu_calc.progress import Progress, silent, within
from abu_calc.scenes.durations import DECAY_TIMES
from abu_calc.sizing.arm_repairs import Change, up
from abu_calc.sizing.design import Design

LONGEST: Final = 3.0
"""Settling times permitted: as long as a scene lasts at most."""

TIMES: Final = (1.0, 2.0, 4.0)
"""Of the damping with which the arm has come to rest by then."""


def damping_to_simulate(
    design: Design, judged: ArmJudgement, accuracy: float, progress: Progress = silent
) -> Change | None:
    """The least that was tried with which both scenes are simulated and every check of the arm passes; None: none was.

    On the arm with the changes that are advised.
    """
    arm, table = judged.bounds.arm, design.case.table.swing_arm
    assert table is not None
    values = {change.key: change.new for change in judged.changes}
    added = arm.inertia - table.moment_of_inertia_kg_m2
    inertia = values.get("moment_of_inertia_kg_m2", table.moment_of_inertia_kg_m2) + added
    rate = DECAY_TIMES / (LONGEST * design.case.table.limits.settling_time_s)
    old = values.get("joint_damping_N_s_per_m", table.joint_damping_N_s_per_m)
    for times in TIMES:
        new = up(times * 2 * inertia * rate / arm.length**2)
        if new <= old:
            continue
        change = Change("joint_damping_N_s_per_m", table.joint_damping_N_s_per_m, new)
        tell = within(progress, f"with {change.text}")
        other = changed(design, (*judged.changes, change))
        if other is not None and not simulated(other, accuracy, tell, (IDLE, CUTTING))[1]:
            return change
    return None
