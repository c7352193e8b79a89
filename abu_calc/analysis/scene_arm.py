"""Advice on the arm of a scene file.

Such an arm has one stiffness, at one speed, and no bounds over contact angles.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, Final

from abu_calc.dynamics.balanced.stability import critical_damping, stability
from abu_calc.dynamics.scene import Scene
from abu_calc.errors import NotTrustworthyError
from abu_calc.sizing.arm_repairs import Change, up

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
                return f"change {description}. Tried: it is stable, and the bound on the joint damping holds."
    except NotTrustworthyError as error:
        return f"no change was tried: {str(error).splitlines()[0]}."
    return f"no change found. Tried: up to {INERTIA[-1]:g} times the inertia, {DAMPING[-1]:g} times the joint damping."


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
                Change("moment_of_inertia_kg_m2", support.inertia, inertia),
                Change("joint_damping_N_s_per_m", support.damping, damping),
            )
            description = ", ".join(change.text for change in changes if change.new != change.old)
            if description:
                other = replace(heavier, support=replace(support, inertia=inertia, damping=damping))
                yield (other, damping), description


def _holds(scene: Scene, damping: float) -> bool:
    """Stable, and damped above the bound where there is one."""
    limit = critical_damping(scene)
    return (limit is None or damping > limit) and bool(stability(scene).stable)
