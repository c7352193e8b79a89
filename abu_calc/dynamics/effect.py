"""Interface of an effect: one thing that acts in a scene besides the support, the races and the imbalance.

Effects are in `effects/`, one file each; `effects/__init__.py` tells how they go together.
"""

from functools import cached_property
from typing import Annotated, Any, ClassVar, Final, Literal, Protocol, Self, get_args

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from abu_calc.dynamics.motion import AnyArray, Levers, Loads, Motion, Solved
from abu_calc.dynamics.rotor import STEADY, Acting, Modes, Parameters, Rotation
from abu_calc.dynamics.support import Circumstances, Holding
from abu_calc.dynamics.trajectory import Samples
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.reading.table import Table

Kind = Literal["conservative", "dissipative", "driven"]

Stage = Literal["rotor", "races", "across", "forces", "impacts", "friction"]
STAGES: Final = get_args(Stage)
"""Order in which the effects of a scene act.

First what turns the rotor, then what moves the races, then what opens the direction across them, then forces, last what
decides by all forces.
"""

BallRadius = Annotated[
    float, Field(description="Radius of a ball [mm]; {range}, the same in all effects.", examples=[8.0], gt=0, le=1000)
]

ACROSS = "across"
"""Name of the state of each ball that is its place across the race [m], of whichever effect lets it move there."""

ACROSS_RATE = "across'"
"""Name of the state of each ball that is its speed across the race, of whichever effect lets it move there."""


@dataclass(frozen=True)
class EffectInfluence:
    """Estimated influence of an effect: the change if it is left out.

    It is measured as accuracy measures errors; None without a cheap estimate.
    """

    value: float | None
    why: str


@dataclass(frozen=True)
class Rule:
    """Rule by which compiled code decides an effect's next mode, and its numbers.

    It applies when a watched number of the effect falls. dry friction: the mode is a `Rolling`. ball
    contact: a `Neighbours`, its pairs rebounding by `restitution`. one-sided contact: 1.0 or 0.0, the other
    when its one watched number falls.
    """

    name: Literal["dry friction", "ball contact", "one-sided contact"]
    restitution: float = 0.0


class Laws(Protocol):
    """The equations of a scene, as far as effects may ask them."""

    @property
    def scene(self) -> Circumstances:
        """Scene of the equations."""

    @property
    def parameters(self) -> Parameters:
        """Numbers that the equations read."""

    @property
    def first_modes(self) -> Modes:
        """The modes of all effects before they are settled."""

    @property
    def scales(self) -> tuple[float, ...]:
        """Size that counts as a whole unit of each state."""

    def accelerations(self, xp: Any, t: Any, y: Any, acting: Acting) -> tuple[Motion, Loads, Solved]:
        """Kinematics, loads and all accelerations at one time."""

    def in_mode(self, modes: Modes) -> Acting:
        """The numbers while the effects act in these modes."""


@dataclass(frozen=True)
class SwitchPoint:
    """A state at which modes are decided, and the effect that decides: `index` is its place among the effects."""

    equations: Laws
    t: float
    y: NDArray[np.float64]
    modes: Modes
    index: int

    @property
    def mode(self) -> Any:
        """The mode of the effect that decides."""
        return self.modes[self.index]

    @property
    def parameters(self) -> Parameters:
        """The numbers."""
        return self.equations.parameters

    @cached_property
    def acting(self) -> Acting:
        """The numbers in these modes."""
        return self.equations.in_mode(self.modes)

    @property
    def own(self) -> Any:
        """The states of the effect that decides; None where it has none."""
        p, effect = self.parameters, self.parameters.effects[self.index]
        before = sum(len(earlier.ball_states) for earlier in p.effects[: self.index])
        place, count = 2 * (p.size + p.balls) + before * p.balls, len(effect.ball_states) * p.balls
        return self.y[place : place + count] if count else None

    def solved(self, mode: Any) -> tuple[Motion, Loads, Solved]:
        """The accelerations if its mode were another."""
        modes = (*self.modes[: self.index], mode, *self.modes[self.index + 1 :])
        return self.equations.accelerations(np, self.t, self.y, self.equations.in_mode(modes))


