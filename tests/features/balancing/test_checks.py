"""Checks of a correction: resonance, planes, bending, trial masses, each with its number."""

import re
from pathlib import Path

import numpy as np
import pytest

from tests.cli.runner import Seen, abu
from tests.features.balancing.rig import BARE_ROTOR, RIG, ROTOR, Simulated, Workshop, trial, written


def check(document: dict, code: str) -> dict:
    return next(entry for entry in document["checks"] if entry["code"] == code)


def run_with(folder: Path, *rotor: str, masses=(12.0, 7.0), angles=(205.0, 320.0)) -> dict:
    shop = Workshop(masses=masses, angles=angles)
    return abu("balance", written(folder, RIG, ROTOR, *rotor, shop.run()), "--json").document


def test_places_that_leave_no_way_fail(tmp_path: Path) -> None:
    document = run_with(tmp_path, "max_removable_g = 1.0\nleft_places_deg = [200, 210]")
    assert check(document, "ABU1008")["status"] == "fail" and document["status"] == "fail"


def test_a_speed_near_a_natural_frequency_is_flagged_and_then_refused(tmp_path: Path) -> None:
    runs = {}
    for rpm in (1800.0, 1260.0, 1100.0, 1041.0):
        shop = Workshop(speed_rpm=rpm)
        seen = abu("balance", written(tmp_path, RIG, ROTOR, shop.run()), "--json")
        runs[rpm] = seen
    assert check(runs[1800.0].document, "ABU1002")["status"] == "pass"
    warned = check(runs[1260.0].document, "ABU1002")
    assert warned["status"] == "warn" and warned["value"] == pytest.approx(21 / 17.34994 - 1, rel=1e-4)
    assert "the remaining vibration falls from" in warned["remedy"]
    assert check(runs[1100.0].document, "ABU1002")["status"] == "fail" and runs[1100.0].status == 1
    assert runs[1041.0].status == 3 and runs[1041.0].document["result"] is None
    assert re.search(r"condition number is \d|leave (over )?\d+ %", runs[1041.0].err)


def test_what_the_remedy_promises_is_so(tmp_path: Path) -> None:
    seen = abu("balance", written(tmp_path, RIG, ROTOR, Workshop(speed_rpm=1260.0).run()), "--json").document
    rpm, share = re.findall(
        r"at (\d+) rpm: the remaining vibration falls from [\d.]+ to ([\d.]+) %", check(seen, "ABU1002")["remedy"]
    )[0]
    there = abu("balance", written(tmp_path, RIG, ROTOR, Workshop(speed_rpm=float(rpm)).run()), "--json").document
    assert 100 * there["result"]["residual_check"]["rest_share"] == pytest.approx(float(share), abs=0.06)


def test_planes_close_together_are_flagged_and_then_refused(tmp_path: Path) -> None:
    def balanced(b: float, c: float) -> Seen:
        rig = Simulated(a=0.67 - b, b=b, c=c, d=0.81 - c)
        lengths = {"left_end_to_left_plane_m = 0.15": rig.a, "left_plane_to_centre_m = 0.52": b,
                   "centre_to_right_plane_m = 0.61": c, "right_plane_to_right_end_m = 0.20": rig.d}  # fmt: skip
        rotor = ROTOR
        for old, value in lengths.items():
            rotor = rotor.replace(old, f"{old.split(' = ')[0]} = {value!r}")
        return abu("balance", written(tmp_path, RIG, rotor, Workshop(rig).run()), "--json")

    assert check(balanced(0.02, 0.02).document, "ABU1001")["status"] in ("warn", "fail")
    far = balanced(0.5, 0.6)
    assert check(far.document, "ABU1001")["status"] == "pass" and far.status == 0
    close = balanced(0.001, 0.001)
    assert close.status == 3 and close.document["result"] is None and re.search(r"\d", close.err)


def test_a_roll_that_bends_shows_in_runs_of_two_speeds(tmp_path: Path) -> None:
    """Imbalance grows as 1/(1 − (Ω/Ω_b)²) toward a bending speed of 6000 rpm."""
    shops = []
    for rpm in (1800.0, 3000.0):
        more = 1 / (1 - (rpm / 6000) ** 2)
        shops.append(Workshop(speed_rpm=rpm, masses=(12 * more, 7 * more)))
    seen = abu("balance", written(tmp_path, RIG, ROTOR, *(shop.run() for shop in shops)), "--json")
    bending = check(seen.document, "ABU1006")
    assert bending["status"] in ("warn", "fail") and bending["value"] > 3 and "bends" in bending["remedy"]


