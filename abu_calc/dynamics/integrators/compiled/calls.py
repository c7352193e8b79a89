"""Calls in the compiled language: of each other, of functions on numbers, and `any` and `all`."""

import ast

from abu_calc.dynamics.integrators.compiled.expressions import FUNCTIONS, Expressions
from abu_calc.dynamics.integrators.compiled.writer import Value, constant, shown


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
        given = [f"{shown(kind)} {self.number(operand, kind)}" for operand, kind in zip(node.args, kinds, strict=True)]
        place = self.new(f"load ptr, ptr @{name}.at") if name in self.outside else f"@{name}"
        call = f"call {shown(result)} {place}({', '.join(given)})"
        if result == "void":
            self.put(call)
            return "void", ""
        return result, self.new(call)

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
        if isinstance(target, ast.Name):
            kind = self.kinds.setdefault(target.id, value[0])
            self.put(f"store {shown(kind)} {self.as_kind(value, kind, target)}, ptr %{target.id}")
        elif isinstance(target, ast.Subscript) and not isinstance(target.slice, ast.Slice):
            kind, place = self.element(target)
            self.put(f"store {kind} {self.as_kind(value, kind, target)}, ptr {place}")
        else:
            self.refuse(target, "nothing can be stored there")

    def statement(self, node: ast.stmt) -> None:
        """Any of the words."""
        if not (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)):
            self.handler("do", node)(node)
