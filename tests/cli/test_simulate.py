"""`abu simulate` as its users see it."""

import csv
import math
from pathlib import Path

import pytest

from abu_calc.analysis import simulate as simulate_module
from tests.cli.runner import abu
from tests.spec.scenes import ARM, PLANAR, SCENE, TILTING
from tests.spec.test_scene import CASES, TILTING_CASES

DISC = """\
[scene]
support = "planar"
mass_kg = 21.0
stiffness_N_per_m = [10.0, 10.0]
damping_N_s_per_m = [1.0, 1.0]
speed_rpm = 14.32394487827058
imbalance_g_mm = 1e6
imbalance_angle_deg = 45.0
duration_s = 300.0
[[scene.race]]
pitch_radius_mm = 1000.0
ball_masses_g = [1000.0, 1000.0]
rolling_drag_per_s = 0.5
start_angles_deg = [55.0, 15.0]
"""
KEYS = {
    "scene", "duration_s", "settling_time_s", "residual_imbalance_g_mm", "axis_amplitude_mm", "velocity_rms_mm_per_s",
    "level_db", "final", "effects", "cost", "error_estimate",
}  # fmt: skip


@pytest.fixture
def scene(tmp_path: Path) -> str:
    return written(tmp_path, SCENE)


def written(folder: Path, text: str) -> str:
    file = folder / "scene.toml"
    file.write_text(text, encoding="utf-8")
    return str(file)


def rows_of(path: Path) -> list[dict[str, float]]:
    with path.open(encoding="utf-8", newline="") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def test_published_transient(scene: str, tmp_path: Path) -> None:
    """Rodrigues et al. 2008, fig. 11 i: largest |w| per window; ± 2 % is how well the figure can be read."""
    motion = tmp_path / "motion.csv"
    seen = abu("simulate", scene, "--trajectory", str(motion), "--samples", "28001", "--json")
    assert seen.status == 0
    published = {
        (0, 25): 0.0484, (25, 50): 0.0436, (50, 75): 0.0362, (75, 100): 0.0281, (100, 150): 0.0236, (150, 200): 0.0187,
        (200, 300): 0.0123, (300, 400): 0.0076, (400, 500): 0.0045, (500, 600): 0.0029, (600, 700): 0.0020,
    }  # fmt: skip
    rows = rows_of(motion)
    for (low, high), expected in published.items():
        largest = max(math.hypot(row["x_mm"], row["y_mm"]) for row in rows if low <= row["t_s"] <= high) / 1000
        assert largest == pytest.approx(expected, rel=0.02, abs=6e-5), (low, high)
    result = seen.document["result"]
    assert result["final"]["ball_angles_deg"] == pytest.approx([95.64, -95.64], abs=0.03)
    # Without balls m₀e Ω²/|k − MΩ²| with c: 13.33 mm.
    assert result["unbalanced_amplitude_mm"] == pytest.approx(13.33, abs=0.01)


def test_the_disc_of_twenty_kilograms(tmp_path: Path) -> None:
    """Published to whole degrees: the balls end at 165° and 285°."""
    seen = abu("simulate", written(tmp_path, DISC), "--json")
    result = seen.document["result"]
    assert [angle % 360 for angle in result["final"]["ball_angles_deg"]] == pytest.approx([165, 285], abs=0.5)
    assert result["settling_time_s"] is not None and result["residual_imbalance_g_mm"] < 0.01e6


def test_the_envelope(scene: str) -> None:
    document = abu("simulate", scene, "--set", "scene.duration_s=50", "--json").document
    result, model = document["result"], document["model"]
    assert result.keys() >= KEYS and document["abu"]["command"] == "simulate"
    assert result["final"].keys() == {
        "t_s", "x_mm", "y_mm", "vx_mm_per_s", "vy_mm_per_s", "ball_angles_deg", "ball_speeds_rpm",
    }  # fmt: skip
    (check,) = document["checks"]
    assert (check["code"], check["name"], check["status"]) == ("ABU801", "accuracy reached", "pass")
    assert check["value"] == result["error_estimate"] <= check["limit"] == 0.01
    assert result["cost"]["integrator"] == "scipy-dop853" and result["final"]["t_s"] == result["duration_s"] == 50
    assert model["states"] == ["x", "y", "x'", "y'", "θ1", "θ2", "θ1'", "θ2'"]
    assert model["speed_rad_per_s"] == pytest.approx(2.0) and model["imbalance_kg_m"] == pytest.approx(0.01)
    assert model["mass_kg"] == [[1.0, 0.0], [0.0, 1.0]] and model["stiffness_N_per_m"] == [[1.0, 0.0], [0.0, 1.0]]
    assert model["damping_N_s_per_m"] == [[0.02, 0.0], [0.0, 0.02]] and model["ball_masses_kg"] == [0.05, 0.05]
    assert (model["pitch_radius_m"], model["drag_per_s"], model["inertia_factor"]) == (1.0, 0.01, 1.0)
    assert model["start_angles_rad"] == pytest.approx([math.pi / 2, -math.pi / 2])


