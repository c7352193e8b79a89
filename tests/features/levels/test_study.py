"""`abu levels`, from files and machines to numbers, against closed forms and against `abu simulate`."""

import math
from pathlib import Path

import numpy as np
import pytest

import abu_calc
from abu_calc.foundation.errors import InputError
from abu_calc.sizing import size as size_design
from tests.cli.runner import abu, once

V = 14.09e-3
"""Rms velocity [m/s] of 109 dB re 5e-8 m/s."""
RIGID = {"machine.transverse_inertia_kg_m2": 0.1, "machine.center_of_mass_to_wheel_mm": 200.0}
HANDLES = [{"name": "front", "from_center_of_mass_mm": 100.0}, {"name": "rear", "from_center_of_mass_mm": -200.0}]


def sine_file(folder: Path, hertz: float = 5800 / 60, seconds: float = 6.0, axes: int = 1, rate: float = 4096.0,
              times: float = 1.0) -> str:  # fmt: skip
    """A velocity of so many times V rms along every axis, in mm/s."""
    t = np.arange(round(seconds * rate)) / rate
    wave = 1e3 * times * V * math.sqrt(2) * np.sin(2 * math.pi * hertz * t)
    head = ",".join(["t_s", *("vx_mm_per_s", "vy_mm_per_s", "vz_mm_per_s")[:axes]])
    file = folder / "sine.csv"
    np.savetxt(file, np.column_stack([t, *[wave] * axes]), delimiter=",", header=head, comments="", fmt="%.10g")
    return str(file)


def test_a_sine_of_the_spindle_reads_its_level_in_its_octave(tmp_path: Path) -> None:
    seen = abu("levels", sine_file(tmp_path), "--json")
    result = seen.document["result"]
    level = 20 * math.log10(V / 5e-8)
    assert seen.status == 0 and seen.document["status"] == "pass"
    octaves = {one["nominal_hz"]: one["level_db"] for one in result["octaves"]}
    assert octaves[125] == pytest.approx(level, abs=0.01) and result["level_db"] == pytest.approx(level, abs=0.01)
    assert octaves[63] < level - 17.5 and octaves[250] < level - 42
    assert result["corrected_level_db"] == pytest.approx(level, abs=0.05)


@pytest.mark.slow
def test_weighted_acceleration_and_exposure_of_three_axes(tmp_path: Path) -> None:
    """a_hv = √3·2πf·V·W_h, A(8) = a_hv √(T/8 h); W_h 0.160 at 100 Hz falls as 1/f there, ISO 5349-1."""
    hertz = 10 ** (20 / 10)
    result = abu("levels", sine_file(tmp_path, hertz, axes=3), "--minutes", "120", "--json").document["result"]
    total = math.sqrt(3) * 2 * math.pi * hertz * V * 0.160
    assert result["weighted_acceleration_m_per_s2"] == pytest.approx(total, rel=0.01)
    assert result["daily_exposure_m_per_s2"] == pytest.approx(total / 2, rel=0.01)
    place = result["places"][0]
    assert place["acceleration_m_per_s2"] == pytest.approx(2 * math.pi * hertz * V, rel=0.01)
    assert place["displacement_rms_um"] == pytest.approx(1e6 * V / (2 * math.pi * hertz), rel=0.01)
    assert place["weighted_axis_m_per_s2"] == pytest.approx(total / math.sqrt(3), rel=0.01)


@pytest.mark.few(2)
@pytest.mark.parametrize(("scale", "axes", "status"), [
    (1.0, 1, "pass"), (1.1, 1, "warn"), (1.0, 3, "pass"), (1.1, 3, "warn"), (1.9, 3, "warn"), (2.1, 3, "fail"),
])  # fmt: skip
def test_exposure_against_the_values_of_the_directive(tmp_path: Path, scale: float, axes: int, status: str) -> None:
    """8 h of 1.42 m/s² along an axis: of three 2.46 m/s²; of one up to 1.7 times as much, 2.41, may be the total.

    2.5 m/s² call for measures, 5 are the limit.
    """
    found = abu_calc.levels(sine_file(tmp_path, seconds=2.0, axes=axes, times=scale), minutes=480)
    check = next(one for one in found.checks if one.code == "ABU413")
    assert check.status == status, check


