"""Actions on seats, followed: the check gets the grade and the number that it tells, and no other check gets worse."""

import re
from random import Random
from typing import Any

import pytest

from abu_calc.features.seats.advice import with_entries
from abu_calc.features.seats.lookup import from_table
from abu_calc.features.seats.seats import judge
from abu_calc.foundation.checks import RANK
from tests.features.seats.samples import by_designation

BEARINGS = ("6203", "6206", "6304", "608", "NU206", "7206B", "30206", "22208")
COUNT = 60


def drawn(seed: int) -> dict[str, Any]:
    """A bearing with seats and load at random."""
    rng = Random(seed)
    angular = BEARINGS[seed % len(BEARINGS)].endswith("B")
    return {
        "designation": BEARINGS[seed % len(BEARINGS)], "radial_load_kN": round(10 ** rng.uniform(-1, 1), 3),
        "shaft_fit": rng.choice(("g6", "h6", "js6", "k6", "m6", "p6")),
        "housing_fit": rng.choice(("G7", "H7", "J7", "K7", "N7")),
        "internal_clearance": rng.choice(("CA", "CB", "CC", "GA") if angular else ("C2", "CN", "C3")),
        "outer_ring_load": rng.choice(("stationary", "rotating")),
    }  # fmt: skip


@pytest.mark.parametrize("seed", range(COUNT))
def test_every_action_holds_when_followed(seed: int) -> None:
    bearing = from_table(by_designation(**drawn(seed)))
    found = judge(bearing)
    ranks = {check.code: RANK.index(check.status) for check in found.checks}
    for code, action in found.actions.items():
        after = judge(with_entries(bearing, dict(entry.split("=") for entry in action.overrides)))
        now = {check.code: check for check in after.checks}
        if not action.overrides:
            assert "no class suits all checks" in action.text
            continue
        worse = [each for each, check in now.items() if check.requested and RANK.index(check.status) < ranks[each]]
        assert not worse, action.text
        told = "pass" if f"Then {code} passes." in action.text else "warn" if "still warns." in action.text else "fail"
        assert now[code].status == told, action.text
        number = re.search(r" to ([-\d.]+) (?:µm|%|N)", action.text)
        if number and "under" not in action.text:
            assert float(number[1]) == pytest.approx(now[code].value, rel=6e-3, abs=6e-3), action.text
