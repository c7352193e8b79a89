"""Every report on one screen of 80 columns: `size` in 26 lines, the others in 40; the tables of the whole report."""

import re
from dataclasses import replace
from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.design.screen import number_table, size_screen
from abu_calc.features.design.starts import FurtherStarts
from abu_calc.features.design.study import SizeResult
from abu_calc.features.design.tables import action_groups, make, numbers_that_matter
from abu_calc.features.design.verdict import Verdict
from abu_calc.features.design.view import size_blocks
from abu_calc.features.seats.study import CheckFitResult
from abu_calc.features.seats.view import check_fit_screen
from abu_calc.foundation.checks import Check, Grade
from abu_calc.reporting.blocks import Paragraph
from abu_calc.reporting.parts import check_blocks
from abu_calc.reporting.screen import as_text, height
from tests.cli.runner import Seen, abu, once
from tests.cli.test_command import PRESETS
from tests.inputs.scenes import ARM, PLANAR, SCENE, TILTING
from tests.remembered import recalled

GRADES: tuple[Grade, ...] = ("pass", "warn", "fail", "not-done")
COMMANDS = [
    *((command, name) for name in PRESETS for command in ("size", "simulate", "stability", "effects")),
    ("check-fit", "mmg-3200k-knife-shaft"),
    ("verify", "msh-230"),
]
STIFF = ("--set", "suspension.natural_frequencies_hz=[130.0, 130.0]", "--set", "suspension.damping_ratios=[0.05, 0.05]")


@pytest.fixture(autouse=True)
def terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")


@pytest.fixture(scope="module")
def sized() -> SizeResult:
    return recalled("size", abu_calc.read("msh-230"))


@pytest.fixture(scope="module")
def seats() -> CheckFitResult:
    return abu_calc.check_fit(abu_calc.read("mmg-3200k-knife-shaft"))


def fits(seen: Seen, most: int = 40) -> bool:
    """Lines of a screen; a command to paste stands on one line, however long it is."""
    lines = [line for line in seen.out.splitlines() if not line.startswith("  abu size ")]
    return len(lines) <= most and max(map(len, lines)) <= 80 and "Traceback" not in seen.err


def tables(result: SizeResult) -> str:
    return as_text([*make(result), *numbers_that_matter(result)])


def flat(text: str) -> str:
    return " ".join(text.split())


@pytest.mark.few(4)
@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
@pytest.mark.slow
def test_presets(command: tuple[str, ...]) -> None:
    seen = once(*command)
    assert fits(seen) and seen.out.strip()


ONE_RACE = tuple(name for name in PRESETS if name not in ("pedestal-grinder", "washing-machine-two-races"))


@pytest.mark.few(2)
@pytest.mark.parametrize("name", ONE_RACE)
@pytest.mark.slow
def test_size_needs_at_most_26_lines_and_begins_and_ends_with_the_verdict(name: str) -> None:
    """Two more where a change stands there: what it does, and its command."""
    seen, document = once("size", name), once("size", name, "--json").document
    if "verdict" not in document["result"]:
        pytest.skip("bearings alone")
    verdict, lines = document["result"]["verdict"], seen.out.splitlines()
    word = {"suits": "SUITS", "suits-but": "SUITS, BUT", "does-not-suit": "DOES NOT SUIT"}[verdict["word"]]
    assert fits(seen, 26 + 3 * (verdict["next"] is not None))
    assert lines[1].strip().startswith(word) and lines[-1].strip().startswith(word)
    assert verdict["next"] is None or f"  {verdict['next']}" in lines


def test_rows_of_the_screen_are_numbers_of_the_result(sized: SizeResult) -> None:
    """Each with its limit and grade."""
    text, many = as_text(size_screen(sized)), sized.ensemble
    assert many is not None and many.further_starts is not None
    vibration, further = sized.vibration, many.further_starts
    level = row_of(text, "Idle, wheel plane, expected").split()
    assert level == [f"{vibration.level_before_db:.1f}", f"{vibration.level_after_db:.1f}", "109", "pass"]
    loudest = max(many.level_db.worst or 0.0, further.level_db)
    assert row_of(text, f"loudest of {many.runs} start cases").split() == [f"{loudest:.1f}", "109", "pass"]
    quiet = max(many.quiet_time_s.worst or 0.0, further.quiet_time_s or 0.0)
    assert row_of(text, "Quiet after, s: slowest start").split() == [f"{quiet:.2f}", "1.00", "pass,", "tightest"]
    assert f"{sized.autobalancer.mass_g:.0f} g," in flat(text) and "Assumed Point mass. Measure" in flat(text)


