"""Trial of compiled code on a system that nobody has tried, once, in a process that may crash.

An error of a compiler may end the process that runs its code. So a separate process compiles a scene
with friction and contact, and compares it with the same loop in plain Python. Its success is recorded
in the folder of compiled code.
"""

import hashlib
import math
import subprocess
import sys
from functools import cache
from typing import Final

from abu_calc.dynamics.integrators.compiled import machine
from abu_calc.dynamics.integrators.compiled.cache import Cache
from abu_calc.version import __version__

TRIED: Final = ("linux",)
"""Systems on which compiled code has run in tests."""

PASSED: Final = b"compiled code gave what plain code did"
LONGEST: Final = 60.0
"""Seconds after which the trial is given up."""


@cache
def passed() -> None:
    """Raise CompilerError unless the trial was passed, now or before, or is not needed here."""
    if sys.platform in TRIED:
        return
    folder, key = Cache.own(), hashlib.sha256(f"{__version__} {machine.described()}".encode()).hexdigest()
    if folder.read(key) is None:
        with machine.guarded("its trial"):
            words = [sys.executable, "-m", __name__]
            seen = subprocess.run(words, capture_output=True, timeout=LONGEST, check=False)
        folder.write(key, PASSED if seen.returncode == 0 else f"it ended with status {seen.returncode}".encode())
    record = folder.read(key)
    if record != PASSED:
        raise machine.CompilerError(f"its trial: {'cannot be kept' if record is None else record.decode()}")


def main() -> None:
    """Exit with 0 when compiled and plain code agree on a scene by both methods."""
    import numpy as np

    from abu_calc.dynamics.effects.ball_contact import BallContact
    from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFriction
    from abu_calc.dynamics.effects.gravity import Gravity
    from abu_calc.dynamics.equations.assemble import assemble
    from abu_calc.dynamics.integrators.compiled.kernels import METHODS
    from abu_calc.dynamics.integrators.compiled.run import integrate
    from abu_calc.dynamics.race import Race
    from abu_calc.dynamics.scene import Scene
    from abu_calc.dynamics.supports.planar import planar

    race = Race(0.023, (0.016, 0.016), 15.0, 1.4, (0.4, 1.2), (0.0, 0.0))
    scene = Scene(
        name="trial", support=planar(6.0, (1500.0, 1500.0), (95.0, 95.0)), speed=600.0, imbalance=250e-6,
        imbalance_angle=0.0, races=(race,), duration=0.2, start_position=(0.0, 0.0), start_velocity=(0.0, 0.0),
        effects=(Gravity(), BallContact(0.008, 0.5), DryRollingFriction(2e-6, 0.008)),
    )  # fmt: skip
    equations = assemble(scene)
    units = np.array(equations.scales)[:, None] * math.sqrt(1e-6)
    for method in METHODS:
        fast, plain = (
            integrate(equations, 1e-6, [0.1, 0.2], compiled=compiled, method=method) for compiled in (True, False)
        )
        if not (fast.events == plain.events > 0 and bool(np.all(np.abs(fast.y - plain.y) < units))):
            sys.exit(1)


if __name__ == "__main__":
    main()
