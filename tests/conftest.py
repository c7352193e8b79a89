"""How the tests are shared out among processes; what makes them quicker."""

import gc
import os
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings

from abu_calc.foundation.disk_cache import FOLDER, Cache
from tests import remembered

settings.register_profile("any machine", deadline=None)  # timings decide no test
settings.load_profile("any machine")
gc.disable()  # until all tests are collected: of what that makes nearly nothing is garbage


def pytest_collection_finish() -> None:
    """What is there now stays: garbage is looked for among what tests make."""
    gc.freeze()
    gc.enable()


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Of a test marked `few(n, m)` all cases but the first n are slow, those after the first m of these hard; what is
    hard is not slow as well.
    """
    cases = Counter[str]()
    for item in items:
        if (few := item.get_closest_marker("few")) is not None:
            test = item.nodeid.partition("[")[0]
            cases[test] += 1
            quick, *slow = few.args
            if cases[test] > quick:
                item.add_marker(pytest.mark.hard if slow and cases[test] > quick + slow[0] else pytest.mark.slow)
        if item.get_closest_marker("hard") is not None:
            item.own_markers[:] = [mark for mark in item.own_markers if mark.name != "slow"]


@pytest.hookimpl(wrapper=True)
def pytest_collect_file(file_path: Path) -> Any:
    """A module without an example in its docstrings is not searched for one."""
    collectors = yield
    examples = b">>>" in file_path.read_bytes()
    return [collector for collector in collectors if examples or type(collector) is pytest.Module]


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """A process that has nothing left takes from another: long tests at the end of the list keep none waiting."""
    if config.getvalue("dist") != "load":
        return None
    from xdist.scheduler import WorkStealingScheduling

    return WorkStealingScheduling(config, log)


@pytest.fixture(scope="session", autouse=True)
def studies(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Processes of a session tell each other what they have computed, and those of sessions that name one folder.

    Without a home they keep compiled code among the files of the session.
    """
    base = tmp_path_factory.getbasetemp()
    if "ABU_CALC_TEST_STUDIES" in os.environ:
        remembered.share(Path(os.environ["ABU_CALC_TEST_STUDIES"]))
    elif base.name.startswith("popen-"):
        remembered.share(base.parent / "studies")
    if not _can_be_written(Cache.own().folder):
        os.environ[FOLDER] = str(base.parent / "compiled")


def _can_be_written(folder: Path) -> bool:
    """Whether files may be kept in a folder; not in a home that is missing or read-only."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError:
        return False
    return os.access(folder, os.W_OK)
