"""Arguments of studies from Python: taken as they should be, or refused by their names before anything is computed."""

import json
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any, get_type_hints

import numpy as np
import pytest

import abu_calc
from tests.rows import for_each

STUDIES = (
    *(abu_calc.size, abu_calc.check_fit, abu_calc.simulate, abu_calc.stability, abu_calc.accuracy, abu_calc.effects),
    abu_calc.grinding,
)
ARGUMENTS = [(study, name) for study in STUDIES for name in get_type_hints(study) if name != "return"]
MACHINE = abu_calc.read("msh-230")
BEARINGS = abu_calc.read("mmg-3200k-knife-shaft")


class Unprintable:
    """Whatever a script may hold."""

    def __repr__(self) -> str:
        raise RuntimeError


def refused(study: Callable[..., object], *arguments: object, **named: object) -> abu_calc.InputError:
    with pytest.raises(abu_calc.InputError) as caught:
        study(*arguments, **named)
    return caught.value


def first(study: object) -> Any:
    """What a study is about."""
    return BEARINGS if study is abu_calc.check_fit else MACHINE


@pytest.mark.parametrize(("study", "name"), ARGUMENTS, ids=lambda value: getattr(value, "__name__", value))
@pytest.mark.parametrize("value", [object(), b"x", {}, 1j, Unprintable()], ids=lambda value: type(value).__name__)
def test_every_argument_of_every_study_refuses_what_it_cannot_be(study: Any, name: str, value: object) -> None:
    named = {name: value} if name in ("machine", "source") else {next(iter(get_type_hints(study))): first(study)}
    error = refused(study, **{**named, name: value})
    assert error.place.key == name and error.found and error.allowed, error


@for_each(
    [
        (abu_calc.size, "machine", "msh-230", "a machine that was read"),
        (abu_calc.size, "machine", None, "a machine that was read"),
        (abu_calc.size, "accuracy", "0.01", "a number"),
        (abu_calc.size, "accuracy", True, "a number"),
        (abu_calc.size, "accuracy", None, "a number"),
        (abu_calc.size, "accuracy", 10**400, "a number"),
        (abu_calc.size, "accuracy", float("nan"), "1e-8 … 0.5"),
        (abu_calc.size, "progress", None, "a function"),
        (abu_calc.simulate, "source", "msh-230", "a scene file that was read"),
        (abu_calc.simulate, "duration_s", "1", "a number or None"),
        (abu_calc.simulate, "duration_s", -1, "s"),
        (abu_calc.simulate, "samples", 2.5, "a whole number or None"),
        (abu_calc.simulate, "samples", True, "a whole number or None"),
        (abu_calc.simulate, "samples", 1, "2 … 1e6"),
        (abu_calc.simulate, "most_evaluations", 0, "1 … 1e12"),
        (abu_calc.simulate, "scene", 5, "text or None"),
        (abu_calc.simulate, "scene", "idel", "idle"),
        (abu_calc.simulate, "start", ["bunched"], "text or None"),
        (abu_calc.simulate, "with_effects", "gravity", "a list, each of it text"),
        (abu_calc.simulate, "with_effects", [1], "a list, each of it text"),
        (abu_calc.simulate, "with_effects", (each for each in ["gravity"]), "a list, each of it text"),
        (abu_calc.simulate, "without_effects", None, "a list, each of it text"),
        (abu_calc.simulate, "without_effects", ["gravitation"], "gravity"),
        (abu_calc.simulate, "integrator", None, "text"),
        (abu_calc.simulate, "integrator", "euler", "compiled"),
        (abu_calc.simulate, "audit", "no", "True or False"),
        (abu_calc.simulate, "audit", 1, "True or False"),
        (abu_calc.stability, "speeds_rpm", (1,), "(a number, a number) or None"),
        (abu_calc.stability, "speeds_rpm", (1.0, 2.0, 3.0), "(a number, a number) or None"),
        (abu_calc.stability, "speeds_rpm", ("1", "2"), "(a number, a number) or None"),
        (abu_calc.stability, "speeds_rpm", "12", "(a number, a number) or None"),
        (abu_calc.stability, "speeds_rpm", (2000.0, 1000.0), "ascending"),
        (abu_calc.accuracy, "quantity", None, "text"),
        (abu_calc.accuracy, "quantity", "noise", "amplitude"),
        (abu_calc.accuracy, "budget_s", True, "a number"),
        (abu_calc.effects, "without_effects", "gravity", "a list, each of it text"),
        (abu_calc.check_fit, "machine", MACHINE.tables, "a machine that was read"),
    ]
)
def test_a_wrong_argument_is_refused_by_its_name(study: Any, name: str, value: object, allowed: str) -> None:
    named = {} if name in ("machine", "source") else {next(iter(get_type_hints(study))): first(study)}
    error = refused(study, **{**named, name: value})
    assert error.place.key == name and allowed in str(error.allowed), error


