"""Every way to get a machine file wrong: the key, the line and the remedy are told, and nothing is guessed."""

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.reading.errors import MOST_LISTED, SpecErrors
from tests.inputs.samples import BASIC, BEARINGS, FULL, all_of, full_text, path_of, read, refused

MASS, LAYOUT, NAME = "mass_kg = 5.6", 'layout = "straight"', 'name = "straight grinder"'
DIAMETER, IMBALANCE, WIDTH = "diameter_mm = 150.0", "imbalance_g_mm = 150.0", "max_width_mm = 32.0"
FREQUENCIES, FIT, SIZE, SPEED = "[2.5, 2.5]", 'shaft_fit = "k6"', 'designation = "6203"', "speed_rpm = 5800"
LIMITS = "[limits]"

# What is replaced in the basic file, by what, the line and key that must be named, words that must be told.
CASES: list[tuple[str, str, int | None, str | None, tuple[str, ...]]] = [
    # not TOML
    (MASS, "mass_kg = 5,6", 5, "machine.mass_kg", ("a comma in a number", "write 5.6 (the decimal sign is a point)")),
    (MASS, "mass_kg = 11,000", 5, "machine.mass_kg", ("11000 if the comma groups thousands", "11.000 if it is")),
    (MASS, "mass_kg = 1900 g", 5, "machine.mass_kg", ("write mass_kg = 1.9", 'or mass = "1900 g"')),
    (MASS, "mass_kg = 3 furlong", 5, "machine.mass_kg", ("a number in kg", "lb")),
    (MASS, "mass_kg = 5.6 kg", 5, "machine.mass_kg", ("a number with its unit", "write mass_kg = 5.6")),
    (MASS, "mass_kg = .5", 5, "machine.mass_kg", ("write 0.5",)),
    (MASS, "mass_kg = 5.", 5, "machine.mass_kg", ("write 5.0",)),
    (MASS, "mass_kg = 05.6", 5, "machine.mass_kg", ("leading zeros", "write 5.6")),
    (MASS, "mass_kg = 5 600", 5, "machine.mass_kg", ("gaps",)),
    (MASS, "mass_kg =", 5, "machine.mass_kg", ("missing", "leave the key out")),
    (MASS, "mass_kg = # later", 5, "machine.mass_kg", ("missing",)),
    (MASS, "mass_kg = " + "9" * 5000, 5, "machine.mass_kg", ("thousands of digits", "shorter")),
    (MASS, "mass_kg 5.6", 5, None, ("write key = value",)),
    (MASS, "mass_kg: 5.6", 5, None, ("write mass_kg = 5.6",)),
    (MASS, "mass_kg = True", 5, "machine.mass_kg", ("write true",)),
    (MASS, "mass_kg = none", 5, "machine.mass_kg", ("leave the key out",)),
    (MASS, "mass_kg = 5.6\nmass_kg = 5.7", 6, "machine.mass_kg", ("twice", "line 5")),
    (MASS, 'mass_kg = 5.6\n"mass_kg" = 5.7', 6, "machine.mass_kg", ("twice", "line 5")),
    (LAYOUT, "layout = straight", 4, "machine.layout", ("without quotes", 'write "straight"')),
    (LAYOUT, 'layout = "straight', 4, "machine.layout", ("closing quote",)),
    (NAME, 'name = "C:\\users"', 3, "machine.name", ("backslash", "single quotes")),
    (FREQUENCIES, "[2.5, 2.5", 11, "suspension.natural_frequencies_hz", ("close every bracket",)),
    (FREQUENCIES, "[2.5 2.5]", 11, "suspension.natural_frequencies_hz", ("commas between",)),
    ("[wheel]", "[wheel", 14, None, ("[wheel]",)),
    ("[wheel]", "[machine]", 14, "machine", ("table stands twice", "line 2")),
    # unknown names
    (MASS, "mass_g = 5600", 5, "machine.mass_g", ("unknown key", "mass_kg", "in kg instead of g")),
    (MASS, "mass = 5.6", 5, "machine.mass", ("mass_kg", "unit stands in the key")),
    (MASS, "mas_kg = 5.6", 5, "machine.mas_kg", ("nearest known key is mass_kg",)),
    (MASS, "MASS_KG = 5.6", 5, "machine.MASS_KG", ("nearest known key is mass_kg",)),
    (MASS, "Mass-kg = 5.6", 5, "machine.Mass-kg", ("nearest known key is mass_kg",)),
    (DIAMETER, "diameter_cm = 15", 16, "wheel.diameter_cm", ("diameter_mm", "mm instead of cm")),
    (DIAMETER, DIAMETER + "\npower_W = 3", 17, "wheel.power_W", ("belongs in [machine]",)),
    (DIAMETER, DIAMETER + "\npress_force_N = 3", 17, "wheel.press_force_N", ("belongs in [grinding]",)),
    (DIAMETER, DIAMETER + "\nwidth_mm = 3", 17, "wheel.width_mm", ("belongs in [[bearing]]",)),
    (DIAMETER, DIAMETER + "\npress_force_n = 3", 17, "wheel.press_force_n", ("press_force_N of [grinding]",)),
    (DIAMETER, DIAMETER + "\nqqq = 3", 17, "wheel.qqq", ("known keys of [wheel]", "runout_tir_mm")),
    ("# a straight grinder", "mass_kg = 5", 1, "mass_kg", ("belongs in [machine] or [wheel]",)),
    ("# a straight grinder", "foo = 5", 1, "foo", ("every key belongs in a table",)),
    ("# a straight grinder", "[foo]", 1, "foo", ("unknown table", "swing_arm")),
    ("[wheel]", "[whel]", 14, "whel", ("unknown table", "[wheel]")),
    ("[[bearing]]", "[[bearings]]", 23, "bearings", ("unknown table", "[[bearing]]")),
    (LIMITS, '[limits]\n"a b" = 1', 28, 'limits."a b"', ("unknown key",)),
    # wrong kinds
    (MASS, 'mass_kg = "5.6"', 5, "machine.mass_kg", ("number", "5.6 without quotes")),
    (MASS, 'mass_kg = "5,6"', 5, "machine.mass_kg", ("number", "write 5.6 (", "without quotes")),
    (MASS, 'mass_kg = "5600 g"', 5, "machine.mass_kg", ('write mass_kg = 5.6, or mass = "5600 g"',)),
    (MASS, "mass_kg = true", 5, "machine.mass_kg", ("number", "found true")),
    (MASS, "mass_kg = [5.6]", 5, "machine.mass_kg", ("not a list",)),
    (MASS, "mass_kg = 2020-01-01", 5, "machine.mass_kg", ("number", "2020-01-01")),
    (MASS, "mass_kg = {}", 5, "machine.mass_kg", ("number", "a table")),
    (MASS, "mass_kg = 0x" + "f" * 5000, 5, "machine.mass_kg", ("number", "huge integer")),
    (MASS, "mass_kg = 1" + "0" * 400, 5, "machine.mass_kg", ("number",)),
    (NAME, "name = 230", 3, "machine.name", ("text", 'write "230"')),
    (SIZE, "designation = 6203", 24, "bearing[0].designation", ("text", 'write "6203"')),
    (FIT, "bearing_class = 0", 25, "bearing[0].bearing_class", ("text", 'write "0"')),
    (WIDTH, WIDTH + "\nball_count = 4.0", 22, "autobalancer.ball_count", ("whole number", "write 4")),
    (LIMITS, "[grinding]\nrotation_sense = true\n[limits]", 28, "grinding.rotation_sense", ("whole number",)),
    ("[suspension]", "[[suspension]]", 9, "suspension", ("one bracket",)),
    ("[[bearing]]", "[bearing]", 23, "bearing", ("two brackets",)),
    (LIMITS, '[machine.handle]\nname = "a"\n[limits]', 27, "machine.handle", ("[[machine.handle]]",)),
    ("# a straight grinder", "grinding = 5", 1, "grinding", ("write [grinding] on a line",)),
    ("# a straight grinder", "expected = 5", 1, "expected", ("a table is expected",)),
    (SPEED, SPEED + "\nspeed_range_rpm = 5800", 7, "machine.speed_range_rpm", ("list",)),
    # out of bounds
    (MASS, "mass_kg = nan", 5, "machine.mass_kg", ("finite", "nan")),
    (MASS, "mass_kg = -inf", 5, "machine.mass_kg", ("finite", "-inf")),
    (MASS, "mass_kg = 0", 5, "machine.mass_kg", ("at least 0.001 kg",)),
    (MASS, "mass_kg = 20001", 5, "machine.mass_kg", ("at most 20000 kg",)),
    (SPEED, "speed_rpm = 300001", 6, "machine.speed_rpm", ("at most 300000 rpm",)),
    (FREQUENCIES, "[2.5, 0]", 11, "suspension.natural_frequencies_hz[1]", ("above 0 Hz",)),
    (FREQUENCIES, "0", 11, "suspension.natural_frequencies_hz", ("above 0 Hz", "found 0")),
    ("damping_ratios = [0.5, 0.5]", "damping_ratios = -0.1", 12, "suspension.damping_ratios", ("at least 0",)),
    (WIDTH, WIDTH + "\nball_count = 1", 22, "autobalancer.ball_count", ("at least 2",)),
    (WIDTH, WIDTH + "\ncapacity_margin = 0.9", 22, "autobalancer.capacity_margin", ("at least 1",)),
    (WIDTH, WIDTH + "\nrace_hardness_HRC = 19", 22, "autobalancer.race_hardness_HRC", ("at least 20 HRC",)),
    (LIMITS, "[swing_arm]\ncontact_angle_deg = 181\n[limits]", 28, "swing_arm.contact_angle_deg", ("at most 180 °",)),
    # wrong words and lengths
    (LAYOUT, 'layout = "strait"', 4, "machine.layout", ('"straight", "face" or "angle"', 'nearest is "straight"')),
    (LAYOUT, "layout = 5", 4, "machine.layout", ("straight",)),
    (NAME, 'name = ""', 3, "machine.name", ("empty",)),
    (IMBALANCE, 'balance_grade = "G6,3"', 17, "wheel.balance_grade", ('nearest is "G6.3"',)),
    (IMBALANCE, "balance_grade = 6.3", 17, "wheel.balance_grade", ('nearest is "G6.3"',)),
    (LIMITS, "[grinding]\nrotation_sense = 2\n[limits]", 28, "grinding.rotation_sense", ("-1 or 1",)),
    (FIT, 'shaft_fit = "K6"', 25, "bearing[0].shaft_fit", ("small letters", 'such as "k6"', 'write "k6"')),
    (FIT, 'housing_fit = "h7"', 25, "bearing[0].housing_fit", ("capitals", 'write "H7"')),
    (FIT, 'shaft_fit = "k"', 25, "bearing[0].shaft_fit", ("letters and a number",)),
    (FREQUENCIES, "[2,5, 2,5]", 11, "suspension.natural_frequencies_hz", ("too many", "decimal sign is a point")),
    (FREQUENCIES, "[]", 11, "suspension.natural_frequencies_hz", ("too few",)),
    (IMBALANCE, "measured_level_db = []", 17, "wheel.measured_level_db", ("too few",)),
    (IMBALANCE, 'measured_level_db = [110, "111"]', 17, "wheel.measured_level_db[1]", ("111 without quotes",)),
    # missing
    (MASS + "\n", "", 2, "machine.mass_kg", ("missing", "add mass_kg = …, such as 5.6")),
    (DIAMETER + "\n", "", 14, "wheel.diameter_mm", ("missing", "add diameter_mm")),
    (WIDTH + "\n", "", 19, "autobalancer.max_width_mm", ("missing",)),
    ('[suspension]\nmodel = "springs"\nnatural_frequencies_hz = [2.5, 2.5]\ndamping_ratios = [0.5, 0.5]\n', "", None,
     "suspension", ("table [suspension] is missing", "abu init")),
    # rules between keys
    ("natural_frequencies_hz = [2.5, 2.5]\n", "", 9, "suspension.natural_frequencies_hz", ("springs", "add natural")),
    ("damping_ratios = [0.5, 0.5]\n", "", 9, "suspension.damping_ratios", ("springs", "add damping_ratios")),
    ('"springs"', '"hands"', 11, "suspension.natural_frequencies_hz", ("hands", "ISO 10068", "leave")),
    (IMBALANCE + "\n", "", 14, "wheel", ("exactly one source", "found none", "imbalance_g_mm")),
    (IMBALANCE, IMBALANCE + '\nbalance_grade = "G16"', 18, "wheel.balance_grade", ("exactly one", "keep one")),
    (IMBALANCE, IMBALANCE + '\nmeasured_at = "front"', 18, "wheel.measured_at", ("measured value only",)),
    (IMBALANCE, 'measured_level_db = 111\nmeasured_at = "front"', 18, "wheel.measured_at", ("no handle",)),
    (DIAMETER, DIAMETER + "\nrunout_mm = 0.04\nrunout_tir_mm = 0.08", 18, "wheel.runout_tir_mm", ("keep one",)),
    (SPEED, SPEED + "\nspeed_range_rpm = [3000, 4000]", 7, "machine.speed_range_rpm", ("contain speed_rpm", "Widen")),
    (SPEED, SPEED + "\nspeed_range_rpm = [6000, 5000]", 7, "machine.speed_range_rpm", ("ascend", "[5000, 6000]")),
    (SPEED, SPEED + "\ntransverse_inertia_kg_m2 = 0.1", 7, "machine.transverse_inertia_kg_m2",
     ("only together", "add center_of_mass_to_wheel_mm")),
    (SPEED, SPEED + "\ncenter_of_mass_to_wheel_mm = 200", 7, "machine.center_of_mass_to_wheel_mm",
     ("only together", "add transverse_inertia_kg_m2")),
    (LIMITS, '[[machine.handle]]\nname = "a"\nfrom_center_of_mass_mm = 1\n[[machine.handle]]\nname = "a"\n'
     "from_center_of_mass_mm = 2\n[limits]", 31, "machine.handle[1].name", ("two handles",)),
    (LIMITS, "[run_up]\npause_speed_rpm = 5800\n[limits]", 28, "run_up.pause_speed_rpm", ("below 5800 rpm",)),
    (LIMITS, "[run_up]\npause_speed_rpm = 900\n[motor]\n[limits]", 28, "run_up.pause_speed_rpm", ("beside [motor]",)),
    (LIMITS, "[motor]\nno_load_speed_rpm = 3000\n[limits]", 28, "motor.no_load_speed_rpm", ("at least 5800 rpm",)),
    (WIDTH, WIDTH + "\nbore_diameter_mm = 68", 22, "autobalancer.bore_diameter_mm",
     ("no room", "= 68", "bore_diameter_mm below max_outer_diameter_mm")),
    ("max_outer_diameter_mm = 68.0", "max_outer_diameter_mm = 20", 20, "autobalancer.max_outer_diameter_mm", ()),
    (SIZE + "\n", "", 23, "bearing[0].bore_mm", ("no size", "designation")),
    (SIZE, "bore_mm = 17\nwidth_mm = 12", 23, "bearing[0].outer_mm", ("is incomplete", "add outer_mm")),
    (SIZE, SIZE + "\nbore_mm = 17", 25, "bearing[0].bore_mm", ("both give the size", "keep")),
    (SIZE, "bore_mm = 40\nouter_mm = 40\nwidth_mm = 9", 25, "bearing[0].outer_mm", ("outer_mm must be above bore_mm",)),
    (SIZE, "bore_mm = 17\nouter_mm = 40\nwidth_mm = 12\nchamfer_mm = 6", 27, "bearing[0].chamfer_mm", ("no seat",)),
    (SIZE, "bore_mm = 17\nouter_mm = 40\nwidth_mm = 12\nshaft_bore_mm = 17", 24, "bearing[0].bore_mm", ("above",)),
    (LIMITS, "[expected]\na.b = 3\n[limits]", 28, "expected.a", ("whole path in quotes",)),
    (LIMITS, '[expected]\n"a.b" = nan\n[limits]', 28, 'expected."a.b"', ("finite",)),
    (LIMITS, '[expected]\n"a.b" = 3\n[expected.tolerance]\n"a.b" = -1\n[limits]', 30, 'expected.tolerance."a.b"',
     ("at least 0",)),
    (LIMITS, '[expected]\n"a.b" = 3\n[expected.tolerance]\n"a.c" = 1\n[limits]', 30, 'expected.tolerance."a.c"',
     ("no expected value",)),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "line", "key", "words"), CASES, ids=[f"{c[3]}: {c[1][:40]}" for c in CASES])
