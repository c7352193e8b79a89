"""Checks on the simulated scenes of a swing arm.

The disk must stay on its workpiece. If a scene gives no answer with less pivot damping, the damping
that gives one is advised.
"""

from collections.abc import Sequence
from typing import Final

from abu_calc.analysis.arm import CUTTING, IDLE, ArmJudgement, changed
from abu_calc.analysis.machine import Run, simulated
from abu_calc.checks import Check, coded, verdict
from abu_calc.dynamics.effects.lift_off import LiftOff
from abu_calc.progress import Progress, silent, within
from abu_calc.scenes.durations import DECAY_TIMES
from abu_calc.sizing.arm_repairs import Change, up
from abu_calc.sizing.design import Design

LONGEST: Final = 3.0
"""Settling times permitted: as long as a scene lasts at most."""

TIMES: Final = (1.0, 2.0, 4.0)
"""Factors on the damping with which the arm comes to rest within the longest scene."""


FIRMER: Final = (1.5, 2.0, 3.0, 5.0, 10.0)
"""Times the pressing moment, tried where the disk bounces."""


def on_work(design: Design, runs: Sequence[Run], accuracy: float, progress: Progress = silent) -> Check | None:
    """Check that the disk stays on its workpiece in the simulated scene.

    None if the workpiece has no stiffness. If the disk bounces, the action is the least of the tried
    pressing moments with which it stays.
    """
    run = next((run for run in runs if run.ledger.scene.name == CUTTING), None)
    effect = None if run is None else run.simulation.scene.effect("lift_off")
    if run is None:
        return coded("ABU506", "not-done", "the scene at the work gave no answer, see ABU703", unit="%")
    if not isinstance(effect, LiftOff):
        return None
    samples = run.simulation.trajectory
    share, last = 100 * effect.share_apart(samples), effect.last_apart(samples)
    if share:
        message = "disk and work part again and again, so that the bounds on the arm do not say how it moves"
        return coded("ABU506", "fail", message, share, 0.0, "%", _firmer(design, accuracy, progress))
    if last is None:
        return coded("ABU506", "pass", "the disk is pressed to its work throughout", 0.0, 0.0, "%")
    time, limit = run.simulation.response.settling_time, design.case.table.limits.settling_time_s
    soon = time is not None and time <= limit
    message = f"the disk leaves its work until {last:.3g} s, then the bounds on the arm hold"
    if not soon:
        message += f"; the balls need more than the {limit:g} s allowed to settle there"
    return coded("ABU506", verdict(True, soon), message, 0.0, 0.0, "%")


def _firmer(design: Design, accuracy: float, progress: Progress) -> str:
    """Sentence on the pressing moments that were tried."""
    table = design.case.table.swing_arm
    assert table is not None
    for times in FIRMER:
        change = Change("pressing_moment_N_m", table.pressing_moment_N_m, up(times * table.pressing_moment_N_m))
        other = changed(design, (change,))
        if other is None:
            continue
        runs, _ = simulated(other, accuracy, within(progress, f"with {change.text}"), (CUTTING,))
        effect = runs[0].simulation.scene.effect("lift_off") if runs else None
        if isinstance(effect, LiftOff) and not effect.share_apart(runs[0].simulation.trajectory):
            return f"Tried: {change.text}; the disk then stays on its work in the end."
    return f"A better balanced wheel. Tried without success: up to {FIRMER[-1]:g} times the pressing moment."


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
