"""`abu stability` as its users see it."""

from pathlib import Path

import pytest

from tests.cli.runner import abu
from tests.spec.scenes import SCENE

RPM = 9.549296585513721
"""rpm of one rad/s: the natural frequency of the dimensionless rotor."""


@pytest.fixture
def scene(tmp_path: Path) -> str:
    file = tmp_path / "scene.toml"
    file.write_text(SCENE, encoding="utf-8")
    return str(file)


@pytest.mark.parametrize(
    ("ball_mass", "published", "derived"),
    [
        (10, [1.4006], [1.40154]),
        (30, [1.6933], [1.69396]),
        (50, [1.0295, 1.0932, 1.8820], [1.02969, 1.09363, 1.88224]),
    ],
)
def test_published_boundaries(scene: str, ball_mass: float, published: list[float], derived: list[float]) -> None:
    """Rodrigues et al. 2008, fig. 5a: read off a figure, ± 0.001; derived values to their last digit."""
    masses = f"scene.race[0].ball_masses_g=[{ball_mass}, {ball_mass}]"
    seen = abu("stability", scene, "--set", masses, "--speeds", "1:190", "--json")
    result = seen.document["result"]
    speeds = [one["speed_rpm"] / RPM for one in result["boundaries_rpm"]]
    assert speeds == pytest.approx(published, abs=1e-3) and speeds == pytest.approx(derived, abs=1e-5)
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


def test_of_a_machine() -> None:
    """A soft suspension: stable at its speed, unstable near its natural frequency of 150 rpm and below."""
    seen = abu("stability", "avtovaz-707-222", "--speeds", "100:8000", "--json")
    (one,) = seen.document["result"]["boundaries_rpm"]
    assert seen.status == 0 and one["stable_above"] and 130 < one["speed_rpm"] < 200


def test_the_report_fits_80_columns(scene: str) -> None:
    for extra in ((), ("--speeds", "1:190"), ("--set", "scene.stiffness_N_per_m=[1.0, 2.0]")):
        seen = abu("stability", scene, *extra)
        assert max(map(len, seen.out.splitlines())) <= 80
        assert "necessary, not sufficient" in " ".join(seen.out.split())
    assert "17.9741" in abu("stability", scene, "--speeds", "1:190").out


@pytest.mark.parametrize(
    "speeds", ["", "5", "5:", ":5", "50:5", "5:5", "0:5", "-5:5", "nan:5", "5:inf", "5:2e6", "5:6:7", "a:b", "5,1:6"]
)
def test_wrong_speeds_are_refused(scene: str, speeds: str) -> None:
    seen = abu("stability", scene, "--speeds", speeds)
    assert seen.status == 2 and "--speeds" in seen.err and "LOW:HIGH" in seen.err and seen.out == ""


def test_what_is_not_simulated_yet_is_refused(scene: str) -> None:
    for change in ("scene.support=tilting", "scene.support=swing-arm"):
        seen = abu("stability", scene, "--set", change)
        assert seen.status == 2 and "scene." in seen.err
