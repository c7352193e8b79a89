"""Use from Python: typed, what the command prints, and errors that say what is wrong."""

import copy
import dataclasses
import pickle
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

import abu_calc
from abu_calc.sizing import size as size_design
from tests.cli.runner import abu
from tests.remembered import recalled

CLOCK = frozenset({"wall_s", "cold_s"})


def without_clock(value: object) -> object:
    """A result but for the times of the clock."""
    if isinstance(value, dict):
        return {key: without_clock(inner) for key, inner in value.items() if key not in CLOCK}
    return [without_clock(inner) for inner in value] if isinstance(value, list) else value


@pytest.mark.slow
def test_sizing_returns_what_the_command_prints() -> None:
    machine = abu_calc.read("msh-230").changed({"wheel.mass_kg": 0.6, "autobalancer.rolling_drag_per_s": 20.0})
    result = abu_calc.size(machine)
    seen = abu(
        "size", "msh-230", "--set", "wheel.mass_kg=0.6", "--set", "autobalancer.rolling_drag_per_s=20.0", "--json"
    )
    document = seen.document
    assert without_clock(result.to_dict()) == without_clock(document["result"])
    assert result.status == document["status"]
    assert [check.code for check in result.checks] == [check["code"] for check in document["checks"]]
    assert list(result.warnings) == document["warnings"]
    assert document["input"]["overrides"] == {"wheel.mass_kg": 0.6, "autobalancer.rolling_drag_per_s": 20.0}
    assert result.provenance.input == document["input"]


@pytest.mark.parametrize(
    ("values", "key", "part"),
    [
        ({"wheel.mass_kg": "heavy"}, "wheel.mass_kg", "number"),
        ({"wheel.mass_kg": float("nan")}, "wheel.mass_kg", "finite"),
        ({"wheel.mass_kg": True}, "wheel.mass_kg", "number"),
        ({"wheel.mass_kg": -1.0}, "wheel.mass_kg", "at least"),
        ({"wheel.mas_kg": 1.0}, "wheel.mas_kg", "mass_kg"),
        ({"bearing[7].shaft_fit": "k6"}, "bearing", ""),
        ({"": 1.0}, "", "not a key path"),
    ],
    ids=str,
)
def test_a_wrong_change_is_refused_with_its_key(values: dict[str, object], key: str, part: str) -> None:
    with pytest.raises(abu_calc.InputError) as refused:
        abu_calc.read("msh-230").changed(values)
    assert key in str(refused.value) and part in str(refused.value)
    assert "--set" not in str(refused.value)


def test_a_change_leaves_the_machine_as_it_was() -> None:
    machine = abu_calc.read("msh-230")
    changed = machine.changed({"wheel.mass_kg": 0.9}).changed({"limits.settling_time_s": 0.5})
    assert [override.key for override in changed.overrides] == ["wheel.mass_kg", "limits.settling_time_s"]
    assert machine.overrides == () and machine.tables != changed.tables


def test_changes_of_changes_leave_earlier_machines_and_the_callers_values_alone() -> None:
    given = {"contact": "compliant", "press_force_N": 30.0, "contact_stiffness_N_per_m": 1e5}
    first = abu_calc.read("msh-230").changed({"grinding": given})
    second = first.changed({"grinding.press_force_N": 99.0})
    assert given["press_force_N"] == 30.0 and dict(abu_calc.effects(first).provenance.overrides)["grinding"] == given
    assert [machine.whole("size").grinding.press_force_N for machine in (first, second)] == [30.0, 99.0]  # type: ignore[union-attr]


def test_one_key_takes_the_place_of_another_again_and_again() -> None:
    machine = abu_calc.read("msh-230")
    for key, value in (("imbalance_g_mm", 100.0), ("balance_grade", "G16"), ("imbalance_g_mm", 90.0)):
        machine = machine.changed({f"wheel.{key}": value})
    assert [override.key for override in machine.overrides] == ["wheel.imbalance_g_mm"]
    assert size_design(machine.whole()).imbalance.value == pytest.approx(90e-6)


@pytest.mark.parametrize("values", [{1: 2}, {None: 1}, [("a", 1)], None, "wheel.mass_kg=1"], ids=str)
def test_what_is_no_change_is_refused(values: object) -> None:
    with pytest.raises(abu_calc.InputError, match="key paths with their values"):
        abu_calc.read("msh-230").changed(values)  # type: ignore[arg-type]


def test_dates_are_no_expected_values() -> None:
    seen = abu("check-fit", "mmg-3200k-knife-shaft", "--set", "expected.foo=1979-05-27")
    assert seen.status == 2 and "--set expected.foo" in seen.err and "(found 1979-05-27)" in seen.err


