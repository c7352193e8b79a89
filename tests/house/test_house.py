"""The house: the tools are content, start-up stays light, what is public says what it does."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

from abu_calc.cli.app import COMMANDS

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "abu_calc"


@pytest.mark.parametrize(
    "command",
    [["ruff", "check", "."], ["ruff", "format", "--check", "."], pytest.param(["mypy"], marks=pytest.mark.slow)],
    ids=["ruff", "format", "mypy"],
)
def test_tools_are_content(command: list[str]) -> None:
    done = subprocess.run([sys.executable, "-m", *command], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]


def _loaded_modules(*commands: tuple[str, ...]) -> list[set[str]]:
    """After each of the commands, run one after the other in a process of their own."""
    code = (
        "import sys\nfrom abu_calc.cli.app import run\n"
        f"for command in {commands!r}:\n"
        "    print('\\nSTATUS', run(list(command)), 'MODULES', *sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, encoding="utf-8", check=True
    )
    told = [line.split() for line in done.stdout.splitlines() if line.startswith("STATUS ")]
    assert [one[1] in ("0", "1") for one in told] == [True] * len(commands), done.stderr
    return [set(one[3:]) for one in told]


def _libraries(modules: set[str]) -> set[str]:
    return {name.partition(".")[0] for name in modules}


def test_help_loads_no_more_than_it_shows() -> None:
    """The list of all commands loads no command; the help of a command loads that one, and no library of results.

    Seats are judged without the modules that size a machine.
    """
    helps = [(name, "--help") for name in COMMANDS]
    whole, single, *_, after = _loaded_modules(("--help",), ("stability", "--help"), *helps)
    assert not {name for name in whole if name.startswith("abu_calc.features")}
    loaded = {name for name in single if name.startswith("abu_calc.features.")}
    assert loaded == {"abu_calc.features.stability", "abu_calc.features.stability.command"}
    assert not _libraries(after) & {"pydantic", "rich", "numpy"}
    assert len({name for name in whole if name.startswith("abu_calc")}) <= 15
    assert len({name for name in single if name.startswith("abu_calc")}) <= 25
    (seats,) = _loaded_modules(("check-fit", "--designation", "6203"))
    assert not {name for name in seats if name.startswith(("abu_calc.sizing", "abu_calc.dynamics"))}


LIGHT = [
    ("--help",),
    ("size", "--help"),
    ("validate", "mmg-3200k-knife-shaft"),
    ("schema",),
    ("presets",),
    ("check-fit", "mmg-3200k-knife-shaft"),
    ("explain", "capacity"),
]


def test_commands_load_only_what_they_need() -> None:
    """One after the other in one process, sizing last: modules stay loaded."""
    heavy = {"scipy", "numpy", "matplotlib", "jsonschema", "tomlkit", "llvmlite"}
    *light, modules = map(_libraries, _loaded_modules(*LIGHT, ("size", "msh-230", "--json")))
    assert [(command, loaded & heavy) for command, loaded in zip(LIGHT, light, strict=True) if loaded & heavy] == []
    assert {"llvmlite", "numpy"} <= modules
    assert not modules & {"scipy", "matplotlib", "jsonschema", "tomlkit", "pandas", "multiprocessing"}


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
