"""Largest displacement at which dry rolling friction can hold the axis, over all ball arrangements.

Dry rolling friction of balls that gravity shakes once in a revolution, on a horizontal spindle.
"""

import math
from itertools import pairwise
from typing import TYPE_CHECKING, Final

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import GRAVITY


@formula(
    "Largest spindle displacement at which dry rolling friction can hold every ball in its place",
    "(k_r·R_p/r)/cos(γ_g/2)",
    "m",
    shown="um",
    signs="w θ",
    where=(
        "For every ball |Im(w e^{−iθ})| ≤ k_r·R_p/r holds, so |w| is at most this displacement. γ_g is taken modulo "
        "180°. For two balls at ±θ the displacement is (k_r·R_p/r)/min(|sin θ|, |cos θ|). It is infinite if all balls "
        "are in one line."
    ),
    assumed="hard, clean race with k_r 0.5–5 µm, at any speed",
    source="derived; Kladiev 1996 gives no such limit",
)
def friction_band(arm: float, pitch_radius: float, ball_radius: float, angles: tuple[float, ...]) -> float:
    """
    >>> round(1e6 * friction_band(2e-6, 23e-3, 8e-3, (-math.radians(60), math.radians(60))), 2)
    11.5
    """
    if arm == 0:
        return 0.0
    directions = sorted(angle % math.pi for angle in angles)
    gap = max(after - before for before, after in pairwise([*directions, directions[0] + math.pi]))
    in_line = math.pi - gap < 1e-9
    return math.inf if in_line else arm * pitch_radius / ball_radius / math.cos(gap / 2)


if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Reals = NDArray[np.float64]
    Complexes = NDArray[np.complex128]

GRID = 48
"""Displacements tried at first."""
FINER = 96
"""Displacements tried between the two that an end lies between, twice: to 1e-5."""
SWEEPS = 12
"""Rounds in which each ball moves once."""
MOST_CORNERS = 12
"""Beginnings of an arc. With one for each ball the work would grow with the fourth power of their number."""
SLACK, STILL = 1e-9, 1e-6
"""Slack on imbalances in m·R_p; `STILL`: change of them by a round at which the search ends."""


@dataclass(frozen=True)
class WorstFriction:
    """Largest displacement [m] at which the balls can rest, and their angles from the imbalance [rad] there."""

    displacement: float
    angles: tuple[float, ...]


@dataclass(frozen=True)
class _Split:
    """Split of the balls: `near` ones in the displacement's direction, `far` ones in the opposite one.

    Lengths are in bands, imbalances in m·R_p.
    """

    near: int
    far: int
    pull: complex
    imbalance: float


@formula(
    "Largest spindle displacement at which dry rolling friction can hold the balls, over all arrangements",
    "largest w ≥ w_f with u_min(w) ≤ U/(m·R_p) ≤ u_max(w)",
    "m",
    shown="um",
    signs="G",
    where=(
        "At the displacement w each ball rests within arcsin(w_f/w) of the displacement's direction or of the "
        "opposite one. For each split of the balls, u_min and u_max are the least and the largest |w/(G·m·R_p) − Σ of "
        "the balls' directions|. The interval of w that begins at w_f counts. For two balls the interval with one "
        "ball on either side counts, too: 5–10 % of starts end there. Two cases do not count: two balls together "
        "opposite the imbalance (one start in 400), and all balls on the heavy side."
    ),
    assumed="ball contact left out; w small compared with R_p",
    source="derived; confirmed by integration from random starts",
)
def worst_friction(count: int, moment: float, band: float, imbalance: float, receptance: complex) -> WorstFriction:
    """`moment`: m·R_p of one ball, `imbalance`: U that they balance [kg m]; `band`: b [m]; `receptance`: h [1/kg].

    >>> worst = worst_friction(4, 4.084e-3 * 26e-3, 10.4e-6, 300e-6, -1 / 5.6)
    >>> round(1e6 * worst.displacement, 1)
    25.5
    """
    import numpy as np

    worst = WorstFriction(band, ())
    if band == 0:
        return worst
    for far in range(count + 1):
        split = _Split(count - far, far, -band / (receptance * moment), imbalance / moment)
        if count > 2 and worst.angles and not _possible(split, np.array([worst.displacement / band]), every=True)[0]:
            continue  # its interval ends before that of another split
        end = _end(split)
        if end is not None and (end * band > worst.displacement or not worst.angles):
            worst = WorstFriction(end * band, _arrangement(split, end))
    return worst


