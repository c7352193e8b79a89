"""The verdict at the work in words: remedies with their levels, reasons that fit the numbers."""

from types import SimpleNamespace
from typing import Any

import pytest

from abu_calc.features.grinding.verdict import NOTHING, changes, in_words, shortest
from abu_calc.features.grinding.work import TriedRemedy

LEVELS: Any = SimpleNamespace(before=111.04, after=104.96)
RUNOUT = TriedRemedy(runout=2e-5, level_before_db=111.04, level_after_db=104.96)
STIFFNESS = TriedRemedy(contact_stiffness=4.5e5, level_before_db=111.04, level_after_db=104.96)
PRESS = TriedRemedy(press_force=90.0, level_before_db=111.04, level_after_db=104.96)


def side(**values: Any) -> SimpleNamespace:
    steady = SimpleNamespace(balls=None, amplitude=None, reaction=None)
    return SimpleNamespace(
        **({"scatter": 0.0, "parts": False, "failure": None, "run": None, "steady": steady} | values)
    )


def work(**values: Any) -> Any:
    face = SimpleNamespace(contact=SimpleNamespace(contact="face", press_force=45.0))
    usual = {
        "levels": LEVELS, "lowered": True, "always": True, "fitted": side(), "without": side(), "at_once": side(),
        "design": SimpleNamespace(case=face), "level_at_once": 104.96, "stays_loud": False,
    }  # fmt: skip
    return SimpleNamespace(**(usual | values))


def test_each_remedy_says_its_bound_and_its_levels() -> None:
    text = changes((RUNOUT, STIFFNESS, PRESS))
    assert "Reduce wheel.runout_mm to 0.02: 105.0 dB at most, 111.0 dB without." in text
    assert "Reduce grinding.contact_stiffness_N_per_m to 4.5e5: " in text
    assert shortest((PRESS, RUNOUT)) == (
        "Raise grinding.press_force_N to 90: loudest case 105.0 dB, without autobalancer 111.0 dB (simulated)."
    )
    assert changes(()) == "" and shortest(()) is None


def test_a_machine_that_is_quieter_in_every_case_needs_no_remedy() -> None:
    words = in_words(work(), ())
    assert words.startswith("The autobalancer helps under load: 105.0 dB with it, 111.0 dB without. A face ")
    assert NOTHING not in words and "pressed" not in words


def test_a_start_that_stays_loud_is_told_with_what_prevents_it() -> None:
    loud = work(
        always=False, level_at_once=119.6, stays_loud=True, at_once=side(run=SimpleNamespace(duration=6.0), parts=True)
    )
    words = in_words(loud, (RUNOUT,))
    assert "keep bouncing at 119.6 dB, still after 6 s." in words and "Reduce wheel.runout_mm to 0.02: " in words
    unknown = work(always=None, level_at_once=None, at_once=side(failure="too much work"))
    assert "Pressed before the balls have settled: not known, too much work." in in_words(unknown, ())
    assert in_words(unknown, ()).endswith(NOTHING)


def test_levels_within_their_scatter_are_not_told_apart() -> None:
    words = in_words(work(lowered=None, fitted=side(scatter=4.0), without=side(scatter=3.0)), ())
    assert (
        "not known whether the autobalancer helps under load: 105.0 ± 4.0 dB with it and 111.0 ± 3.0 dB without differ"
        in words
    )


@pytest.mark.parametrize(
    ("failure", "said"), [("chaotic", "no simulation can be trusted, chaotic"), (None, "no method of calculation")]
)
def test_a_level_that_is_missing_has_its_reason(failure: str | None, said: str) -> None:
    missing = work(lowered=None, levels=SimpleNamespace(before=None, after=104.0), fitted=side(failure=failure))
    assert said in in_words(missing, ())
