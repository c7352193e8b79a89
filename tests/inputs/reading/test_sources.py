"""What is read: regular files of bounded size and depth, or standard input; and what validate promises of them."""

import io
import os
import re
import tracemalloc
from pathlib import Path

import pytest

import abu_calc
from abu_calc.inputs.reading import toml_text as lines
from abu_calc.inputs.reading import values_with_units as bounds
from abu_calc.inputs.rolling_bearing import MOST_BEARINGS
from abu_calc.simulation.simulate import simulate
from abu_calc.simulation.subject import subject_of
from abu_calc.sizing import size
from tests.cli.runner import abu
from tests.inputs.samples import BASIC, BEARINGS
from tests.inputs.scenes import SCENE

posix = pytest.mark.skipif(os.name == "nt", reason="has no FIFOs")
FILE = "machine.toml"


@posix
@pytest.mark.parametrize("command", ["validate", "check-fit", "size", "simulate", "stability", "effects", "accuracy",
                                     "verify"])  # fmt: skip
def test_pipes_and_devices_are_no_files(tmp_path: Path, command: str) -> None:
    pipe = tmp_path / "pipe.toml"
    os.mkfifo(pipe)
    for path in (pipe, Path("/dev/zero")):
        seen = abu(command, str(path))
        assert seen.status == 2 and str(path) in seen.err and "standard input" in seen.err


@posix
def test_a_pipe_in_a_folder_is_told(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.toml")
    (tmp_path / "inside.toml").mkdir()
    seen = abu("verify", str(tmp_path))
    assert seen.status == 2 and "pipe.toml: this is not a regular file" in seen.err


def test_standard_input_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    for text, status in ((BEARINGS, 0), (BEARINGS.replace("80", '"80"'), 2), ("", 2)):
        monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(text.encode())))
        seen = abu("validate", "-")
        assert seen.status == status and (status == 0 or "abu validate: -" in seen.err)
    monkeypatch.setattr("sys.stdin", None)
    assert "standard input is closed" in abu("validate", "-").err


@pytest.mark.parametrize("text", [
    "a" + ".a" * 50_000 + " = 1\n", "[" + "a." * 50_000 + "a]\n", "a = " + "[" * 50_000, "x = " + "{a=" * 20_000,
    "x = {" + '"a".' * 20_000 + "b = 1}", "a.b = 1\n" * 50 + "[x]\n" + "'a' . " * 20_000 + "b = 1",
], ids=["dotted", "header", "brackets", "tables", "quoted", "late"])  # fmt: skip
def test_depth_is_bounded_before_memory_is_spent(tmp_path: Path, text: str) -> None:
    file = tmp_path / FILE
    file.write_text(text, encoding="utf-8")
    abu("validate", str(file))
    tracemalloc.start()
    seen = abu("validate", str(file))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    line = 52 if "[x]" in text else 1
    assert seen.status == 2 and f"{file}:{line}: the file is nested too deeply" in seen.err
    assert peak < 5e6  # before: 1e9 and more


def test_what_looks_deep_and_is_not(tmp_path: Path) -> None:
    """Points and brackets of texts, comments and long lists are no depth."""
    file, dots = tmp_path / FILE, "[{a." * 100
    levels = ", ".join(["110.5"] * 900)
    text = BASIC.replace("imbalance_g_mm = 150.0", f"measured_level_db = [{levels}] # {dots}")
    file.write_text(text.replace('"straight grinder"', f"'''{dots}'''"), encoding="utf-8")
    assert abu("validate", str(file)).status == 0


@pytest.mark.parametrize("text", ['a = "' + '\\"' * 5000, "a = '''" + "'x" * 5000, 'a = """' + 'x"' * 5000])
@pytest.mark.parametrize("token", [bounds._TOKEN, lines._TOKEN])
def test_a_string_without_end_is_looked_through_once(text: str, token: re.Pattern[str]) -> None:
    """Time would grow with the square of the length, if its end were looked for from each quote in it."""
    found = [one[0] for one in token.finditer(text)]
    assert "".join(found) == text and len(found) <= 6


