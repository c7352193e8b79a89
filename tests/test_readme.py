"""The README shows what is so."""

import re
from pathlib import Path

from tests.cli.runner import abu

README = (Path(__file__).resolve().parent.parent / "README.md").read_text(encoding="utf-8")


def test_the_example_is_real_output() -> None:
    shown = re.search(r"\$ abu size avtovaz-707-222\n(.*?)\n```", README, re.DOTALL)
    assert shown is not None
    real = [line.rstrip() for line in abu("size", "avtovaz-707-222").out.splitlines()]
    assert real[: len(shown[1].splitlines())] == shown[1].splitlines()


def test_every_command_is_named() -> None:
    listed = re.findall(r"^  (\S+) ", abu("--help").out.split("Commands:")[1].split("\n\n")[0], re.MULTILINE)
    assert len(listed) >= 8
    assert all(f"`abu {name}" in README for name in listed)
