"""Whether `abu identify` finds known values: random machines, recorded by another integrator at a tighter tolerance.

    python -m tests.studies.identification [machines] [first] [file of lines]

The truth is integrated by SciPy's DOP853 at 1e-8; the banks that are compared with it by the compiled loop at 2e-4.
Each machine has ten starts, 1 mm/s of noise and a mark; every fourth spindle is vertical. Every fifth machine is
identified once more without its mark. The file has one line of JSON for each machine; these are not done again. A
machine takes one to two minutes of one core. The lines kept here are of the first machines; the command goes on with
them.
"""

import json
import math
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Final

import numpy as np

import abu_calc
from abu_calc.simulation.scene_file import read_any
from tests.benchmarks.measuring import keep, machine
from tests.features.identification.recorded import record

STARTS: Final = 10
EVERY_VERTICAL: Final = 4
EVERY_WITHOUT_MARK: Final = 5
ENGINE: Final = ("scipy", 1e-8)
LINES: Final = Path(__file__).with_name("identification.jsonl")
"""Lines of the machines done."""
ENOUGH: Final = 12
"""Machines, the least for a record."""
NAMES: Final = (
    "rolling_drag_per_s",
    "rolling_friction_mm",
    "race_eccentricity_mm",
    "race_eccentricity_angle_deg",
)

SCENE: Final = """[scene]
support = "planar"
mass_kg = {mass:.3f}
stiffness_N_per_m = [{stiffness:.4f}, {stiffness:.4f}]
damping_N_s_per_m = [{damping:.5f}, {damping:.5f}]
speed_rpm = {speed:.1f}
imbalance_g_mm = {imbalance:.2f}
duration_s = {duration:.2f}
rolling_inertia = true
[[scene.race]]
pitch_radius_mm = {pitch:.3f}
ball_masses_g = {masses}
ball_radius_mm = {radius:.4f}
rolling_drag_per_s = 15
start_angles_deg = {angles}
[scene.effects]
{gravity}
ball_contact = {{ ball_radius_mm = {radius:.4f}, restitution = 0.5 }}
run_up = {{ time_s = {run_up:.3f} }}
race_eccentricity = {{ magnitude_mm = 0.01, angle_deg = 0.0 }}
dry_rolling_friction = {{ lever_arm_mm = 0.002, ball_radius_mm = {radius:.4f} }}
"""


@dataclass(frozen=True)
class Known:
    """A machine: the text of its scene, and what is to be found."""

    scene: str
    horizontal: bool
    truth: dict[str, float]
    half_angle: float
    """Half of the angle that a ball takes in the race [rad]."""
    balls: int


@dataclass(frozen=True)
class Found:
    """Values found of one machine, with their intervals, and the checks that do not pass."""

    seed: int
    horizontal: bool
    mark: bool
    truth: dict[str, float]
    values: dict[str, dict[str, float] | None]
    checks: dict[str, str]
    seconds: float
    without_mark: dict[str, Any] | None = field(default=None)


def known_machine(seed: int) -> Known:
    """Machine of a seed: 3–8 kg, 3000–7000 rpm, two to five balls, drag 5–60 1/s, lever arm 0.7–15 µm, Δ 5–20 µm."""
    rng = np.random.default_rng((37, seed))

    def log(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(math.log(low), math.log(high))))

    horizontal = seed % EVERY_VERTICAL != EVERY_VERTICAL - 1
    mass, speed, count = rng.uniform(3, 8), log(3000, 7000), int(rng.integers(2, 6))
    radius, pitch = rng.uniform(5.5, 8.5), rng.uniform(22, 35)
    ball = 7.8e-3 * 4 / 3 * math.pi * radius**3
    natural = 2 * math.pi * rng.uniform(2, 4)
    drag, run_up = log(5, 60), log(0.3, 1.2)
    half = math.asin(radius / pitch)
    angles = [-90 + math.degrees(2.0002 * half) * (k - (count - 1) / 2) for k in range(count)]
    scene = SCENE.format(
        mass=mass, stiffness=mass * natural**2, damping=2 * rng.uniform(0.3, 0.6) * mass * natural, speed=speed,
        imbalance=count * ball * pitch * rng.uniform(0.25, 0.6), duration=run_up + min(max(2.0, 40 / drag), 6.0),
        pitch=pitch, masses=[round(ball, 4)] * count, radius=radius, angles=[round(a, 4) for a in angles],
        gravity="gravity = {}" if horizontal else "", run_up=run_up,
    )  # fmt: skip
    lever = log(0.7, 15)
    truth = dict(zip(NAMES, (drag, lever * 1e-3, rng.uniform(5, 20) * 1e-3, rng.uniform(-180, 180)), strict=True))
    return Known(scene, horizontal, truth, half, count)


def recordings(known: Known, path: Path, seed: int, *, mark: bool = True) -> Iterator[str]:
    """Files of the starts of a machine."""
    drag, lever, size, angle = (known.truth[name] for name in NAMES)
    offset = size * 1e-3 * complex(math.cos(math.radians(angle)), math.sin(math.radians(angle)))
    for k in range(STARTS):
        rng = np.random.default_rng((73, seed, k))
        room = 2 * math.pi - 2.001 * known.half_angle * known.balls
        gaps = np.sort(rng.uniform(0, room, known.balls)) + 2.001 * known.half_angle * np.arange(known.balls)
        angles = None if known.horizontal else tuple(map(float, rng.uniform(0, 2 * math.pi) + gaps))
        file = path.with_name(f"{path.stem}-{k}.csv")
        yield record(
            path, file, drag, lever * 1e-3, offset, 1000 * seed + k, angles=angles, engine=ENGINE, mark=mark
        )  # fmt: skip


