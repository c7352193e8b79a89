"""The bank of simulated starts: kept, read again, and made anew where it is damaged."""

from pathlib import Path

import numpy as np
import pytest

from abu_calc.features.identification import bank
from abu_calc.features.identification.bank import Box, bank_of, simulated_track, window_centres
from abu_calc.features.identification.estimate import end_of
from abu_calc.foundation.disk_cache import FOLDER
from abu_calc.foundation.progress import silent
from abu_calc.simulation.scene_file import read_any
from abu_calc.simulation.scene_of_file import scene_from
from tests.features.identification.recorded import scene_file

NARROW = Box(np.array([2.6, 0.3, 4.0, 11.0]), np.array([2.7, 0.4, 4.2, 11.3]))


@pytest.mark.slow
def test_a_bank_is_kept_and_a_damaged_one_is_made_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(FOLDER, str(tmp_path / "banks"))
    scene = scene_from(read_any(str(scene_file(tmp_path))).scene)  # type: ignore[union-attr]
    centres, runs = window_centres(scene), []
    monkeypatch.setattr(bank, "simulated_track", lambda *a: runs.append(1) or simulated_track(*a))
    first = bank_of(scene, NARROW, 4, centres, silent)
    assert len(runs) == 4 and len(first.points) == 4
    again = bank_of(scene, NARROW, 4, centres, silent)
    assert len(runs) == 4 and np.array_equal(first.tracks, again.tracks)
    (file,) = (tmp_path / "banks").glob("*.npz")
    for content in (file.read_bytes()[:500], b"", b"PK\x03\x04 nothing"):
        file.write_bytes(content)
        assert np.array_equal(bank_of(scene, NARROW, 4, centres, silent).tracks, first.tracks)
    assert len(runs) == 16
    # The axis rests opposite to the eccentricity; that of the box is known to 0.2 µm.
    ends = np.array([end_of(track) for track in first.tracks]) * 1e6
    offsets = first.points[:, 2] + 1j * first.points[:, 3]
    assert np.abs(ends + offsets).max() < 0.3


def test_a_folder_that_cannot_be_written_keeps_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    monkeypatch.setenv(FOLDER, str(tmp_path / "file" / "banks"))
    scene = scene_from(read_any(str(scene_file(tmp_path))).scene)  # type: ignore[union-attr]
    with pytest.warns(RuntimeWarning, match="simulated starts are not kept"):
        assert len(bank_of(scene, NARROW, 2, window_centres(scene), silent).tracks) == 2
