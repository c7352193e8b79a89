"""A sized machine in Python: saved, printed, shown, as tables; start cases left out; machines from text."""

import inspect
import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

import abu_calc
from abu_calc.features.design.start_rules import RULES
from abu_calc.features.files.result_schema import RESULTS
from abu_calc.foundation.errors import InputError, OutputError
from abu_calc.foundation.quantity import LEVEL_AFTER, Record, parts_of_type, quantities
from abu_calc.foundation.units import unit_of
from tests.cli.runner import again
from tests.remembered import remembered
from tests.rows import for_each

PRESET = "avtovaz-707-222"


@pytest.fixture(scope="module")
def result() -> abu_calc.SizeResult:
    with remembered():
        return abu_calc.size(abu_calc.read(PRESET))


@pytest.fixture(scope="module")
def without() -> abu_calc.SizeResult:
    return abu_calc.size(abu_calc.read(PRESET), starts="none")


@pytest.mark.slow
def test_save_writes_what_output_writes(result: abu_calc.SizeResult, tmp_path: Path) -> None:
    for ending in (".json", ".toml", ".csv", ".txt", ".svg", ".dxf", ".html"):
        if ending == ".dxf":
            pytest.importorskip("ezdxf")
        path = result.save(tmp_path / f"x{ending}")
        assert path.stat().st_size > 1000
    assert result.save(tmp_path / "solid.step").read_text("utf-8").startswith("ISO-10303-21;")
    made = again("size", PRESET, "--quiet", "--output", str(tmp_path / "y.dxf"))
    assert made.status == 0
    assert {p.name[1:] for p in tmp_path.glob("x*.dxf")} == {p.name[1:] for p in tmp_path.glob("y*.dxf")}
    written = json.loads((tmp_path / "x.json").read_text("utf-8"))
    seen = again("size", PRESET, "--json").document
    assert written["result"].keys() == seen["result"].keys() and written["checks"] == seen["checks"]
    assert (tmp_path / "x.txt").read_text("utf-8") == result.text(full=True)
    assert again("size", PRESET, "--full").out == result.text(full=True)
    assert again("size", PRESET).out == result.text()


def test_save_refuses_with_the_remedy(result: abu_calc.SizeResult, tmp_path: Path) -> None:
    path = result.save(str(tmp_path / "x.json"))
    before = path.read_bytes()
    with pytest.raises(OutputError, match="force=True"):
        result.save(path)
    with pytest.raises(OutputError, match=r"\.html.*\.dxf"):
        result.save(tmp_path / "x.docx")
    with pytest.raises(OutputError, match="folder does not exist"):
        result.save(tmp_path / "none" / "x.json")
    assert path.read_bytes() == before and len(list(tmp_path.iterdir())) == 1
    assert result.save(path, force=True) == path
    levels = abu_calc.effects(abu_calc.read(PRESET))
    with pytest.raises(OutputError):
        levels.save(tmp_path / "x.dxf")


def test_texts_are_short_and_name_the_verdict(result: abu_calc.SizeResult) -> None:
    pattern = r"<SizeResult PASS( WITH WARNINGS)?: \d+ of \d+ checks pass.*; AvtoVAZ [^>]*>"
    assert re.fullmatch(pattern, repr(result))
    machine = abu_calc.read(PRESET)
    members = [result, result.checks, result.checks[0], result.autobalancer, result.vibration, result.ensemble,
               result.simulation, machine, machine.changed({"wheel.mass_kg": 0.5})]  # fmt: skip
    assert max(len(repr(member)) for member in members) <= 500
    level = next(check for check in result.checks if check.code == "ABU401")
    assert re.fullmatch(r"<Check ABU401 [A-Z]+: idle vibration level \([\d.]+ dB, limit 109 dB\)>", repr(level))


@pytest.mark.slow
def test_a_notebook_shows_verdict_section_and_checks(result: abu_calc.SizeResult) -> None:
    late = replace(next(check for check in result.checks if check.code == "ABU702"), status="warn")
    checks = tuple(late if check.code == late.code else check for check in result.checks)
    assert "PASS WITH WARNINGS" in replace(result, checks=checks)._repr_html_()
    html = result._repr_html_()
    assert "PASS" in html and "PASS WITH WARNINGS" not in html and "<svg" in html and "<script" not in html
    assert all(check.code in html for check in result.checks)
    odd = abu_calc.read(PRESET).changed({"machine.name": "<b>&"})
    assert "<b>&" not in abu_calc.effects(odd)._repr_html_()


def test_tables(result: abu_calc.SizeResult) -> None:
    assert result.checks.to_dict("list")["code"] == [check.code for check in result.checks]  # type: ignore[attr-defined]
    assert result.candidates[0] is result.autobalancer and len(result.candidates) == 1 + len(result.alternatives)
    rows = {(row.state, row.place): row for row in result.levels}
    assert rows["idle", result.vibration.place].level_after_db == result.level_after_db
    assert ("grinding", result.vibration.place) in rows and len(rows) == len(result.levels)


@pytest.mark.slow
@pytest.mark.parametrize("starts", ["none", "one"])
@pytest.mark.parametrize("preset", [PRESET, "msh-230", "avtovaz-707-305"])
def test_without_the_starts_no_check_that_needs_them_passes(preset: str, starts: str) -> None:
    sized = abu_calc.size(abu_calc.read(preset), starts=starts)
    codes = {rule.code for rule in RULES}
    needing = {check.code: check for check in sized.checks if check.code in codes}
    assert set(needing) == codes
    assert all(check.status in ("not-done", "fail") for check in needing.values())
    assert sized.status != "pass" and any(f'starts="{starts}"' in text for text in sized.warnings)


