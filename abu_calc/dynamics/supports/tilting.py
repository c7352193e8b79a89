"""A rigid rotor on bearings, which moves in its plane and tilts, with gyroscopic moments."""

from collections.abc import Sequence
from typing import Annotated, Any, ClassVar, Final, Self, final

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from abu_calc.dynamics.motion import AnyArray, Axial, Leaning, Levers, Motion
from abu_calc.dynamics.rotor import LARGEST, Geometry, Parameters, Race
from abu_calc.dynamics.support import Unbalance
from abu_calc.dynamics.supports.planar import (
    DAMPING,
    MASS,
    STIFFNESS,
    DampingPair,
    LinearGeometry,
    LinearSupport,
    Pair,
    StiffnessPair,
    rows,
)
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range
from abu_calc.inputs.reading.table import Many, Table, entry, problem

Position = Annotated[float, Field(ge=-1e5, le=1e5)]

PER_BEARING: Final = ("bearing_stiffness_N_per_m", "bearing_damping_N_s_per_m")


class CoupleImbalance(Table):
    """Couple imbalance: the polar principal axis of inertia leans against the axis of rotation."""

    magnitude_rad: float = entry(ge=0, le=0.1, usual=(1e-7, 5e-3), example=6.8e-5).means(
        "Angle between the polar principal axis and the axis of rotation [rad]; {range}."
    )
    angle_deg: float = entry(0.0, ge=-360, le=360).means(
        "Angle to which the +z end of the principal axis leans, from the zero mark [degrees]; {range}. Default: "
        "{default}."
    )


class Tilting(Table):
    """A rigid rotor on bearings, which moves in its plane and tilts: support = "tilting"."""

    transverse_inertia_kg_m2: float = entry(gt=0, le=1e9, example=0.0138).means(
        "Moment of inertia about an axis across the spindle through the centre of mass, without balls [kg·m²]; {range}."
    )
    polar_inertia_kg_m2: float = entry(ge=0, le=1e9, example=0.00124).means(
        "Moment of inertia of what rotates about the spindle, without balls [kg·m²]; {range}, at most twice the "
        "transverse one."
    )
    bearing_positions_mm: Many[Position] = entry(example=[110.0, -150.0], min_length=1, max_length=20).means(
        "Places of the bearings along +z, from the centre of mass [mm]; {range}, one or more."
    )
    bearing_stiffness_N_per_m: Many[StiffnessPair] = entry(
        example=[[21500.0, 15800.0], [21500.0, 15800.0]], max_length=20
    ).means("Stiffness of each bearing along x and y [N/m]; {range}.")
    bearing_damping_N_s_per_m: Many[DampingPair] = entry(example=[[5.375, 3.95], [5.375, 3.95]], max_length=20).means(
        "Damping of each bearing along x and y [N·s/m]; {range}."
    )
    couple_imbalance_angle: CoupleImbalance | None = None
    ball_tilt_inertia: bool = entry(True).means(
        "Whether balls move axially with the race as it tilts: true or false. Default: {default}."
    )

    @model_validator(mode="after")
    def _numbers_for_each_bearing(self) -> Self:
        bearings = len(self.bearing_positions_mm)
        for key in PER_BEARING:
            given = len(getattr(self, key))
            if given != bearings:
                raise problem(
                    "one pair [x, y] for each bearing of bearing_positions_mm",
                    key,
                    found=f"{given} of them",
                    allowed=f"{bearings}",
                )
        return self

    @model_validator(mode="after")
    def _inertia_of_a_body(self) -> Self:
        if self.polar_inertia_kg_m2 > 2 * self.transverse_inertia_kg_m2:
            raise problem(
                "no body has such moments of inertia",
                "polar_inertia_kg_m2",
                found=f"{self.polar_inertia_kg_m2:g} kg·m²",
                allowed=f"at most twice transverse_inertia_kg_m2, {2 * self.transverse_inertia_kg_m2:g} kg·m²",
            )
        return self

    @property
    def couple(self) -> tuple[float, float]:
        """χ(J_t − J_p) [kg m²] and where it points [rad]."""
        lean = self.couple_imbalance_angle
        if lean is None:
            return 0.0, 0.0
        return lean.magnitude * (self.transverse_inertia - self.polar_inertia), lean.angle


