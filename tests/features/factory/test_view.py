"""The factory's table: cells, spans, degrees of freedom, and the sentence that lists the misses."""

from abu_calc.features.factory.measurements import ValueSource
from abu_calc.features.factory.study import FactoryLevel, FactoryResult, FittedValues, SoftRaceLevel
from abu_calc.features.factory.view import factory_blocks, factory_screen
from abu_calc.reporting.blocks import Grid
from abu_calc.reporting.screen import as_text
from abu_calc.simulation.result import Provenance

EMPTY = dict.fromkeys(
    ("without_measured_db", "without_predicted_db", "with_measured_db", "with_predicted_db", "with_predicted_worst_db",
     "lowered_measured_db", "lowered_predicted_db", "miss_db",
     "difference_db", "at_handles_db", "at_handles_miss_db", "not_comparable", "degrees_of_freedom_spent",
     "louder_octave_hz", "louder_octave_db", "named")
)  # fmt: skip


def level(**values: object) -> FactoryLevel:
    return FactoryLevel(**{
        "machine": "m", "short": "straight", "place": "handle", "axis": "y", "state": "idle", "octave_hz": 125.0,
        "source": "A paper", "word": "A word.", **EMPTY, **values,
    })  # type: ignore[arg-type]  # fmt: skip


def table(*rows: FactoryLevel, **more: object) -> FactoryResult:
    return FactoryResult(**{
        "title": "Factory", "provenance": Provenance.today(), "rows": rows, "fitted": (), "soft_races": (),
        "devices": (), "source": "A paper", "background": "None added.", **more,
    })  # type: ignore[arg-type]  # fmt: skip


def grid(result: FactoryResult) -> tuple[tuple[str, ...], ...]:
    return next(block.rows for block in factory_screen(result) if isinstance(block, Grid))


def words(result: FactoryResult) -> str:
    return " ".join(as_text(factory_blocks(result), 80).split())


def test_each_row_has_its_numbers_or_a_dash() -> None:
    full = level(with_measured_db=(102.0, 103.0), with_predicted_db=98.66, miss_db=3.34, at_handles_db=(89.4, 95.8),
                 at_handles_miss_db=6.2, degrees_of_freedom_spent=3)  # fmt: skip
    less = level(axis="z", state="loaded", lowered_measured_db=(8.0, 9.0), lowered_predicted_db=13.7, miss_db=4.7)
    rows = grid(table(full, level(state="not said", named="peak"), less))
    assert rows[0] == ("1 straight idle", "125", "102–103", "98.7", "3.3", "89–96", "6.2", "3")
    assert rows[1] == ("2 straight", "125", "peak", "–", "–", "–", "–", "not said")
    assert rows[2] == ("3 straight loaded", "125", "Δ 8–9", "Δ 13.7", "4.7", "not comparable", "–", "not said")
    assert "along the spindle, where the plane model has no motion" in words(table(less))
    assert "estimated from assumed lengths" not in words(table(less))
    assert "spindle, where" not in words(table(full))


def test_the_verdict_lists_every_miss() -> None:
    """Of four rows one has no prediction; two lie within."""
    text = words(table(*(level(miss_db=miss) for miss in (0.0, None, 2.5, 0.0))))
    told = (
        "The model predicts 3 of 4 measurements, 2 within the published range. Misses of the medians: 0.0, 2.5, 0.0 dB."
    )
    assert told in text
    assert "The model predicts 0 of 1 measurement." in words(table(level()))


def test_a_louder_octave_of_the_model_is_told_with_its_row() -> None:
    result = table(level(louder_octave_hz=250.0, louder_octave_db=115.06))
    text = words(result)
    assert "1 A word. Pressed before the balls have settled, the model is loudest at 250 Hz, 115.1 dB." in text
    assert "Source: A paper." in text and result.status == "pass"


def test_fitted_values_and_soft_races_are_told() -> None:
    value = ValueSource(key="wheel.runout_mm", status="fitted", why="so that it holds")
    fitted = FittedValues(machine="m", short="straight", published=11, assumed=12, fitted=(value,), not_said=0)
    unknown = FittedValues(machine="n", short="other", published=0, assumed=0, fitted=(), not_said=16)
    soft = SoftRaceLevel(short="A, B", assumed_machine="msh-230", published="no reduction", rolling_friction_mm=0.01,
                         level_without_db=110.46, with_median_db=107.7, with_worst_db=None)  # fmt: skip
    text = words(table(level(), fitted=(fitted, unknown), soft_races=(soft,)))
    assert "straight: 11 published, 12 assumed; fitted: runout_mm." in text
    assert "other: 16 values without an origin in the file." in text
    assert "A, B, ASSUMED MACHINE" in text and "friction arm 0.01 mm 110.5 107.7 –" in text
    assert "assumes the machine msh-230" in text and "wheel.runout_mm so that it holds" in text
