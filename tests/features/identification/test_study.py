"""`abu identify` on synthetic machines whose truth is known, and what it must refuse or notice."""

import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import abu_calc
from abu_calc.features.identification.bank import WIDE
from abu_calc.features.identification.estimate import Best
from abu_calc.features.identification.fit import Estimate, identified_values
from abu_calc.foundation.disk_cache import FOLDER
from abu_calc.foundation.errors import InputError
from abu_calc.simulation.scene_file import read_any
from tests.features.identification.recorded import record, scene_file

DRAG, LEVER, OFFSET = 14.0, 1.5e-6, 12e-6 * np.exp(1j * math.radians(70))


def starts(folder: Path, count: int, **options: object) -> tuple[Path, list[str]]:
    path = scene_file(folder)
    files = [
        record(path, folder / f"start{k:02d}.csv", DRAG, LEVER, complex(OFFSET), k, **options)  # type: ignore[arg-type]
        for k in range(count)
    ]
    return path, files


@pytest.mark.slow
def test_fewer_than_eight_starts_give_no_value(tmp_path: Path) -> None:
    path, files = starts(tmp_path, 5)
    result = abu_calc.identify(read_any(str(path)), files)
    assert result.status == "not-done" and result.rolling_drag_per_s is None and result.race_eccentricity_mm is None
    assert [check.code for check in result.checks] == ["ABU1101"] and result.starts == 5 and result.mark
    assert result.measured_run_up_s == pytest.approx(0.5, rel=0.02)
    # The balls rest where the eccentricity puts them: the axis opposite to it.
    ends = np.mean([complex(*course.end_um) for course in result.courses])
    assert ends == pytest.approx(-OFFSET * 1e6, abs=0.4)


@pytest.mark.slow
def test_recordings_that_cannot_be_starts_are_refused(tmp_path: Path) -> None:
    path, files = starts(tmp_path, 1)
    source = read_any(str(path))
    lines = Path(files[0]).read_text(encoding="utf-8").splitlines()
    for name, text, words in (
        ("short", lines[:1500], "too short"),
        ("slow", [lines[0], *lines[1::8]], "too slowly"),
        ("no mark", [line.rpartition(",")[0] for line in lines], "some have none"),
        ("flat mark", [lines[0], *(line.rpartition(",")[0] + ",0" for line in lines[1:])], "mark"),
    ):
        file = tmp_path / f"{name}.csv"
        file.write_text("\n".join(text) + "\n", encoding="utf-8")
        with pytest.raises(InputError, match=words):
            abu_calc.identify(source, [files[0], str(file)])
    with pytest.raises(InputError, match="no recordings"):
        abu_calc.identify(source, [])
    with pytest.raises(InputError, match="run-up time"):
        abu_calc.identify(source, files, run_up_s=-1.0)
    with pytest.raises(InputError):
        abu_calc.identify(source, [str(tmp_path / "none.csv")])


@pytest.mark.slow
def test_recordings_of_another_unit_or_given_twice_are_refused(tmp_path: Path) -> None:
    path, files = starts(tmp_path, 2)
    source = read_any(str(path))
    with pytest.raises(InputError, match="given twice"):
        abu_calc.identify(source, [files[0], files[0]])
    copied = tmp_path / "copy.csv"
    copied.write_text(Path(files[0]).read_text(encoding="utf-8"), encoding="utf-8")
    with pytest.raises(InputError, match="given twice"):
        abu_calc.identify(source, [files[0], files[1], str(copied)])
    head, *rows = Path(files[0]).read_text(encoding="utf-8").splitlines()
    for factor in (1e3, 1e-3):
        parts = [row.split(",") for row in rows]
        text = "\n".join([head, *(f"{t},{float(v) * factor:.6f},{mark}" for t, v, mark in parts)])
        copied.write_text(text + "\n", encoding="utf-8")
        with pytest.raises(InputError, match="not that of the machine"):
            abu_calc.identify(source, [str(copied), files[1]])
    for k, file in enumerate(files):
        Path(file).write_text("\n".join([head, *rows[: 600 + k]]) + "\n", encoding="utf-8")
    with pytest.raises(InputError, match="too short") as refusal:
        abu_calc.identify(source, files)
    assert "start00.csv" in str(refusal.value)


def test_a_clipped_recording_is_told(tmp_path: Path) -> None:
    path, files = starts(tmp_path, 2)
    head, *rows = Path(files[0]).read_text(encoding="utf-8").splitlines()
    parts = [row.split(",") for row in rows]
    most = 0.6 * max(abs(float(velocity)) for _, velocity, _ in parts)
    text = "\n".join([head, *(f"{t},{max(-most, min(most, float(v))):.3f},{mark}" for t, v, mark in parts)])
    Path(files[0]).write_text(text + "\n", encoding="utf-8")
    result = abu_calc.identify(read_any(str(path)), files)
    assert [warning for warning in result.warnings if "clipped" in warning] == [
        f"{files[0]} is clipped: its amplitudes read too low."
    ]