@pytest.mark.slow
def test_what_fails_without_the_starts_still_fails() -> None:
    loud = abu_calc.read(PRESET).changed({"limits.vibration_level_db": 90.0})
    for starts in ("none", "one"):
        sized = abu_calc.size(loud, starts=starts)
        assert next(check for check in sized.checks if check.code == "ABU401").status == "fail"
        assert sized.status == "fail"
    with pytest.raises(InputError, match="full, one, none"):
        abu_calc.size(loud, starts="all")


@pytest.mark.slow
def test_the_numbers_that_need_no_start_are_the_same(result: abu_calc.SizeResult, without: abu_calc.SizeResult) -> None:
    for name in ("autobalancer", "vibration_loaded", "fits", "required_capacity_g_mm", "frequency"):
        if name != "vibration_loaded":
            assert getattr(result, name) == getattr(without, name), name
    assert result.vibration.level_after_db == without.level_after_db
    assert without.ensemble is None and without.data_gaps == ()


def records() -> set[type[Record]]:
    from abu_calc.foundation.quantity import hints

    known: set[type[Record]] = set()
    left: list[type[Record]] = list(RESULTS)
    while left:
        kind = left.pop()
        if kind not in known:
            known.add(kind)
            left += [part for hint in hints(kind).values() for part in parts_of_type(hint)
                     if isinstance(part, type) and issubclass(part, Record)]  # fmt: skip
    return known


@for_each(sorted(records(), key=lambda kind: kind.__name__))
def test_the_docstring_of_each_record_lists_its_fields(kind: type[Record]) -> None:
    text = inspect.getdoc(kind) or ""
    for name, quantity in quantities(kind).items():
        if name in kind.entries():
            assert f"{name}: {quantity.label}" in text
            unit = unit_of(name)
            assert not unit or f"[{unit}]" in text
        if name == "level_after_db" and quantity.label == "level after":
            assert quantity is LEVEL_AFTER


@pytest.mark.slow
def test_machines_from_text_dictionary_and_file_are_the_same(tmp_path: Path) -> None:
    machine = abu_calc.read(PRESET)
    path = tmp_path / "m.toml"
    path.write_text(machine.text, encoding="utf-8")
    for source in (machine.text, machine.document.content, path, str(path), machine.to_toml()):
        assert abu_calc.read(source).tables == machine.tables
    text = abu_calc.size(abu_calc.read(machine.text), starts="none")
    assert text.provenance.input is not None and text.provenance.input["file"] is None
    changed = machine.changed({"wheel.mass_kg": 0.5, "autobalancer.ball_count": 4})
    again_read = abu_calc.read(changed.to_toml())
    assert again_read.tables == changed.tables and again_read.overrides == ()


@pytest.mark.parametrize(
    "source", ["", "\n", "# only\n# comments", {}, {"machine": None}, {1: 2}, [1], None, 5, b"[machine]\n"]
)
def test_other_sources_are_refused(source: object) -> None:
    with pytest.raises(InputError):
        abu_calc.read(source)  # type: ignore[arg-type]


@pytest.mark.slow
def test_xarray_and_numpy_of_a_simulation() -> None:
    simulated = abu_calc.simulate(abu_calc.read(PRESET), samples=50)
    motion = simulated.motion
    assert motion is not None and motion.ball_angles_deg.shape == (4, 50) and motion.x_mm.shape == (50,)
    xarray = pytest.importorskip("xarray")
    data = simulated.to_xarray()
    assert isinstance(data, xarray.Dataset) and dict(data.sizes) == {"t_s": 50, "ball": 4}
    assert (data["ball_angles_deg"].sel(ball=2).values == motion.ball_angles_deg[1]).all()
    assert {name: data[name].attrs["units"] for name in ("t_s", "x_mm", "ball_angles_deg")} == {
        "t_s": "s", "x_mm": "mm", "ball_angles_deg": "°",
    }  # fmt: skip
    polars = pytest.importorskip("polars")
    assert polars.DataFrame(motion)["ball4_deg"].to_list() == motion.ball_angles_deg[3].tolist()
    with pytest.raises(InputError, match="no motion was kept"):
        abu_calc.simulate(abu_calc.read(PRESET)).to_xarray()


@pytest.mark.slow
def test_members_of_a_sweep_as_tables() -> None:
    seen: list[str] = []
    sweep = abu_calc.sweep(
        abu_calc.read(PRESET), vary={"wheel.imbalance_g_mm": "200:300:3"}, progress=seen.append, workers=1
    )
    assert seen and len(list(sweep.members)) == 3 and next(iter(sweep.members))["member"] == 0
    assert sweep.members.to_dict("list")["wheel.imbalance_g_mm"] == [200.0, 250.0, 300.0]
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(sweep.members)
    assert frame["level_db"].tolist() == sweep.members["level_db"].tolist() and frame.equals(sweep.members.to_pandas())
    polars = pytest.importorskip("polars")
    assert polars.DataFrame(sweep.members)["member"].to_list() == [0, 1, 2]
    pytest.importorskip("xarray")
    data = sweep.members.to_xarray()
    assert data["level_db"].attrs["units"] == "dB" and data.sizes["member"] == 3
