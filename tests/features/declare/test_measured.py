"""`abu declare --recordings`: fifteen recordings whose value and K are known, and files that are wrong."""

import math
import re
import wave as wave_files
from pathlib import Path
from statistics import fmean, stdev

import numpy as np
import pytest

import abu_calc
from abu_calc import InputError
from abu_calc.features.declare.measured import MeasuredDeclareResult, declare_recordings
from abu_calc.features.declare.read import read_recordings
from tests.features.declare.recordings import AXES, MV, RATE, TOTAL, run_file, wave

SIZES = {
    (operator, run): 2.0 * (1 + 0.2 * (operator - 1)) * (1 + 0.02 * (run - 3))
    for operator in (0, 1, 2)
    for run in range(1, 6)
}
"""Size of each run: operators differ by 20 %, runs by 2 %."""


def listed(folder: Path, head: str = "", more: str = "", **how: object) -> str:
    """A file that lists the fifteen recordings, which are written beside it."""
    entries = []
    for (operator, run), size in SIZES.items():
        name = f"operator{operator}-run{run}.csv"
        run_file(folder, name, size, **how)  # type: ignore[arg-type]
        entries.append(
            f'[[recording]]\nfile = "{name}"\noperator = "{"ABC"[operator]}"\nrun = {run}\nhandle = "front"\n{more}'
        )
    path = folder / "recordings.toml"
    path.write_text(head + "\n" + "\n".join(entries), encoding="utf-8")
    return str(path)


def evaluated(path: str) -> MeasuredDeclareResult:
    return declare_recordings(read_recordings(path))


def by_list(folder: Path, *entries: str) -> MeasuredDeclareResult:
    """By a list of recordings that has these entries."""
    path = folder / "list.toml"
    path.write_text("".join(f"[[recording]]\n{entry}\n" for entry in entries), encoding="utf-8")
    return evaluated(str(path))


def wav_file(folder: Path, name: str, channels: np.ndarray) -> str:
    """Of one column a channel, 50 m/s² at full scale; the entry of a list."""
    with wave_files.open(str(folder / name), "wb") as file:
        file.setnchannels(channels.shape[1])
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes(np.clip(channels / 50 * 32767, -32768, 32767).astype("<i2").tobytes())
    return f'file = "{name}"\nscale = 50.0\nquantity = "acceleration"'


@pytest.mark.slow
def test_fifteen_recordings_have_their_value(tmp_path: Path) -> None:
    """a_hd = mean of the operators' means; s_R is theirs, since it exceeds 0.06 a + 0.3."""
    result = evaluated(listed(tmp_path))
    means = [TOTAL * fmean(SIZES[operator, run] for run in range(1, 6)) for operator in (0, 1, 2)]
    value, spread = fmean(means), stdev(means)
    assert spread < 0.06 * value + 0.3
    assert result.a_hd_m_per_s2 == pytest.approx(value, rel=1e-4)
    assert result.s_R_m_per_s2 == pytest.approx(0.06 * value + 0.3, rel=1e-4)
    assert result.K_m_per_s2 == pytest.approx(1.65 * (0.06 * value + 0.3), rel=1e-4)
    runs = [TOTAL * SIZES[1, run] for run in range(1, 6)]
    assert result.coefficient_of_variation == pytest.approx(stdev(runs) / fmean(runs), rel=1e-3)
    assert (result.handle, result.factor, len(result.runs)) == ("front", 1.0, 15)
    assert result.runs[7].a_hv_m_per_s2 == pytest.approx(TOTAL * SIZES[1, 3], rel=1e-4)
    assert [axis.a_hw_m_per_s2 for axis in result.runs[0].axes] == pytest.approx(
        [share * SIZES[0, 1] for share in AXES], rel=1e-4
    )
    assert {check.code: check.status for check in result.checks} == {
        "ABU441": "pass", "ABU442": "pass", "ABU443": "warn", "ABU444": "pass", "ABU445": "pass",
    }  # fmt: skip


@pytest.mark.slow
def test_millivolts_and_decimal_commas(tmp_path: Path) -> None:
    plain = evaluated(listed(tmp_path))
    path = listed(tmp_path, more='sensitivity = "100 mV/g"\n', unit="mV", per_unit=MV, decimal=",")
    assert evaluated(path).a_hd_m_per_s2 == pytest.approx(plain.a_hd_m_per_s2, rel=1e-6)


