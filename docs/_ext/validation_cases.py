"""Published cases recomputed when the documentation is built: published values and those of abu-calc side by side.

```{abu-validation} transient         a table, or a table and a figure, of one case
```
"""

import csv
import json
import math
from collections.abc import Callable, Sequence
from pathlib import Path

import case_parts
from case_parts import Shown, run
from case_parts import axes as _axes
from case_parts import save as _save
from command_output import FOLDER
from docutils import nodes
from docutils.statemachine import StringList
from published_cases import PUBLISHED_CASES, eigenvalues_by_hand
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

EIGENVALUES = (-0.004087 + 0.744047j, -0.004952 + 0.068382j, -0.009185 + 2.956028j, -0.011363 + 1.006468j)
"""Of two balls at (Ω, μ, δ, ζ, β) = (2, .05, .01, .01, .01), in the coordinates of Green, Champneys and Lieven 2006."""

SHARES = (0.1, 0.3, 0.5, 0.7, 0.9)
"""Imbalance over the capacity of two balls."""

MASSES_G = (5, 10, 15, 20, 25, 30, 33, 36, 40, 45, 50, 60)
"""Masses of a ball for the curve of the speeds at which stability changes."""

ARM = {5.0: (12.0, None), 2.0: (12.0, None), 0.75: (4.0, 2.3), 0.5: (4.0, 2.5)}
"""Ω/ω₀, duration of the run [s], and amplitude over that without balls, by a separate simulation of ours."""

SEATS = {"K7": (-30, 28, 0.554), "M7": (-18, 40, 0.066), "H7": (-58, 0, 0.99996)}
"""Housing Ø140: interference [µm] from and to, probability of clearance (Afanasiev 2015)."""

BETWEEN = {200: False, 460: True, 620: False, 1000: True}
"""Speeds [rad/s] of a support with natural frequencies of 300 and 700 rad/s: whether separate simulations balance."""

MERGED = ((0.5, 1e4, 1, 0.02), (0.7, 2e4, 1, 0.02), (2.0, 12e4, -1, 0.2), (3.0, 15e4, -1, 0.2))
"""Speed, imbalance [g·mm], side on which the balls stand, damping [N·s/m]: numbers of ours."""

W_H = {6.3: 0.727, 8: 0.873, 16: 0.896, 31.5: 0.519, 63: 0.256, 125: 0.127, 250: 0.0634, 500: 0.0314, 1000: 0.0135}
"""Weights W_h of ISO 5349-1:2001, table A.2, by frequency in Hz."""

RPM = 30 / math.pi


def transient(folder: Path) -> Shown:
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
    worst = max(abs(float(str(row[3]).split()[0])) for row in rows)
    told = f"Largest difference: {worst:.1f} %. The figure can be read within 2 %."
    return Shown(("time t·ω_n", "largest displacement, published", "abu-calc", "difference"), rows, told)


def _draw(motion: Sequence[tuple[float, ...]], file: Path) -> None:
    axes = _axes("time t·ω_n", "spindle displacement / pitch radius")
    axes.plot([t for t, *_ in motion], [math.hypot(x, y) / 1000 for _, x, y in motion], lw=0.5, label="abu-calc")
    for (low, high), published in TRANSIENT.items():
        axes.plot([low, high], [published, published], "k", lw=1.5, label="published, largest per window" * (low == 0))
    axes.set(xlim=(0, 700), ylim=0)
    _save(axes, file)


def boundaries(folder: Path) -> Shown:
    """Speeds at which stability changes."""
    rows: list[Row] = []
    curve = {mass: _changes(mass) for mass in MASSES_G}
    for mass, published in BOUNDARIES.items():
        ours = _changes(mass)
        for k, value in enumerate(published):
            found = min(ours, key=lambda speed: abs(speed - value))
            rows.append((f"{mass / 1000:g}" if k == 0 else "", value, f"{found:.4f}", f"{found - value:+.4f}"))
    axes = _axes("ball mass / rotor mass", "speed Ω/ω_n at which stability changes")
    points = [(mass / 1000, speed) for mass, speeds in curve.items() for speed in speeds]
    axes.plot(*zip(*points, strict=True), "o", ms=4, mfc="none", label="abu-calc")
    points = [(mass / 1000, speed) for mass, speeds in BOUNDARIES.items() for speed in speeds]
    axes.plot(*zip(*points, strict=True), "kx", ms=7, label="published")
    _save(axes, folder / "boundaries.svg")
    worst = max(abs(float(str(row[3]))) for row in rows)
    told = f"Largest difference: {worst:.4f}. The figure can be read within 0.001."
    return Shown(("ball mass / rotor mass", "Ω/ω_n, published", "abu-calc", "difference"), rows, told)


