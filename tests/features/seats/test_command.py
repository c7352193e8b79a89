"""`abu check-fit`: the report, its drawing, the options."""

from dataclasses import replace
from types import NoneType
from typing import get_args

import pytest

from abu_calc.features.seats.command import BANDS, OPTIONS
from abu_calc.features.seats.study import check_fit
from abu_calc.features.seats.view import zone_lines
from abu_calc.inputs.read_machine import read_machine
from abu_calc.inputs.rolling_bearing import Bearing
from tests.cli.runner import abu

BARE = ("check-fit", "--bore", "80", "--outer", "140", "--width", "33", "--shaft", "m6", "--housing", "K7")
FLESHING = ("check-fit", "mmg-3200k-knife-shaft")


def zones(*seats):
    """The drawing of a shaft and a housing whose ring, part and field are these."""
    known = check_fit(read_machine(FLESHING[1])).seats[:2]
    return zone_lines(*(
        replace(row, ring_limits_um=tuple(ring), part_limits_um=tuple(part), fit=fit)
        for row, (ring, part, fit) in zip(known, seats, strict=True)
    ))  # fmt: skip


def test_bare_options_give_a_whole_result_but_for_creep_under_an_unknown_load():
    seen = abu(*BARE, "--json")
    shaft, housing = seen.document["result"]
    assert shaft["interference_um"] == [11, 45] and housing["interference_um"] == [-30, 28]
    assert shaft["required_interference_um"] is None and shaft["creep"]["verdict"] == "not known"
    undone = [check for check in seen.document["checks"] if check["status"] == "not-done"]
    assert [check["code"] for check in undone] == ["ABU601"] and "radial_load_kN" in undone[0]["remedy"]
    assert seen.document["status"] == "not-done" and seen.status == 1


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
             "--shaft-strength": "250", "--housing-strength": "120", "--bearing-type": "ball"}  # fmt: skip
    others = {"--bore", "--outer", "--width", "--shaft-limits", "--housing-split"}
    assert set(given) | others == {option.name for option in OPTIONS}
    seen = abu("check-fit", *(word for pair in given.items() for word in pair), "--housing-split", "--json")
    shaft = seen.document["result"][0]
    assert shaft["name"] == "spindle" and shaft["asked_interference_um"] == [3, 18]
    assert {loss["name"] for loss in shaft["losses"]} == {"load", "smoothing", "temperature", "centrifugal growth"}
    assert shaft["internal_clearance"]["group"] == "C3" and shaft["creep"]["holds_at_start"] is not None


def test_options_take_what_their_keys_take():
    for option in OPTIONS:
        if option.key not in BANDS:  # two numbers, LEAST:MOST
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
    [(("--asked-interference", "10-28"), ("--asked-interference", "LEAST:MOST")),
     (("--asked-interference", "28:10"), ("ascend",)), (("--internal-clearance", "C7"), ("C7", "CN")),
     (("--set", "bearing[0].shaft_fit=m6"), ("--set",)), (("--seat-friction", "2"), ("--seat-friction",)),
     (("--speed", "nan"), ("--speed",))],
)  # fmt: skip
def test_wrong_options_are_refused(arguments, said):
    seen = abu(*BARE, *arguments)
    assert seen.status == 2 and not seen.out
    assert all(word in seen.err for word in said), seen.err


@pytest.mark.parametrize("width", [60, 80])
def test_the_report_fits_its_width(monkeypatch, width):
    monkeypatch.setenv("COLUMNS", str(width))
    out = abu(*FLESHING, "--full").out
    assert max(map(len, out.splitlines())) <= width
    for words in ("may creep", "Write m6", "zero line", "positive when tight", "Fields that pass", "For the drawing"):
        assert words in " ".join(out.split())


def test_explain_puts_the_numbers_in():
    out = " ".join(abu(*FLESHING, "--explain", "--set", "bearing[0].shaft_rz_um=4.0").out.split())
    for line in ("13·3·2.8/29 = 3.766 µm", "0.08·√(80·3000/33) = 6.822 µm", "2 − (0) … 21 − (-15) = 2 … 36 µm",
                 "0.4·4 µm = 1.6 µm", "Source: Lamé", "Afanasiev 2015"):  # fmt: skip
        assert line in out


