"""Every command, `--set` line and code block of the README and of docs/ runs.

Commands of the `{abu}` directives run when the site is built; the commands of `sh` blocks run here.
"""

import re
import shlex
import shutil
from pathlib import Path

import pytest

from tests.cli.runner import again
from tests.house.structure import ROOT

DOCS = ROOT / "docs"
PAGES = [ROOT / "README.md", *sorted(page for page in DOCS.rglob("*.md") if "generated" not in page.parts)]
SHELL = re.compile(r"^```sh\n(.*?)^```", re.DOTALL | re.MULTILINE)
PYTHON = re.compile(r"^```python\n(.*?)^```", re.DOTALL | re.MULTILINE)


def commands(page: Path) -> list[str]:
    """The `abu` commands of the shell blocks of a page; CI runs those that install."""
    lines = [
        line.split(" #")[0].strip() for block in SHELL.findall(page.read_text("utf-8")) for line in block.split("\n")
    ]
    return [line for line in lines if line.startswith("abu ")]


def named(page: Path) -> str:
    return str(page.relative_to(ROOT))


FEWER = {"sweep": ("--runs", "16")}
"""Of samples: as many as a page's grid has cells."""


# CI builds the documentation, which runs what its pages show.
@pytest.mark.parametrize(
    "page",
    [
        pytest.param(page, marks=pytest.mark.slow if page.name == "README.md" else pytest.mark.hard, id=named(page))
        for page in PAGES
        if commands(page)
    ],
)
def test_each_command_runs(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(DOCS / "examples", tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    for command in commands(page):
        words = shlex.split(command)[1:]
        seen = again(*words, *FEWER.get(words[0], ()))
        assert seen.status == 0, f"{command}: {seen.status}\n{seen.err}"


@pytest.mark.parametrize("page", [page for page in PAGES if PYTHON.search(page.read_text("utf-8"))], ids=named)
def test_each_script_runs(page: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for script in PYTHON.findall(page.read_text("utf-8")):
        exec(compile(script, named(page), "exec"), {})
    first, *checks = capsys.readouterr().out.splitlines()
    assert re.fullmatch(r"(pass|fail|not-done) \d+ \d+\.\d+", first)
    assert len(checks) > 8 and all(line.startswith("ABU") for line in checks)


@pytest.mark.slow
def test_each_table_of_a_machine_file_is_read(tmp_path: Path) -> None:
    """Tables that a page shows are added to a preset, which is validated."""
    blocks = {
        (page, block)
        for page in PAGES
        for block in re.findall(r"^```toml\n(.*?)^```", page.read_text("utf-8"), re.DOTALL | re.MULTILINE)
    }
    assert len(blocks) >= 2
    preset = (ROOT / "presets" / "msh-230.toml").read_text("utf-8")
    for page, block in blocks:
        text = preset
        for header, entries in re.findall(r"^(\[\[?[\w.]+\]?\])\n((?:(?!\[).*\n?)*)", block, re.MULTILINE):
            if header in text and not header.startswith("[["):
                names = [line.split("=")[0].strip() for line in entries.splitlines() if "=" in line]
                start, end = text.index(header), text.find("\n[", text.index(header) + 1)
                body = text[start : end if end > 0 else len(text)]
                kept = [line for line in body.splitlines()[1:] if line.split("=")[0].strip() not in names]
                text = text.replace(body, "\n".join([header, entries.rstrip(), *kept]) + "\n")
            else:
                text += f"\n{header}\n{entries}"
        file = tmp_path / "machine.toml"
        file.write_text(text, encoding="utf-8")
        seen = again("validate", str(file))
        assert seen.status == 0, f"{named(page)}: {block}\n{seen.out}{seen.err}"


@pytest.mark.slow
def test_each_example_file_is_valid() -> None:
    examples = sorted((DOCS / "examples").glob("*.toml"))
    assert len(examples) >= 3
    seen = again("validate", *map(str, examples))
    assert seen.status == 0, seen.out + seen.err


def test_each_link_of_the_readme_leads_somewhere() -> None:
    text = (ROOT / "README.md").read_text("utf-8")
    links = [*re.findall(r"\]\(([\w./-]+)\)", text), *re.findall(r'src="([^"]+)"', text)]
    assert len(links) >= 3
    assert all((ROOT / link).exists() for link in links)
