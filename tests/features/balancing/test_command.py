"""`abu balance` as its users see it: orders, drawing, checks with their numbers, one screen, files."""

import json
import math
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import abu_calc
from abu_calc.features.balancing.errors import correction, removed, total
from abu_calc.features.balancing.records import PlaneCorrection
from abu_calc.features.balancing.view import drawing
from tests.cli.runner import Seen, abu
from tests.features.balancing.rig import BARE_ROTOR, RIG, ROTOR, Simulated, Workshop, trial, turned, written
from tests.house.structure import ROOT

PRESET = "sapropel-screw-rig"


@pytest.fixture(autouse=True)
def terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")


def fits(seen: Seen) -> bool:
    return len(seen.out.splitlines()) <= 48 and seen.width <= 80


def check(document: dict, code: str) -> dict:
    return next(one for one in document["checks"] if one["code"] == code)


def test_the_preset_says_what_to_do_on_one_screen() -> None:
    seen = abu("balance", PRESET)
    lines = [line.strip() for line in seen.out.splitlines()]
    assert seen.status == 0 and fits(seen)
    assert lines[1] == "PASS"
    assert lines[2:4] == ["LEFT plane: take off 12.00 g at 205.0°.", "RIGHT plane: take off 7.000 g at 320.0°."]
    assert "AGAINST rotation" in abu("balance", PRESET, "--full").out


def test_the_document_is_as_interface_and_schema_say() -> None:
    document = abu("balance", PRESET, "--json").document
    result = document["result"]
    for side in ("left", "right"):
        assert result[side].keys() >= {
            "mass_g", "angle_deg", "mass_uncertainty_g", "angle_uncertainty_deg", "remove_at_deg", "add_at_deg",
        }  # fmt: skip
    assert result["residual_check"]["reproduced"] < 1e-12
    assert result["natural_frequencies_hz"] == pytest.approx([12.5422, 17.3499], rel=1e-5)
    assert result == abu_calc.balance(PRESET).to_dict() == abu_calc.balance(abu_calc.read_readings(PRESET)).to_dict()
    jsonschema.Draft202012Validator(json.loads(abu("schema", "result").out)).validate(document)


@pytest.mark.parametrize("suffix", [".json", ".toml", ".csv", ".txt"])
def test_output_formats(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"answer{suffix}"
    assert abu("balance", PRESET, "-q", "--output", str(path)).status == 0
    assert path.stat().st_size > 500


def test_init_validate_schema_verify_presets_and_explain_know_the_kind(tmp_path: Path) -> None:
    file = str(tmp_path / "mine.toml")
    assert "abu balance" in " ".join(abu("init", "--readings", file).out.split())
    assert abu("validate", file).status == 0 and abu("balance", file, "-q").status == 0
    assert abu("init", "--readings", file).status == 2
    schema = json.loads(abu("schema", "readings").out)
    jsonschema.Draft4Validator(schema).validate(tomllib.loads(Path(file).read_text(encoding="utf-8")))
    assert abu("init", "--readings", "--scene", str(tmp_path / "x.toml")).status == 2
    copy = str(tmp_path / "copy.toml")
    assert "abu balance" in " ".join(abu("init", "--preset", PRESET, copy).out.split())
    assert abu("verify", copy).status == 0 and abu("verify", str(tmp_path)).status == 0
    text = Path(copy).read_text(encoding="utf-8")
    Path(copy).write_text(text.replace('"left.mass_g" = 12.0', '"left.mass_g" = 13.0'), encoding="utf-8")
    assert abu("verify", copy).status == 1
    assert abu("verify", "--update", copy).status == 0 and abu("verify", copy).status == 0
    Path(copy).write_text(text.split("[expected]")[0], encoding="utf-8")
    assert abu("verify", "--update", copy).status == 0 and '"left.angle_deg" = 205.0' in Path(copy).read_text("utf-8")
    assert PRESET in abu("presets").out and abu("presets", PRESET).out == text
    assert "wrong side" in " ".join(abu("explain", "balance").out.split())
    assert abu("verify", PRESET).status == 0


def test_it_needs_no_scipy() -> None:
    lines = ("import sys", "from abu_calc.cli.app import run", f"run(['balance', '{PRESET}', '-q'])")
    code = "; ".join((*lines, "print('scipy' in sys.modules)"))
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


def test_other_commands_send_readings_to_balance() -> None:
    for command in ("size", "simulate", "stability", "check-fit"):
        seen = abu(command, PRESET)
        assert seen.status == 2 and "`abu balance` takes it" in seen.err
    assert "`abu size` takes it" in abu("balance", "msh-230").err


# Remove, add, split


SPREAD = st.lists(st.floats(0, 6.28), min_size=2, max_size=6).filter(lambda p: abs(math.sin(p[1] - p[0])) > 0.01)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.floats(0.001, 1.0), st.floats(-7, 7), st.none() | st.floats(0, 1), st.none() | SPREAD)
def test_shares_take_away_the_heavy_spot(mass: float, angle: float, removable: float | None, places) -> None:
    shares = correction(mass, angle, removable, places)
    assert abs(total(shares) - mass * np.exp(1j * angle)) < 1e-9 * mass / 0.01
    assert all(one.mass > 0 and 0 <= one.angle < 2 * math.pi for one in shares) and 1 <= len(shares) <= 2
    if places is not None:
        assert all(any(abs(math.sin((one.angle - p) / 2)) < 1e-9 for p in places) for one in shares)
    elif removable is not None:
        assert removed(shares) <= removable


