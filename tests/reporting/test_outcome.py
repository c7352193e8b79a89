"""Outcomes of commands, and the one JSON document they become.

What is written: never over a file that came meanwhile, through links and not over them, and nothing but files.
"""

import json
import math
import os
import threading
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Annotated, ClassVar

import pytest

import abu_calc
from abu_calc.cli import command as filing
from abu_calc.foundation.checks import Check, Grade
from abu_calc.foundation.errors import InputError, OutputError, Place
from abu_calc.foundation.quantity import Quantity, record
from abu_calc.reporting import outcome as write
from abu_calc.reporting.blocks import Paragraph
from abu_calc.reporting.outcome import Outcome, document, error_document, finite, to_json
from abu_calc.simulation.result import Provenance, Result
from tests.cli.runner import abu
from tests.inputs.samples import BEARINGS
from tests.inputs.scenes import SCENE

WHOLE, SHORT = (Paragraph("whole"),), (Paragraph("short"),)


def test_blocks_are_made_when_they_are_wanted() -> None:
    made: list[str] = []

    def view() -> tuple[Paragraph, ...]:
        made.append("view")
        return WHOLE

    outcome = Outcome("size", {}, view)
    assert made == [] and outcome.blocks == WHOLE and made == ["view"]


def test_the_screen_is_the_short_report_or_else_the_whole_one() -> None:
    assert Outcome("size", {}, WHOLE, short=lambda: SHORT).screen == SHORT
    assert Outcome("size", {}, WHOLE).screen == WHOLE


@record
class Sample(Result):
    """A result with one number."""

    command: ClassVar[str] = "sample"

    mass_g: Annotated[float, Quantity("mass")] = 240.5


def sample(*checks: Check) -> Outcome:
    result = Sample(title="sample", checks=checks, warnings=("careful",), provenance=Provenance.today())
    return Outcome(result.command, result, lambda: WHOLE)


def check(status: Grade) -> Check:
    return Check("ABU201", "capacity", status, "enough", 2.0, 1.0, "g·mm", None, "least")


def test_only_a_pass_exits_with_zero() -> None:
    statuses = [sample(check(status)).exit_status for status in ("pass", "warn", "fail", "not-done")]
    assert statuses == [0, 0, 1, 1]
    assert Outcome("presets", {}, WHOLE).exit_status == 0


def test_the_envelope_holds_what_the_result_holds_and_no_input_without_a_file() -> None:
    made = document(sample(check("pass")))
    assert made["abu"]["command"] == "sample" and made["abu"]["version"] == abu_calc.__version__
    assert made["input"] is None and made["warnings"] == ["careful"] and made["result"] == {"mass_g": 240.5}
    assert made["checks"] == [
        {"code": "ABU201", "name": "capacity", "status": "pass", "message": "enough", "value": 2.0, "limit": 1.0,
         "unit": "g·mm", "remedy": None, "bound": "least", "overrides": (), "change": None}
    ]  # fmt: skip


def test_an_action_is_told_with_everything_that_it_replaces() -> None:
    entries = ("oil.grade=VG 100", "run_up.time_s=0.5", "machine.speed_range_rpm=[3000,6000]")
    made = document(sample(replace(check("fail"), overrides=entries)))
    assert made["checks"][0]["change"] == {
        "oil.grade": "VG 100", "run_up.time_s": 0.5, "machine.speed_range_rpm": [3000, 6000]
    }  # fmt: skip


def test_a_command_without_a_study_has_its_notes_for_warnings() -> None:
    made = document(Outcome("validate", {"files": []}, WHOLE, notes=("careful",)))
    assert (made["status"], made["checks"], made["model"]) == ("pass", [], {})
    assert (made["result"], made["warnings"]) == ({"files": []}, ["careful"])


