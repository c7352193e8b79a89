"""Published statements and systems that no single command shows: Filimonikhin, Wright and Peng, two planes, others."""

import csv
import json
import math
from collections.abc import Callable
from pathlib import Path

from case_parts import Shown, axes, run, save, study
from command_output import FOLDER

RPM = 30 / math.pi
FIGURE_5A = {0.01: (1.4006,), 0.03: (1.6933,), 0.05: (1.0295, 1.0932, 1.8820)}
"""Rodrigues et al. 2008, fig. 5a, ± 0.001, by a ball's mass over that of the rotor."""

STUCK = ((1, 1), (3, 1), (3, 0), (1, 0))
"""Stuck speeds and how many of them are below the resonance, as the rotor turns faster (EEJET 2018, 128265)."""

SETTLES = {"avtovaz-707-222": 1.0, "avtovaz-707-370": 1.0, "avtovaz-707-305": 1.0}
"""Longest settling time [s] of the three machines (Kladiev 1996)."""

TWO_PLANE_SPEEDS = (1.5, 4.0, 6.0)


def routh(folder: Path) -> Shown:
    """Boundaries by Routh's array beside those of abu-calc."""
    by_hand, rows, worst = study("routh")["changes"], [], 0.0
    drawn = axes("ball mass / rotor mass", "speed Ω/ω_n at which stability changes")
    for k, (mass, values) in enumerate(by_hand.items()):
        changes = f"--set scene.race[0].ball_masses_g=[{1000 * float(mass):g},{1000 * float(mass):g}]"
        command = f"stability two-balls.toml --speeds 9.6:24 {changes} --json"
        found = json.loads(run(command).stdout)["result"]["boundaries_rpm"]
        ours = [change["speed_rpm"] / RPM for change in found if change["speed_rpm"] / RPM > 1.01]
        drawn.plot([float(mass)] * len(ours), ours, "o", ms=5, mfc="none", color="C0", label="abu-calc" * (k == 0))
        drawn.plot([float(mass)] * len(values), values, "+", ms=9, color="C1", label="Routh's array" * (k == 0))
        if len(ours) != len(values):
            rows.append((mass, len(values), len(ours), "miss"))
            continue
        for value, own in zip(values, ours, strict=True):
            worst = max(worst, abs(own - value))
            rows.append((mass, f"{value:.5f}", f"{own:.5f}", f"{own - value:+.0e}"))
    points = [(mass, value) for mass, values in FIGURE_5A.items() for value in values]
    drawn.plot(*zip(*points, strict=True), "kx", ms=6, label="published (Rodrigues et al. 2008)")
    save(drawn, folder / "routh.svg")
    return Shown(("ball mass / rotor mass", "Ω/ω_n, Routh's array", "abu-calc", "difference"), rows,
                 f"Largest difference: {worst:.0e}.")  # fmt: skip


def eigenvalues_by_hand() -> list[complex]:
    """Roots of the characteristic polynomial at Green's numbers."""
    return [complex(*value) for value in study("routh")["eigenvalues"]]