@pytest.mark.parametrize(("header", "key"), [("[[bearing]]\ndesignation = '6203'\n", "bearing"),
                                             ("[[machine.handle]]\nname = '{}'\nfrom_center_of_mass_mm = 1\n",
                                              "machine.handle")])  # fmt: skip
def test_counts_are_bounded(tmp_path: Path, header: str, key: str) -> None:
    file = tmp_path / FILE
    rows = "".join(header.format(k) for k in range(MOST_BEARINGS + 1))
    file.write_text(BASIC + rows, encoding="utf-8")
    seen = abu("validate", str(file))
    assert seen.status == 2 and f"at most {MOST_BEARINGS}" in seen.err
    assert f"{key}: too many tables, {BASIC.count(f'[[{key}]]') + MOST_BEARINGS + 1} of them" in seen.err


@pytest.mark.slow
def test_many_unknown_keys_are_asked_but_once_what_they_were_meant_to_be(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The work grows with the number of keys: what is dear is done for the first of them."""
    from abu_calc.inputs.reading import errors

    asked, stray = [], errors._stray
    monkeypatch.setattr(errors, "_stray", lambda finding: asked.append(finding) or stray(finding))
    file = tmp_path / FILE
    keys = "".join(f"kk{k}_mm = 1\n" for k in range(5000))
    file.write_text(BASIC.replace("[autobalancer]", f"{keys}[autobalancer]"), encoding="utf-8")
    seen = abu("validate", str(file))
    assert seen.status == 2 and "and 4990 more" in seen.err and len(asked) == errors.MOST_EXPLAINED


@pytest.mark.parametrize(("text", "key", "line"), [
    ('bearing = [1]\n[machine]\nname = "x"\n', "bearing[0]", 1),
    (BASIC.replace("= 5.6", "= 5.6\nhandle = [1]"), "machine.handle[0]", 6),
    (SCENE.partition("[[")[0] + "race = [1]\n", "scene.race[0]", 12),
    (BEARINGS + '[expected]\n"simulation.²" = 1\n', 'expected."simulation.²"', 15),
    (BEARINGS + f'[expected]\n"fits.{"1" * 5000}.x" = 1\n', 'expected."fits.111', 15),
    (BEARINGS + "[expected]\nstatus = 2020-01-01\n", "expected.status", 15),
    (BEARINGS + "[expected]\nstatus = 07:32:00\n", "expected.status", 15),
    (BEARINGS + "[expected]\nstatus = [1, [nan]]\n", "expected.status", 15),
    (BEARINGS + f"[expected]\nstatus = [1{'0' * 400}]\n", "expected.status", 15),
    (BEARINGS + "[expected]\nstatus = [{a = 1}]\n", "expected.status", 15),
])  # fmt: skip
def test_odd_entries_are_wrong_input(tmp_path: Path, text: str, key: str, line: int) -> None:
    file = tmp_path / FILE
    file.write_text(text, encoding="utf-8")
    for arguments in (("validate", str(file)), ("verify", str(file)), ("verify", str(tmp_path), "--json")):
        if "[scene]" in text and arguments[0] == "verify":
            continue
        seen = abu(*arguments)
        if "[expected]" not in text and arguments[1] == str(tmp_path):
            assert "no file with [expected]" in seen.err
            continue
        assert seen.status == 2 and f"{file}:{line}: {key}" in seen.err and "bug" not in seen.err, seen
        assert seen.err.count("\n") >= 1


@pytest.mark.slow
def test_the_library_refuses_with_its_own_errors() -> None:
    machine, bearings = abu_calc.read("msh-230"), abu_calc.read("mmg-3200k-knife-shaft")
    scene = subject_of(machine).scene
    for duration in (1e12, 1e300):
        with pytest.raises(abu_calc.InputError, match="duration"):
            abu_calc.simulate(machine, duration_s=duration)
        long = type(scene)(**{**vars(scene), "duration": duration})
        for study in (abu_calc.simulate, simulate):
            with pytest.raises(abu_calc.InputError, match="duration"):
                study(long)
    for refuse in (lambda: abu_calc.size(bearings), lambda: size(bearings.tables)):  # type: ignore[arg-type]
        with pytest.raises(abu_calc.InputError, match="whole machine"):
            refuse()
