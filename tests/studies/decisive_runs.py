"""The start that decides a warning or a failure of `abu size`, and its neighbours, for the outside equations.

The options of `abu simulate` that the result gives are read here anew.
"""

import copy
import math
import shlex
import tomllib
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, Final

import numpy as np

from tests.studies.outside_runs import GRAVITY, Json, Start, machine_of

NEIGHBOURS: Final = 20
MIDDLE: Final = {"behind": -20.0}
"""Angle [deg] of the middle of balls that touch, from the imbalance; 20° for the other starts."""


def decisive_starts(file: Json, result: Json, seed: int) -> Iterator[Start]:
    """The decisive start, then its neighbours: ball angles within 3°, race centre within 10°, eccentricity and
    imbalance up to 5 and 2 % less; if more than the promised band varies, drag and friction within 3 %, too.
    """
    rng, decisive = np.random.default_rng(30_000 + seed), result["ensemble"]["worst_run"]
    start, of_file = _decisive(file, result, decisive["options"]), machine_of(file, result)
    of_file = of_file._replace(gravity=start.machine.gravity)
    yield replace(start, of_file=of_file)
    for _ in range(NEIGHBOURS):
        p, less = start.machine, rng.uniform(0.98, 1)
        p = p._replace(
            offset=p.offset * rng.uniform(0.95, 1), offset_angle=p.offset_angle + math.radians(rng.uniform(-10, 10)),
            imbalance=p.imbalance * less, carried=p.carried * less,
        )  # fmt: skip
        if not decisive["promised"]:
            p = p._replace(drag=p.drag * rng.uniform(0.97, 1.03), friction=p.friction * rng.uniform(0.97, 1.03))
        angles = _apart(np.array(start.angles) + np.radians(rng.uniform(-3, 3, p.balls)), p.gap)
        yield replace(start, machine=p, angles=angles, of_file=of_file, kind=f"beside {start.kind}")


def _decisive(file: Json, result: Json, options: str) -> Start:
    words = shlex.split(options)
    given = {words[k]: words[k + 1] for k in range(0, len(words), 2) if words[k] != "--set"}
    changed: dict[str, Any] = copy.deepcopy(dict(file))
    for k in range(0, len(words), 2):
        if words[k] == "--set":
            key, value = words[k + 1].split("=", 1)
            table, name = key.split(".")
            word = value[:1].isalpha() and value not in ("true", "false", "inf", "nan")
            changed.setdefault(table, {})[name] = value if word else tomllib.loads(f"value = {value}")["value"]
    imbalance = changed["wheel"].get("imbalance_g_mm", result["imbalance_g_mm"])
    machine = machine_of(changed, {**result, "imbalance_g_mm": imbalance})
    machine = machine._replace(
        offset_angle=math.radians(float(given["--race-centre"])),
        gravity=GRAVITY if changed["machine"]["spindle_axis"] == "horizontal" else 0.0,
    )
    n, kind, starts = machine.balls, given.get("--start", "bunched"), changed.get("start", {})
    middle = math.radians(MIDDLE.get(kind, 20.0))
    touching = [middle + (k - (n - 1) / 2) * machine.gap for k in range(n)]
    spread = [middle + math.tau * k / n for k in range(n)]
    named = spread if kind == "spread" else touching
    angles = [math.radians(one) for one in starts["angles_deg"]] if "angles_deg" in starts else named
    if given.get("--scene") == "run-up":
        ramp = changed["run_up"]["time_s"]
        return Start("run-up", machine._replace(ramp=ramp), _apart(angles, machine.gap), (0.0,) * n, 0.0, ramp)
    lags = starts.get("speeds_rpm", [0.0] * n)
    speeds = [0.0 if kind == "standstill" else machine.speed + lag * math.tau / 60 for lag in lags]
    return Start(kind, machine, _apart(angles, machine.gap), tuple(speeds))


def _apart(angles: Any, gap: float) -> tuple[float, ...]:
    """The angles with neighbours no nearer than touching, in their order round the race."""
    parted, order = np.array(angles, dtype=float), np.argsort(np.mod(angles, math.tau))
    for _ in range(200):
        for k in range(len(order)):
            a, b = order[k], order[(k + 1) % len(order)]
            lacks = gap * 1.0001 - math.fmod(parted[b] - parted[a] + 2 * math.tau, math.tau)
            if len(order) > 1 and 0 < lacks < gap:
                parted[[a, b]] += -lacks / 2, lacks / 2
    return tuple(parted)