def _changes(mass: float) -> list[float]:
    """Speeds over the natural frequency at which stability changes, for balls of a mass [g]."""
    command = f"stability two-balls.toml --speeds 9.6:24 --set scene.race[0].ball_masses_g=[{mass},{mass}] --json"
    changes = json.loads(run(command).stdout)["result"]["boundaries_rpm"]
    return [speed for change in changes if (speed := change["speed_rpm"] / RPM) > 1.01]


def eigenvalues(folder: Path) -> Shown:
    """The four pairs of two balls."""
    result = json.loads(run("stability two-balls.toml --json").stdout)["result"]
    ours = [complex(*value) for value in result["eigenvalues"] if value[1] > 0]
    by_hand, rows = eigenvalues_by_hand(), list[Row]()
    for listed in EIGENVALUES:
        own, other = (min(values, key=lambda value: abs(value - listed)) for values in (ours, by_hand))
        rows.append((_complex(listed), _complex(own), f"{abs(own - listed):.0e}", f"{abs(own - other):.0e}"))
    axes = _axes("real part", "imaginary part")
    axes.plot([value.real for value in ours], [value.imag for value in ours], "o", mfc="none", label="abu-calc")
    axes.plot([value.real for value in EIGENVALUES], [value.imag for value in EIGENVALUES], "kx", label="listed")
    _save(axes, folder / "eigenvalues.svg")
    worst = max(min(abs(value - known) for value in ours) for known in EIGENVALUES)
    told = f"Largest distance from the listed values: {worst:.1e}; their last digit is 1e-6."
    return Shown(("listed", "abu-calc", "distance", "distance from the polynomial"), rows, told)


def _complex(value: complex) -> str:
    return f"{value.real:.6f} ± {value.imag:.6f}i"


def rest(folder: Path) -> Shown:
    """Places at which two balls come to rest."""
    settles = "scene.damping_N_s_per_m=[0.2,0.2] scene.race[0].rolling_drag_per_s=0.3 scene.duration_s=300"
    rows: list[Row] = []
    for share in SHARES:
        changes = f"{settles} scene.imbalance_g_mm={1e5 * share}".split()
        command = f"simulate two-balls.toml --json {' '.join(f'--set {change}' for change in changes)}"
        angles = sorted(json.loads(run(command).stdout)["result"]["final"]["ball_angles_deg"])
        want = math.degrees(math.acos(-share))
        rows.append((share, f"± {want:.2f}°", f"{angles[0]:.2f}°, {angles[1]:.2f}°", f"{angles[1] - want:+.3f}°"))
    axes = _axes("imbalance / capacity", "angle of a ball, °")
    line = [k / 50 for k in range(51)]
    axes.plot(line, [math.degrees(math.acos(-share)) for share in line], "k", lw=1, label="published law")
    axes.plot(SHARES, [float(str(row[2]).split(", ")[1][:-1]) for row in rows], "o", mfc="none", label="abu-calc")
    _save(axes, folder / "rest.svg")
    told = f"Largest difference: {max(abs(float(str(row[3])[:-1])) for row in rows):.3f}°."
    return Shown(("imbalance / capacity", "published law", "abu-calc", "difference"), rows, told)


def arm(folder: Path) -> Shown:
    """Two balls on a swing arm, above and below its natural frequency."""
    rows, grown = list[Row](), dict[float, float]()
    for ratio, (duration, reference) in ARM.items():
        natural = 300 / ratio
        changes = (
            f"scene.duration_s={duration}", f"scene.swing_arm.joint_stiffness_N_per_m={0.45 * natural**2 / 0.09}",
            f"scene.swing_arm.joint_damping_N_s_per_m={0.2 * natural * 0.45 / 0.09}",
        )  # fmt: skip
        command = f"simulate swing-arm.toml --json {' '.join(f'--set {change}' for change in changes)}"
        result = json.loads(run(command).stdout)["result"]
        angles = ", ".join(f"{angle:.1f}°" for angle in sorted(result["final"]["ball_angles_deg"]))
        grown[ratio] = result["axis_amplitude_mm"] / result["unbalanced_amplitude_mm"]
        want = "balanced, balls at ± 131.8°" if reference is None else f"× {reference}, balls together"
        ours = f"× {grown[ratio]:.2g}" if grown[ratio] > 0.001 else "× < 0.001"
        rows.append((f"{ratio:g}", want, f"{ours}, balls at {angles}"))
    axes = _axes("speed / natural frequency of the arm", "amplitude with / without balls")
    axes.plot(list(grown), list(grown.values()), "o", mfc="none", label="abu-calc")
    points = [(ratio, 0.0 if value is None else value) for ratio, (_, value) in ARM.items()]
    axes.plot(*zip(*points, strict=True), "kx", label="separate simulation")
    axes.axhline(1, color="0.7", lw=0.8)
    _save(axes, folder / "arm.svg")
    return Shown(("Ω/ω₀", "separate simulation", "abu-calc"), rows)


