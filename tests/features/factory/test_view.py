"""The factory's table: cells, spans, and the sentence that counts predictions within what was measured."""

from abu_calc.features.factory.study import FactoryLevel, FactoryResult
from abu_calc.features.factory.view import factory_blocks, factory_screen
from abu_calc.reporting.blocks import Grid
from abu_calc.reporting.text import as_text
from abu_calc.simulation.result import Provenance

EMPTY = dict.fromkeys(
    ("without_measured_db", "without_predicted_db", "with_measured_db", "with_predicted_db", "with_predicted_worst_db",
     "lowered_measured_db", "lowered_predicted_db", "outside_db", "difference_db", "louder_octave_hz",
     "louder_octave_db", "named")
)  # fmt: skip


def level(**values: object) -> FactoryLevel:
    return FactoryLevel(**{
        "machine": "m", "short": "straight", "state": "idle", "octave_hz": 125.0, "word": "A word.", **EMPTY, **values,
    })  # type: ignore[arg-type]  # fmt: skip


def table(*rows: FactoryLevel) -> FactoryResult:
    return FactoryResult(
        title="Factory", provenance=Provenance.today(), rows=rows, source="A paper", background="None added."
    )


def grid(result: FactoryResult) -> tuple[tuple[str, ...], ...]:
    return next(block.rows for block in factory_screen(result) if isinstance(block, Grid))


def test_each_row_has_its_numbers_or_a_dash() -> None:
    full = level(without_measured_db=(108.0, 111.0), without_predicted_db=111.04, with_predicted_db=98.66,
                 with_predicted_worst_db=103.0, difference_db=3.44, lowered_measured_db=(6.0, 9.0))  # fmt: skip
    rows = grid(table(full, level(state="not said", named="loud")))
    assert rows[0] == ("1 straight idle", "125", "108–111", "111.0", "–", "98.7", "+3.4", "6–9", "–")
    assert rows[1] == ("2 straight", "125", "loud", "–", "–", "–", "–", "–", "–")


def test_the_verdict_counts_what_the_model_speaks_of() -> None:
    """Of four rows one has no prediction; two lie within, one is off by 2.5 dB."""
    rows = [level(outside_db=off) for off in (0.0, None, 2.5, 0.0)]
    text = " ".join(as_text(factory_screen(table(*rows)), 80).split())
    assert (
        "The model predicts 3 of 4 measurements: 2 within the measured range, the others up to 2.5 dB outside it."
        in text
    )


def test_a_louder_octave_of_the_model_is_told_with_its_row() -> None:
    result = table(level(louder_octave_hz=250.0, louder_octave_db=115.06))
    text = " ".join(as_text(factory_blocks(result), 80).split())
    assert "1 A word. Pressed before the balls have settled, the model is loudest at 250 Hz, 115.1 dB." in text
    assert "Source: A paper." in text and result.status == "pass"
