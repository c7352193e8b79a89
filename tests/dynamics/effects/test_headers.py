"""The header of every effect lists its parameters."""

import ast
import inspect
from dataclasses import fields

import pytest

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.registry import REGISTRY


@pytest.mark.parametrize(("name", "kind"), REGISTRY, ids=lambda part: part if isinstance(part, str) else "")
def test_a_header_has_a_row_for_each_parameter(name: str, kind: type[Effect]) -> None:
    header = ast.get_docstring(ast.parse(inspect.getsource(inspect.getmodule(kind)))) or ""  # type: ignore[arg-type]
    table = header[header.index("parameter ") :].splitlines()
    assert table[0].split() == ["parameter", "unit", "range", "default", "source"]
    assert [row.split()[0] for row in table[1:] if row.strip()] == [field.name for field in fields(kind)]
