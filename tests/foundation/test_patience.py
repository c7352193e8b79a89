"""`--patience`: a wall of seconds, past which a check is not done, and never another verdict."""

import time

import pytest

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import choice
from abu_calc.dynamics.integrators.run import TooMuchWorkError
from abu_calc.foundation import patience
from abu_calc.foundation.errors import RangeError
from tests.cli.runner import abu, again
from tests.dynamics.scenes import straight_grinder


def statuses(*arguments: str) -> dict[tuple[str, str], str]:
    """Of each check of `abu size`."""
    ask = abu if "--patience" in arguments else again
    document = ask("size", *arguments, "--json").document
    return {(check["code"], check["name"]): check["status"] for check in document["checks"]}


@pytest.mark.few(1)
@pytest.mark.parametrize("name", ["avtovaz-707-222", "swing-arm-grinder"])
@pytest.mark.slow
def test_past_it_a_check_is_not_done_and_never_another_verdict(name: str) -> None:
    whole, hasty = statuses(name), statuses(name, "--patience", "1e-6")
    assert hasty["ABU701", "balances from every start"] == "not-done"
    for check, status in hasty.items():
        assert status in ("not-done", whole.get(check)), check


@pytest.mark.slow
def test_with_enough_of_it_all_is_as_without() -> None:
    assert statuses("msh-230", "--patience", "600") == statuses("msh-230")


@pytest.mark.parametrize("integrator", ["compiled", "plain", "scipy"])
def test_runs_end_when_it_is_over(integrator: str) -> None:
    """However many evaluations they may take; and begin no more."""
    equations = assemble(straight_grinder())
    ready = choice.choose(equations, integrator, 1e-9)
    ready.integrate(equations, 1e-6, [0.01], 10**6)  # whatever is loaded is loaded
    with patience.limited(1e-3):
        time.sleep(2e-3)
        with pytest.raises(TooMuchWorkError, match="--patience"):
            ready.integrate(equations, 1e-9, [2.0], 1)
    with pytest.raises(TooMuchWorkError, match="more work than allowed"):
        ready.integrate(equations, 1e-9, [2.0], 1)
    with patience.limited(100.0):
        assert ready.integrate(equations, 1e-6, [0.01], 1).t[-1] == 0.01


def test_it_stands_for_what_is_within_alone() -> None:
    assert not patience.given() and not patience.over()
    with patience.limited(50.0), patience.limited(None):
        assert patience.given() and not patience.over()
    assert not patience.given()


@pytest.mark.parametrize("seconds", [0.0, -1.0, float("nan"), float("inf"), 1e7])
def test_what_is_no_time_is_refused(seconds: float) -> None:
    with pytest.raises(RangeError, match="patience"), patience.limited(seconds):
        pass


@pytest.mark.parametrize("command", ["size", "simulate", "grinding", "levels", "accuracy", "stability"])
def test_commands_that_simulate_have_it(command: str) -> None:
    seen = abu(command, "avtovaz-707-222", "--patience", "0")
    assert seen.status == 2 and "--patience" in seen.err
