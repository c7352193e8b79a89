"""LLVM's text of numbers, types and expressions."""

import ast
import math
import struct

import pytest

from abu_calc.dynamics.integrators.compiled.llvm_text import Expressions, LanguageError, constant, shown, signature


def function(text: str) -> ast.FunctionDef:
    """The first function of a text."""
    node = ast.parse(text).body[0]
    assert isinstance(node, ast.FunctionDef)
    return node


@pytest.mark.parametrize("number", [0.0, -0.0, 0.1, 1e-320, math.pi, -math.inf, math.nan])
def test_a_real_number_is_written_by_its_bits(number: float) -> None:
    kind, text = constant(number)
    (back,) = struct.unpack(">d", bytes.fromhex(text.removeprefix("0x")))
    assert kind == "double" and struct.pack(">d", back) == struct.pack(">d", number)


def test_truths_and_whole_numbers_have_types_of_their_own() -> None:
    assert constant(True) == ("i1", "true") and constant(1) == ("i64", "1") and constant(-3) == ("i64", "-3")
    assert [shown(kind) for kind in ("reals", "integers", "double")] == ["ptr", "ptr", "double"]


def test_a_signature_is_that_of_the_annotations() -> None:
    node = function("def go(x: Reals, k: Integers, t: float, yes: bool) -> int:\n return 0")
    assert signature(node) == ("i64", ["reals", "integers", "double", "i1"])
    assert signature(function("def go():\n pass")) == ("void", [])


@pytest.mark.parametrize(
    "text", ["def go(x: str) -> int:\n pass", "def go(x) -> int:\n pass", "def go() -> list:\n pass"]
)
def test_a_type_that_the_language_lacks_is_refused_with_its_place(text: str) -> None:
    with pytest.raises(LanguageError, match="go, line 1"):
        signature(function(text))


def written(expression: str) -> tuple[str, list[str]]:
    """Type of an expression of t (real) and k (whole), and the instructions that compute it."""
    node = function(f"def go(t: float, k: int) -> float:\n return {expression}")
    writer = Expressions(node, {"go": signature(node)}, {"SIZE": 2.5}, {})
    value = node.body[0]
    assert isinstance(value, ast.Return) and value.value is not None
    kind, _ = writer.value(value.value)
    return kind, [line.strip() for line in writer.body]


@pytest.mark.parametrize(("expression", "kind", "sign"), [
    ("k + k", "i64", "add i64"), ("k + t", "double", "fadd double"), ("k / k", "double", "fdiv double"),
    ("-t", "double", "fneg double"), ("-k", "i64", "sub i64 0"), ("t < SIZE", "i1", "fcmp olt double"),
    ("t != t", "i1", "fcmp une double"), ("k >= 2", "i1", "icmp sge i64"), ("t ** 2", "double", "@llvm.pow.f64"),
])  # fmt: skip
def test_arithmetic_has_the_instruction_of_its_types(expression: str, kind: str, sign: str) -> None:
    """Only a number that is none differs from itself."""
    result, lines = written(expression)
    assert result == kind and any(sign in line for line in lines)


@pytest.mark.parametrize("expression", ["t + other", "k // k", "not t", "'word'", "t < k < t", "t[0]"])
def test_what_no_expression_may_be_is_refused(expression: str) -> None:
    with pytest.raises(LanguageError, match="go, line 2"):
        written(expression)
