"""Entries of features: each names modules, results and figures that are there."""

import pytest

from abu_calc.cli.command import Command
from abu_calc.foundation.errors import InputError
from abu_calc.registry import BY_NAME, FEATURES, FIGURES, VIEWS, Feature, Known, Views, absent, imported, known, named
from tests.rows import for_each


@for_each(FEATURES)
def test_a_feature_declares_its_command(feature: Feature) -> None:
    assert isinstance(imported(feature.command), Command)


@for_each(VIEWS.values())
def test_all_that_shows_a_result_is_there(views: Views) -> None:
    result, screen = imported(views.result), views.screen or f"{views.view}_screen"
    assert isinstance(result, type) and bool(views.extras) == (result.command in FIGURES)
    makers = (f"{views.view}_blocks", screen, views.extras, views.note, views.drawings, views.solids)
    assert all(callable(imported(path)) for path in makers if path)


def test_names_of_features_and_of_their_figures_differ() -> None:
    assert len(BY_NAME) == len(FEATURES)
    assert BY_NAME.keys() >= FIGURES.keys()
    for figures in FIGURES.values():
        assert len({entry.name for entry in figures}) == len(figures)


@pytest.mark.parametrize(("pattern", "name", "fits"), [
    ("seats-N", "seats-1", True), ("seats-N", "seats-12", True), ("seats-N", "seats-0", False),
    ("seats-N", "seats-N", False), ("seats-N", "seats-1x", False), ("level", "level-loaded", False),
    ("decides-QUANTITY", "decides-fits[0].level_db", True), ("decides-QUANTITY", "decides-", False),
    ("decides-QUANTITY", "decides-a b", False),
])  # fmt: skip
def test_a_name_stands_for_a_number_or_a_word(pattern: str, name: str, fits: bool) -> None:
    assert Known(pattern).fits(name) is fits


def test_a_figure_that_no_result_has_is_refused_with_those_there_are() -> None:
    with pytest.raises(InputError) as refused:
        known("accuracy", "orbit")
    error = refused.value
    assert (error.place.key, error.found, error.allowed) == ("--figure", "orbit", "precision")


def test_a_figure_that_this_result_lacks_is_told_with_the_reason() -> None:
    when = known("grinding", "hodograph").when
    assert when and when in str(absent("grinding", "hodograph", ["orbit"]))
    with pytest.raises(InputError, match="allowed: none"):
        named("grinding", [], "hodograph")
