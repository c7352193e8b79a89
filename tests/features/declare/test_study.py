"""`abu declare MACHINE`: the reference machines, cases without an answer, what the file may say."""

import math
from pathlib import Path
from typing import Any

import pytest

import abu_calc
from abu_calc import InputError
from abu_calc.features.declare.study import DeclareResult, declare
from tests.features.declare.machines import S100, S150, written

STARTS = 1500


def result(folder: Path, text: str, starts: int = STARTS, **values: Any) -> DeclareResult:
    machine = abu_calc.read(written(folder, text))
    changes = {key.replace("__", "."): value for key, value in values.items()}
    return declare(machine.changed(changes) if changes else machine, starts)


@pytest.fixture(scope="module")
def rigid(tmp_path_factory: pytest.TempPathFactory) -> DeclareResult:
    return result(tmp_path_factory.mktemp("rigid"), S150, 10_000)


@pytest.fixture(scope="module")
def point(tmp_path_factory: pytest.TempPathFactory) -> DeclareResult:
    return result(tmp_path_factory.mktemp("point"), S100, 10_000)


@pytest.mark.slow
def test_rigid_machine_without_autobalancer(rigid: DeclareResult) -> None:
    """1.45775 and 0.92766 of a free body; the suspension at 2.5 Hz adds 0.03 %."""
    assert rigid.without.a_hv_m_per_s2 == pytest.approx(1.0003 * 1.45775, rel=1e-4)
    assert {each.name: each.without_m_per_s2 for each in rigid.handles} == pytest.approx(
        {"front": 1.0003 * 1.45775, "rear": 1.0003 * 0.92766}, rel=1e-4
    )
    assert rigid.without.K_m_per_s2 == pytest.approx(0.639, abs=1e-3)


@pytest.mark.slow
def test_rigid_machine_with_autobalancer(rigid: DeclareResult) -> None:
    """The reference counts the balls' mass in both states; here the autobalancer adds 2.5 %, which moves 1 %."""
    with_ = rigid.with_
    assert with_ is not None
    assert rigid.handle == with_.handle == "front"
    assert with_.a_hv_m_per_s2 == pytest.approx(0.5515, rel=0.03)
    assert with_.declared_m_per_s2 == pytest.approx(1.3 * with_.a_hv_m_per_s2)
    assert (with_.p05, with_.p50, with_.p95) == pytest.approx((0.148, 0.532, 1.035), rel=0.06)
    assert with_.no_friction_m_per_s2 == pytest.approx(0.43241, rel=0.01)
    assert with_.K_m_per_s2 == pytest.approx(0.566, abs=4e-3)
    assert rigid.friction_rms_mm == pytest.approx(0.0105, rel=0.04)
    assert rigid.lowers
    spread = (with_.declared_high_m_per_s2 - with_.declared_low_m_per_s2) / 2
    assert spread == pytest.approx(1.6449 * 1.3 * 0.124 / math.sqrt(3), rel=0.06)


@pytest.mark.slow
def test_rigid_machine_of_the_same_mass_with_autobalancer(tmp_path: Path, rigid: DeclareResult) -> None:
    """The reference has 6 kg with the autobalancer: a file says so by a mass that is lighter by it.

    Both simulations have random starts: within three of their standard errors together.
    """
    added = rigid.model.mass_kg - rigid.model.mass_without_autobalancer_kg
    light = result(tmp_path, S150, 10_000, machine__mass_kg=5.3 - added)
    assert light.with_ is not None
    assert light.model.mass_kg == pytest.approx(6.0, rel=1e-3)
    error = light.with_.standard_error_m_per_s2 / light.with_.a_hv_m_per_s2
    values = {each.name: each.with_m_per_s2 for each in light.handles}
    for name, value, deviation in (("front", 0.5515, 0.0020), ("rear", 0.3360, 0.0013)):
        assert values[name] == pytest.approx(value, abs=3 * math.hypot(deviation, error * value))
    assert light.with_.no_friction_m_per_s2 == pytest.approx(0.43241, rel=1e-3)


