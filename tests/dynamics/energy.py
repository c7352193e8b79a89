"""Mass matrix, energy and power of a scene: the Lagrangian side of the equations, which holds them to account.

It starts from the places of the balls in space; nothing here is used by `equations`, so a sign lost on either side
breaks the symmetry, Lagrange's equations or the balance of energy. Coordinates x = (q, θ, [w], turn): support, balls
along the race, balls across it where they have that freedom, the rotor's turn, which on a swing arm is counted from the
arm and is a freedom only where a motor drives. Their rates are v. With the places r_k(x) of the balls

    T = ½ q'ᵀ M q' + ½ Σ m |r_k'|² + ½ Σ (J − 1) m [(r Ω − R θ')² + w'² + ν²]
        + m₀e c'·u' + χ(J_t − J_p) Θ'·u' + ½ J_r Ω²

Ω the rotor's speed in space, c' that of its centre, u the direction of the imbalance or of the couple. The third term
is a rolling ball's spin, which for θ' = 0 is the rotor's own (Kladiev 1996, eq. (12), has the same 7/5); r⁻¹ν is that
about the contact's normal, a speed without a coordinate. Balls that roll two ways obey no Lagrange's equations, since
they may not slip, but keep the energy; points (J = 1) obey both.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from abu_calc.dynamics.equations.assemble import STEP, assemble
from abu_calc.dynamics.equations.right_hand_side import accelerations, motion_of, with_states
from abu_calc.dynamics.motion import AnyArray
from abu_calc.dynamics.rotor import GUIDED, Acting, Modes
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport

ACROSS = "transverse_motion"
"""The effect whose states are the balls' ways across the race and their rates."""


def mass_matrix(scene: Scene, t: Any, y: AnyArray) -> AnyArray:
    """The symmetric, positive definite M of T = ½ vᵀ M v in the coordinates that are free [kg, kg m, kg m²]."""
    bodies = Bodies(scene)
    x, _ = bodies.split(t, y)
    return bodies.mass(x)[: bodies.freedoms, : bodies.freedoms]


def energy(scene: Scene, t: Any, y: AnyArray, modes: Modes | None = None) -> Any:
    """E = T + V [J]: springs, the arm's constant moment, and the energy of the effects."""
    bodies = Bodies(scene)
    x, v = bodies.split(t, y)
    spin = bodies.spinning(y)
    kinetic = v @ bodies.mass(x) @ v / 2 + (bodies.rolling * spin) @ spin / 2
    return kinetic + _potential(bodies, x, v, _acting(scene, modes))


def power(scene: Scene, t: float, y: AnyArray, modes: Modes | None = None) -> float:
    """dE/dt [W] by all that is not conservative: dampers, drag, effects, and the drive that keeps the rotor's speed."""
    acting = _acting(scene, modes)
    p = acting.parameters
    _, v = Bodies(scene).split(t, y)
    motion, _, solved = accelerations(np, t, y, acting)
    total = resisting(scene, t, y) @ v
    total += sum(effect.power(motion, mode, own, solved, p) for effect, mode, own in with_states(y, acting))
    if not scene.rotor.rows:
        total += demanded(scene, t, y, modes, slice(-1, None))[0] * v[-1]
    return float(total)


def resisting(scene: Scene, t: float, y: AnyArray) -> AnyArray:
    """Forces of the support's dampers, of the gyroscopic moments and of the drag, in all coordinates.

    The drag's torque is that between ball and race, so it stands in the row of θ alone.
    """
    bodies, support = Bodies(scene), scene.support
    _, v = bodies.split(t, y)
    first, last = bodies.size, bodies.size + bodies.balls
    force = np.zeros(len(v))
    if isinstance(support, SwingArmSupport):
        force[0] = -support.damping * support.length**2 * v[0]
    else:
        spinning = np.array(support.gyroscopic) * v[-1] if support.gyroscopic else 0.0
        force[:first] = -(np.array(support.damping) + spinning) @ v[:first]
    radii, drag = _each(scene, "pitch_radius"), _each(scene, "drag")
    force[first:last] = -np.array(scene.ball_masses) * radii**2 * drag * v[first:last]
    return force


def demanded(scene: Scene, t: float, y: AnyArray, modes: Modes | None = None, rows: slice = slice(None)) -> AnyArray:
    """d/dt ∂L/∂v − ∂L/∂x, L = T − V, with the accelerations of `equations`: what forces of no energy must supply.

    In all coordinates, the turn's included, whoever drives it, or in some rows alone. Derivatives by the complex step,
    exact to rounding.
    """
    bodies, acting = Bodies(scene), _acting(scene, modes)
    x, v = bodies.split(t, y)
    motion, _, solved = accelerations(np, t, y, acting)
    across = [solved.across] if bodies.across else []
    a = np.concatenate([solved.support, solved.balls / motion.radii, *across, [solved.rotor]])
    moved, sped = x + 1j * STEP * v, v + 1j * STEP * a
    slope = []
    for j in range(len(x))[rows]:
        aside = x.astype(complex)
        aside[j] += 1j * STEP
        L = v @ bodies.mass(aside) @ v / 2 - _potential(bodies, aside, v, acting)
        slope.append(L.imag / STEP)
    found: AnyArray = (bodies.mass(moved) @ sped).imag[rows] / STEP - np.array(slope)
    return found


