"""Translator of plain Python on numbers to LLVM's language: the few words that a compiled loop needs.

Each function is translated alone. Types are those of the annotations: float, int, bool, `Reals` and `Integers` (arrays;
`a[i:]` is the same array from i on), and groups of these: classes of the texts that are `NamedTuple`s. A group is made
by `g = Group(a, b)`, read by `g.a` and handed on whole. Words: assignments, `a: float = b`, `a, b = c, d`, if, while,
for … in range(…), break, continue, return, calls of each other, and abs, min, max, sqrt, sin, cos, any, all. Names from
outside are numbers. All else is refused by a LanguageError. The same text is Python as well, and does there what it
does compiled.
"""

import ast
import threading
from collections.abc import Collection, Mapping, Sequence
from typing import Any

from abu_calc.dynamics.integrators.compiled.llvm_text import (
    FUNCTIONS,
    TYPES,
    Expressions,
    Value,
    constant,
    fields,
    shown,
    signature,
)


class Calls(Expressions):
    """Translation of the calls that a function may make."""

    def of_Call(self, node: ast.Call) -> Value:  # noqa: N802
        """Any call."""
        name = ast.unparse(node.func)
        if name in ("any", "all"):
            return self.of_each(name == "all", node)
        if node.keywords:
            self.refuse(node, "arguments have no names")
        if name in ("min", "max"):
            return self.extreme(name, node)
        if name in FUNCTIONS:
            if len(node.args) != 1:
                self.refuse(node, "one argument")
            text = self.number(node.args[0], "double")
            return "double", self.new(f"call double @{FUNCTIONS[name]}(double {text})")
        return self.own(name, node)

    def own(self, name: str, node: ast.Call) -> Value:
        """A function of the language itself."""
        if name not in self.known:
            self.refuse(node, "no such function")
        result, kinds = self.known[name]
        if len(kinds) != len(node.args):
            self.refuse(node, f"{len(kinds)} arguments")
        given = [text for operand, kind in zip(node.args, kinds, strict=True) for text in self.handed(operand, kind)]
        place = self.new(f"load ptr, ptr @{name}.at") if name in self.outside else f"@{name}"
        call = f"call {shown(result)} {place}({', '.join(given)})"
        if result == "void":
            self.put(call)
            return "void", ""
        return result, self.new(call)

    def handed(self, node: ast.expr, kind: str) -> list[str]:
        """An argument of a call; of a group, all its fields."""
        if kind not in self.groups:
            return [f"{shown(kind)} {self.number(node, kind)}"]
        if not isinstance(node, ast.Name) or self.grouped.get(node.id) != kind:
            self.refuse(node, f"a variable that is a {kind}")
        return [f"{shown(each)} {self.load(ast.Name(name))[1]}" for name, each in self.parts(node.id, kind).items()]

    def of_each(self, every: bool, node: ast.Call) -> Value:
        """`all` and `any` of conditions: a loop that ends where one decides."""
        each = node.args[0] if len(node.args) == 1 else None
        if not isinstance(each, ast.GeneratorExp) or len(each.generators) != 1 or each.generators[0].ifs:
            self.refuse(node, "one condition for … in range(…)")
        truth = ast.Name(self.label("truth"))
        self.store(truth, constant(every))
        test = ast.UnaryOp(ast.Not(), each.elt) if every else each.elt
        body: list[ast.stmt] = [ast.Assign([truth], ast.Constant(not every)), ast.Break()]
        (generator,) = each.generators
        loop = ast.For(generator.target, generator.iter, [ast.If(test, body, [])], [])
        self.statement(ast.fix_missing_locations(ast.copy_location(loop, node)))
        return self.load(truth)

    def extreme(self, name: str, node: ast.Call) -> Value:
        """The smaller or larger of two."""
        if len(node.args) != 2:
            self.refuse(node, "two arguments")
        a, b = (self.value(argument) for argument in node.args)
        kind = "i64" if a[0] == b[0] == "i64" else "double"
        left, right = self.as_kind(a, kind, node), self.as_kind(b, kind, node)
        less = "lt" if name == "min" else "gt"
        test = f"icmp s{less} i64 {right}, {left}" if kind == "i64" else f"fcmp o{less} double {right}, {left}"
        return kind, self.new(f"select i1 {self.new(test)}, {kind} {right}, {kind} {left}")

    def store(self, target: ast.expr, value: Value) -> None:
        """Into a variable or an element."""
        if isinstance(target, ast.Name) and target.id in self.grouped:
            self.refuse(target, "the name of a group")
        if isinstance(target, ast.Name):
            kind = self.kinds.setdefault(target.id, value[0])
            self.put(f"store {shown(kind)} {self.as_kind(value, kind, target)}, ptr %{target.id}")
        elif isinstance(target, ast.Subscript) and not isinstance(target.slice, ast.Slice):
            kind, place = self.element(target)
            self.put(f"store {kind} {self.as_kind(value, kind, target)}, ptr {place}")
        else:
            self.refuse(target, "nothing can be stored there")

    def make(self, target: ast.expr, call: ast.Call) -> None:
        """A group of these values."""
        kind = ast.unparse(call.func)
        if not isinstance(target, ast.Name):
            self.refuse(target, "a group has a name")
        if target.id in self.kinds or self.grouped.get(target.id, kind) != kind:
            self.refuse(target, "the name of something else")
        if call.keywords or len(call.args) != len(self.groups[kind]):
            self.refuse(call, f"{len(self.groups[kind])} values without names")
        rows = zip(self.parts(target.id, kind).items(), call.args, strict=True)
        values = [(name, (each, self.number(operand, each))) for (name, each), operand in rows]
        for name, value in values:
            self.store(ast.Name(name), value)

    def statement(self, node: ast.stmt) -> None:
        """Any of the words."""
        if not (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)):
            self.handler("do", node)(node)


