"""`abu compare`: files, screens and refusals."""

import json
import tomllib
from pathlib import Path

import jsonschema
import pytest

from tests.cli.runner import abu, once
from tests.features.compare.test_study import of

SHAFT = ("compare", "mmg-3200k-knife-shaft", "--variant", "bearing[0].shaft_fit=m6")


@pytest.mark.slow
def test_files_have_the_differences_and_with_full_every_entry(tmp_path: Path) -> None:
    short, whole = tmp_path / "short.txt", tmp_path / "whole.txt"
    assert once(*SHAFT, "--output", str(short)).status == once(*SHAFT, "--full", "--output", str(whole)).status == 1
    less, more = (one.read_text(encoding="utf-8") for one in (short, whole))
    assert "bearing[0].shaft_fit" in less and "Left out because equal: " in less and "≠" not in less
    assert "≠ bearing[0].shaft_fit" in more and len(more.splitlines()) > 2 * len(less.splitlines())


@pytest.mark.slow
def test_seats_from_the_command_line(tmp_path: Path) -> None:
    document = once(*SHAFT, "--json").document
    assert document["abu"]["command"] == "compare" and len(document["result"]["files"]) == 2
    assert document["result"]["files"][1]["overrides"] == {"bearing[0].shaft_fit": "m6"}
    rows = document["result"]["differences"]
    assert of("file", rows) == {"bearing[0].shaft_fit": ["k6", "m6"]}
    # ISO 286-2, 80 mm: k6 +2…+21, m6 +11…+30, against a ring of class 0 from −15 to 0.
    assert of("design", rows)["fits.0.interference_um.0"] == pytest.approx([2, 11])
    assert of("design", rows)["fits.0.interference_um.1"] == pytest.approx([36, 45])
    seen = once(*SHAFT)
    assert seen.status == 1 and seen.width <= 80 and "tolerance class" in seen.out and "fits.0" not in seen.out
    schema = json.loads(once("schema", "result").out)
    jsonschema.Draft202012Validator(schema).validate(document)


@pytest.mark.slow
def test_files_keep_places_of_what_is_missing(tmp_path: Path) -> None:
    target = tmp_path / "both.toml"
    assert abu(*SHAFT[:3], "bearing[0].speed_rpm=900", "--output", str(target)).status == 1
    rows = tomllib.loads(target.read_text(encoding="utf-8"))["result"]["differences"]
    assert of("file", rows)["bearing[0].speed_rpm"] == ["null", 900.0]


@pytest.mark.slow
def test_three_and_more_machines_fit_the_screen() -> None:
    fits = ("j6", "js6", "k5", "k6", "m5", "m6", "n6")
    variants = [part for fit in fits for part in ("--variant", f"bearing[0].shaft_fit={fit}")]
    seen = abu(*SHAFT[:2], *variants)
    assert len(seen.out.splitlines()) <= 48 and seen.width <= 80 and "\n  H  " in seen.out
    files = abu(*SHAFT[:2], *variants, "--json").document["result"]
    assert files["differences"][0]["values"] == ["k6", *fits]
    assert seen.status == max(0 if one["status"] == "pass" else 1 for one in files["files"])


@pytest.mark.few(2)
@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("msh-230",), "2 to 26"),
        (("msh-230", "msh-230", "--variant", "wheel.mass_kg=1"), "variants are of one machine"),
        (("msh-230", "--variant", "wheel.mas_kg=1"), "--variant wheel.mas_kg: unknown key"),
        (("msh-230", "--variant", "wheel.mass_kg"), "--variant: not an override"),
        (("msh-230", "--variant", "wheel.mass_kg=0,5"), "Write 0.5"),
        (("msh-230", "--variant", ""), "not an override"),
        (("msh-230", "--variant", "wheel.mass_kg=-1,machine.mass_kg=5"), "--variant wheel.mass_kg: out of range"),
        (("msh-230", "--variant", "wheel.mass_kg=[1,2"), "not a TOML value"),
        (("msh-230", "--variant", "wheel.mass_kg=1,,machine.mass_kg=5"), "--variant wheel.mass_kg"),
        (("msh-230", "sapropel-screw-rig"), "abu balance"),
        (("msh-230", "no-such-machine"), "no-such-machine"),
        (("msh-230", "avtovaz-707-222", "--accuracy", "5"), "--accuracy"),
        ((*["msh-230"] * 27,), "27 of them"),
    ],
)
def test_wrong_ones_are_refused(arguments: tuple[str, ...], told: str) -> None:
    seen = abu("compare", *arguments)
    assert seen.status == 2 and told in seen.err and "Traceback" not in seen.err and not seen.out