@pytest.mark.slow
def test_break_even_of_the_rigid_machine(rigid: DeclareResult) -> None:
    assert rigid.break_even_frictionless_mm == pytest.approx(0.025946, rel=0.01)
    assert rigid.break_even_eccentricity_mm == pytest.approx(0.0250, rel=0.02)
    assert rigid.break_even_reason is None


@pytest.mark.slow
def test_point_mass(point: DeclareResult) -> None:
    """The reference is 3.2 kg in both states; here 3.1 kg without and 3.2 kg with the autobalancer."""
    mass = point.model.mass_kg
    assert mass == pytest.approx(3.2, rel=0.02)
    with_ = point.with_
    assert with_ is not None
    assert point.without.a_hv_m_per_s2 == pytest.approx(0.95121 * 3.2 / 3.1, rel=1e-3)
    assert with_.a_hv_m_per_s2 == pytest.approx(0.6629, rel=0.04)
    assert with_.no_friction_m_per_s2 == pytest.approx(0.52481, rel=1e-3)
    frictionless = 29e-3 / (1.3 * 3.1)
    assert point.break_even_frictionless_mm == pytest.approx(frictionless, rel=1e-3)
    assert point.break_even_eccentricity_mm == pytest.approx(0.00588 * 3.2 / 3.1, rel=0.03)
    assert point.body == "point mass"
    assert any("point mass" in remark for remark in point.warnings)


@pytest.mark.slow
def test_a_gain_below_the_uncertainty_warns(point: DeclareResult) -> None:
    """A good design that gains 9 %: nothing against K."""
    grades = {check.code: check.status for check in point.checks}
    assert grades == {"ABU431": "pass", "ABU432": "warn", "ABU433": "pass"}
    assert point.status == "pass"


@pytest.mark.slow
def test_the_break_even_eccentricity_is_one(tmp_path: Path, rigid: DeclareResult) -> None:
    """At it the declared value is that without the autobalancer; 10 % beside it, it is not."""
    even = rigid.break_even_eccentricity_mm
    assert even is not None
    for share, lowers in ((0.9, True), (1.1, False)):
        other = result(tmp_path, S150, autobalancer__race_eccentricity_mm=share * even)
        assert other.lowers == lowers
        assert {check.code: check.status for check in other.checks}["ABU431"] == ("pass" if lowers else "warn")


@pytest.mark.slow
def test_an_action_holds_when_followed(tmp_path: Path) -> None:
    other = result(tmp_path, S150, autobalancer__race_eccentricity_mm=0.030)
    check = next(check for check in other.checks if check.code == "ABU431")
    assert check.status == "warn"
    assert check.overrides
    text = {entry.partition("=")[0]: float(entry.partition("=")[2]) for entry in check.overrides}
    machine = abu_calc.read(written(tmp_path, S150)).changed({**text, "autobalancer.ball_count": 4})
    after = declare(machine, STARTS)
    assert after.lowers
    assert check.remedy is not None
    assert f"{after.with_.declared_m_per_s2:.3g}" in check.remedy if after.with_ else False


@pytest.mark.slow
def test_causes_add_up(rigid: DeclareResult) -> None:
    assert sum(cause.share for cause in rigid.causes) == pytest.approx(1.0)
    by_name = {cause.name: cause.a_hv_m_per_s2 for cause in rigid.causes}
    assert by_name["race eccentricity"] == pytest.approx(0.4306, rel=0.01)
    square = math.sqrt(sum(value**2 for value in by_name.values()))
    assert rigid.with_ is not None
    assert 0.8 * square < rigid.with_.a_hv_m_per_s2 < square


def test_no_friction_needs_no_simulation(tmp_path: Path) -> None:
    ideal = result(tmp_path, S150, autobalancer__rolling_friction_mm=0.0)
    assert ideal.with_ is not None
    assert ideal.with_.a_hv_m_per_s2 == pytest.approx(ideal.with_.no_friction_m_per_s2, rel=1e-3)
    assert ideal.friction_rms_mm == 0
    assert ideal.break_even_eccentricity_mm == ideal.break_even_frictionless_mm