def test_what_does_not_balance_has_no_pass(sized: SizeResult) -> None:
    failed = Check("ABU701", "balances from every start", "fail", "no", 3.0, 2.0, "g·mm")
    text = as_text(size_screen(replace(sized, checks=(*sized.checks[1:], failed))))
    assert not re.search(r"\bpass\b", text) and re.search(r"Balances from every start, g·mm +3.000 +2.000 +FAIL", text)


@pytest.mark.parametrize(
    ("code", "value", "limit"), [("ABU401", 108.9, 109.0), ("ABU404", 0.6, 0.5), ("ABU702", 0.9, 1.0)]
)
def test_no_check_that_is_not_passed_is_hidden(sized: SizeResult, code: str, value: float, limit: float) -> None:
    """One whose value keeps its limit, and one that has no row: a point mass shows no handles."""
    check = Check(code, "name of it", "warn", "why", value, limit, "x", None)
    assert sized.ensemble is not None
    text = as_text(size_screen(replace(sized, checks=(check,))))
    assert "WARN" in text


def test_what_the_next_command_does_is_told_by_its_own_action(sized: SizeResult) -> None:
    seat = Check(
        "ABU601", "seat", "fail", "why", 1.0, 2.0, "µm", "Specify m6: a.", overrides=("bearing.0.shaft_fit=m6",)
    )
    own = Check("ABU701", "starts", "warn", "why", 1.0, 2.0, "g·mm", "Set c = 1: b.", overrides=("oil.grade=VG 100",))
    verdict = Verdict.of([seat, own], "", sized.provenance, own.overrides)
    text = flat(as_text(size_screen(replace(sized, checks=(seat, own), verdict=verdict))))
    assert "Next Set c = 1: b. abu size" in text and "Specify m6" not in text


def test_the_tightest_limit_is_marked_where_all_are_kept(sized: SizeResult) -> None:
    marked = [line for line in as_text(size_screen(sized)).splitlines() if line.endswith("pass, tightest")]
    assert len(marked) == 1 and "Quiet after" in marked[0]
    warned = replace(sized, checks=(*sized.checks, Check("ABU203", "mass", "warn", "why", 9.0, 8.0, "%")))
    assert "tightest" not in as_text(size_screen(warned))


def test_a_fault_of_both_races_has_one_row_that_of_the_worse() -> None:
    races = [Check("ABU304", f"round, race {k}", "fail", "why", 10.0 * k, 5.0, "µm") for k in (1, 2)]
    assert [row[:4] for row in number_table({}, races).rows] == [("Round, µm", "", "20.00", "5.000")]
    assert len(number_table({}, [races[0], replace(races[1], status="warn")]).rows) == 2  # the warning is counted


def test_a_long_change_is_told_without_what_it_replaces(sized: SizeResult) -> None:
    brief = "oil VG 46 (viscosity index 120, 1 ml) and min wall 3 mm"
    told = f"{brief} instead of {'2.5 ' * 70}mm: b falls. Keep balls and race. All checks then pass."
    own = Check("ABU701", "starts", "warn", "why", 1.0, 2.0, "g·mm", told, overrides=("oil.grade=VG 46",))
    verdict = Verdict.of([own], "", sized.provenance, own.overrides, change=brief)
    text = flat(as_text(size_screen(replace(sized, checks=(own,), verdict=verdict))))
    assert "Next Oil VG 46 and min wall 3 mm: b falls. All checks then pass. abu size" in text


def test_a_start_case_louder_than_without_is_told_so(sized: SizeResult) -> None:
    vibration = replace(sized.vibration, level_before_db=95.0)
    text = as_text(size_screen(replace(sized, vibration=vibration)))
    assert "LOUDER THAN WITHOUT" in row_of(text, "loudest of")