@pytest.mark.slow
def test_a_machine_that_balances_itself_declares_more(tmp_path: Path) -> None:
    path = listed(tmp_path, head="[type_test]\nautomatic_balancing = true")
    result = evaluated(path)
    assert result.declared_m_per_s2 == pytest.approx(1.3 * (result.a_hd_m_per_s2 or 0.0))
    spread = 1.3 * stdev(TOTAL * fmean(SIZES[operator, run] for run in range(1, 6)) for operator in (0, 1, 2))
    assert spread > 0.06 * (result.declared_m_per_s2 or 0.0) + 0.3
    assert result.K_m_per_s2 == pytest.approx(1.65 * spread, rel=1e-4)
    assert declare_recordings(read_recordings(path)).factor == 1.3


@pytest.mark.slow
def test_operators_that_differ_decide_the_uncertainty(tmp_path: Path) -> None:
    names = []
    for operator, size in (("A", 1.0), ("B", 3.0), ("C", 5.0)):
        for run in (1, 2):
            name = f"{operator}{run}.csv"
            run_file(tmp_path, name, size * (1 + 0.01 * run))
            names.append(f'file = "{name}"\noperator = "{operator}"')
    result = by_list(tmp_path, *names)
    spread = TOTAL * stdev([1.015, 3 * 1.015, 5 * 1.015])
    assert result.s_R_m_per_s2 == pytest.approx(spread, rel=1e-4)
    assert {check.code: check.status for check in result.checks}["ABU442"] == "warn"


@pytest.mark.slow
def test_the_highest_handle_decides(tmp_path: Path) -> None:
    """One file holds both handles, named by its columns."""
    front, rear = (wave(size) for size in (1.0, 2.0))
    rows = np.column_stack([front[0], front[1], rear[1]])
    for run in (1, 2):
        np.savetxt(tmp_path / f"{run}.csv", rows * [1, run, run], delimiter=",", comments="", fmt="%.10g",
                   header="t_s,front_ax_m_per_s2,rear_ax_m_per_s2")  # fmt: skip
    result = declare_recordings([str(tmp_path / f"{run}.csv") for run in (1, 2)])
    assert result.handle == "rear"
    assert {each.name: each.a_hv_m_per_s2 for each in result.handles} == pytest.approx(
        {"front": 1.5, "rear": 3.0}, rel=1e-3
    )


@pytest.mark.slow
def test_axes_in_files_of_their_own(tmp_path: Path) -> None:
    entries = []
    for run in (1, 2):
        for axis, share in zip("xyz", AXES, strict=True):
            run_file(tmp_path, f"{axis}{run}.csv", share / AXES[0], axes=1)
            entries.append(f'file = "{axis}{run}.csv"\nrun = {run}\naxis = "{axis}"')
    result = by_list(tmp_path, *entries)
    assert result.a_hd_m_per_s2 == pytest.approx(TOTAL, rel=1e-4)
    assert [axis.name for axis in result.runs[0].axes] == ["x", "y", "z"]


@pytest.mark.slow
def test_calibrator_runs_judge_each_channel(tmp_path: Path) -> None:
    """Channel x reads 8 % too much, y is right."""
    t = np.arange(2 * RATE) / RATE
    tone = 10 * math.sqrt(2) * np.sin(2 * math.pi * 159.2 * t)
    np.savetxt(tmp_path / "calibrator.csv", np.column_stack([t, 1.08 * MV * tone, MV * tone]), delimiter=",",
               comments="", fmt="%.10g", header="t_s,ax_mV,ay_mV")  # fmt: skip
    path = Path(listed(tmp_path))
    path.write_text(path.read_text() + '\n[[calibration]]\nfile = "calibrator.csv"\nsensitivity = "100 mV/g"\n')
    result = evaluated(str(path))
    check = next(check for check in result.checks if check.code == "ABU443")
    assert check.status == "fail" and check.remedy is not None and "1.08" in check.remedy
    assert [channel.ratio for channel in result.calibration] == pytest.approx([1.08, 1.0], rel=2e-3)
    assert result.status == "fail"


@pytest.mark.slow
def test_an_overload_fails(tmp_path: Path) -> None:
    path = listed(tmp_path)
    run_file(tmp_path, "operator0-run1.csv", 2.0, limit=8.0)
    check = next(check for check in evaluated(path).checks if check.code == "ABU444")
    assert check.status == "fail" and "operator A, run 1, front, a" in check.message


