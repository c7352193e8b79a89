"""Reports on bearing seats: tables, and tolerance zones in plain characters."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from abu_calc.features.seats.study import check_fit
from abu_calc.features.seats.view import zone_lines
from abu_calc.inputs.read_machine import read_machine
from tests.cli.runner import abu

FLESHING = ("check-fit", "mmg-3200k-knife-shaft")


def _metres(micrometres: Sequence[float]) -> tuple[float, ...]:
    return tuple(1e-6 * limit for limit in micrometres)


def zones(*seats: tuple[Sequence[float], Sequence[float], str]) -> list[str]:
    """The drawing of a shaft and a housing whose ring, part and field are these."""
    known = check_fit(read_machine(FLESHING[1])).seats[:2]
    return zone_lines(*(
        replace(row, ring_limits=_metres(ring), part_limits=_metres(part), fit=fit)
        for row, (ring, part, fit) in zip(known, seats, strict=True)
    ))  # fmt: skip


@pytest.mark.few(1)
@pytest.mark.parametrize("width", [60, 80])
def test_the_report_fits_its_width(monkeypatch: pytest.MonkeyPatch, width: int) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    out = abu(*FLESHING, "--full").out
    assert max(map(len, out.splitlines())) <= width
    for words in (
        "may creep",
        "Specify shaft m6",
        "zero line",
        "negative: clearance",
        "Classes that pass",
        "For the drawing",
    ):
        assert words in " ".join(out.split())


def test_the_drawing_of_the_source() -> None:
    lines = zones(([-15, 0], [2, 21], "k6"), ([-18, 0], [-28, 12], "K7"))
    zero = next(i for i, line in enumerate(lines) if "+---" in line)
    assert all(ord(character) < 128 for line in lines for character in line)
    assert max(map(len, lines)) <= 58
    above, below = "".join(lines[1:zero]), "".join(lines[zero + 1 :])
    assert "/" not in above and "/" in below  # rings lie below the zero line
    assert "k6" in above and "k6" not in below
    assert "+21" in above and "-15" in below and "-28" in below and "+12" in above


@pytest.mark.parametrize("part", [[-33, -20], [0, 9], [-9.5, 9.5], [-6, 0], [63, 131], [0, 4]])
def test_zones_stand_where_their_limits_are(part: list[float]) -> None:
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


def test_lists_of_fits_stand_side_by_side() -> None:
    seen = abu("check-fit", "--designation", "6205", "--radial-load-kN", "1", "--shaft", "g6,k5,m5", "--housing", "H7")
    lines = seen.out.splitlines()
    table = [line.split() for line in lines[lines.index("") + 1 :][:4]]
    assert table[0] == ["bearing", "shaft", "housing", "verdict", "specify"]
    assert [row[:3] for row in table[1:]] == [["g6", "g6", "H7"], ["k5", "k5", "H7"], ["m5", "m5", "H7"]]
    assert "FAIL" in table[1] and "pass" in table[2] and "WARN" in table[3] and seen.status == 1
    seen = abu("check-fit", "--designation", "6205", "--shaft", "j5,k5", "--housing", "H7,J7", "--json")
    assert [seat["name"] for seat in seen.document["result"][::2]] == ["j5/H7", "j5/J7", "k5/H7", "k5/J7"]
    wrong = abu("check-fit", "--designation", "6205", "--shaft", "k5,K6")
    assert wrong.status == 2 and "--shaft" in wrong.err


@pytest.mark.slow
def test_sorting_and_repair_are_told() -> None:
    out = abu("check-fit", "--designation", "6205", "--radial-load-kN", "1", "--shaft", "k6", "--housing", "H7",
              "--asked-interference", "5:22").out  # fmt: skip
    assert "group  shaft, µm  bore, µm" in out and "8.5 … 15   -5 … 0" in out
    out = " ".join(abu("check-fit", "--designation", "6205", "--radial-load-kN", "2", "--shaft-limits", "-14:-6",
                       "--shaft", "k6").out.split())  # fmt: skip
    assert "interference after losses -14 … 4 µm, 5.6 µm required" in out and "+2 … +15 µm" in out
    assert "turn down to 20 mm for bearing 6204" in out


def test_a_ring_that_needs_no_interference_shows_none() -> None:
    out = abu("check-fit", "--designation", "6205", "--radial-load-kN", "1", "--full").out
    row = next(line for line in out.splitlines() if "required interference" in line)
    assert row.split()[-1] == "–" and "housing  load" not in out


@pytest.mark.slow
def test_each_word_names_interference_clearance_or_tolerance_class() -> None:
    """The engineer reads no grip, play or field, and what is required and permitted has its sign."""
    out = abu("check-fit", "--designation", "6205", "--radial-load-kN", "3", "--shaft", "m6", "--housing", "H7").out
    assert "shaft Ø25 mm, housing Ø52 mm" in out.splitlines()[0]
    row = next(line for line in out.splitlines() if " shaft    m6 " in line)
    assert "≥ 8.40" in row and "≤ 25.0" in row and "Specify shaft k5" in out
    assert next(line for line in out.splitlines() if " housing  H7 " in line).split()[-3:] == ["none", "≤", "52.0"]
    whole = abu("check-fit", "mmg-3200k-knife-shaft", "--full").out
    for word in (" grip", " jams", " field", "Write ", "tight by", " play"):
        assert word not in out + whole, word


@pytest.mark.slow
def test_notes_of_several_bearings_stand_once() -> None:
    whole = " ".join(abu(*FLESHING, "--full").out.split())
    # Once for the shaft, once for the housing: both rings are under a rotating load.
    assert whole.count("Interference required under a rotating load, without losses") == 2
    assert whole.count("zone of the ring, ###") == 1 and whole.count("SKF General Catalogue 2006: M7, also") == 1


def test_a_bearing_without_a_load_is_judged_for_a_normal_one() -> None:
    seen = abu("check-fit", "--designation", "6203")
    assert seen.out.splitlines()[1].startswith("  PASS: 5 of 5 checks pass")
    assert "(P/C = 0.08, a normal load, assumed)" in " ".join(seen.out.split())


def test_a_temperature_given_for_one_seat_alone_has_its_row(tmp_path: Path) -> None:
    """The shaft works 5 K below its ring; of the housing nothing is said."""
    file = tmp_path / "warm.toml"
    file.write_text(
        '[machine]\nname = "warm"\n[[bearing]]\ndesignation = "6205"\nring_temperature_difference_K = 5\n',
        encoding="utf-8",
    )
    out = abu("check-fit", str(file), "--full").out
    (row,) = (line for line in out.splitlines() if line.strip().startswith("working"))
    assert row.split()[-1] == "–" and "µm" not in row
