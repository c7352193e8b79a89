"""Columns of a sample of a sweep, with units, as store, answers and Python have them."""

from typing import Final, Literal

from abu_calc.frozen import dataclass
from abu_calc.units import unit_of

What = Literal["build", "design", "scene"]


@dataclass(frozen=True)
class Column:
    """One number of each member: its name (which ends in the unit), what it means."""

    name: str
    meaning: str

    @property
    def unit(self) -> str:
        """Unit as shown."""
        return unit_of(self.name)


LEVEL: Final = Column("level_db", "velocity level, idle, at the loudest handle")
SETTLING: Final = Column("settling_time_s", "until the balls stay where they end, of a run-up from full speed on")
LEFT: Final = Column("residual_imbalance_g_mm", "what balls leave of the imbalance")
BALANCES: Final = Column("balances", "1: the balls rest in their race, and what they leave is allowed")
MEETS: Final = Column("meets_limits", "1: it meets all of the limits")
SEED: Final = Column("seed", "of what is particular to the member: how its balls differ within their lot")
REASON: Final = Column("reason", "why there are no numbers")
MEMBER: Final = Column("member", "number of the member, from 0")

OUTSIDE: Final = "not computed: "
"""Start of reasons that lie outside the machine, in the computer: such members are tried again by the next run."""
OVERTIME: Final = "not done within "
"""Start of the reason of a member that took too long; the limit in seconds follows. A longer one tries it again."""
IMPATIENT: Final = OUTSIDE + "the seconds of --patience were over"
"""Reason of a member that the patience of its run left out; the next run computes it."""

QUANTITIES: Final[dict[What, tuple[Column, ...]]] = {
    "build": (
        LEVEL,
        SETTLING,
        Column("residual_um", "amplitude of the axis that stays"),
        LEFT,
        Column("capacity_ratio", "capacity over need"),
    ),
    "design": (
        Column("level_after_db", "level with the autobalancer, as expected"),
        Column("worst_level_db", "of the loudest start"),
        Column("worst_settling_time_s", "of the slowest start"),
        Column("ball_count", "balls"),
        Column("ball_diameter_mm", "their diameter"),
        Column("race_radius_mm", "radius of the race"),
        Column("mass_g", "mass with balls"),
        Column("capacity_ratio", "capacity over need"),
    ),
    "scene": (
        LEVEL,
        SETTLING,
        Column("axis_amplitude_mm", "amplitude of the axis that stays"),
        LEFT,
    ),
}
"""Numbers that percentiles are told of."""

FLAGS: Final[dict[What, tuple[Column, ...]]] = {
    "build": (
        BALANCES,
        Column("none_hangs", "1: no ball goes round behind the rotor at the end"),
        Column("meets_level", "1: the level is within limits.vibration_level_db"),
        Column("meets_settling", "1: it balances within limits.settling_time_s"),
        MEETS,
    ),
    "design": (MEETS,),
    "scene": (BALANCES, MEETS),
}
"""Conditions that are met or not; the last of them is all together."""

DECIDING: Final[dict[What, str]] = {"build": "level_db", "design": "level_after_db", "scene": "level_db"}
"""The number whose sensitivities are told first."""
