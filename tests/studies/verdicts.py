"""Whether a PASS holds: machines at random, sized, then switched on in ways that sizing did not try.

    python -m tests.studies.verdicts [machines] [first]

Of machines that pass without a warning on level, balancing, settling and hanging, the full model is run from random
starts (balls anywhere in the race, turning or not) and by random run-ups; what exceeds a limit or hangs is counted.
"""

import json
import math
import sys
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from abu_calc.analysis.covering import with_searched
from abu_calc.analysis.ensemble import ALWAYS, outcome_of
from abu_calc.analysis.idle import ensemble_checks, level_check
from abu_calc.analysis.ledger import chosen
from abu_calc.analysis.outcomes import Outcome
from abu_calc.analysis.proven import proven
from abu_calc.analysis.response import evaluate, needed_times
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.errors import AbuError
from abu_calc.scenes.from_design import contact_half_angle
from abu_calc.scenes.members import Member, scene_of_member
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from abu_calc.spec.read import read_machine
from tests.benchmarks.measuring import keep, machine

STARTS, RUN_UPS = 50, 20
TOLERANCE = 1e-4
WORK = 1_000_000
CODES = "ABU401", "ABU701", "ABU702", "ABU704"


@dataclass(frozen=True)
class Verdict:
    """One machine: what `abu size` says of it, and of how many further runs so many broke the promise."""

    seed: int
    status: str
    runs: int = 0
    broken: int = 0
    without: int = 0
    """Runs that gave no answer."""
    how: str = ""


def machine_text(seed: int) -> str:
    """A plausible hand-held machine: 1–10 kg, 3000–20 000 rpm, both axes, four suspensions, drags 3–60 1/s."""
    rng = np.random.default_rng(seed)

    def log(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(math.log(low), math.log(high))))

    mass, speed = log(1, 10), log(3000, 20000)
    springs = [
        ([rng.uniform(2, 4)], 0.5),
        ([log(5, 12), log(8, 20)], 0.2),
        ([log(10, 30)], log(0.02, 0.2)),
    ]
    hertz, damping = springs[rng.integers(3)]
    frequencies = ", ".join(f"{one:.3g}" for one in hertz)
    held = f'model = "springs"\nnatural_frequencies_hz = [{frequencies}]\ndamping_ratios = [{damping:.2g}]'
    suspension = 'model = "hands"' if rng.random() < 0.25 else held
    wheel = 0.3 * log(100, 230) / 100
    return f"""
[machine]
name = "machine {seed}"
layout = "straight"
mass_kg = {mass:.4g}
speed_rpm = {speed:.5g}
spindle_axis = "{rng.choice(["horizontal", "vertical"])}"
[suspension]
{suspension}
[wheel]
mass_kg = {min(wheel, mass / 4):.3g}
diameter_mm = {min(230, 1.5e6 / speed):.4g}
measured_level_db = {rng.uniform(112, 124):.4g}
[autobalancer]
max_outer_diameter_mm = {rng.uniform(60, 100):.3g}
max_width_mm = {rng.uniform(15, 35):.3g}
max_mass_fraction = 0.08
bore_diameter_mm = 12
rolling_drag_per_s = {log(3, 60):.3g}
rolling_friction_mm = {log(0.0005, 0.004):.2g}
race_eccentricity_mm = {log(0.003, 0.015):.2g}
[run_up]
time_s = {log(0.3, 3):.2g}
[limits]
vibration_level_db = 109.0
settling_time_s = {rng.choice([1.0, 2.0])}
"""


def judged(seed: int, folder: Path) -> Verdict:
    """Size the machine, and try to break what it promises."""
    file = folder / f"machine-{seed}.toml"
    file.write_text(machine_text(seed), encoding="utf-8")
    try:
        found = proven(size(read_machine(str(file)).whole("size")))
    except AbuError as error:
        return Verdict(seed, f"refused: {str(error).splitlines()[0]}")
    design, ensemble = found.design, found.ensemble
    checks = [level_check(one, ensemble) if one.code == "ABU401" else one for one in design.checks]
    checks += ensemble_checks(design, ensemble)
    statuses = {one.code: with_searched(one, found.searched, design).status for one in checks}
    if "fail" in statuses.values() or "not-done" in statuses.values():
        return Verdict(seed, "fail: " + " ".join(code for code, status in statuses.items() if status != "pass"))
    if any(statuses[code] == "warn" for code in CODES):
        return Verdict(seed, "warn")
    return tried(design, seed)