def run_with(folder: Path, *rotor: str, masses=(12.0, 7.0), angles=(205.0, 320.0)) -> dict:
    shop = Workshop(masses=masses, angles=angles)
    return abu("balance", written(folder, RIG, ROTOR, *rotor, shop.run()), "--json").document


def test_too_little_metal_is_welded_opposite(tmp_path: Path) -> None:
    result = run_with(tmp_path, "max_removable_g = 10.0")["result"]
    (left,), (right,) = result["left"]["corrections"], result["right"]["corrections"]
    assert left["action"] == "add" and left["angle_deg"] == pytest.approx(25) and left["mass_g"] == pytest.approx(12)
    assert right["action"] == "remove" and right["angle_deg"] == pytest.approx(320)


def test_shares_stand_at_the_places_given(tmp_path: Path) -> None:
    """12 g at 205°: flights at 0, 120, 240; 7 g at 320°: only at 10 and 100, so that one side is put on."""
    places = "left_places_deg = [0, 120, 240]\nright_places_deg = [10, 100]"
    result = run_with(tmp_path, places)["result"]
    left = {round(one["angle_deg"]): (one["action"], one["mass_g"]) for one in result["left"]["corrections"]}
    whole = 12 / math.sin(math.radians(120))  # law of sines: 35° from 240, 85° from 120, 120° between
    assert left == {
        120: ("remove", pytest.approx(whole * math.sin(math.radians(35)))),
        240: ("remove", pytest.approx(whole * math.sin(math.radians(85)))),
    }
    right = result["right"]["corrections"]
    assert [one["action"] for one in right] == ["remove", "add"]
    gone = sum((1 if one["action"] == "remove" else -1) * one["mass_g"] * np.exp(1j * math.radians(one["angle_deg"]))
               for one in right)  # fmt: skip
    assert gone == pytest.approx(7 * np.exp(1j * math.radians(320)), rel=1e-9)


def test_places_that_leave_no_way_fail(tmp_path: Path) -> None:
    document = run_with(tmp_path, "max_removable_g = 1.0\nleft_places_deg = [200, 210]")
    assert check(document, "ABU1008")["status"] == "fail" and document["status"] == "fail"


# Angles, drawn