def stuck(folder: Path) -> Shown:
    """Stuck speeds over the rotor's speed, their numbers, and how far simulations deviate."""
    result = study("stuck")
    drawn = axes("speed of the rotor Ω/ω_n", "stuck speed / ω_n")
    points = [(at, value) for at, values in zip(result["speeds"], result["stuck"], strict=True) for value in values]
    drawn.plot(*zip(*points, strict=True), ".", ms=2.5, label="abu-calc, closed")
    drawn.axhline(1.0, color="0.7", lw=0.8)
    for low, high, count, below in result["ranges"]:
        drawn.axvline(low, color="0.8", lw=0.8)
        drawn.annotate(f"{count}", (math.sqrt(low * high), 15.0), ha="center")
        del below
    simulated = [row[2] for row in result["deviations"]]
    drawn.plot([2.0] * len(simulated), simulated, "o", mfc="none", color="C3", label="abu-calc, simulated")
    drawn.set(xscale="log", yscale="log", ylim=(0.6, 22))
    save(drawn, folder / "stuck.svg")
    rows, alike = [], 0
    for k, (low, high, count, below) in enumerate(result["ranges"]):
        wanted = STUCK[k] if k < len(STUCK) else ("none", "none")
        alike += (count, below) == wanted
        rows.append((f"{low:.3g} … {high:.3g}", f"{wanted[0]}, {wanted[1]} below", f"{count}, {below} below"))
    shares = ", ".join(f"{share:.3f} at {ratio:g}" for ratio, _, _, share in result["deviations"])
    told = (
        f"{alike} of {len(STUCK)} ranges alike. Published, too: simulated motions deviate from the closed speeds in "
        f"the ratio of the masses. Deviation over that ratio, by the ratio (red rings, Ω/ω_n = 2): {shares}."
    )
    return Shown(("Ω/ω_n", "published: stuck speeds", "abu-calc"), rows, told)


def ramps(folder: Path) -> Shown:
    """Share of starts that balance by the length of the run-up."""
    shares = study("ramps")
    drawn, rows = axes("run-up time · ω_n", "share of starts that balance"), []
    for name in dict.fromkeys(row[0] for row in shares):
        chosen = [(run_up, share) for case, run_up, share in shares if case == name]
        drawn.plot(*zip(*chosen, strict=True), "o-", mfc="none", label=name)
        spread = max(share for _, share in chosen) - min(share for _, share in chosen)
        wanted = "depends on the run-up" if "decides" in name else "does not depend on it"
        seen = "depends on the run-up" if spread > 0.1 else "does not depend on it"
        cells = ", ".join(f"{100 * share:.0f}" for _, share in chosen)
        rows.append((name, wanted, seen, cells, "yes" if wanted == seen else "NO"))
    drawn.set(ylim=(0, 1.05))
    save(drawn, folder / "ramps.svg")
    header = ("set of numbers", "published: share that balances", "abu-calc", "%, by run-up time", "alike")
    return Shown(header, rows)


def stiction(folder: Path) -> Shown:
    """Imbalance left by starts with and without friction and a temporary speed reduction."""
    ends = study("stiction")
    drawn, rows, labels = axes("abu-calc, one ring a start", "imbalance left / imbalance"), [], []
    for k, (friction, plateau, left) in enumerate(ends):
        labels.append(f"f = {friction:g}\n{'full speed' if plateau is None else f'slowed to {plateau:g}'}")
        drawn.plot([k] * len(left), left, "o", ms=4, mfc="none", color="C0")
        rows.append((f"{friction:g}", "none" if plateau is None else f"to {plateau:g}", f"{left[len(left) // 2]:.3f}",
                     f"{left[int(0.9 * len(left))]:.3f}", f"{left[-1]:.3f}"))  # fmt: skip
    drawn.set_xticks(range(len(labels)), labels, fontsize=7)
    save(drawn, folder / "stiction.svg")
    high = {(friction, plateau): (left[int(0.9 * len(left))], left[-1]) for friction, plateau, left in ends}
    scatters = all(
        most > 10 * high[0.0, None][1] and most > 0.05 for _, most in high.values() if most != high[0.0, None][1]
    )
    slowed = [(value, high[key[0], None]) for key, value in high.items() if key[1] is not None]
    told = (
        f"Friction scatters the starts: {'yes' if scatters else 'NO'}. With a reduction the 90 % value is lower in "
        f"{sum(value[0] < full[0] for value, full in slowed)} of {len(slowed)} cases, the largest in "
        f"{sum(value[1] < full[1] for value, full in slowed)}: single starts end farther off."
    )
    return Shown(("f", "speed reduced", "left: median", "90 %", "largest"), rows, told)


