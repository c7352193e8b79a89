"""Machine files with two races: what is read, and what is refused with file, line and key."""

from pathlib import Path

import pytest

import abu_calc
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import read, read_machine

PRESET = "pedestal-grinder"


def test_planes_and_imbalances_are_read() -> None:
    tables = read_machine(PRESET).spindle
    assert tables is not None
    assert [wheel.plane_mm for wheel in tables.wheel] == [260.0, -260.0]
    assert [race.plane_mm for race in tables.autobalancer] == [300.0, -300.0]
    assert tables.machine.speeds_rpm == (2850.0, 2850.0)


def test_a_machine_with_one_race_has_no_two() -> None:
    assert read_machine("avtovaz-707-222").spindle is None


@pytest.mark.parametrize(
    ("override", "key", "words"),
    [
        ("autobalancer.1.plane_mm=300.0", "autobalancer[1].plane_mm", "one plane"),
        ("autobalancer.1.plane_mm=nan", "autobalancer.1.plane_mm", "finite|number"),
        ("autobalancer.1.rolling_friction_mm=0.004", "autobalancer[1].rolling_friction_mm", "same"),
        ("autobalancer.0.plane_offset_mm=5.0", "autobalancer[0].plane_offset_mm", "plane_mm alone"),
        ("machine.rotor_polar_inertia_kg_m2=6.3", "machine.rotor_polar_inertia_kg_m2", "no body"),
        ("machine.transverse_inertia_kg_m2=0.0", "machine.transverse_inertia_kg_m2", "above 0"),
        ("machine.mass_kg=-1.0", "machine.mass_kg", "0.001"),
        ('suspension.model="hands"', "suspension.model", "bearings"),
        ("suspension.bearing_damping_N_s_per_m=[300.0]", "suspension.bearing_damping_N_s_per_m", "each bearing"),
        ("suspension.damping_ratios=0.1", "suspension.damping_ratios", "takes no"),
        ("machine.speed_range_rpm=[3000.0, 3100.0]", "machine.speed_range_rpm", "contain"),
        ("wheel.0.imbalance_angle_deg=400.0", "wheel.0.imbalance_angle_deg", "360"),
    ],
)
def test_what_cannot_be_is_refused(override: str, key: str, words: str) -> None:
    with pytest.raises(InputError) as caught:
        read_machine(PRESET, [override])
    text = str(caught.value)
    assert key.rpartition(".")[2] in text
    assert any(word in text for word in words.split("|")), text


def test_a_measured_level_gives_no_imbalances_of_two_wheels() -> None:
    with pytest.raises(InputError, match="two wheels"):
        read_machine(PRESET, ["wheel.0.measured_level_db=111.0"])


def test_commands_for_one_race_say_so() -> None:
    machine = abu_calc.read(PRESET)
    for study in (abu_calc.levels, abu_calc.effects):
        with pytest.raises(InputError, match="two races"):
            study(machine)  # type: ignore[operator]


def lists_of_one(folder: Path, more: str = "") -> Path:
    text = read("avtovaz-707-222").document.text
    text = text.replace("\n[wheel]\n", "\n[[wheel]]\n").replace("\n[autobalancer]\n", "\n[[autobalancer]]\n" + more)
    file = folder / "one.toml"
    file.write_text(text, encoding="utf-8")
    return file


def test_lists_of_one_are_the_single_tables(tmp_path: Path) -> None:
    file = lists_of_one(tmp_path)
    assert "[[wheel]]" in file.read_text(encoding="utf-8")
    machine, usual = read(file), read("avtovaz-707-222")
    assert (machine.tables, machine.defaults_used) == (usual.tables, usual.defaults_used)
    assert machine.warnings == usual.warnings
    assert machine.changed({"wheel.mass_kg": 0.5}).whole().wheel.mass_kg == 0.5


def test_a_fault_in_a_list_of_one_has_its_line(tmp_path: Path) -> None:
    file = lists_of_one(tmp_path, "capacity_margin = 0.5\n")
    line = file.read_text(encoding="utf-8").splitlines().index("capacity_margin = 0.5") + 1
    with pytest.raises(InputError, match=rf"one\.toml:{line}: autobalancer\.capacity_margin"):
        read(file)


TABLE = """
[[autobalancer]]
plane_mm = 0.0
max_outer_diameter_mm = 160.0
max_width_mm = 40.0
bore_diameter_mm = 30.0
"""


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda text: text.replace("[[autobalancer]]", "[autobalancer]"), "write \\[\\[autobalancer\\]\\] each time"),
        (lambda text: text.replace("[[wheel]]", "[wheel]"), "write \\[\\[wheel\\]\\] each time"),
        (lambda text: text.replace("[limits]", TABLE + "\n[limits]"), "too many autobalancers"),
        (lambda text: text[: text.rindex("[[autobalancer]]")] + text[text.index("[limits]") :], "two wheels need two"),
    ],
)
def test_hints_of_tables_that_stand_wrongly(change, words: str) -> None:
    text = Path(__file__).parents[2].joinpath("presets", f"{PRESET}.toml").read_text(encoding="utf-8")
    with pytest.raises(InputError, match=words):
        read(change(text))


@pytest.mark.parametrize(
    ("command", "words"),
    [("levels", "abu grinding"), ("size", "abu sweep")],
)
def test_commands_that_take_one_race_say_why_and_what_to_do(command: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        read_machine(PRESET).whole(command)
