"""The same equations without the terms that are zero while modes stay as they are: less for plain Python to do.

Most gaps are open and most torques between balls nothing; their terms are products with parameters that are zero then.
Left out are x·0, x + 0, 0 + x, x − 0, x·1 and x/1, which change no digit of a finite number.
"""

import ast
from collections.abc import Callable, Iterator, Mapping, Sequence
from copy import copy
from typing import Final, TypeVar

FOLDED: Final = (0.0, 1.0)
"""Values of parameters by which terms go or stay as they are."""

Node = TypeVar("Node", ast.expr, ast.stmt)


def placed(node: Node) -> Node:
    """A new node as one of a text: a compiler asks where each is."""
    node.lineno, node.col_offset = 1, 0
    return node


Body = TypeVar("Body", ast.FunctionDef, ast.Try)


def spared(whole: Body, known: Mapping[int, float]) -> Body:
    """One of the functions of a program, where parameters par[…] have these values; of one that stores in arrays."""
    folding = _Folding(known)
    return _rewritten(whole, lambda body: _needed([one for one in map(folding.line, body) if one is not None]))


def without(whole: ast.FunctionDef, array: str, name: str) -> ast.FunctionDef:
    """The same under another name, that does not store in the array which is its last argument."""
    found = _rewritten(whole, lambda body: _needed([one for one in body if not _stores(one, array)]))
    arguments = copy(whole.args)
    found.name, found.args, arguments.args = name, arguments, whole.args.args[:-1]
    return found


def _rewritten(whole: Body, lines: Callable[[list[ast.stmt]], list[ast.stmt]]) -> Body:
    """With other lines in its body, or in what it tries."""
    found, inner = copy(whole), whole.body[0]
    found.body = [_rewritten(inner, lines)] if isinstance(inner, ast.Try) else lines(whole.body)
    return found


def _stores(line: ast.stmt, array: str) -> bool:
    """Whether it is an assignment to an element of this array."""
    target = line.targets[0] if isinstance(line, ast.Assign) else None
    return isinstance(target, ast.Subscript) and isinstance(target.value, ast.Name) and target.value.id == array


def _needed(lines: Sequence[ast.stmt]) -> list[ast.stmt]:
    """Those that store in arrays, and those that make what these use."""
    kept, needed = [], set[str]()
    for line in reversed(lines):
        if isinstance(line, ast.Assign) and isinstance(line.targets[0], ast.Name) and line.targets[0].id not in needed:
            continue
        if isinstance(line, ast.Assign):
            needed.update(_names(line.value))
        kept.append(line)
    return kept[::-1]


def _names(node: ast.expr) -> Iterator[str]:
    """Those in an expression: by its operations, a third of the time of a walk over all nodes."""
    if isinstance(node, ast.Name):
        yield node.id
    elif isinstance(node, ast.BinOp):
        yield from _names(node.left)
        yield from _names(node.right)
    elif not isinstance(node, ast.Constant):
        yield from (one.id for one in ast.walk(node) if isinstance(one, ast.Name))


class _Folding:
    """Expressions with what is known put in."""

    def __init__(self, known: Mapping[int, float]) -> None:
        self.known, self.names = known, dict[str, ast.expr]()

    def line(self, line: ast.stmt) -> ast.stmt | None:
        """None for a name that is a number or another name."""
        if not isinstance(line, ast.Assign):
            return line
        (target,) = line.targets
        value = self.folded(line.value)
        if isinstance(target, ast.Name) and isinstance(value, ast.Constant | ast.Name):
            self.names[target.id] = value
            return None
        return placed(ast.Assign(targets=[target], value=value))

    def folded(self, node: ast.expr) -> ast.expr:
        """The same with fewer operations."""
        if isinstance(node, ast.Name):
            return self.names.get(node.id, node)
        if isinstance(node, ast.Subscript) and isinstance(node.value, ast.Name) and node.value.id == "par":
            assert isinstance(node.slice, ast.Constant)
            place = node.slice.value
            return placed(ast.Constant(self.known[place])) if place in self.known else node  # type: ignore[index]
        if isinstance(node, ast.Call):
            return placed(ast.Call(func=node.func, args=[self.folded(one) for one in node.args], keywords=[]))
        if isinstance(node, ast.UnaryOp):
            return placed(ast.UnaryOp(op=node.op, operand=self.folded(node.operand)))
        if isinstance(node, ast.BinOp):
            return _fewer(self.folded(node.left), node.op, self.folded(node.right))
        return node


def _fewer(left: ast.expr, operator: ast.operator, right: ast.expr) -> ast.expr:
    """One operation, unless it is none."""
    a, b = _number(left), _number(right)
    if isinstance(operator, ast.Mult):
        if a == 0.0 or b == 0.0:
            return placed(ast.Constant(0.0))
        if a == 1.0 or b == 1.0:
            return right if a == 1.0 else left
    elif isinstance(operator, ast.Add) and (a == 0.0 or b == 0.0):
        return right if a == 0.0 else left
    elif (isinstance(operator, ast.Sub) and b == 0.0) or (isinstance(operator, ast.Div) and b == 1.0):
        return left
    return placed(ast.BinOp(left=left, op=operator, right=right))


def _number(node: ast.expr) -> float | None:
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, float) else None