def between(folder: Path) -> Shown:
    """Stability between and beside the natural frequencies of an anisotropic support."""
    changes = (
        f"scene.mass_kg=5 scene.stiffness_N_per_m=[{5 * 300**2},{5 * 700**2}] scene.damping_N_s_per_m=[150,350] "
        "scene.imbalance_g_mm=100 scene.race[0].pitch_radius_mm=24 scene.race[0].ball_masses_g=[4,4] "
        "scene.race[0].rolling_drag_per_s=30"
    ).split()
    rows: list[Row] = []
    for speed, published in BETWEEN.items():
        sets = " ".join(f"--set {change}" for change in (*changes, f"scene.speed_rpm={speed * RPM}"))
        stable = json.loads(run(f"stability two-balls.toml --json {sets}").stdout)["result"]["stable"]
        words = {True: "balances", False: "does not balance"}
        rows.append((speed, words[published], words[stable]))
    told = f"{sum(row[1] == row[2] for row in rows)} of {len(rows)} alike."
    return Shown(("speed, rad/s", "separate simulation", "abu-calc"), rows, told)


def merged(folder: Path) -> Shown:
    """Amplitudes of balls that cannot balance and stand together: law and simulation."""
    rows: list[Row] = []
    for speed, imbalance, side, damping in MERGED:
        changes = (
            f"scene.speed_rpm={speed * RPM}", f"scene.imbalance_g_mm={imbalance}", "scene.duration_s=1500",
            f"scene.damping_N_s_per_m=[{damping},{damping}]", "scene.race[0].rolling_drag_per_s=0.3",
        )  # fmt: skip
        sets = " ".join(f"--set {change}" for change in changes)
        ours = json.loads(run(f"simulate two-balls.toml --json {sets}").stdout)["result"]["axis_amplitude_mm"]
        law = (imbalance + side * 1e5) * speed**2 / abs(1 - 1.1 * speed**2) / 1000
        where = "heavy side" if side > 0 else "opposite, too little capacity"
        rows.append((f"{speed:g}", where, f"{abs(law):.2f}", f"{ours:.2f}", f"{100 * (ours / abs(law) - 1):+.1f} %"))
    drawn = _axes("speed Ω/ω_n", "amplitude, mm")
    drawn.plot([float(str(row[0])) for row in rows], [float(str(row[3])) for row in rows], "o", mfc="none",
               label="abu-calc")  # fmt: skip
    drawn.plot([float(str(row[0])) for row in rows], [float(str(row[2])) for row in rows], "kx", label="undamped law")
    drawn.set(ylim=0)
    _save(drawn, folder / "merged.svg")
    told = f"Largest difference: {max(abs(float(str(row[4])[:-2])) for row in rows):.1f} %."
    return Shown(("Ω/ω_n", "balls", "undamped law, mm", "abu-calc, mm", "difference"), rows, told)


def seats(folder: Path) -> Shown:
    """Interference and probability of clearance of a housing."""
    rows: list[Row] = []
    for fit, (low, high, probability) in SEATS.items():
        command = (
            "check-fit --bore 80 --outer 140 --width 33 --bearing-type ball --radial-load-kN 3 --shaft k6 "
            f"--housing {fit} --json"
        )
        housing = json.loads(run(command).stdout)["result"][1]
        ours = housing["interference_um"]
        chance = housing["clearance_probability"]
        rows.append(
            (f"Ø140 {fit}", f"{low} … {high}", f"{ours[0]:g} … {ours[1]:g}", f"{probability:g}", f"{chance:.5g}")
        )
    header = ("housing", "interference, µm, published", "abu-calc", "probability of clearance, published", "abu-calc")
    return Shown(header, rows)


