"""One integration on its way: samples in blocks, ends of segments, and runs that are given up."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pytest

from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import run
from abu_calc.dynamics.integrators.run import IntegrationRun, Recorder, TooMuchWorkError, work
from abu_calc.dynamics.rotor import Modes
from abu_calc.dynamics.trajectory import Samples, Sampling, Until
from abu_calc.foundation.errors import InputError, NotTrustworthyError, RangeError
from tests.dynamics.scenes import scene_on, with_effects

Array = np.ndarray
TIMES = np.linspace(0, 1, 11)
STATES = np.array((TIMES, TIMES**2))


@pytest.mark.parametrize("room", [1, 3, 4, 100])
@pytest.mark.parametrize("part", [1, 2, 11])
def test_readers_see_all_samples_however_they_come(room: int, part: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """And what is held of them stays."""
    monkeypatch.setattr(run, "BLOCK", room)
    seen: list[Samples] = []
    shares: list[float] = []
    held = np.array((TIMES[2], TIMES[7], TIMES[8]))
    reader: Callable[[Samples], None] = lambda block: seen.append(Samples(block.t.copy(), block.y.copy()))  # noqa: E731
    recorder = Recorder(Sampling(TIMES, held, (reader,), shares.append))
    for first in range(0, 11, part):
        recorder.fill(STATES[:, first : first + part])
    samples = recorder.samples()
    np.testing.assert_array_equal(np.concatenate([block.t for block in seen]), TIMES)
    np.testing.assert_array_equal(np.hstack([block.y for block in seen]), STATES)
    np.testing.assert_array_equal(samples.y, np.array((held, held**2)))
    assert shares[-1] == 1.0 and max(len(block.t) for block in seen) <= room


@pytest.mark.parametrize("times", [[], [0.0], [1.0, 1.0], [2.0, 1.0], [-1.0, 1.0], [0.0, np.inf], [0.0, np.nan]])
def test_times_that_do_not_ascend_are_refused(times: list[float]) -> None:
    with pytest.raises(InputError, match="ascend"):
        Recorder(Sampling.of(times))


@dataclass
class Standing(IntegrationRun):
    """A toy that stands still: it goes `pace` [s] at most at once, each time to an event where `events_happen`."""

    pace: float = 1e9
    events_happen: bool = False
    cost: int = 1
    bounds: list[float] = field(default_factory=list)

    @property
    def name(self) -> str:
        """Its name."""
        return "standing"

    def segment(self, t: float, state: Array, modes: Modes, bound: float) -> tuple[float, Array, bool]:
        """Nothing moves."""
        reached = min(t + self.pace, bound)
        self.bounds.append(bound)
        self.evaluations += self.cost
        wanted = self.samples[(self.samples > t) & (self.samples <= reached)]
        if len(wanted):
            self.fill(np.tile(state[:, None], len(wanted)))
        return reached, state, self.events_happen and reached < bound


EQUATIONS = assemble(with_effects(scene_on("planar"), RunUpEffect(4.0)))


def test_segments_end_at_breaks_and_where_the_run_may_end() -> None:
    """A run-up is over after 4 s; after 6 s the samples so far are enough."""
    until = Until((2.0, 6.0), lambda samples: bool(samples.t[-1] > 5))
    standing = Standing(EQUATIONS, 1e-6, Sampling(np.linspace(0, 10, 11), until=until), 1000)
    assert standing.ends() == [2.0, 4.0, 6.0, 10.0]
    trajectory = standing.trajectory()
    assert standing.bounds == [2.0, 4.0, 6.0] and trajectory.t.tolist() == list(range(7))
    assert trajectory.integrator == "standing" and work(trajectory) == trajectory.evaluations == 3


def test_a_motion_that_stalls_in_events_is_given_up_with_the_time() -> None:
    with pytest.raises(NotTrustworthyError, match="stalls"):
        Standing(EQUATIONS, 1e-6, [10.0], 10**9, pace=1e-12, events_happen=True).trajectory()


def test_work_beyond_what_is_allowed_is_told_with_what_was_reached() -> None:
    """Ten evaluations and an event, worth fifty, each second: 250 are passed in the fifth."""
    with pytest.raises(TooMuchWorkError, match="events") as given_up:
        Standing(EQUATIONS, 1e-6, [10.0], 250, pace=1.0, events_happen=True, cost=10).trajectory()
    assert 3 < given_up.value.reached <= 6 and given_up.value.evaluations == 10 * given_up.value.reached


def test_a_run_that_must_take_too_much_is_not_begun() -> None:
    hopeless = Standing(EQUATIONS, 1e-6, [1e9], 100)
    with pytest.raises(TooMuchWorkError, match="at least") as refused:
        hopeless.trajectory()
    assert not hopeless.bounds and refused.value.reached == 0.0


@pytest.mark.parametrize("tolerance", [0.0, 1e-14, 0.2, np.nan])
def test_a_tolerance_that_means_nothing_is_refused(tolerance: float) -> None:
    with pytest.raises(RangeError, match="tolerance"):
        Standing(EQUATIONS, tolerance, [1.0], 100)
