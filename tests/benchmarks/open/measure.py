"""Error measure of the open benchmark.

Places and angles are continuous where modes change, so they are compared at all times; rates jump at impacts and are
compared nowhere. Events are compared in their order: kind, ball, time.
"""

import math
from collections.abc import Sequence
from typing import Any, Final

import numpy as np

LOST: Final = 1e-3
"""Error of a ball [rad] from which on a program has lost the motion."""


def errors(states: Sequence[Sequence[float]], reference: Sequence[Sequence[float]], balls: int) -> tuple[float, float]:
    """Largest error of the axis over its largest displacement, and of the ball angles on the circle [rad]."""
    found, wanted = np.array(states, dtype=float), np.array(reference, dtype=float)
    if found.shape != wanted.shape:
        raise ValueError(f"states of shape {found.shape}, not {wanted.shape}")
    if not np.isfinite(found).all():
        return np.inf, np.inf
    axis = np.hypot(*(found - wanted)[:, :2].T).max() / np.hypot(*wanted[:, :2].T).max()
    angles = np.angle(np.exp(1j * (found - wanted)[:, 2 : 2 + balls]))
    return float(axis), float(np.abs(angles).max(initial=0.0))


def followed(
    states: Sequence[Sequence[float]], reference: Sequence[Sequence[float]], times: Sequence[float], balls: int
) -> float:
    """Last time [s] up to which all balls are within `LOST` of the reference."""
    found, wanted = np.array(states, dtype=float), np.array(reference, dtype=float)
    apart = np.abs(np.angle(np.exp(1j * (found - wanted)[:, 2 : 2 + balls]))).max(axis=1, initial=0.0)
    lost = np.flatnonzero(~(apart <= LOST))
    return times[-1] if not len(lost) else times[lost[0] - 1] if lost[0] else math.nan


def event_errors(
    events: Sequence[Sequence[Any]], reference: Sequence[Sequence[Any]], speed: float
) -> tuple[int, float]:
    """Events [time, kind, ball] missed, added or out of order, and the largest error in time in revolutions.

    The times are those of the events before the first difference.
    """
    alike = 0
    for mine, wanted in zip(events, reference, strict=False):
        if list(mine[1:]) != list(wanted[1:]):
            break
        alike += 1
    late = (abs(mine[0] - wanted[0]) for mine, wanted in zip(events[:alike], reference[:alike], strict=True))
    return max(len(events), len(reference)) - alike, max(late, default=0.0) * abs(speed) / math.tau
