"""The file that `abu init` writes."""

import re
from pathlib import Path

import pytest

from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.reading.schema import WIDTH, template_of
from abu_calc.inputs.reading.table import all_tables
from abu_calc.inputs.wheel import QUANTITIES
from tests.inputs.samples import document, read

OPTIONAL = [
    "[grinding]",
    "[run_up]",
    "[motor]",
    "[swing_arm]",
    "[[bearing]]",
    "[sweep]",
    "[expected]",
]
REPLACED = {"imbalance_g_mm": ("balance_grade", *QUANTITIES), "runout_mm": ("runout_tir_mm",)}


def test_it_reads_back_and_shows_every_default(tmp_path: Path) -> None:
    loaded = read(tmp_path, template_of("machine"))
    assert [path for path, _ in loaded.defaults_used] == ["machine.speed_range_rpm"]
    assert isinstance(loaded.tables, MachineFile) and loaded.tables.autobalancer is not None


def test_it_names_every_table_and_key_once() -> None:
    rows = [row.lstrip("#") for row in template_of("machine").splitlines() if not row.startswith("# ")]
    for path, table in all_tables(MachineFile):
        header = next(row for row in rows if row.strip("[]") == ".".join(path) and row.startswith("["))
        block = rows[rows.index(header) + 1 :]
        end = next((index for index, row in enumerate(block) if row.startswith("[")), len(block))
        keys = [row.split(" = ")[0] for row in block[:end] if row]
        assert keys == [key for key in table.model_fields if key != "handle"], path


def test_a_new_file_is_a_rigid_body_with_a_handle(tmp_path: Path) -> None:
    tables = read(tmp_path, template_of("machine")).tables
    assert isinstance(tables, MachineFile)
    assert tables.machine.estimates and [handle.name for handle in tables.machine.handle] == ["front"]


@pytest.mark.parametrize("header", OPTIONAL)
def test_an_optional_table_reads_once_its_marks_are_taken_away(tmp_path: Path, header: str) -> None:
    before, mark, after = template_of("machine").partition(f"\n#{header}")
    assert mark
    block, gap, rest = after.partition("\n\n")
    # The sizes of a bearing stand beside its designation, its load beside that of the process: one may be used.
    others = r"#(bore_mm|outer_mm|width_mm|position_mm|cutting_force_N|normal_to_cutting_ratio|bearings_sharing)"
    lines = [row for row in block.split("\n") if not re.match(others, row)]
    used = "\n".join(row[1:] if re.match(r"#[a-z]", row) else row for row in lines)
    text = f"{before}\n{header}{used}{gap}{rest}"
    assert read(tmp_path, text).tables != read(tmp_path, template_of("machine")).tables or header == "[expected]"


@pytest.mark.parametrize(("shown", "other"), [(shown, other) for shown, all_ in REPLACED.items() for other in all_])
def test_an_alternative_key_reads_in_place_of_the_one_shown(tmp_path: Path, shown: str, other: str) -> None:
    text = re.sub(rf"(?m)^{shown} = ", f"#{shown} = ", template_of("machine"))
    wheel = document(re.sub(rf"(?m)^#{other} = ", f"{other} = ", text, count=1))["wheel"]
    assert isinstance(wheel, dict) and other in wheel and shown not in wheel
    read(tmp_path, re.sub(rf"(?m)^#{other} = ", f"{other} = ", text, count=1))


def test_comments_are_wrapped() -> None:
    assert max(map(len, template_of("machine").splitlines())) <= WIDTH + 2
