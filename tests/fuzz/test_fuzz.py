"""100 inputs, the same each time, and all that once broke a command."""

import tempfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.fuzz.inputs import SOURCES, shared_out
from tests.fuzz.judging import broken, described, seed

INPUTS = 100
SEEDS = sorted((Path(__file__).parent / "seeds").glob("*.json"))
CALM = (HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example, HealthCheck.filter_too_much)


@pytest.mark.slow
@pytest.mark.parametrize(("odd", "each"), shared_out(INPUTS).items())
def test_nothing_breaks_a_command(odd: str, each: int) -> None:
    @settings(max_examples=each, derandomize=True, deadline=None, database=None, suppress_health_check=CALM)
    @given(st.data())
    def commands_end_well(data: st.DataObject) -> None:
        one = data.draw(SOURCES[odd])
        with tempfile.TemporaryDirectory() as folder:
            # How long it took is for `python -m tests.fuzz` to tell: timings decide no test.
            assert [fault for fault in broken(one, Path(folder)) if not fault.startswith("took")] == [], described(one)

    commands_end_well()


@pytest.mark.slow
@pytest.mark.parametrize("path", SEEDS, ids=lambda path: path.stem)
def test_what_once_broke_a_command(path: Path, tmp_path: Path) -> None:
    assert broken(seed(path.read_text(encoding="utf-8")), tmp_path) == []
