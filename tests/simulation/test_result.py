"""Common parts of results: provenance, and the verdict of the checks."""

import datetime
from typing import ClassVar

import abu_calc
from abu_calc.foundation.checks import Check, Grade
from abu_calc.foundation.quantity import record
from abu_calc.simulation.result import Provenance, Result


@record
class Sample(Result):
    """A result without fields of its own."""

    command: ClassVar[str] = "sample"


def sample(*grades: Grade) -> Sample:
    checks = tuple(Check("ABU401", "level", grade, "reason") for grade in grades)
    return Sample(title="sample", checks=checks, provenance=Provenance.today())


def test_the_worst_check_is_the_verdict_and_a_warning_passes() -> None:
    assert sample("pass", "warn").status == "pass"
    assert sample("pass", "not-done").status == "not-done"
    assert sample("not-done", "fail", "pass").status == "fail"
    assert sample().status == "not-done"


def test_title_checks_and_provenance_stand_in_the_envelope_alone() -> None:
    assert sample("pass").to_dict() == {}


def test_what_was_no_file_has_no_input() -> None:
    made = Provenance.today()
    assert made.input is None and made.version == abu_calc.__version__
    assert datetime.date.fromisoformat(made.date) <= datetime.date.today()


def test_a_file_keeps_its_hash_and_the_last_of_two_overrides() -> None:
    machine = abu_calc.read("msh-230").changed({"wheel.mass_kg": 1.0}).changed({"wheel.mass_kg": 1.5})
    made = Provenance.of(machine)
    assert made.input is not None and made.input["overrides"] == {"wheel.mass_kg": 1.5}
    assert made.sha256 == machine.sha256 and made.file == machine.file
    assert "wheel.mass_kg" not in made.input["defaults"]