def _end(split: _Split) -> float | None:
    """End of the interval of displacements that begins at b; None if b is not in it.

    With one ball on either side, the last interval counts.
    """
    import numpy as np

    u, reach = split.imbalance, abs(split.pull)
    narrow = [abs(abs(split.far - split.near) + sign * u) / reach for sign in (-1, 1)]
    most = 1.01 * max((u + split.near + split.far) / reach, 1.0)
    grid = np.array(sorted({*np.geomspace(1.0, most, GRID).tolist(), *(edge for edge in narrow if 1 < edge < most)}))
    first = 0
    if split.near == split.far == 1:
        first = int(max(np.flatnonzero(_possible(split, grid)), default=0))
    inside = _before_impossible(split, grid[first:]) + first
    if inside < first:
        return None
    for _ in range(2):
        grid = np.linspace(grid[inside], grid[inside + 1], FINER)
        inside = max(_before_impossible(split, grid), 0)
    return float(grid[inside])


def _before_impossible(split: _Split, grid: "Reals") -> int:
    """Index before the first displacement that is not possible, each that seems so looked at again."""
    import numpy as np

    seems = np.flatnonzero(~_possible(split, grid))
    return next((int(at) for at in seems if not _possible(split, grid[at : at + 1], every=True)[0]), len(grid) - 1) - 1


def _possible(split: _Split, rho: "Reals", *, every: bool = False) -> "NDArray[np.bool_]":
    """Mask of the displacements at which the balls can carry the imbalance.

    The imbalance then lies between the least and the largest that the balls can carry in their resting places.
    """
    import numpy as np

    possible = np.abs(_carried(split, rho, _farthest(split, rho))) >= split.imbalance - SLACK
    # What all balls together cannot make up for needs no arrangement.
    possible &= abs(split.pull) * rho - split.near - split.far <= split.imbalance + SLACK
    where = np.flatnonzero(possible)
    least = np.abs(_carried(split, rho[where], _nearest(split, rho[where], every=every)))
    possible[where] = least <= split.imbalance + SLACK
    return np.asarray(possible)


def _carried(split: _Split, rho: "Reals", angles: "Reals") -> "Complexes":
    """z = Kd + Σe^{iφ}; balls stand along the last axis of the angles."""
    import numpy as np

    return np.asarray(split.pull * rho + np.exp(1j * angles).sum(axis=-1))


def _farthest(split: _Split, rho: "Reals") -> "Reals":
    """Angles of the balls that carry most: those of an arc together, at one of its corners or along the sum."""
    import numpy as np

    half = np.arcsin(1 / rho)
    corners = np.array([[-1.0], [1.0]]) * half
    near, far = np.repeat(corners, 2, axis=0), np.tile(corners, (2, 1))
    rest = split.pull * rho
    along_near = np.clip(np.angle(rest - split.far * np.exp(1j * corners)), -half, half)
    along_far = np.clip(np.angle(-rest - split.near * np.exp(1j * corners)), -half, half)
    near, far = np.concatenate([near, along_near, corners]), np.concatenate([far, corners, along_far])
    sums = np.abs(rest + split.near * np.exp(1j * near) - split.far * np.exp(1j * far))
    best = sums.argmax(axis=0), np.arange(len(rho))
    return np.repeat(np.stack([near[best], far[best] + np.pi], axis=-1), [split.near, split.far], axis=-1)


def _nearest(split: _Split, rho: "Reals", *, every: bool = True) -> "Reals":
    """Angles of the balls that carry least: each ball in turn moves against the sum of the rest, from every beginning
    or from the best.
    """
    import numpy as np

    half, turns = np.arcsin(1 / rho), np.repeat([1.0, -1.0], [split.near, split.far])
    near, far = _beginnings(split, rho)
    if not every:
        total = split.pull * rho + np.exp(1j * near).sum(axis=-1) - np.exp(1j * far).sum(axis=-1)
        best = np.abs(total).argmin(axis=0), np.arange(len(rho))
        near, far = near[best][None], far[best][None]
    units = np.concatenate([np.exp(1j * near), -np.exp(1j * far)], axis=-1)
    total = split.pull * rho + units.sum(axis=-1)
    for _ in range(SWEEPS):
        before = total
        for ball, turn in enumerate(turns):
            rest = total - units[..., ball]
            units[..., ball] = turn * np.exp(1j * np.clip(np.angle(-turn * rest), -half, half))
            total = rest + units[..., ball]
        if np.abs(total - before).max(initial=0.0) < STILL:
            break
    least = units[np.abs(total).argmin(axis=0), np.arange(len(rho))]
    return np.asarray(np.angle(turns * least) + np.where(turns > 0, 0.0, np.pi))


def _beginnings(split: _Split, rho: "Reals") -> "tuple[Reals, Reals]":
    """Angles of either group within its arc: each at the corners in all ways, or against such a sum of the other."""
    import numpy as np

    half, pull = np.arcsin(1 / rho), split.pull * rho
    near, far = _at_corners(split.near, half), _at_corners(split.far, half)
    far_against = _against(pull + np.exp(1j * near).sum(axis=-1), split.far, half)
    near_against = _against(np.exp(1j * far).sum(axis=-1) - pull, split.near, half)
    both = np.repeat(near, len(far), axis=0), np.tile(far, (len(near), 1, 1))
    return np.concatenate([both[0], near, near_against]), np.concatenate([both[1], far_against, far])


