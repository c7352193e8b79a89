"""Warnings about how the stability of a balanced state was found."""

from collections.abc import Iterator
from typing import Final

from abu_calc.dynamics.balanced.arrangements import Arrangement
from abu_calc.dynamics.balanced.stability import Stability
from abu_calc.dynamics.scene import Scene

BALANCED_TO_FIRST_ORDER: Final = frozenset({"gravity"})
"""Effects that leave the balanced state as it is, to the first order."""


def stability_warnings(judgement: Stability, scene: Scene, way: Arrangement) -> Iterator[str]:
    """Each a sentence or two."""
    yield from _state_judged(judgement, scene)
    if judgement.multipliers is not None:
        yield (
            "What is felt of the support changes as the rotor turns: Floquet multipliers of one revolution stand in "
            "place of eigenvalues."
        )
    if judgement.angles is not None:
        yield from _arrangements(judgement, scene, way)
    others = [name for name in judgement.left_out if name not in BALANCED_TO_FIRST_ORDER]
    if others:
        yield f"Left out of the linear motion, at steady speed: {', '.join(others)}."


def _state_judged(judgement: Stability, scene: Scene) -> Iterator[str]:
    """Warnings about a judged state other than balls opposite the imbalance with a still axis."""
    if judgement.reason:
        yield f"No eigenvalues: {judgement.reason}."
    elif judgement.state is None:
        yield "No eigenvalues: there is no balanced state at this speed."
    if judgement.state == "race still":
        yield (
            "The race is not in the plane of the imbalance: its balls hold the race itself still, the axis keeps "
            "moving elsewhere. That state is judged."
        )
    if judgement.state == "arm alone":
        why = "the balls cannot carry the imbalance" if scene.ball_masses else "there are no balls"
        yield f"Judged is the forced motion of the arm alone with its imbalance: {why}."


def _arrangements(judgement: Stability, scene: Scene, way: Arrangement) -> Iterator[str]:
    """Warning about the arrangement that was judged, of many that balance."""
    counts = [len(race.ball_masses) for race in scene.races]
    most = max(counts, default=0)
    if most <= 2:
        return
    phrase = {
        "fan": "the one spread about the light side with even gaps between equal balls: others may be less stable",
        "start": "the one to which balls go from their start angles, heavily damped and without size",
        "worst": f"the least stable of {judgement.arrangements} that stand for all, the even fan among them",
    }[way]
    if way == "worst" and judgement.multipliers is not None and judgement.state == "balanced":
        phrase = f"the least stable that a search found, {judgement.arrangements} of them compared"
    if way == "worst" and judgement.state == "race still":
        phrase = "the one with even gaps: others are not known where the axis moves"
    yield (
        f"{most} balls of a race can balance in many arrangements; judged is {phrase}. The neutral motions from one to "
        "another do not count."
    )
    if way == "worst" and (
        sum(count > 2 for count in counts) > 1 or any(len(set(r.ball_masses)) > 1 for r in scene.races)
    ):
        yield (
            "Not all arrangements were looked at: several races change together, from even to less even, and unequal "
            "balls keep the order of the file."
        )
