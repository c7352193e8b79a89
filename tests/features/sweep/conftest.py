"""Sweeps whose members cost nothing: a closed form in the place of each run."""

from pathlib import Path
from typing import Any

import pytest

import abu_calc
from abu_calc.features.sweep.samples import Builds

ECCENTRICITY = "autobalancer.race_eccentricity_mm"


@pytest.fixture(scope="session")
def machine() -> abu_calc.Machine:
    """A machine whose members vary by race eccentricity and start."""
    return abu_calc.read("avtovaz-707-222")


@pytest.fixture
def cheap(monkeypatch: pytest.MonkeyPatch) -> None:
    """The level is 80 dB and 1 dB for each micrometre."""

    def closed_form(self: Builds, values: Any, seed: int) -> Any:
        return 80 + 1e3 * values[ECCENTRICITY], 0.1, 0.2, 0.3, 1.0, 1.0, 1.2, True, True, True, True, True

    monkeypatch.setattr(Builds, "numbers", closed_form)


class Sweeps:
    """Sweeps of one study into stores in one folder."""

    def __init__(self, machine: abu_calc.Machine, folder: Path) -> None:
        self.machine, self.folder, self.store = machine, folder, folder / "members.sqlite"

    def run(self, store: Any = None, runs: int = 12, **options: Any) -> abu_calc.SweepResult:
        """One sweep; into the usual store if none is named."""
        vary = {ECCENTRICITY: "uniform(0.004, 0.016)"}
        return abu_calc.sweep(self.machine, vary, runs, store=store or self.store, **options)


@pytest.fixture
def sweeps(machine: abu_calc.Machine, tmp_path: Path, cheap: None) -> Sweeps:
    """Into an empty folder."""
    return Sweeps(machine, tmp_path)
