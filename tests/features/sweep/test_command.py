"""`abu sweep` as people see it."""

import json
from pathlib import Path
from typing import Any

import pytest

from abu_calc.features.sweep.samples import SweepStudy
from abu_calc.foundation.errors import NotTrustworthyError
from tests.cli.runner import abu

OFF = "autobalancer.race_eccentricity_mm=uniform(0.004,0.016)"
CALM = ("--vary", "start.kind=choice(bunched)", "--workers", "1")


@pytest.mark.slow
def test_one_screen_and_the_document(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    store, csv = tmp_path / "members.sqlite", tmp_path / "found.csv"
    shown = abu("sweep", "avtovaz-707-222", "--vary", OFF, "--runs", "32", *CALM, "--store", str(store), "-o", str(csv))
    assert shown.status == 0 and len(shown.out.splitlines()) <= 48 and shown.width <= 80
    assert "32 machines built to one design meet the limits" in shown.out.replace("\n  ", " ")
    assert "quantities.level_db.p95," in csv.read_text(encoding="utf-8")
    again = abu("sweep", "avtovaz-707-222", "--store", str(store), "--resume", "--json", "--workers", "1")
    document = again.document
    result = document["result"]
    assert again.status == 0 and document["abu"]["command"] == "sweep" and result["store"] == str(store)
    assert result["runs"] == 32 and result["failed"] == {"members": 0, "reasons": []}
    assert result["quantities"]["level_db"].keys() == {"p05", "p50", "p95", "mean"}
    assert {"share", "confidence_interval"} <= result["meets_limits"].keys()
    assert {"key", "first_order", "total"} == result["sensitivity"][0].keys()


@pytest.mark.slow
def test_who_interrupts_is_told_how_to_go_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    computed = SweepStudy._row

    def stopped(self: SweepStudy, member: int, may_end_process: bool) -> Any:
        if member == 2:
            raise KeyboardInterrupt
        return computed(self, member, may_end_process)

    monkeypatch.setattr(SweepStudy, "_row", stopped)
    store = tmp_path / "members.sqlite"
    seen = abu("sweep", "avtovaz-707-222", "--vary", OFF, "--runs", "8", *CALM, "--store", str(store))
    assert seen.status == 130 and f"of 8 samples are in {store}. Go on with:" in seen.err and "--resume" in seen.err
    kept = abu("sweep", "avtovaz-707-222", "--vary", OFF, *CALM)
    assert kept.status == 130 and "no member is kept" in kept.err


@pytest.mark.slow
def test_who_interrupts_the_trials_is_told_that_all_members_are_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stopped(*_: Any) -> Any:
        raise KeyboardInterrupt

    monkeypatch.setattr("abu_calc.features.sweep.study.prices", stopped)
    store = tmp_path / "members.sqlite"
    seen = abu("sweep", "avtovaz-707-222", "--vary", OFF, "--runs", "4", *CALM, "--store", str(store))
    assert seen.status == 130 and f"4 of 4 samples are in {store}. Go on with:" in seen.err


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (("--vary", "wheel.mas_kg=1:2:2"), "--vary wheel.mas_kg: unknown key"),
        (("--vary", "wheel.mass_kg=norml(1,2)"), "--vary wheel.mass_kg: an unknown distribution"),
        (("--vary", "wheel.mass_kg"), "--vary: not KEY="),
        (("--resume",), "--resume goes with --store"),
        (("--runs", "0"), "--runs"),
        (("--what", "builds"), "--what"),
        (("--cluster-wait", "0"), "--cluster-wait"),
        (("--grid", "wheel.mass_kg", "machine.mass_kg"), "--grid"),
        (("--set", 'sweep.vary=["wheel.mass_kg"]'), "not KEY="),
        (("--set", "sweep.run=5"), "runs"),
    ],
    ids=str,
)
def test_wrong_options_are_refused(arguments: tuple[str, ...], part: str) -> None:
    seen = abu("sweep", "msh-230", *arguments)
    assert seen.status == 2 and part in seen.err and seen.out == ""


@pytest.mark.parametrize("option", ["--output", "--figure"])
@pytest.mark.parametrize("through", ["itself", "a link", "another way"])
def test_a_store_on_the_path_of_another_output_is_refused(option: str, through: str, tmp_path: Path) -> None:
    """Before anything is computed."""
    file = tmp_path / ("found.json" if option == "--output" else "found.svg")
    other = tmp_path / ".." / tmp_path.name / file.name
    store = {"itself": file, "a link": tmp_path / "link", "another way": other}[through]
    if through == "a link":
        store.symlink_to(file)
    given = str(file) if option == "--output" else f"shares={file}"
    seen = abu("sweep", "msh-230", "--tolerances", "--runs", "2", "--store", str(store), option, given)
    assert seen.status == 2 and "two outputs name the same file" in seen.err
    assert not file.exists()


def test_a_loop_of_links_is_told_by_the_name_of_the_store(tmp_path: Path) -> None:
    loop = tmp_path / "loop"
    loop.symlink_to(loop)
    for more in ((), ("--resume",), ("--force",), ("--output", str(tmp_path / "out.json"))):
        seen = abu("sweep", "msh-230", "--tolerances", "--store", str(loop), *more)
        assert seen.status == 2 and f"--store: {loop}" in seen.err and "bug" not in seen.err


def test_memory_is_no_store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    seen = abu("sweep", "msh-230", "--tolerances", "--runs", "2", "--store", ":memory:")
    assert seen.status == 2 and "--store" in seen.err and list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_who_lost_a_cluster_is_told_how_to_go_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    computed = SweepStudy._row

    def lost(self: SweepStudy, member: int, may_end_process: bool) -> Any:
        if member == 3:
            raise NotTrustworthyError("the cluster has had no scheduler or no worker for 60 s")
        return computed(self, member, may_end_process)

    monkeypatch.setattr(SweepStudy, "_row", lost)
    store = tmp_path / "members.sqlite"
    seen = abu("sweep", "avtovaz-707-222", "--vary", OFF, "--runs", "8", *CALM, "--store", str(store))
    assert seen.status == 3 and f"of 8 samples are in {store}. Go on with:" in seen.err and "--resume" in seen.err


def test_a_cluster_that_is_not_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "distributed", None)
    seen = abu("sweep", "msh-230", "--tolerances", "--cluster", "tcp://127.0.0.1:1", "--json")
    assert seen.status == 2 and "abu-calc[cluster]" in seen.err
    assert json.loads(seen.out)["error"]["key"] == "--cluster"


@pytest.mark.slow
def test_a_wrong_table_is_named_with_its_file(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    assert abu("init", "--all-keys", str(file)).status == 0
    with file.open("a", encoding="utf-8") as text:
        text.write('\n[sweep.vary]\n"wheel.mas_kg" = "1:2:2"\n')
    seen = abu("sweep", str(file))
    assert seen.status == 2 and "machine.toml" in seen.err and "sweep.vary wheel.mas_kg: unknown key" in seen.err