@final
@dataclass(frozen=True)
class TiltingGeometry(LinearGeometry):
    """A = (x'', y'', Θ''). `tilt_map` (4 × 2N): the tilts and their rates, where balls move axially with them."""

    tilt_map: AnyArray | None

    def levers(self, m: Motion, p: Parameters) -> Levers:
        """T = (e_t, z e_t), N = (e_r, z e_r); along the spindle a ball moves by −R_p Θ·e_r."""
        plane: AnyArray = np.array(((m.cos, m.sin), (-m.sin, m.cos)))
        outward, along = np.concatenate([plane, p.places * plane], axis=1)
        levers = Levers(along, outward, p.frame.whole)
        leaning = None if self.tilt_map is None else self._lean(m, p, self.tilt_map, levers)
        return p.rotor.carry(m, levers, leaning)

    def _lean(self, m: Motion, p: Parameters, tilt_map: AnyArray, levers: Levers) -> AnyArray:
        """−R_p Θ·e_r along the spindle, its rate −R_p (Θ'·e_r + γ' Θ·e_t), and so on; R_p even off a groove's middle.

        A race that leans is narrower, seen along the spindle: R_p² less the square of that way. So what goes round with
        it flies outward a little less, which makes up for the pull the way along the spindle would have by itself.
        Returns the way along the spindle per turn.
        """
        tx, ty, vx, vy = tilt_map.dot(m.support)
        zero = 0.0 * m.cos
        swept: AnyArray = p.radii * (tx * m.sin - ty * m.cos)
        carried = 2 * p.radii * m.swing * (vx * m.sin - vy * m.cos)
        height = -p.radii * (tx * m.cos + ty * m.sin)
        rise = swept * m.swing - p.radii * (vx * m.cos + vy * m.sin)
        lever = np.array([zero, zero, -p.radii * m.cos, -p.radii * m.sin])
        levers.axial, levers.leaning = Axial(lever, carried, swept / m.radii), Leaning(height, rise)
        levers.sunk, levers.sinking = height * height, 2 * m.swing * height * rise
        return swept

    def plane(self, z: Any) -> AnyArray:
        """x + z θ_y and y − z θ_x."""
        displacements: AnyArray = self.race_map[:2] + z * self.race_map[2:]
        return displacements

    def forces(self, x: Any, y: Any, z: Any) -> list[Any]:
        """Forces with their moments about the centre of mass."""
        return [x, y, z * x, z * y]


