"""`abu grinding`: verdict first, on one screen; what the format promises; golden machine; refusals."""

import cmath
import math
from functools import cache

import pytest

import abu_calc
from abu_calc.features.grinding.view import grinding_blocks, grinding_screen
from abu_calc.reporting.screen import as_text
from tests.cli.runner import abu, once
from tests.remembered import recalled

STRAIGHT = "avtovaz-707-222"
GOLDEN = {
    "suspension.natural_frequencies_hz": [80 / (2 * math.pi), 120 / (2 * math.pi)],
    "suspension.damping_ratios": [0.2, 0.2],
    "wheel.imbalance_g_mm": 100.0,
    "wheel.runout_mm": 0.04,
    "wheel.runout_angle_deg": math.degrees(0.6),
    "grinding.contact": "rigid",
    "grinding.press_force_N": 400.0,
    "autobalancer.ball_count": 2,
    "autobalancer.ball_diameter_mm": 16.0,
    "autobalancer.race_radius_mm": 31.5,
    "autobalancer.rolling_drag_per_s": 40.0,
}
"""The machine of the golden numbers, hardly damped; its mass is that of the preset with the autobalancer."""


HELPS = {
    "wheel.runout_mm": 0.02,
    "wheel.life_min": 32.0,
    "wheel.life_with_autobalancer_min": 48.0,
    "wheel.usable_wear_mm": 10.0,
}


@cache
def worked(name: str, which: str = "", sense: int = -1) -> abu_calc.GrindingResult:
    """Each machine is worked once for all tests."""
    changes = {"": {}, "golden": {**GOLDEN, "grinding.rotation_sense": sense}, "helps": HELPS}[which]
    return recalled("grinding", abu_calc.read(name).changed(changes))


@pytest.fixture(autouse=True)
def terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")


@pytest.mark.few(1, 2)
@pytest.mark.parametrize(
    ("name", "which", "begins"),
    [
        (STRAIGHT, "", "The autobalancer helps under load: 104.9 dB with it, 111.0 dB without."),
        (STRAIGHT, "helps", "The autobalancer helps under load"),
        (STRAIGHT, "golden", "The autobalancer makes the loaded machine LOUDER"),
        ("avtovaz-707-370", "", "The autobalancer helps under load"),
    ],
)
@pytest.mark.slow
def test_one_screen_verdict_first(name: str, which: str, begins: str) -> None:
    result = worked(name, which)
    text = as_text(grinding_screen(result), 80)
    lines = text.splitlines()
    assert len(lines) <= 48
    assert max(map(len, lines)) <= 80
    assert lines[1].strip().startswith(("PASS", "FAIL", "NOT EVALUATED"))
    assert " ".join(line.strip() for line in lines[2:4]).startswith(begins)
    assert result.verdict.startswith(begins)


@pytest.mark.slow
def test_the_command_prints_the_screen_and_the_whole() -> None:
    seen = once("grinding", "avtovaz-707-370")
    assert seen.status == 0
    assert seen.out.splitlines()[2].strip().startswith("The autobalancer helps under load")
    assert len(seen.out.splitlines()) <= 48
    whole = as_text(grinding_blocks(worked(STRAIGHT, "helps")), 80)
    for part in ("Over the speeds", "Force round the wheel", "Course of wear with it", "Life of the wheel"):
        assert part in whole


@pytest.mark.parametrize("sense", [-1, pytest.param(1, marks=pytest.mark.slow)])
@pytest.mark.slow
def test_golden_machine(sense: int) -> None:
    """Balls, force and axis by formulas written here, from the masses and numbers that the model states."""
    found = worked(STRAIGHT, "golden") if sense == -1 else worked(STRAIGHT, "golden", sense)
    result, model = found.to_dict(), found.model.to_dict()
    W, f, mass = 5800 * math.pi / 30, 0.35, model["system_mass_kg"]
    held = [6.2 * w**2 + 2j * 0.2 * 6.2 * w * W for w in (80.0, 120.0)]
    D = [k - mass * W**2 for k in held]
    E, own = cmath.rect(4e-5, 0.6), 1e-4
    isf = 1j * sense * f
    U = E * (D[0] - isf * D[1]) / (1 + isf) / W**2
    V = U - own
    assert result["ball_resultant_g_mm"] == pytest.approx(1e6 * abs(V), rel=1e-9)
    moment = model["ball_mass_kg"] * model["pitch_radius_m"]
    half = math.acos(abs(V) / (2 * moment))
    places = [math.remainder(math.degrees(cmath.phase(V) + sign * half), 360) for sign in (-1, 1)]
    assert result["ball_angles_deg"] == pytest.approx(places, abs=1e-6)
    N = 1j * (D[1] * E + W**2 * U)
    assert result["reaction"]["mean_N"] == 400
    assert result["reaction"]["amplitude_N"] == pytest.approx(abs(N))
    assert result["reaction"]["angle_deg"] == pytest.approx(math.degrees(cmath.phase(N)))
    assert result["reaction"]["separates"] is False
    assert result["axis"] == pytest.approx({"x_amplitude_mm": 0.04, "y_amplitude_mm": 0.04})
    bare = [k - 6.2 * W**2 for k in held]
    X = (W**2 * own + sense * f * 1j * (bare[1] * E + W**2 * own)) / bare[0]
    assert result["axis_without"]["x_amplitude_mm"] == pytest.approx(1e3 * abs(X))
    assert result["axis_without"]["y_amplitude_mm"] == pytest.approx(0.04)
    H = -1j * N
    rate = -(H * E.conjugate()).real / (4e-5 * 400)
    assert result["wear"]["runout_rate"] == pytest.approx(rate)
    assert result["wear"]["centres"] is False
    bounds = [-D[1].real, -D[0].real - D[1].real]
    assert result["contact_stiffness_regions_N_per_m"] == pytest.approx(bounds)
    assert result["flutter_drag_limit_per_s"] == 0
    kappa = model["ball_mass_kg"] * W**4 / -D[0].real / 2
    assert result["flutter_drag_worst_per_s"] == pytest.approx(math.sqrt(1.4 * kappa) * f, rel=0.2)  # undamped
    assert (model["rotation_sense"], model["runout_angle_deg"]) == (sense, pytest.approx(math.degrees(0.6)))
    off = abs(result["printed"]["error_deg"])
    assert 15 < off < 35  # that of the resultant; Θ₁ and Θ₂ are off by up to 31°
    assert found.status == "fail"
    assert result["helps"] is False
    assert result["agreement"].pop("from_idle") is True
    assert max(result["agreement"].values()) < 0.02


