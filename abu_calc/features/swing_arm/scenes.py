"""Checks on the simulated scenes of a swing arm, and advice on the arm of a scene file.

In a machine's scenes the disk must stay on its workpiece. If a scene gives no answer with less pivot damping, the
damping that gives one is advised. The arm of a scene file has one stiffness, at one speed, and no bounds over contact
angles.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, Final

from abu_calc.dynamics.effects.lift_off import LiftOffEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.verdict import critical_damping, stability
from abu_calc.features.swing_arm.verdict import CUTTING, IDLE, ArmJudgement, changed
from abu_calc.foundation.checks import Action, Check, coded, verdict
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.progress import Progress, silent, within
from abu_calc.simulation.design_scenes import SceneRun, simulated
from abu_calc.simulation.durations import DECAY_TIMES
from abu_calc.sizing.actions import overrides, pins, words
from abu_calc.sizing.design import Design
from abu_calc.sizing.swing_arm import ArmRepair, up

LONGEST: Final = 3.0
"""Quiet times permitted: as long as a scene lasts at most."""

TIMES: Final = (1.0, 2.0, 4.0)
"""Factors on the damping with which the arm comes to rest within the longest scene."""


FIRMER: Final = (1.5, 2.0, 3.0, 5.0, 10.0)
"""Times the pressing moment, tried where the disk bounces."""


def on_work(design: Design, runs: Sequence[SceneRun], accuracy: float, progress: Progress = silent) -> Check | None:
    """Check that the disk stays on its workpiece in the simulated scene.

    None if the workpiece has no stiffness. If the disk bounces, the action is the least of the tried
    pressing moments with which it stays.
    """
    run = next((run for run in runs if run.ledger.scene.name == CUTTING), None)
    effect = None if run is None else run.simulation.scene.effect("lift_off")
    if run is None:
        return coded("ABU506", "not-done", "The scene on the workpiece gave no answer, see ABU703", unit="%")
    if not isinstance(effect, LiftOffEffect):
        return None
    samples = run.simulation.trajectory
    share, last = 100 * effect.share_apart(samples), effect.last_apart(samples)
    if share:
        message = "Disk and workpiece lose contact again and again, so the bounds on the arm do not tell its motion"
        return coded("ABU506", "fail", message, share, 0.0, "%", _firmer(design, accuracy, progress))
    if last is None:
        return coded("ABU506", "pass", "The disk stays on its workpiece throughout", 0.0, 0.0, "%")
    time, limit = run.simulation.response.rest_time, design.case.table.limits.longest_quiet_time
    soon = time is not None and time <= limit
    message = f"The disk leaves its workpiece until {last:.3g} s. Then the bounds on the arm hold"
    if not soon:
        message += f". The balls need more than the permitted {limit:g} s to rest there"
    return coded("ABU506", verdict(True, soon), message, 0.0, 0.0, "%")


def _firmer(design: Design, accuracy: float, progress: Progress) -> Action:
    """The least pressing moment, of those simulated, with which the disk stays on its workpiece."""
    table = design.case.table.swing_arm
    assert table is not None
    for times in FIRMER:
        change = ArmRepair("pressing_moment_N_m", table.pressing_moment_N_m, up(times * table.pressing_moment_N_m))
        other = changed(design, (change,))
        if other is None:
            continue
        runs, _ = simulated(other, accuracy, within(progress, f"with {change.text}"), (CUTTING,))
        effect = runs[0].simulation.scene.effect("lift_off") if runs else None
        if isinstance(effect, LiftOffEffect) and not effect.share_apart(runs[0].simulation.trajectory):
            entries: dict[str, object] = {f"swing_arm.{change.key}": change.new}
            return Action(f"Set {words(entries)}.", overrides({**entries, **pins(design.autobalancer)}))
    return Action(f"Balance the wheel better. Up to {FIRMER[-1]:g} times the pressing moment did not help (simulated).")


def damping_to_simulate(
    design: Design, judged: ArmJudgement, accuracy: float, progress: Progress = silent
) -> ArmRepair | None:
    """The least that was tried with which both scenes are simulated and every check of the arm passes; None: none was.

    On the arm with the changes that are advised.
    """
    arm, table = judged.bounds.arm, design.case.table.swing_arm
    assert table is not None
    values = {change.key: change.new for change in judged.changes}
    added = arm.inertia - table.moment_of_inertia_kg_m2
    inertia = values.get("moment_of_inertia_kg_m2", table.moment_of_inertia_kg_m2) + added
    rate = DECAY_TIMES / (LONGEST * design.case.table.limits.longest_quiet_time)
    old = values.get("joint_damping_N_s_per_m", table.joint_damping_N_s_per_m)
    for times in TIMES:
        new = up(times * 2 * inertia * rate / arm.length**2)
        if new <= old:
            continue
        change = ArmRepair("joint_damping_N_s_per_m", table.joint_damping_N_s_per_m, new)
        tell = within(progress, f"with {change.text}")
        other = changed(design, (*judged.changes, change))
        if other is not None and not simulated(other, accuracy, tell, (IDLE, CUTTING))[1]:
            return change
    return None


INERTIA: Final = (1.0, 1.2, 1.5, 2.0, 3.0)
DAMPING: Final = (1.0, 2.0, 5.0, 20.0)
"""Times what it has, tried one after another."""
MARGIN: Final = 1.05


def advise_scene(scene: Scene) -> str | None:
    """Advice in one line that makes the balanced state stable and the pivot damped above its bound.

    None without a swing arm. Every advised change was tried.
    """
    arm = scene.support.standing_arm(scene.balls)
    if arm is None:
        return None
    if arm.joint_stiffness <= 0:
        return "nothing holds it, so that it has no place of rest: it needs some joint stiffness."
    try:
        if scene.ball_masses and stability(scene, arrangement="fan").angles is None:
            return "the balls cannot carry the imbalance: no change of the arm makes them."
        if _holds(scene, arm.joint_damping):
            limit = critical_damping(scene)
            share = f"more than {100 * limit / arm.joint_damping:.2g} %" if limit else "none"
            return f"nothing to change. The bound asks for {share} of the joint damping."
        for changed, description in _changed(scene):
            if _holds(*changed):
                return f"change {description}. Calculated: it is stable, and the bound on the joint damping holds."
    except NotTrustworthyError as error:
        return f"no change was tried: {str(error).splitlines()[0]}."
    return (
        f"no change found by calculating up to {INERTIA[-1]:g} times the inertia and {DAMPING[-1]:g} times the joint "
        "damping."
    )


def _changed(scene: Scene) -> Iterator[tuple[tuple[Scene, float], str]]:
    """The scene with more inertia, more damping, or both; its damping; what was changed, in words."""
    support: Any = scene.support  # which knows its inertia and damping, as it stands on an arm
    for times in INERTIA:
        inertia = up(times * support.inertia) if times > 1 else support.inertia
        heavier = replace(scene, support=replace(support, inertia=inertia))
        limit = critical_damping(heavier) or 0.0
        for more in DAMPING:
            enough = more == 1 and support.damping > limit
            damping = support.damping if enough else up(max(MARGIN * limit, more * support.damping))
            changes = (
                ArmRepair("moment_of_inertia_kg_m2", support.inertia, inertia),
                ArmRepair("joint_damping_N_s_per_m", support.damping, damping),
            )
            description = ", ".join(change.text for change in changes if change.new != change.old)
            if description:
                other = replace(heavier, support=replace(support, inertia=inertia, damping=damping))
                yield (other, damping), description


def _holds(scene: Scene, damping: float) -> bool:
    """Stable, and damped above the bound where there is one."""
    limit = critical_damping(scene)
    return (limit is None or damping > limit) and bool(stability(scene).stable)
