"""Long work reports each hundredth once, under the name of the whole."""

from itertools import pairwise

from abu_calc.foundation.progress import STEP, Stage, share_of, silent, within


def test_each_hundredth_is_reported_once() -> None:
    """A thousand calls make at most a hundred and one reports, and none goes back."""
    seen: list[str] = []
    report = share_of(seen.append, "runs")
    assert report is not None
    for k in (*range(1001), 500, 0):
        report(k / 1000)
    shares = [stage.share for stage in seen if isinstance(stage, Stage)]
    assert (shares[0], set(seen)) == (0.0, {"runs"})
    assert 90 <= len(shares) == len(seen) <= 101
    assert all(later - earlier >= STEP * (1 - 1e-9) for earlier, later in pairwise(shares))


def test_a_part_reports_under_the_name_of_the_whole() -> None:
    seen: list[str] = []
    progress = within(within(seen.append, "size"), "starts")
    progress("reads")
    progress(Stage("runs", 0.25))
    assert seen == ["size: starts: reads", "size: starts: runs"]
    assert isinstance(seen[1], Stage) and seen[1].share == 0.25 and not isinstance(seen[0], Stage)


def test_who_does_not_watch_costs_nothing() -> None:
    assert share_of(silent, "runs") is None and within(silent, "size") is silent
