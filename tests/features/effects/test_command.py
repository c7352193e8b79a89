"""`abu effects` as its users see it."""

from pathlib import Path

import pytest

from abu_calc.dynamics.effects.registry import REGISTRY
from tests.cli.runner import abu
from tests.inputs.scenes import PLANAR, SCENE

PUBLISHED = {
    "gravity": "conservative",
    "dry_rolling_friction": "dissipative",
    "ball_contact": "dissipative",
    "race_eccentricity": "driven",
    "grinding_contact": "driven",
    "run_up": "driven",
    "motor": "driven",
    "transverse_motion": "driven",
}


@pytest.fixture
def file(tmp_path: Path) -> str:
    """Race eccentricity of 0.01 mm beside an amplitude of 13 mm, and gravity that shakes balls at 19 rpm."""
    path = tmp_path / "scene.toml"
    path.write_text(
        SCENE + "[scene.effects]\ngravity = {}\nrace_eccentricity = { magnitude_mm = 0.0003 }\n", encoding="utf-8"
    )
    return str(path)


def ledger(*arguments: str) -> dict[str, dict]:
    seen = abu("effects", *arguments, "--json")
    assert seen.status == 0, seen.err
    return {entry["name"]: entry for entry in seen.document["result"]["effects"]}


def test_all_effects_there_are() -> None:
    found = ledger()
    assert {name: entry["kind"] for name, entry in found.items()} == {name: kind.kind for name, kind in REGISTRY}
    assert all(found[name]["kind"] == kind for name, kind in PUBLISHED.items())
    assert all(entry["about"][0].isupper() and "\n" not in entry["about"] for entry in found.values())
    assert found["gravity"]["table"] == "scene.effects.gravity"
    seen = abu("effects")
    assert all(name in seen.out for name in found) and seen.width <= 80


@pytest.mark.slow
def test_of_a_scene(file: str) -> None:
    """0.0003/(1 % of 13.33 mm) weighs 0.0023, less than half of 0.01; g/(R_p Ω²) = 2.45 far more."""
    found = ledger(file)
    assert {name: entry["included"] for name, entry in found.items()} == {"race_eccentricity": False, "gravity": True}
    assert found["race_eccentricity"]["weight"] == pytest.approx(0.0003 / 0.1333, rel=0.01)
    assert found["gravity"]["weight"] > 9.8 / 4
    assert all("whirls" in entry["why"] or "swings" in entry["why"] for entry in found.values())
    document = abu("effects", file, "--json").document
    assert document["result"]["scene"] == "scene" and document["model"]["effects"] == ["gravity"]
    # What is simulated is what was told, and the error claimed counts what was left out.
    simulated = abu("simulate", file, "--duration", "20", "--json").document
    assert found["race_eccentricity"]["weight"] < simulated["result"]["error_estimate"] <= 0.01
    assert simulated["checks"][0]["value"] == simulated["result"]["error_estimate"]
    assert "Defaults used" in abu("effects", file, "--full").out
    assert simulated["result"]["effects"] == list(found.values()) and simulated["model"]["effects"] == ["gravity"]


@pytest.mark.parametrize(("accuracy", "included"), [("0.001", True), ("0.004", True), ("0.005", False), ("0.1", False)])
def test_accuracy_decides(file: str, accuracy: str, included: bool) -> None:
    assert ledger(file, "--accuracy", accuracy)["race_eccentricity"]["included"] is included


def test_effects_asked_for(file: str) -> None:
    found = ledger(file, "--with", "race_eccentricity", "--without", "gravity")
    assert {name: entry["included"] for name, entry in found.items()} == {"race_eccentricity": True, "gravity": False}
    assert found["race_eccentricity"]["why"].startswith("asked for")
    assert found["gravity"]["why"].startswith("left out by request")


def test_all_at_once_as_a_scene_and_as_text(tmp_path: Path) -> None:
    path = tmp_path / "all.toml"
    path.write_text(PLANAR, encoding="utf-8")
    found = ledger(str(path))
    assert found.keys() == PUBLISHED.keys()
    # What has no estimate is in.
    assert all(
        found[name]["weight"] is None and found[name]["included"] for name in ("run_up", "motor", "ball_contact")
    )
    seen = abu("effects", str(path), "--full")
    assert seen.status == 0 and seen.width <= 80
    assert "half the accuracy" in " ".join(seen.out.split())
    assert "has data for no effect" in abu("effects", _without_effects(tmp_path)).out


def _without_effects(folder: Path) -> str:
    path = folder / "none.toml"
    path.write_text(SCENE, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize(
    ("name", "options", "effects"),
    [
        ("msh-230", (), {"race_eccentricity", "ball_contact", "dry_rolling_friction"}),
        ("avtovaz-707-222", (), {"race_eccentricity", "gravity", "ball_contact", "dry_rolling_friction"}),
        ("avtovaz-707-222", ("--scene", "grinding"), {
            "race_eccentricity", "gravity", "grinding_contact", "ball_contact", "dry_rolling_friction"}),
        ("avtovaz-707-222", ("--scene", "run-up", "--set", "run_up.time_s=1.0"), {
            "run_up", "race_eccentricity", "gravity", "ball_contact", "dry_rolling_friction"}),
        ("swing-arm-grinder", ("--scene", "swing-arm-cutting"), {
            "race_eccentricity", "gravity", "lift_off", "ball_contact", "dry_rolling_friction"}),
    ],
)  # fmt: skip
def test_of_a_machine(name: str, options: tuple[str, ...], effects: set[str]) -> None:
    found = ledger(name, *options)
    assert found.keys() == effects and all(entry["why"] for entry in found.values())
    assert found["ball_contact"]["included"] and found["race_eccentricity"]["weight"] > 1


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--with", "gravity"), ("need a file",)),
        (("--scene", "idle"), ("need a file",)),
        (("FILE", "--with", "motor"), ("--with", "no data", "gravity", "table")),
        (("FILE", "--with", "graviti"), ("graviti", '"gravity"')),
        (("FILE", "--without", "friction"), ("--without", "friction", "dry_rolling_friction")),
        (("FILE", "--with", "gravity", "--without", "gravity"), ("both in and out",)),
        (("FILE", "--accuracy", "0"), ("accuracy",)),
        (("FILE", "--accuracy", "2"), ("accuracy",)),
        (("FILE", "--scene", "idle"), ("machines",)),
        (("msh-230", "--scene", "run-up"), ("run_up",)),
        (("no-such-machine",), ("no-such-machine",)),
    ],
    ids=lambda value: " ".join(value)[:50],
)
def test_what_is_refused(file: str, arguments: tuple[str, ...], words: tuple[str, ...]) -> None:
    seen = abu("effects", *(file if word == "FILE" else word for word in arguments))
    assert seen.status == 2 and seen.out == "" and "Traceback" not in seen.err
    assert all(word in seen.err for word in words), seen.err