@pytest.mark.slow
def test_levels_are_those_of_the_motion() -> None:
    """20 lg(Ω·max(|X|, |Y|)/√2/5e-8), race and friction of the budget added as squares with the autobalancer."""
    result = worked(STRAIGHT, "golden").to_dict()
    W = 5800 * math.pi / 30
    for axis, level, rest in (
        (result["axis_without"], result["level_before_db"], 0.0),
        (result["axis"], result["level_after_db"], result["resting_um"]),
    ):
        moved = math.hypot(max(axis.values()) * 1e-3, rest * 1e-6)
        assert level == pytest.approx(20 * math.log10(W * moved / math.sqrt(2) / 5e-8))


@pytest.mark.slow
def test_the_face_machine_does_at_work_what_it_does_at_idle() -> None:
    result = worked("avtovaz-707-370").to_dict()
    assert worked("avtovaz-707-370").status == "pass"
    assert result["reaction"]["amplitude_N"] == 0
    assert result["wear"] is None
    assert result["contact_stiffness_regions_N_per_m"] is None
    assert result["axis"]["x_amplitude_mm"] == 0
    assert result["level_before_db"] == pytest.approx(112.0)


@pytest.mark.slow
def test_remedies_hold_when_taken() -> None:
    """What is advised is in force: the machine with it passes without that warning."""
    result = worked(STRAIGHT).to_dict()
    assert result["level_at_once_db"] > result["level_before_db"] > result["level_after_db"]
    assert result["remedies"]
    machine = abu_calc.read(STRAIGHT)
    first = next(one for one in result["remedies"] if one["runout_mm"])
    better = abu_calc.grinding(machine.changed({"wheel.runout_mm": first["runout_mm"]}))
    assert next(check for check in better.checks if check.code == "ABU421").status == "pass"
    starts = better.starts
    assert starts is not None and starts.worst_db is not None  # a remedy is told by its loudest start case
    worst = max(better.level_after_db or 0, better.level_at_once_db or 0, starts.worst_db)
    assert worst == pytest.approx(first["level_after_db"], abs=1e-3)


def test_a_file_without_grinding_is_refused_with_the_remedy() -> None:
    seen = abu("grinding", "swing-arm-grinder")
    assert seen.status == 2
    assert seen.out == ""
    assert "[grinding]" in seen.err
    assert "Add a table" in seen.err
    assert "Traceback" not in seen.err


@pytest.mark.parametrize(
    "change",
    [
        "grinding.press_force_N=0", "grinding.contact=\"soft\"", "grinding.rotation_sense=2", "wheel.life_min=-1",
        "wheel.usable_wear_mm=nan", "wheel.axial_runout_mm=\"0.1\"", "grinding.cutting_coefficient=true",
        "grinding.contact_stiffness_N_per_m=0",
    ],
)  # fmt: skip
def test_wrong_entries_are_refused(change: str) -> None:
    seen = abu("grinding", STRAIGHT, "--set", change)
    assert seen.status == 2
    assert change.split("=")[0] in seen.err


@pytest.mark.slow
def test_python_returns_what_the_command_prints() -> None:
    result, document = worked("avtovaz-707-370"), once("grinding", "avtovaz-707-370", "--json").document
    assert result.to_dict() == document["result"]
    assert result.model.to_dict() == document["model"]
    assert result.status == "pass"
    with pytest.raises(abu_calc.InputError, match="accuracy"):
        abu_calc.grinding(abu_calc.read("avtovaz-707-370"), accuracy=0.0)
