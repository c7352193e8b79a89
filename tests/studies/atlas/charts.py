"""Charts of the atlas as data: axes, fixed parameters, definition."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

FOLDER: Final = Path(__file__).parent
RPM: Final = 30 / math.pi

SPEEDS: Final = (0.8, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0, 8.0, 12.0)
"""Speed of the rotor over the natural frequency of the rotor without balls."""

DRAGS: Final = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0)
"""Viscous drag rate over the natural frequency."""


@dataclass(frozen=True)
class Cell:
    """A cell of a chart: a scene file with entries replaced, and its place."""

    chart: str
    speed_ratio: float
    drag: float
    file: str
    sets: tuple[str, ...]

    @property
    def key(self) -> tuple[str, str, str]:
        """Chart and place, as the CSV writes them."""
        return self.chart, f"{self.speed_ratio:g}", f"{self.drag:g}"

    def command(self, starts: int) -> str:
        """Command that gives the share of the cell again."""
        sets = " ".join(f"--set '{each}'" for each in self.sets)
        return f"abu stability tests/studies/atlas/{self.file} {sets} --attractors --starts {starts}"


@dataclass(frozen=True)
class BalanceChart:
    """Chart (a): share of drawn starts that balance, over speed ratio and drag rate.

    Fixed: all balls together 4 % of the rotor's mass, imbalance half of their capacity, damping ratio 0.05, J = 7/5,
    rotor at full speed, starts as in `abu stability --attractors`. With contact and friction r/R = 0.1, k_r/r = 2.5e-4.
    """

    balls: int
    contact: bool

    @property
    def name(self) -> str:
        """Name of the chart."""
        return f"a-{self.balls}-{'contact' if self.contact else 'plain'}"

    def cells(self) -> Iterator[Cell]:
        """All cells, row by row."""
        masses = ",".join([f"{40 / self.balls:g}"] * self.balls)
        angles = ",".join(f"{360 * k / self.balls:g}" for k in range(self.balls))
        for drag in DRAGS:
            for speed in SPEEDS:
                sets = (
                    f"scene.race[0].ball_masses_g=[{masses}]", f"scene.race[0].start_angles_deg=[{angles}]",
                    f"scene.race[0].rolling_drag_per_s={drag:g}", f"scene.speed_rpm={speed * RPM:.9g}",
                )  # fmt: skip
                yield Cell(self.name, speed, drag, f"{'contact' if self.contact else 'plain'}.toml", sets)


CHARTS: Final = tuple(BalanceChart(balls, contact) for balls in (2, 3, 4, 8) for contact in (False, True))
