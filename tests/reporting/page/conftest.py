"""Pages of every command, each written once for all tests that ask."""

from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from tests.cli.runner import again
from tests.reporting.page.pages import COMMANDS


class Written(NamedTuple):
    """The text of a command's page, its JSON document, the file."""

    text: str
    document: dict[str, Any]
    file: Path


@pytest.fixture(scope="session")
def written(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Of a command by its name."""
    folder = tmp_path_factory.mktemp("pages")

    @cache
    def made(name: str) -> Written:
        file = folder / f"{name}.html"
        seen = again(*COMMANDS[name], "--json", "--output", str(file))
        assert seen.status in (0, 1), seen.err
        return Written(file.read_text(encoding="utf-8"), seen.document, file)

    return made