def test_results_are_dataclasses() -> None:
    result = abu_calc.check_fit(abu_calc.read("mmg-3200k-knife-shaft"))
    assert dataclasses.replace(result, title="x").title == "x"
    assert pickle.loads(pickle.dumps(result)) == copy.deepcopy(result) == result
    with pytest.raises(dataclasses.FrozenInstanceError):
        result.title = "y"  # type: ignore[misc]


@pytest.mark.slow
def test_the_same_machine_gives_an_equal_result_however_long_that_took() -> None:
    machine = abu_calc.read("msh-230")
    result, again = abu_calc.size(machine), recalled("size", machine)
    idle = again.simulation[0]
    longer = dataclasses.replace(idle, cost=dataclasses.replace(idle.cost, wall_s=idle.cost.wall_s + 1.0))
    assert result == again == dataclasses.replace(again, simulation=(longer, *again.simulation[1:]))
    other = dataclasses.replace(idle, cost=dataclasses.replace(idle.cost, steps=idle.cost.steps + 1))
    assert result != dataclasses.replace(again, simulation=(other, *again.simulation[1:]))


def test_remedies_name_the_argument_and_the_option() -> None:
    stiff = {"suspension.natural_frequencies_hz": [90.0, 90.0], "suspension.damping_ratios": [0.05, 0.05]}
    (check,) = abu_calc.stability(abu_calc.read("msh-230").changed(stiff)).checks
    assert check.status == "fail" and "(--speeds finds them, Python: speeds_rpm=)" in str(check.remedy)


def test_a_file_may_be_named_by_a_path(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    file.write_text(abu("presets", "msh-230").out, encoding="utf-8")
    assert abu_calc.read(file).tables == abu_calc.read("msh-230").tables
    with pytest.raises(abu_calc.InputError, match="no such file"):
        abu_calc.read(tmp_path / "other.toml")


def test_every_public_name_is_there() -> None:
    assert all(hasattr(abu_calc, name) for name in abu_calc.__all__)
    named = {name for names in abu_calc._ROOMS.values() for name in names.split()}
    assert {*named, "__version__", "units"} == set(abu_calc.__all__) and set(abu_calc.__all__) <= set(dir(abu_calc))
    with pytest.raises(AttributeError, match="no attribute 'sise'"):
        _ = abu_calc.sise  # type: ignore[attr-defined]


def test_importing_loads_nothing() -> None:
    code = "import sys, abu_calc; print(sorted({'numpy', 'pydantic', 'scipy', 'rich'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.slow
def test_a_type_checker_sees_types_of_what_is_not_in_units(tmp_path: Path) -> None:
    script = tmp_path / "use.py"
    script.write_text(
        textwrap.dedent("""
        import abu_calc
        machine = abu_calc.read("msh-230").changed({"wheel.mass_kg": 0.5})
        result = abu_calc.size(machine)
        reveal_type(machine)
        reveal_type(result.autobalancer.ball_count)
        reveal_type(result.simulation[0].settling_time_s)
        reveal_type(abu_calc.check_fit(machine).seats)
        reveal_type(abu_calc.stability(machine).stable)
        reveal_type(machine.whole().wheel.mass_kg)
        reveal_type(result.model.speed_rad_per_s)
        reveal_type(abu_calc.simulate(machine, samples=2).model)
        abu_calc.sise(machine)
        """),
        encoding="utf-8",
    )
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", str(script)],
        capture_output=True, text=True, check=False, cwd=Path(abu_calc.__file__).parents[1],
    )  # fmt: skip
    said = [line.split(": ", 1)[1] for line in done.stdout.splitlines() if "use.py:" in line]
    revealed = [line.split('"')[1].replace("builtins.", "") for line in said if "Revealed type" in line]
    assert revealed == [
        "abu_calc.inputs.read_machine.Machine",
        "int",
        "Any",
        "tuple[abu_calc.features.seats.seats.SeatResult, ...]",
        "bool | None",
        "float",
        "float",
        "abu_calc.simulation.records.SceneModel",
    ]
    errors = [line for line in said if line.startswith("error")]
    assert len(errors) == 1 and "sise" in errors[0]


def test_a_misspelt_entry_is_told() -> None:
    """At run time: entries in user units are made of fields in SI, which a type checker does not see."""
    seat = abu_calc.check_fit(abu_calc.read("mmg-3200k-knife-shaft")).seats[0]
    assert "interference_um" in dir(seat)
    with pytest.raises(AttributeError, match="'interferense_um'") as caught:
        _ = seat.interferense_um
    assert caught.value.name == "interferense_um" and caught.value.obj is seat