@pytest.mark.parametrize("arguments", [(), (MACHINE, 0.01, print, 1, 1)], ids=["none", "too many"])
def test_how_many_arguments_there_are_is_pythons_to_judge(arguments: tuple[Any, ...]) -> None:
    with pytest.raises(TypeError, match=r"size\(\)"):
        abu_calc.size(*arguments)
    with pytest.raises(TypeError, match="acuracy"):
        abu_calc.size(MACHINE, acuracy=None)  # type: ignore[call-arg]


@pytest.mark.parametrize("number", [np.float32(0.25), np.float64(0.25), Decimal("0.25"), Fraction(1, 4)], ids=repr)
def test_numbers_of_other_libraries_are_numbers(number: Any) -> None:
    result = abu_calc.effects(
        MACHINE.changed({"wheel.mass_kg": number, "wheel.runout_mm": np.int64(0)}), accuracy=number
    )
    assert type(result.accuracy) is float and result.accuracy == 0.25
    overrides = json.loads(json.dumps(result.provenance.input))["overrides"]
    assert overrides == {"wheel.mass_kg": 0.25, "wheel.runout_mm": 0}


@pytest.mark.parametrize("count", [np.int64(4), np.int32(4), np.uint8(4)], ids=repr)
def test_whole_numbers_of_numpy_count_balls_and_samples(count: Any) -> None:
    machine = MACHINE.changed({"autobalancer.ball_count": count})
    assert machine.overrides[0].value == 4 and type(machine.overrides[0].value) is int
    motion = abu_calc.simulate(machine, duration_s=0.05, samples=count, accuracy=0.1).motion
    assert motion is not None and len(motion.t_s) == 4


@pytest.mark.parametrize(
    "value",
    [None, 1j, b"6", {1: 2}, {4}, object(), Decimal("sNaN"), np.bool_(True), np.array([1.0]), [1.0, None], Path("x")],
    ids=lambda value: type(value).__name__,
)
def test_a_change_to_what_no_file_can_hold_is_refused(value: object) -> None:
    error = refused(MACHINE.changed, {"wheel.mass_kg": value})
    assert error.place.key == "wheel.mass_kg" and error.found and "numbers" in str(error.allowed)


@pytest.mark.parametrize("values", [{"grinding": None}, {"grinding": {"contact": None}}], ids=str)
def test_none_takes_nothing_out_of_a_file(values: dict[str, object]) -> None:
    error = refused(MACHINE.changed, values)
    assert error.found == "None" and "Leave the entry out" in str(error.remedy)


@pytest.mark.parametrize("source", [None, 5, b"msh-230", ["msh-230"]], ids=repr)
@pytest.mark.parametrize("reader", [abu_calc.read, abu_calc.read_scene])
def test_what_is_no_name_of_a_file_is_refused(reader: Any, source: object) -> None:
    assert refused(reader, source).place.key == "source"


@pytest.mark.parametrize("overrides", ["scene.speed_rpm=1", {"scene.speed_rpm": 1}, [1], 5], ids=repr)
def test_what_is_no_list_of_overrides_is_refused(tmp_path: Path, overrides: Any) -> None:
    file = tmp_path / "scene.toml"
    file.write_text("[scene]\nmass_kg = 1.0\n", encoding="utf-8")
    assert refused(abu_calc.read_scene, file, overrides).place.key == "overrides"


@pytest.mark.parametrize("name", ["size", "simulate", "stability", "effects", "accuracy", "grinding"])
def test_a_file_of_bearings_is_refused_in_the_name_of_the_study(name: str) -> None:
    assert "this command needs a whole machine" in str(refused(getattr(abu_calc, name), BEARINGS))
    assert "holds bearings only" in str(refused(BEARINGS.whole))


@pytest.mark.parametrize(
    ("effect", "needs"),
    [("transverse_motion", 'grinding.contact = "face", wheel.axial_runout_mm above 0'), ("motor", "[motor]"),
     ("gravity", "horizontal")],
)  # fmt: skip
def test_an_effect_that_a_machine_lacks_says_what_it_needs(effect: str, needs: str) -> None:
    error = refused(abu_calc.simulate, MACHINE, with_effects=[effect])
    assert needs in (error.remedy or "") and error.place.key == "with_effects"


def test_a_machine_that_has_what_an_effect_needs_gets_it() -> None:
    from abu_calc.simulation.subject import subject_of

    subject = subject_of(MACHINE.changed({"wheel.axial_runout_mm": 0.1}), "grinding")
    assert subject.scene.effect("transverse_motion") is not None
