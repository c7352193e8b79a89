"""Texts that could be misread say what they mean: suggestions, units, tiny values, singular and plural."""

import re
from functools import partial
from pathlib import Path

import pytest

from abu_calc.features.design import study
from abu_calc.inputs.reading import sources
from tests.cli.runner import abu, once

SMALL = (
    "--set", "wheel.imbalance_g_mm=0", "--set", "autobalancer.race_eccentricity_mm=0",
    "--set", "autobalancer.rolling_friction_mm=0", "--set", "run_up={time_s=1}",
)  # fmt: skip


def flat(text: str) -> str:
    """A text without its line breaks."""
    return " ".join(text.split())


@pytest.mark.parametrize(("grade", "nearest"), [("G17", "G16"), ("G1.1", "G1"), ("G90", "G100"), ("17", "G16")])
def test_the_nearest_balance_grade_is_nearest_by_its_number(grade: str, nearest: str) -> None:
    told = abu("validate", "avtovaz-707-222", "--set", f'wheel.balance_grade="{grade}"')
    assert told.status == 2 and f'The nearest is "{nearest}"' in told.err


@pytest.mark.parametrize(("options", "added"), [
    ((), "Add --bore, --outer and --width, or --designation, or name a machine file."),
    (("--bore", "20", "--chamfer", "1"), "Add --outer and --width, or --designation."),
])  # fmt: skip
def test_a_bearing_without_sizes_is_told_what_to_add(options: tuple[str, ...], added: str) -> None:
    told = abu("check-fit", *options)
    assert told.status == 2 and added in flat(told.err) and "found no" not in told.err


@pytest.mark.parametrize(("entry", "key"), [
    ("max_outer_diameter_mm=25", "max_outer_diameter_mm"), ("max_width_mm=3", "max_width_mm"),
])  # fmt: skip
def test_an_action_does_not_name_the_key_that_was_given_as_another(entry: str, key: str) -> None:
    told = abu("size", "avtovaz-707-222", "--set", f"autobalancer.{entry}")
    assert told.status == 2 and "Increase it" in told.err and told.err.count(key) == 1 and "at least" in told.err