def test_a_scene_without_run_up_or_balls_is_refused(tmp_path: Path) -> None:
    path, files = starts(tmp_path, 1)
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("run_up = { time_s = 0.5 }\n", ""), encoding="utf-8")
    with pytest.raises(InputError, match="run-up is not known"):
        abu_calc.identify(read_any(str(path)), files)
    path.write_text(text.replace("imbalance_g_mm = 256.0", "imbalance_g_mm = 0.0"), encoding="utf-8")
    with pytest.raises(InputError, match="no imbalance"):
        abu_calc.identify(read_any(str(path)), files)


@pytest.mark.hard
def test_values_of_a_machine_are_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Three standard deviations of eight starts: 5 % of the drag, and 0.17 in the logarithm of the lever arm.

    The truth is simulated at a tighter tolerance.
    """
    monkeypatch.setenv(FOLDER, str(tmp_path / "cache"))
    path, files = starts(tmp_path, 8)
    result = abu_calc.identify(read_any(str(path)), files)
    assert result.rolling_drag_per_s.value == pytest.approx(DRAG, rel=0.15)
    assert abs(math.log(result.rolling_friction_mm.value / (LEVER * 1e3))) < 0.51
    # These eight starts are among the five of a hundred whose interval of 95 % just misses the lever arm.
    low, high = (math.log(end) for end in (result.rolling_friction_mm.low, result.rolling_friction_mm.high))
    assert low - (high - low) / 4 <= math.log(LEVER * 1e3) <= high
    assert result.race_eccentricity_mm.value == pytest.approx(0.012, abs=0.001)
    assert result.race_eccentricity_angle_deg.value == pytest.approx(70, abs=10)
    assert result.rolling_drag_per_s.low < result.rolling_drag_per_s.value < result.rolling_drag_per_s.high
    assert result.status == "pass" and "rolling_drag_per_s" in result.toml
    again = abu_calc.identify(read_any(str(path)), files)  # from the banks that were kept
    assert again.rolling_drag_per_s == result.rolling_drag_per_s


@pytest.mark.hard
def test_a_background_is_separated_by_a_run_without_balls(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Until then it looks like eccentricity."""
    monkeypatch.setenv(FOLDER, str(tmp_path / "cache"))
    moved = tmp_path
    background = 5e-6 * np.exp(1j * math.radians(-30))
    path, files = starts(moved, 8, background=complex(background))
    alone = record(path, moved / "alone.csv", DRAG, LEVER, 0.0, 99, balls=False, background=complex(background))
    result = abu_calc.identify(read_any(str(path)), files, without=alone)
    assert result.race_eccentricity_mm.value == pytest.approx(0.012, abs=0.001)
    told = abu_calc.identify(read_any(str(path)), files)
    assert told.race_eccentricity_mm.value == pytest.approx(abs(OFFSET - background) * 1e3, abs=0.001)


@pytest.mark.hard
@pytest.mark.parametrize("wrong", [{"imbalance": 1.25}, {"run_up": 2.0}, {"stiffness": 4.8**2}], ids=str)
def test_wrong_assumptions_are_noticed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, wrong: dict[str, float]
) -> None:
    """The springs are those of 12 Hz, and the file tells 2.5 Hz."""
    monkeypatch.setenv(FOLDER, str(tmp_path / "cache"))
    path, files = starts(tmp_path, 8, **wrong)
    result = abu_calc.identify(read_any(str(path)), files)
    assert {check.status for check in result.checks} & {"warn", "not-done"}


