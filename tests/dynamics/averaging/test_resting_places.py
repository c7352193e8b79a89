"""Ends of the slow motion with dry friction: held balls, the reference machines, symmetries, and the equations."""

import math

import numpy as np
import pytest

from abu_calc.dynamics.averaging import resting_places as module
from abu_calc.dynamics.averaging.resting_places import RestingPlaces, SlowBalls, resting_places
from abu_calc.foundation.errors import RangeError

RUNS = 20_000
S100 = SlowBalls(3, 2.091e-3 * 20e-3, 20e-3, 15.0, 1.4, 5.0e-6, 1 / 3.2, 10_000 * math.pi / 30)
S150 = SlowBalls(4, 4.084e-3 * 26e-3, 26e-3, 15.0, 1.4, 10.4e-6, 1 / 2.03804, 5800 * math.pi / 30)


def turned(balls: SlowBalls, eccentricity: float, by_wheel: float, runs: int = RUNS, seed: int = 1) -> RestingPlaces:
    """Ends with the test wheel in five orientations."""
    turns = 2 * np.pi * np.arange(runs) / 5
    return resting_places(balls, eccentricity - by_wheel * np.exp(1j * turns), seed)


@pytest.mark.parametrize(
    ("balls", "eccentricity", "by_wheel", "mean", "rms", "high"),
    [
        (S100, 5e-6, 29e-6 / 3.2, 4.33, 5.22, 8.95),
        (S150, 10e-6, 65e-6 * (1 / 6 + 0.36), 8.84, 10.50, 19.6),
    ],
)
@pytest.mark.slow
def test_displacements_of_the_reference_machines(
    balls: SlowBalls, eccentricity: float, by_wheel: float, mean: float, rms: float, high: float
) -> None:
    """Means of 20 000 runs of another program, its step good for 0.6 %; 3 % is 3 standard errors of both."""
    ends = turned(balls, eccentricity, by_wheel)
    size = 1e6 * np.abs(ends.displacements)
    assert ends.moving <= 2
    assert size.mean() == pytest.approx(mean, rel=0.03)
    assert math.sqrt((size**2).mean()) == pytest.approx(rms, rel=0.04)
    assert np.quantile(size, 0.95) == pytest.approx(high, rel=0.06)


@pytest.mark.parametrize("balls", [S100, S150, SlowBalls(2, 1e-4, 20e-3, 5.0, 1.4, 3e-6, 0.3, 600.0)])
def test_friction_holds_every_ball_at_its_end(balls: SlowBalls) -> None:
    """|Im(c e^{−iθ})| ≤ b, with c by the sum of the balls where they stand."""
    undisturbed = np.full(300, 12e-6 + 5e-6j)
    ends = resting_places(balls, undisturbed)
    c = undisturbed - balls.receptance * balls.moment * np.exp(1j * ends.angles).sum(axis=0)
    assert np.abs(c - ends.displacements).max() < 1e-12
    assert np.abs((c * np.exp(-1j * ends.angles)).imag).max() <= balls.band * (1 + 1e-9)


def test_a_quarter_of_the_step_ends_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nearly all runs end at the same place; those at the edge of two basins may not."""
    first = turned(S150, 10e-6, 34e-6, 500).displacements
    monkeypatch.setattr(module, "STEP", module.STEP / 4)
    second = turned(S150, 10e-6, 34e-6, 500).displacements
    apart = np.abs(first - second)
    assert np.median(apart) < 0.03 * S150.band
    assert (apart < 0.3 * S150.band).mean() > 0.95


def test_turning_what_balls_balance_turns_the_displacements() -> None:
    """The law of c depends on T by its direction alone: mean of c/T is the same, though single runs differ."""
    sizes = [
        math.sqrt(
            (np.abs(resting_places(S150, np.full(3000, 30e-6 * np.exp(1j * angle)), 5).displacements) ** 2).mean()
        )
        for angle in (0.0, 1.0)
    ]
    assert sizes[0] == pytest.approx(sizes[1], rel=0.06)


def test_lengths_scale() -> None:
    """Twice the band, the receptance and the displacement: twice c, with the same starts and steps."""
    twice = SlowBalls(4, S150.moment, S150.pitch_radius, 15.0, 1.4, 2 * S150.band, 2 * S150.receptance, S150.speed)
    slower = SlowBalls(
        4, S150.moment, S150.pitch_radius, 15.0 / math.sqrt(2), 1.4, S150.band, S150.receptance,
        S150.speed / math.sqrt(2),
    )  # fmt: skip
    plain = turned(S150, 10e-6, 34e-6, 200).displacements
    assert turned(slower, 10e-6, 34e-6, 200).displacements == pytest.approx(plain, rel=1e-6)
    doubled = SlowBalls(
        4, S150.moment, S150.pitch_radius, 15.0 * math.sqrt(2), 1.4, twice.band, twice.receptance, S150.speed
    )
    assert turned(doubled, 20e-6, 68e-6, 200).displacements == pytest.approx(2 * plain, rel=1e-6)


def test_less_friction_leaves_less() -> None:
    sizes = []
    for share in (1.0, 0.1, 0.01):
        balls = SlowBalls(4, S150.moment, S150.pitch_radius, 15.0, 1.4, share * S150.band, S150.receptance, S150.speed)
        ends = turned(balls, 10e-6, 34e-6, 1000)
        sizes.append(math.sqrt((np.abs(ends.displacements) ** 2).mean()) / balls.band)
    assert sizes == pytest.approx([1.0, 1.0, 1.0], rel=0.3)


def test_the_same_seed_gives_the_same_ends() -> None:
    first, second = (turned(S150, 10e-6, 34e-6, 100, seed=7).displacements for _ in range(2))
    assert (first == second).all()
    assert (turned(S150, 10e-6, 34e-6, 100, seed=8).displacements != first).any()


def test_no_friction_is_refused() -> None:
    with pytest.raises(RangeError):
        resting_places(SlowBalls(4, 1e-4, 26e-3, 15.0, 1.4, 0.0, 0.5, 600.0), np.zeros(5, dtype=complex))


@pytest.mark.slow
def test_heavy_drag_ends_where_less_heavy_drag_ends() -> None:
    """Both creep without swinging, so that the drag sets the time and not the place."""
    sizes = []
    for drag in (300.0, 30_000.0):
        balls = SlowBalls(4, S150.moment, S150.pitch_radius, drag, 1.4, S150.band, S150.receptance, S150.speed)
        ends = turned(balls, 10e-6, 34e-6, 2000)
        assert ends.moving == 0
        sizes.append(math.sqrt((np.abs(ends.displacements) ** 2).mean()))
    assert sizes[0] == pytest.approx(sizes[1], rel=0.03)