def test_a_wrong_input_is_told_by_its_place() -> None:
    error = InputError("out of range", place=Place("m.toml", 3, "wheel.mass_kg"), found="-1", allowed="above 0")
    facts = error_document("size", error)["error"]
    assert (facts["file"], facts["line"], facts["key"]) == ("m.toml", 3, "wheel.mass_kg")
    assert (facts["message"], facts["found"], facts["allowed"], facts["remedy"]) == (
        "out of range",
        "-1",
        "above 0",
        None,
    )


def test_what_is_no_error_of_ours_is_a_bug() -> None:
    facts = error_document("size", ZeroDivisionError("by zero"))
    assert facts["error"] == {"kind": "bug", "message": "by zero"} and facts["status"] == "not-done"


def test_json_holds_no_nan_and_is_ascii() -> None:
    for number in (math.nan, math.inf):
        with pytest.raises(ValueError):
            to_json({"a": number})
        assert finite(number) is None
    text = to_json({"unit": "µm"})
    assert text.isascii() and json.loads(text) == {"unit": "µm"}
    assert finite(0.0) == 0.0


COMMAND = ("check-fit", *["--designation", "7516", "--radial-load-kN", "3", "--shaft", "f6", "--housing", "H7"])
posix = pytest.mark.skipif(os.name == "nt", reason="links need rights there, and FIFOs are none")


@pytest.fixture
def meanwhile(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """A file that appears when all is computed."""
    path, written = tmp_path / "out.json", filing.write_files

    def late(*how: object) -> bool:
        path.write_text("somebody else's", encoding="utf-8")
        return written(*how)  # type: ignore[arg-type]

    monkeypatch.setattr("abu_calc.cli.command.write_files", late)
    return path


def test_a_file_that_came_meanwhile_stays(meanwhile: Path) -> None:
    seen = abu(*COMMAND, "--output", str(meanwhile))
    assert seen.status == 2 and seen.out == "" and meanwhile.read_text(encoding="utf-8") == "somebody else's"
    assert (
        "exists already" in seen.err
        and "The computed result is fail; without the file, the exit status is 1" in seen.err
    )
    assert list(meanwhile.parent.iterdir()) == [meanwhile]
    assert abu(*COMMAND, "--output", str(meanwhile), "--force").status == 1
    assert meanwhile.read_text(encoding="utf-8").startswith("{")


@pytest.mark.parametrize("links", [True, False])
def test_two_at_once_write_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, links: bool) -> None:
    """Of many that write the same new file one does, the others are refused; with links and without them."""
    if not links:
        monkeypatch.setattr(Path, "hardlink_to", lambda *_: (_ for _ in ()).throw(OSError(95, "no links here")))
    path, outcome = tmp_path / "out.txt", []

    def put(text: str) -> None:
        try:
            write.write([write.Target(path, text)], force=False)
            outcome.append(text)
        except write.OutputError:
            pass

    threads = [threading.Thread(target=put, args=(f"text {k}",)) for k in range(8)]
    for one in threads:
        one.start()
    for one in threads:
        one.join()
    assert len(outcome) == 1 and path.read_text(encoding="utf-8") == outcome[0]
    assert list(tmp_path.iterdir()) == [path]


@posix
@pytest.mark.parametrize("dangling", [False, True])
def test_links_stay_links(tmp_path: Path, dangling: bool) -> None:
    (tmp_path / "folder").mkdir()
    real, link = tmp_path / "folder" / "real.json", tmp_path / "out.json"
    link.symlink_to(real)
    if not dangling:
        real.write_text("old", encoding="utf-8")
    seen = abu(*COMMAND, "--output", str(link))
    assert seen.status == 2 and "exists already" in seen.err and real.exists() is not dangling
    assert abu(*COMMAND, "--output", str(link), "--force").status == 1
    assert link.is_symlink() and real.read_text(encoding="utf-8").startswith("{")


@posix
@pytest.mark.parametrize("force", [(), ("--force",)])
def test_pipes_and_devices_are_no_targets(tmp_path: Path, force: tuple[str, ...]) -> None:
    pipe, link = tmp_path / "pipe.json", tmp_path / "null.json"
    os.mkfifo(pipe)
    link.symlink_to("/dev/null")
    for path in (pipe, link):
        seen = abu(*COMMAND, "--output", str(path), *force)
        assert seen.status == 2 and "not a regular file" in seen.err
    assert pipe.is_fifo() and link.is_symlink()