@pytest.mark.slow
def test_friction_alone_can_leave_no_break_even(tmp_path: Path) -> None:
    rough = result(tmp_path, S100, autobalancer__rolling_friction_mm=0.02)
    assert rough.break_even_eccentricity_mm is None
    assert rough.break_even_reason is not None and "friction" in rough.break_even_reason
    assert not rough.lowers


@pytest.mark.slow
def test_background_above_its_limit(tmp_path: Path, rigid: DeclareResult) -> None:
    """1.204 times the value of the imbalance alone."""
    limit = rigid.background_limit_m_per_s2
    assert limit == pytest.approx(rigid.without.a_hv_m_per_s2 / math.sqrt(0.69), rel=1e-9)
    loud = result(tmp_path, S150, type_test__background_a_hv_m_per_s2=1.01 * limit)
    assert loud.without.a_hv_m_per_s2 == pytest.approx(math.hypot(rigid.without.a_hv_m_per_s2, 1.01 * limit))
    assert not loud.lowers
    assert loud.break_even_eccentricity_mm is None
    assert any("however perfect" in remark for remark in loud.warnings)


@pytest.mark.slow
def test_a_break_even_eccentricity_beyond_the_capacity_is_told(tmp_path: Path, rigid: DeclareResult) -> None:
    """425 g·mm carry 68.4 + 2.04·25 of the reference; three small balls carry 111."""
    assert not any("larger balls" in remark for remark in rigid.warnings)
    small = {"autobalancer__ball_count": 3, "autobalancer__ball_diameter_mm": 7.0, "autobalancer__capacity_margin": 1.0}
    tight = result(tmp_path, S150, 1000, wheel__imbalance_g_mm=70.0, **small)
    even = tight.break_even_eccentricity_mm
    assert even is not None
    need = 65 * 1.0517 + 1e3 * even * tight.model.effective_mass_kg
    capacity = next(check.value for check in tight.checks if check.code == "ABU433")
    assert capacity is not None
    assert any("larger balls" in remark for remark in tight.warnings) and need > capacity


def test_a_test_wheel_beyond_the_capacity(tmp_path: Path) -> None:
    heavy = result(tmp_path, S150, type_test__test_wheel_imbalance_g_mm=500.0)
    assert heavy.status == "fail"
    assert heavy.with_ is None and heavy.to_dict()["with"] is None
    assert not heavy.lowers
    assert heavy.break_even_eccentricity_mm is None and heavy.friction_rms_mm is None
    assert {check.code: check.status for check in heavy.checks} == {
        "ABU431": "not-done", "ABU432": "not-done", "ABU433": "fail",
    }  # fmt: skip
    assert heavy.without.a_hv_m_per_s2 == pytest.approx(500 / 65 * 1.4582, rel=1e-3)


def test_a_speed_at_which_balls_do_not_balance(tmp_path: Path) -> None:
    stiff = result(tmp_path, S150, suspension__natural_frequencies_hz=[200.0, 200.0])
    assert stiff.status == "fail"
    assert stiff.with_ is None
    check = next(check for check in stiff.checks if check.code == "ABU433")
    assert "natural frequencies" in check.message


@pytest.mark.parametrize("diameter", [60.0, 178.0])
def test_a_wheel_without_a_test_wheel_is_refused(tmp_path: Path, diameter: float) -> None:
    with pytest.raises(InputError, match="no built-in test wheel") as caught:
        result(tmp_path, S150, wheel__diameter_mm=diameter)
    assert caught.value.place.key == "wheel.diameter_mm"
    assert caught.value.remedy is not None and "test_wheel_imbalance_g_mm" in caught.value.remedy


