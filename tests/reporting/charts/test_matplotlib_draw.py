"""Figures as files: titles without dates, drawings as large as on paper."""

import importlib.util
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from abu_calc.foundation.errors import OutputError
from abu_calc.registry import figures_of
from abu_calc.reporting.charts.chart import Figure
from abu_calc.reporting.charts.matplotlib_draw import figure_file
from abu_calc.reporting.drawings.shapes import Drawing
from tests.cli.runner import abu
from tests.reporting.page.sized import sized


@cache
def _figures() -> dict[str, Figure]:
    return {one.name: one for one in figures_of(sized())}


@pytest.mark.few(1)
@pytest.mark.parametrize(
    ("name", "suffix", "begins"),
    [("settling", ".png", b"\x89PNG"), ("costs", ".pdf", b"%PDF"), ("section", ".pdf", b"%PDF")],
)
def test_png_and_pdf_have_a_title_and_no_date(name: str, suffix: str, begins: bytes) -> None:
    one = _figures()[name]
    file = figure_file(one, suffix)
    assert isinstance(file, bytes)
    assert file.startswith(begins)
    assert one.shown.title.encode() in file  # type: ignore[union-attr]
    assert b"CreationDate" not in file


@pytest.mark.slow
def test_drawing_is_as_large_as_on_paper() -> None:
    shown = _figures()["section"].shown
    assert isinstance(shown, Drawing)
    wide, high = sized().figure("section").get_size_inches()
    assert (25.4 * wide, 25.4 * high) == pytest.approx(shown.size)


@pytest.mark.slow
def test_missing_matplotlib_is_named_with_what_installs_it(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    found: Callable[[str], object] = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "matplotlib" else found(name))
    asked = ("check-fit", "mmg-3200k-knife-shaft", "--quiet", "--figure")
    seen = abu(*asked, f"interference-1={tmp_path / 'a.svg'}")
    assert seen.status == 2
    assert "matplotlib" in seen.err and 'pip install "abu-calc[report]"' in seen.err
    assert abu(*asked, f"seats-1={tmp_path / 'b.svg'}").status == 1
    with pytest.raises(OutputError, match="matplotlib"):
        sized().figure("levels")
