"""The structure of the package, read from its imports: those for a type checker alone count too."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "abu_calc"


@cache
def files() -> dict[str, Path]:
    """Every file of the package by its dotted name."""
    found = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


@cache
def imports() -> dict[str, set[str]]:
    """Which files each file imports, wherever in it the import stands; a package's name alone stands for its file."""
    return {name: set(_imported(path)) - {name} for name, path in files().items()}


def _imported(path: Path) -> Iterator[str]:
    for node in _statements(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("abu_calc"):
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                yield inner if inner in files() else str(node.module)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in files())


def _statements(block: ast.AST) -> Iterator[ast.AST]:
    """All statements within a block; expressions, most of a tree, hold none."""
    for part in ("body", "orelse", "finalbody", "handlers", "cases"):
        inner = getattr(block, part, ())
        for node in inner if isinstance(inner, list) else ():
            yield node
            yield from _statements(node)


def circles() -> list[set[str]]:
    """Files that import each other in a loop (strongly connected components of more than one file)."""
    graph, index, low, stack, found = imports(), dict[str, int](), dict[str, int](), list[str](), list[set[str]]()

    def visit(name: str) -> None:
        index[name] = low[name] = len(index)
        stack.append(name)
        for other in graph[name]:
            if other not in index:
                visit(other)
                low[name] = min(low[name], low[other])
            elif other in stack:
                low[name] = min(low[name], index[other])
        if low[name] == index[name]:
            members = set[str]()
            while name not in members:
                members.add(stack.pop())
            if len(members) > 1:
                found.append(members)

    for name in graph:
        if name not in index:
            visit(name)
    return found


def lines(path: Path) -> int:
    """How many lines a file has."""
    return len(path.read_text(encoding="utf-8").splitlines())
