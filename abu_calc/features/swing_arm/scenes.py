"""Checks on the simulated scenes of a swing arm, and advice on the arm of a scene file.

In a machine's scenes the disk must stay on its workpiece. The arm of a scene file has one stiffness, at one speed, and
no bounds over contact angles.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, Final

from abu_calc.dynamics.effects.lift_off import LiftOffEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.verdict import critical_damping, stability
from abu_calc.features.swing_arm.verdict import CUTTING
from abu_calc.features.swing_arm.view import ArmChange
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.simulation.design_scenes import SceneRun
from abu_calc.sizing.design import Design
from abu_calc.sizing.swing_arm import up


def on_work(design: Design, runs: Sequence[SceneRun]) -> Check | None:
    """Check that the disk stays on its workpiece in the simulated scene; None if the workpiece has no stiffness."""
    run = next((run for run in runs if run.ledger.scene.name == CUTTING), None)
    effect = None if run is None else run.simulation.scene.effect("lift_off")
    if run is None:
        return coded("ABU506", "not-done", "The scene on the workpiece gave no answer, see ABU703", None)
    if not isinstance(effect, LiftOffEffect):
        return None
    samples = run.simulation.trajectory
    share, last = effect.share_apart(samples), effect.last_apart(samples)
    if share:
        message = "Disk and workpiece lose contact again and again, so the bounds on the arm do not tell its motion"
        return coded("ABU506", "fail", message, share, 0.0)
    if last is None:
        return coded("ABU506", "pass", "The disk stays on its workpiece throughout", 0.0, 0.0)
    time, limit = run.simulation.response.rest_time, design.case.table.limits.longest_quiet_time
    soon = time is not None and time <= limit
    message = f"The disk leaves its workpiece until {last:.3g} s. Then the bounds on the arm hold"
    if not soon:
        message += f". The balls need more than the permitted {limit:g} s to rest there"
    return coded("ABU506", verdict(True, soon), message, 0.0, 0.0)


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
                ArmChange(key="moment_of_inertia_kg_m2", old=support.inertia, new=inertia),
                ArmChange(key="joint_damping_N_s_per_m", old=support.damping, new=damping),
            )
            description = ", ".join(change.text for change in changes if change.new != change.old)
            if description:
                other = replace(heavier, support=replace(support, inertia=inertia, damping=damping))
                yield (other, damping), description


def _holds(scene: Scene, damping: float) -> bool:
    """Stable, and damped above the bound where there is one."""
    limit = critical_damping(scene)
    return (limit is None or damping > limit) and bool(stability(scene).stable)
