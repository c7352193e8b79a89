"""Errors of an answer against the scatter of spoilt data; shares of a correction."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from abu_calc.features.balancing.errors import changes, placing, radial
from abu_calc.features.balancing.formulas import (
    RollOnRig,
)
from abu_calc.features.balancing.methods import solved
from abu_calc.features.balancing.run_tables import Errors
from abu_calc.features.balancing.runs import Balancing
from tests.cli.runner import abu
from tests.features.balancing.rig import BARE_ROTOR, Workshop, trial, written
from tests.features.balancing.test_methods import ROLL, run_of

NO_ERRORS = Errors(**dict.fromkeys(Errors.model_fields, 0.0))


SIGMA = Errors(
    amplitude_percent=1.0, phase_deg=1.0, speed_percent=0.1, support_mass_percent=2.0, stiffness_percent=2.0,
    damping_ratio=0.0, rotor_mass_percent=0.5, inertia_percent=2.0, length_mm=1.0, placed_mass_percent=1.0,
    placed_angle_deg=1.0, coefficient_percent=0.0,
)  # fmt: skip


def spoilt(roll: RollOnRig, rng: np.random.Generator) -> RollOnRig:
    """The rig's data, each off by its error."""
    n = iter(rng.standard_normal(20))
    relative = {"M1": 0.02, "M2": 0.02, "C1": 0.02, "C2": 0.02, "M3": 0.005, "J3": 0.02}
    moved = {key: getattr(roll, key) * (1 + s * next(n)) for key, s in relative.items()}
    return replace(roll, **moved, **{key: getattr(roll, key) + 0.001 * next(n) for key in "abcd"})


@pytest.mark.slow
@pytest.mark.parametrize("rpm", [1300.0, 3000.0])
def test_uncertainties_are_the_scatter_of_spoilt_readings_and_rigs(rpm: float) -> None:
    shop = Workshop(speed_rpm=rpm)
    case = Balancing(ROLL, (run_of(shop),))
    by = changes(case, "rig data", SIGMA)
    Q = solved(case, "rig data").imbalance
    rng, answers = np.random.default_rng(5), []
    for _ in range(2000):
        run = case.runs[0]
        run = replace(
            run, speed=run.speed * (1 + 0.001 * rng.standard_normal()),
            amplitudes=tuple(a * (1 + 0.01 * rng.standard_normal()) for a in run.amplitudes),
            phases=tuple(p + math.radians(1) * rng.standard_normal() for p in run.phases),
        )  # fmt: skip
        answers.append(solved(Balancing(spoilt(ROLL, rng), (run,)), "rig data").imbalance)
    for plane in (0, 1):
        values = np.array([pair[plane] for pair in answers])
        sizes = np.std(np.abs(values))
        angles = np.std(np.angle(values / Q[plane]))
        deltas = [change.imbalance[plane] for change in by]
        assert radial(Q[plane], deltas) == pytest.approx(sizes, rel=0.08)
        across = math.sqrt(sum((d / Q[plane]).imag ** 2 for d in deltas))
        assert across == pytest.approx(angles, rel=0.08)


def test_without_errors_nothing_is_unsure() -> None:
    case = Balancing(ROLL, (run_of(Workshop()),))
    assert all(abs(part) == 0 for change in changes(case, "rig data", NO_ERRORS) for part in change.imbalance)
    assert all(abs(part) == 0 for pair in placing(((1j,), (1.0,)), NO_ERRORS) for part in pair)


def test_masses_that_nearly_cancel_leave_the_errors_of_both() -> None:
    """500 g at 89.4° on either side make 10 g: one percent of each is 5 g, not 0.1 g."""
    sigma = NO_ERRORS.model_copy(update={"placed_mass_percent": 1.0})
    one = 0.5 * np.exp(1j * math.acos(0.01))
    left = placing(((one, one.conjugate()),), sigma)
    assert abs(2 * one.real - 0.010) < 1e-12
    assert math.sqrt(sum(abs(plane[0]) ** 2 for plane in left)) == pytest.approx(0.005 * math.sqrt(2))


@pytest.mark.parametrize("other_rpm", [3029.5, 2970.5])
def test_an_error_of_the_speed_changes_no_set_of_runs(tmp_path: Path, other_rpm: float) -> None:
    """Speeds that differ by nearly 1 % are one set; errors of the speed may not part it."""
    shop = Workshop()
    runs = [shop.run(), *(shop.put_on(k, 20.0, 0.0).run(trial(k, 20.0, 0.0)) for k in (0, 1))]
    runs[1] = runs[1].replace("3000.0", str(other_rpm))
    for errors in ("", "[errors]\nspeed_percent = 3.0\n"):
        seen = abu("balance", written(tmp_path, BARE_ROTOR, *runs, errors), "--json")
        assert seen.status in (0, 1) and seen.document["result"]["left"]["mass_g"] == pytest.approx(12, rel=0.1)
