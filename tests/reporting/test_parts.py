"""Parts that reports share: checks with their reasons, defaults, and where a result comes from."""

from abu_calc.foundation.checks import Check
from abu_calc.reporting.parts import reasons
from abu_calc.reporting.text import as_text


def test_a_value_beyond_its_limit_is_not_shown_as_the_limit() -> None:
    def told(value: float) -> str:
        return "".join(as_text(reasons([Check("ABU401", "level", "fail", "told", value, 109.0, "dB")])))

    assert "(109.03 dB, at most 109.00)" in told(109.0312)
    assert "(112.0 dB, at most 109.0)" in told(112.04)
    assert "(109.0 dB, at most 109.0)" in told(109.0)
