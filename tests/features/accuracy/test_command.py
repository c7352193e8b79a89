"""`abu accuracy`: its options reach the study under their own names."""

import pytest

from tests.cli.runner import abu


@pytest.mark.parametrize(
    ("option", "value", "said"),
    [("--quantity", "beauty", "settling"), ("--time-budget", "0", "3600"), ("--duration", "-1", "duration"),
     ("--scene", "flying", "idle")],
)  # fmt: skip
def test_a_wrong_option_is_refused_with_what_is_allowed(option: str, value: str, said: str) -> None:
    seen = abu("accuracy", "msh-230", option, value)
    assert seen.status == 2 and option in seen.err and said in seen.err and seen.out == ""
