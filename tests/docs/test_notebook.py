"""The notebook of the documentation: kept without outputs, and it runs from its first cell to its last."""

import json
from pathlib import Path
from typing import Any

import pytest

from tests.house.structure import ROOT

NOTEBOOK = ROOT / "docs" / "how-to" / "python.ipynb"


def cells() -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(NOTEBOOK.read_text("utf-8"))["cells"]
    return found


def test_it_is_kept_without_outputs() -> None:
    for cell in cells():
        if cell["cell_type"] == "code":
            assert cell["outputs"] == [] and cell["execution_count"] is None
            compile("".join(cell["source"]), cell["id"], "exec")


def test_it_designs_sweeps_plots_and_writes() -> None:
    code = "\n".join("".join(cell["source"]) for cell in cells() if cell["cell_type"] == "code")
    for word in ("abu_calc.size(", "abu_calc.sweep(", ".plot(", 'save("design.html"', 'save("section.dxf"'):
        assert word in code, word


@pytest.mark.slow
def test_every_cell_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    pytest.importorskip("ezdxf")
    matplotlib.use("Agg")
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    for cell in cells():
        if cell["cell_type"] == "code":
            source = "".join(cell["source"]).replace("runs=60", "runs=12")
            exec(compile(source, cell["id"], "exec"), names)
    assert names["result"].status == "pass" and len(names["sweep"].members) == 12
    assert {path.name for path in tmp_path.iterdir()} >= {"design.html", "section.dxf", "section.svg"}