def test_a_wrong_file_is_told_with_line_key_and_remedy(
    tmp_path: Path, old: str, new: str, line: int | None, key: str | None, words: tuple[str, ...]
) -> None:
    assert old in BASIC
    text = BASIC.replace("\n" + old, "\n" + new, 1) if "\n" + old in BASIC else BASIC.replace(old, new, 1)
    error = refused(tmp_path, text)
    assert not isinstance(error, SpecErrors), str(error)
    assert (error.place.line, error.place.key) == (line, key), str(error)
    assert error.place.file == str(tmp_path / "m.toml")
    for word in words:
        assert word.casefold() in str(error).casefold(), str(error)
    assert len(str(error).splitlines()) <= 2


def test_all_faults_of_a_file_are_told_in_the_order_of_lines(tmp_path: Path) -> None:
    text = BASIC.replace("mass_kg = 0.6", "mass_kg = true").replace("mass_kg = 5.6", "mass_kg = 0").replace("k6", "K6")
    error = refused(tmp_path, text)
    assert [one.place.line for one in all_of(error)] == [5, 15, 25]
    first, after = text.index("[machine]"), text.index("[suspension]")
    moved = text[:first] + text[after:] + text[first:after]
    assert [one.place.key for one in all_of(refused(tmp_path, moved))] == [
        "wheel.mass_kg",
        "bearing[0].shaft_fit",
        "machine.mass_kg",
    ]
    assert error.place.key == "machine.mass_kg"
    assert isinstance(error.at(error.place), InputError)
    assert len(str(error).splitlines()) == 4  # three faults, one of them with a remedy


