"""`abu grinding` of machines with two races: closed forms against own sums, simulations, refusals."""

import cmath
import math
from functools import cache
from typing import Any

import pytest

import abu_calc
from abu_calc.features.spindle.case import (
    SpindleDesign,
    capacity_needs,
    pressed_wheels,
    read_case,
    size_races,
    work_needs,
)
from abu_calc.features.spindle.start_cases import start_of
from abu_calc.features.spindle.work_runs import (
    agreement,
    ball_angles,
    capacities_at_work,
    contact_of,
    growth_rates,
    resultants_at_work,
)
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import read_machine
from tests.cli.runner import abu, again, once

WORK = (
    "grinding.press_force_N=45", "grinding.contact_stiffness_N_per_m=200000", "wheel.0.runout_mm=0.04",
    "wheel.1.runout_mm=0.02", "limits.settling_time_s=0.5",
)  # fmt: skip
SET = tuple(part for entry in WORK for part in ("--set", entry))


@cache
def design_of(*overrides: str) -> SpindleDesign:
    return size_races(read_machine("pedestal-grinder", (*WORK, *overrides)))


def document(*arguments: str) -> dict[str, Any]:
    seen = once("grinding", "pedestal-grinder", *SET, *arguments, "--json")
    assert seen.status in (0, 1), seen.err
    return dict(seen.document)


@pytest.mark.slow
def test_both_wheels_are_judged_and_the_worst_leads() -> None:
    result = document()["result"]
    assert [row["wheel"] for row in result["wheels"]] == ["right wheel", "left wheel"]
    worst = max(result["wheels"], key=lambda row: row["worst_change_db"])
    assert result["wheel"] == worst["wheel"] and result["level_after_db"] == worst["level_after_db"]
    assert result.keys() >= {
        "ball_resultant_g_mm", "ball_angles_deg", "reaction", "axis", "axis_without", "wear",
        "contact_stiffness_regions_N_per_m", "flutter_drag_limit_per_s",
    }  # fmt: skip
    assert result["helps"] is True and all(row["runs"] == 20 for row in result["wheels"])


@pytest.mark.slow
def test_one_wheel_alone_gives_what_it_gives_beside_the_other() -> None:
    both, second = document()["result"], document("--wheel", "2")["result"]
    assert [row["number"] for row in second["wheels"]] == [2]
    assert second["wheels"][0] == both["wheels"][1]


@pytest.mark.slow
def test_races_balance_imbalances_and_contact_as_a_lever() -> None:
    """V_1 + V_2 + ΣU + U_N = 0 and Σz·(…) = 0 about the centre of mass."""
    design = design_of()
    wheel = pressed_wheels(design.case)[0]
    for phases in ((0.0, 0.0), (0.0, 1.3)):
        loads = [(load.place, load.imbalance) for load in design.case.turned(phases)]
        loads.append((wheel.place, contact_of(design, wheel, phases).acting_imbalance()))
        loads += zip(design.case.races, resultants_at_work(design, wheel, phases), strict=True)
        assert abs(sum(load for _, load in loads)) < 1e-12
        assert abs(sum(place * load for place, load in loads)) < 1e-12


@pytest.mark.slow
def test_ball_angles_add_up_to_the_resultants() -> None:
    design = design_of()
    resultants = resultants_at_work(design, pressed_wheels(design.case)[1], (0.0, 2.0))
    angles = ball_angles(design, resultants)
    assert angles is not None
    for race, own, resultant in zip(design.races, angles, resultants, strict=True):
        abu_ = race.autobalancer
        total = abu_.ball_mass * abu_.pitch_radius * sum(cmath.exp(1j * angle) for angle in own)
        assert abs(total - resultant) < 1e-6 * abs(resultant)


@pytest.mark.slow
def test_simulated_contact_of_the_whole_rotor_agrees_with_the_closed_form() -> None:
    """Force and both resultants after 3 s, ideal races: within half a per cent."""
    design = design_of()
    off = agreement(design, pressed_wheels(design.case)[0], start_of(design, "spread", (0.7,)))
    assert isinstance(off, float) and off < 0.005


@pytest.mark.slow
def test_the_worst_phase_requires_most() -> None:
    design = design_of()
    for wheel in pressed_wheels(design.case):
        most = [0.0, 0.0]
        for step in range(72):
            resultants = resultants_at_work(design, wheel, (0.0, 2 * math.pi * step / 72))
            most = [max(a, abs(b)) for a, b in zip(most, resultants, strict=True)]
        bare = design_of("autobalancer.0.race_eccentricity_mm=0.0", "autobalancer.1.race_eccentricity_mm=0.0")
        needs = capacities_at_work(bare, pressed_wheels(bare.case)[wheel.index])
        assert needs == pytest.approx(most, rel=5e-3)


