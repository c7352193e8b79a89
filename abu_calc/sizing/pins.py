"""Choices of the search: the envelope, stock sizes, and values that the file has pinned."""

from abu_calc.errors import InputError, Place
from abu_calc.formulas.ball_ring import best_count, half_angle, most_balls
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import greatest_race_radius, least_race_radius, width
from abu_calc.standards.balls import stock_diameter, stock_diameters
from abu_calc.units import from_si, to_si

RADIUS_STEP_MM = 0.5
MOST_BALLS = 64
"""Nobody counts in more; only very large races would hold them."""


def ball_diameters(case: Case) -> tuple[float, ...]:
    """Stock diameters [m] that fit the envelope, or the pinned one; refused when none fits."""
    abu = case.autobalancer
    if abu.ball_diameter_mm is not None:
        return (_pinned_diameter(case, abu.ball_diameter_mm),)
    stock = stock_diameters(abu.ball_sizes)
    fitting = tuple(d for d in stock if _fits_width(case, d) and race_radii(case, d))
    if fitting:
        return fitting
    if abu.race_radius_mm is not None:
        raise impossible("race_radius_mm", abu.race_radius_mm, "no stock ball runs on this race in this envelope")
    smallest = stock[0]
    if not _fits_width(case, smallest):
        least = from_si(width(abu.design, smallest), "mm")
        raise impossible("max_width_mm", abu.max_width_mm, "too narrow for the smallest ball", f"at least {least:.1f}")
    least = 2 * from_si(least_race_radius(abu.design, to_si(abu.bore_diameter_mm, "mm"), smallest), "mm")
    least += abu.max_outer_diameter_mm - 2 * from_si(_greatest(case), "mm")
    raise impossible(
        "max_outer_diameter_mm", abu.max_outer_diameter_mm, "no room for balls round this bore", f"at least {least:.1f}"
    )


def race_radii(case: Case, diameter: float) -> tuple[float, ...]:
    """Race radii [m] to try for one ball: every half millimetre in the envelope and its largest, or the pinned one."""
    abu = case.autobalancer
    least = least_race_radius(abu.design, to_si(abu.bore_diameter_mm, "mm"), diameter)
    greatest = _greatest(case)
    if abu.race_radius_mm is not None:
        pinned = to_si(abu.race_radius_mm, "mm")
        return (pinned,) if least - 1e-9 <= pinned <= greatest + 1e-9 else ()
    if least > greatest:
        return ()
    step = to_si(RADIUS_STEP_MM, "mm")
    first, last = int(least // step) + 1, int(greatest // step)
    return tuple(sorted({*(k * step for k in range(first, last + 1)), greatest}))


def ball_counts(case: Case, diameter: float, race_radius: float) -> range:
    """Counts to try on the largest race: 2 … n*, or the pinned one; refused when that many do not fit."""
    beta = half_angle(diameter / 2, race_radius - diameter / 2)
    count = case.autobalancer.ball_count
    if count is None:
        return range(2, min(MOST_BALLS, max(2, best_count(beta))) + 1)
    if count <= most_balls(beta):
        return range(count, count + 1)
    if case.autobalancer.ball_diameter_mm is None:
        return range(0)
    raise impossible("ball_count", count, "so many do not fit round the race", f"2 … {most_balls(beta)}")


def _greatest(case: Case) -> float:
    abu = case.autobalancer
    return greatest_race_radius(abu.design, to_si(abu.max_outer_diameter_mm, "mm"), to_si(abu.min_wall_mm, "mm"))


def _fits_width(case: Case, diameter: float) -> bool:
    return width(case.autobalancer.design, diameter) <= to_si(case.autobalancer.max_width_mm, "mm") + 1e-9


def _pinned_diameter(case: Case, given_mm: float) -> float:
    """The stock size meant by the pinned one (sources round 19.844 to 19.84), or itself when it is no stock size."""
    abu, given = case.autobalancer, to_si(given_mm, "mm")
    diameter = stock_diameter(given) or given
    if not _fits_width(case, diameter):
        allowed = abu.max_width_mm - from_si(width(abu.design, diameter) - diameter, "mm")
        raise impossible("ball_diameter_mm", given_mm, "wider than the envelope", f"up to {allowed:.1f}")
    if not race_radii(case, diameter):
        least = from_si(least_race_radius(abu.design, to_si(abu.bore_diameter_mm, "mm"), diameter), "mm")
        greatest = from_si(_greatest(case), "mm")
        key = "race_radius_mm" if abu.race_radius_mm is not None else "ball_diameter_mm"
        pinned_mm = given_mm if abu.race_radius_mm is None else abu.race_radius_mm
        allowed_text = f"race radius {least:.2f} … {greatest:.2f}" if least <= greatest else "a smaller ball"
        raise impossible(key, pinned_mm, "hub, ball and wall do not fit one inside the other", allowed_text)
    return diameter


def impossible(key: str, given: float, message: str, allowed: str | None = None) -> InputError:
    """The error that refuses a choice that no geometry allows."""
    return InputError(
        f"geometrically impossible: {message}",
        place=Place(key=f"autobalancer.{key}"),
        found=f"{given:g}",
        allowed=allowed,
        remedy="Change it, or widen autobalancer.max_outer_diameter_mm or max_width_mm.",
    )
