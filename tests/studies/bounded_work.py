"""Whether every command ends: random machines at work and scenes with every effect, by seconds of processor time.

    python -m tests.studies.bounded_work [count] [first] [lines]

Each command runs in a process of its own that ends after `MOST` seconds. Lines of an earlier run are kept.
"""

import json
import os
import resource
import signal
import sys
import tempfile
import time
import tomllib
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np

import abu_calc
from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.scene import Scene, placed
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.foundation.errors import AbuError
from abu_calc.foundation.progress import silent
from abu_calc.simulation.simulate import simulate
from tests.dynamics.random_scenes import Dice, random_scene
from tests.studies.random_machines import family_of, machine_text

MOST: Final = 150
"""Seconds of processor time after which a command is ended."""
ASKED: Final = 60.0
"""Seconds of processor time that no command may take at the default accuracy."""
PRESETS: Final = Path(__file__).parents[2] / "presets"
PRESET_RACES: Final = "pedestal-grinder", "washing-machine-two-races"


def working_machine(seed: int) -> dict[str, Any]:
    """A random machine that grinds: by its face with axial runout, on a soft or a rigid contact; every tenth has two
    races.
    """
    rng = np.random.default_rng((seed, 53))

    def log(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))

    if seed % 10 == 9:
        file = tomllib.loads((PRESETS / f"{PRESET_RACES[seed // 10 % 2]}.toml").read_text(encoding="utf-8"))
        del file["expected"]
        file["machine"]["speed_rpm"] *= log(0.6, 1.6)
        friction = log(0.0003, 0.03)
        for race in file["autobalancer"]:
            race["rolling_drag_per_s"] = log(1, 100)
            race["rolling_friction_mm"] = friction
        for wheel in file["wheel"]:
            wheel["imbalance_g_mm"] *= log(0.2, 2)
        return file
    file = tomllib.loads(machine_text(seed, family_of(seed)))
    contact = str(rng.choice(["face", "compliant", "rigid"]))
    file["grinding"] = {"contact": contact, "press_force_N": log(10, 150), "cutting_coefficient": rng.uniform(0.1, 0.5)}
    if contact == "compliant":
        file["grinding"]["contact_stiffness_N_per_m"] = log(2e4, 1e7)
    file["wheel"]["runout_mm"] = log(0.01, 0.3)
    if rng.random() < 0.7:
        file["wheel"]["axial_runout_mm"] = log(0.005, 1.0)
    if rng.random() < 0.3:
        file["autobalancer"]["rolling_friction_mm"] = log(0.002, 0.05)
    if rng.random() < 0.3:
        file["autobalancer"]["rolling_drag_per_s"] = log(0.1, 1000)
    return file


def commands(seed: int) -> Iterator[tuple[str, Callable[[], object]]]:
    """What is asked of the machine of a seed: its simulations, and of each fifth machine its design or its work."""
    file = working_machine(seed)
    machine = abu_calc.read(file)
    scenes = ("swing-arm-idle", "swing-arm-cutting") if "swing_arm" in file else ("grinding",)
    for scene in ("idle",) if machine.spindle is not None else scenes:
        yield f"simulate {scene}", lambda scene=scene: abu_calc.simulate(machine, scene)
    if seed % 5 in (0, 4):
        yield "size", lambda: abu_calc.size(machine)
    if seed % 5 == 1:
        yield "grinding", lambda: abu_calc.grinding(machine)


