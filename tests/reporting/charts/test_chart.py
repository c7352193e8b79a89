"""What figures are made of, against numbers and places computed anew.

Figures alone: as files, and from Python. They show the result's numbers, alike each time, and name their units.
"""

import math
import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import cast
from xml.etree import ElementTree

import numpy as np
import pytest

import abu_calc
from abu_calc.dynamics.stability.boundaries import boundaries, growth_over
from abu_calc.dynamics.stability.verdict import stability
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import read_machine
from abu_calc.registry import FIGURES, figures_of, known
from abu_calc.reporting.charts.chart import (
    FIELD,
    Axis,
    Bar,
    Bars,
    Cells,
    Curve,
    Figure,
    MarkedPoint,
    Plot,
    alike,
    caught,
    settling,
)
from abu_calc.reporting.charts.matplotlib_charts import colors
from abu_calc.reporting.charts.matplotlib_draw import figure_file
from abu_calc.reporting.drawings.shapes import Drawing
from abu_calc.reporting.page.chart_svg import plot
from abu_calc.simulation.result import Result
from abu_calc.simulation.rotor_view import RotorView
from tests.cli.runner import abu
from tests.dynamics.scenes import dimensionless
from tests.remembered import recalled
from tests.reporting.page.reader import read
from tests.reporting.page.sized import sized


def test_decades_are_even_along_a_logarithmic_axis() -> None:
    axis = Axis.decades("time [s]", [0.003, 40.0])
    assert (axis.low, axis.high) == pytest.approx((1e-3, 1e2))
    assert axis.ticks == pytest.approx([1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0])
    shares = [axis.share(tick) for tick in axis.ticks]
    assert shares == pytest.approx([0.0, 0.2, 0.4, 0.6, 0.8, 1.0])
    assert axis.share(math.sqrt(axis.low * axis.high)) == pytest.approx(0.5)
    many = Axis.decades("error", [3e-16, 0.5]).ticks
    assert len(many) <= 8
    page = read(plot("a", Plot("A", "told", axis, Axis.decades("error", [1e-12, 1.0]))))
    words = [words for tag, words in page.texts if tag == "text"]
    assert {"1e-12", "1", "0.001", "100"} <= set(words)
    assert "0" not in words


def test_axes_alike_have_one_scale() -> None:
    across, up = alike("x", "y", [(3.0, 0.0), (0.0, -2.0)])
    assert (across.high - across.low) / (up.high - up.low) == pytest.approx(FIELD)
    assert across.low <= -3.0 < 3.0 <= across.high
    assert up.low <= -2.0


def test_growth_over_speeds_is_that_of_each_speed() -> None:
    scene = dimensionless(3.0, 0.02, 0.02, 0.2, 0.3, (1.0, 2.5), 100.0)
    speeds = [0.5, 0.9, 1.7, 2.6, 3.0]
    found = growth_over(scene, speeds)
    assert [speed for speed, _ in found] == speeds
    for speed, rate in found:
        alone = stability(replace(scene, speed=speed)).growth_rate
        assert rate == pytest.approx(alone, abs=1e-9)
    edges = boundaries(scene, 0.5, 3.0)
    at_edges = growth_over(scene, [one.speed for one in edges])
    assert edges
    assert [rate for _, rate in at_edges] == pytest.approx([0.0] * len(edges), abs=1e-6)


@pytest.mark.hard
def test_orbits_reach_as_far_as_the_amplitudes_say() -> None:
    from abu_calc.features.grinding.study import grinding

    result = grinding(read_machine("avtovaz-707-222"))
    amplitudes = {"without": result.axis_without, "balls fixed": result.axis_fixed, "with": result.axis}
    for one in result.orbits:
        x, y = (max(map(abs, each)) / 1e3 for each in zip(*one.points_um, strict=True))
        told = result.simulation if one.simulated else amplitudes[one.name]
        assert told is not None
        assert (x, y) == pytest.approx((told.x_amplitude_mm, told.y_amplitude_mm), rel=0.05 if one.simulated else 2e-3)


pytest.importorskip("matplotlib")

