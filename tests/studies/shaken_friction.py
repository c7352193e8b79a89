"""Residuals of horizontal spindles whose balls gravity shakes: those told by the product against runs to their end by
equations of motion that share nothing with it.

    pip install numba
    python -m tests.studies.shaken_friction [machines] [first] [file of lines]

Held machines at random are laid horizontal. Their lever arm of rolling friction is set so that friction is 0.2 to 4
times gravity. Each is sized and switched on 14 times: balls anywhere, turning or not, and run-ups. The largest residual
displacement of its race is compared with the worst residual of `sizing.vibration`, which counts gravity by
`formulas.friction_band.remaining_band`. A machine above it is on the unsafe side. Runs in which a ball stalls say
nothing about friction and are left out. `remaining_band` was chosen by seeds below 32.
"""

import json
import math
import re
import sys
import tempfile
import tomllib
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from abu_calc.inputs.read_machine import read_machine
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from tests.benchmarks.measuring import keep, machine
from tests.studies.outside_equations import COMPILED
from tests.studies.outside_runs import GRAVITY, ended, starts
from tests.studies.random_machines import held_text

FRESH: Final = 100
"""First seed that had no part in the choice of the formula."""
ANYWHERE, RUN_UPS = 10, 4
FRICTION_NUMBERS: Final = (0.2, 4.0)
LEVERS: Final = (5e-8, 2e-5)
"""Lever arms of rolling friction that balls in a race have [m]; other machines are left out."""
LENGTH: Final = 3.0
"""Settling times permitted that runs last at most."""
REFERENCE: Final = 5e-8
"""Velocity of 0 dB [m/s]."""
MARGINS: Final = (0.05, 0.10)
STALLED: Final = 0.05
"""Revolutions of a ball against its race in one of the race."""


@dataclass(frozen=True)
class Comparison:
    """Worst residual told and the largest and median seen [um] of one machine."""

    seed: int
    friction_number: float
    ball_count: int
    speed_rpm: float
    told_um: float
    told_vertical_um: float
    largest_um: float
    median_um: float
    stalled: int

    @property
    def above(self) -> float:
        """Share by which the largest residual seen is above the one told; negative: below, the safe side."""
        return self.largest_um / self.told_um - 1


def compared(seed: int, folder: Path) -> Comparison | str:
    """Run a machine to its end; in words why it is left out."""
    text, design, number = horizontal_machine(seed, folder / f"machine-{seed}.toml")
    balls, lever = design.autobalancer, design.case.friction_arm
    if not design.frequency.balancing_possible or balls.budget.capacity_shortfall:
        return "balls cannot balance"
    if not LEVERS[0] < lever < LEVERS[1]:
        return f"lever arm {lever * 1e3:.2g} mm"
    file, told = tomllib.loads(text), design.worst[-1]
    result, limit = _result(design), file["limits"]["settling_time_s"]
    endings = [ended(start, result, limit, longest=LENGTH) for start in starts(file, result, seed, ANYWHERE, RUN_UPS)]
    seen = [
        1e6 * math.sqrt(2) * REFERENCE * 10 ** (ending.level / 20) / design.case.speed
        for ending in endings
        if ending.slip < STALLED
    ]
    if not seen:
        return "balls stall in every run"
    return Comparison(
        seed, number, balls.ball_count, design.case.speed * 30 / math.pi, 1e6 * told.residual,
        1e6 * told.upright.residual, max(seen), float(np.median(seen)), len(endings) - len(seen),
    )  # fmt: skip


