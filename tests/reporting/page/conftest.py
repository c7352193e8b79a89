"""Pages of every command, each written once for all tests that ask, and a browser that shows them."""

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from tests.cli.runner import again
from tests.reporting.page.browser import FOUND, Browser, BrowserUnavailableError
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


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """One for all pages of a file of tests."""
    if FOUND is None:
        pytest.skip("no Chromium is installed")
    try:
        opened = Browser(tmp_path_factory.mktemp("profile")).__enter__()
    except BrowserUnavailableError as problem:
        pytest.skip(f"Chromium does not start: {problem}")
    yield opened
    opened.__exit__()