def test_a_scene_moves_from_where_it_says(tmp_path: Path) -> None:
    text = SCENE.replace(
        "rolling_inertia = false",
        "rolling_inertia = true\ninitial = { x_mm = 3.0, y_mm = -2.0, vx_mm_per_s = 5.0, vy_mm_per_s = 7.0 }",
    ).replace("duration_s = 700.0", "duration_s = 20.0")
    text += "start_speeds_rpm = [1.0, -2.0]\n"
    motion = tmp_path / "motion.csv"
    seen = abu("simulate", written(tmp_path, text), "--trajectory", str(motion), "--samples", "20001", "--json")
    model, rows = seen.document["model"], rows_of(motion)
    assert model["inertia_factor"] == 1.4
    first, second = rows[0], rows[1]
    assert (first["x_mm"], first["y_mm"], first["ball1_deg"], first["ball2_deg"]) == (3.0, -2.0, 90.0, -90.0)
    assert (second["x_mm"] - 3.0) / 1e-3 == pytest.approx(5.0, abs=0.1)
    assert (second["y_mm"] + 2.0) / 1e-3 == pytest.approx(7.0, abs=0.1)
    assert (second["ball1_deg"] - 90.0) / 1e-3 == pytest.approx(6.0, abs=0.1)  # 1 rpm is 6°/s
    assert (second["ball2_deg"] + 90.0) / 1e-3 == pytest.approx(-12.0, abs=0.1)


def test_a_trajectory_is_equally_spaced_and_changes_nothing(scene: str, tmp_path: Path) -> None:
    motion = tmp_path / "motion.csv"
    options = ("simulate", scene, "--duration", "60", "--json")
    alone = abu(*options).document["result"]
    beside = abu(*options, "--trajectory", str(motion), "--samples", "7").document["result"]
    rows = rows_of(motion)
    assert [row["t_s"] for row in rows] == [0, 10, 20, 30, 40, 50, 60]
    assert list(rows[0]) == ["t_s", "x_mm", "y_mm", "ball1_deg", "ball2_deg"]
    for result in (alone, beside):
        del result["cost"]
    assert alone == beside
    assert rows[-1]["x_mm"] == pytest.approx(beside["final"]["x_mm"], rel=1e-9)
    final = [math.remainder(rows[-1][f"ball{k}_deg"], 360) for k in (1, 2)]
    assert final == pytest.approx(beside["final"]["ball_angles_deg"], abs=1e-6)
    before = motion.read_bytes()
    seen = abu(*options, "--trajectory", str(motion))
    assert seen.status == 2 and "--force" in seen.err and motion.read_bytes() == before
    assert abu(*options, "--trajectory", str(motion), "--force").status == 0
    assert len(rows_of(motion)) == 1001
    assert sorted(path.name for path in tmp_path.iterdir()) == ["motion.csv", "scene.toml"]


def test_ball_angles_of_a_trajectory_are_not_wrapped(scene: str, tmp_path: Path) -> None:
    motion = tmp_path / "motion.csv"
    speeds = ["--set", "scene.race[0].start_speeds_rpm=[600, 0]"]
    abu("simulate", scene, *speeds, "--duration", "4", "--trajectory", str(motion), "-q")
    assert rows_of(motion)[-1]["ball1_deg"] > 360 * 30


def test_effects_of_a_file_are_named_as_left_out(tmp_path: Path) -> None:
    seen = abu("simulate", written(tmp_path, PLANAR.replace("700.0", "20.0")), "--json")
    effects = seen.document["result"]["effects"]
    assert [effect["name"] for effect in effects][:3] == ["gravity", "dry_rolling_friction", "ball_contact"]
    assert len(effects) == 8 and not any(effect["included"] for effect in effects)
    (warning,) = seen.document["warnings"]
    assert all(effect["name"] in warning for effect in effects) and "warning" in seen.err