def test_of_very_many_faults_ten_are_told(tmp_path: Path) -> None:
    error = refused(tmp_path, BASIC + "".join(f"strange_{index} = 1\n" for index in range(25)))
    assert len(all_of(error)) == 25
    assert str(error).count("unknown key") == MOST_LISTED
    assert str(error).endswith("and 15 more")


def test_a_misspelt_key_is_not_reported_missing_too(tmp_path: Path) -> None:
    assert len(all_of(refused(tmp_path, BASIC.replace("mass_kg = 5.6", "mass_gg = 5.6")))) == 1
    unrelated = refused(tmp_path, BASIC.replace("mass_kg = 5.6", "qqq = 5.6"))
    assert {one.place.key for one in all_of(unrelated)} == {"machine.qqq", "machine.mass_kg"}


def test_bearings_alone_know_only_their_tables(tmp_path: Path) -> None:
    error = refused(tmp_path, BEARINGS + "[grinding]\n")
    assert error.place.key == "grinding" and "Known tables: machine, bearing, limits, expected" in str(error)
    assert refused(tmp_path, BEARINGS.replace("[machine]", "[mashine]")).place.key == "mashine"


NUMBERS = [(header, key) for header, keys in FULL.items() for key, value in keys.items() if value[0] in "-0123456789"]
LISTS = [(header, key) for header, keys in FULL.items() for key, value in keys.items() if value[0] == "["]
BAD = ("nan", "+nan", "inf", "-inf", '"5"', "'x'", "true", "false", "1979-05-27", "{}", "[[]]")


