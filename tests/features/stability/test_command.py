"""`abu stability` as its users see it."""

from pathlib import Path

import pytest

from tests.cli.runner import abu, once
from tests.inputs.scenes import ARM, JOINT_AND_CONTACT, SCENE, TILTING

RPM = 9.549296585513721
"""rpm of one rad/s: the natural frequency of the dimensionless rotor."""


@pytest.fixture
def scene(tmp_path: Path) -> str:
    file = tmp_path / "scene.toml"
    file.write_text(SCENE, encoding="utf-8")
    return str(file)


def test_boundaries_of_two_balls(scene: str) -> None:
    """Of balls of 50 g, as published and derived."""
    seen = abu("stability", scene, "--speeds", "1:190", "--json")
    result = seen.document["result"]
    speeds = [one["speed_rpm"] / RPM for one in result["boundaries_rpm"]]
    assert speeds == pytest.approx([1.02969, 1.09363, 1.88224], abs=1e-5)
    assert result["boundaries_rpm"][-1]["stable_above"] is True
    assert result["stable"] and seen.status == 0


def test_published_eigenvalues_and_the_envelope(scene: str) -> None:
    document = abu("stability", scene, "--json").document
    result = document["result"]
    upper = [complex(*pair) for pair in result["eigenvalues"] if pair[1] > 0]
    expected = [-0.004087 + 0.744047j, -0.004952 + 0.068382j, -0.009185 + 2.956028j, -0.011363 + 1.006468j]
    assert all(abs(a - b) < 1e-6 for a, b in zip(upper, expected, strict=True))
    assert result["growth_rate_per_s"] == pytest.approx(-0.004087, abs=1e-6)
    assert result["boundaries_rpm"] is None and result["floquet_multipliers"] is None
    assert result["resting_angles_deg"] == pytest.approx([95.739, -95.739], abs=1e-3)
    (check,) = document["checks"]
    assert (check["code"], check["status"], check["unit"]) == ("ABU802", "pass", "1/s")
    assert document["model"]["states"] == ["x", "y", "x'", "y'", "θ1", "θ2", "θ1'", "θ2'"]


def test_an_unstable_state_ends_with_status_1(scene: str) -> None:
    seen = abu("stability", scene, "--set", "scene.speed_rpm=12.0", "--json")
    assert seen.status == 1 and seen.document["status"] == "fail"
    assert seen.document["result"]["stable"] is False and seen.document["result"]["growth_rate_per_s"] > 0
    assert seen.document["checks"][0]["remedy"]


def test_no_balanced_state(scene: str) -> None:
    seen = abu("stability", scene, "--set", "scene.imbalance_g_mm=100001", "--speeds", "5:50", "--json")
    document, result = seen.document, seen.document["result"]
    assert seen.status == 1 and result["stable"] is False and result["boundaries_rpm"] == []
    assert result["eigenvalues"] is None and result["growth_rate_per_s"] is None
    assert "no balanced state" in document["checks"][0]["message"]
    assert any("eigenvalues" in warning for warning in document["warnings"])


def test_anisotropic_supports_have_multipliers(scene: str) -> None:
    seen = abu("stability", scene, "--set", "scene.stiffness_N_per_m=[1.0, 2.0]", "--json")
    result = seen.document["result"]
    assert result["eigenvalues"] is None and len(result["floquet_multipliers"]) == 8
    assert any("Floquet" in warning for warning in seen.document["warnings"])
    assert (max(abs(complex(*pair)) for pair in result["floquet_multipliers"]) < 1) is result["stable"]


def test_more_than_two_balls_are_told(scene: str) -> None:
    three = ["--set", "scene.race[0].ball_masses_g=[50, 50, 50]", "--set", "scene.race[0].start_angles_deg=[0, 1, 2]"]
    document = abu("stability", scene, *three, "--json").document
    assert len(document["result"]["eigenvalues"]) == 9 and "arrangements" in document["warnings"][0]


@pytest.mark.slow
def test_of_a_machine() -> None:
    """A soft suspension: stable at its speed, unstable near its natural frequency of 150 rpm and below."""
    seen = abu("stability", "avtovaz-707-222", "--speeds", "100:8000", "--json")
    (one,) = seen.document["result"]["boundaries_rpm"]
    assert seen.status == 0 and one["stable_above"] and 130 < one["speed_rpm"] < 200


@pytest.mark.slow
def test_the_report_fits_80_columns(scene: str) -> None:
    for extra in ((), ("--speeds", "1:190"), ("--set", "scene.stiffness_N_per_m=[1.0, 2.0]")):
        seen = abu("stability", scene, *extra)
        assert seen.width <= 80
        assert "necessary, not sufficient" in " ".join(seen.out.split())
    assert "17.9741" in abu("stability", scene, "--speeds", "1:190").out


@pytest.mark.parametrize(
    "speeds", ["", "5", "5:", ":5", "50:5", "5:5", "0:5", "-5:5", "nan:5", "5:inf", "5:2e6", "5:6:7", "a:b", "5,1:6"]
)
def test_wrong_speeds_are_refused(scene: str, speeds: str) -> None:
    seen = abu("stability", scene, "--speeds", speeds)
    assert seen.status == 2 and "--speeds" in seen.err and "LOW:HIGH" in seen.err and seen.out == ""


