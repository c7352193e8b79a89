"""Which stock the balls are chosen from."""

import pytest

from abu_calc.foundation.errors import InputError
from abu_calc.sizing.balls import ball_diameters, candidates, choose
from abu_calc.sizing.case import Case, read_case
from tests.sizing.machines import machine

IMBALANCE = 250e-6


def case(sizes: str | None, **changes: object) -> Case:
    return read_case(machine(autobalancer__ball_sizes=sizes, **changes))


def halves(diameter: float) -> float:
    """How many half millimetres a diameter [m] is."""
    return diameter / 0.5e-3


def test_metric_sizes_are_whole_and_half_millimetres() -> None:
    found = ball_diameters(case("metric"))
    assert len(found) > 15 and all(halves(one) == pytest.approx(round(halves(one)), abs=1e-9) for one in found)


def test_all_sizes_are_those_and_the_inch_sizes() -> None:
    metric, whole = ball_diameters(case("metric")), ball_diameters(case("all"))
    assert set(metric) < set(whole)
    sixty_fourths = [one / 25.4e-3 * 64 for one in set(whole) - set(metric)]
    assert len(sixty_fourths) > 15 and all(one == pytest.approx(round(one), abs=1e-3) for one in sixty_fourths)


def test_without_the_key_the_choice_is_from_all() -> None:
    assert ball_diameters(case(None)) == ball_diameters(case("all"))


@pytest.mark.parametrize("envelope", [56.0, 60.0, 68.0, 80.0])
def test_the_metric_choice_is_the_best_of_the_metric_candidates_among_all(envelope: float) -> None:
    one = case("metric", autobalancer__max_outer_diameter_mm=envelope)
    best, freer = (
        choose(one, IMBALANCE).best,
        choose(case("all", autobalancer__max_outer_diameter_mm=envelope), IMBALANCE),
    )
    assert round(halves(best.ball_diameter)) == pytest.approx(halves(best.ball_diameter), abs=1e-9)
    # What more there is to choose from cannot make the choice heavier.
    assert freer.best.mass <= best.mass + 1e-12
    assert {each.ball_diameter for each in candidates(one, IMBALANCE)} <= set(ball_diameters(one))


def test_a_choice_that_was_an_inch_size_changes() -> None:
    """The straight grinder under load takes 15.875 mm from all stock."""
    loaded = {"grinding": {"contact_stiffness_N_per_m": 4.9e5}, "wheel__runout_mm": 0.09}
    inch, metric = (choose(case(sizes, **loaded), 256e-6).best.ball_diameter for sizes in ("all", "metric"))
    assert inch == pytest.approx(15.875e-3, abs=1e-6) and metric != inch
    assert halves(metric) == pytest.approx(round(halves(metric)), abs=1e-9)


def test_a_pinned_inch_size_stands() -> None:
    assert ball_diameters(case("metric", autobalancer__ball_diameter_mm=15.875)) == (0.015875,)


def test_where_no_ball_fits_the_smallest_is_named_likewise() -> None:
    for sizes in ("metric", "all"):
        with pytest.raises(InputError, match="too narrow for the smallest ball"):
            ball_diameters(case(sizes, autobalancer__max_width_mm=3.0))