Part = tuple[str, Mapping[str, Any]]
"""A text, and what its names from outside stand for."""


_PARSING = threading.Lock()


def _parsed(text: str) -> list[ast.stmt]:
    """The statements of a text; threads take turns, since `ast.parse` of CPython 3.11 fails where they meet in it."""
    with _PARSING:
        return ast.parse(text).body


def numbers(names: Mapping[str, Any]) -> dict[str, float]:
    """Names whose values are numbers."""
    return {name: value for name, value in names.items() if isinstance(value, int | float)}


def translated(parts: Sequence[Part], exported: Collection[str], given: str = "") -> str:
    """The module of all functions in some texts, each with its constants; those exported can be called from outside.

    `given`: functions, as their text declares them, that another module exports; their addresses are given to
    `connect`, in order. Raises LanguageError where a text is more than the language.
    """
    others, own = _parsed(given), [(_parsed(text), numbers(names)) for text, names in parts]
    groups = {
        node.name: fields(node) for body in (others, *(body for body, _ in own)) for node in body
        if isinstance(node, ast.ClassDef)
    }  # fmt: skip
    outside = {node.name: signature(node) for node in others if isinstance(node, ast.FunctionDef)}
    functions = [
        (node, constants) for body, constants in own for node in body if isinstance(node, ast.FunctionDef)
    ]  # fmt: skip
    known = outside | {node.name: signature(node, groups) for node, _ in functions}
    lines = [f"declare double @{name}(double) memory(none) nounwind willreturn" for name in FUNCTIONS.values()]
    lines.append("declare double @llvm.pow.f64(double, double)")
    lines += [f"@{name}.at = internal global ptr null" for name in outside]
    for function, constants in functions:
        lines += _Function(function, known, constants, outside, groups).lines(function.name in exported)
    stored = [f"  store ptr %{name}, ptr @{name}.at" for name in outside]
    arguments = ", ".join(f"ptr %{name}" for name in outside)
    return "\n".join([*lines, f"define void @connect({arguments}) {{", *stored, "  ret void", "}", ""])


