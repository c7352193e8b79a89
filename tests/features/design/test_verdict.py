"""The verdict in a word: by the worst grade, with what decides it and the command of a change that was tried."""

import shlex
from dataclasses import replace

import pytest

import abu_calc
from abu_calc.features.design.verdict import Verdict, benefit, faults
from abu_calc.foundation.checks import CHECK_CODES, Check, Grade, OptionalCheck, coded
from abu_calc.simulation.result import Provenance
from tests.remembered import recalled

LEVEL = Check("ABU401", "idle level", "pass", "Loudest start case. It is loud", 104.0, 109.0, "dB")


def of_grades(*grades: Grade) -> Verdict:
    checks = [Check("ABU402", f"check {k}", grade, f"reason {k}. And more") for k, grade in enumerate(grades)]
    return Verdict.of(checks, "It helps.", Provenance.today())


@pytest.mark.parametrize(
    ("grades", "word", "sentence"),
    [
        (("pass", "pass"), "suits", "Suits. It helps."),
        (
            ("pass", "warn", "pass"),
            "suits-but",
            "Suits, but check 1 (and more). It helps.",
        ),
        (
            ("warn", "not-done", "pass"),
            "not-known",
            "Not known: check 1 (reason 1).",
        ),
        (
            ("not-done", "fail", "warn", "fail"),
            "does-not-suit",
            "Does not suit: check 1 (reason 1); check 3 (reason 3).",
        ),
    ],
)
def test_the_worst_grade_decides(grades: tuple[Grade, ...], word: str, sentence: str) -> None:
    verdict = of_grades(*grades)
    assert (verdict.word, verdict.sentence, verdict.next) == (word, sentence, None)


@pytest.mark.parametrize(
    ("late", "words"),
    [
        (["ABU702"], "at most 109.0). With that, name ABU702 fails."),
        (["ABU402", "ABU702"], "at most 96.7). With that, name ABU402 and name ABU702 fail."),
    ],
)
def test_checks_that_fail_with_another_are_named(late: list[str], words: str) -> None:
    cause = LEVEL if len(late) == 1 else replace(LEVEL, code="ABU701", limit=96.7, unit="g·mm")
    failed = [replace(cause, status="fail", value=110.0), *(Check(code, f"name {code}", "fail", "no") for code in late)]
    sentence = Verdict.of(failed, "", Provenance.today()).sentence
    assert sentence.endswith(words) and sentence.count("name ABU702") == 1


def test_a_check_that_nobody_asked_for_decides_nothing() -> None:
    optional = OptionalCheck("ABU407", "vibration at handles", "not-done", "no direction")
    assert Verdict.of([LEVEL, optional], "It helps.", Provenance.today()).word == "suits"


def test_numbers_stand_with_their_limit_and_the_tried_change_is_a_command() -> None:
    late = Check("ABU702", "quiet time", "fail", "late", 1.25, 1.0, "s", "Set … (simulated).", overrides=("e.f=3",))
    moved = {"path": "ensemble.quiet_time_s.worst", "from": 1.25, "to": 0.5}
    reading = Provenance.today("my machine.toml", overrides=(("a.b", 1), ("x.y", 2)))
    verdict = Verdict.of([LEVEL, late], "", reading, ("a.b=2", 'c.d="x y"'), moved)
    assert verdict.sentence == "Does not suit: the machine becomes quiet too late (1.25 s, at most 1.00)."
    creeps = Check(
        "ABU702", "quiet time", "warn", "Slowest: 0.1 s. Further start cases: 1 of 72 still creeps", 0.1, 1.0, "s"
    )
    assert "the balls still creep at the end of some" in Verdict.of([creeps], "", Provenance.today()).sentence
    assert verdict.next is not None
    replaced = ["--set", "x.y=2", "--set", "a.b=2", "--set", 'c.d="x y"']
    assert shlex.split(verdict.next) == ["abu", "size", "my machine.toml", *replaced], "and what was replaced before"
    assert verdict.promise == moved
    plain = Verdict.of([LEVEL], "It helps.", Provenance.today("my machine.toml"), ("a.b=2",), moved)
    assert (plain.next, plain.promise) == (None, None), "nothing is mended of what suits"