@pytest.mark.few(1)
@pytest.mark.parametrize(
    "arguments",
    [
        ("size", "avtovaz-707-370", *STIFF),
        ("size", "msh-230", "--set", "autobalancer.max_outer_diameter_mm=40"),
        ("simulate", "avtovaz-707-222", "--scene", "grinding"),
        ("simulate", "swing-arm-grinder", "--scene", "swing-arm-cutting"),
        pytest.param(
            ("stability", "swing-arm-grinder", "--scene", "swing-arm-idle", "--speeds", "2000:9000"),
            marks=pytest.mark.slow,
        ),
        ("accuracy", "msh-230", "--time-budget", "0.5"),
    ],
    ids=" ".join,
)
@pytest.mark.slow
def test_other_reports(arguments: tuple[str, ...]) -> None:
    assert fits(once(*arguments))


@pytest.mark.few(1)
@pytest.mark.parametrize(
    ("text", "duration"),
    [(SCENE, "20"), (PLANAR, ""), (TILTING, "0.2"), (ARM, "0.5")],
    ids=("bare", "all", "tilt", "arm"),
)
def test_scene_files(tmp_path: Path, text: str, duration: str) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(text, encoding="utf-8")
    assert fits(abu("stability", str(file))) and fits(abu("effects", str(file)))
    if duration:  # the other is chaotic
        assert fits(abu("simulate", str(file), "--duration", duration))


@pytest.mark.slow
def test_what_failed_stands_there_with_its_remedy() -> None:
    arguments = ("size", "avtovaz-707-370", *STIFF)
    document, lines = once(*arguments, "--json").document, once(*arguments, "--full").out
    asked = [check for check in document["checks"] if not check["message"].endswith("(optional)")]
    bad = [check for check in asked if check["status"] != "pass"]
    assert {check["status"] for check in bad} == {"fail", "not-done"}
    for check in bad:
        assert check["code"] in lines and check["message"] in flat(lines)
        assert check["remedy"] is None or check["remedy"] in flat(lines)


def row_of(text: str, label: str) -> str:
    (row,) = [line for line in text.splitlines() if line.strip().startswith(label)]
    return row.strip().removeprefix(label)


@pytest.mark.slow
def test_each_case_has_its_number_its_limit_and_its_grade(sized: SizeResult) -> None:
    text = tables(sized)
    vibration, many = sized.vibration, sized.ensemble
    assert many is not None and vibration.worst_arrangement is not None and sized.friction_bound is not None
    near = f"{sized.friction_bound.reached_within_1_db} of {sized.friction_bound.runs} runs near"
    axes = vibration.handles[0].axes
    assert axes is not None
    before = f"{max(axis.a_h_before_m_per_s2 or 0.0 for axis in axes):.3g}"
    after = f"{max(axis.a_h_after_m_per_s2 or 0.0 for axis in axes):.2f}"
    cases = (
        ("Idle, without autobalancer", vibration.level_before_db, (before,)),
        ("Idle, with: median of the start cases", many.predicted_level_db, ("109", "pass")),
        ("expected, manufacture and friction", vibration.level_after_db, (after, "109", "pass")),
        (f"bound of friction: {near}", vibration.worst_arrangement.level_after_db, ()),
        ("Median of the start cases", many.quiet_time_s.typical, ("1.00", "pass")),
        ("Rest time (the balls keep their places), slowest", many.rest_time_s.worst, ()),
    )
    for label, value, judged in cases:
        number, *others = row_of(text, label).split()
        assert value is not None and float(number) == pytest.approx(value, rel=0.005, abs=0.051)
        assert tuple(others) == judged
    assert f"{sized.autobalancer.mass_g:.0f} g with balls" in row_of(text, "Mass")


@pytest.mark.slow
def test_a_case_beyond_its_limit_points_to_its_action() -> None:
    """The expected level is above a limit of 108 dB; the number of its action stands below, with what it changes.

    Friction alone would hold the balls at 116.4 dB on a vertical spindle: that is told, and judged by none.
    """
    entries = "machine.spindle_axis=vertical", "limits.vibration_level_db=108", "autobalancer.race_eccentricity_mm=0.03"
    lines = once("size", "avtovaz-707-222", *(part for entry in entries for part in ("--set", entry)), "--full").out
    level, *_, limit, grade, number = row_of(lines, "expected, manufacture and friction").split()
    assert (level, limit, grade) == ("108.5", "108", "FAIL")
    assert re.fullmatch(r": \d+ of \d+ runs near +116\.4( +[\d.]+)?", row_of(lines, "bound of friction"))
    assert "spindle held vertical" not in lines
    assert re.search(rf"{number} FAIL ABU401 .* from 108\.5 to \d+\.\d dB \(simulated\)", flat(lines))