NAMES = (
    *("levels", "section", "face", "speeds", "budget", "motion", "settling", "level", "level-loaded", "run-up"),
    *("run-up-amplitude", "candidates", "costs"),
)
SVG = "{http://www.w3.org/2000/svg}"
ODD = Plot(
    "No $x$ math, <b>no</b> elements & no \x1b signs, but a title that goes on, far beyond what a line has room for",
    "told", Axis("time [s]", 0, 1), Axis("a name as long as some names of quantities are, and longer [g·mm]", 0, 1),
    [Curve([(0, 0), (1, 1)], f"$line {k}$", k) for k in range(1, 9)],
    [MarkedPoint(k / 8, 0.5, f"$p{k}", k) for k in range(1, 9)], (0.5, "limit $"), [(-1, 0.2), (0.9, 7), (3, 4)],
)  # fmt: skip
CELLS = Cells("Field", "told", "speed_rpm [rpm]", "mass_kg [kg]", ["1", "2"], ["3", "4", "5"],
              [[0, 1], [2, 3], [4, None]], [(0, "none"), (4, "all"), (None, "not computed")])  # fmt: skip
SPANS = Bars("Spans", "told", Axis("x [µm]", -5, 5), [Bar("$a", 2, "2 µm", 1, -3, (1, 3)), Bar("b", -1, "-1 µm", 2)],
             (0.0, "neither"))  # fmt: skip
DECADES = Plot("Work", "told", Axis.decades("time [s]", [1e-4, 3]), Axis.decades("error", [1e-9, 1]),
               [Curve([(1e-4, 1), (3, 1e-9)])])  # fmt: skip


@cache
def _figures() -> dict[str, Figure]:
    return {one.name: one for one in figures_of(sized())}


def _texts(file: str | bytes) -> list[str]:
    root = ElementTree.fromstring(file)
    return ["".join(one.itertext()).strip() for one in root.iter(f"{SVG}text")]


@pytest.mark.slow
def test_size_has_these_figures_and_the_help_knows_them() -> None:
    assert sized().figures == NAMES
    told = " ".join(abu("size", "--help").out.split())
    assert all(one.name in told for one in FIGURES["size"])
    assert {known("size", name).name for name in (*NAMES, "arm", "oil", "seats-12")} == {
        one.name for one in FIGURES["size"]
    }


@pytest.mark.few(2)
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.slow
def test_svg_is_well_formed_alike_each_time_and_its_texts_are_texts(name: str) -> None:
    one = _figures()[name]
    file = figure_file(one, ".svg")
    assert isinstance(file, str)
    if name == "run-up":
        assert file == figure_file(one, ".svg")
    texts = _texts(file)
    if isinstance(one.shown, Drawing):
        return
    assert one.caption.split(":")[0] in " ".join(file.split())
    assert "<dc:date>" not in file
    axes = [text for text in texts if re.search(r"\[.+\]$", text)]
    assert len(axes) == (1 if isinstance(one.shown, Bars) else 2), texts
    told = set(re.findall(r"#[0-9a-f]{6}", file))
    assert told <= {*(color[:7] for color in colors().values()), "#ffffff", "#000000"}, told
    if isinstance(one.shown, Bars):
        assert {row.text for row in one.shown.rows} | {row.name for row in one.shown.rows} <= set(texts)
    if isinstance(one.shown, Plot):
        assert {line.name for line in one.shown.legend} <= set(texts)


@pytest.mark.parametrize("shown", [ODD, CELLS, SPANS, DECADES], ids=["odd", "cells", "spans", "decades"])
@pytest.mark.slow
def test_whatever_stands_in_a_chart_is_drawn(shown: Plot | Cells | Bars) -> None:
    file = figure_file(Figure("odd", "", shown, "A caption with $, \x00 and <."), ".svg")
    texts = " ".join(_texts(file))
    if shown is ODD:
        assert "$line 8$" in texts
        assert "limit $" in texts
        assert texts.count("not stable") == 2
    if shown is CELLS:
        assert "not computed" in texts
        assert "mass_kg [kg]" in texts
    if shown is DECADES:
        assert {"0.0001", "10", "1e-07"} <= set(_texts(file))