def _against(pulled: "Complexes", balls: int, half: "Reals") -> "Reals":
    """Balls in the direction of what they are to cancel, fanned where together they would be too much."""
    import numpy as np

    odd = balls % 2
    fan = np.arccos(np.clip((np.abs(pulled) - odd) / max(balls - odd, 1), 0.0, 1.0))
    sides = np.array([0.0] * odd + [1.0, -1.0] * (balls // 2))
    return np.asarray(np.clip(np.angle(pulled)[..., None] + fan[..., None] * sides, -half[:, None], half[:, None]))


def _at_corners(balls: int, half: "Reals") -> "Reals":
    """Corner arrangements: n balls at the upper corner of their arc, the rest at the lower one.

    The number n runs from none to all. If there are many balls, some of these numbers stand for the others,
    since each ball moves on from there.
    """
    import numpy as np

    counts = np.array(sorted({*np.linspace(0, balls, min(balls, MOST_CORNERS) + 1).round().tolist()}))
    upper = np.arange(balls) < counts[:, None]
    return np.asarray(np.where(upper, 1.0, -1.0)[:, None, :] * half[:, None])


def _arrangement(split: _Split, end: float) -> tuple[float, ...]:
    """Angles from the imbalance, on the way from the least to the largest sum where it carries the imbalance."""
    import numpy as np

    rho = np.array([end])
    low, high = _nearest(split, rho), _farthest(split, rho)
    for _ in range(60):
        middle = (low + high) / 2
        if abs(_carried(split, rho, middle)[0]) < split.imbalance:
            low = middle
        else:
            high = middle
    turned = high[0] + np.pi - np.angle(_carried(split, rho, high))
    return tuple(((turned + np.pi) % (2 * np.pi) - np.pi).tolist())


@formula(
    "Friction over gravity of a ball in a race that turns about a horizontal axis",
    "k_r·R_p·Ω²/(r·g)",
    "",
    where="Below 1 gravity shakes friction out: no ball stays at rest beside its balanced place.",
    source="derived",
)
def friction_number(lever: float, pitch_radius: float, ball_radius: float, speed: float) -> float:
    """
    >>> round(friction_number(1.5e-6, 23e-3, 7.9375e-3, 607.37), 4)
    0.1635
    """
    return lever * pitch_radius * speed**2 / (ball_radius * GRAVITY)


COUNTED: Final = 0.5
"""Share of gravity that counts. Balls whose friction is near their weight creep so slowly that runs end before they do.

The half also stands for a spindle that is held askew by up to 60°.
"""


@formula(
    "Part of the friction band by which dry friction still holds balls that gravity shakes, on a horizontal spindle",
    "max(w_f − g/(2Ω²), 0)",
    "m",
    shown="um",
    where=(
        "A spindle displacement w pulls a ball along the race with Ω²·Im(w e^{−iθ}). Gravity adds a force of amplitude "
        "g at the rotor's speed. The ball stays at rest through the revolution only if both together never exceed the "
        "friction Ω²·w_f, so gravity takes g/Ω² from the band. Otherwise it slips a little in each revolution, always "
        "the way it is pulled. Near the end of that way balls creep: at constant κ_s the rest falls as "
        "2π·g·J/(4.5·κ_s·Ω·t). So only half of gravity counts here, which also allows for a spindle held askew. The "
        "worst friction case keeps at least the friction of evenly spread balls."
    ),
    assumed="spindle horizontal or up to 60° askew, constant speed",
    source="derived here; safe side chosen by simulations with other equations, friction 0.2 to 4 times gravity",
)
def remaining_band(band: float, speed: float) -> float:
    """`band`: w_f = k_r·R_p/r [m]; the same as w_f·max(1 − 1/(2Λ), 0), Λ the `friction_number`.

    >>> [round(1e6 * remaining_band(band, 607.37), 2) for band in (5.8e-6, 13.4e-6, 40e-6)]
    [0.0, 0.11, 26.71]
    """
    return max(band - COUNTED * GRAVITY / speed**2, 0.0)


@formula(
    "Viscous drag rate equivalent to dry friction that gravity shakes, for slow balls on a horizontal spindle",
    "(2/π)·(k_r/r)·J·R_p·Ω³/g",
    "1/s",
    where="It adds to the drag of the oil while the balls are slow: the end of a decay shows the friction.",
    assumed="a friction number below 1, and balls slower than g/(J·R_p·Ω) in the rotor",
    source="derived by averaging; compared with simulations",
)
def equivalent_drag(
    lever: float, pitch_radius: float, ball_radius: float, speed: float, inertia_factor: float
) -> float:
    """
    >>> round(equivalent_drag(0.5e-6, 23e-3, 7.9375e-3, 607.37, 1.4), 1)
    29.5
    """
    return 2 / math.pi * lever / ball_radius * inertia_factor * pitch_radius * speed**3 / GRAVITY