@pytest.mark.slow
def test_the_file_chooses_the_test_wheel(tmp_path: Path) -> None:
    other = result(tmp_path, S150, 100, type_test__test_wheel_diameter_mm=125.0)
    assert (other.test_wheel.diameter_mm, other.test_wheel.imbalance_g_mm) == pytest.approx((125.0, 45.0))
    own = result(tmp_path, S150, 100, type_test__test_wheel_imbalance_g_mm=50.0)
    assert (own.test_wheel.imbalance_g_mm, own.test_wheel.status) == (pytest.approx(50.0), "given")


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("type_test.orientations", 0), ("type_test.orientations", [400.0]), ("type_test.orientations", "five"),
        ("type_test.runs", 0), ("type_test.runs", 1.5), ("type_test.operators", 0),
        ("type_test.test_wheel_imbalance_g_mm", -65.0), ("type_test.test_wheel_imbalance_g_mm", math.nan),
        ("type_test.test_wheel_imbalance_g_mm", "65 g"), ("type_test.test_wheel_diameter_mm", 0.0),
        ("type_test.background_a_hv_m_per_s2", -1.0), ("type_test.orientation", 5),
    ],
)  # fmt: skip
def test_wrong_entries_are_refused(tmp_path: Path, key: str, value: object) -> None:
    with pytest.raises(InputError):
        abu_calc.read(written(tmp_path, S150)).changed({key: value})


@pytest.mark.parametrize("starts", [0, 99, 10**7])
def test_wrong_numbers_of_starts_are_refused(tmp_path: Path, starts: int) -> None:
    with pytest.raises(InputError):
        declare(abu_calc.read(written(tmp_path, S150)), starts)


@pytest.mark.slow
def test_orientations_runs_and_operators_count(tmp_path: Path) -> None:
    """Eight orientations with two runs and four operators: the spread falls as the root of all runs."""
    usual = result(tmp_path, S150)
    more = result(tmp_path, S150, type_test__orientations=8, type_test__runs=2, type_test__operators=4)
    assert more.plan.orientations_deg == pytest.approx([45.0 * k for k in range(8)])
    spans = [
        each.with_.declared_high_m_per_s2 - each.with_.declared_low_m_per_s2 for each in (usual, more) if each.with_
    ]
    assert spans[0] / spans[1] == pytest.approx(math.sqrt(64 / 15), rel=0.15)


@pytest.mark.slow
def test_the_same_machine_gives_the_same_numbers(tmp_path: Path) -> None:
    first, second = (result(tmp_path, S150, 500).to_dict() for _ in range(2))
    assert first == second


@pytest.mark.slow
def test_gravity_is_told_on_a_horizontal_spindle(tmp_path: Path, rigid: DeclareResult) -> None:
    """k_r·R_p·Ω²/r = 3.8 m/s² is below g: gravity shakes the balls free, and friction leaves nothing."""
    lying = result(tmp_path, S150, 10_000, machine__spindle_axis="horizontal")
    assert lying.with_ is not None and lying.with_.shaken_free
    assert rigid.with_ is not None and not rigid.with_.shaken_free and rigid.with_.upright_m_per_s2 is None
    assert any("gravity shakes" in remark and "friction leaves nothing" in remark for remark in lying.warnings)
    assert lying.with_.a_hv_m_per_s2 == pytest.approx(0.43241, rel=0.01)
    assert lying.with_.upright_m_per_s2 == rigid.with_.a_hv_m_per_s2
    assert lying.friction_rms_mm == 0 and "rolling friction" not in {cause.name for cause in lying.causes}
    assert lying.break_even_eccentricity_mm == pytest.approx(0.025946, rel=0.01)


@pytest.mark.slow
def test_friction_above_gravity_holds_balls_on_a_horizontal_spindle(tmp_path: Path, rigid: DeclareResult) -> None:
    """k_r of 20 µm: 38 m/s² against g, so that most of the friction stays."""
    rough = {"autobalancer__rolling_friction_mm": 0.02}
    lying = result(tmp_path, S150, 2000, machine__spindle_axis="horizontal", **rough)
    standing = result(tmp_path, S150, 2000, **rough)
    assert lying.with_ is not None and standing.with_ is not None and rigid.with_ is not None
    assert not lying.with_.shaken_free
    assert lying.with_.upright_m_per_s2 == standing.with_.a_hv_m_per_s2
    assert rigid.with_.a_hv_m_per_s2 < lying.with_.a_hv_m_per_s2 < standing.with_.a_hv_m_per_s2