def test_what_a_short_or_slow_record_does_not_tell_is_not_done(tmp_path: Path) -> None:
    seen = abu("levels", sine_file(tmp_path, seconds=1.0, rate=1000.0), "--json")
    checks = {check["name"]: check for check in seen.document["checks"]}
    assert seen.status == 1 and seen.document["status"] == "not-done"
    assert checks["octave level, 125 Hz"]["status"] == "pass"
    assert "short" in checks["octave level, 8 Hz"]["message"] and checks["octave level, 8 Hz"]["value"] is None
    assert "slowly" in checks["octave level, 1000 Hz"]["message"]
    assert checks["weighted overall level"]["status"] == "not-done"


@pytest.mark.slow
def test_a_start_that_is_loud_is_told_and_can_be_left_out(tmp_path: Path) -> None:
    file = Path(sine_file(tmp_path))
    t, v = np.loadtxt(file, delimiter=",", skiprows=1).T
    np.savetxt(file, np.column_stack([t, np.where(t < 2, 10 * v, v)]), delimiter=",", header="t_s,v_mm_per_s",
               comments="", fmt="%.10g")  # fmt: skip
    whole, later = abu_calc.levels(str(file)), abu_calc.levels(str(file), from_s=3.0)
    assert any("quieter" in one for one in whole.warnings)
    assert later.level_db == pytest.approx(20 * math.log10(V / 5e-8), abs=0.01)
    assert later.octaves[4].level_db == pytest.approx(later.level_db, abs=0.01)


def two_handles(folder: Path) -> str:
    """Volts of six sensors: front 1, 2, 3 and rear 2, 4, 6 times 109 dB along x, y, z; 1 mV per m/s², rear z 2."""
    rate, hertz = 4096.0, 100.0
    t = np.arange(round(6 * rate)) / rate
    wave = 1e3 * 2 * math.pi * hertz * V * math.sqrt(2) * np.sin(2 * math.pi * hertz * t) * 1e-3
    columns = [t, *(k * wave for k in (1, 2, 3, 2, 4, 12))]
    head = ";".join(["t_s", *(f"{handle}_a{axis}_mV" for handle in ("front", "rear") for axis in "xyz")])
    rows = [";".join(f"{value:.9f}".replace(".", ",") for value in row) for row in zip(*columns, strict=True)]
    file = folder / "two.csv"
    file.write_text("\n".join([head, *rows]), encoding="utf-8")
    return str(file)


@pytest.mark.slow
def test_two_handles_in_volts_each_have_their_levels_and_total(tmp_path: Path) -> None:
    """By closed form: √(1+4+9) and twice it, W_h 0.160 at 100 Hz; the rear decides; third octaves beside octaves."""
    asked = ("--sensitivity", "1", "--sensitivity", "rear_az_mV=2", "--third-octaves", "--json")
    result = abu("levels", two_handles(tmp_path), *asked).document["result"]
    front, rear = result["places"]
    level, total = 20 * math.log10(V / 5e-8), 2 * math.pi * 100 * V * 0.160 * math.sqrt(14)
    assert (front["name"], rear["name"], result["loudest_place"]) == ("front", "rear", "rear")
    for place, times in ((front, 1), (rear, 2)):
        assert place["level_db"] == pytest.approx(level + 20 * math.log10(3 * times), abs=0.01)
        assert place["weighted_acceleration_m_per_s2"] == pytest.approx(times * total, rel=0.01)
        thirds = {band["nominal_hz"]: band["level_db"] for band in place["third_octaves"]}
        assert thirds[100] == pytest.approx(place["level_db"], abs=0.01)
        assert max(other or 0.0 for hertz, other in thirds.items() if hertz != 100) < thirds[100] - 30
        assert [axis["third_octave_levels_db"][12] for axis in place["axes"]] == pytest.approx(
            [level + 20 * math.log10(k * times) for k in (1, 2, 3)], abs=0.01
        )
    plain = abu("levels", two_handles(tmp_path), "--sensitivity", "1", "--json").document["result"]
    assert "third_octaves" not in plain["places"][0]


@pytest.mark.slow
def test_a_machine_has_third_octaves_too() -> None:
    place = abu_calc.levels("avtovaz-707-222", third_octaves=True).places[0]
    assert place.third_octaves is not None
    spindle = next(band for band in place.third_octaves if band.nominal_hz == 100)
    assert spindle.level_db == pytest.approx(place.level_db, abs=0.02)


# simulated motion
@pytest.mark.slow
@pytest.mark.parametrize("samples", ["1001", "4001"])
def test_a_file_that_the_simulation_wrote_has_its_level(tmp_path: Path, samples: str) -> None:
    motion = tmp_path / "motion.csv"
    said = abu("simulate", "avtovaz-707-222", "--trajectory", str(motion), "--samples", samples, "--json")
    found = abu_calc.levels(str(motion))
    assert found.level_db == pytest.approx(said.document["result"]["level_db"], abs=0.02)
    assert found.octaves[4].level_db == pytest.approx(said.document["result"]["level_db"], abs=0.03)