def levels(folder: Path) -> Shown:
    """Levels with the autobalancer that a factory measured, predicted ones, and their misses."""
    result = json.loads(run("factory --json").stdout)["result"]
    rows, labels = list[Row](), list[str]()
    axes = _axes("", "level with autobalancer, dB re 5e-8 m/s")
    for k, row in enumerate(row for row in result["rows"] if row["with_measured_db"]):
        (low, high), ours, there = row["with_measured_db"], row["with_predicted_db"], row["at_handles_db"]
        labels.append(f"{row['short']}\n{row['state']}")
        axes.plot([k, k], [low, high], "k", lw=6, solid_capstyle="butt", label="measured" * (k == 0))
        axes.plot([k], [ours], "o", mfc="none", label="plane model" * (k == 0))
        axes.plot([k + 0.1] * 2, there, "C1", lw=3, label="rigid body at the handles" * (k == 0))
        rows.append(
            (f"{row['short']}, {row['state']}", f"{low:g} … {high:g}", f"{ours:.1f}", f"{row['miss_db']:.1f}",
             f"{there[0]:.0f} … {there[1]:.0f}", f"{row['at_handles_miss_db']:.1f}", row["degrees_of_freedom_spent"])
        )  # fmt: skip
    axes.set_xticks(range(len(labels)), labels)
    _save(axes, folder / "levels.svg")
    misses = [(abs(float(str(row[3]))), abs(float(str(row[5])))) for row in rows]
    told = (
        f"Misses: {min(plane for plane, _ in misses):.1f} to {max(plane for plane, _ in misses):.1f} dB in the plane "
        f"model, {min(rigid for _, rigid in misses):.1f} to {max(rigid for _, rigid in misses):.1f} dB at the handles."
    )
    header = ("machine", "measured, dB", "plane model, dB", "miss, dB", "at the handles, dB", "miss, dB",
              "degrees of freedom spent")  # fmt: skip
    return Shown(header, rows, told)


def disc(folder: Path) -> Shown:
    """End angles of two free balls."""
    result = json.loads(run("simulate disc.toml --json").stdout)["result"]
    angles = sorted(angle % 360 for angle in result["final"]["ball_angles_deg"])
    pairs = zip((165, 285), angles, strict=True)
    rows = [(f"ball {k}", f"{want}°", f"{got:.2f}°", f"{got - want:+.2f}°") for k, (want, got) in enumerate(pairs, 1)]
    return Shown(("", "published", "abu-calc", "difference"), rows)


def facts(folder: Path) -> Shown:
    """Rows of standards."""
    from abu_calc.standards.vibration import hand_arm_weight

    rows: list[Row] = []
    for frequency, published in W_H.items():
        ours = hand_arm_weight(math.tau * frequency)
        rows.append((f"W_h at {frequency:g} Hz", published, f"{ours:.4g}", f"{100 * (ours / published - 1):+.2f} %"))
    for diameter, published in BALLS_G.items():
        ours = 7.8e-3 * math.pi * diameter**3 / 6
        rows.append((f"ball Ø{diameter:g} mm, g", published, f"{ours:.3f}", f"{100 * (ours / published - 1):+.2f} %"))
    return Shown(("row", "published", "abu-calc", "difference"), rows)


def machines(folder: Path) -> Shown:
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
    return Shown(("machine", "balls, published", "abu-calc", "mass share, published", "abu-calc"), rows)


CASES: dict[str, Callable[[Path], Shown]] = {
    "transient": transient,
    "boundaries": boundaries,
    "eigenvalues": eigenvalues,
    "rest": rest,
    "arm": arm,
    "between": between,
    "merged": merged,
    "seats": seats,
    "levels": levels,
    "disc": disc,
    "facts": facts,
    "machines": machines,
    **PUBLISHED_CASES,
}


class ValidationCase(SphinxDirective):
    """The table of one case, and its figure if it makes one."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Recompute the case."""
        name = self.arguments[0]
        folder = Path(self.env.srcdir) / "_generated"
        folder.mkdir(exist_ok=True)
        case_parts.RAN.clear()
        shown = CASES[name](folder)
        lines = [_line(shown.header), _line(["---"] * len(shown.header)), *map(_line, shown.rows)]
        if shown.agreement:
            lines += ["", shown.agreement]
        container = nodes.container()
        self.state.nested_parse(StringList(lines, source=name), 0, container)
        figure = folder / f"{name}.svg"
        if figure.is_file():
            container += nodes.image(uri=f"/_generated/{figure.name}", alt=f"published values and abu-calc: {name}")
        if text := case_parts.commands():
            container += nodes.literal_block(text, text, language="console")
        return [container]


def _line(cells: Row) -> str:
    return f"| {' | '.join(map(str, cells))} |"


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directive."""
    app.add_directive("abu-validation", ValidationCase)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