def scene_with_every_effect(seed: int) -> Scene:
    """A random scene with gravity, contact of balls, friction, an eccentric race and, off the arm, grinding and balls
    that roll across their race.
    """
    scene, dice = random_scene(seed), Dice(np.random.default_rng((seed, 53)))
    race, radius = scene.races[0], scene.races[0].ball_radius
    effects = [effect for effect in scene.effects if effect.name in ("run_up", "motor")]
    effects += [RaceEccentricityEffect(race.pitch_radius * dice.log(1e-5, 1e-2), dice.even(-3, 3))]
    if not isinstance(scene.support, SwingArmSupport):
        way = race.pitch_radius * dice.log(1e-5, 1e-2)
        effects += [TransverseMotionEffect(race.pitch_radius * dice.even(0.6, 1), radius, way, dice.often(0.3))]
    effects += [GravityEffect()]
    if not isinstance(scene.support, SwingArmSupport):
        pull = scene.imbalance * scene.speed**2
        effects += [GrindingContactEffect(
            press_force=pull * dice.log(0.03, 3), cutting_coefficient=dice.even(0, 0.5), contact="compliant",
            contact_stiffness=pull / race.pitch_radius * dice.log(1, 1e3), rotation_sense=-1,
            runout=race.pitch_radius * dice.log(1e-5, 1e-2), runout_angle=dice.even(-3, 3),
            wheel_radius=2 * race.pitch_radius, plane_offset=0.0,
        )]  # fmt: skip
    effects += [BallContactEffect(radius, dice.even(0, 1))]
    effects += [DryRollingFrictionEffect(radius * dice.log(1e-6, 1e-2), radius)]
    return placed(replace(scene, effects=tuple(effects)))


def ended(ask: Callable[[], object]) -> tuple[float, str]:
    """Processor seconds of a command in a process of its own, and how it ended."""
    read, write = os.pipe()
    if not (child := os.fork()):
        os.close(read)
        resource.setrlimit(resource.RLIMIT_CPU, (MOST, MOST))
        try:
            result = ask()
            how = str(getattr(result, "status", "done"))
        except AbuError as error:
            how = f"{type(error).__name__}: {str(error).splitlines()[0]}"
        except BaseException as error:
            how = f"BUG {type(error).__name__}: {error}"
        os.write(write, how.encode()[:2000])
        os._exit(0)
    os.close(write)
    with os.fdopen(read, "rb") as pipe:
        how = pipe.read().decode(errors="replace")
    _, status, usage = os.wait4(child, 0)
    if os.WIFSIGNALED(status):
        how = f"no end ({signal.Signals(os.WTERMSIG(status)).name})"
    return usage.ru_utime + usage.ru_stime, how


def asked(seed: int) -> Iterator[tuple[str, Callable[[], object]]]:
    """All commands of a seed, and its scene."""
    try:
        yield from commands(seed)
    except AbuError as error:
        print(seed, "refused", error, file=sys.stderr)
    scene = scene_with_every_effect(seed)
    yield "scene", lambda: simulate(scene, progress=silent)


def main() -> None:
    """Print each command, and those that take too long."""
    count, first = (int(sys.argv[k]) if len(sys.argv) > k else value for k, value in ((1, 300), (2, 0)))
    lines = Path(sys.argv[3] if len(sys.argv) > 3 else Path(tempfile.gettempdir()) / "bounded-work.jsonl")
    known = [json.loads(line) for line in lines.read_text().splitlines()] if lines.exists() else []
    done = {(row["seed"], row["command"]) for row in known}
    with lines.open("a") as file:
        for seed in range(first, first + count):
            for name, ask in asked(seed):
                if (seed, name) in done:
                    continue
                began = time.perf_counter()
                seconds, how = ended(ask)
                row = {"seed": seed, "command": name, "cpu_s": round(seconds, 2), "how": how,
                       "wall_s": round(time.perf_counter() - began, 1)}  # fmt: skip
                known.append(row)
                print(json.dumps(row), file=file, flush=True)
                if seconds > ASKED / 3:
                    print(json.dumps(row), flush=True)
    slow = [row for row in known if row["cpu_s"] > ASKED]
    print(f"{len(known)} commands, {len(slow)} above {ASKED:g} s, longest {max(row['cpu_s'] for row in known):g} s")


if __name__ == "__main__":
    main()
