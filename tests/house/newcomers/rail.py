"""A rotor on a rail: its axis slides along one line, at an angle to x, on a spring and a damper.

M s'' + b s' + k s = m₀e Ω² cos(Ωt − α),    x = s cos α, y = s sin α
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from abu_calc.dynamics.motion import Levers, Motion
from abu_calc.dynamics.rotor import Balls, Frame, Geometry, Parameters, Race
from abu_calc.dynamics.support import SmallMotion, Support, Unbalance
from abu_calc.inputs.reading.table import Table, entry


class OnRail(Table):
    """A rotor that slides along one line: support = "rail"."""

    stiffness_N_per_m: float = entry(ge=0, le=1e15, example=2e4).means("Stiffness along the rail [N/m]; {range}.")
    damping_N_s_per_m: float = entry(ge=0, le=1e12, example=60.0).means("Damping along the rail [N·s/m]; {range}.")
    angle_deg: float = entry(0.0, ge=-360, le=360).means("From +x to it [degrees]; {range}. Default: {default}.")


@dataclass(frozen=True)
class RailGeometry(Geometry):
    """The frame moves along one line, at an angle to x."""

    cos: Any
    sin: Any

    def levers(self, m: Motion, p: Parameters) -> Levers:
        """Of one acceleration."""
        along, outward = m.cos * self.sin - m.sin * self.cos, m.cos * self.cos + m.sin * self.sin
        return p.rotor.carry(m, Levers(along[None, :], outward[None, :], p.frame.whole))

    def imbalance(self, m: Motion, p: Parameters) -> tuple[Any, Any]:
        """Its part along the rail."""
        place = m.turn + p.imbalance_angle
        towards = self.cos * m.xp.cos(place) + self.sin * m.xp.sin(place)
        across = self.sin * m.xp.cos(place) - self.cos * m.xp.sin(place)
        force = np.array([p.imbalance * (m.speed * m.speed * towards)])
        return p.rotor.unbalanced(m, force, None, lambda: np.array([p.imbalance * across]), lambda: 0.0)


@dataclass(frozen=True)
class Rail(Support):
    """A rotor of a mass [kg] that slides along one line at an angle [rad], on a spring and a damper."""

    mass: float
    stiffness: float
    damping: float
    angle: float
    names: tuple[str, ...] = ("way",)

    kind, about = "rail", "a line along which the rotor slides, [scene.rail]"
    needs = ("mass_kg", "rail")
    keys = {"rail": OnRail}  # noqa: RUF012

    @classmethod
    def of(cls, scene: Any) -> "Rail":
        rail: OnRail = scene.rail
        return cls(scene.mass_kg, rail.stiffness, rail.damping, rail.angle)

    def started(self, scene: Any) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """At the place of the rail that is next to where the file says."""
        along, start = self.unit[:, 0], scene.initial
        return (float(along @ (start.x, start.y)),), (float(along @ (start.vx, start.vy)),)

    @property
    def unit(self) -> Any:
        """2 × 1."""
        return np.array([[math.cos(self.angle)], [math.sin(self.angle)]])

    def frame(self, balls: Balls) -> Frame:
        mass = np.array([[self.mass]])
        return Frame(mass, np.array([[-self.stiffness, -self.damping]]), whole=mass + balls.masses.sum())

    def geometry(self, unbalance: Unbalance) -> Geometry:
        return RailGeometry(math.cos(self.angle), math.sin(self.angle))

    @property
    def felt_mass(self) -> float:
        return self.mass

    def shares(self, races: Sequence[Race]) -> list[float]:
        return [1.0]

    def small_motion(self, speed: float) -> SmallMotion:
        return SmallMotion(np.array([[self.mass]]), np.array([[self.damping]]), np.array([[self.stiffness]]), self.unit)

    def holding(self, balls: Balls) -> Self:
        return replace(self, mass=self.mass + float(balls.masses.sum()))

    def resonances(self, balls: Balls) -> list[float]:
        return [math.sqrt(self.stiffness / self.holding(balls).mass)]

    def resting_position(self, force: tuple[float, float] = (0.0, 0.0)) -> tuple[float, ...]:
        return (float(self.unit[:, 0] @ force) / self.stiffness,)

    def axis(self, q: Any, plane: float = 0.0) -> Any:
        return self.unit @ q

    def axis_velocity(self, q: Any, rates: Any) -> Any:
        return self.unit @ rates

    @property
    def description(self) -> str:
        return "Rotor on a rail"

    def model(self) -> dict[str, Any]:
        return {"mass_kg": self.mass, "angle_rad": self.angle}
