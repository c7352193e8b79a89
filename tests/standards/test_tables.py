"""Data files: each tells its source, is read once, and refuses names that it does not have."""

from pathlib import Path

import pytest

from abu_calc.standards import tables
from abu_calc.standards.tables import csv_rows, toml_table, unknown

DATA = Path(tables.__file__).parent / "data"
CSV, TOML = (sorted(path.stem for path in DATA.glob(f"*.{suffix}")) for suffix in ("csv", "toml"))


@pytest.mark.parametrize("name", CSV)
def test_rows_have_a_source_and_as_many_cells_as_names(name: str) -> None:
    text = (DATA / f"{name}.csv").read_text(encoding="utf-8").splitlines()
    assert any(line.startswith("# source: ") for line in text) and any(line.startswith("# edition: ") for line in text)
    names = next(line for line in text if not line.startswith("#")).split(",")
    rows = csv_rows(name)
    assert rows and {len(row) for row in rows} == {len(names)} and tuple(names) not in rows


def test_a_file_is_read_once() -> None:
    assert csv_rows(CSV[0]) is csv_rows(CSV[0]) and toml_table(TOML[0]) is toml_table(TOML[0])


@pytest.mark.parametrize("name", TOML)
def test_a_table_of_facts_says_where_they_are_from(name: str) -> None:
    text = (DATA / f"{name}.toml").read_text(encoding="utf-8")
    assert "source" in text and toml_table(name)


def test_an_unknown_name_is_answered_with_the_nearest() -> None:
    near = unknown("design", "one-peice", ["light", "one-piece"], "give any")
    assert (near.found, near.allowed) == ("one-peice", "light, one-piece") and "one-piece" in (near.remedy or "")
    far = unknown("design", "zzz", ["light", "one-piece"], "give any")
    assert far.remedy == "Give any"
    assert unknown("size", "zzz", map(str, range(51))).allowed is None