@dataclass(frozen=True)
class Effect:
    """One effect. Its fields are its numbers in SI; subclasses are final and say what they add.

    `keys` declares them for scene files: unit, range, default and meaning, each under the name of its field.

    It reads the shared kinematics, the circumstances and its own numbers, never another effect. `act` and `rates` use
    plain arithmetic and m.xp.sin, m.xp.cos alone, so that they serve real, complex and symbolic numbers.
    """

    name: ClassVar[str]
    kind: ClassVar[Kind]
    about: ClassVar[str]
    """Description of the effect in one line, shown where people choose effects."""
    detail: ClassVar[str] = ""
    """Further text of `abu explain NAME`, if any."""
    keys: ClassVar[type[Table] | None] = None
    """Its table in a scene file, `scene.effects.NAME`; None: it comes with another `table`."""
    table: ClassVar[str] = ""
    """The table of a scene file that it comes with, if that is not its own."""
    stage: ClassVar[Stage] = "forces"
    """Its place in the order of a scene."""
    ball_states: ClassVar[tuple[str, ...]] = ()
    """Names of the states it adds for each ball."""
    switches: ClassVar[bool] = False
    """True if the effect has modes that the state may end."""
    traceable: ClassVar[bool] = True
    """True if the effect can be traced.

    It then uses no function but sin and cos, and no decision by values that are not its own numbers.
    """
    averaged: ClassVar[bool] = False
    """True if the averaged slow motion includes the effect.

    The motion accounts for it by `offset`, by `falling`, or since it averages out.
    """
    whole_run: ClassVar[bool] = False
    """True if its remarks need samples of the whole run at once; a long run gives some of them."""
    balls_meet: ClassVar[bool] = False
    """True if the effect gives balls a size, so that they cannot pass each other."""

    @classmethod
    def of(cls, table: Any) -> Self:
        """The effect of its table in a file; what that leaves open, or has no part in it, has its default here."""
        return cls(**table.in_si())

    # Properties others ask an effect for, so that nobody needs to ask which effect it is.

    @property
    def rotor(self) -> Rotation:
        """Way of turning that the effect requires of the rotor; the most that any effect requires counts."""
        return STEADY

    @property
    def rotor_inertia(self) -> float:
        """Inertia that the effect adds to a driven rotor [kg m²]."""
        return 0.0

    @property
    def from_rest(self) -> bool:
        """True if the effect makes the rotor start from rest."""
        return False

    @property
    def run_down(self) -> float:
        """Time [s] at the end of the scene in which it lets nothing drive the rotor."""
        return 0.0

    @property
    def least_duration(self) -> float:
        """Least duration of a scene with the effect [s]."""
        return 0.0

    @property
    def at_speed(self) -> float:
        """Time at which the rotor is at full speed for good [s]."""
        return 0.0

    @property
    def offset(self) -> complex:
        """Offset of the races' centres from the axis by the effect, x + iy in the rotor [m]."""
        return 0j

    @property
    def falling(self) -> float:
        """Constant acceleration in space toward −y that it gives the balls [m/s²]."""
        return 0.0

    def holding(self, scene: Circumstances) -> Holding | None:
        """Dry friction with which it can hold balls in their places."""
        return None

    def placed(self, scene: Circumstances) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Position and velocity with which the support has to start."""
        return scene.start_position, scene.start_velocity

    def check(self, scene: Circumstances) -> None:
        """Raise InputError if the effect cannot act in these circumstances, on their support for instance."""

    # Motion.

    def move(self, m: Motion, mode: Any, own: Any) -> None:
        """Change the kinematics, before the levers are known."""

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """Add what it does to levers and loads."""

    def rates(self, m: Motion, own: Any, solved: Solved) -> AnyArray:
        """Time derivatives of its own states."""
        raise NotImplementedError

    def start(self, scene: Circumstances) -> tuple[float, ...]:
        """States of the effect at t = 0."""
        return ()

    def scales(self, scene: Circumstances) -> tuple[float, ...]:
        """Size that counts as a whole unit of each of the effect's own states."""
        return ()

    # Modes.

    def switching(self, scene: Circumstances) -> bool:
        """True if the effect has modes that the state may end, in this scene."""
        return self.switches

    def first_mode(self, scene: Circumstances) -> Any:
        """Mode at first, before the modes of all effects are settled; None if there is only one way to act."""
        return None

    def breaks(self, scene: Circumstances) -> tuple[float, ...]:
        """Times [s] from which it acts in another way, whatever the state."""
        return ()

    def mode_at(self, scene: Circumstances, t: float, mode: Any) -> Any:
        """Mode of the effect from t on, at t = 0 or at one of its breaks."""
        return mode

    def settle(self, at: SwitchPoint) -> tuple[Any, Any]:
        """State and mode with which it can go on; the very same objects where nothing changes."""
        return at.y, at.mode

    def watch(self, m: Motion, mode: Any, own: Any, loads: Loads, solved: Solved, p: Parameters) -> list[Any]:
        """Numbers that stay at or above zero as long as its mode holds; an event is one of them falling below.

        Without units: they are usually near 1.
        """
        return []

    def rule(self, mode: Any) -> Rule | None:
        """Rule by which compiled code finds the mode after one like this; None if only `settle` can find it."""
        return None

    def criteria(self, m: Motion, mode: Any, own: Any, loads: Loads, solved: Solved, p: Parameters) -> list[Any]:
        """Further numbers by which that rule chooses."""
        return []

    # What it means.

    def energy(self, m: Motion, own: Any, p: Parameters) -> Any:
        """Potential energy [J] of a conservative effect."""
        return 0.0

    def power(self, m: Motion, mode: Any, own: Any, solved: Solved, p: Parameters) -> Any:
        """Power [W] it puts in, by the coordinates' own motion; negative where it takes out."""
        return 0.0

    def remarks(self, equations: Laws, samples: Samples) -> tuple[str, ...]:
        """Remarks on a run that a user should know: that it left the range of the effect, for instance.

        A long run is shown block by block, until there is a remark, unless `whole_run`.
        """
        return ()

    def weight(self, scene: Circumstances) -> EffectInfluence:
        """Estimated influence: the change if the effect is left out."""
        return EffectInfluence(None, "")