def plane(angle: float) -> PlaneCorrection:
    seen = abu_calc.balance(PRESET).left
    values = {name: getattr(seen, name) for name in seen.entries()}
    shares = (type(seen.corrections[0])(action="remove", mass_g=1.0, angle_deg=angle),)
    return PlaneCorrection(**(values | {"corrections": shares, "angle_deg": angle}))


@pytest.mark.parametrize("angle", [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0])
@pytest.mark.parametrize("sense", ["counterclockwise", "clockwise"])
def test_angles_are_drawn_as_one_stands_before_the_roll(angle: float, sense: str) -> None:
    """The roll turns with the arrows; laid off against them from the mark on top, the sign is where the angle says."""
    one = plane(angle)
    lines = drawing(one, one, sense)
    turn = math.radians(angle)
    from_left = 1.0 if sense == "counterclockwise" else -1.0
    for start, flip in ((2, from_left), (40, -from_left)):
        cells = [line.ljust(80)[start : start + 36] for line in lines[1:]]
        upper = next(row for row in cells if re.search(r"<---|--->", row))
        assert ("<---" in upper) == (flip > 0)  # counterclockwise: the top runs to the left
        bare = [re.sub("<---|--->", "    ", row) for row in cells]
        signs = [(x, y) for y, row in enumerate(bare) for x, letter in enumerate(row) if letter == "-"]
        ((x, y),) = signs
        across, up = (x - 18) / 11 * flip, (6 - y) / 5
        assert across == pytest.approx(math.sin(turn), abs=0.1) and up == pytest.approx(math.cos(turn), abs=0.15)


def test_both_ends_show_the_same_roll() -> None:
    """The right plane is seen from the other end: the drawing of the same angles is its mirror image."""
    one = plane(70.0)
    lines = drawing(one, one, "counterclockwise")[2:-1]
    for line in lines:
        left, right = line.ljust(80)[2:39], line.ljust(80)[40:77]
        shape = [letter in ".o-" for letter in left], [letter in ".o-" for letter in right[::-1]]
        assert sum(a != b for a, b in zip(*shape, strict=True)) <= 8


# Refused or flagged, with the number


def test_a_speed_near_a_natural_frequency_is_flagged_and_then_refused(tmp_path: Path) -> None:
    found = {}
    for rpm in (1800.0, 1260.0, 1100.0, 1041.0):
        shop = Workshop(speed_rpm=rpm)
        seen = abu("balance", written(tmp_path, RIG, ROTOR, shop.run()), "--json")
        found[rpm] = seen
    assert check(found[1800.0].document, "ABU1002")["status"] == "pass"
    warned = check(found[1260.0].document, "ABU1002")
    assert warned["status"] == "warn" and warned["value"] == pytest.approx(21 / 17.34994 - 1, rel=1e-4)
    assert "would leave" in warned["remedy"]
    assert check(found[1100.0].document, "ABU1002")["status"] == "fail" and found[1100.0].status == 1
    assert found[1041.0].status == 3 and found[1041.0].document["result"] is None
    assert re.search(r"condition number is \d|leave \d+ %", found[1041.0].err)


def test_what_the_remedy_promises_is_so(tmp_path: Path) -> None:
    seen = abu("balance", written(tmp_path, RIG, ROTOR, Workshop(speed_rpm=1260.0).run()), "--json").document
    rpm, share = re.findall(r"At (\d+) rpm the same errors would leave ([\d.]+) %", check(seen, "ABU1002")["remedy"])[0]
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
    found = check(seen.document, "ABU1006")
    assert found["status"] in ("warn", "fail") and found["value"] > 3 and "bends" in found["remedy"]


