"""`abu declare` as people call it: screens, exit statuses, keys of the result, options that exclude each other."""

from pathlib import Path

import pytest

from tests.cli.runner import abu, once
from tests.features.declare.machines import S100, S150, written
from tests.features.declare.recordings import MV, run_file

KEYS = {
    "test_wheel", "handle", "without", "with", "handles", "break_even_eccentricity_mm", "friction_rms_mm", "lowers",
}  # fmt: skip
PRESETS = ("angle-grinder-125", "avtovaz-707-222", "avtovaz-707-305", "avtovaz-707-370", "msh-230")


@pytest.mark.few(1)
@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.slow
def test_presets_have_a_screen(preset: str) -> None:
    seen = once("declare", preset, "--starts", "500")
    assert seen.status == 0, seen.err
    assert "declared with" in seen.out and "break-even" in seen.out
    assert seen.width <= 80 and len(seen.out.splitlines()) <= 48


@pytest.mark.slow
def test_a_common_tool_shows_its_handles_out_of_the_box() -> None:
    """Two handles in three axes, the limit of a_hv, and a declared value that falls by more than K."""
    for command in ("size", "levels", "declare"):
        seen = once(command, "angle-grinder-125", *(("--starts", "500") if command == "declare" else ()))
        assert seen.status == 0 and "PASS" in seen.out and "point mass" not in seen.out
        assert seen.width <= 80 and len(seen.out.splitlines()) <= 48
        assert "rear" in seen.out and "side" in seen.out
    checks = {check["code"]: check["status"] for check in once("declare", "angle-grinder-125", "--starts", "500",
              "--json").document["checks"]}  # fmt: skip
    assert checks == {"ABU431": "pass", "ABU432": "pass", "ABU433": "pass"}


@pytest.mark.slow
def test_a_horizontal_spindle_tells_the_vertical_case_beside() -> None:
    """Friction below gravity leaves nothing: no spread of runs is printed, and both cases stand in the table."""
    seen = once("declare", "avtovaz-707-222", "--starts", "500")
    assert "spindle vertical, friction holds" in seen.out and "every start" in seen.out
    assert "standard error" not in seen.out and "rolling friction" not in seen.out.split("Causes")[1].split("Notes")[0]


@pytest.mark.slow
def test_the_document_has_the_fixed_keys(tmp_path: Path) -> None:
    result = abu("declare", written(tmp_path, S150), "--starts", "500", "--json").document["result"]
    assert result.keys() >= KEYS
    assert result["test_wheel"].keys() >= {"diameter_mm", "imbalance_g_mm", "source"}
    assert result["without"].keys() >= {"a_hv_m_per_s2", "K_m_per_s2"}
    assert result["with"].keys() >= {
        "a_hv_m_per_s2", "p05", "p50", "p95", "factor", "declared_m_per_s2", "K_m_per_s2",
    }  # fmt: skip
    assert result["handles"][0].keys() >= {"name", "without_m_per_s2", "with_m_per_s2"}


def test_balls_that_cannot_balance_end_with_one(tmp_path: Path) -> None:
    seen = abu("declare", written(tmp_path, S150), "--set", "type_test.test_wheel_imbalance_g_mm=500", "--json")
    assert seen.status == 1
    assert seen.document["result"]["with"] is None


@pytest.mark.parametrize("preset", ["pedestal-grinder", "washing-machine-two-races"])
def test_a_machine_with_two_races_declares_no_value(preset: str) -> None:
    """The type test of ISO 28927-4 is one of hand-held machines with one wheel."""
    seen = abu("declare", preset)
    assert seen.status == 2 and not seen.out
    words = (
        f"{preset}:",
        "hand-held",
        "found two [[autobalancer]]",
        "one [wheel]",
        "`abu size FILE`",
        "`abu grinding FILE`",
    )
    assert all(word in seen.err for word in words), seen.err
    assert len(seen.err.splitlines()) == 2


def test_a_wheel_without_a_test_wheel_ends_with_two(tmp_path: Path) -> None:
    seen = abu("declare", written(tmp_path, S100), "--set", "wheel.diameter_mm=60")
    assert seen.status == 2
    assert "test_wheel_imbalance_g_mm" in seen.err and "Traceback" not in seen.err


@pytest.mark.parametrize(
    "arguments",
    [
        (), ("avtovaz-707-222", "--recordings", "a.csv"), ("avtovaz-707-222", "--sensitivity", "10"),
        ("avtovaz-707-222", "--automatic-balancing"), ("avtovaz-707-222", "--starts", "1"),
        ("sapropel-screw-rig",), ("mmg-3200k-knife-shaft",), ("nothing.toml",), ("--recordings", "nothing.csv"),
        ("--recordings", "nothing.toml"), ("--recordings", "avtovaz-707-222"),
    ],
)  # fmt: skip
def test_wrong_options_end_with_two(arguments: tuple[str, ...]) -> None:
    seen = abu("declare", *arguments)
    assert seen.status == 2, seen.out
    assert "Traceback" not in seen.err and "bug" not in seen.err


@pytest.mark.slow
def test_recordings_of_a_command_line(tmp_path: Path) -> None:
    files = [run_file(tmp_path, f"{run}.csv", 1.0 + 0.01 * run, unit="mV", per_unit=MV) for run in (1, 2, 3)]
    options = [part for file in files for part in ("--recordings", file)]
    assert abu("declare", *options).status == 2
    seen = abu("declare", *options, "--sensitivity", "100 mV/g", "--automatic-balancing", "--json")
    result = seen.document["result"]
    assert seen.status == 0 and result["factor"] == 1.3
    assert {"a_hd_m_per_s2", "K_m_per_s2", "s_R_m_per_s2", "coefficient_of_variation", "runs"} <= result.keys()
    screen = abu("declare", *options, "--sensitivity", "100 mV/g")
    assert screen.width <= 80 and len(screen.out.splitlines()) <= 48


@pytest.mark.slow
def test_pages_and_figures(tmp_path: Path) -> None:
    page, file = tmp_path / "page.html", written(tmp_path, S150)
    assert abu("declare", file, "--starts", "500", "--output", str(page)).status == 0
    text = page.read_text(encoding="utf-8")
    assert text.count("<svg") == 3 and "Causes with the autobalancer" in text
    measured = tmp_path / "measured.html"
    runs = [part for run in (1, 2) for part in ("--recordings", run_file(tmp_path, f"{run}.csv", float(run)))]
    abu("declare", *runs, "--output", str(measured))
    assert measured.read_text(encoding="utf-8").count("<svg") == 1


def test_new_list_of_recordings_reads_back(tmp_path: Path) -> None:
    path = tmp_path / "list.toml"
    assert abu("init", "--recordings", str(path)).status == 0
    assert abu("validate", str(path)).status == 0
    assert abu("schema", "recordings").status == 0