def test_the_drawing_of_the_source():
    lines = zones(([-15, 0], [2, 21], "k6"), ([-18, 0], [-28, 12], "K7"))
    zero = next(i for i, line in enumerate(lines) if "+---" in line)
    assert all(ord(character) < 128 for line in lines for character in line)
    assert max(map(len, lines)) <= 58
    above, below = "".join(lines[1:zero]), "".join(lines[zero + 1 :])
    assert "/" not in above and "/" in below  # rings lie below the zero line
    assert "k6" in above and "k6" not in below
    assert "+21" in above and "-15" in below and "-28" in below and "+12" in above


@pytest.mark.parametrize("part", [[-33, -20], [0, 9], [-9.5, 9.5], [-6, 0], [63, 131], [0, 4]])
def test_zones_stand_where_their_limits_are(part):
    """Rows that hold the part's mark, by the scale at their left, against the limits."""
    lines = zones(*[([-8, 0], part, "x1")] * 2)
    zero = next(i for i, line in enumerate(lines) if "+---" in line)
    scale = abs(int(lines[zero + 1].split("|")[0]))
    for number, line in enumerate(lines[1:], 1):
        if number == zero:
            continue
        edge = int(line.split("|")[0])
        middle = edge - scale / 2 if number < zero else edge + scale / 2
        if part[1] - part[0] > 2 * scale:
            assert ("#" in line) == (part[0] < middle < part[1]), line
    assert sum("#" in line for line in lines) >= 1


def test_without_fits_it_answers_which_to_write():
    seen = abu("check-fit", "--designation", "608", "--radial-load-kN", "0.4")
    assert seen.status == 0 and "Write shaft js5, housing H7, clearance CN (P/C = 0.12)." in " ".join(seen.out.split())
    by_sizes = abu("check-fit", "--bore", "80", "--outer", "140", "--width", "33", "--radial-load-kN", "3", "--json")
    shaft, housing = by_sizes.document["result"]
    assert (shaft["recommended_fit"], shaft["fit_given"], housing["recommended_fit"]) == ("m6", False, "H7")
    assert by_sizes.status == 0


def test_lists_of_fits_stand_side_by_side():
    seen = abu("check-fit", "--designation", "6205", "--radial-load-kN", "1", "--shaft", "g6,k5,m5", "--housing", "H7")
    lines = seen.out.splitlines()
    table = [line.split() for line in lines[lines.index("") + 1 :][:4]]
    assert table[0] == ["bearing", "shaft", "housing", "verdict", "write"]
    assert [row[:3] for row in table[1:]] == [["g6", "g6", "H7"], ["k5", "k5", "H7"], ["m5", "m5", "H7"]]
    assert "FAIL" in table[1] and "PASS," in table[2] and seen.status == 1
    seen = abu("check-fit", "--designation", "6205", "--shaft", "j5,k5", "--housing", "H7,J7", "--json")
    assert [seat["name"] for seat in seen.document["result"][::2]] == ["j5/H7", "j5/J7", "k5/H7", "k5/J7"]
    wrong = abu("check-fit", "--designation", "6205", "--shaft", "k5,K6")
    assert wrong.status == 2 and "--shaft" in wrong.err


def test_sorting_and_repair_are_told():
    out = abu("check-fit", "--designation", "6205", "--radial-load-kN", "1", "--shaft", "k6", "--housing", "H7",
              "--asked-interference", "5:22").out  # fmt: skip
    assert "group  shaft, µm  bore, µm" in out and "8.5 … 15   -5 … 0" in out
    out = " ".join(abu("check-fit", "--designation", "6205", "--radial-load-kN", "2", "--shaft-limits", "-14:-6",
                       "--shaft", "k6").out.split())  # fmt: skip
    assert "grip left -14 … 4 µm, 5.6 needed" in out and "+2 … +15 µm" in out and "turn down to 20 mm for 6204" in out


def test_a_ring_that_needs_no_interference_shows_none():
    out = abu("check-fit", "--designation", "6205", "--radial-load-kN", "1", "--full").out
    row = next(line for line in out.splitlines() if "required interference" in line)
    assert row.split()[-1] == "–" and "housing  load" not in out


@pytest.mark.parametrize("text", ["P5", "5", "p5"])
def test_classes_may_be_written_as_people_do(text):
    seen = abu("check-fit", "--designation", "6205", "--bearing-class", text, "--radial-load-kN", "1", "--json")
    assert seen.document["result"][0]["ring_limits_um"] == [-6, 0] and seen.status == 0
    normal = abu("check-fit", "--designation", "6205", "--bearing-class", "Normal", "--json").document["result"][0]
    assert normal["ring_limits_um"] == [-10, 0]