@pytest.mark.slow
def test_figure_from_python_has_the_numbers_of_the_result() -> None:
    result = sized()
    axes = result.figure("settling").axes[0]
    course = max(axes.lines, key=lambda line: len(np.asarray(line.get_xdata())))
    assert result.idle_run is not None
    assert np.asarray(course.get_ydata()) == pytest.approx(result.idle_run.residual_g_mm)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time [s]", "imbalance left [g·mm]")
    speeds = result.figure("speeds").axes[0]
    assert result.measured_after is not None
    points = {tuple(map(float, np.ravel(line.get_data()))) for line in speeds.lines if len(line.get_data()[0]) == 1}
    assert any(y == pytest.approx(result.measured_after.measured_level_db) for _, y in points)
    assert {round(x) for x, y in points if y == result.measured_after.measured_level_db} == {5800}


@pytest.mark.slow
def test_run_up_ends_at_full_speed_with_little_left() -> None:
    shown = _figures()["run-up"].shown
    assert isinstance(shown, Plot)
    speed, left = (dict(line.points) for line in shown.lines)
    assert speed[max(speed)] == pytest.approx(100, abs=0.1)
    assert left[max(left)] < 30 < left[min(left)]
    assert shown.legend[0].name == "speed, of 5800 rpm"


def test_large_imbalances_are_written_as_tables_have_them() -> None:
    """Without powers of ten, which a legend gave beyond 999 g·mm."""
    view = SimpleNamespace(t_s=np.array([0.0, 1.0]), residual_g_mm=np.array([1135.91, 12.0]))
    shown = caught(cast(RotorView, view), np.array([100.0, 5800.0]))
    assert [one.name for one in shown.legend] == ["speed, of 5800 rpm", "imbalance left, of 1136 g·mm"]
    rest = settling(cast(RotorView, view), 12345.6)
    assert rest.summary == "From 1136 g·mm at the start to 12.00 g·mm at 1 s"
    assert rest.limit is not None and rest.limit[1] == "permitted 12350 g·mm"


@pytest.mark.slow
def test_motion_stands_still_as_the_angles_of_the_balls() -> None:
    result = sized()
    assert result.idle_run is not None
    lines = [line for line in result.figure("motion").axes[0].lines if len(line.get_xdata()) > 1]  # type: ignore[arg-type]
    ends = sorted(float(line.get_ydata()[-1]) for line in lines)  # type: ignore[index]
    angles = result.idle_run.ball_angles_deg[:, -1] % 360
    assert ends == pytest.approx(sorted(angles))


@pytest.mark.slow
def test_starts_are_those_of_the_ensemble() -> None:
    result = sized()
    views = result.starts.views
    assert views is result.starts.views
    assert [one.why for one in views[:2]] == ["worst", "typical"]
    assert len(views) <= 12
    ensemble = result.ensemble
    assert ensemble is not None
    times = {(one.start, one.drag_per_s): one.quiet_time_s for one in ensemble.settling_by_start}
    given = {one.start for one in views if one.drag_per_s == result.starts.drag_per_s}
    rated = {start for start, drag in times if drag == result.starts.drag_per_s and "rpm" not in start}
    assert rated < {start for start, _ in times} and rated <= given
    slowest = [one for one in views if not one.why]
    assert [one.quiet_time_s for one in slowest] == [times[one.start, one.drag_per_s] for one in slowest]
    for one in views:
        assert one.view.level_db[-1] == pytest.approx(one.level_db, abs=1.0)
        assert len(one.view.t_s) <= 250
    assert ensemble.level_db.worst == max(one.level_db for one in views)


@pytest.mark.slow
def test_a_name_that_is_not_there_is_refused_with_those_there_are() -> None:
    with pytest.raises(InputError) as refused:
        sized().figure("arm")
    assert "[swing_arm]" in str(refused.value)
    assert "settling" in str(refused.value)
    known = abu_calc.effects(abu_calc.read("avtovaz-707-222"))
    assert known.figures == ()
    with pytest.raises(InputError, match="no figure levels"):
        known.figure("levels")


