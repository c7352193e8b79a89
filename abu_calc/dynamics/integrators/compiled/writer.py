"""LLVM's text of one function as it is written: types, instructions, jumps, variables."""

import ast
import struct
from collections.abc import Mapping
from typing import Any, NoReturn

Value = tuple[str, str]
"""Type and text: "double", "i64", "i1", "reals", "integers"."""

Signature = tuple[str, list[str]]
"""Types of result and arguments."""

TYPES = {"float": "double", "int": "i64", "bool": "i1", "Reals": "reals", "Integers": "integers", "None": "void"}
ELEMENTS = {"reals": "double", "integers": "i64"}


class LanguageError(TypeError):
    """A word, a name or a type that the compiled language does not have."""


def shown(kind: str) -> str:
    """A type as LLVM writes it."""
    return "ptr" if kind in ELEMENTS else kind


def constant(value: float) -> Value:
    """A number, a real one by its bits."""
    if isinstance(value, bool):
        return "i1", str(value).lower()
    if isinstance(value, int):
        return "i64", str(value)
    return "double", "0x" + struct.pack(">d", value).hex().upper()


def signature(function: ast.FunctionDef) -> Signature:
    """Signature of a function by its annotations."""
    kinds = [ast.unparse(node) if node else "nothing" for node in (param.annotation for param in function.args.args)]
    result = ast.unparse(function.returns) if function.returns else "None"
    for kind in (result, *kinds):
        if kind not in TYPES:
            raise LanguageError(f"{function.name}, line {function.lineno}: {kind} is no type of the compiled language")
    return TYPES[result], [TYPES[kind] for kind in kinds]


class Writer:
    """One function on its way: every variable has a place in memory, which LLVM makes registers of.

    `known`: all functions that may be called; `numbers`: names from outside; `outside`: functions of another module.
    """

    def __init__(
        self,
        node: ast.FunctionDef,
        known: Mapping[str, Signature],
        numbers: Mapping[str, float],
        outside: Mapping[str, Signature],
    ) -> None:
        self.node, self.known, self.numbers, self.outside = node, known, numbers, outside
        self.result, kinds = known[node.name]
        self.kinds = dict(zip((param.arg for param in node.args.args), kinds, strict=True))
        self.arguments = dict(self.kinds)
        self.body: list[str] = []
        self.count = 0
        self.loops: list[tuple[str, str]] = []

    def refuse(self, node: ast.AST, reason: str) -> NoReturn:
        """Raise LanguageError, naming the place."""
        line = getattr(node, "lineno", self.node.lineno)
        raise LanguageError(f"{self.node.name}, line {line}: {ast.unparse(node)!r}: {reason}")

    def handler(self, prefix: str, node: ast.AST) -> Any:
        """Method that writes a node of this kind."""
        method = getattr(self, f"{prefix}_{type(node).__name__}", None)
        return method or self.refuse(node, "the compiled language has no such word")

    def put(self, line: str) -> None:
        """One instruction."""
        self.body.append("  " + line)

    def new(self, instruction: str) -> str:
        """One instruction, and the name of what it gives."""
        self.count += 1
        self.put(f"%.{self.count} = {instruction}")
        return f"%.{self.count}"

    def label(self, name: str) -> str:
        """A name for a place in the code."""
        self.count += 1
        return f"{name}.{self.count}"

    def block(self, label: str) -> None:
        """Here begins what can be jumped to."""
        self.body.append(f"{label}:")

    def jump(self, label: str) -> None:
        """Go there; what follows has a name of its own."""
        self.put(f"br label %{label}")

    def branch(self, truth: str, yes: str, no: str) -> None:
        """Go to one of two places."""
        self.put(f"br i1 {truth}, label %{yes}, label %{no}")

    def load(self, node: ast.Name) -> Value:
        """A variable."""
        if node.id not in self.kinds:
            self.refuse(node, "no such name")
        kind = self.kinds[node.id]
        return kind, self.new(f"load {shown(kind)}, ptr %{node.id}")

    def as_kind(self, value: Value, kind: str, node: ast.AST) -> str:
        """An integer may stand where a real number is wanted."""
        have, text = value
        if have == kind:
            return text
        if (have, kind) == ("i64", "double"):
            return self.new(f"sitofp i64 {text} to double")
        return self.refuse(node, f"{have} where {kind} is wanted")
