"""LLVM's text of one function as it is written: types, instructions, jumps, variables, expressions."""

import ast
import struct
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Final, NoReturn

Value = tuple[str, str]
"""Type and text: "double", "i64", "i1", "reals", "integers"."""

Signature = tuple[str, list[str]]
"""Types of result and arguments; a group's type is its name."""

Groups = Mapping[str, Mapping[str, str]]
"""Groups of arguments by name: each is a `NamedTuple` of the texts, here its fields with their types."""

NO_GROUPS: Final[Groups] = MappingProxyType({})

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


def fields(group: ast.ClassDef) -> dict[str, str]:
    """Fields of a group with their types."""
    rows = [node for node in group.body if isinstance(node, ast.AnnAssign)]
    for node in rows:
        if ast.unparse(node.annotation) not in TYPES:
            raise LanguageError(f"{group.name}: {ast.unparse(node.annotation)} is no type of the compiled language")
    return {ast.unparse(node.target): TYPES[ast.unparse(node.annotation)] for node in rows}


def signature(function: ast.FunctionDef, groups: Groups = NO_GROUPS) -> Signature:
    """Signature of a function by its annotations."""
    kinds = [ast.unparse(node) if node else "nothing" for node in (param.annotation for param in function.args.args)]
    result = ast.unparse(function.returns) if function.returns else "None"
    place = f"{function.name}, line {function.lineno}"
    if result in groups:
        raise LanguageError(f"{place}: {result} is no type of a result")
    for kind in (result, *kinds):
        if kind not in TYPES and kind not in groups:
            raise LanguageError(f"{place}: {kind} is no type of the compiled language")
    return TYPES[result], [TYPES.get(kind, kind) for kind in kinds]


class Writer:
    """One function on its way: every variable has a place in memory, which LLVM makes registers of.

    `known`: all functions that may be called; `numbers`: names from outside; `outside`: functions of another module.
    A group has no place of its own: each of its fields has one, so that it costs what single arguments cost.
    """

    def __init__(
        self,
        node: ast.FunctionDef,
        known: Mapping[str, Signature],
        numbers: Mapping[str, float],
        outside: Mapping[str, Signature],
        groups: Groups = NO_GROUPS,
    ) -> None:
        self.node, self.known, self.numbers, self.outside, self.groups = node, known, numbers, outside, groups
        self.result, kinds = known[node.name]
        self.grouped: dict[str, str] = {}
        self.kinds: dict[str, str] = {}
        for param, kind in zip(node.args.args, kinds, strict=True):
            self.kinds |= self.parts(param.arg, kind)
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

    def parts(self, name: str, kind: str) -> dict[str, str]:
        """A variable with its type; of a group, which is known from here on, all fields with theirs."""
        if kind not in self.groups:
            return {name: kind}
        self.grouped[name] = kind
        return {f"{name}.{field}": each for field, each in self.groups[kind].items()}

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