WRONG: dict[str, tuple[tuple[str, ...], str]] = {
    "no file": (("levels",), "NAME=FILE"),
    "no name": (("=a.svg",), "NAME=FILE"),
    "no name of a file": (("levels=",), "NAME=FILE"),
    "another name": (("level-s=a.svg",), "candidates"),
    "of another command": (("precision=a.svg",), "candidates"),
    "number nought": (("seats-0=a.svg",), "seats-N"),
    "number in words": (("seats-N=a.svg",), "seats-N"),
    "in capitals": (("LEVELS=a.svg",), "levels"),
    "suffix": (("levels=a.jpg",), ".svg .png .pdf"),
    "no suffix": (("levels=a",), ".svg .png .pdf"),
    "no folder": (("levels=none/a.svg",), "folder does not exist"),
    "a folder": (("levels=folder.svg",), "this is a folder"),
    "exists": (("levels=there.svg",), "--force"),
    "exists, second": (("face=a.svg", "levels=there.svg"), "--force"),
    "twice": (("levels=a.svg", "face=./a.svg"), "same file"),
    "as output": (("levels=out.svg",), "same file"),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_cannot_be_written_is_refused_before_anything_is_read(
    case: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("there.svg").write_text("mine")
    Path("folder.svg").mkdir()
    given, part = WRONG[case]
    options = [word for one in given for word in ("--figure", one)]
    seen = abu("size", "no-such-machine", *options, "--output", "out.svg")
    assert seen.status == 2
    assert part in seen.err
    assert "no-such-machine" not in seen.err
    assert sorted(path.name for path in Path().iterdir()) == ["folder.svg", "there.svg"]
    assert Path("there.svg").read_text() == "mine"


def test_commands_without_figures_have_no_such_option() -> None:
    seen = abu("presets", "--figure", "levels=a.svg")
    assert seen.status == 2
    assert "--figure" in seen.err


@pytest.mark.slow
def test_what_can_be_written_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    files = ("--figure", "zones-1=zones.png", "--figure", "interference-1=bars.pdf", "--output", "fit.json")
    asked = ("check-fit", "mmg-3200k-knife-shaft", "--quiet", *files)
    seen = abu(*asked, "--figure", "seats-9=seats.svg")
    assert seen.status == 2
    assert "such a bearing" in seen.err and "zones-1" in seen.err and "The computed result is" in seen.err
    assert "Written is: fit.json, zones.png, bars.pdf." in seen.err
    written = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert set(written) == {"zones.png", "bars.pdf", "fit.json"}
    assert abu(*asked).status == 2
    assert abu(*asked, "--force").status == 1  # as built the outer ring creeps
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == written


def test_nothing_opens_a_window() -> None:
    package = Path(abu_calc.__file__).parent
    assert [
        path for path in package.rglob("*.py") if re.search(r"(import|from).*pyplot", path.read_text("utf-8"))
    ] == []


def _machine(name: str = "msh-230", **values: object) -> abu_calc.Machine:
    return abu_calc.read(name).changed({key.replace("__", "."): value for key, value in values.items()})


STUDIES: dict[str, tuple[Callable[[], Result], set[str]]] = {
    "simulate": (lambda: abu_calc.simulate(_machine(run_up__time_s=0.3), "run-up"), set()),
    "stability": (lambda: abu_calc.stability(_machine(), speeds_rpm=(1000.0, 6000.0)), {"multipliers"}),
    "grinding": (lambda: recalled("grinding", _machine("avtovaz-707-222")), set()),
    "accuracy": (lambda: abu_calc.accuracy(_machine(), budget_s=3.0), set()),
    "balance": (lambda: abu_calc.balance(abu_calc.read_readings("sapropel-screw-rig")), set()),
    "compare": (lambda: abu_calc.compare([_machine(), _machine(wheel__mass_kg=0.6)]), set()),
    "sweep": (lambda: abu_calc.sweep(_machine(), ["wheel.mass_kg=0.5,0.6"], 4), set()),
    "check-fit": (lambda: abu_calc.check_fit(_machine("mmg-3200k-knife-shaft")), set()),
}
"""Of each command a result, and what it has not."""


@pytest.mark.slow
@pytest.mark.parametrize("command", STUDIES)
def test_every_command_knows_the_names_of_its_figures(command: str) -> None:
    study, absent = STUDIES[command]
    result = study()
    assert result.figures
    kinds = {known(command, name).name for name in result.figures}
    assert not kinds & absent
    for name in result.figures:
        assert len(result.figure(name).axes) == 1
    always = {one.name for one in FIGURES[command] if not one.when}
    assert always <= kinds
