"""What carries a rotor: a linear support of any coordinates, or a swing arm."""

import sys
from dataclasses import dataclass
from typing import ClassVar

from abu_calc.errors import InputError
from abu_calc.validity import Range

Matrix = tuple[tuple[float, ...], ...]

LARGEST = sys.float_info.max
_NON_NEGATIVE = (0.0, LARGEST)


def finite(name: str, values: tuple[float, ...]) -> None:
    """Refuse infinities and NaN."""
    for value in values:
        Range(name, -LARGEST, LARGEST, remedy="give a finite number").check(value)


@dataclass(frozen=True)
class LinearSupport:
    """M q'' + (C + Ω G) q' + K q = Pᵀ F in N coordinates q; the frame P q is what the balls feel, F acts on it.

    The rows of P are x and y of the race centre, all races in one plane; or four, x, y of the centre of mass and the
    tilts θ_y, −θ_x: then a race at z moves by (x + z θ_y, y − z θ_x). The mass M is what moves with the rotor WITHOUT
    balls; it must be symmetric and positive definite, which `equations.assemble` verifies; the gyroscopic matrix G
    (none where empty) is antisymmetric, Ω the speed of the rotor. `axial_inertia`: the balls move axially with a race
    that tilts. Units: coordinates in m (then kg, N·s/m, N/m) unless their name says otherwise.
    """

    mass: Matrix
    damping: Matrix
    stiffness: Matrix
    race_map: Matrix
    names: tuple[str, ...]
    gyroscopic: Matrix = ()
    axial_inertia: bool = False
    bearings: tuple[float, ...] = ()
    """Places of the bearings along the spindle [m], where motion is told too; none on supports that do not tilt."""

    def __post_init__(self) -> None:
        size = len(self.names)
        if len(self.race_map) not in (2, 4):
            raise InputError("race map: must have the rows x, y or x, y and two tilts")
        if self.axial_inertia and len(self.race_map) != 4:
            raise InputError("balls move axially on supports that tilt only")
        for name, matrix, rows in (
            ("support mass", self.mass, size),
            ("support damping", self.damping, size),
            ("support stiffness", self.stiffness, size),
            ("gyroscopic matrix", self.gyroscopic, size if self.gyroscopic else 0),
            ("race map", self.race_map, len(self.race_map)),
        ):
            if len(matrix) != rows or any(len(row) != size for row in matrix):
                raise InputError(f"{name}: must be {rows} × {size}")
            for row in matrix:
                finite(name, row)

    @property
    def tilts(self) -> bool:
        """Whether races stand at different places along the spindle."""
        return len(self.race_map) == 4


@dataclass(frozen=True)
class SwingArm:
    """A rigid arm of length l [m] that turns by φ about its axis, the rotor at its end (Kovalenko 2010, eqs. (1)–(3)).

    J_O φ'' + b l² φ' + c l² φ = moment + what rotor and balls do; J_O [kg m²] without balls, stiffness c [N/m] and
    damping b [N·s/m] of the joint reduced to l. Work that is cut adds its own to the stiffness and to the moment
    [N m]: `supports.swing_arm` says how. At φ = 0 the arm lies along +x; the axis is the rotor's.
    """

    length: float
    inertia: float
    stiffness: float
    damping: float
    moment: float = 0.0
    names: ClassVar[tuple[str, ...]] = ("arm_angle",)
    tilts: ClassVar[bool] = False

    def __post_init__(self) -> None:
        Range("arm length", 0, LARGEST, "m", open_low=True).check(self.length)
        Range("arm inertia", 0, LARGEST, "kg m²", open_low=True).check(self.inertia)
        Range("joint damping", *_NON_NEGATIVE, "N s/m").check(self.damping)
        # The stiffness of work that pushes itself away is negative.
        finite("arm stiffness and moment", (self.stiffness, self.moment))


Support = LinearSupport | SwingArm
