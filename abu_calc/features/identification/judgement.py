"""Checks of recorded starts and their fit: what could be given, and what is not as the file says."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from abu_calc.dynamics.scene import Scene
from abu_calc.features.identification.estimate import (
    DECAY,
    end_of,
)
from abu_calc.features.identification.fit import SETS, VAGUE, Estimate, Measured
from abu_calc.foundation.checks import Check, coded

FEWEST: Final = 8
"""Starts, at least."""
TREND: Final = 0.01
"""Probability below which an order of the decays is no chance."""
POOR: Final = 0.025
"""Share of simulated sets that fit worse, below which the fit is poor."""
OFF: Final = 4.0
"""Standard errors by which amplitudes at the start may differ."""
RUN_UP_OFF: Final = 0.15
"""Share by which a run-up may differ from the file's."""


def checks_of(scene: Scene, measured: Measured, estimate: Estimate | None) -> Iterator[Check]:
    """Checks of recorded starts; without an estimate there are too few of them."""
    count, marked = len(measured.starts), measured.reading.marked
    if estimate is None:
        yield coded("ABU1101", "not-done", f"{count} starts were recorded", count, FEWEST)
        return
    yield coded("ABU1101", "pass", f"{count} starts were recorded", count, FEWEST)
    edge = estimate.at_the_edge(marked=marked)
    yield coded("ABU1102", "not-done" if edge else "pass",
        f"At the edge of the range: {', '.join(edge)}" if edge else "All values lie inside",
    )  # fmt: skip
    yield _intervals(estimate)
    mean = complex(np.mean([end_of(track) for track in measured.tracks])) * 1e6
    yield from _of_the_ends(mean, measured.end_error, estimate, marked=marked)
    yield _trend(measured)
    off = abs(estimate.amplitude_off) > OFF and abs(estimate.amplitude_ratio - 1) > 0.05
    ratio = estimate.amplitude_ratio
    yield coded("ABU1105", "warn" if off else "pass", f"The amplitude at the start is {ratio:.2f} times that simulated"
        + (f"; an imbalance {ratio:.2f} times as large, or a mass {1 / ratio:.2f} times, would fit" if off else ""),
    )  # fmt: skip
    yield coded("ABU1107", "warn" if estimate.fits_worse < POOR else "pass",
        f"{estimate.fits_worse:.0%} of {SETS} simulated sets fit worse",
    )  # fmt: skip
    yield _run_up_check(scene, measured)
    odd = estimate.odd_start
    yield coded("ABU1109", "pass" if odd is None else "warn", "All starts lie where simulated ones lie"
        if odd is None
        else f"{measured.starts[odd].file} is unlike the starts simulated with the identified values",
    )  # fmt: skip


def _intervals(estimate: Estimate) -> Check:
    vague = " and ".join(estimate.vague)
    if vague:
        return coded("ABU1110", "not-done", f"Intervals reach farther than a factor of {VAGUE:g}: {vague}")
    return coded("ABU1110", "pass", f"Intervals of drag rate and lever arm are within a factor of {VAGUE:g}")


def _of_the_ends(mean: complex, error: float, estimate: Estimate, *, marked: bool) -> Iterator[Check]:
    if not marked:
        yield coded("ABU1103", "not-done", "There is no mark, so that ends have no direction", requested=False)
        yield coded("ABU1106", "not-done", "There is no mark", requested=False)
        return
    known = estimate.offset_error <= estimate.offset_allowed
    offset = complex(*estimate.best.point[2:])
    if known:
        apart = abs(offset + mean)
        allowed = 3 * error + estimate.offset_error + 1.0
        yield coded("ABU1103", "pass" if apart <= allowed else "warn",
            "Distance of the mean end from the place opposite the eccentricity",
            apart, allowed, unit="µm",
        )  # fmt: skip
    else:
        yield coded("ABU1103", "not-done", "No eccentricity is known")
    yield coded("ABU1106", "pass" if known else "not-done", "Half of the interval of the eccentricity",
        estimate.offset_error, estimate.offset_allowed, unit="µm",
    )  # fmt: skip


def _trend(measured: Measured) -> Check:
    from scipy.stats import spearmanr

    decays = measured.features[:, DECAY]
    rank, chance = spearmanr(np.arange(len(decays)), decays) if np.ptp(decays) else (0.0, 1.0)
    trend = bool(chance < TREND)
    way = "longer" if rank > 0 else "shorter"
    return coded("ABU1104", "warn" if trend else "pass",
        f"The decays get {way} from start to start (rank correlation {rank:.2f})" if trend
        else f"Rank correlation of decay and order {rank:.2f}",
    )  # fmt: skip


def _run_up_check(scene: Scene, measured: Measured) -> Check:
    times = [start.run_up for start in measured.starts if start.run_up is not None]
    if not times:
        return coded("ABU1108", "not-done", "The recordings have no mark during the run-up", requested=False)
    time, given = float(np.median(times)), scene.full_speed
    off = abs(time / given - 1) > RUN_UP_OFF
    return coded("ABU1108", "warn" if off else "pass",
        f"By the mark the run-up takes {time:.3g} s, by the file {given:.3g} s",
        remedy=f"If the recordings begin at the switching-on, repeat with the measured time: --run-up {time:.3g}."
        if off else None,
    )  # fmt: skip