@dataclass(frozen=True)
class Bodies:
    """What of a scene has inertia, where it is and how it moves with the coordinates."""

    scene: Scene

    @property
    def size(self) -> int:
        """Coordinates of the support."""
        return len(self.scene.support.names)

    @property
    def balls(self) -> int:
        """How many balls."""
        return len(self.scene.ball_masses)

    @property
    def arm(self) -> SwingArmSupport | None:
        """The support if it is a swing arm."""
        return self.scene.support if isinstance(self.scene.support, SwingArmSupport) else None

    @property
    def groove(self) -> Any:
        """What lets balls move across the race, None without."""
        return self.scene.effect(ACROSS)

    @property
    def across(self) -> bool:
        """Whether balls move across the race."""
        return self.groove is not None

    @property
    def rolling(self) -> AnyArray:
        """(J − 1) m of each ball."""
        masses: AnyArray = np.array(self.scene.ball_masses) * (_each(self.scene, "inertia_factor") - 1)
        return masses

    @property
    def freedoms(self) -> int:
        """How many of the coordinates are free."""
        return self.size + self.balls * (1 + self.across) + self.scene.rotor.rows

    def split(self, t: Any, y: AnyArray) -> tuple[AnyArray, AnyArray]:
        """x and v of a state."""
        q, q_rate, theta, rate, w, w_rate, _, turn = self._cut(y)
        if not len(turn):
            turn = np.array([self.scene.speed * t, self.scene.speed])
        return np.concatenate([q, theta, w, turn[:1]]), np.concatenate([q_rate, rate, w_rate, turn[1:]])

    def spinning(self, y: AnyArray) -> AnyArray:
        """ν of each ball [m/s]."""
        spin = self._cut(y)[6]
        return spin if len(spin) else np.zeros(self.balls)

    def _cut(self, y: AnyArray) -> list[AnyArray]:
        """q, q', θ, θ', w, w', ν, (turn, speed); empty what there is not."""
        free_spin = self.across and self.groove.free_spin
        counts = [self.size] * 2 + [self.balls] * 2 + [self.balls * self.across] * 2 + [self.balls * free_spin]
        return np.split(y, np.cumsum(counts))

    def parts(self, x: AnyArray) -> list[AnyArray]:
        """q, θ, w (empty without), turn."""
        return np.split(x, np.cumsum([self.size, self.balls, self.balls * self.across]))

    def turned(self, x: AnyArray) -> Any:
        """The rotor's turn in space."""
        return x[-1] + x[0] if self.arm else x[-1]

    def centre(self, x: AnyArray) -> AnyArray:
        """Where the axis of the rotor is."""
        if self.arm:
            return self.arm.length * _direction(x[0])
        return np.array(self.scene.support.race_map[:2]) @ x[: self.size]  # type: ignore[union-attr]

    def radii(self, x: AnyArray) -> AnyArray:
        """R of each ball, less than R_p where it is off the middle of its groove."""
        w = self.parts(x)[2]
        middle = _each(self.scene, "pitch_radius")
        nearer: AnyArray = w * w / (2 * self.groove.bend) if self.across else 0.0 * middle
        return middle - nearer

    def tilts(self, x: AnyArray) -> AnyArray:
        """How the spindle leans toward x and y: Θ."""
        rows = () if self.arm else self.scene.support.race_map[2:]  # type: ignore[union-attr]
        return np.array(rows) @ x[: self.size] if rows else np.zeros(2)

    def sunk(self, x: AnyArray) -> AnyArray:
        """By how much R² of each ball is less, seen along the spindle, since its race leans."""
        _, theta, w, _ = self.parts(x)
        way = _each(self.scene, "pitch_radius") * (self.tilts(x) @ _direction(theta + self.turned(x)))
        narrower: AnyArray = way * way - (2 * w * way if self.across else 0.0)
        return narrower

    def places(self, x: AnyArray) -> AnyArray:
        """r_k: x, y and along the spindle, of each ball (3 × n)."""
        _, theta, w, _ = self.parts(x)
        turn, tilts = self.turned(x), self.tilts(x)
        outward = _direction(theta + turn)
        plane = self.centre(x)[:, None] + tilts[:, None] * _each(self.scene, "plane_offset") + self.radii(x) * outward
        aside: Any = self.scene.effect("race_eccentricity")
        if aside:
            plane = plane + aside.magnitude * _direction(turn + aside.angle)[:, None]
        axial = w + self.groove.axial_runout * np.cos(turn) if self.across else 0.0 * theta
        if getattr(self.scene.support, "axial_inertia", False):
            axial = axial - _each(self.scene, "pitch_radius") * (tilts @ outward)
        return np.vstack([plane, axial])

    def mass(self, x: AnyArray) -> AnyArray:
        """The symmetric matrix of the kinetic energy in all coordinates."""
        scene, masses = self.scene, np.array(self.scene.ball_masses)
        inertia = sum(effect.rotor_inertia for effect in scene.effects)
        turning, ways = self._turning, self._slope(self.places, x)
        along = np.pad(np.diag(self.radii(x)), ((0, 0), (self.size, len(x) - self.size - self.balls)))
        spins = np.outer(_each(scene, "ball_radius"), turning) - along
        matrix: AnyArray = np.einsum("akx,k,aky->xy", ways, masses, ways)
        matrix = matrix + np.einsum("kx,k,ky->xy", spins, self.rolling, spins)
        if getattr(scene.support, "axial_inertia", False):
            going = np.pad(np.eye(self.balls), ((0, 0), (self.size, len(x) - self.size - self.balls))) + turning
            matrix = matrix - np.einsum("kx,k,ky->xy", going, masses * self.sunk(x), going)
        if self.across:
            w = slice(self.size + self.balls, -1)
            matrix[w, w] += np.diag(self.rolling)
        # The arm's own inertia counts the rotor's.
        own = np.array([[self.arm.inertia - inertia]]) if self.arm else np.array(scene.support.mass)  # type: ignore[union-attr]
        matrix[: self.size, : self.size] += own
        matrix += inertia * np.outer(turning, turning)
        matrix += scene.imbalance * self._leaning(x, self.centre, scene.imbalance_angle)
        matrix += scene.couple * self._leaning(x, self.tilts, scene.couple_angle)
        return matrix

    @property
    def _turning(self) -> AnyArray:
        """The rotor's speed in space per unit of each rate."""
        row = np.zeros(self.size + self.balls * (1 + self.across) + 1)
        row[-1] = 1.0
        row[0] = 1.0 if self.arm else 0.0
        return row

    def _leaning(self, x: AnyArray, place: Callable[[AnyArray], AnyArray], angle: float) -> AnyArray:
        """Matrix of place'·u', u the direction at `angle` in the rotor."""
        moved = self._slope(place, x)
        turned = self._slope(lambda z: _direction(self.turned(z) + angle), x)
        coupling: AnyArray = moved.T @ turned
        return coupling + coupling.T

    def _slope(self, place: Callable[[AnyArray], AnyArray], x: AnyArray) -> AnyArray:
        """∂place/∂x, last axis x.

        Places are linear in lengths and tilts, or quadratic across the groove, and first harmonics of angles: of all of
        these a difference over a long step is the derivative itself, of sin over ±π/2 as of a parabola over ±1.
        """
        steps = np.full(len(x), math.pi / 2)
        steps[: 0 if self.arm else self.size] = 1.0
        steps[self.size + self.balls : -1] = 1.0
        return np.stack([(place(x + step) - place(x - step)) / 2 for step in np.diag(steps)], axis=-1)