def test_a_roll_that_bends_is_flagged_with_the_ratio(tmp_path: Path) -> None:
    for bending_rpm, status in ((9000.0, "pass"), (5000.0, "warn"), (4000.0, "fail")):
        document = run_with(tmp_path, f"first_bending_speed_rpm = {bending_rpm}")
        bending = check(document, "ABU1003")
        assert bending["status"] == status and bending["value"] == pytest.approx(3000 / bending_rpm)
    shop = Workshop()
    slow = abu("balance", written(tmp_path, RIG, ROTOR, shop.run(), "[tolerance]\nservice_speed_rpm = 6000"), "--json")
    assert check(slow.document, "ABU1003")["status"] == "warn" and check(slow.document, "ABU1003")["value"] > 1


def test_trial_masses_that_move_nothing_fail(tmp_path: Path) -> None:
    shop = Workshop()
    runs = [shop.run(), *(shop.put_on(k, 0.02, 0.0).run(trial(k, 0.02, 0.0)) for k in (0, 1))]
    seen = abu("balance", written(tmp_path, BARE_ROTOR, *runs), "--json")
    assert seen.status in (1, 3)
    if seen.status == 1:
        assert check(seen.document, "ABU1007")["status"] == "fail"
    tiny = [shop.run(), *(shop.put_on(k, 1e-3, 0.0).run(trial(k, 1e-3, 0.0)) for k in (0, 1))]
    assert abu("balance", written(tmp_path, BARE_ROTOR, *tiny)).status == 3
    known = abu("balance", written(tmp_path, RIG, ROTOR, *tiny), "--json").document
    assert known["result"]["method"] == "rig data" and any(
        "masses that change the readings" in line for line in known["warnings"]
    )
    heavy = [shop.run(), *(shop.put_on(k, 20.0, 0.0).run(trial(k, 20.0, 0.0)) for k in (0, 1))]
    good = abu("balance", written(tmp_path, BARE_ROTOR, *heavy), "--json")
    assert good.status == 0 and check(good.document, "ABU1007")["status"] == "pass"


def test_trial_masses_that_move_nothing_at_all_are_named(tmp_path: Path) -> None:
    shop = Workshop()
    runs = [shop.run(), shop.run(trial(0, 5.0, 0.0)), shop.put_on(1, 20.0, 0.0).run(trial(1, 20.0, 0.0))]
    seen = abu("balance", written(tmp_path, BARE_ROTOR, *runs))
    assert seen.status == 3 and "the trial masses in the left plane do not change the readings" in seen.err


def test_a_trial_mass_counts_by_what_its_sensor_read_before(tmp_path: Path) -> None:
    """A mass that triples the small initial readings is large enough: 30 % of the reading without it are asked."""
    shop = Workshop(masses=(2.0, 2.0), angles=(10.0, 100.0))
    runs = [shop.run(), *(shop.put_on(k, 20.0, 10.0 + 90 * k).run(trial(k, 20.0, 10.0 + 90 * k)) for k in (0, 1))]
    large = check(abu("balance", written(tmp_path, BARE_ROTOR, *runs), "--json").document, "ABU1007")
    before, after = shop.motion(), shop.put_on(0, 20.0, 10.0).motion()
    floor = 0.1 * max(np.abs(shop.put_on(k, 20.0, 10.0 + 90 * k).motion()).max() for k in (0, 1))
    left = (np.abs(after - before) / np.maximum(np.abs(before), floor)).max()
    after = shop.put_on(1, 20.0, 100.0).motion()
    right = (np.abs(after - before) / np.maximum(np.abs(before), floor)).max()
    assert large["status"] == "pass" and large["value"] == pytest.approx(min(left, right), rel=1e-3)


def test_runs_of_one_speed_in_two_units_are_asked_about(tmp_path: Path) -> None:
    shop = Workshop()
    runs = [shop.run(), *(shop.put_on(k, 20.0, 0.0).run(trial(k, 20.0, 0.0)) for k in (0, 1))]
    assert "are in mm" not in abu("balance", written(tmp_path, BARE_ROTOR, *runs)).out
    runs[1] = runs[1].replace('quantity = "displacement"', 'unit = "µm 0-peak"')
    document = abu("balance", written(tmp_path, BARE_ROTOR, *runs), "--json").document
    assert any("in mm and in µm 0-peak" in line for line in document["warnings"])
