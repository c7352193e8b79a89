"""Published cases recomputed when the documentation is built: published values and those of abu-calc side by side.

```{abu-validation} transient         a table, or a table and a figure, of one case
```
"""

import csv
import json
import math
from collections.abc import Callable, Sequence
from pathlib import Path

from command_output import FOLDER, run
from docutils import nodes
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

Row = Sequence[object]

TRANSIENT = {
    (0, 25): 0.0484, (25, 50): 0.0436, (50, 75): 0.0362, (75, 100): 0.0281, (100, 150): 0.0236, (150, 200): 0.0187,
    (200, 300): 0.0123, (300, 400): 0.0076, (400, 500): 0.0045, (500, 600): 0.0029, (600, 700): 0.0020,
}  # fmt: skip
"""Largest spindle displacement in windows of time (Rodrigues et al. 2008, fig. 11 i), read off the figure, ± 2 %."""

BOUNDARIES = {10.0: (1.4006,), 30.0: (1.6933,), 50.0: (1.0295, 1.0932, 1.8820)}
"""Speeds over the natural frequency at which stability changes, by a ball's mass in g (ibid., fig. 5a, ± 0.001)."""

BALLS_G = {4.76: 0.440, 8.0: 2.091, 10.0: 4.084, 12.7: 8.366, 16.0: 16.728, 19.84: 31.895}
"""Masses of steel balls at 7.8e-3 g/mm³ by diameter in mm."""

W_H = {6.3: 0.727, 8: 0.873, 16: 0.896, 31.5: 0.519, 63: 0.256, 125: 0.127, 250: 0.0634, 500: 0.0314, 1000: 0.0135}
"""Weights W_h of ISO 5349-1:2001, table A.2, by frequency in Hz."""

RPM = 30 / math.pi


def transient(folder: Path) -> tuple[Row, list[Row]]:
    """Largest displacement per window, and a figure of both."""
    seen = run("simulate two-balls.toml --json --trajectory two-balls.csv --samples 28001 --force")
    if seen.returncode:
        raise RuntimeError(seen.stderr)
    with (FOLDER / "two-balls.csv").open(encoding="utf-8", newline="") as file:
        motion = [tuple(float(row[key]) for key in ("t_s", "x_mm", "y_mm")) for row in csv.DictReader(file)]
    rows: list[Row] = []
    for (low, high), published in TRANSIENT.items():
        ours = max(math.hypot(x, y) for t, x, y in motion if low <= t <= high) / 1000
        rows.append((f"{low}–{high}", f"{published:.4f}", f"{ours:.4f}", f"{100 * (ours / published - 1):+.1f} %"))
    _draw(motion, folder / "transient.svg")
    return ("time t·ω_n", "largest displacement, published", "abu-calc", "difference"), rows


def _draw(motion: Sequence[tuple[float, ...]], file: Path) -> None:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7, 3.2), layout="constrained")
    axes = figure.subplots()
    axes.plot([t for t, *_ in motion], [math.hypot(x, y) / 1000 for _, x, y in motion], lw=0.5, label="abu-calc")
    for (low, high), published in TRANSIENT.items():
        axes.plot([low, high], [published, published], "k", lw=1.5, label="published, largest per window" * (low == 0))
    axes.set(xlabel="time t·ω_n", ylabel="spindle displacement / pitch radius", xlim=(0, 700), ylim=0)
    axes.legend(frameon=False)
    figure.savefig(file)


def boundaries(folder: Path) -> tuple[Row, list[Row]]:
    """Speeds at which stability changes."""
    rows: list[Row] = []
    for mass, published in BOUNDARIES.items():
        command = f"stability two-balls.toml --speeds 9.6:24 --set scene.race[0].ball_masses_g=[{mass},{mass}] --json"
        ours = [boundary["speed_rpm"] / RPM for boundary in json.loads(run(command).stdout)["result"]["boundaries_rpm"]]
        ours = [speed for speed in ours if speed > 1.01]
        for k, value in enumerate(published):
            found = min(ours, key=lambda speed: abs(speed - value))
            rows.append((f"{mass / 1000:g}" if k == 0 else "", value, f"{found:.4f}", f"{found - value:+.4f}"))
    return ("ball mass / rotor mass", "Ω/ω_n, published", "abu-calc", "difference"), rows


def disc(folder: Path) -> tuple[Row, list[Row]]:
    """End angles of two free balls."""
    result = json.loads(run("simulate disc.toml --json").stdout)["result"]
    angles = sorted(angle % 360 for angle in result["final"]["ball_angles_deg"])
    pairs = zip((165, 285), angles, strict=True)
    rows = [(f"ball {k}", f"{want}°", f"{got:.2f}°", f"{got - want:+.2f}°") for k, (want, got) in enumerate(pairs, 1)]
    return ("", "published", "abu-calc", "difference"), rows


def facts(folder: Path) -> tuple[Row, list[Row]]:
    """Rows of standards."""
    from abu_calc.standards.vibration import hand_arm_weight

    rows: list[Row] = []
    for frequency, published in W_H.items():
        ours = hand_arm_weight(math.tau * frequency)
        rows.append((f"W_h at {frequency:g} Hz", published, f"{ours:.4g}", f"{100 * (ours / published - 1):+.2f} %"))
    for diameter, published in BALLS_G.items():
        ours = 7.8e-3 * math.pi * diameter**3 / 6
        rows.append((f"ball Ø{diameter:g} mm, g", published, f"{ours:.3f}", f"{100 * (ours / published - 1):+.2f} %"))
    return ("row", "published", "abu-calc", "difference"), rows


def machines(folder: Path) -> tuple[Row, list[Row]]:
    """Balls of the four machines that a factory measured."""
    published = {
        "avtovaz-707-222": ("4 × Ø16 mm", "4 %"),
        "avtovaz-707-370": ("3 × Ø16 mm", "4.7 %"),
        "avtovaz-707-305": ("3 × Ø19.8 mm", "4.9 %"),
        "msh-230": ("not published", "not published"),
    }
    rows: list[Row] = []
    for preset, (balls, share) in published.items():
        made = json.loads(run(f"size {preset} --json").stdout)["result"]["autobalancer"]
        ours = f"{made['ball_count']} × Ø{made['ball_diameter_mm']:.1f} mm"
        rows.append((preset, balls, ours, share, f"{100 * made['mass_fraction']:.1f} %"))
    return ("machine", "balls, published", "abu-calc", "mass share, published", "abu-calc"), rows


CASES: dict[str, Callable[[Path], tuple[Row, list[Row]]]] = {
    "transient": transient,
    "boundaries": boundaries,
    "disc": disc,
    "facts": facts,
    "machines": machines,
}


class ValidationCase(SphinxDirective):
    """The table of one case, and its figure if it makes one."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Recompute the case."""
        name = self.arguments[0]
        folder = Path(self.env.srcdir) / "_generated"
        folder.mkdir(exist_ok=True)
        header, rows = CASES[name](folder)
        lines = [_line(header), _line(["---"] * len(header)), *map(_line, rows)]
        container = nodes.container()
        self.state.nested_parse(StringList(lines, source=name), 0, container)
        figure = folder / f"{name}.svg"
        if figure.is_file():
            container += nodes.image(uri=f"/_generated/{figure.name}", alt=f"published values and abu-calc: {name}")
        return [container]


def _line(cells: Row) -> str:
    return f"| {' | '.join(map(str, cells))} |"


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directive."""
    app.add_directive("abu-validation", ValidationCase)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