def test_a_clipped_wav_file_fails_and_names_its_channel(tmp_path: Path) -> None:
    """Other commands refuse such a file; a type test keeps the other runs and says which one to repeat."""
    _, values = wave(1.0, seconds=1.5)
    files = (wav_file(tmp_path, f"{gain}.wav", np.column_stack([values, gain * values])) for gain in (1, 40))
    result = by_list(tmp_path, *files)
    check = next(check for check in result.checks if check.code == "ABU444")
    assert (result.status, check.status) == ("fail", "fail")
    assert "run 2, handle, channel 2" in check.message and "channel 1" not in check.message
    assert [run.overload for run in result.runs] == [False, True]
    assert [axis.overload for axis in result.runs[1].axes] == [False, True]


def test_a_recording_listed_twice_warns(tmp_path: Path) -> None:
    """Its series would scatter by nothing."""
    run_file(tmp_path, "a.csv", 2.0)
    result = by_list(tmp_path, *['file = "a.csv"'] * 2)
    check = next(check for check in result.checks if check.code == "ABU442")
    assert check.status == "warn"
    assert "run 2, handle: the same recording as operator 1, run 1" in check.message


@pytest.mark.parametrize(
    ("heads", "row", "words"),
    [
        ("ax_m_per_s2,ax_m_per_s2,az_m_per_s2", None, "same name"),
        ("ax_m_per_s2,ay_m_per_s2,az_m_per_s2", "0", "same number from start to end"),
        ("a1_m_per_s2,a2_m_per_s2,a3_m_per_s2,a4_m_per_s2", None, "three axes at most"),
    ],
)
def test_advice_on_recordings_names_no_option_of_another_command(
    tmp_path: Path, heads: str, row: str | None, words: str
) -> None:
    """A doubled axis, a dead channel, too many columns: `abu declare` has neither --channels nor --handle."""
    t, values = wave(1.0)
    columns = [values if row is None else 0 * values + float(row)] * (heads.count(",") + 1)
    path = tmp_path / "a.csv"
    np.savetxt(path, np.column_stack([t, *columns]), delimiter=",", comments="", header=f"t_s,{heads}", fmt="%.9g")
    with pytest.raises(InputError, match=words) as caught:
        declare_recordings([str(path)])
    assert caught.value.remedy is not None and not re.search(r"--(?!recordings)", caught.value.remedy)


def test_remarks_on_recordings_name_no_option_of_another_command(tmp_path: Path) -> None:
    t, values = wave(1.0)
    for run in (1, 2):
        np.savetxt(tmp_path / f"{run}.csv", np.column_stack([t, run * values, values]), delimiter=",", comments="",
                   header="t_s,ax,ay", fmt="%.9g")  # fmt: skip
    result = declare_recordings([str(tmp_path / f"{run}.csv") for run in (1, 2)])
    told = [remark for remark in result.warnings if "[[recording]]" in remark]
    assert told and not any(re.search(r"--(scale|handle|quantity|channels)", remark) for remark in result.warnings)


def test_a_unit_that_is_not_known_is_refused(tmp_path: Path) -> None:
    """Inches per second squared are no metres."""
    run_file(tmp_path, "a.csv", 2.0)
    text = (tmp_path / "a.csv").read_text(encoding="utf-8").split("\n", 1)
    (tmp_path / "a.csv").write_text("t_s,ax [in/s2],ay [in/s2],az [in/s2]\n" + text[1], encoding="utf-8")
    with pytest.raises(InputError, match="unit that is not known") as caught:
        declare_recordings([str(tmp_path / "a.csv")])
    assert caught.value.place.line == 1


@pytest.mark.slow
def test_runs_that_scatter_fail(tmp_path: Path) -> None:
    path = listed(tmp_path)
    run_file(tmp_path, "operator1-run3.csv", 5.0)
    result = evaluated(path)
    check = next(check for check in result.checks if check.code == "ABU441")
    assert check.status == "fail" and "Operator B" in check.message
    assert (result.coefficient_of_variation or 0.0) > 0.15


@pytest.mark.slow
def test_small_values_may_scatter(tmp_path: Path) -> None:
    """A standard deviation below 0.3 m/s² suffices, whatever the coefficient of variation."""
    for run, size in enumerate((0.2, 0.3, 0.4, 0.3, 0.2), 1):
        run_file(tmp_path, f"{run}.csv", size)
    result = declare_recordings([str(tmp_path / f"{run}.csv") for run in range(1, 6)])
    assert (result.coefficient_of_variation or 0.0) > 0.15
    assert next(check for check in result.checks if check.code == "ABU441").status == "pass"


