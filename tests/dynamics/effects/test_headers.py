"""The header of an effect lists the parameters that its keys do not declare."""

import ast
import inspect
from dataclasses import fields

import pytest

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.inputs.reading.table import in_si


@pytest.mark.parametrize(("name", "kind"), REGISTRY, ids=lambda part: part if isinstance(part, str) else "")
def test_every_parameter_is_declared_once(name: str, kind: type[Effect]) -> None:
    header = ast.get_docstring(ast.parse(inspect.getsource(inspect.getmodule(kind)))) or ""  # type: ignore[arg-type]
    head, *table = header.partition("parameter ")[2].splitlines() or [""]
    assert head.split() in ([], ["unit", "range", "default", "source"])
    declared = in_si(kind.keys) if kind.keys else {}
    rows = [row.split()[0] for row in table if row.strip()]
    assert rows == [field.name for field in fields(kind) if field.name not in declared]
