"""The oil's part of a design's result and report."""

import pytest

from abu_calc.features.design.band import OilRecord, oil_blocks
from abu_calc.formulas.oil import GRADES
from abu_calc.reporting.blocks import Grid, Heading, Paragraph
from abu_calc.sizing import size
from tests.sizing.machines import PINNED, machine

OIL = {"grade": "VG 46", "fill_ml": 2.0}


def test_the_record_gives_three_temperatures_with_bands_and_the_working_grade_again() -> None:
    design = size(machine(**{**PINNED, "oil": OIL, "autobalancer__rolling_drag_per_s": None}))
    record = OilRecord.of(design)
    assert record is not None and not record.overridden
    assert [each.state for each in record.temperatures] == ["cold", "at work", "hot"]
    work = record.temperatures[1]
    assert work.rolling_drag_per_s == design.case.drag
    assert (work.low_per_s * 3, work.high_per_s / 3) == pytest.approx((design.case.drag, design.case.drag))
    # The list of grades holds the oil itself, at the fill of the file.
    (fill,) = (each for each in record.fills if each.fill_ml == pytest.approx(2.0))
    assert fill.by_grade_per_s[GRADES.index(46)] == pytest.approx(design.case.drag)
    assert work.by_slip_per_s[1] == pytest.approx(design.case.drag)  # 0.5 m/s
    blocks = list(oil_blocks(record, 40.0))
    assert isinstance(blocks[0], Heading) and sum(isinstance(block, Grid) for block in blocks) == 2
    texts = [block.text for block in blocks if isinstance(block, Paragraph)]
    assert any("factor of 3" in text for text in texts) and any("die out fastest" in text for text in texts)


def test_without_oil_there_is_nothing() -> None:
    assert OilRecord.of(size(machine(**PINNED))) is None and list(oil_blocks(None, 40.0)) == []