def test_balls_parted_at_the_start_are_told(tmp_path: Path) -> None:
    text = SCENE.replace("[90.0, -90.0]", "[10.0, 370.0]").replace("700.0", "20.0")
    document = abu("simulate", written(tmp_path, text), "--json").document
    assert "parted" in document["warnings"][0]
    one, other = document["model"]["start_angles_rad"]
    assert abs(math.remainder(one - other, 2 * math.pi)) == pytest.approx(1e-6, rel=1e-3)


@pytest.mark.parametrize("balls", [0, 1, 5])
def test_any_number_of_balls(tmp_path: Path, balls: int) -> None:
    masses, angles = [20.0] * balls, [40.0 * k for k in range(balls)]
    text = SCENE.replace("[50.0, 50.0]", str(masses)).replace("[90.0, -90.0]", str(angles)).replace("700.0", "30.0")
    seen = abu("simulate", written(tmp_path, text))
    assert seen.status == 0 and max(map(len, seen.out.splitlines())) <= 80
    assert abu("stability", written(tmp_path, text), "--quiet").status in (0, 1)


# machines
def test_a_machine_is_simulated_as_it_is_sized() -> None:
    sized = abu("size", "msh-230", "--json").document["result"]["simulation"][0]
    document = abu("simulate", "msh-230", "--json").document
    found = document["result"]
    assert found["scene"] == "idle"
    for key in ("duration_s", "settling_time_s", "axis_amplitude_mm", "level_db", "final", "effects"):
        assert found[key] == sized[key], key
    assert abu("simulate", "msh-230", "--scene", "idle", "--start", "bunched", "--json").document["result"][
        "final"
    ] == found["final"]  # fmt: skip


def test_starts_of_a_machine() -> None:
    """Spread balls are evenly round the race; at standstill they do not turn, so they fall behind by a whole speed."""
    starts = {
        start: abu("simulate", "msh-230", "--start", start, "--json").document for start in ("spread", "standstill")
    }
    model = starts["spread"]["model"]
    balls = len(model["ball_masses_kg"])
    assert model["start_angles_rad"] == pytest.approx([math.radians(20 + k * 360 / balls) for k in range(balls)])
    assert model["start_speeds_rad_per_s"] == [0.0] * balls
    model = starts["standstill"]["model"]
    assert sum(model["start_angles_rad"]) / balls == pytest.approx(math.radians(20))
    assert model["start_speeds_rad_per_s"] == [-model["speed_rad_per_s"]] * balls
    assert all(document["status"] == "pass" for document in starts.values())


def test_duration_of_a_machine() -> None:
    assert abu("simulate", "msh-230", "--duration", "0.2", "--json").document["result"]["duration_s"] == 0.2


def test_the_report_fits_80_columns(scene: str) -> None:
    for seen in (abu("simulate", "avtovaz-707-222"), abu("simulate", scene, "--duration", "40")):
        assert seen.status == 0 and max(map(len, seen.out.splitlines())) <= 80
        assert "not settled" in seen.out or "settled in" in seen.out


@pytest.mark.parametrize("suffix", [".json", ".toml", ".csv", ".txt"])
def test_output_formats(scene: str, tmp_path: Path, suffix: str) -> None:
    for command in (("simulate", scene, "--duration", "20"), ("stability", scene, "--speeds", "5:50")):
        path = tmp_path / f"{command[0]}{suffix}"
        assert abu(*command, "--output", str(path), "--quiet").out == "" and path.stat().st_size > 200


# what is refused
ALL_WRONG = [(SCENE, old, new, key) for old, new, _, key, _ in CASES]
ALL_WRONG += [(TILTING, old, new, f"scene.tilting.{key}") for old, new, key, _ in TILTING_CASES]


@pytest.mark.parametrize(("text", "old", "new", "key"), ALL_WRONG, ids=[f"{c[3]}: {c[2][:40]}" for c in ALL_WRONG])
def test_wrong_scene_files(tmp_path: Path, text: str, old: str, new: str, key: str) -> None:
    file = written(tmp_path, text.replace(old, new, 1))
    for command in ("simulate", "stability"):
        seen = abu(command, file, "--json")
        assert seen.status == 2 and "Traceback" not in seen.err and file in seen.err
        assert key in seen.err and seen.document["error"]["file"] == file


@pytest.mark.parametrize(("text", "key"), [(TILTING, "scene.support"), (ARM, "scene.support")])
def test_supports_of_later_are_refused_by_name(tmp_path: Path, text: str, key: str) -> None:
    seen = abu("simulate", written(tmp_path, text))
    assert seen.status == 2 and f":2: {key}" in seen.err and "not simulated in this version" in seen.err