class _Function(Calls):
    """Statements of one function."""

    def lines(self, exported: bool) -> list[str]:
        """The whole definition."""
        entry = [f"  store {shown(k)} %{n}.in, ptr %{n}" for n, k in self.arguments.items()]
        for statement in self.node.body:
            self.statement(statement)
        self.put("ret void" if self.result == "void" else "unreachable")
        places = [f"  %{name} = alloca {shown(kind)}" for name, kind in self.kinds.items()]
        given = ", ".join(f"{shown(kind)} %{name}.in" for name, kind in self.arguments.items())
        how = "" if exported else "internal "  # inlined, they would be compiled again and again
        named = f"define {how}{shown(self.result)} @{self.node.name}({given}) noinline nounwind {{"
        return [named, "entry:", *places, *entry, *self.body, "}"]

    def do_Expr(self, node: ast.Expr) -> None:  # noqa: N802
        """A call whose value nobody takes."""
        self.value(node.value)

    def do_Pass(self, node: ast.Pass) -> None:  # noqa: N802
        """Nothing."""
        return

    def do_Assign(self, node: ast.Assign) -> None:  # noqa: N802
        """One value, as many values as names, or a group."""
        if len(node.targets) != 1:
            self.refuse(node, "one assignment at a time")
        (target,) = node.targets
        if isinstance(node.value, ast.Call) and ast.unparse(node.value.func) in self.groups:
            return self.make(target, node.value)
        if not isinstance(target, ast.Tuple):
            return self.store(target, self.value(node.value))
        if not isinstance(node.value, ast.Tuple) or len(node.value.elts) != len(target.elts):
            self.refuse(node, "as many values as names")
        values = [self.value(expression) for expression in node.value.elts]
        for element, value in zip(target.elts, values, strict=True):
            self.store(element, value)
        return None

    def do_AnnAssign(self, node: ast.AnnAssign) -> None:  # noqa: N802
        """A value whose type is written down."""
        kind = ast.unparse(node.annotation)
        if node.value is None or kind not in TYPES:
            self.refuse(node, "a value of a type of the compiled language")
        self.store(node.target, (TYPES[kind], self.number(node.value, TYPES[kind])))

    def do_AugAssign(self, node: ast.AugAssign) -> None:  # noqa: N802
        """`a += b` as `a = a + b`."""
        (read,) = _parsed(ast.unparse(node.target))
        assert isinstance(read, ast.Expr)
        whole = ast.copy_location(ast.BinOp(read.value, node.op, node.value), node)
        self.store(node.target, self.value(ast.fix_missing_locations(whole)))

    def do_Return(self, node: ast.Return) -> None:  # noqa: N802
        """The end, with the value that the signature names."""
        if (node.value is None) != (self.result == "void"):
            self.refuse(node, f"{self.result} is to be returned")
        text = "" if node.value is None else " " + self.number(node.value, self.result)
        self.put(f"ret {shown(self.result)}{text}")
        self.block(self.label("after"))

    def do_If(self, node: ast.If) -> None:  # noqa: N802
        """One of two blocks."""
        yes, no, end = self.label("yes"), self.label("no"), self.label("end")
        self.branch(self.truth(node.test), yes, no)
        for label, body in ((yes, node.body), (no, node.orelse)):
            self.block(label)
            for statement in body:
                self.statement(statement)
            self.jump(end)
        self.block(end)

    def do_While(self, node: ast.While) -> None:  # noqa: N802
        """A block as long as a condition holds."""
        test, body, end = self.label("test"), self.label("body"), self.label("end")
        self.jump(test)
        self.block(test)
        self.branch(self.truth(node.test), body, end)
        self.block(body)
        self.repeated(node, test, end)
        self.jump(test)
        self.block(end)

    def do_For(self, node: ast.For) -> None:  # noqa: N802
        """A block for whole numbers in order."""
        call, target = node.iter, node.target
        counts = isinstance(call, ast.Call) and ast.unparse(call.func) == "range" and len(call.args) in (1, 2)
        if not counts or not isinstance(call, ast.Call) or not isinstance(target, ast.Name):
            self.refuse(node, "for name in range(one or two numbers)")
        bounds = [self.number(argument, "i64") for argument in call.args]
        counter = ast.Name(self.label("counter"))  # the name itself keeps its last value, as Python's does
        self.store(counter, ("i64", bounds[0] if len(bounds) == 2 else "0"))
        test, body, onward, end = (self.label(name) for name in ("test", "body", "onward", "end"))
        self.jump(test)
        self.block(test)
        self.branch(self.new(f"icmp slt i64 {self.load(counter)[1]}, {bounds[-1]}"), body, end)
        self.block(body)
        self.store(target, self.load(counter))
        self.repeated(node, onward, end)
        self.jump(onward)
        self.block(onward)
        self.store(counter, ("i64", self.new(f"add i64 {self.load(counter)[1]}, 1")))
        self.jump(test)
        self.block(end)

    def repeated(self, node: ast.For | ast.While, onward: str, end: str) -> None:
        """The body of a loop."""
        if node.orelse:
            self.refuse(node, "loops have no else")
        self.loops.append((onward, end))
        for statement in node.body:
            self.statement(statement)
        self.loops.pop()

    def do_Break(self, node: ast.Break) -> None:  # noqa: N802
        """Jump to the end of the innermost loop."""
        self.jump(self.loops[-1][1])
        self.block(self.label("after"))

    def do_Continue(self, node: ast.Continue) -> None:  # noqa: N802
        """Jump to the next turn of the innermost loop."""
        self.jump(self.loops[-1][0])
        self.block(self.label("after"))
