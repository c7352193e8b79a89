"""How far dry rolling friction can hold the axis at most, over all arrangements of the balls."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from abu_calc.formula import formula

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Reals = NDArray[np.float64]
    Complexes = NDArray[np.complex128]

GRID = 48
"""Displacements tried at first."""
FINER = 24
"""Displacements tried between the two that an end lies between, thrice: to 1e-5."""
SWEEPS = 12
"""Rounds in which each ball moves once."""
SLACK = 1e-9


@dataclass(frozen=True)
class WorstFriction:
    """Largest displacement [m] at which the balls can rest, and their angles from the imbalance [rad] there."""

    displacement: float
    angles: tuple[float, ...]


@dataclass(frozen=True)
class _Split:
    """So many balls near the displacement's direction, so many opposite; lengths in bands, imbalances in m·R_p."""

    near: int
    far: int
    pull: complex
    imbalance: float


@formula(
    "Largest displacement at which dry rolling friction can hold the balls in any arrangement",
    "largest ρ ≥ b with L(ρ) ≤ u ≤ H(ρ)",
    "m",
    where=(
        "b = k_r·R_p/r. At the displacement ρ each ball rests within arcsin(b/ρ) of the displacement's direction or of "
        "the opposite one; for each split of the balls L and H are the least and the largest |Kρ + Σe^{iφ}|, K = "
        "−1/(h·m·R_p), h = Ω²/(k − MΩ² + icΩ), u = U/(m·R_p). Counted is the interval of ρ that begins at b; of two "
        "balls also the one with a ball on either side, where 5–10 % of starts end. Not counted: two balls bunched "
        "opposite the imbalance (one start in 400), and all on the heavy side."
    ),
    assumed="ball contact left out; ρ small against R_p",
    source="derived; confirmed by integration from random starts",
)
def worst_friction(count: int, moment: float, band: float, imbalance: float, receptance: complex) -> WorstFriction:
    """`moment`: m·R_p of one ball, `imbalance`: U that they balance [kg m]; `band`: b [m]; `receptance`: h [1/kg].

    >>> worst = worst_friction(4, 4.084e-3 * 26e-3, 10.4e-6, 300e-6, -1 / 5.6)
    >>> round(1e6 * worst.displacement, 1)
    25.9
    """
    import numpy as np

    found = WorstFriction(band, ())
    if band == 0:
        return found
    for far in range(count + 1):
        split = _Split(count - far, far, -band / (receptance * moment), imbalance / moment)
        if count > 2 and found.angles and not _possible(split, np.array([found.displacement / band]))[0]:
            continue  # its interval ends before that of another split
        end = _end(split)
        if end is not None and (end * band > found.displacement or not found.angles):
            found = WorstFriction(end * band, _arrangement(split, end))
    return found


def _end(split: _Split) -> float | None:
    """Where the interval that begins at b ends, of one ball on either side the last one; None: b is not in it."""
    import numpy as np

    u, reach, last_one = split.imbalance, abs(split.pull), split.near == split.far == 1
    narrow = [abs(abs(split.far - split.near) + sign * u) / reach for sign in (-1, 1)]
    most = 1.01 * max((u + split.near + split.far) / reach, 1.0)
    grid = np.unique([*np.geomspace(1.0, most, GRID), *(one for one in narrow if 1 < one < most)])
    possible = _possible(split, grid)
    if not (possible.any() if last_one else possible[0]):
        return None
    inside = int(np.flatnonzero(possible)[-1] if last_one else np.argmin(possible) - 1)
    for _ in range(3):
        grid = np.linspace(grid[inside], grid[inside + 1], FINER)
        inside = int(np.argmin(_possible(split, grid)) - 1)
    return float(grid[inside])


def _possible(split: _Split, rho: "Reals") -> "NDArray[np.bool_]":
    """Whether the imbalance lies between the least and the largest that the balls can carry where they rest."""
    import numpy as np

    possible = np.abs(_carried(split, rho, _farthest(split, rho))) >= split.imbalance - SLACK
    where = np.flatnonzero(possible)
    least = np.abs(_carried(split, rho[where], _nearest(split, rho[where])))
    possible[where] = least <= split.imbalance + SLACK
    return np.asarray(possible)


def _carried(split: _Split, rho: "Reals", angles: "Reals") -> "Complexes":
    """z = Kρ + Σe^{iφ}; balls stand along the last axis of the angles."""
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


def _nearest(split: _Split, rho: "Reals") -> "Reals":
    """Angles of the balls that carry least: from the best beginning each in turn moves against the sum of the rest."""
    import numpy as np

    half, pull = np.arcsin(1 / rho), split.pull * rho
    middles = np.repeat([0.0, np.pi], [split.near, split.far])
    near, far = _at_corners(split.near, half), _at_corners(split.far, half)

    def opposed(rest: "Complexes", balls: int) -> "Reals":
        return np.repeat(np.clip(np.angle(-rest), -half, half)[..., None], balls, axis=-1)

    def sums(angles: "Reals") -> "Complexes":
        return np.asarray(np.exp(1j * angles).sum(axis=-1))

    cornered = np.stack([np.concatenate([one, other], axis=-1) for one in near for other in far])
    far_along = np.concatenate([near, opposed(-(pull + sums(near)), split.far)], axis=-1)
    near_along = np.concatenate([opposed(pull - sums(far), split.near), far], axis=-1)
    beginnings = middles + np.concatenate([cornered, far_along, near_along])
    best = np.abs(_carried(split, rho, beginnings)).argmin(axis=0)
    angles: Reals = beginnings[best, np.arange(len(rho))]
    total = _carried(split, rho, angles)
    for _ in range(SWEEPS):
        before = total
        for ball, middle in enumerate(middles):
            rest = total - np.exp(1j * angles[:, ball])
            turned = np.angle(-rest * np.exp(-1j * middle))
            angles[:, ball] = middle + np.clip(turned, -half, half)
            total = rest + np.exp(1j * angles[:, ball])
        if np.abs(total - before).max(initial=0.0) < SLACK:
            break
    return angles


def _at_corners(balls: int, half: "Reals") -> "Reals":
    """So many balls at the upper corner of their arc, the rest at the lower one, for none to all."""
    import numpy as np

    upper = np.arange(balls) < np.arange(balls + 1)[:, None]
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