@pytest.mark.parametrize(
    ("code", "message", "value", "unit", "words"),
    [
        ("ABU701", "2 do not: one is bunched (hot oil). The value", 5.0, "g·mm", "from every start in hot oil."),
        ("ABU704", "Balls stall in 2 of 40: one (hot oil)", 20.0, "start cases", "stall in hot oil (20 start cases)."),
        ("ABU702", "Slowest at another drag rate: x (cold oil), 12 s. By them one of 1000 takes 11 s", 12.0, "s",
         "too late in cold oil (12.0 s, at most 10.0)."),
    ],
)  # fmt: skip
def test_a_warning_names_the_oil(code: str, message: str, value: float, unit: str, words: str) -> None:
    check = Check(code, CHECK_CODES[code].name, "warn", message, value, 10.0, unit)
    assert Verdict.of([check], "", Provenance.today()).sentence.endswith(words)


def test_what_no_change_mends_is_told_so() -> None:
    told = "No change of the file was found that mends it."
    for grade in ("pass", "warn", "fail", "not-done"):
        check = Check("ABU702", "quiet time", grade, "late", 1.25, 1.0, "s")
        verdict = Verdict.of([check], "It helps.", Provenance.today(), incurable=True)
        assert verdict.sentence.endswith(told) is (grade in ("warn", "fail")) and verdict.next is None


def test_what_the_autobalancer_does_in_a_sentence() -> None:
    told = benefit("left handle", 111.04, 98.66, 109.0, 0.123)
    assert told == (
        "Vibration at the left handle falls from 111.0 to 98.7 dB (18 to 4.3 mm/s), limit 109; quiet after 0.12 s at "
        "the latest."
    )
    assert "falls by 1.5 dB only, from 110.0 to 108.5 dB" in benefit("spindle", 110.0, 108.5, 109.0, None)
    assert "rises from 90.0 to 91.0 dB" in benefit("spindle", 90.0, 91.0, 109.0, None)


@pytest.mark.slow
def test_the_result_holds_it() -> None:
    result = recalled("size", abu_calc.read("avtovaz-707-222"))
    verdict = result.to_dict()["verdict"]
    assert verdict["word"] == "suits" and f"to {result.vibration.level_after_db:.1f} dB" in verdict["sentence"]
    assert abu_calc.size(abu_calc.read("avtovaz-707-222"), starts="none").verdict.word == "not-known"


def test_one_fault_counts_once() -> None:
    """What follows from a support that moves with the imbalance is not told beside it."""
    codes = {
        "ABU101": "fail",
        "ABU103": "fail",
        "ABU401": "not-done",
        "ABU701": "fail",
        "ABU304": "fail",
        "ABU203": "warn",
    }
    numbers = {"ABU101": (2.0, 3.0)}
    checks = [coded(code, grade, "why", *numbers.get(code, (3.0, 2.0))) for code, grade in codes.items()]  # type: ignore[arg-type]
    assert [check.code for check in faults(checks, "fail")] == ["ABU101", "ABU304"]
    assert [check.code for check in faults(checks, "warn")] == ["ABU203"] and not faults(checks, "not-done")
    sentence = Verdict.of(checks, "", Provenance.today()).sentence
    assert "balls go to the heavy side (0.318 Hz, at least 0.477); the race does not stay round (3" in sentence


@pytest.mark.parametrize(
    ("code", "useless"), [("ABU101", True), ("ABU401", True), ("ABU304", False), ("ABU601", False)]
)
def test_a_seat_or_a_strength_is_no_reason_to_leave_the_autobalancer_out(code: str, useless: bool) -> None:
    checks = [coded(code, "fail", "why", 3.0, 2.0)]
    assert Verdict.of(checks, "", Provenance.today(), incurable=True).leave_out is useless
    assert not Verdict.of(checks, "", Provenance.today()).leave_out, "changes are left that were not tried"


def test_a_benefit_that_is_not_known_is_not_told() -> None:
    assert benefit("spindle", 90.0, None, 109.0, 0.1) == ""
    checks = [coded("ABU203", "warn", "why", 0.03, 0.02)]
    assert Verdict.of(checks, "", Provenance.today()).sentence.endswith("(3.00 %, at most 2.00).")