def test_of_two_files_the_written_one_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    scene, motion, output = (tmp_path / name for name in ("scene.toml", "motion.csv", "out.json"))
    scene.write_text(SCENE, encoding="utf-8")
    placed = write._place

    def place(temporary: Path, path: Path, *, force: bool) -> None:
        if path == output:
            output.write_text("somebody else's", encoding="utf-8")
        placed(temporary, path, force=force)

    monkeypatch.setattr(write, "_place", place)
    seen = abu("simulate", str(scene), "--duration", "10", "--trajectory", str(motion), "--output", str(output))
    assert seen.status == 2 and f"Written is: {motion}" in seen.err and "The computed result is pass" in seen.err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["motion.csv", "out.json", "scene.toml"]


def test_an_update_writes_over_no_edit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "seats.toml"
    file.write_text(BEARINGS, encoding="utf-8")

    def edited(*_: object) -> dict[str, object]:
        file.write_text(BEARINGS + "# edited\n", encoding="utf-8")
        return {"status": "fail"}

    monkeypatch.setattr("abu_calc.features.verify.study.present_values", edited)
    seen = abu("verify", "--update", str(file))
    assert seen.status == 2 and "changed while it was recomputed" in seen.err
    assert file.read_text(encoding="utf-8").endswith("# edited\n")


LONG = "x" * 300


@pytest.mark.parametrize(
    ("arguments", "option"),
    [
        (("size", "msh-230", "--output", f"{LONG}.json"), "--output"),
        (("size", "msh-230", "--figure", f"settling={LONG}.svg"), "--figure"),
        (("simulate", "msh-230", "--trajectory", f"{LONG}.csv"), "--trajectory"),
        (("sweep", "msh-230", "--tolerances", "--store", f"{LONG}.sqlite"), "--store"),
        (("verify", LONG), LONG),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_names_that_no_file_can_have_are_told_with_their_option(arguments: tuple[str, ...], option: str) -> None:
    seen = abu(*arguments)
    assert seen.status == 2 and option in seen.err and "name too long" in seen.err.lower()


def test_loops_of_links_are_no_targets(tmp_path: Path) -> None:
    loop = tmp_path / "loop.svg"
    loop.symlink_to(loop)
    for more in ((), ("--force",)):
        seen = abu("size", "msh-230", "--figure", f"settling={loop}", *more)
        assert seen.status == 2 and "--figure" in seen.err and "symbolic links" in seen.err


@pytest.mark.few(2)
@pytest.mark.parametrize(
    ("arguments", "name", "taken"),
    [
        (("schema",), "schema.json", True),
        (("schema",), "schema.toml", False),
        (("schema", "result"), "schema.csv", False),
        (("presets", "msh-230"), "machine.toml", True),
        (("presets", "msh-230"), "machine.json", True),
        (("presets", "msh-230"), "machine.csv", False),
    ],
)
def test_a_files_ending_says_what_is_in_it(arguments: tuple[str, ...], name: str, taken: bool, tmp_path: Path) -> None:
    file = tmp_path / name
    seen = abu(*arguments, "--output", str(file))
    assert seen.status == (0 if taken else 2) and file.exists() == taken
    if taken:
        (json.loads if name.endswith(".json") else tomllib.loads)(file.read_text(encoding="utf-8"))
    else:
        assert ".json" in seen.err and "does not write" in seen.err


def test_a_picture_as_output_is_refused_with_the_option_for_pictures(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"--figure NAME=FILE\.png"):
        write.check_target(tmp_path / "a.png", force=False, suffixes=(".svg",), option="--output")
    with pytest.raises(OutputError) as other:
        write.check_target(tmp_path / "a.doc", force=False, suffixes=(".svg",), option="--output")
    assert other.value.remedy is None