def _potential(bodies: Bodies, x: AnyArray, v: AnyArray, acting: Acting) -> Any:
    """V [J] of springs and effects."""
    arm, q = bodies.arm, x[: bodies.size]
    K = np.array([[arm.stiffness * arm.length**2]]) if arm else np.array(bodies.scene.support.stiffness)
    own = q @ K @ q / 2 - (arm.torque * q[0] if arm else 0.0)
    (q, theta, w, turn), (q_rate, rate, w_rate, speed) = bodies.parts(x), bodies.parts(v)
    spin = np.zeros(bodies.balls * (bodies.across and bodies.groove.free_spin))
    # Whoever turns the rotor: its turn is told here, so that energies can be asked for at any.
    p = replace(acting.parameters, rotor=GUIDED)
    y = np.concatenate([q, q_rate, theta, rate, w, w_rate, spin, turn, speed])
    motion, parts = motion_of(np, 0.0, y, p), with_states(y, acting)
    for effect, mode, states in parts:
        effect.move(motion, mode, states)
    return own + sum(effect.energy(motion, states, p) for effect, _, states in parts)


def _acting(scene: Scene, modes: Modes | None) -> Acting:
    """The numbers of a scene in these modes, those of the start by default."""
    equations = assemble(scene)
    return equations.acting if modes is None else equations.in_mode(modes)


def _each(scene: Scene, name: str) -> AnyArray:
    """A number of the races, for each ball."""
    return np.array([getattr(race, name) for race in scene.races for _ in race.ball_masses], dtype=float)


def _direction(angle: Any) -> AnyArray:
    """(cos, sin)."""
    return np.array((np.cos(angle), np.sin(angle)))