def test_a_horizontal_spindle_shows_the_case_held_vertical_too() -> None:
    """Gravity shakes friction out of the horizontal machine; a hand tool gets turned."""
    lines = once("size", "avtovaz-707-222", "--full").out
    assert re.fullmatch(r": \d+ of \d+ runs near +105\.4", row_of(lines, "bound of friction"))
    assert row_of(lines, "spindle held vertical").split() == ["113.5"]
    assert "pressed earlier" in lines and "LOUDER THAN WITHOUT" in lines


def test_an_action_alone_is_printed_if_its_case_stands_in_a_table() -> None:
    checks = (graded("warn", 1), graded("fail", 2))
    alone, told = action_groups(checks, frozenset({1}))
    assert alone[0].text.startswith("1 FAIL ABU403: Remedy 2") and "reason 2" not in alone[0].text
    assert told[0].text.startswith("2 WARN ABU403 thing 1") and "reason 1" in told[0].text


@pytest.mark.slow
def test_balls_that_do_not_balance_are_never_quiet() -> None:
    lines = once("size", "avtovaz-707-370", *STIFF, "--full").out
    assert "Median of the start cases" not in lines or "never" in row_of(lines, "Median of the start cases")


@pytest.mark.slow
def test_nothing_judged_is_no_pass(tmp_path: Path) -> None:
    """A scene given outright, and one under load, have no limits to pass."""
    file = tmp_path / "scene.toml"
    file.write_text(SCENE, encoding="utf-8")
    for arguments in ((str(file), "--duration", "20"), ("avtovaz-707-222", "--scene", "grinding")):
        seen = once("simulate", *arguments)
        assert seen.status == 0 and "PASS" not in seen.out and "NO LIMITS for this scene" in seen.out
    assert "PASS" in once("simulate", "avtovaz-707-222").out.splitlines()[1]


@pytest.mark.slow
def test_amplitude_without_balls_is_told_to_be_off_the_work() -> None:
    """It is of the imbalance alone; that of the wheel pressed, 41.5 µm by `abu grinding`, is another."""
    seen = " ".join(once("simulate", "avtovaz-707-222", "--scene", "grinding").out.split())
    assert "0.0402 mm without balls off the workpiece;" in seen and seen.count("without balls") == 1
    assert "off the work" not in once("simulate", "avtovaz-707-222").out


@pytest.mark.slow
def test_times_after_a_run_up_are_shown_as_they_are_judged() -> None:
    seen = once("simulate", "msh-230", "--scene", "run-up", "--set", "run_up.time_s=1.5")
    quiet, rest = (row_of(seen.out, f"{name} time, from full speed").split() for name in ("quiet", "rest"))
    assert seen.status == 0 and 0 <= float(quiet[0]) < 1 and quiet[1:] == ["s", "at", "most", "1", "s"]
    assert float(quiet[0]) < float(rest[0]) and rest[1:] == ["s"]


# grades
def graded(status: Grade, number: int = 1) -> Check:
    remedy = None if status == "pass" else f"Remedy {number} of many, long enough to be broken into two lines or more."
    return Check("ABU403", f"thing {number}", status, f"reason {number}", 1.0, 2.0, "dB", remedy)


@pytest.mark.slow
def test_grades_differ_without_color(sized: SizeResult) -> None:
    """In the words of the verdict, of the reason and of the table."""
    bare = replace(sized, warnings=())
    verdicts, rows, tables = [], [], []
    for grade in GRADES:
        checks = (graded(grade),)
        verdict = Verdict.of(checks, "It helps.", sized.provenance)
        lines = as_text(size_screen(replace(bare, checks=checks, verdict=verdict))).splitlines()
        verdicts.append(re.split(r"[.:]| thing", lines[1].strip())[0])
        rows.append([re.split(r"\s{2,}", line.strip())[-1] for line in lines if line.strip().startswith("Thing 1")])
        tables.append(as_text(check_blocks([graded(grade)])).splitlines()[2].split(" ABU")[0].strip())
    assert verdicts == ["SUITS", "SUITS, BUT", "DOES NOT SUIT", "NOT KNOWN"]
    assert rows == [[], ["WARN"], ["FAIL"], ["NOT EVALUATED"]]
    assert tables == ["pass", "WARN", "FAIL", "NOT EVALUATED"]


