"""One sign for one thing: every sign of formulas and results means what stands in one list, with the unit of files."""

import re
import tomllib
from pathlib import Path

import pytest

import abu_calc.foundation.formula
from abu_calc.features.explain.steps import STEPS
from abu_calc.features.files.result_schema import RESULTS
from abu_calc.foundation.formula import Formula, conversions, formula_of, in_files, signs, signs_in, told, unit_name
from abu_calc.foundation.units import SI_PER_UNIT
from abu_calc.foundation.validity import Range
from abu_calc.sizing.strength import permitted_pressure
from tests.cli.runner import abu
from tests.rows import for_each

FORMULAS = [formula for step in STEPS.values() for formula in step.formulas]
INDEXED = re.compile(r"(?<![\w·])[^\W\d_][₀-₉]*_[A-Za-z]+")
SI = {"m", "rad", "rad/s", "Pa", "m/s", "kg m"}


@for_each(FORMULAS)
def test_every_sign_is_told(one: Formula) -> None:
    """Of equations every letter; of sentences beside them what has an index."""
    equations = [one.equation, *(line for line in one.where.splitlines() if line.startswith("    "))]
    assert [letter for equation in equations for letter in signs_in(equation)[1]] == []
    assert set(one.signs.split()) <= signs().keys()
    said = " ".join((one.gives, one.where, one.assumed, one.published, one.source))
    assert {name for name in INDEXED.findall(said) if name not in {"Q_L", "e_r"}} <= signs().keys()
    # No sentence gives a sign another meaning, or a unit: both stand in the list.
    assert not re.search(r"\[(m|kg|rad|rad/s|Pa|N|1/s|m/s|kg m)\]", said)


def test_no_two_things_have_one_sign_and_few_one_thing_two() -> None:
    """The list is a table by sign; the words differ, so that nothing stands in it twice under other names."""
    meanings = [one.meaning for one in signs().values()]
    again = {one for one in meanings if meanings.count(one) > 1}
    assert again <= {"constant of the oil"}
    assert "density" in signs()["ρ"].meaning and "groove" in signs()["R_g"].meaning
    assert all(one.unit in SI_PER_UNIT or one.unit not in SI for one in signs().values())


def test_the_list_is_read_as_toml_would_be() -> None:
    path = Path(abu_calc.foundation.formula.__file__).with_name("symbols.toml")
    assert {name: [one.meaning, *filter(None, [one.unit])] for name, one in signs().items()} == tomllib.loads(
        path.read_text(encoding="utf-8")
    )


def test_every_sign_is_used() -> None:
    used = {name for one in FORMULAS for name in (*signs_in(one.equation)[0], *one.signs.split())}
    used |= {name for one in FORMULAS for name in signs_in(one.where)[0]}
    used |= {name for symbol in _symbols() for name in signs_in(symbol)[0]}
    assert signs().keys() - used <= {"P", "C"}


def _symbols() -> set[str]:
    """Of the records of all results."""
    from abu_calc.foundation.quantity import Record, quantities

    def below(kind: type) -> set[type]:
        return {kind, *(one for each in kind.__subclasses__() for one in below(each))}

    assert RESULTS
    return {one.symbol for kind in below(Record) for one in quantities(kind).values() if one.symbol}


def test_symbols_of_results_are_signs_of_the_list() -> None:
    assert {letter for symbol in _symbols() for letter in signs_in(symbol)[1]} == set()


@pytest.mark.parametrize("step", STEPS)
def test_explain_has_the_units_of_files_and_says_how_to_come_to_si(step: str) -> None:
    shown = " ".join(abu("explain", step).out.split())
    formulas, *conversion = shown.split(" Equations take SI: ")
    assert not re.search(r"\[(kg m|rad|rad/s|Pa|m/s)\]", formulas)
    assert len(conversion) == 1 and conversion[0].startswith("1 ")


def test_units_are_those_of_files_or_of_si() -> None:
    assert told(("m", "Ω"), si=False) == "m mass of a ball [g]; Ω speed of rotation [rpm]"
    assert told(("m", "Ω"), si=True) == "m mass of a ball [kg]; Ω speed of rotation [rad/s]"
    assert conversions(("MPa", "kg")) == "1 MPa = 1e6 Pa"
    assert in_files(Range("diameter", 0, 10, unit="m")) == "0 … 10000 mm"
    assert unit_name("hz", si=False) == "Hz"
    helped = formula_of("formulas.balls:capacity").paragraphs
    shown = formula_of("formulas.balls:capacity").for_users
    assert helped[0].endswith("[kg m].") and shown[0].endswith("[g·mm].")
    expected = "1 g·mm = 1e-6 kg m, 1 g = 0.001 kg, 1 mm = 0.001 m, 1 ° = 0.01745 rad"
    assert conversions(formula_of("formulas.balls:capacity").file_units) == expected


@for_each(FORMULAS)
def test_words_and_differentials_are_no_signs(one: Formula) -> None:
    """An article before a word, "as" and the d of a derivative: "a" is an acceleration, "s" and "d" have meanings."""
    assert not re.search(r"\b(a [a-z]{3,}|as [a-z])", one.equation)
    assert "d" not in signs_in(one.equation)[0] or not re.search(r"\bd[a-zε][_/]", one.equation)


def test_results_in_micrometres_hertz_and_kilonewtons_are_explained_in_them() -> None:
    """As the keys of the JSON name them: residuals, interferences and losses in µm, natural frequencies in Hz."""
    shown = {one.name: one.for_users[0] for one in FORMULAS}
    for name in ("friction band", "permitted displacement", "probable interference", "clearance left"):
        assert shown[name].endswith("[µm].")
    assert shown["natural frequency"].endswith("[Hz].") and shown["natural frequencies"].endswith("[Hz].")
    assert shown["load intensity"].endswith("[kN/m].") and shown["published answer"].endswith("[°, g].")
    assert "1 µm = 1e-6 m" in conversions(formula_of("formulas.friction_band:friction_band").file_units)
    assert formula_of("formulas.friction_band:friction_band").paragraphs[0].endswith("[m].")


def test_no_equation_with_units_of_its_own_says_that_it_takes_si() -> None:
    """13·F_r·k_B/b_s gives µm by kN and mm; in SI it would be 1e12 times too much."""
    for name in ("creep_interference", "load_loss", "catalogue_smoothing_loss"):
        formula = formula_of(f"features.seats.interference:{name}")
        assert not formula.file_units and "This equation takes these units, not SI." in formula.for_users


def test_labels_of_the_design_are_equations_that_give_its_numbers() -> None:
    """Of the drag κ_s, not κ, which gives 72 1/s where 92 stands; of the fan w_f over the cosine, not w_f alone."""
    from abu_calc.features.design.records import AccuracyBudget, AutobalancerRecord
    from abu_calc.foundation.quantity import quantities

    assert quantities(AutobalancerRecord)["optimum_drag_per_s"].symbol == "2√(Jκ_s)"
    assert quantities(AccuracyBudget)["rolling_friction_um"].symbol == "w_f/cos(γ_g/2)"


def test_factors_of_the_permitted_pressure_multiply_to_the_one_used() -> None:
    found = formula_of("sizing.strength:permitted_pressure")
    share, strength, both = (float(one) for one in re.findall(r"(\d\.\d+)·", found.equation))
    assert share * strength == pytest.approx(both)
    assert permitted_pressure(700.0) == pytest.approx(1e6 * both * 700.0)
