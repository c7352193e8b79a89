"""Formulas of both seats with the numbers of a bearing put in."""

from dataclasses import replace

import pytest

from abu_calc.features.seats.formula_view import seat_numbers
from abu_calc.features.seats.study import check_fit
from abu_calc.inputs.read_machine import read_machine
from tests.cli.runner import abu

FLESHING = ("check-fit", "mmg-3200k-knife-shaft")


@pytest.mark.slow
def test_explain_puts_the_numbers_in() -> None:
    out = " ".join(abu(*FLESHING, "--explain", "--set", "bearing[0].shaft_rz_um=4.0").out.split())
    for line in ("13·3·2.8/29 = 3.766 µm", "0.08·√(80·3000/33) = 6.822 µm", "2 − (0) … 21 − (-15) = 2 … 36 µm",
                 "0.4·4 µm = 1.6 µm", "Source: Lamé", "Afanasiev 2015"):  # fmt: skip
        assert line in out


def test_what_the_file_has_no_data_for_has_no_line() -> None:
    judged = check_fit(read_machine("mmg-3200k-knife-shaft"))
    bearing = judged.judged[0]
    lines = seat_numbers([bearing])
    assert lines[0] == f"{bearing.shaft.name}:"
    assert any("13·F_r·k_B/b_s" in line for line in lines)
    unloaded = replace(bearing.shaft.joint, radial_load=None)
    blank = bearing._replace(shaft=replace(bearing.shaft, joint=unloaded))
    assert not any(line.startswith("shaft: 13·F_r") for line in seat_numbers([blank]))
    assert len(seat_numbers([bearing, bearing])) == 2 * len(lines)


def test_the_spread_of_the_line_is_the_root_of_both_halves() -> None:
    """80 k6 is 19 µm wide and the bore 15: √(9.5² + 7.5²) = 12.1, about a mean of 11.5 + 7.5 = 19."""
    judged = check_fit(read_machine("mmg-3200k-knife-shaft"))
    (line,) = [line for line in seat_numbers(judged.judged[:1]) if line.startswith("shaft: probable")]
    assert "19 ∓ √(9.5² + 7.5²) = 6 … 32 µm" in line


def test_the_standard_deviation_is_a_third_of_the_spread() -> None:
    """√(9.5² + 7.5²)/3 = 4.035, and the mean of 19 is 4.7 of them: 1.2 in a million pairs are loose."""
    judged = check_fit(read_machine("mmg-3200k-knife-shaft"))
    lines = seat_numbers(judged.judged[:1])
    (line,) = (line for line in lines if line.startswith("shaft: P(clearance)"))
    assert "Φ(−(19)/4.035) = 1.2" in line and "σ = √(9.5² + 7.5²)/3" in line


def test_the_life_of_the_bearing_is_computed_from_the_numbers_shown() -> None:
    seen = abu(
        "check-fit", "--designation", "6210", "--radial-load-kN", "3", "--speed", "3000", "--lubricant-viscosity",
        "20", "--explain",
    )  # fmt: skip
    assert "10⁶/(60·3000)·(37.1/3)^3 = 1.051e+04 h" in seen.out and "C0/P0 = 23.2/3 = 7.733" in seen.out
    assert "κ_v = 20/9.82 = 2.037" in seen.out
