"""`abu simulate` as its users see it."""

import csv
import math
from pathlib import Path

import pytest

from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.simulation import simulate as simulate_module
from tests.cli.runner import abu
from tests.inputs.scenes import ARM, PLANAR, SCENE, TILTING

KEYS = {
    "scene", "duration_s", "quiet_time_s", "rest_time_s", "creeping", "settling_time_s", "residual_imbalance_g_mm",
    "axis_amplitude_mm", "velocity_rms_mm_per_s", "level_db", "final", "effects", "cost", "error_estimate", "rung",
    "envelope",
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


def test_the_envelope(scene: str) -> None:
    document = abu("simulate", scene, "--set", "scene.duration_s=50", "--json").document
    result, model = document["result"], document["model"]
    assert result.keys() >= KEYS and document["abu"]["command"] == "simulate"
    assert result["final"].keys() == {
        "t_s", "x_mm", "y_mm", "vx_mm_per_s", "vy_mm_per_s", "ball_angles_deg", "ball_speeds_rpm", "ball_rates_rpm",
        "rotor_speed_rpm",
    }  # fmt: skip
    (check,) = document["checks"]
    assert (check["code"], check["name"], check["status"]) == ("ABU801", "accuracy reached", "pass")
    assert check["value"] == result["error_estimate"] <= check["limit"] == 0.01
    assert result["effects"] == [] and result["final"]["t_s"] == result["duration_s"] == 50
    assert model["states"] == ["x", "y", "x'", "y'", "θ1", "θ2", "θ1'", "θ2'"]
    assert model["speed_rad_per_s"] == pytest.approx(2.0) and model["imbalance_kg_m"] == pytest.approx(0.01)
    assert model["mass_kg"] == [[1.0, 0.0], [0.0, 1.0]] and model["stiffness_N_per_m"] == [[1.0, 0.0], [0.0, 1.0]]
    assert model["damping_N_s_per_m"] == [[0.02, 0.0], [0.0, 0.02]]
    (race,) = model["races"]
    assert race["ball_masses_kg"] == [0.05, 0.05] and model["effects"] == []
    assert (race["pitch_radius_m"], race["drag_per_s"], race["inertia_factor"]) == (1.0, 0.01, 1.0)
    assert race["start_angles_rad"] == pytest.approx([math.pi / 2, -math.pi / 2])
    assert result["cost"].keys() >= {"integrator", "tolerance", "evaluations", "steps", "wall_s"}


@pytest.mark.slow
def test_a_scene_moves_from_where_it_says(tmp_path: Path) -> None:
    text = SCENE.replace(
        "rolling_inertia = false",
        "rolling_inertia = true\ninitial = { x_mm = 3.0, y_mm = -2.0, vx_mm_per_s = 5.0, vy_mm_per_s = 7.0 }",
    ).replace("duration_s = 700.0", "duration_s = 20.0")
    text += "start_speeds_rpm = [1.0, -2.0]\n"
    motion = tmp_path / "motion.csv"
    seen = abu("simulate", written(tmp_path, text), "--trajectory", str(motion), "--samples", "20001", "--json")
    model, rows = seen.document["model"], rows_of(motion)
    assert model["races"][0]["inertia_factor"] == 1.4
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
        del result["cost"], result["envelope"]
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


@pytest.mark.slow
def test_a_trajectory_holds_all_that_moves(tmp_path: Path) -> None:
    """Its last row is the end that is reported; bearings and the ball's way along the spindle by own geometry."""
    effects = """[scene.effects]
run_up = { time_s = 0.05 }
transverse_motion = { groove_radius_mm = 9.0, ball_radius_mm = 4.0, axial_runout_mm = 0.05 }
"""
    motion = tmp_path / "motion.csv"
    options = ("--with", "transverse_motion", "--trajectory", str(motion), "--samples", "11", "--json")
    text = written(tmp_path, TILTING + effects)
    final = abu("simulate", text, "--duration", "0.1", *options).document["result"]["final"]
    rows = rows_of(motion)
    balls = [f"ball{k}_deg" for k in (1, 2, 3, 4)]
    places = [f"bearing{k}_{axis}_mm" for k in (1, 2) for axis in "xy"]
    axial = [f"ball{k}_axial_mm" for k in (1, 2, 3, 4)]
    assert list(rows[0]) == [
        "t_s", "x_mm", "y_mm", *balls, "tilt_x_mrad", "tilt_y_mrad", *places, *axial, "rotor_speed_rpm",
    ]  # fmt: skip
    for name in ("x_mm", "tilt_x_mrad", "tilt_y_mrad", "rotor_speed_rpm"):
        assert rows[-1][name] == pytest.approx(final[name], rel=1e-9)
    assert rows[5]["rotor_speed_rpm"] == pytest.approx(final["rotor_speed_rpm"])
    assert rows[0]["rotor_speed_rpm"] == 0
    for row in rows[1:]:
        for k, place in ((1, 110.0), (2, -150.0)):
            assert row[f"bearing{k}_x_mm"] == pytest.approx(row["x_mm"] + 1e-3 * place * row["tilt_y_mrad"], rel=1e-9)
            assert row[f"bearing{k}_y_mm"] == pytest.approx(row["y_mm"] - 1e-3 * place * row["tilt_x_mrad"], rel=1e-9)
    assert 1e-4 < max(abs(row[name]) for row in rows for name in axial) < 5
    arm = abu("simulate", written(tmp_path, ARM), "--duration", "0.1", *options[2:], "--force").document["result"]
    rows = rows_of(motion)
    assert list(rows[0]) == ["t_s", "x_mm", "y_mm", "ball1_deg", "ball2_deg", "arm_angle_mrad"]
    assert rows[-1]["arm_angle_mrad"] == pytest.approx(arm["final"]["arm_angle_mrad"], rel=1e-9)
    for row in rows:
        assert row["y_mm"] == pytest.approx(300 * math.sin(row["arm_angle_mrad"] / 1000), rel=1e-9)


# supports and effects
STALLED = """[scene]
mass_kg = 4.0
stiffness_N_per_m = [1000.0, 1000.0]
damping_N_s_per_m = [60.0, 60.0]
speed_rpm = 3000.0
imbalance_g_mm = 100.0
duration_s = 3.0
[[scene.race]]
pitch_radius_mm = 24.0
ball_masses_g = [16.7, 16.7]
rolling_drag_per_s = 20.0
start_angles_deg = [90.0, -90.0]
[scene.effects]
motor = { stall_torque_N_m = 0.8, no_load_speed_rpm = 6000.0, rotor_inertia_kg_m2 = 2e-3 }
grinding_contact = { contact = "face", press_force_N = 45.0, cutting_coefficient = 0.35, wheel_radius_mm = 75.0 }
"""


def test_a_motor_weaker_than_cutting_stands_and_is_not_driven_backward(tmp_path: Path) -> None:
    """45 N · 0.35 · 75 mm = 1.18 N·m against 0.8 N·m at standstill."""
    seen = abu("simulate", written(tmp_path, STALLED), "--json").document
    assert seen["result"]["final"]["rotor_speed_rpm"] == pytest.approx(0.0, abs=1e-6)
    assert any("stands on the work" in warning and "1.18 N·m" in warning for warning in seen["warnings"])


def test_a_tilting_rotor_tells_tilts_and_bearings(tmp_path: Path) -> None:
    document = abu("simulate", written(tmp_path, TILTING), "--duration", "0.2", "--json").document
    final, model = document["result"]["final"], document["model"]
    assert len(final["bearing_amplitudes_mm"]) == 2 and len(final["ball_angles_deg"]) == 4
    assert {"tilt_x_mrad", "tilt_y_mrad"} < final.keys() and "arm_angle_mrad" not in final
    assert len(model["states"]) == 8 + 8 and [race["plane_offset_m"] for race in model["races"]] == [0.02, -0.02]
    assert model["couple_kg_m2"] == pytest.approx(6.8e-5 * (0.0138 - 0.00124))


def test_the_tilts_are_those_that_move_the_axis_off_the_middle(tmp_path: Path) -> None:
    """Displacement at z: x + iy + z (θ_y − iθ_x), against the amplitudes at two bearings of one rigid shaft.

    Without balls, and with a couple alone along +x, bearings alike: the shaft nods about its middle.
    """
    text = TILTING.replace("imbalance_g_mm = 50", "imbalance_g_mm = 0").replace("[2.0, 2.0]", "[]")
    text = text.replace("start_angles_deg = [10, 60]", "start_angles_deg = []").replace(
        "[110.0, -150.0]", "[100, -100]"
    )
    result = abu("simulate", written(tmp_path, text), "--duration", "3", "--json").document["result"]
    final = result["final"]
    assert result["axis_amplitude_mm"] < 1e-9
    one, other = final["bearing_amplitudes_mm"]
    assert one == pytest.approx(other) and one > 0.001
    # Above its critical speed the shaft nods against the couple; after whole turns at θ_y < 0, θ_x near 0.
    assert -1.01 * one < 0.1 * final["tilt_y_mrad"] < -0.9 * one * math.cos(math.radians(20))
    assert abs(final["tilt_x_mrad"]) < abs(final["tilt_y_mrad"])


def test_a_swing_arm_tells_its_angle(tmp_path: Path) -> None:
    document = abu("simulate", written(tmp_path, ARM), "--duration", "0.5", "--json").document
    final, model = document["result"]["final"], document["model"]
    assert model["states"] == ["arm_angle", "arm_angle'", "θ1", "θ2", "θ1'", "θ2'"]
    # The axis is where the arm carries it, 0.3 m from its joint.
    assert final["y_mm"] == pytest.approx(300 * math.sin(final["arm_angle_mrad"] / 1000))
    assert final["x_mm"] == pytest.approx(300 * (math.cos(final["arm_angle_mrad"] / 1000) - 1))


@pytest.mark.few(2)
@pytest.mark.parametrize(
    ("effect", "states"),
    [
        ("gravity", []),
        ("race_eccentricity", []),
        ("ball_contact", []),
        ("dry_rolling_friction", []),
        ("grinding_contact", []),
        ("run_up", ["turn", "turn'"]),
        ("motor", ["turn", "turn'"]),
        ("transverse_motion", ["across1", "across2", "across'1", "across'2"]),
    ],
)
def test_the_model_has_the_states_that_are_integrated(tmp_path: Path, effect: str, states: list[str]) -> None:
    """Every effect of the file's example alone: it is in, and adds its own states to axis, body and balls."""
    there = [name for name, _ in REGISTRY if f"{name} = {{" in PLANAR or f".{name}]" in PLANAR]
    left_out = [word for name in there if name != effect for word in ("--without", name)]
    document = abu("simulate", written(tmp_path, PLANAR), "--duration", "4", "--with", effect, *left_out,
                   "--json").document  # fmt: skip
    model = document["model"]
    assert model["states"][:4] == ["x", "y", "body_x", "body_y"] and model["states"][12:] == states
    assert len(model["states"]) == 12 + len(states) and model["effects"] == [effect]
    assert {entry["name"]: entry["included"] for entry in document["result"]["effects"]} == {
        name: name == effect for name in there
    }


@pytest.mark.slow
def test_a_run_up_ends_at_full_speed(tmp_path: Path) -> None:
    text = SCENE + "[scene.effects]\nrun_up = { time_s = 30.0 }\n"
    motion = tmp_path / "motion.csv"
    seen = abu("simulate", written(tmp_path, text), "--duration", "60", "--trajectory", str(motion), "--json")
    assert seen.document["result"]["final"]["rotor_speed_rpm"] == pytest.approx(19.0985931710274)
    # Before it turns, nothing moves.
    first, second = rows_of(motion)[:2]
    assert math.hypot(second["x_mm"], second["y_mm"]) < 0.1 and first["x_mm"] == 0


@pytest.mark.slow
def test_an_audit_tells_what_was_left_out(tmp_path: Path) -> None:
    """Gravity of a scene that turns fast weighs little and is left out; the audit takes it in and compares.

    Σ m R_p a/2 at 2Ω drives the axis, a = g/(R_p Ω²), the balls near ± 96°, whose e^{2iθ} nearly add up. The race is
    off: what stays of its whirl is what the machine is quiet beside; of nothing gravity would be everything.
    """
    text = SCENE + "[scene.effects]\ngravity = {}\nrace_eccentricity = {magnitude_mm = 0.1}\n"
    fast = ("--set", "scene.speed_rpm=3000", "--set", "scene.stiffness_N_per_m=[24674.0, 24674.0]", "--set",
            "scene.damping_N_s_per_m=[31.0, 31.0]", "--set", "scene.race[0].rolling_drag_per_s=25",
            "--duration", "3")  # fmt: skip
    file = written(tmp_path, text)
    document = abu("simulate", file, *fast, "--accuracy", "0.1", "--audit", "--json").document
    (gravity,) = (effect for effect in document["result"]["effects"] if effect["name"] == "gravity")
    moment, square = 0.1 * 9.80665 / 314.159**2 / 2, 314.159**2
    weight = moment * 4 * square / (1.1 * 4 * square - 24674) / (0.01 * 0.01 * square / (1.1 * square - 24674))
    assert not gravity["included"] and gravity["weight"] == pytest.approx(
        weight, rel=0.15
    )  # by which mass, M or M + 2m
    audit = document["result"]["audit"]
    assert audit["effects"] == ["gravity"] and audit["promise"] == gravity["weight"]
    assert gravity["weight"] / 3 < audit["difference"] < 3 * gravity["weight"] and audit["evaluations"] > 0
    checks = {check["code"]: check for check in document["checks"]}
    assert checks["ABU803"]["status"] == "pass" and checks["ABU803"]["value"] == audit["difference"]
    seen = abu("simulate", file, *fast, "--with", "gravity", "--audit", "--full")
    assert seen.status == 0 and "No effect was left out" in seen.out
    seen = abu("simulate", file, "--without", "gravity", "--duration", "60", "--audit", "--json")
    assert seen.status == 1 and seen.document["checks"][1]["remedy"]  # at 19 rpm gravity is all there is


@pytest.mark.slow
def test_the_rung_is_told(scene: str, tmp_path: Path) -> None:
    """Light balls are slow: their averages do for two per cent, and the equations are taken for less."""
    heavy = " ".join(abu("simulate", scene, "--duration", "50", "--full").out.split())
    assert "The envelope is not accurate enough: the balls' own rate" in heavy
    light = written(tmp_path, SCENE.replace("[50.0, 50.0]", "[0.2, 0.2]").replace("10000.0", "100.0"))
    options = ("--set", "scene.damping_N_s_per_m=[0.6, 0.6]", "--set", "scene.race[0].rolling_drag_per_s=0.04",
               "--duration", "600", "--json")  # fmt: skip
    slow = abu("simulate", light, *options, "--accuracy", "0.05").document
    full = abu("simulate", light, *options, "--accuracy", "0.001").document
    assert slow["result"]["rung"] == "envelope" and full["result"]["rung"] == "equations"
    assert slow["checks"][0]["status"] == "pass" and "averages" in slow["checks"][0]["message"]
    assert slow["result"]["envelope"]["error_estimate"] == slow["result"]["error_estimate"] <= 0.05
    assert full["result"]["envelope"]["error_estimate"] > 0.001 and full["result"]["envelope"]["why"]
    one, other = (document["result"]["final"]["ball_angles_deg"] for document in (slow, full))
    assert one == pytest.approx(other, abs=math.degrees(0.05))
    text = abu("simulate", light, *options[:-1], "--accuracy", "0.05", "--full")
    assert text.status == 0 and "envelope (averaged slow motion)" in text.out


def test_integrators_agree(scene: str) -> None:
    told = {
        name: abu("simulate", scene, "--duration", "60", "--integrator", name, "--json").document["result"]
        for name in ("scipy", "compiled")
    }
    names = [result["cost"]["integrator"] for result in told.values()]
    assert names == ["scipy-dop853", "compiled-dop853"]
    one, other = (result["final"]["ball_angles_deg"] for result in told.values())
    assert one == pytest.approx(other, abs=math.degrees(0.01))


@pytest.mark.few(1)
@pytest.mark.parametrize("balls", [0, 1, 5])
def test_any_number_of_balls(tmp_path: Path, balls: int) -> None:
    masses, angles = [20.0] * balls, [40.0 * k for k in range(balls)]
    text = SCENE.replace("[50.0, 50.0]", str(masses)).replace("[90.0, -90.0]", str(angles)).replace("700.0", "30.0")
    seen = abu("simulate", written(tmp_path, text))
    assert seen.status == 0 and seen.width <= 80
    assert abu("stability", written(tmp_path, text), "--quiet").status in (0, 1)


# machines
@pytest.mark.slow
def test_duration_of_a_machine() -> None:
    assert abu("simulate", "msh-230", "--duration", "0.2", "--json").document["result"]["duration_s"] == 0.2


@pytest.mark.slow
def test_the_report_fits_80_columns(scene: str) -> None:
    for seen in (abu("simulate", "avtovaz-707-222", "--duration", "0.3"), abu("simulate", scene, "--duration", "40")):
        assert seen.status == 0 and seen.width <= 80
        text = " ".join(seen.out.split())
        assert "not quiet by the end" in text or "quiet after" in text


# what is refused
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--scene", "idle"), ("--scene", "machines")),
        (("--start", "spread"), ("--start", "machines")),
        (("--scene", "idel"), ("--scene", "idle")),
        (("--scene", "grinding"), ("--scene", "machines")),
        (("--start", "bunch"), ("--start", "bunched")),
        (("--accuracy", "0"), ("accuracy",)),
        (("--accuracy", "nan"), ("accuracy",)),
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
        (("--with", "gravity"), ("--with", "gravity", "no data", "table")),
        (("--with", "gravitation"), ("gravitation", '"gravity"')),
        (("--without", "balls_contact"), ("balls_contact", '"ball_contact"')),
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


@pytest.mark.few(2)
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("simulate", "mmg-3200k-knife-shaft"), ("bearings only",)),
        (("simulate", "msh-230", "--scene", "swing-arm-idle"), ("swing_arm", "abu init")),
        (("simulate", "msh-230", "--scene", "run-up"), ("run_up",)),
        (("simulate", "msh-231"), ("msh-230",)),
        (("simulate", "msh-230", "--set", "scene.mass_kg=3"), ("scene",)),
        (("simulate",), ("Missing argument",)),
        (("simulate", "msh-230", "--with", "gravity"), ("--with", "no data", "race_eccentricity")),
        (
            ("simulate", "msh-230", "--with", "ball_contact", "--without", "ball_contact"),
            ("--without", "both in and out"),
        ),
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


