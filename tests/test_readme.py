"""The README shows what is so."""

import re
from pathlib import Path

import pytest

from tests.cli.runner import abu, once

README = (Path(__file__).resolve().parent.parent / "README.md").read_text(encoding="utf-8")


NUMBER = re.compile(r"\d+(?:\.\d+)?")


def test_the_example_is_real_output() -> None:
    """Word for word; numbers to 5 %, since what a simulation leaves over differs a little between platforms."""
    shown = re.search(r"\$ abu size avtovaz-707-222\n(.*?)\n```", README, re.DOTALL)
    assert shown is not None
    example = shown[1].splitlines()
    real = once("size", "avtovaz-707-222").out.splitlines()
    assert [NUMBER.sub("#", line) for line in real] == [NUMBER.sub("#", line) for line in example]
    numbers = [[float(number) for number in NUMBER.findall("\n".join(lines))] for lines in (real, example)]
    assert numbers[0] == pytest.approx(numbers[1], rel=0.05) and len(numbers[0]) > 20


def test_the_scene_is_simulated(tmp_path: Path) -> None:
    shown = re.search(r"```toml\n(\[scene\].*?)```", README, re.DOTALL)
    assert shown is not None
    file = tmp_path / "my-scene.toml"
    file.write_text(shown[1], encoding="utf-8")
    seen = abu("simulate", str(file), "--json")
    assert seen.status == 0 and len(seen.document["result"]["effects"]) == 4


def test_the_script_runs(capsys: pytest.CaptureFixture[str]) -> None:
    shown = re.search(r"```python\n(.*?)```", README, re.DOTALL)
    assert shown is not None
    scope: dict[str, object] = {}
    exec(compile(shown[1], "README.md", "exec"), scope)
    first, *checks = capsys.readouterr().out.splitlines()
    assert re.fullmatch(r"(pass|fail|not-done) \d+ \d+\.\d+", first)
    assert len(checks) > 8 and all(line.startswith("ABU") for line in checks)


def test_every_command_is_named() -> None:
    listed = re.findall(r"^  (\S+) ", abu("--help").out.split("Commands:")[1].split("\n\n")[0], re.MULTILINE)
    assert len(listed) >= 8
    assert all(f"`abu {name}" in README for name in listed)