def test_a_roll_that_bends_is_flagged_with_the_ratio(tmp_path: Path) -> None:
    for bending, status in ((9000.0, "pass"), (5000.0, "warn"), (4000.0, "fail")):
        document = run_with(tmp_path, f"first_bending_speed_rpm = {bending}")
        found = check(document, "ABU1003")
        assert found["status"] == status and found["value"] == pytest.approx(3000 / bending)
    shop = Workshop()
    slow = abu("balance", written(tmp_path, RIG, ROTOR, shop.run(), "[tolerance]\nservice_speed_rpm = 6000"), "--json")
    assert check(slow.document, "ABU1003")["status"] == "warn" and check(slow.document, "ABU1003")["value"] > 1


def test_trial_runs_that_do_not_suffice_are_refused_with_what_is_missing(tmp_path: Path) -> None:
    shop = Workshop()
    runs = [shop.run(), shop.put_on(0, 10.0, 0.0).run(trial(0, 10.0, 0.0))]
    seen = abu("balance", written(tmp_path, BARE_ROTOR, *runs))
    assert seen.status == 2 and "none with a trial in the right plane" in seen.err and "three runs" in seen.err
    other = Workshop(speed_rpm=2000.0).put_on(1, 10.0, 0.0).run(trial(1, 10.0, 0.0))
    seen = abu("balance", written(tmp_path, BARE_ROTOR, *runs, other))
    assert seen.status == 2 and "one speed" in seen.err


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
    assert known["result"]["method"] == "rig data" and any("masses that tell" in line for line in known["warnings"])
    heavy = [shop.run(), *(shop.put_on(k, 20.0, 0.0).run(trial(k, 20.0, 0.0)) for k in (0, 1))]
    good = abu("balance", written(tmp_path, BARE_ROTOR, *heavy), "--json")
    assert good.status == 0 and check(good.document, "ABU1007")["status"] == "pass"


def test_the_grade_is_shared_by_the_centre_of_mass(tmp_path: Path) -> None:
    """9549·6.3·64/3000 g·mm in all, the nearer plane more."""
    shop, grade = Workshop(), '[tolerance]\nbalance_grade = "G6.3"'
    document = abu("balance", written(tmp_path, RIG, ROTOR, shop.run(), grade), "--json").document
    result, whole = document["result"], 9549.3 * 6.3 * 64 / 3000
    assert result["residual_check"]["permitted_g_mm"] == pytest.approx(whole, rel=1e-4)
    assert result["left"]["permitted_g_mm"] == pytest.approx(whole * 0.61 / 1.13, rel=1e-4)
    assert all(one["status"] == "pass" for one in document["checks"] if one["code"] == "ABU1005")
    assert any("service_speed_rpm is not given" in line for line in document["warnings"])
    fine = abu("balance", written(tmp_path, RIG, ROTOR, shop.run(), '[tolerance]\nbalance_grade = "G0.4"'), "--json")
    assert {one["status"] for one in fine.document["checks"] if one["code"] == "ABU1005"} == {"fail"}
    small = Workshop(masses=(0.5, 0.5))
    said = abu("balance", written(tmp_path, RIG, ROTOR, small.run(), grade), "--json").document["warnings"]
    assert any("no correction is needed" in line for line in said)


@pytest.mark.parametrize("count", [1, 12])
def test_every_report_fits(tmp_path: Path, count: int) -> None:
    """Many runs of all quantities near a natural frequency, with everything that can be said."""
    shops = [Workshop(speed_rpm=1100.0 + 40 * k, quantity=("acceleration", "velocity")[k % 2]) for k in range(count)]
    extra = "max_removable_g = 1.0\nleft_places_deg = [200, 210]\nfirst_bending_speed_rpm = 1500"
    grade = '[tolerance]\nbalance_grade = "G0.4"'
    file = written(tmp_path, RIG, ROTOR, extra, *(shop.run() for shop in shops), grade)
    seen = abu("balance", file)
    assert seen.status == 1 and fits(seen), seen.out
    assert abu("balance", file, "--full").width <= 80
    assert abs(turned(abu_calc.balance(file).left.angle_deg, 205)) < 1e-3