@pytest.mark.slow
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


@pytest.mark.slow
def test_every_integrator_is_taken_by_name(tmp_path: Path) -> None:
    """As the help names them; one that is gone, with what replaces it."""
    file = written(tmp_path, SCENE.replace("700.0", "20.0"))
    for name in ("auto", "scipy", "plain", "compiled"):
        assert abu("simulate", file, "--integrator", name, "--quiet").status == 0
    seen = abu("simulate", file, "--integrator", "odeint")
    assert seen.status == 2 and "auto, scipy, plain, compiled)" in seen.err
    seen = abu("simulate", file, "--integrator", "heyoka")
    assert seen.status == 2 and "Use auto or compiled" in seen.err


@pytest.mark.parametrize(
    ("text", "entry"),
    [(ARM, "scene.swing_arm.contact_stiffness_N_per_m=1e11"), (PLANAR, "scene.stiffness_N_per_m=[1e11, 1e11]")],
)
@pytest.mark.slow
def test_what_oscillates_too_fast_for_its_duration_is_not_begun(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, entry: str
) -> None:
    """Work is counted in the cycles of what is fastest, not in revolutions alone."""
    monkeypatch.setattr(simulate_module, "evaluate", None)  # which nothing reaches
    seen = abu("simulate", written(tmp_path, text), "--set", entry)
    assert seen.status == 3
    for word in ("more work than allowed", "allowed: 2e+06", "times in a revolution", "stiffness", "--most-eval"):
        assert word in seen.err


def test_a_stiff_arm_within_the_work_is_answered(tmp_path: Path) -> None:
    """ω = l √(c/J), for as many of its cycles as the machine's own stiffness makes in the whole run."""
    entries = ("scene.swing_arm.contact_stiffness_N_per_m=1e8", "scene.duration_s=0.1")
    sets = [word for entry in entries for word in ("--set", entry)]
    assert abu("simulate", written(tmp_path, ARM), *sets).status == 0