@final
@dataclass(frozen=True)
class TiltingSupport(LinearSupport):
    """A linear support whose frame has the rows x, y of the centre of mass and the tilts θ_y, −θ_x.

    A race at z moves by (x + z θ_y, y − z θ_x). `axial_inertia`: the balls move axially with a race that tilts.
    """

    couples: ClassVar[bool] = True
    kind, about = "tilting", "a rigid rotor on bearings, [scene.tilting]"
    needs = ("mass_kg", "tilting")
    keys = {"tilting": Tilting}  # noqa: RUF012

    axial_inertia: bool = False
    bearings: tuple[float, ...] = ()

    @classmethod
    def of(cls, scene: Any) -> "TiltingSupport":
        """Support on the bearings of the file."""
        own: Tilting = scene.tilting
        bearings = own.bearing_positions, own.bearing_stiffness, own.bearing_damping
        return tilting(
            scene.mass_kg, own.transverse_inertia, own.polar_inertia, *bearings, axial_inertia=own.ball_tilt_inertia
        )

    def geometry(self, unbalance: Unbalance) -> Geometry:
        """Geometry in planes that tilt."""
        P = np.array(self.race_map)
        return TiltingGeometry(P, *self.turning(unbalance), np.kron(np.eye(2), P[2:]) if self.axial_inertia else None)

    def shares(self, races: Sequence[Race]) -> list[float]:
        """The most of axis, races, and balls along the spindle."""
        P = np.array(self.race_map)
        moved = [np.hypot(*P[:2]), *(np.hypot(*(P[:2] + race.plane_offset * P[2:])) for race in races)]
        moved.append(np.hypot(*P[2:]) * max((race.pitch_radius for race in races), default=0.0))
        return [float(value) for value in np.max(moved, axis=0)]

    def plane(self, z: float) -> NDArray[np.float64]:
        """x and y there."""
        return self._at(z)

    def tilt(self, q: NDArray[np.float64]) -> tuple[float, float] | None:
        """θ_y, −θ_x."""
        x, y = (np.array(self.race_map)[2:] @ q).tolist()
        return x, y

    def _at(self, plane: float) -> NDArray[np.float64]:
        P = np.array(self.race_map)
        return np.asarray(P[:2] + plane * P[2:], dtype=float)

    @property
    def description(self) -> str:
        """Description of the support."""
        return "Rigid rotor that moves in its plane and tilts"


def tilting(
    mass: float,
    transverse_inertia: float,
    polar_inertia: float,
    positions: Sequence[float],
    stiffness: Sequence[Pair],
    damping: Sequence[Pair],
    axial_inertia: bool = True,
) -> TiltingSupport:
    """m r'' = F, J_t Θ'' − i J_p Ω Θ' = moment, Θ = θ_y − iθ_x, on bearings at z [m] with r_z = r + z Θ.

    Coordinates x, y, θ_y, −θ_x: tilts small, so that a place at z moves by z Θ. Mass [kg], inertias without balls
    [kg m²], stiffness [N/m] and damping [N·s/m] of each bearing along x and y. `axial_inertia`: balls move along the
    spindle as their race tilts. Raises RangeError where no body has such inertias. Source: Genta 2005, Dynamics of
    Rotating Systems, 2.5 (rigid rotor, four freedoms).

    >>> tilting(1.0, 0.02, 0.01, (0.1,), ((100.0, 200.0),), ((0.0, 0.0),)).stiffness[0]
    (100.0, 0.0, 10.0, 0.0)
    """
    Range("transverse inertia", 0, LARGEST, "kg m²", open_low=True).check(transverse_inertia)
    # That of a flat disc is the largest there is.
    J = Range("polar inertia", 0, 2 * transverse_inertia, "kg m²").check(polar_inertia)
    for limit, pairs in ((STIFFNESS, stiffness), (DAMPING, damping)):
        for value in (value for pair in pairs for value in pair):
            limit.check(value)
    return TiltingSupport(
        mass=rows(np.diag((MASS.check(mass), mass, transverse_inertia, transverse_inertia))),
        damping=rows(_of_bearings(positions, damping)),
        stiffness=rows(_of_bearings(positions, stiffness)),
        gyroscopic=rows(np.kron(np.diag((0.0, 1.0)), np.array(((0.0, J), (-J, 0.0))))) if J else (),
        race_map=rows(np.eye(4)),
        names=("x", "y", "tilt_x", "tilt_y"),
        axial_inertia=axial_inertia,
        bearings=tuple(positions),
    )


def _of_bearings(positions: Sequence[float], values: Sequence[Pair]) -> AnyArray:
    """Σ over bearings of what acts against the motion of its place, in the four coordinates."""
    pairs = zip(positions, values, strict=True)
    total: AnyArray = sum(
        (np.kron(np.array(((1, z), (z, z * z))), np.diag(pair)) for z, pair in pairs), np.zeros((4, 4))
    )
    return total
