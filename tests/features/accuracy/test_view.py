"""The picture of error against time, the table of points, and the chosen way."""

from abu_calc.features.accuracy.study import AccuracyResult, MeasuredPoint, Reference
from abu_calc.features.accuracy.view import accuracy_blocks, accuracy_extras, picture
from abu_calc.reporting.charts.chart import Plot
from abu_calc.reporting.screen import as_text
from abu_calc.simulation.result import Provenance


def test_each_decade_stands_once_in_the_picture():
    """Nine decades on sixteen rows: no two rows with one label, and the labels fall."""
    points = tuple(point("compiled-dop853", 10.0**-k, 1e-3) for k in range(10))
    labels = [line.split("|")[0].strip() for line in picture(points) if "|" in line]
    decades = [int(label.removeprefix("1e")) for label in labels if label]
    assert decades == list(range(0, -10, -1))


def test_a_picture_of_nothing():
    assert picture((point(None, None, None, "closed-form"),)) == ["no point has an error"]


def point(integrator: str | None, error: float | None, wall_s: float | None, rung: str = "equations") -> MeasuredPoint:
    return MeasuredPoint(
        rung=rung, integrator=integrator, tolerance=1e-3, error=error, evaluations=10, steps=5, wall_s=wall_s,
        cold_s=wall_s, note="" if error else "stiff",
    )  # fmt: skip


def result(*points: MeasuredPoint, skipped: tuple[str, ...] = ()) -> AccuracyResult:
    reference = Reference(
        integrators=("a", "b"), tolerances=(1e-10, 1e-11), disagreement=1e-9, wall_s=1.0, response=None,  # type: ignore[arg-type]
    )  # fmt: skip
    return AccuracyResult(
        title="disc", provenance=Provenance.today(), model=None, scene="scene", quantity="amplitude", accuracy=0.01,
        reference=reference, points=points, chosen=points[0], skipped=skipped,
    )  # type: ignore[arg-type]  # fmt: skip


def test_a_quicker_point_stands_farther_left_and_a_better_one_lower() -> None:
    lines = picture((point("scipy-dop853", 1e-6, 0.5), point("compiled-rk45", 1e-2, 0.005)))
    places = {mark: (row, line.index(mark)) for row, line in enumerate(lines) for mark in "DC" if mark in line[10:]}
    assert places["C"][0] < places["D"][0] and places["C"][1] < places["D"][1]
    assert "d" in "".join(
        picture((point("scipy-dop853", 1e-6, 0.5, "everything"), point("compiled-rk45", 1e-2, 0.005)))
    )


def test_the_report_says_what_was_chosen_and_what_was_not_measured() -> None:
    points = (point("scipy-dop853", 5e-3, 0.0125), point("scipy-bdf", None, None))
    skipped = ("scipy-radau 1e-3", "scipy-radau 1e-4", "envelope")
    text = " ".join(as_text(accuracy_blocks(result(*points, skipped=skipped)), 80).split())
    assert (
        "an error of at most 0.01: equations, scipy-dop853 at tolerance 0.001. Its error is 0.005" in text
        and "12.5 ms" in text
    )
    assert "Not computed by bdf: stiff." in text
    assert "Not measured in the time allowed (--time-budget): radau 1e-3/1e-4; envelope." in text


def test_a_figure_has_a_line_for_each_way() -> None:
    points = (point("scipy-dop853", 1e-3, 0.1), point("scipy-dop853", 1e-5, 0.3), point("scipy-rk45", 1e-3, 0.2))
    (figure,) = accuracy_extras(result(*points)).figures
    assert isinstance(figure.shown, Plot) and figure.shown.limit == (0.01, "asked for 0.01")
    assert {line.name: list(line.points) for line in figure.shown.lines} == {
        "dop853": [(0.1, 1e-3), (0.3, 1e-5)], "rk45": [(0.2, 1e-3)],
    }  # fmt: skip
    assert accuracy_extras(result(point("scipy-bdf", None, None))).figures == ()
