"""abu-calc: design calculator for passive ball autobalancers.

    machine = abu_calc.read("avtovaz-707-222")          # a file, a preset, TOML text, a dictionary
    lighter = machine.changed({"wheel.mass": "500 g"})  # checked as if the file said so
    result = abu_calc.size(lighter)                     # what `abu size` prints, typed
    result.status, result.autobalancer.ball_count, result.checks.to_pandas(), result.to_dict()
    result.save("report.html"), result.save("section.dxf"), print(result.text(full=True))

Each name is imported when it is first used, so that importing the package costs nothing.
"""

import importlib
from typing import TYPE_CHECKING, Final

from abu_calc.version import __version__

if TYPE_CHECKING:
    from abu_calc import units
    from abu_calc.dynamics.rotor import Race
    from abu_calc.dynamics.scene import Scene
    from abu_calc.dynamics.supports.planar import planar
    from abu_calc.features.accuracy.study import AccuracyResult, accuracy
    from abu_calc.features.balancing.read import Readings, read_readings
    from abu_calc.features.balancing.study import BalanceResult, balance
    from abu_calc.features.compare.study import CompareResult, compare
    from abu_calc.features.declare.measured import MeasuredDeclareResult, declare_recordings
    from abu_calc.features.declare.read import Recordings, read_recordings
    from abu_calc.features.declare.study import DeclareResult, declare
    from abu_calc.features.design.study import SizeResult, size
    from abu_calc.features.effects.study import EffectsResult, effects
    from abu_calc.features.factory.study import FactoryResult, factory
    from abu_calc.features.grinding.study import GrindingResult, grinding
    from abu_calc.features.identification.plan import MeasurePlanResult, measure_plan
    from abu_calc.features.identification.results import IdentifyResult
    from abu_calc.features.identification.study import identify
    from abu_calc.features.levels.study import LevelsResult, levels
    from abu_calc.features.optimise.result import OptimiseResult
    from abu_calc.features.optimise.study import optimise
    from abu_calc.features.seats.study import CheckFitResult, check_fit
    from abu_calc.features.simulate.study import SimulateResult, simulate
    from abu_calc.features.spindle.records import TwoRaceGrindingResult, TwoRaceSizeResult
    from abu_calc.features.stability.study import StabilityResult, stability
    from abu_calc.features.sweep.result import SweepResult
    from abu_calc.features.sweep.study import sweep
    from abu_calc.features.verify.study import VerifyResult, verify
    from abu_calc.foundation.checks import Check
    from abu_calc.foundation.errors import AbuError, InputError, NotTrustworthyError, OutputError, RangeError
    from abu_calc.inputs.read_machine import Machine, read
    from abu_calc.inputs.recording import Recording
    from abu_calc.inputs.recording_files import read_recording
    from abu_calc.simulation.scene_file import SceneDescription, read_scene

_ROOMS: Final = {
    "dynamics.rotor": "Race",
    "dynamics.scene": "Scene",
    "dynamics.supports.planar": "planar",
    "features.accuracy.study": "AccuracyResult accuracy",
    "features.balancing.read": "Readings read_readings",
    "features.balancing.study": "BalanceResult balance",
    "features.compare.study": "CompareResult compare",
    "features.declare.measured": "MeasuredDeclareResult declare_recordings",
    "features.declare.read": "Recordings read_recordings",
    "features.declare.study": "DeclareResult declare",
    "features.design.study": "SizeResult size",
    "features.effects.study": "EffectsResult effects",
    "features.factory.study": "FactoryResult factory",
    "features.grinding.study": "GrindingResult grinding",
    "features.identification.plan": "MeasurePlanResult measure_plan",
    "features.identification.results": "IdentifyResult",
    "features.identification.study": "identify",
    "features.levels.study": "LevelsResult levels",
    "features.optimise.result": "OptimiseResult",
    "features.optimise.study": "optimise",
    "features.seats.study": "CheckFitResult check_fit",
    "features.simulate.study": "SimulateResult simulate",
    "features.spindle.records": "TwoRaceGrindingResult TwoRaceSizeResult",
    "features.stability.study": "StabilityResult stability",
    "features.sweep.result": "SweepResult",
    "features.sweep.study": "sweep",
    "features.verify.study": "VerifyResult verify",
    "foundation.checks": "Check",
    "foundation.errors": "AbuError InputError NotTrustworthyError OutputError RangeError",
    "inputs.read_machine": "Machine read",
    "inputs.recording": "Recording",
    "inputs.recording_files": "read_recording",
    "simulation.scene_file": "SceneDescription read_scene",
}
"""Public names of each module."""

__all__ = [
    "AbuError", "AccuracyResult", "BalanceResult", "Check", "CheckFitResult", "CompareResult", "DeclareResult",
    "EffectsResult", "FactoryResult", "GrindingResult", "IdentifyResult", "InputError", "LevelsResult", "Machine",
    "MeasurePlanResult", "MeasuredDeclareResult", "NotTrustworthyError", "OptimiseResult", "OutputError", "Race",
    "RangeError", "Readings", "Recording", "Recordings", "Scene", "SceneDescription", "SimulateResult", "SizeResult",
    "StabilityResult", "SweepResult", "TwoRaceGrindingResult", "TwoRaceSizeResult", "VerifyResult", "__version__",
    "accuracy", "balance", "check_fit", "compare", "declare", "declare_recordings", "effects", "factory", "grinding",
    "identify", "levels", "measure_plan", "optimise", "planar", "read", "read_readings", "read_recording",
    "read_recordings", "read_scene", "simulate", "size", "stability", "sweep", "units", "verify",
]  # fmt: skip


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


if not TYPE_CHECKING:  # a type checker shall find what is there, and nothing else

    def __getattr__(name: str) -> object:
        if name == "units":
            return importlib.import_module("abu_calc.units")
        for room, names in _ROOMS.items():
            if name in names.split():
                return getattr(importlib.import_module(f"abu_calc.{room}"), name)
        raise AttributeError(f"module 'abu_calc' has no attribute {name!r}")