@pytest.mark.slow
def test_a_machine_has_the_level_that_its_simulation_has() -> None:
    said = once("simulate", "avtovaz-707-222", "--json").document["result"]
    found = abu_calc.levels(abu_calc.read("avtovaz-707-222"))
    assert found.status == "pass" and found.level_db == pytest.approx(said["handles"][0]["level_db"], abs=0.02)
    assert found.octaves[4].level_db == pytest.approx(found.level_db, abs=0.02)
    assert all(one.level_db < found.level_db - 20 for one in found.octaves if one.nominal_hz != 125)
    assert found.measured_after is not None
    mean = 20 * math.log10((10 ** (102 / 20) + 10 ** (103 / 20)) / 2)
    assert found.measured_after.measured_level_db == pytest.approx(mean, abs=1e-9)
    assert found.measured_after.this_run_db == pytest.approx(found.level_db, abs=1e-6)
    predicted = found.measured_after.predicted_level_db
    assert predicted is not None and found.measured_after.difference_db == pytest.approx(mean - predicted, abs=1e-6)


@pytest.mark.slow
def test_handles_of_a_rigid_body_move_and_carry_as_mechanics_has_it() -> None:
    """Motion per imbalance 1/M + p·a/J, load by the lever about the centre of mass."""
    machine = abu_calc.read("avtovaz-707-222").changed({**RIGID, "machine.handle": HANDLES})
    found, added = abu_calc.levels(machine), size_design(machine.whole()).autobalancer.mass
    front, rear = found.places
    total = 6.2 + added
    moves = [abs(1 / total + p * 0.2 / 0.1) for p in (0.1, -0.2)]
    assert front.level_db - rear.level_db == pytest.approx(20 * math.log10(moves[0] / moves[1]), abs=1e-6)
    # F₁ + F₂ = (M + m) g and F₁ p₁ + F₂ p₂ = m g a.
    force = [front.static_load_N, rear.static_load_N]
    assert sum(force) == pytest.approx(total * 9.80665, rel=1e-9)
    assert 0.1 * force[0] - 0.2 * force[1] == pytest.approx(added * 9.80665 * 0.2, rel=1e-9)
    assert front.static_load_without_N == pytest.approx(6.2 * 9.80665 * 2 / 3, rel=1e-9)
    assert front.level_before_db > front.level_db + 5


@pytest.mark.slow
@pytest.mark.parametrize("changes", [{}, {"machine.spindle_axis": "vertical"}])
def test_where_statics_does_not_tell_no_load_is_given(changes: dict[str, object]) -> None:
    rigid = RIGID if changes else {}
    found = abu_calc.levels(abu_calc.read("avtovaz-707-222").changed({"machine.handle": HANDLES, **rigid, **changes}))
    assert all(place.static_load_N is None for place in found.places)
    assert any("load on each hand is not known" in one for one in found.warnings)


def test_a_background_is_not_in_the_octaves_and_that_is_said() -> None:
    found = abu_calc.levels(abu_calc.read("msh-230").changed({"machine.background_level_db": 95.0}))
    assert any("background of 95 dB" in one for one in found.warnings)


@pytest.mark.slow
def test_a_level_in_the_wrong_unit_is_wondered_at(tmp_path: Path) -> None:
    file = tmp_path / "v.csv"
    file.write_text(Path(sine_file(tmp_path)).read_text().replace("t_s,vx_mm_per_s", "time,velocity"))
    assert any("169 dB is unusual" in one for one in abu_calc.levels(str(file)).warnings)
    assert not any("unusual" in one for one in abu_calc.levels(str(file), scale=1e-3).warnings)


def test_a_machine_is_judged_by_one_start_and_that_is_said() -> None:
    assert any("One start" in one for one in abu_calc.levels("msh-230").warnings)


@pytest.mark.slow
def test_sources_of_every_kind(tmp_path: Path) -> None:
    file = sine_file(tmp_path)
    recorded = abu_calc.read_recording(file)
    results = [abu_calc.levels(source) for source in (file, Path(file), recorded)]
    assert {one.level_db for one in results} == {results[0].level_db}
    with pytest.raises(InputError):
        abu_calc.levels(recorded, "idle")
    with pytest.raises(InputError):
        abu_calc.levels(3.0)  # type: ignore[arg-type]
    with pytest.raises(InputError):
        abu_calc.levels("msh-230", quantity="velocity")