def two_planes(folder: Path) -> Shown:
    """Vibration of a rotor with two races beside the public program's equations."""
    record = study("two-planes")
    drawn, rows, worst = axes("time t·ω_n", "largest vibration per window"), [], 0.0
    for k, speed in enumerate(TWO_PLANE_SPEEDS):
        published = record["largest"][str(speed)]
        seen = run(
            "simulate two-planes.toml --json --trajectory two-planes.csv --samples 16001 --force --accuracy 0.001 "
            f"--set scene.speed_rpm={speed * RPM!r}"
        )
        if seen.returncode:
            raise RuntimeError(seen.stderr)
        with (FOLDER / "two-planes.csv").open(encoding="utf-8", newline="") as file:
            motion = [(float(row["t_s"]), _vibration(row)) for row in csv.DictReader(file)]
        ours = [max(level for t, level in motion if low <= t <= high) for low, high in record["windows"]]
        for (low, high), value, own in zip(record["windows"], published, ours, strict=True):
            worst = max(worst, abs(own / value - 1))
            if low in (0, 300, 700):
                rows.append(
                    (
                        f"{speed:g}",
                        f"{low:g}–{high:g}",
                        f"{value:.4e}",
                        f"{own:.4e}",
                        f"{100 * (own / value - 1):+.4f} %",
                    )
                )
        middle = [(low + high) / 2 for low, high in record["windows"]]
        drawn.plot(middle, ours, "o", mfc="none", color=f"C{k}", label=f"abu-calc, Ω = {speed:g}")
        drawn.plot(middle, published, "kx", label="program's equations" * (k == 0))
    drawn.set(yscale="log")
    save(drawn, folder / "two-planes.svg")
    return Shown(("Ω", "time t·ω_n", "program's equations", "abu-calc", "difference"), rows,
                 f"Largest difference in all windows: {100 * worst:.4f} %.")  # fmt: skip


def _vibration(row: dict[str, str]) -> float:
    """Mean displacement [m] one unit to either side of the middle."""
    x, y, tilt_x, tilt_y = (float(row[key]) / 1000 for key in ("x_mm", "y_mm", "tilt_x_mrad", "tilt_y_mrad"))
    return (math.hypot(x + tilt_y, y - tilt_x) + math.hypot(x - tilt_y, y + tilt_x)) / 2


def settling(folder: Path) -> Shown:
    """Settling times of three machines."""
    rows, drawn = [], axes("", "settling time, s")
    for k, (preset, limit) in enumerate(SETTLES.items()):
        times = json.loads(run(f"size {preset} --json").stdout)["result"]["ensemble"]["settling_time_s"]
        rows.append((preset, f"under {limit:g} s", f"{times['typical']:.2f} s", f"{times['worst']:.2f} s"))
        drawn.plot([k, k], [0, limit], "k", lw=6, alpha=0.3, label="published range" * (k == 0))
        drawn.plot([k], [times["typical"]], "o", mfc="none", color="C0", label="abu-calc, median" * (k == 0))
        drawn.plot([k], [times["worst"]], "^", mfc="none", color="C3", label="abu-calc, slowest, hot oil" * (k == 0))
    drawn.set_xticks(range(len(SETTLES)), SETTLES)
    drawn.set(ylim=(0, 2.1))
    save(drawn, folder / "settling.svg")
    typical = sum(float(str(row[2])[:-2]) < 1 for row in rows)
    slowest = sum(float(str(row[3])[:-2]) < 1 for row in rows)
    told = f"Under one second: the median in {typical} of {len(rows)}, the slowest start with hot oil in {slowest}."
    return Shown(("machine", "published", "abu-calc: median", "slowest start"), rows, told)


PUBLISHED_CASES: dict[str, Callable[[Path], Shown]] = {
    "routh": routh,
    "stuck": stuck,
    "ramps": ramps,
    "stiction": stiction,
    "two-planes": two_planes,
    "settling": settling,
}