IDLE_ARM = f"""\
{ARM.partition(JOINT_AND_CONTACT)[0]}joint_stiffness_N_per_m = 112500.0
joint_damping_N_s_per_m = 150.0
[scene.effects]
gravity = {{}}
dry_rolling_friction = {{ lever_arm_mm = 0.002, ball_radius_mm = 8.0 }}
"""
HEAVIER = [
    *("mass_kg=1.2", "speed_rpm=3800.0", "imbalance_g_mm=10.0", "duration_s=12.0", "tilting.ball_tilt_inertia=false"),
    *("race[0].plane_offset_mm=110.0", "race[0].ball_masses_g=[3.0, 3.0]", "race[0].rolling_drag_per_s=20.0"),
    *("race[1].plane_offset_mm=-150.0", "race[1].ball_masses_g=[3.0, 3.0]", "race[1].rolling_drag_per_s=30.0"),
]
"""The shared tilting rotor with heavier balls in the planes of its bearings."""


def written(tmp_path: Path, text: str) -> str:
    file = tmp_path / "other.toml"
    file.write_text(text, encoding="utf-8")
    return str(file)


@pytest.mark.slow
def test_a_swing_arm(tmp_path: Path) -> None:
    """The worked arm at Ω/ω₀ = 2: balanced with balls at ± 131.8°, multipliers, the damping of (24)."""
    document = abu("stability", written(tmp_path, IDLE_ARM), "--speeds", "200:6000", "--json").document
    result = document["result"]
    assert result["stable"] and result["state"] == "balanced" and result["eigenvalues"] is None
    assert sorted(result["resting_angles_deg"]) == pytest.approx([-131.81, 131.81], abs=0.01)
    assert len(result["floquet_multipliers"]) == 6 and len(result["boundaries_rpm"]) == 1
    assert result["critical_damping_N_s_per_m"] == pytest.approx(4e-4 / 0.3 * 150, rel=0.005)  # balls add inertia
    assert result["effects_left_out"] == ["gravity", "dry_rolling_friction"]
    assert any("dry_rolling_friction" in told and "gravity" not in told for told in document["warnings"])


@pytest.mark.slow
def test_a_swing_arm_alone(tmp_path: Path) -> None:
    file = written(tmp_path, IDLE_ARM)
    empty = ["--set", "scene.race[0].ball_masses_g=[]", "--set", "scene.race[0].start_angles_deg=[]"]
    seen = abu("stability", file, *empty, "--json")
    assert seen.status == 0 and seen.document["result"]["state"] == "arm alone"
    assert abu("stability", file, *empty).out.count("°") == 0
    seen = abu("stability", file, "--set", "scene.imbalance_g_mm=700", "--json")
    result = seen.document["result"]
    assert seen.status == 1 and result["stable"] is False and len(result["floquet_multipliers"]) == 2
    assert any("cannot carry" in told for told in seen.document["warnings"])


def sets(*entries: str) -> list[str]:
    """Options that change entries of the scene."""
    return [word for entry in entries for word in ("--set", f"scene.{entry}")]


@pytest.mark.hard
def test_a_tilting_rotor(tmp_path: Path) -> None:
    heavier = written(tmp_path, TILTING), *sets(*HEAVIER)
    result = abu("stability", *heavier, "--speeds", "1000:6000", "--json").document["result"]
    assert result["stable"] and len(result["resting_angles_deg"]) == 4 and len(result["boundaries_rpm"]) == 3
    assert result["critical_damping_N_s_per_m"] is None
    alike = "tilting.bearing_stiffness_N_per_m=[[2e4, 2e4], [2e4, 2e4]]"
    damped = "tilting.bearing_damping_N_s_per_m=[[5, 5], [5, 5]]"
    result = abu("stability", *heavier, *sets(alike, damped), "--json").document["result"]
    assert len(result["eigenvalues"]) == 16 and result["floquet_multipliers"] is None


def test_what_is_not_known_is_not_done(tmp_path: Path) -> None:
    lone = sets("race[1].ball_masses_g=[]", "race[1].start_angles_deg=[]")
    seen = abu("stability", written(tmp_path, TILTING), *lone, "--speeds", "1000:6000", "--json")
    assert seen.status == 1 and seen.document["status"] == "not-done"
    assert seen.document["result"]["stable"] is None and seen.document["result"]["boundaries_rpm"] is None
    assert "differs along x and y" in seen.document["checks"][0]["message"]


@pytest.mark.hard
def test_scenes_of_a_machine() -> None:
    tables = ["--set", "swing_arm.arm_length_mm=350.0"]
    for name in ("swing-arm-idle", "swing-arm-cutting"):
        result = abu("stability", "avtovaz-707-222", *tables, "--scene", name, "--json").document["result"]
        assert result["floquet_multipliers"] and result["critical_damping_N_s_per_m"] > 0
    seen = abu("stability", "avtovaz-707-222", "--scene", "run-up")
    assert seen.status == 2 and "--scene" in seen.err and "swing-arm-idle" in seen.err


