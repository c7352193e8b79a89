"""`abu check-fit`: the report, its drawing, the options."""

from types import NoneType
from typing import get_args

import pytest

from abu_calc.features.seats.command import BANDS, OPTIONS
from abu_calc.inputs.rolling_bearing import Bearing
from tests.cli.runner import abu

BARE = ("check-fit", "--bore", "80", "--outer", "140", "--width", "33", "--shaft", "m6", "--housing", "K7")


def test_bare_options_give_a_whole_result_for_a_normal_load():
    seen = abu(*BARE, "--json")
    shaft, housing = seen.document["result"]
    assert shaft["interference_um"] == [11, 45] and housing["interference_um"] == [-30, 28]
    assert shaft["required_interference_um"] == pytest.approx(19.448, abs=1e-3)  # P = 0.08·C of 32216
    undone = {check["code"]: check for check in seen.document["checks"] if check["status"] == "not-done"}
    decisive = {code for code, check in undone.items() if not check["message"].endswith("(optional)")}
    assert not decisive and {"ABU631", "ABU632", "ABU635"} < set(undone)
    assert all(check["remedy"] for check in undone.values())
    grip = next(check for check in seen.document["checks"] if check["code"] == "ABU601")
    assert grip["status"] == "warn" and "(normal, assumed)" in grip["message"] and seen.status == 0


def test_bare_options_and_a_load_give_a_whole_result():
    seen = abu(*BARE, "--radial-load-kN", "0.8", "--json")
    shaft, housing = seen.document["result"]
    assert seen.status == 0
    assert shaft["interference_um"] == [11, 45] and housing["interference_um"] == [-30, 28]
    assert shaft["creep"]["verdict"] == "holds" and housing["creep"]["verdict"] == "needs no grip"
    assert shaft["required_interference_um"] == pytest.approx(0.08 * (80 * 800 / 33) ** 0.5, abs=1e-4)
    assert shaft["selective_groups"] is None and shaft["internal_clearance"] is None


def test_every_key_has_an_option_that_is_taken():
    assert {option.key for option in OPTIONS} == set(Bearing.model_fields)
    given = {"--designation": "6203", "--shaft": "m5", "--housing": "H7", "--radial-load-kN": "0.3",
             "--series": "light", "--inner-ring-load": "rotating", "--outer-ring-load": "stationary",
             "--bearing-class": "6", "--chamfer": "0.5", "--shaft-rz": "2", "--housing-rz": "3",
             "--ring-temperature-difference": "3", "--speed": "5800", "--shaft-bore": "4", "--housing-outer": "70",
             "--housing-material": "aluminium", "--internal-clearance": "C3",
             "--raceway-temperature-difference": "5", "--starting-torque": "0.5", "--seat-friction": "0.1",
             "--asked-interference": "3:18", "--name": "spindle", "--dynamic-load-rating": "9.95",
             "--static-load-rating": "4.75", "--housing-limits": "0:20", "--temperature-rise": "30",
             "--housing-temperature-difference": "-4", "--shaft-material": "stainless-steel",
             "--shaft-strength": "250", "--housing-strength": "120", "--bearing-type": "ball",
             "--axial-load-kN": "0.1", "--load-kind": "moderate",
             "--lubricant-viscosity": "20", "--contamination-factor": "0.6",
             "--required-life": "500", "--position": "35", "--short-pairs-warn": "2", "--short-pairs-fail": "6",
             "--temperature-range": "-20:60", "--ring-outer-limits": "-8:-1", "--mounting-clearance": "12"}  # fmt: skip
    others = {"--bore", "--outer", "--width", "--shaft-limits", "--housing-split", "--ring-bore-limits",
              "--cutting-force", "--normal-to-cutting", "--bearings-sharing"}  # fmt: skip
    assert set(given) | others == {option.name for option in OPTIONS}
    seen = abu("check-fit", *(word for pair in given.items() for word in pair), "--housing-split", "--json")
    shaft = seen.document["result"][0]
    assert shaft["name"] == "spindle" and shaft["asked_interference_um"] == [3, 18]
    assert {loss["name"] for loss in shaft["losses"]} == {
        "load", "pressure", "smoothing", "temperature", "centrifugal growth",
    }  # fmt: skip
    assert shaft["internal_clearance"]["group"] == "C3" and shaft["creep"]["holds_at_start"] is not None


def test_options_take_what_their_keys_take():
    for option in OPTIONS:
        if option.key not in BANDS:  # two numbers, LOW:HIGH
            annotation = Bearing.model_fields[option.key].annotation
            assert (float in {annotation, *get_args(annotation)} - {NoneType}) == (option.type is float), option.key


def test_options_and_a_file_of_the_same_bearing_agree(tmp_path):
    file = tmp_path / "seats.toml"
    file.write_text(
        "[machine]\nname = 'm'\n[[bearing]]\nbore_mm = 80.0\nouter_mm = 140.0\nwidth_mm = 33.0\n"
        "shaft_fit = 'm6'\nhousing_fit = 'K7'\nasked_interference_um = [3.0, 40.0]\n",
        encoding="utf-8",
    )
    by_file, by_options = abu("check-fit", str(file), "--json"), abu(*BARE, "--asked-interference", "3:40", "--json")
    assert by_file.document["result"] == by_options.document["result"]
    assert by_file.document["checks"] == by_options.document["checks"]
    assert by_options.document["input"] is None and by_file.document["input"]["file"] == str(file)


def test_what_plays_no_part_is_told():
    seen = abu(*BARE, "--seat-friction", "0.2", "--json")
    assert "seat_friction plays no part" in seen.document["warnings"][0]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [(("--asked-interference", "10-28"), ("--asked-interference", "LOW:HIGH")),
     (("--asked-interference", "28:10"), ("ascend",)), (("--internal-clearance", "C7"), ("C7", "CN")),
     (("--set", "bearing[0].shaft_fit=m6"), ("--set",)), (("--seat-friction", "2"), ("--seat-friction",)),
     (("--speed", "nan"), ("--speed",))],
)  # fmt: skip
def test_wrong_options_are_refused(arguments, said):
    seen = abu(*BARE, *arguments)
    assert seen.status == 2 and not seen.out
    assert all(word in seen.err for word in said), seen.err


def test_without_fits_it_answers_which_to_write():
    seen = abu("check-fit", "--designation", "608", "--radial-load-kN", "0.4")
    assert seen.status == 0 and "Specify shaft js5, housing H7, clearance CN (P/C = 0.12)." in " ".join(
        seen.out.split()
    )
    by_sizes = abu("check-fit", "--bore", "80", "--outer", "140", "--width", "33", "--radial-load-kN", "3", "--json")
    shaft, housing = by_sizes.document["result"]
    assert (shaft["recommended_fit"], shaft["fit_given"], housing["recommended_fit"]) == ("m6", False, "H7")
    assert by_sizes.status == 0


@pytest.mark.parametrize("text", ["P5", "5", "p5"])
def test_classes_may_be_written_as_people_do(text):
    seen = abu("check-fit", "--designation", "6205", "--bearing-class", text, "--radial-load-kN", "1", "--json")
    assert seen.document["result"][0]["ring_limits_um"] == [-6, 0] and seen.status == 0
    normal = abu("check-fit", "--designation", "6205", "--bearing-class", "Normal", "--json").document["result"][0]
    assert normal["ring_limits_um"] == [-10, 0]