REAL_SIGNS: dict[type, str] = {ast.Add: "fadd", ast.Sub: "fsub", ast.Mult: "fmul", ast.Div: "fdiv"}
INT_SIGNS: dict[type, str] = {ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul"}
COMPARED: dict[type, str] = {ast.Lt: "lt", ast.LtE: "le", ast.Gt: "gt", ast.GtE: "ge", ast.Eq: "eq", ast.NotEq: "ne"}
FUNCTIONS = {"sqrt": "llvm.sqrt.f64", "abs": "llvm.fabs.f64", "sin": "sin", "cos": "cos"}


class Expressions(Writer):
    """Each kind of node has its method."""

    def value(self, node: ast.expr) -> Value:
        """Type and text of an expression."""
        translation: Value = self.handler("of", node)(node)
        return translation

    def number(self, node: ast.expr, kind: str) -> str:
        """An expression of this type."""
        return self.as_kind(self.value(node), kind, node)

    def truth(self, node: ast.expr) -> str:
        """A condition."""
        kind, text = self.value(node)
        return text if kind == "i1" else self.refuse(node, "no condition")

    def element(self, node: ast.Subscript) -> Value:
        """Type and place of an element."""
        kind, base = self.array(node)
        index = self.number(node.slice, "i64")
        return ELEMENTS[kind], self.new(f"getelementptr {ELEMENTS[kind]}, ptr {base}, i64 {index}")

    def array(self, node: ast.Subscript) -> Value:
        """Array whose element a subscript takes."""
        if not isinstance(node.value, ast.Name | ast.Attribute):
            self.refuse(node, "elements are those of a named array")
        kind, base = self.value(node.value)
        return (kind, base) if kind in ELEMENTS else self.refuse(node, "no array")

    def of_Constant(self, node: ast.Constant) -> Value:  # noqa: N802
        """A number."""
        if not isinstance(node.value, bool | int | float):
            self.refuse(node, "no number")
        return constant(node.value)

    def of_Name(self, node: ast.Name) -> Value:  # noqa: N802
        """A variable before a number from outside."""
        if node.id in self.numbers and node.id not in self.kinds:
            return constant(self.numbers[node.id])
        return self.load(node)

    def of_Attribute(self, node: ast.Attribute) -> Value:  # noqa: N802
        """A field of a group."""
        return self.load(ast.copy_location(ast.Name(ast.unparse(node)), node))

    def of_BinOp(self, node: ast.BinOp) -> Value:  # noqa: N802
        """Arithmetic; a division gives a real number."""
        a, b, sign = self.value(node.left), self.value(node.right), type(node.op)
        if a[0] == b[0] == "i64" and sign in INT_SIGNS:
            return "i64", self.new(f"{INT_SIGNS[sign]} i64 {a[1]}, {b[1]}")
        left, right = self.as_kind(a, "double", node.left), self.as_kind(b, "double", node.right)
        if sign is ast.Pow:
            return "double", self.new(f"call double @llvm.pow.f64(double {left}, double {right})")
        if sign not in REAL_SIGNS:
            self.refuse(node, "the compiled language has no such sign")
        return "double", self.new(f"{REAL_SIGNS[sign]} double {left}, {right}")

    def of_UnaryOp(self, node: ast.UnaryOp) -> Value:  # noqa: N802
        """Logical negation, or minus."""
        if isinstance(node.op, ast.Not):
            return "i1", self.new(f"xor i1 {self.truth(node.operand)}, true")
        kind, text = self.value(node.operand)
        if not isinstance(node.op, ast.USub) or kind not in ("double", "i64"):
            self.refuse(node, "the compiled language has no such sign")
        return kind, self.new(f"fneg double {text}" if kind == "double" else f"sub i64 0, {text}")

    def of_Compare(self, node: ast.Compare) -> Value:  # noqa: N802
        """Comparison of two numbers; a value that is no number is neither less, greater nor equal."""
        if len(node.ops) != 1 or type(node.ops[0]) not in COMPARED:
            self.refuse(node, "one comparison of two numbers")
        a, b, word = self.value(node.left), self.value(node.comparators[0]), COMPARED[type(node.ops[0])]
        if a[0] == b[0] == "i64":
            return "i1", self.new(f"icmp {word if word in ('eq', 'ne') else 's' + word} i64 {a[1]}, {b[1]}")
        if a[0] == b[0] == "i1" and word in ("eq", "ne"):
            return "i1", self.new(f"icmp {word} i1 {a[1]}, {b[1]}")
        left, right = self.as_kind(a, "double", node), self.as_kind(b, "double", node)
        return "i1", self.new(f"fcmp {'une' if word == 'ne' else 'o' + word} double {left}, {right}")

    def of_BoolOp(self, node: ast.BoolOp) -> Value:  # noqa: N802
        """The second is looked at only where the first does not decide."""
        end, is_and = self.label("end"), isinstance(node.op, ast.And)
        truth = ast.Name(self.label("truth"))
        self.kinds[truth.id] = "i1"
        for k, operand in enumerate(node.values):
            text = self.truth(operand)
            self.put(f"store i1 {text}, ptr %{truth.id}")
            if k + 1 < len(node.values):
                onward = self.label("onward")
                self.branch(text, *((onward, end) if is_and else (end, onward)))
                self.block(onward)
        self.jump(end)
        self.block(end)
        return self.load(truth)

    def of_IfExp(self, node: ast.IfExp) -> Value:  # noqa: N802
        """The other side is not computed."""
        yes, no, end = self.label("yes"), self.label("no"), self.label("end")
        self.branch(self.truth(node.test), yes, no)
        sides = []
        for label, side in ((yes, node.body), (no, node.orelse)):
            self.block(label)
            value = self.value(side)
            sides.append((*value, len(self.body)))
            self.jump(end)
        kind = sides[0][0] if sides[0][0] == sides[1][0] else "double"
        choice = ast.Name(self.label("either"))
        self.kinds[choice.id] = kind
        for have, text, at in reversed(sides):  # the later one first, so that places stay where they are
            here, self.body = self.body, []
            self.put(f"store {shown(kind)} {self.as_kind((have, text), kind, node)}, ptr %{choice.id}")
            self.body = [*here[:at], *self.body, *here[at:]]
        self.block(end)
        return self.load(choice)

    def of_Subscript(self, node: ast.Subscript) -> Value:  # noqa: N802
        """An element, or the same array from a place on."""
        if not isinstance(node.slice, ast.Slice):
            kind, place = self.element(node)
            return kind, self.new(f"load {kind}, ptr {place}")
        if node.slice.lower is None or node.slice.upper is not None or node.slice.step is not None:
            self.refuse(node, "of an array is taken what begins somewhere")
        kind, base = self.array(node)
        index = self.number(node.slice.lower, "i64")
        return kind, self.new(f"getelementptr {ELEMENTS[kind]}, ptr {base}, i64 {index}")