def test_a_single_run_is_not_evaluated(tmp_path: Path) -> None:
    result = declare_recordings([run_file(tmp_path, "one.csv", 1.0)])
    assert result.a_hd_m_per_s2 == pytest.approx(TOTAL, rel=1e-4)
    assert result.status == "not-done"


@pytest.mark.slow
@pytest.mark.parametrize("axes", [1, 2])
def test_axes_that_are_missing_warn(tmp_path: Path, axes: int) -> None:
    result = evaluated(listed(tmp_path, axes=axes))
    check = next(check for check in result.checks if check.code == "ABU442")
    assert check.status == "warn" and f"{axes} of 3 axes" in check.message


@pytest.mark.slow
def test_a_run_too_short_leaves_no_value(tmp_path: Path) -> None:
    path = listed(tmp_path)
    run_file(tmp_path, "operator0-run1.csv", 2.0, seconds=0.3)
    result = evaluated(path)
    assert result.a_hd_m_per_s2 is None and result.K_m_per_s2 is None
    assert result.status == "not-done"
    assert next(check for check in result.checks if check.code == "ABU445").status == "not-done"


def test_wav_files_with_a_scale(tmp_path: Path) -> None:
    _, values = wave(1.0, seconds=1.5)
    files = (wav_file(tmp_path, f"{run}.wav", values[:, None]) for run in (1, 2))
    assert by_list(tmp_path, *files).a_hd_m_per_s2 == pytest.approx(1.0, rel=1e-3)


WRONG = {
    "millivolts without sensitivity": ('file = "mv.csv"', "sensitivity of its sensor"),
    "no such file": ('file = "nothing.csv"', "cannot be read"),
    "a sensitivity of nothing": ('file = "mv.csv"\nsensitivity = 0', "not a sensitivity"),
    "two sensitivities for three columns": ('file = "mv.csv"\nsensitivity = [10.0, 10.0]', "sensitivity of its sensor"),
    "an unknown key": ('file = "good.csv"\nhandel = "front"', "handel"),
    "an axis of three columns": ('file = "good.csv"\nrun = 1\naxis = "x"', "one axis"),
    "an axis without a run": ('file = "good.csv"\naxis = "x"', "run"),
    "a run of zero": ('file = "good.csv"\nrun = 0', "run"),
    "an operator that is no name": ('file = "good.csv"\noperator = true', "operator"),
    "no such column": ('file = "good.csv"\ncolumns = ["aw_m_per_s2"]', "no such channel"),
    "scale and sensitivity": ('file = "mv.csv"\nscale = 2.0\nsensitivity = 10.0', "both a scale"),
    "the same run twice": ('file = "good.csv"\nrun = 1\n[[recording]]\nfile = "good.csv"\nrun = 1', "twice"),
    "a quantity unknown": ('file = "good.csv"\nquantity = "noise"', "quantity"),
}


@pytest.mark.parametrize(("entry", "word"), WRONG.values(), ids=WRONG)
def test_wrong_lists_are_refused(tmp_path: Path, entry: str, word: str) -> None:
    run_file(tmp_path, "good.csv", 1.0)
    run_file(tmp_path, "mv.csv", 1.0, unit="mV", per_unit=MV)
    with pytest.raises(InputError, match=word):
        by_list(tmp_path, *entry.split("[[recording]]"))


@pytest.mark.parametrize("text", ["", "[type_test]\nname = 'x'\n", "[[calibration]]\nfile = 'a.csv'\n"])
def test_a_list_without_recordings_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "list.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError):
        evaluated(str(path))


@pytest.mark.slow
def test_lists_and_recordings_do_not_mix(tmp_path: Path) -> None:
    path, file = listed(tmp_path), run_file(tmp_path, "a.csv", 1.0)
    with pytest.raises(InputError, match="stands alone"):
        abu_calc.declare_recordings([path, file])


@pytest.mark.parametrize("value", ["true", "[]", '""', "{}", "[true]", '[""]', "{ ax_mV = true }", "0", '"5 V"'])
def test_what_is_no_sensitivity_is_refused_by_its_line(value: str) -> None:
    with pytest.raises(InputError, match="not a sensitivity") as caught:
        read_recordings(f'[[recording]]\nfile = "a.csv"\nsensitivity = {value}\n')
    assert (caught.value.place.line, caught.value.place.key) == (3, "recording[0].sensitivity")