def test_a_warning_is_told_with_its_remedy_and_passes(sized: SizeResult) -> None:
    result = replace(sized, checks=(*sized.checks, graded("warn")), warnings=("One.",))
    text = as_text(size_blocks(result))
    assert result.status == "pass" and "! One." in text
    assert "1 WARN ABU403 thing 1 (1.000 dB, at most 2.000): reason 1. Action: Remedy 1 of many" in flat(text)


# room


def further_starts(time: float | None, rare: float | None, level: float) -> FurtherStarts:
    """By quiet time and level: when balls rest or |U| settles decides nothing without a limit of it."""
    return FurtherStarts(
        members=36, quiet_time=time, rest_time=9.0, settling_time=9.0, rare_quiet_time=rare, level_db=level
    )


SLOWEST = "Slowest of 36 further start cases, over the band"


@pytest.mark.parametrize(
    ("time", "rare", "status", "expected"),
    [
        (0.3, 0.9, "warn", (SLOWEST, "0.30", "1.00", "pass")),
        (1.05, 2.0, "warn", (SLOWEST, "1.05", "1.00", "WARN 1")),
        (1.05, 2.0, "fail", (SLOWEST, "1.05", "1.00", "FAIL 1")),
        (None, None, "warn", (SLOWEST, "never", "1.00", "WARN 1")),
        (0.3, 1.67, "warn", ("One start case of 1000, estimated", "1.67", "1.00", "WARN 1")),
    ],
)
def test_the_slowest_further_start_case_stands_in_the_table(
    sized: SizeResult, time: float | None, rare: float | None, status: Grade, expected: tuple[str, ...]
) -> None:
    """Or the estimate of rare ones where it alone is late."""
    assert sized.ensemble is not None
    further = further_starts(time, rare, 100.0)
    late = Check("ABU702", "quiet time", status, "late", 0.3, 1.0, "s", "Repeat it.")
    result = replace(sized, checks=(late,), ensemble=replace(sized.ensemble, further_starts=further))
    text = tables(result)
    rows = [line for line in text.splitlines() if "further start case" in line or "of 1000" in line]
    assert [tuple(re.split(r"\s{2,}", line.strip())) for line in rows] == [expected]


def test_a_loud_further_start_case_stands_in_the_table(sized: SizeResult) -> None:
    assert sized.ensemble is not None
    further = further_starts(0.3, 0.4, 112.34)
    loud = Check("ABU401", "level", "warn", "loud", 100.0, 109.0, "dB", "Repeat it.")
    result = replace(sized, checks=(loud,), ensemble=replace(sized.ensemble, further_starts=further))
    assert re.search(r"loudest of 36 further start cases +112\.3 +109 +WARN 1", tables(result))


@pytest.mark.slow
@pytest.mark.parametrize(("bad", "warned"), [(0, 0), (0, 60), (5, 7), (14, 0), (60, 60)])
def test_what_there_is_no_room_for_is_counted(seats: CheckFitResult, bad: int, warned: int) -> None:
    checks = tuple(graded(GRADES[1 + number % 3], number) for number in range(bad))
    warnings = tuple(f"Warning {number} " + "of some words " * (number % 12) for number in range(warned))
    blocks = check_fit_screen(replace(seats, seats=seats.seats * 20, checks=checks, warnings=warnings))
    text = as_text(blocks)
    assert height(blocks) <= 40
    for told, all_of, name in ((r"reason \d+\.", bad, "check"), (r"! Warning", warned, "note")):
        counted = re.search(rf"And (\d+) more {name}s?{' .ABU403.' if name == 'check' else ''}: --full", text)
        assert len(re.findall(told, flat(text))) + int(counted[1] if counted else 0) == all_of
        assert counted is None or int(counted[1]) > 0