@pytest.mark.slow
def test_size_adds_what_work_requires() -> None:
    """|s|·|U_N| of the wheel at work at its worst angle; nothing of a face, and nothing without [grinding]."""
    case = design_of().bare
    idle = read_machine("pedestal-grinder").spindle
    assert idle is not None
    alone = read_case(idle)
    assert work_needs(alone, alone.speed) == (0.0, 0.0)
    extra = [with_ - without for with_, without in zip(capacity_needs(case), capacity_needs(alone), strict=True)]
    assert extra == pytest.approx(work_needs(case, case.speed), rel=1e-9)
    share = 560 / 600
    acting = abs(contact_of(design_of(), pressed_wheels(case)[0], (0.0, 0.0), bare=True).acting_imbalance())
    assert extra[0] == pytest.approx(share * acting, rel=1e-9)
    face = design_of("grinding.contact=face").bare
    assert work_needs(face, face.speed) == (0.0, 0.0)


@pytest.mark.slow
def test_runs_at_work_that_are_balanced_do_not_grow() -> None:
    growths = growth_rates(design_of(), pressed_wheels(design_of().case)[0])
    assert growths is not None and max(growths) < 1e-6
    stiff = design_of("grinding.contact_stiffness_N_per_m=2e6")
    unstable = growth_rates(stiff, pressed_wheels(stiff.case)[0])
    assert unstable is not None and unstable[0] > 1.0


@pytest.mark.slow
def test_swapped_wheels_and_races_give_the_same() -> None:
    """The file mirrored along the spindle: every number of a wheel moves with it."""
    design = design_of()
    mirrored = design_of(
        "wheel.0.plane_mm=-260", "wheel.1.plane_mm=260", "autobalancer.0.plane_mm=-300", "autobalancer.1.plane_mm=300"
    )
    for wheel, other in zip(pressed_wheels(design.case), pressed_wheels(mirrored.case), strict=True):
        assert capacities_at_work(mirrored, other) == pytest.approx(capacities_at_work(design, wheel), rel=1e-9)
        assert contact_of(mirrored, other, (0.0, 0.0)).balanced_force() == pytest.approx(
            contact_of(design, wheel, (0.0, 0.0)).balanced_force(), rel=1e-9
        )


@pytest.mark.slow
def test_a_rigid_contact_that_would_pull_is_not_evaluated() -> None:
    seen = document("--wheel", "1", "--set", "grinding.contact=rigid")
    check = next(check for check in seen["checks"] if check["code"] == "ABU421")
    assert check["status"] == "not-done" and "pull" in check["message"]
    assert seen["result"]["helps"] is None


@pytest.mark.slow
def test_below_a_critical_speed_nothing_is_promised() -> None:
    seen = document("--wheel", "1", "--set", "machine.speed_rpm=700")
    assert [(check["code"], check["status"]) for check in seen["checks"]] == [("ABU421", "not-done")]
    assert seen["result"]["helps"] is None and seen["result"]["level_after_db"] is None


@pytest.mark.slow
def test_balls_that_carry_too_little_fail() -> None:
    """A runout of 0.4 mm at a stiff contact asks race 1 for 5.8 kg·mm, and five balls of Ø15 mm carry 4.6 kg·mm."""
    pinned = (
        "autobalancer.0.ball_count=5", "autobalancer.1.ball_count=5", "autobalancer.0.ball_diameter_mm=15",
        "autobalancer.1.ball_diameter_mm=15", "wheel.0.runout_mm=0.4", "grinding.contact_stiffness_N_per_m=2e6",
    )  # fmt: skip
    seen = document("--wheel", "1", *(part for entry in pinned for part in ("--set", entry)))
    statuses = [(check["code"], check["status"]) for check in seen["checks"] if check["code"] in ("ABU422", "ABU423")]
    assert statuses == [("ABU422", "fail"), ("ABU422", "pass"), ("ABU423", "not-done")]


@pytest.mark.few(1)
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("pedestal-grinder",), ("grinding", "press_force_N")),
        (("pedestal-grinder", *SET, "--wheel", "3"), ("wheel", "3", "1 … 2")),
        (("pedestal-grinder", *SET, "--wheel", "0"), ("wheel", "1 … 2")),
        (("avtovaz-707-222", "--wheel", "1"), ("wheel", "one wheel")),
    ],
)
def test_what_cannot_be_answered_is_refused(arguments: tuple[str, ...], words: tuple[str, ...]) -> None:
    seen = abu("grinding", *arguments)
    assert seen.status == 2
    assert all(word in seen.err for word in words), seen.err


@pytest.mark.slow
def test_screen_and_page_fit(tmp_path: Any) -> None:
    """Of one wheel, each of whose start cases is simulated."""
    page = tmp_path / "work.html"
    seen = again("grinding", "pedestal-grinder", *SET, "--wheel", "2", "--output", str(page))
    assert seen.status == 0 and seen.width <= 80 and len(seen.out.splitlines()) <= 48
    assert "<svg" in page.read_text(encoding="utf-8")


@pytest.mark.slow
def test_the_screen_of_both_wheels_fits() -> None:
    seen = once("grinding", "pedestal-grinder", *SET)
    assert seen.status == 0 and seen.width <= 80 and len(seen.out.splitlines()) <= 48


def test_the_study_refuses_a_machine_with_one_race() -> None:
    from abu_calc.features.spindle.work import grind_spindle

    with pytest.raises(InputError, match="one race"):
        grind_spindle(abu_calc.read("avtovaz-707-222"), lambda _: None)