def without_column(file: str) -> str:
    """A copy of a recording without its mark."""
    path = Path(file)
    lines = path.read_text(encoding="utf-8").splitlines()
    copy = path.with_name(f"{path.stem}-no-mark.csv")
    copy.write_text("\n".join(line.rpartition(",")[0] for line in lines) + "\n", encoding="utf-8")
    return str(copy)


def identified(path: Path, files: Sequence[str]) -> dict[str, Any]:
    """What `identify` tells of recordings: values, checks that do not pass, seconds."""
    begin = time.perf_counter()
    result = abu_calc.identify(read_any(str(path)), files)
    values = {name: None if (value := getattr(result, name)) is None else asdict(value) for name in NAMES}
    checks = {check.code: check.status for check in result.checks if check.status != "pass"}
    return {"values": values, "checks": checks, "seconds": round(time.perf_counter() - begin, 1)}


def found(seed: int, folder: Path) -> Found:
    """Record a machine, and identify it."""
    known = known_machine(seed)
    path = folder / f"machine{seed}.toml"
    path.write_text(known.scene, encoding="utf-8")
    files = list(recordings(known, path, seed))
    blind = identified(path, [without_column(file) for file in files]) if seed % EVERY_WITHOUT_MARK == 0 else None
    return Found(seed, known.horizontal, True, known.truth, **identified(path, files), without_mark=blind)


def off(name: str, value: float, truth: float) -> float:
    """Difference from the truth: a logarithm of drag and lever arm; µm; degrees."""
    if name in NAMES[:2]:
        return math.log(value / truth)
    return (value - truth) * 1e3 if name == NAMES[2] else (value - truth + 180) % 360 - 180


def holds(name: str, interval: dict[str, float], truth: float) -> bool:
    """True if an interval holds the truth; one of an angle on the circle."""
    shift = off(name, truth, interval["value"]) if name == NAMES[3] else truth - interval["value"]
    return interval["low"] - interval["value"] <= shift <= interval["high"] - interval["value"]


def summary(machines: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Counts, rms differences and the share of intervals that hold the truth, of rows with truth and values."""
    told: dict[str, Any] = {"machines": len(machines)}
    pairs = {
        name: [(row["truth"][name], row["values"][name]) for row in machines if row["values"][name] is not None]
        for name in NAMES
    }
    for name, of_name in pairs.items():
        if of_name:
            apart = [off(name, value["value"], truth) for truth, value in of_name]
            told[name] = {
                "given": len(of_name), "rms": round(float(np.sqrt(np.mean(np.square(apart)))), 4),
                "median": round(float(np.median(np.abs(apart))), 4),
                "largest": round(float(np.max(np.abs(apart))), 4),
                "held": int(sum(holds(name, value, truth) for truth, value in of_name)),
            }  # fmt: skip
    told["intervals"] = sum(len(of_name) for of_name in pairs.values())
    told["held"] = sum(part["held"] for part in told.values() if isinstance(part, dict))
    told["ABU1107"] = sum("ABU1107" in row["checks"] for row in machines)
    return told


def summaries(machines: Sequence[Found]) -> dict[str, Any]:
    """Summaries of horizontal and vertical spindles, with mark and without."""
    rows = [asdict(each) for each in machines]
    parts = {"horizontal": [row for row in rows if row["horizontal"]]}
    parts["vertical"] = [row for row in rows if not row["horizontal"]]
    blind = {
        f"{name}, no mark": [{**row, **row["without_mark"]} for row in own if row["without_mark"]]
        for name, own in parts.items()
    }
    return {name: summary(own) for name, own in {**parts, **blind}.items() if own}


def main() -> None:
    """Print each machine, and keep the record."""
    count, first = (int(sys.argv[k]) if len(sys.argv) > k else value for k, value in ((1, 40), (2, 0)))
    lines = Path(sys.argv[3]) if len(sys.argv) > 3 else LINES
    kept = lines.read_text(encoding="utf-8").splitlines() if lines.exists() else []
    done = {each.seed: each for each in (Found(**json.loads(line)) for line in kept)}
    with tempfile.TemporaryDirectory() as folder, lines.open("a", encoding="utf-8") as file:
        for seed in range(first, first + count):
            if seed not in done:
                done[seed] = found(seed, Path(folder))
                text = json.dumps(asdict(done[seed]))
                print(text, flush=True)
                print(text, file=file, flush=True)
    machines = [done[seed] for seed in range(first, first + count)]
    cases = {"summary": summaries(machines), "machines": [asdict(each) for each in machines]}
    print(json.dumps(cases["summary"], indent=1))
    if count >= ENOUGH:
        what = "known machines recorded by another integrator, and what is identified of them"
        command = "python -m tests.studies.identification"
        print(keep("identification", what, command, machine("not bound"), first, cases))


if __name__ == "__main__":
    main()
