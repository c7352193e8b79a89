"""One simulated scene as results hold it: its numbers in SI and states, and the scene in words."""

import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Self

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.scene import Scene
from abu_calc.foundation.quantity import Quantity, Record, as_plain, record
from abu_calc.simulation.response import End
from abu_calc.simulation.simulate import Cost, Simulation
from abu_calc.simulation.subject import Audit, EffectEntry, Ledger


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
        names = tuple(effect.name for effect in scene.effects)
        return cls.read(scene, states=assemble(scene).states, support=scene.support.model(), effects=names)

    def to_dict(self) -> dict[str, Any]:
        """The support's numbers beside the others."""
        return {**as_plain(self.support), **super().to_dict()}


def in_words(scene: Scene) -> str:
    """Support, races and balls in a sentence."""
    races, balls = len(scene.races), len(scene.ball_masses)
    contact = "" if scene.balls_meet or balls < 2 else "; balls pass through each other"
    where = "one race" if races == 1 else f"{races} races"
    return f"{scene.support.description}, {where} with {balls} balls in all, viscous rolling drag{contact}."


def finite(value: float | None) -> float | None:
    """A number for a result: None where it is not finite."""
    return value if value is not None and math.isfinite(value) else None


@record
class Envelope(Record):
    """Usability of the averaged slow motion: its error estimate, and why it was taken or not."""

    error_estimate: Annotated[float | None, Quantity("error estimate of the averages", "", 2)]
    why: Annotated[str, Quantity("why it was taken, or not")]


@record
class SimulatedScene(Record):
    """One scene: how it ended, when it was quiet, what was left out, what it cost, how far it may be off."""

    optional: ClassVar[frozenset[str]] = frozenset(
        {"bearing_amplitudes_mm", "full_speed_s", "audit", "quiet_time_range_s",
         "rest_time_range_s"}
    )  # fmt: skip

    scene: Annotated[str, Quantity("scene")]
    duration: Annotated[float, Quantity("simulated time", "", 3, unit="s")]
    quiet_time: Annotated[
        float | None,
        Quantity(
            "quiet time",
            "",
            3,
            "from full speed until the level stays low; None if later than 95 % of the run",
            unit="s",
        ),
    ]
    rest_time: Annotated[
        float | None,
        Quantity(
            "rest time", "", 3, "from full speed until the balls keep their places; None if they still creep", unit="s"
        ),
    ]
    creeping: Annotated[bool, Quantity("balls still creep at the end")]
    settling_time: Annotated[
        float | None,
        Quantity("settling time", "", 3, "as it is published: until |imbalance| stays near its end", unit="s"),
    ]
    residual_imbalance: Annotated[
        float, Quantity("imbalance left", "", 3, "|m₀e + Σ m·R_p·e^{iθ}| at the end", unit="g_mm")
    ]
    axis_amplitude: Annotated[
        float,
        Quantity("axis amplitude 0–peak", "", 3, "largest √(x² + y²) about the mean place in the window", unit="mm"),
    ]
    velocity_rms: Annotated[
        float, Quantity("velocity rms", "v", 3, "of the larger of x', y' in the window", unit="mm_per_s")
    ]
    level_db: Annotated[float | None, Quantity("level", "L", 4, "20 lg(v/5e-8 m/s)")]
    unbalanced_amplitude: Annotated[float, Quantity("axis amplitude without balls", "A₀", 3, unit="mm")]
    largest_amplitude: Annotated[float, Quantity("largest since the start", "", 3, unit="mm")]
    final: End
    effects: tuple[EffectEntry, ...]
    cost: Cost
    error_estimate: Annotated[
        float, Quantity("error estimate", "", 2, "of amplitude and settling time relative, of ball angles in rad")
    ]
    rung: Annotated[str, Quantity("computed by", "", 4, "envelope: averaged slow motion; equations: of motion")]
    envelope: Envelope
    bearing_amplitudes: Annotated[
        tuple[float, ...] | None, Quantity("amplitudes at the bearings", "", 3, unit="mm")
    ] = None
    full_speed: Annotated[float | None, Quantity("full speed reached after", "", 3, "None: at the start", unit="s")] = (
        None
    )
    audit: Audit | None = None
    quiet_time_range: Annotated[
        tuple[float | None, float | None] | None,
        Quantity("quiet time, with a threshold that is grazed", "", 3, unit="s"),
    ] = None
    rest_time_range: Annotated[
        tuple[float | None, float | None] | None,
        Quantity("rest time, with a threshold that is grazed", "", 3, unit="s"),
    ] = None

    @classmethod
    def of(
        cls,
        simulation: Simulation,
        ledger: Ledger,
        audit: Audit | None = None,
    ) -> Self:
        """Record in user units."""
        response = simulation.response
        return cls.read(
            response,
            simulation,
            scene=response.scene,
            final=response.final,
            effects=ledger.entries,
            error_estimate=simulation.error_estimate + ledger.spared,
            envelope=Envelope(error_estimate=finite(simulation.offered.error), why=simulation.offered.why),
            bearing_amplitudes=response.bearing_amplitudes or None,
            full_speed=response.full_speed or None,
            audit=audit,
            quiet_time_range=response.quiet.grazed(simulation.scene.revolution),
            rest_time_range=response.rest.grazed(simulation.scene.revolution),
        )