@pytest.mark.slow
def test_size_tells_the_true_region() -> None:
    frequency = once("size", "avtovaz-707-370", "--json").document["result"]["frequency"]
    (one,) = frequency["stability_boundaries_rpm"]
    assert frequency["stable"] is True and one["stable_above"] and 130 < one["speed_rpm"] < 250


GRINDING = """\
[scene.effects.grinding_contact]
press_force_N = 45.0
cutting_coefficient = 0.35
contact = "compliant"
contact_stiffness_N_per_m = 2.0
"""


def test_no_verdict_on_an_idle_state_where_the_scene_grinds(tmp_path: Path) -> None:
    file = written(tmp_path, SCENE + GRINDING)
    seen = abu("stability", file, "--speeds", "1:190", "--json")
    result, (check,) = seen.document["result"], seen.document["checks"]
    assert seen.status == 1 and seen.document["status"] == check["status"] == "not-done"
    assert result["stable"] is None and result["eigenvalues"] is None and result["boundaries_rpm"] is None
    assert "presses the wheel" in check["message"] and "abu simulate" in check["remedy"]
    face = written(tmp_path, SCENE + GRINDING.replace("compliant", "face").split("contact_stiffness")[0])
    assert abu("stability", face, "--json").document["result"]["stable"] is True


FOUR = ("--set", "scene.race[0].ball_masses_g=[50, 50, 50, 50]")
TWO_AND_TWO = (*FOUR, "--set", "scene.race[0].start_angles_deg=[90, 90, -90, -90]")


@pytest.mark.slow
def test_which_arrangement_is_judged(scene: str) -> None:
    """Two and two are less stable than the even fan; the worst is the default, and told."""
    rates = {}
    for way in ("worst", "fan", "start"):
        document = abu("stability", scene, *TWO_AND_TWO, "--arrangement", way, "--json").document
        assert document["result"]["arrangement"] == way and len(document["result"]["resting_angles_deg"]) == 4
        rates[way] = document["result"]["growth_rate_per_s"]
        assert any("arrangements" in told for told in document["warnings"])
    plain = abu("stability", scene, *TWO_AND_TWO, "--json").document["result"]
    assert plain["growth_rate_per_s"] == rates["worst"] >= max(rates.values()) - 1e-12
    seen = abu("stability", scene, "--arrangement", "best")
    assert seen.status == 2 and "arrangement" in seen.err and "worst" in seen.err
    bunched = ("--set", "scene.race[0].start_angles_deg=[0, 0, 0, 0]")
    seen = abu("stability", scene, *FOUR, *bunched, "--arrangement", "start", "--json")
    assert seen.document["status"] == "not-done" and seen.document["result"]["stable"] is None


def test_every_crossing_on_request(scene: str) -> None:
    masses = "scene.race[0].ball_masses_g=[50, 50]"
    result = abu("stability", scene, "--set", masses, "--speeds", "1:190", "--crossings", "--json").document["result"]
    crossed = {round(one["speed_rpm"] / RPM, 5): (one["growing_below"], one["growing_above"])
               for one in result["crossings_rpm"]}  # fmt: skip
    assert {1.02969, 1.09363, 1.88224} <= set(crossed)
    assert crossed[1.88224] == (2, 0) and crossed[1.09363] == (0, 2)
    assert abu("stability", scene, "--speeds", "1:190", "--json").document["result"]["crossings_rpm"] is None
    unasked = abu("stability", scene, "--set", masses, "--crossings", "--json").document["result"]
    assert {1.02969, 1.09363, 1.88224} <= {round(one["speed_rpm"] / RPM, 5) for one in unasked["crossings_rpm"]}
    assert "growing eigenvalues below" in abu("stability", scene, "--speeds", "1:190", "--crossings").out


def test_it_speaks_of_one_state_and_of_balls_that_hang(scene: str) -> None:
    """N = 0.1/1.1, ω = 1/√1.1, ζ = 0.01/√1.1: N ω²/(2ζ(Ω − ω)) by the equal axes."""
    document = abu("stability", scene, "--json").document
    hanging, w = document["result"]["hanging"], 1.1**-0.5
    (bound,) = hanging["bounds"]
    expected = (0.1 / 1.1) * w**2 / (2 * 0.01 * w * (2.0 - w))
    assert bound["state"] == "at a resonance" and bound["drag_per_s"] == pytest.approx(expected, rel=1e-3)
    assert hanging["doubt"] and bound["margin"] == pytest.approx(0.01 / bound["drag_per_s"])
    text = " ".join(abu("stability", scene).out.split())
    assert (
        "holds for the balanced state and small disturbances" in text
        and "Balls may stall" in text
        and "--scene run-up" in text
    )
    drag = "scene.race[0].rolling_drag_per_s=6.0"
    text = " ".join(abu("stability", scene, "--set", drag).out.split())
    assert "No ball stalls" in text and "Balls may hang" not in text