@settings(deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(place=st.sampled_from(NUMBERS), bad=st.sampled_from(BAD))
@pytest.mark.slow
def test_no_number_may_be_anything_else(tmp_path: Path, place: tuple[str, str], bad: str) -> None:
    text, line = full_text(place, bad)
    error = refused(tmp_path, text)
    assert (error.place.key, error.place.line) == (path_of(*place), line)


@pytest.mark.slow
@settings(deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(place=st.sampled_from(LISTS), bad=st.sampled_from(BAD), index=st.integers(0, 1))
def test_no_number_of_a_list_may_be_anything_else(tmp_path: Path, place: tuple[str, str], bad: str, index: int) -> None:
    items = FULL[place[0]][place[1]].strip("[]").split(", ")
    items[index] = bad
    text, line = full_text(place, f"[{', '.join(items)}]")
    error = refused(tmp_path, text)
    assert (error.place.key, error.place.line) == (f"{path_of(*place)}[{index}]", line)


@settings(deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(junk=st.text(max_size=60), line=st.integers(0, 28))
@pytest.mark.slow
def test_junk_in_a_file_never_brings_anything_but_an_input_error(tmp_path: Path, junk: str, line: int) -> None:
    rows = BASIC.split("\n")
    rows.insert(line, junk)
    text = "\n".join(rows).encode("utf-8", "surrogatepass")
    try:
        read(tmp_path, text)
    except InputError as error:
        assert error.place.file == str(tmp_path / "m.toml") and str(error)
