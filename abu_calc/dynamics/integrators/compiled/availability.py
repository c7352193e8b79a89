"""Readiness of compiled code: whether it runs on this system, and whether that of a scene is ready to run.

An error of a compiler may end the process that runs its code. So a system that nobody has tried is tried once, in a
separate process (`main`). It compiles a scene with friction and contact, and compares it with the same loop in plain
Python. Its success is recorded in the folder of compiled code.
"""

import hashlib
import math
import subprocess
import sys
import warnings
from functools import cache
from typing import Final

from abu_calc.dynamics.equations.assemble import Equations
from abu_calc.dynamics.integrators.compiled import code, llvm_engine
from abu_calc.dynamics.integrators.compiled.kernels import Method
from abu_calc.dynamics.integrators.compiled.llvm_engine import CompilerError
from abu_calc.dynamics.integrators.compiled.program import in_order
from abu_calc.dynamics.integrators.compiled.run import described, prepared
from abu_calc.foundation.disk_cache import Cache
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
    folder, key = Cache.own(), hashlib.sha256(f"{__version__} {llvm_engine.described()}".encode()).hexdigest()
    if folder.read(key) is None:
        with llvm_engine.guarded("its trial"):
            words = [sys.executable, "-m", __name__]
            seen = subprocess.run(words, capture_output=True, timeout=LONGEST, check=False)
        folder.write(key, PASSED if seen.returncode == 0 else f"it ended with status {seen.returncode}".encode())
    record = folder.read(key)
    if record != PASSED:
        raise llvm_engine.CompilerError(f"its trial: {'cannot be kept' if record is None else record.decode()}")


def main() -> None:
    """Exit with 0 when compiled and plain code agree on a scene by both methods."""
    import numpy as np

    from abu_calc.dynamics.effects.ball_contact import BallContactEffect
    from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
    from abu_calc.dynamics.effects.gravity import GravityEffect
    from abu_calc.dynamics.equations.assemble import assemble
    from abu_calc.dynamics.integrators.compiled.kernels import METHODS
    from abu_calc.dynamics.integrators.compiled.run import integrate
    from abu_calc.dynamics.rotor import Race
    from abu_calc.dynamics.scene import Scene
    from abu_calc.dynamics.supports.planar import planar

    race = Race(0.023, (0.016, 0.016), 15.0, 1.4, (0.4, 1.2), (0.0, 0.0))
    scene = Scene(
        name="trial", support=planar(6.0, (1500.0, 1500.0), (95.0, 95.0)), speed=600.0, imbalance=250e-6,
        imbalance_angle=0.0, races=(race,), duration=0.2, start_position=(0.0, 0.0), start_velocity=(0.0, 0.0),
        effects=(GravityEffect(), BallContactEffect(0.008, 0.5), DryRollingFrictionEffect(2e-6, 0.008)),
    )  # fmt: skip
    equations = assemble(scene)
    units = np.array(equations.scales)[:, None] * math.sqrt(1e-6)
    for method in METHODS:
        fast, plain = (
            integrate(equations, 1e-6, [0.1, 0.2], compiled=compiled, method=method) for compiled in (True, False)
        )
        if not (fast.events == plain.events > 0 and bool(np.all(np.abs(fast.y - plain.y) < units))):
            sys.exit(1)


NOT_INSTALLED = "llvmlite is not installed"

_failures: list[str] = []


def missing() -> str | None:
    """Why no compiled code runs here; None where it runs, as far as is known."""
    if not code.installed():
        return NOT_INSTALLED
    return f"compiled code does not run here ({_failures[0]})" if _failures else None


def loaded(equations: Equations, method: Method) -> bool:
    """True if this process has the code of a scene."""
    _, structure, _ = described(in_order(equations)[0])
    return code.known(structure, method)


def load(equations: Equations, method: Method) -> bool:
    """Make the code of a scene. False, with a warning once, where compiled code does not run on this llvm_engine."""
    if not _failures and code.installed():
        try:
            passed()
            prepared(in_order(equations)[0], method)
        except CompilerError as error:
            _failures.append(str(error))
            warnings.warn(f"compiled code is not used: {error}", RuntimeWarning, stacklevel=3)
    elif not _failures:
        warnings.warn(
            f"compiled code would be some ten times faster, with the same numbers, but {NOT_INSTALLED}: run "
            "pip install llvmlite, where it has a wheel for this system",
            RuntimeWarning,
            stacklevel=3,
        )
    return missing() is None


if __name__ == "__main__":
    main()
