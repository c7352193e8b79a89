"""What an effect is: one thing that acts in a scene beside its support, its races and the imbalance."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Literal

if TYPE_CHECKING:
    from abu_calc.dynamics.equations.assemble import Equations
    from abu_calc.dynamics.equations.parameters import Array, Parameters, Rotor
    from abu_calc.dynamics.motion import Levers, Loads, Motion, Solved
    from abu_calc.dynamics.scene import Scene
    from abu_calc.dynamics.switching.modes import Moment
    from abu_calc.dynamics.trajectory import Trajectory

Kind = Literal["conservative", "dissipative", "driven"]


@dataclass(frozen=True)
class Weight:
    """What leaving an effect out would change, counted as accuracy counts errors; None where nothing cheap tells."""

    value: float | None
    why: str


@dataclass(frozen=True)
class Effect:
    """One effect. Its fields are its numbers in SI; subclasses are final and say what they add.

    It reads the shared kinematics and its own numbers, never what another effect added. `act` and `rates` use plain
    arithmetic and m.xp.sin, m.xp.cos alone, so that they serve real, complex and symbolic numbers.
    """

    name: ClassVar[str]
    kind: ClassVar[Kind]
    about: ClassVar[str]
    """What it is, in a line, where people choose effects."""
    ball_states: ClassVar[tuple[str, ...]] = ()
    """Names of the states it adds for each ball."""
    switches: ClassVar[bool] = False
    """Whether it has modes that the state may end."""
    traceable: ClassVar[bool] = True
    """Whether heyoka can trace it: no function but sin and cos, no decision by values that are not its own numbers."""

    @property
    def rotor(self) -> "Rotor":
        """Whether the rotor's speed is constant, guided or driven."""
        return "steady"

    @property
    def rotor_inertia(self) -> float:
        """What it adds to the inertia of a driven rotor [kg m²]."""
        return 0.0

    def move(self, m: "Motion", mode: Any, own: Any) -> None:
        """Change the kinematics, before the levers are known."""

    def act(self, m: "Motion", mode: Any, own: Any, levers: "Levers", loads: "Loads", p: "Parameters") -> None:
        """Add what it does to levers and loads."""

    def rates(self, m: "Motion", own: Any, solved: "Solved") -> "Array":
        """Time derivatives of its own states."""
        raise NotImplementedError

    def start(self, scene: "Scene") -> tuple[float, ...]:
        """Its own states at t = 0."""
        return ()

    def scales(self, scene: "Scene") -> tuple[float, ...]:
        """What counts as a whole unit of its own states."""
        return ()

    def first_mode(self, scene: "Scene") -> Any:
        """How it acts at first, before the modes of all effects are settled; None where there is one way only."""
        return None

    def breaks(self, scene: "Scene") -> tuple[float, ...]:
        """Moments [s] at which it acts in another way, whatever the state."""
        return ()

    def mode_at(self, scene: "Scene", t: float, mode: Any) -> Any:
        """Its mode from t on, at t = 0 or at one of its breaks."""
        return mode

    def settle(self, moment: "Moment") -> tuple[Any, Any]:
        """State and mode with which it can go on at a moment; the very same objects where nothing changes."""
        return moment.y, moment.mode

    def watch(self, m: "Motion", mode: Any, own: Any, loads: "Loads", solved: "Solved", p: "Parameters") -> list[Any]:
        """Numbers that stay at or above zero as long as its mode holds; an event is one of them falling below.

        Without units: they are usually near 1.
        """
        return []

    def energy(self, m: "Motion", own: Any, p: "Parameters") -> Any:
        """Potential energy [J] of a conservative effect."""
        return 0.0

    def power(self, m: "Motion", mode: Any, own: Any, solved: "Solved", p: "Parameters") -> Any:
        """Power [W] it puts in, by the coordinates' own motion; negative where it takes out."""
        return 0.0

    def remarks(self, equations: "Equations", trajectory: "Trajectory") -> tuple[str, ...]:
        """What a user should know of a run: that it left the range in which the effect holds, for instance."""
        return ()

    def weight(self, scene: "Scene") -> Weight:
        """What leaving it out would change."""
        return Weight(None, "")
