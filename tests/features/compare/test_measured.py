"""Recorded starts beside predicted ones: `abu compare FILE --measured FILE`."""

import math
from pathlib import Path

import numpy as np
import pytest

from abu_calc.features.compare.measured import CourseNumbers, compare_measured
from abu_calc.foundation.errors import InputError
from abu_calc.simulation.scene_file import read_any
from abu_calc.simulation.scene_of_file import scene_from
from tests.cli.runner import abu
from tests.features.identification.recorded import record, scene_file

DRAG, LEVER, OFFSET = 14.0, 1.5e-6, 12e-6 * np.exp(1j * math.radians(70))


def told(folder: Path, *, drag: float = DRAG) -> Path:
    """A scene whose file gives the values of the machine, or another drag rate."""
    path = scene_file(folder)
    text = path.read_text(encoding="utf-8")
    text = text.replace("rolling_drag_per_s = 15", f"rolling_drag_per_s = {drag}")
    text = text.replace("magnitude_mm = 0.01, angle_deg = 0.0", "magnitude_mm = 0.012, angle_deg = 70.0")
    text = text.replace("lever_arm_mm = 0.002", "lever_arm_mm = 0.0015")
    known = folder / f"known{drag:g}.toml"
    known.write_text(text, encoding="utf-8")
    return known


def recordings(folder: Path, count: int, *, mark: bool = True) -> list[str]:
    path = scene_file(folder)
    return [record(path, folder / f"s{k}{mark}.csv", DRAG, LEVER, complex(OFFSET), k, mark=mark) for k in range(count)]


@pytest.mark.slow
def test_known_values_predict_the_recorded_starts_and_wrong_ones_do_not(tmp_path: Path) -> None:
    files = recordings(tmp_path, 4)
    right = compare_measured([read_any(str(told(tmp_path)))], files)
    (band,) = right.predicted
    times = [course.numbers.settling_time_s or math.inf for course in right.measured]
    assert (band.low.settling_time_s or 0) * 0.6 <= min(times) <= max(times) <= (band.high.settling_time_s or 0) * 1.6
    for course in right.measured:
        # The axis rests opposite to the eccentricity of 12 µm.
        assert course.numbers.residual_um == pytest.approx(12.0, abs=0.8)
        assert course.numbers.residual_um == pytest.approx(band.median.residual_um, abs=0.8)
        speed = 5800 * math.pi / 30
        level = 20 * math.log10(speed * course.numbers.residual_um * 1e-6 / math.sqrt(2) / 5e-8)
        assert course.numbers.level_db == pytest.approx(level, abs=0.01)
    slow = compare_measured([read_any(str(told(tmp_path, drag=4.0)))], files).predicted[0]
    assert (slow.median.settling_time_s or math.inf) > 1.3 * np.median(times)


def test_numbers_of_an_exponential_are_those_of_its_equation(tmp_path: Path) -> None:
    scene = scene_from(read_any(str(scene_file(tmp_path))).scene)  # type: ignore[union-attr]
    centres = 0.5 + np.linspace(0.0, 1.4, 300)
    track = 5e-6 + 40e-6 * np.exp(-8.0 * (centres - 0.5)) + 0j
    numbers = CourseNumbers.of(track, centres, scene)
    # A₀ = U/M far above resonance = 40.6 µm; 40 e^{−8t} falls to 4.06 µm at t = ln(40/4.06)/8.
    assert numbers.settling_time_s == pytest.approx(math.log(40 / 4.06) / 8, abs=0.01)
    assert numbers.residual_um == pytest.approx(5.0, abs=0.01)
    never = CourseNumbers.of(10e-6 * np.exp(1j * 40 * centres), centres, scene)
    assert never.settling_time_s is None and never.settling_time == math.inf


@pytest.mark.slow
def test_the_command_prints_and_draws(tmp_path: Path) -> None:
    files = [option for file in recordings(tmp_path, 2, mark=False) for option in ("--measured", file)]
    figure = tmp_path / "courses.svg"
    seen = abu("compare", str(told(tmp_path)), *files, "--figure", f"courses={figure}")
    assert seen.status == 0 and "Without a mark" in seen.out and seen.width <= 80
    assert "<svg" in figure.read_text(encoding="utf-8")
    result = abu("compare", str(told(tmp_path)), *files, "--json").document["result"]
    assert len(result["measured"]) == 2 and result["mark"] is False


def test_what_cannot_be_compared_is_refused(tmp_path: Path) -> None:
    (file,) = recordings(tmp_path, 1)
    source = read_any(str(told(tmp_path)))
    other = tmp_path / "other.toml"
    other.write_text(told(tmp_path).read_text(encoding="utf-8").replace("time_s = 0.5", "time_s = 0.4"), "utf-8")
    for machines, recorded, words in (
        ([], [file], "nothing"),
        ([source], [], "nothing"),
        ([source], [str(tmp_path / "none.csv")], "none.csv"),
        ([source, read_any(str(other))], [file], "different speeds"),
    ):
        with pytest.raises(InputError, match=words):
            compare_measured(machines, recorded)
    seen = abu("compare", str(other), "--measured", file, "--variant", "wheel.mass_kg=1")
    assert seen.status == 2 and "variants are of a machine" in seen.err
