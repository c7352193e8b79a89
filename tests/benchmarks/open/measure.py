"""Error measure of the open benchmark."""

from collections.abc import Sequence

import numpy as np


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
