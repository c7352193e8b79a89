"""Checks of recorded starts that need no fit."""

from pathlib import Path

import numpy as np
import pytest

from abu_calc.features.identification.bank import recorded, recorded_start, window_centres
from abu_calc.features.identification.estimate import TrackReading
from abu_calc.features.identification.fit import Measured, _run_up_check, _trend, without_balls
from abu_calc.features.identification.study import as_long, known_scene, machine_subject
from abu_calc.simulation.scene_file import read_any
from tests.features.identification.recorded import record, scene_file
from tests.features.identification.test_study import LEVER, OFFSET


def measured(folder: Path, drags: np.ndarray, cut: float = 0.0):  # type: ignore[no-untyped-def]
    """Scene and starts with these drag rates, their beginning cut off."""
    path, files = scene_file(folder), []
    for k, drag in enumerate(drags):
        file = record(path, folder / f"start{k}.csv", float(drag), LEVER, complex(OFFSET), k)
        head, *rows = Path(file).read_text(encoding="utf-8").splitlines()
        parts = [row.split(",", 1)[1] for row in rows[round(cut / 5e-4) :]]
        text = "\n".join([head, *(f"{place * 5e-4:.4f},{rest}" for place, rest in enumerate(parts))])
        Path(file).write_text(text + "\n", encoding="utf-8")
        files.append(recorded(file))
    scene = as_long(known_scene(machine_subject(read_any(str(path))).scene, None), files)
    centres = window_centres(scene)
    starts = tuple(recorded_start(signal, scene, centres) for signal in files)
    reading = TrackReading(centres, scene.full_speed, abs(without_balls(scene)), 0.3e-6, marked=True)
    return scene, Measured(starts, tuple(start.track for start in starts), reading, None)


@pytest.mark.slow
@pytest.mark.parametrize(("last", "status"), [(8.0, "warn"), (16.0, "warn"), (24.0, "pass")])
def test_oil_that_warms_shows_a_trend(tmp_path: Path, last: float, status: str) -> None:
    """The drag rate falls from 24 1/s over eight starts, or stays."""
    _, starts = measured(tmp_path, np.geomspace(24.0, last, 8))
    assert _trend(starts).status == status


@pytest.mark.slow
def test_a_recording_that_begins_late_is_noticed_by_its_run_up(tmp_path: Path) -> None:
    scene, starts = measured(tmp_path, np.full(2, 14.0), cut=0.1)
    check = _run_up_check(scene, starts)
    assert check.status == "warn" and "begin at the switching-on" in (check.remedy or "")
    assert _run_up_check(*measured(tmp_path, np.full(2, 14.0))).status == "pass"