def test_a_file_beside_its_bare_name_is_suggested(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "ag125.toml").write_text(sources.text_of("msh-230"), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    told = abu("size", "ag125")
    assert told.status == 2 and "Did you mean ag125.toml?" in told.err


def test_a_mounted_point_is_not_asked_about_its_unit() -> None:
    told = abu("validate", "avtovaz-707-222", "--set", "wheel.diameter_mm=25")
    assert told.status == 0 and "larger than the wheel" in flat(told.out) and " cm" not in told.out


@pytest.mark.slow
def test_values_below_the_noise_are_bounds() -> None:
    for command in ("simulate", "levels"):
        for told in (once(command, "avtovaz-707-222", *SMALL), once(command, "avtovaz-707-222", *SMALL, "--full")):
            assert not re.search(r"\de-\d\d? *(mm|µm|°)|-\d+(\.\d+)? dB(?! (below|above))|± 0(\.0)? dB", told.out)


@pytest.mark.slow
def test_no_uncertainty_of_nothing_is_told() -> None:
    for name in ("avtovaz-707-222", "avtovaz-707-305"):
        assert not re.search(r"± *0(\.0)? dB", flat(once("grinding", name, "--full").out))


@pytest.mark.hard
def test_the_sheet_counts_one_entry_as_one(tmp_path: Path) -> None:
    drawing = tmp_path / "section.svg"
    assert abu("size", "avtovaz-707-370", "--set", "machine.mass_kg=5.4", "--output", str(drawing)).status == 0
    text = drawing.read_text(encoding="utf-8")
    assert "changed: machine.mass_kg = 5.4" in text and "1 entries" not in text


@pytest.mark.slow
@pytest.mark.parametrize(("name", "told"), [("msh-230", False), ("avtovaz-707-222", True)])
def test_only_a_horizontal_spindle_has_a_speed_that_carries_balls_over(name: str, told: bool) -> None:
    text = once("size", name, "--full").out
    assert ("carry-over speed of the balls" in text) is told
    assert re.search(r"ring would grow by [\d.]+ µm", flat(text))


LITTLE = (
    "--set", "machine.mass_kg=1.9", "--set", "machine.speed_rpm=11000", "--set", "wheel.imbalance_g_mm=30",
    "--set", "autobalancer.max_outer_diameter_mm=50", "--set", "autobalancer.max_width_mm=14",
    "--set", "autobalancer.bore_diameter_mm=14",
)  # fmt: skip
"""A small machine whose race eccentricity leaves almost as much as its wheel's imbalance moves."""


@pytest.mark.slow
def test_a_small_benefit_is_named_at_the_top_and_an_action_finer_than_practice_says_so(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    usual = once("size", "msh-230")
    monkeypatch.setattr(study, "size", partial(study.size, starts="none"))  # start cases change none of this
    little = abu("size", "msh-230", *LITTLE)
    assert "DOES NOT SUIT: the autobalancer does not lower the vibration" in flat(little.out[:400])
    some = abu("size", "msh-230", *LITTLE, "--set", "wheel.imbalance_g_mm=35")
    assert "Vibration at the wheel plane" in flat(usual.out) and "dB only" not in flat(usual.out)
    for out in (little.out, some.out):
        finest = [float(value) for value in re.findall(r"race_eccentricity_mm=([\d.]+)", out)]
        finer = "finer than usual: careful work keeps a race within 0.005 mm" in flat(out)
        assert finer is (min(finest, default=1.0) < 0.005)


@pytest.mark.hard
def test_an_action_is_no_command_that_repeats_a_start_case() -> None:
    """The whole report has the command, with the file and the entries of the result."""
    options = ("--set", "limits.quiet_time_s=0.6")
    for words in ((), ("--full",)):
        assert "To repeat the" not in once("size", "avtovaz-707-305", *options, *words).out
    whole = flat(once("size", "avtovaz-707-305", *options, "--full").out)
    told = re.search(r"ABU702, slowest: `abu simulate avtovaz-707-305 --set limits.quiet_time_s=0.6 .*?`", whole)
    assert told and "FILE" not in told[0]


@pytest.mark.slow
def test_no_report_names_a_file_that_is_not_there() -> None:
    for command in ("size", "grinding", "simulate"):
        assert not re.search(r"`abu [^`]*\bFILE\b", once(command, "avtovaz-707-222").out)


def test_a_valid_file_counts_its_defaults(tmp_path: Path) -> None:
    file = tmp_path / "new.toml"
    assert abu("init", "--all-keys", str(file)).status == 0
    assert "valid, 1 default used" in flat(abu("validate", str(file)).out)
    hands = file.read_text("utf-8").replace('model = "springs"', 'model = "hands"')
    file.write_text(hands, encoding="utf-8")
    told = flat(abu("validate", str(file)).err)
    assert "takes no natural_frequencies_hz and no damping_ratios" in told


@pytest.mark.slow
def test_the_required_capacity_names_margin_and_imbalance() -> None:
    told = re.search(
        r"g·mm, 1.[2-9]\d* × what is needed: imbalance ([\d.]+) \+ race ([\d.]+)", flat(once("size", "msh-230").out)
    )
    result = once("size", "msh-230", "--json").document["result"]
    assert told is not None
    assert float(told[1]) == pytest.approx(result["imbalance_g_mm"], rel=1e-3)
    assert float(told[1]) + float(told[2]) == pytest.approx(result["required_capacity_g_mm"], rel=1e-2)


def test_the_list_of_subjects_fits_a_screen_and_names_every_check() -> None:
    from abu_calc.foundation.checks import CHECK_CODES

    short = abu("explain").out
    assert len(short.splitlines()) <= 48 and all(code in short for code in CHECK_CODES)
    assert len(abu("explain", "--full").out.splitlines()) > 100


def test_each_mark_of_the_picture_of_accuracy_stands_for_one_method() -> None:
    from abu_calc.features.accuracy.view import MARKS

    lower = [mark.lower() for name, mark in MARKS.items() if name not in ("closed-form", "envelope")]
    assert len({*MARKS.values(), *lower}) == len(MARKS) + len(lower)
