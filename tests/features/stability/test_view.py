"""The report of stability: verdict, boundaries, eigenvalues as figures, forbidden speeds."""

from dataclasses import replace
from pathlib import Path

import pytest

import abu_calc
from abu_calc.dynamics.stability.boundaries import StabilityBoundary
from abu_calc.features.stability.study import GrowthAt, Hanging, HangingBound, StabilityResult
from abu_calc.features.stability.view import (
    _forbidden,
    hanging_word,
    stability_blocks,
    stability_extras,
    stability_screen,
)
from abu_calc.foundation.units import to_si
from abu_calc.reporting.charts.chart import Plot
from abu_calc.reporting.screen import as_text
from tests.inputs.scenes import SCENE


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> StabilityResult:
    file = Path(tmp_path_factory.mktemp("scene")) / "scene.toml"
    file.write_text(SCENE, encoding="utf-8")
    return abu_calc.stability(abu_calc.read_scene(file))


def course(*rates: float) -> tuple[GrowthAt, ...]:
    """At 100, 200, … rpm."""
    return tuple(GrowthAt(speed=to_si(100.0 * k, "rpm"), growth_rate=rate) for k, rate in enumerate(rates, 1))


def edges(*pairs: tuple[float, bool]) -> tuple[StabilityBoundary, ...]:
    return tuple(StabilityBoundary(speed=to_si(speed, "rpm"), stable_above=above) for speed, above in pairs)


@pytest.mark.parametrize(
    ("rates", "limits", "bands"),
    [
        ((1.0, -1.0, -1.0, 1.0), edges((150.0, True), (350.0, False)), [(100.0, 150.0), (350.0, 400.0)]),
        ((-1.0, 1.0, -1.0), edges((150.0, False), (250.0, True)), [(150.0, 250.0)]),
        ((1.0, 1.0), (), [(100.0, 200.0)]),
        ((-1.0, -1.0), (), []),
    ],
)
def test_speeds_between_boundaries_that_are_not_stable_are_shaded(
    result: StabilityResult, rates: tuple[float, ...], limits: tuple[StabilityBoundary, ...], bands: list[object]
) -> None:
    known = replace(result, boundaries_rpm=limits, growth_by_speed=course(*rates))
    assert _forbidden(course(*rates), known) == bands
    figures = {figure.name: figure.shown for figure in stability_extras(known).figures}
    growth = figures["growth"]
    assert isinstance(growth, Plot) and list(growth.bands) == bands
    assert sum(point.series == 2 for point in growth.points) == len(limits)


def test_eigenvalues_are_drawn_beside_the_edge_of_stability(result: StabilityResult) -> None:
    figures = {figure.name: figure.shown for figure in stability_extras(result).figures}
    assert set(figures) == {"eigenvalues"}  # no speeds were asked for, and there are no multipliers
    plot = figures["eigenvalues"]
    assert isinstance(plot, Plot) and [(point.x, point.y) for point in plot.points] == list(result.eigenvalues or ())
    assert all(x == 0.0 for x, _ in plot.lines[0].points)
    multipliers = replace(result, eigenvalues=None, floquet_multipliers=((0.5, 0.2), (0.5, -0.2)))
    (circle,) = stability_extras(multipliers).figures
    assert isinstance(circle.shown, Plot)
    assert all(x**2 + y**2 == pytest.approx(1.0) for x, y in circle.shown.lines[0].points)


@pytest.mark.parametrize(
    ("stable", "word"), [(True, "STABLE at"), (False, "NOT STABLE at"), (None, "NOT EVALUATED at")]
)
def test_the_verdict_comes_first(result: StabilityResult, stable: bool | None, word: str) -> None:
    lines = as_text(stability_screen(replace(result, stable=stable)), 80).splitlines()
    assert lines[1].strip().startswith(word) and len(lines) <= 48


def test_boundaries_are_listed_or_said_to_be_none(result: StabilityResult) -> None:
    def text(**changes: object) -> str:
        return " ".join(as_text(stability_blocks(replace(result, **changes)), 80).split())  # type: ignore[arg-type]

    assert "Not searched. `--speeds LOW:HIGH` finds them." in text()
    assert "None from 5 to 50 rpm." in text(boundaries_rpm=(), searched=(to_si(5.0, "rpm"), to_si(50.0, "rpm")))
    both = text(boundaries_rpm=edges((9.0, True), (12.0, False)), searched=(to_si(5.0, "rpm"), to_si(50.0, "rpm")))
    assert "9.00000 stable 12.0000 not stable" in both


def test_balls_may_hang_where_a_bound_is_not_passed() -> None:
    bound = HangingBound(state="at a resonance", drag=20.0, margin=0.5)
    doubt = Hanging(drag=10.0, hanging_drag=20.0, doubt=True, bounds=(bound,))
    assert hanging_word(doubt).startswith("Balls may stall: the viscous drag rate, 10.0 1/s, is not above")
    assert hanging_word(replace(doubt, doubt=False)).startswith(
        "No ball stalls: the viscous drag rate, 10.0 1/s, is above"
    )