def horizontal_machine(seed: int, path: Path) -> tuple[str, Design, float]:
    """File of a machine, the design of this very file, and its friction number.

    The lever arm follows the balls that are chosen with it, for three steps. The number is near the one drawn.
    """
    low, high = map(math.log, FRICTION_NUMBERS)
    drawn = math.exp(np.random.default_rng(seed + 77).uniform(low, high))
    text = held_text(seed).replace('spindle_axis = "vertical"', 'spindle_axis = "horizontal"')
    for steps_left in (3, 2, 1, 0):
        path.write_text(text, encoding="utf-8")
        design = size(read_machine(str(path)).whole("size"))
        balls, case = design.autobalancer, design.case
        unit = balls.ball_diameter / 2 * GRAVITY / (balls.pitch_radius * case.speed**2)
        if not steps_left or math.isclose(drawn * unit, case.friction_arm, rel_tol=1e-3):
            break
        text = re.sub(r"rolling_friction_mm = .*", f"rolling_friction_mm = {1e3 * drawn * unit:.6g}", text)
    return text, design, case.friction_arm / unit


def _result(design: Design) -> dict[str, Any]:
    """The numbers of a design by the names in the result of `abu size`; no start case of the product is run."""
    balls = design.autobalancer
    return {
        "autobalancer": {
            "ball_count": balls.ball_count, "ball_mass_g": balls.ball_mass * 1e3, "mass_g": balls.mass * 1e3,
            "pitch_radius_mm": balls.pitch_radius * 1e3, "ball_diameter_mm": balls.ball_diameter * 1e3,
        },
        "imbalance_g_mm": design.imbalance.value * 1e6,
        "effective_mass_kg": balls.requirement.effective_mass,
        "accuracy_budget": {
            "rolling_friction_um": balls.budget.rolling_friction * 1e6,
            "rolling_friction_vertical_um": design.worst[-1].upright.rolling_friction * 1e6,
        },
    }  # fmt: skip


def summary(found: list[Comparison]) -> dict[str, Any]:
    """Machines above the residual told, by more than each margin, and how far below it they are."""
    above = sorted(one.above for one in found)
    return {
        "machines": len(found),
        "above": sum(share > 0 for share in above),
        **{f"above_by_more_than_{100 * margin:g}_percent": sum(s > margin for s in above) for margin in MARGINS},
        **{f"within_{100 * margin:g}_percent": sum(abs(s) <= margin for s in above) for margin in MARGINS},
        "highest": above[-1], "median": float(np.median(above)), "lowest": above[0],
    }  # fmt: skip


def main() -> None:
    """Print each machine, and keep the record."""
    count, first = (int(sys.argv[k]) if len(sys.argv) > k else value for k, value in ((1, 30), (2, FRESH)))
    lines = Path(sys.argv[3] if len(sys.argv) > 3 else Path(tempfile.gettempdir()) / "shaken-friction.jsonl")
    if not COMPILED:
        print("numba is not installed: the equations run as plain Python, for days. pip install numba", file=sys.stderr)
    known = {}
    if lines.exists():
        known = {entry["seed"]: entry for entry in map(json.loads, lines.read_text(encoding="utf-8").splitlines())}
    found, left_out, seed = list[Comparison](), dict[str, str](), first
    with tempfile.TemporaryDirectory() as folder, lines.open("a", encoding="utf-8") as file:
        while len(found) < count:
            if seed not in known:
                outcome = compared(seed, Path(folder))
                known[seed] = {"seed": seed, "why": outcome} if isinstance(outcome, str) else asdict(outcome)
                print(json.dumps(known[seed]), file=file, flush=True)
            if "why" in known[seed]:
                left_out[str(seed)] = known[seed]["why"]
            else:
                found.append(Comparison(**known[seed]))
                print(f"{seed}: {100 * found[-1].above:+.0f} %", flush=True)
            seed += 1
    machines = [asdict(one) | {"above": one.above} for one in found]
    cases = {"summary": summary(found), "machines": machines, "left_out": left_out}
    print(json.dumps(cases["summary"]))
    what = "worst residual told of horizontal spindles with dry friction, against runs by outside equations"
    print(keep("shaken-friction", what, "python -m tests.studies.shaken_friction", machine("not bound"), first, cases))


if __name__ == "__main__":
    main()
