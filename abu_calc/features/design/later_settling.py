"""The action on the idle level, tried on the quiet time: where it breaks that limit, the action says so."""

import math
from dataclasses import replace

from abu_calc.features.design.data_gaps import quiet_time_with
from abu_calc.features.design.verification import Proven
from abu_calc.foundation.checks import Check


def with_later_settling(check: Check, tried: Proven, accuracy: float) -> Check:
    """A check whose action names the limit of the quiet time if its entries break that; else the check itself.

    The start cases that are slowest today are simulated with the entries. At the given drag rate ABU702 fails by a late
    one; in hot or cold oil it warns. One that is late today is no news.
    """
    ensemble, limit = tried.ensemble, tried.design.case.table.limits.longest_quiet_time
    if ensemble is None or check.remedy is None or not check.overrides:
        return check
    entries = {key: float(value) for key, _, value in (entry.partition("=") for entry in check.overrides)
               if key in MOVING}  # fmt: skip
    others = [outcome for outcome in ensemble.outcomes if outcome not in ensemble.given]
    for outcomes, grade in ((ensemble.given, "fails"), (others, "warns")):
        slowest = max(outcomes, key=lambda outcome: outcome.quiet_time_or_inf, default=None)
        if not entries or slowest is None or slowest.quiet_time_or_inf > limit:
            continue
        time = quiet_time_with(tried.design, slowest, entries, accuracy)
        if time > limit:
            late, code = f"is quiet after {time:.3g} s (limit {limit:g} s, simulated)", "ABU702"
            if math.isinf(time):
                late = "is never quiet (simulated)"
            text = f'{code} then {grade}: start case "{slowest.member.name}" {late}.'
            return replace(check, remedy=f"{check.remedy} {text}")
    return check


MOVING = ("autobalancer.race_eccentricity_mm", "autobalancer.rolling_friction_mm")
"""Entries of the actions on the idle level that move the quiet time."""
