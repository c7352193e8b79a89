"""The SI numbers and states of a scene that is integrated, and what it is in words."""

from collections.abc import Mapping
from typing import Any, ClassVar, Self

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.race import Race
from abu_calc.dynamics.scene import Scene
from abu_calc.studies.quantity import Record, as_plain, record


@record
class RaceModel(Record):
    """A race and its balls."""

    pitch_radius_m: float
    plane_offset_m: float
    ball_masses_kg: tuple[float, ...]
    ball_radius_m: float
    drag_per_s: float
    inertia_factor: float
    start_angles_rad: tuple[float, ...]
    start_speeds_rad_per_s: tuple[float, ...]

    @classmethod
    def of(cls, race: Race) -> Self:
        """Model of a race."""
        return cls(
            pitch_radius_m=race.pitch_radius,
            plane_offset_m=race.plane_offset,
            ball_masses_kg=race.ball_masses,
            ball_radius_m=race.ball_radius,
            drag_per_s=race.drag,
            inertia_factor=race.inertia_factor,
            start_angles_rad=race.start_angles,
            start_speeds_rad_per_s=race.start_speeds,
        )


@record
class SceneModel(Record):
    """A scene as it is integrated; the numbers of its support stand beside the others."""

    left_out: ClassVar[frozenset[str]] = frozenset({"support"})

    states: tuple[str, ...]
    support: Mapping[str, object]
    speed_rad_per_s: float
    imbalance_kg_m: float
    imbalance_angle_rad: float
    couple_kg_m2: float
    couple_angle_rad: float
    races: tuple[RaceModel, ...]
    effects: tuple[str, ...]
    start_position: tuple[float, ...]
    start_velocity: tuple[float, ...]
    duration_s: float

    @classmethod
    def of(cls, scene: Scene) -> Self:
        """Model of a scene."""
        return cls(
            states=assemble(scene).states,
            support=scene.support.model(),
            speed_rad_per_s=scene.speed,
            imbalance_kg_m=scene.imbalance,
            imbalance_angle_rad=scene.imbalance_angle,
            couple_kg_m2=scene.couple,
            couple_angle_rad=scene.couple_angle,
            races=tuple(map(RaceModel.of, scene.races)),
            effects=tuple(effect.name for effect in scene.effects),
            start_position=scene.start_position,
            start_velocity=scene.start_velocity,
            duration_s=scene.duration,
        )

    def to_dict(self) -> dict[str, Any]:
        """The support's numbers beside the others."""
        return {**as_plain(self.support), **super().to_dict()}


def in_words(scene: Scene) -> str:
    """Support, races and balls in a sentence."""
    races, balls = len(scene.races), len(scene.ball_masses)
    contact = "" if scene.balls_meet or balls < 2 else "; balls pass through each other"
    where = "one race" if races == 1 else f"{races} races"
    return f"{scene.support.description}, {where} with {balls} balls in all, viscous rolling drag{contact}."