@pytest.mark.hard
def test_oil_that_warms_from_start_to_start_is_noticed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The drag rate falls from 24 to 8 1/s over eight starts."""
    monkeypatch.setenv(FOLDER, str(tmp_path / "cache"))
    path = scene_file(tmp_path)
    files = [
        record(path, tmp_path / f"start{k}.csv", float(drag), LEVER, complex(OFFSET), k)
        for k, drag in enumerate(np.geomspace(24.0, 8.0, 8))
    ]
    result = abu_calc.identify(read_any(str(path)), files)
    assert next(check for check in result.checks if check.code == "ABU1104").status == "warn"


@pytest.mark.hard
def test_an_eccentricity_that_friction_hides_is_not_given_wrongly(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A vertical spindle with a lever arm of 12 µm: the interval of the eccentricity holds the truth, or none is given;
    that of the arm does, or the fit is called poor.
    """
    monkeypatch.setenv(FOLDER, str(tmp_path / "cache"))
    path = scene_file(tmp_path)
    path.write_text(path.read_text(encoding="utf-8").replace("gravity = {}\n", ""), encoding="utf-8")
    places = np.add.outer(np.random.default_rng(2).uniform(-180, 180, 10), (0.0, 80.0, 170.0, 265.0))
    files = []
    for k, angles in enumerate(places):
        text = path.read_text(encoding="utf-8")
        start = tmp_path / f"scene{k}.toml"
        start.write_text(
            text.replace("[-150.6, -110.2, -69.8, -29.4]", str([round(float(a), 1) for a in angles])), "utf-8"
        )
        files.append(record(start, tmp_path / f"start{k:02d}.csv", DRAG, 12e-6, complex(OFFSET), k))
    result = abu_calc.identify(read_any(str(path)), files)
    length = result.race_eccentricity_mm
    assert (length is None) == (result.race_eccentricity_angle_deg is None) == (result.status == "not-done")
    assert length is None or length.low <= abs(OFFSET) * 1e3 <= length.high
    poor = next(check for check in result.checks if check.code == "ABU1107").status == "warn"
    friction = result.rolling_friction_mm
    assert poor or friction is None or friction.low <= 0.012 <= friction.high


@pytest.mark.parametrize(("half", "given"), [(3.0, True), (6.0, False), (9.0, False)])
def test_an_eccentricity_within_its_own_interval_is_not_known(half: float, given: bool) -> None:
    """5 µm of eccentricity: an interval of ± 6 µm holds none at all."""
    best = Best(np.array([2.5, 0.5, 3.0, 4.0]), 0.0)
    intervals = ((2.4, 2.6), (0.3, 0.7), (3.0 - half, 3.0 + half), (3.5, 4.5))
    estimate = Estimate(best, WIDE, intervals, 0.1, 0.5, 0.0, 1.0, 1)
    assert estimate.offset_error == half and estimate.offset_allowed == 5.0
    assert (estimate.offset_error <= estimate.offset_allowed) is given
    assert estimate.at_the_edge(marked=True) == ()
    edge = Estimate(Best(np.array([2.5, math.log(0.3), 3.0, 4.0]), 0.0), WIDE, intervals, 0.1, 0.5, 0.0, 1.0, 1)
    assert edge.at_the_edge(marked=True) == ("lever arm",)


@pytest.mark.parametrize(
    ("drag", "arm", "vague"),
    [
        ((10.0, 81.0), (1.0, 4.0), ("drag rate", "lever arm")),
        ((4.9, 30.0), (1.9, 2.1), ("drag rate", "lever arm")),
        ((10.0, 30.0), (0.3, 7.9), ()),
        ((19.0, 21.0), (0.3, 8.1), ("lever arm",)),
    ],
    ids=["far above", "far below", "friction next to none", "friction far above"],
)
def test_a_value_whose_interval_says_little_is_not_given(
    drag: tuple[float, float], arm: tuple[float, float], vague: tuple[str, ...]
) -> None:
    """Of 20 1/s and 2 µm; a lever arm goes with its drag rate."""
    ends = [(math.log(low), math.log(high)) for low, high in (drag, arm)]
    best = Best(np.array([math.log(20.0), math.log(2.0), 3.0, 4.0]), 0.0)
    estimate = Estimate(best, WIDE, (*ends, (2.5, 3.5), (3.5, 4.5)), 0.1, 0.5, 0.0, 1.0, 1)
    assert estimate.vague == vague
    measured = SimpleNamespace(reading=SimpleNamespace(marked=True, phase_error=0.0))
    given = identified_values(measured, estimate, 0.0)  # type: ignore[arg-type]
    values = {"drag rate": given.rolling_drag_per_s, "lever arm": given.rolling_friction_mm}
    assert [name for name, value in values.items() if value is None] == list(vague)


@pytest.mark.hard
def test_a_start_of_another_machine_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of nine starts one was recorded with twice the imbalance: the check names its file, and none of the others."""
    monkeypatch.setenv(FOLDER, str(tmp_path / "cache"))
    path, files = starts(tmp_path, 8)
    foreign = record(path, tmp_path / "foreign.csv", DRAG, LEVER, complex(OFFSET), 50, imbalance=2.0)
    for given, status in ((files, "pass"), ([*files[:4], foreign, *files[4:]], "warn")):
        check = next(check for check in abu_calc.identify(read_any(str(path)), given).checks if check.code == "ABU1109")
        assert check.status == status and ("foreign.csv" in check.message) is (status == "warn")
