"""Which starts decide, and have to be confirmed by a tighter run."""

from dataclasses import replace

from abu_calc.simulation.start_cases import Lost, Member, StartOutcome, deciding, worse

DRAG = 15.0


def start(level: float, time: float = 0.1, drag: float = DRAG, **changed: float | bool | None) -> StartOutcome:
    """One that balances."""
    one = StartOutcome(Member("bunched", drag), 0.3, time, 0.4, False, 1e-5, level, 0.0, 1e-5, 1e-4)
    return replace(one, **changed)  # type: ignore[arg-type]


def test_the_loudest_and_the_latest_are_confirmed() -> None:
    """The loudest by a run to the end, for what counts is its level there; the latest may end early."""
    found = [start(98.0), start(99.0), start(97.0, 0.9), start(96.0)]
    assert deciding(found, DRAG) == {1: False, 2: True}
    found[1], found[2] = replace(found[1], confirmed=True), replace(found[2], confirmed=True)
    assert deciding(found, DRAG) == {}


def test_the_latest_is_the_last_to_be_quiet() -> None:
    """Neither the old settling time nor the time of rest decides; what is never quiet comes last."""
    found = [start(99.0, confirmed=True), start(97.0, 0.8), start(97.0, settling_time=None, rest_time=None)]
    assert deciding(found, DRAG) == {1: True}
    assert deciding([*found, start(97.0, quiet_time=None)], DRAG) == {3: True}


def test_what_is_as_loud_as_one_confirmed_decides_nothing() -> None:
    """Within what no level is known to."""
    found = [start(99.0, 0.9, confirmed=True), start(99.2), start(99.4)]
    assert deciding(found[:2], DRAG) == {}
    assert deciding(found, DRAG) == {2: False}


def test_what_might_have_become_the_loudest_is_followed_to_the_end() -> None:
    """A run that ended early while its level rose, confirmed for its time or not."""
    found = [start(99.0, 0.9, confirmed=True), start(98.0, rise=3.0), start(98.5, rise=0.5)]
    assert deciding(found, DRAG) == {1: False}
    found[1] = replace(found[1], confirmed=True)
    assert deciding(found, DRAG) == {1: False}
    found[1] = worse(found[1], start(98.2))  # type: ignore[assignment]
    assert found[1].level == 98.2 and found[1].confirmed and deciding(found, DRAG) == {}


def test_what_hangs_decides_before_what_is_loud() -> None:
    """And the worst at the drag given beside the worst of all."""
    hangs = start(90.0, slip=0.9)
    found = [start(99.0, 0.9, confirmed=True), hangs, start(120.0, drag=5.0)]
    assert deciding(found, DRAG) == {1: False, 2: False}


def test_a_tighter_run_that_ends_otherwise_never_makes_it_easier() -> None:
    """The worse of both stands, and a start without an answer stays without."""
    good, bad, lost = start(99.0), start(95.0, imbalance=1.0), Lost(Member("bunched", DRAG), "why", 1)
    assert worse(good, bad).level == worse(bad, good).level == 95.0  # type: ignore[union-attr]
    assert worse(lost, good) is lost and worse(good, lost) is lost
    assert worse(good, start(98.0)) == start(98.0, confirmed=True)