@pytest.mark.slow
def test_files_and_full_have_the_whole_report(tmp_path: Path) -> None:
    path = tmp_path / "report.txt"
    seen = abu("check-fit", "mmg-3200k-knife-shaft", "--full", "--output", str(path))
    assert path.read_text(encoding="utf-8") == seen.out and "For the drawing" in seen.out
    assert "--full" in once("check-fit", "mmg-3200k-knife-shaft").out


def test_a_number_stays_with_its_unit() -> None:
    for width in range(20, 60):
        text = as_text([Paragraph("settled in 0.142 s, at 5800 rpm and 109 dB; 20 starts, 4.3 % of 5 kg")], width)
        assert not re.search(r"\d\n +(s|rpm|dB|%|kg)\b", text) and flat(text).startswith(
            "settled in 0.142 s, at 5800 rpm"
        )


def test_what_shortens_the_balls_way(sized: SizeResult) -> None:
    """Each start at each drag, the slower of two sides; below the optimum decay is h₀/2J, J = 7/5."""
    many = sized.ensemble
    assert many is not None
    times = {(one.start, round(one.drag_per_s, 6)): one.quiet_time_s for one in many.settling_by_start}
    assert {start for start, _ in times} == {"bunched", "behind", "spread", "standstill", "run-up in 1 s"}
    assert {drag for _, drag in times} == {5.0, 15.0, 45.0} and len(times) == 15
    assert max(time for time in times.values() if time is not None) == many.quiet_time_s.worst
    assert (sized.autobalancer.optimum_drag_per_s or 0) > 15
    assert sized.autobalancer.slowest_decay_per_s == pytest.approx(15 / (2 * 7 / 5), rel=1e-9)


ESTIMATED = str(Path(__file__).parents[2] / "machines" / "angle-grinder-estimated.toml")


@pytest.mark.slow
def test_handles_stand_on_the_screen_axis_by_axis() -> None:
    """The two highest of three handles, without and with the autobalancer, with bands and the limit."""
    assert fits(once("size", ESTIMATED), 29)
    seen = once("size", ESTIMATED, "--full")
    assert "2 of 3 handles" in seen.out and "≤ 1.00" in seen.out and "point mass" not in seen.out
    document = once("size", ESTIMATED, "--json").document
    handles = document["result"]["vibration"]["handles"]
    highest = max(handles, key=lambda handle: handle["a_hv_after_m_per_s2"])
    row = next(line for line in seen.out.splitlines() if line.strip().startswith("with "))
    cells = row.split()
    assert cells[1:8] == [
        *(f"{value:.{digits}f}" for axis in highest["axes"]
          for value, digits in ((axis["level_after_db"], 1), (axis["a_h_after_m_per_s2"], 2))),
        f"{highest['a_hv_after_m_per_s2']:.2f}",
    ]  # fmt: skip
    low, high = highest["a_hv_after_band_m_per_s2"]
    assert low < highest["a_hv_after_m_per_s2"] < high and f"{low:.2f}…{high:.2f}" in seen.out
    assert document["result"]["vibration"]["place"] == "wheel plane"
    assert document["result"]["body"]["estimated"] is True


@pytest.mark.slow
def test_one_total_beside_the_readings_of_a_handle() -> None:
    """The vector total of readings is that of the axes, not √2 of one."""
    for handle in once("size", ESTIMATED, "--json").document["result"]["vibration"]["handles"]:
        assert handle["shown_after"]["total_m_per_s2"] == pytest.approx(handle["a_hv_after_m_per_s2"])
        squares = sum(axis["a_h_after_m_per_s2"] ** 2 for axis in handle["axes"])
        assert handle["a_hv_after_m_per_s2"] == pytest.approx(squares**0.5)


def test_values_that_may_be_slips_of_a_unit_stand_under_the_verdict(sized: SizeResult) -> None:
    odd = [f"{key} = 1900 is unusual, 0.3 … 150 kg is usual." for key in ("machine.mass_kg", "wheel.mass_kg", "third")]
    text = as_text(size_screen(replace(sized, warnings=(*sized.warnings, *odd))), 80)
    under = flat(text.split("\n  Make ")[0])
    assert all(under.count(words) == 1 for words in odd[:2]) and "third" not in text
    assert "1 more unusual value: --full." in under
    assert "unusual" not in as_text(size_screen(sized), 80)