def tried(design: Design, seed: int) -> Verdict:
    """Random starts and run-ups of a machine that passes."""
    rng, limits = np.random.default_rng(10_000 + seed), design.case.table.limits
    broken, without, how = 0, 0, []
    for member, scene in _starts(design, rng):
        one = _run(design, member, scene)
        if one is None:
            without += 1
        elif not one.balanced or one.time > limits.settling_time_s or one.level > design.case.level_limit:
            broken += 1
            how.append(f"{member.name}: slip {one.slip:.2f}, left {one.imbalance / one.allowed:.2f}, "
                       f"{one.time:.2f} s, {one.level:.1f} dB")  # fmt: skip
    return Verdict(seed, "pass", STARTS + RUN_UPS, broken, without, "; ".join(how[:3]))


def _starts(design: Design, rng: np.random.Generator) -> Iterator[tuple[Member, Scene]]:
    drag, count, half = design.case.drag, design.autobalancer.ball_count, contact_half_angle(design)
    for _ in range(STARTS):
        member = Member("standstill", drag)
        scene = scene_of_member(design, member)
        # Anywhere without overlap: gaps beside the balls' own share it evenly.
        gaps = rng.dirichlet(np.ones(count)) * (2 * math.pi - count * 2 * half * 1.001)
        angles = rng.uniform(0, 2 * math.pi) + np.cumsum(gaps + 2 * half * 1.001)
        slow = float(rng.choice([0.0, -1.0, -rng.uniform()])) * design.case.speed
        race = replace(scene.races[0], start_angles=tuple(angles.tolist()), start_speeds=(slow,) * count)
        yield member, replace(scene, races=(race,))
    for _ in range(RUN_UPS):
        member = Member("bunched", drag, round(float(np.exp(rng.uniform(math.log(0.3), math.log(8)))), 2))
        yield member, scene_of_member(design, member)


def _run(design: Design, member: Member, full: Scene) -> Outcome | None:
    scene, _ = with_parted_balls(chosen(full, 0.01, ALWAYS).scene)
    try:
        equations = assemble(scene)
        choice = choose(equations, "auto", TOLERANCE)
        run = choice.integrate(equations, TOLERANCE, needed_times(scene), choice.evaluations(WORK))
        return outcome_of(design, member, scene, evaluate(scene, run))
    except AbuError:
        return None


def summary(verdicts: list[Verdict]) -> dict[str, Any]:
    """Counts, and the worst machines."""
    passed = [one for one in verdicts if one.status == "pass"]
    runs, broken = sum(one.runs for one in passed), sum(one.broken for one in passed)
    return {
        "machines": len(verdicts), "pass": len(passed), "warn": sum(one.status == "warn" for one in verdicts),
        "fail": sum(one.status.startswith("fail") for one in verdicts),
        "refused": sum(one.status.startswith("refused") for one in verdicts),
        "runs": runs, "broken": broken, "share": broken / max(runs, 1), "without": sum(one.without for one in passed),
        "most_of_one": max((one.broken / one.runs for one in passed), default=0.0),
    }  # fmt: skip


def main() -> None:
    """Print each machine, and keep the record."""
    import tempfile

    count, first = (int(sys.argv[k]) if len(sys.argv) > k else value for k, value in ((1, 400), (2, 0)))
    verdicts = []
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + count):
            verdicts.append(judged(seed, Path(folder)))
            print(json.dumps(asdict(verdicts[-1])), flush=True)
    cases = {"summary": summary(verdicts), "broken": [asdict(one) for one in verdicts if one.broken]}
    print(cases["summary"])
    what = "machines that pass, switched on in ways that sizing did not try"
    print(keep("verdicts", what, "python -m tests.studies.verdicts", machine("not bound"), first, cases))


if __name__ == "__main__":
    main()