def test_more_than_one_race_is_refused(tmp_path: Path) -> None:
    seen = abu("simulate", written(tmp_path, SCENE + SCENE[SCENE.index("[[scene.race]]") :]))
    assert seen.status == 2 and "scene.race" in seen.err and "more than one race" in seen.err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--scene", "idle"), ("--scene", "machines")),
        (("--start", "spread"), ("--start", "machines")),
        (("--scene", "idel"), ("--scene", "idle")),
        (("--scene", "grinding"), ("grinding", "not simulated in this version", "idle")),
        (("--start", "bunch"), ("--start", "bunched")),
        (("--accuracy", "0"), ("accuracy",)),
        (("--accuracy", "nan"), ("accuracy",)),
        (("--integrator", "heyoka"), ("--integrator", "SciPy")),
        (("--integrator", "euler"), ("--integrator", "auto, scipy")),
        (("--duration", "1"), ("--duration", "3.14159")),
        (("--duration", "-5"), ("--duration",)),
        (("--duration", "nan"), ("--duration",)),
        (("--duration", "1e12"), ("--duration", "can integrate")),
        (("--set", "scene.duration_s=1e9"), ("scene.duration_s", "can integrate")),
        (("--samples", "5"), ("--samples", "--trajectory")),
        (("--trajectory", "t.csv", "--samples", "1"), ("--samples", "2 …")),
        (("--trajectory", "t.csv", "--samples", "2000000"), ("--samples",)),
        (("--trajectory", "t.txt"), ("t.txt", ".csv")),
        (("--trajectory", "no/folder/t.csv"), ("folder does not exist",)),
        (("--trajectory", "t.csv", "--output", "./t.csv"), ("same file",)),
        (("--with", "gravity"), ("gravity", "not simulated in this version")),
        (("--without", "ball_contact"), ("ball_contact", "not simulated in this version")),
        (("--with", "gravitation"), ("gravitation", "gravity")),
        (("--set", "scene.speed=5"), ("scene.speed", "speed_rpm")),
        (("--frobnicate",), ("--frobnicate",)),
    ],
    ids=lambda value: " ".join(value)[:50],
)
def test_wrong_options(
    scene: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...], words: tuple[str, ...]
) -> None:
    monkeypatch.chdir(tmp_path)
    seen = abu("simulate", scene, *arguments)
    assert seen.status == 2 and seen.out == "", seen
    assert all(word in seen.err for word in words) and "Traceback" not in seen.err, seen.err
    assert [path.name for path in tmp_path.iterdir()] == ["scene.toml"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("simulate", "mmg-3200k-knife-shaft"), ("bearings only",)),
        (("simulate", "msh-230", "--set", "suspension.model=hands"), ("suspension.model", "hands", "springs")),
        (("simulate", "msh-231"), ("msh-230",)),
        (("simulate", "msh-230", "--set", "scene.mass_kg=3"), ("scene",)),
        (("simulate",), ("Missing argument",)),
        (("stability", "msh-230", "--set", "suspension.model=hands"), ("suspension.model",)),
    ],
    ids=lambda value: " ".join(value)[:50],
)
def test_wrong_machines(arguments: tuple[str, ...], words: tuple[str, ...]) -> None:
    seen = abu(*arguments)
    assert seen.status == 2 and all(word in seen.err for word in words), seen.err


def test_an_accuracy_out_of_reach_ends_with_status_3(
    scene: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(simulate_module, "difference", lambda *_: 0.3)
    motion = tmp_path / "motion.csv"
    seen = abu("simulate", scene, "--duration", "10", "--trajectory", str(motion), "--json")
    assert seen.status == 3 and seen.document["error"]["kind"] == "not-trustworthy" and not motion.exists()


# other commands that know scenes
def test_init_validate_and_schema_know_scenes(tmp_path: Path) -> None:
    file = tmp_path / "new.toml"
    assert abu("init", "--scene", str(file)).status == 0
    assert abu("validate", str(file), "msh-230").status == 0
    assert abu("simulate", str(file), "--duration", "10", "--quiet").status == 0
    assert abu("init", "--scene", "--preset", "msh-230", str(tmp_path / "other.toml")).status == 2
    assert "SceneFile" in abu("schema", "scene").out
    seen = abu("size", str(file))
    assert seen.status == 2 and "abu simulate" in seen.err
