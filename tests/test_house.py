"""The house: imports go one way, the tools are content, start-up stays light, formulas explain themselves."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "abu_calc"
ROOMS = ("standards", "spec", "formulas", "fits", "sizing", "dynamics", "scenes", "analysis", "report", "cli")
GROUND = {"errors", "units", "checks", "check_codes", "formula", "validity", "version"}


def _imports(path: Path) -> set[str]:
    """The rooms a file imports, wherever in it the import stands."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        names = [node.module] if isinstance(node, ast.ImportFrom) and node.module else []
        names += [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
        found |= {name.split(".")[1] for name in names if name.startswith("abu_calc.")}
    return found


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_imports_only_rooms_before_it(room: str) -> None:
    allowed = GROUND | set(ROOMS[: ROOMS.index(room) + 1])
    files = list((PACKAGE / room).rglob("*.py"))
    assert files
    for path in files:
        assert _imports(path) <= allowed, f"{path.relative_to(ROOT)} imports {_imports(path) - allowed}"


def test_the_ground_floor_imports_no_room() -> None:
    for name in GROUND:
        assert _imports(PACKAGE / f"{name}.py") <= GROUND


@pytest.mark.parametrize(
    "command", [["ruff", "check", "."], ["ruff", "format", "--check", "."], ["mypy"]], ids=["ruff", "format", "mypy"]
)
def test_tools_are_content(command: list[str]) -> None:
    done = subprocess.run([sys.executable, "-m", *command], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]


def _loaded_modules(*arguments: str) -> set[str]:
    code = (
        "import sys\nfrom abu_calc.cli.app import run\n"
        f"status = run({list(arguments)!r})\n"
        "print('\\nSTATUS', status, 'MODULES', ' '.join(sys.modules))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, encoding="utf-8", check=True
    )
    tail = done.stdout.rsplit("STATUS ", 1)[1]
    assert tail[0] in "01", done.stderr
    return {name.split(".")[0] for name in tail.split("MODULES ")[1].split()}


@pytest.mark.parametrize(
    "arguments",
    [
        ("--help",),
        ("size", "--help"),
        ("validate", "avtovaz-707-222"),
        ("schema",),
        ("presets",),
        ("check-fit", "mmg-3200k-knife-shaft"),
        ("explain", "capacity"),
    ],
    ids=" ".join,
)
def test_light_commands_load_no_numerics(arguments: tuple[str, ...]) -> None:
    assert not _loaded_modules(*arguments) & {"scipy", "numpy", "matplotlib", "jsonschema", "tomlkit", "heyoka"}


def test_size_loads_only_what_it_needs() -> None:
    modules = _loaded_modules("size", "avtovaz-707-222", "--json")
    assert {"scipy", "numpy"} <= modules
    assert not modules & {"matplotlib", "jsonschema", "tomlkit", "pandas"}


def _public(body: list[ast.stmt]) -> list[ast.FunctionDef | ast.ClassDef]:
    """Public functions and classes of a module or class, those inside functions left out."""
    found = [node for node in body if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and node.name[0] != "_"]
    return found + [inner for node in found if isinstance(node, ast.ClassDef) for inner in _public(node.body)]


def test_every_public_function_says_what_it_does() -> None:
    silent = [
        f"{path.relative_to(ROOT)}:{node.lineno} {node.name}"
        for path in PACKAGE.rglob("*.py")
        for node in _public(ast.parse(path.read_text(encoding="utf-8")).body)
        if ast.get_docstring(node) is None and not any("formula(" in ast.unparse(one) for one in node.decorator_list)
    ]
    assert silent == []
