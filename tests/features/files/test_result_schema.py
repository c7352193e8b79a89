"""What `--json` prints is what `abu schema result` says."""

import copy
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from tests.cli.runner import abu, once
from tests.inputs import scenes

SCENE = scenes.SCENE.replace("700.0", "20.0") + "[scene.effects]\nrace_eccentricity = { magnitude_mm = 0.1 }\n"

COMMANDS = (
    *(("size", "msh-230"), ("size", "swing-arm-grinder"), ("check-fit", "mmg-3200k-knife-shaft")),
    *(("simulate", "scene.toml"), ("simulate", "msh-230", "--audit"), ("stability", "scene.toml", "--speeds", "50:90")),
    *(
        ("effects", "scene.toml"),
        ("effects",),
        ("accuracy", "scene.toml", "--time-budget", "0.5"),
        ("verify", "msh-230"),
    ),
    *(("levels", "msh-230", "--minutes", "60"), ("levels", "scene.toml"), ("levels", "motion.csv")),
    *(("grinding", "avtovaz-707-370"), ("grinding", "avtovaz-707-222", "--set", "wheel.runout_mm=0.02")),
    ("size", "no-such-machine"),
)


@pytest.fixture(scope="module")
def schema() -> dict[str, object]:
    """The schema of results."""
    found: dict[str, object] = json.loads(abu("schema", "result").out)
    jsonschema.Draft202012Validator.check_schema(found)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_every_document_is_as_the_schema_says(
    schema: dict[str, object], command: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("scene.toml").write_text(SCENE, encoding="utf-8")
    rows = (f"{k / 500},{math.sin(k)}" for k in range(500))
    Path("motion.csv").write_text("t_s,a_m_per_s2\n" + "\n".join(rows), encoding="utf-8")
    run = abu if {"scene.toml", "motion.csv"} & {*command} else once
    document = run(*command, "--json").document
    jsonschema.Draft202012Validator(schema).validate(document)


@pytest.mark.slow
def test_the_schema_refuses_what_is_not_so(schema: dict[str, object]) -> None:
    document = once("size", "msh-230", "--json").document
    document["result"]["autobalancer"]["ball_count"] = "four"
    with pytest.raises(jsonschema.ValidationError, match="four"):
        jsonschema.Draft202012Validator(schema).validate(document)
    document["result"]["autobalancer"].pop("ball_count")
    with pytest.raises(jsonschema.ValidationError, match="ball_count"):
        jsonschema.Draft202012Validator(schema).validate(document)


WRONG = (
    ("size", lambda document: document["model"].update(candidates="many")),
    ("size", lambda document: document["model"].pop("scenes")),
    ("size", lambda document: document["model"]["scenes"]["idle"].update(states="x")),
    ("size", lambda document: document["model"]["speed_range_rad_per_s"].append(1.0)),
    ("stability", lambda document: document["model"]["races"][0].update(drag_per_s=None)),
    ("stability", lambda document: document["checks"][0].update(value="-1")),
    ("stability", lambda document: document["checks"][0].update(bound="middle")),
    ("stability", lambda document: document["checks"][0].update(message=None)),
    ("stability", lambda document: document["checks"][0].pop("limit")),
    ("stability", lambda document: document["input"].pop("sha256")),
    ("stability", lambda document: document["warnings"].append(1)),
)


@pytest.fixture(scope="module")
def documents() -> dict[str, dict[str, Any]]:
    """A document of each command."""
    return {command: once(command, "msh-230", "--json").document for command in ("size", "stability")}


@pytest.mark.parametrize(("command", "spoil"), WRONG, ids=range(len(WRONG)))
@pytest.mark.slow
def test_the_schema_knows_models_and_checks(
    schema: dict[str, object], documents: dict[str, dict[str, Any]], command: str, spoil: Callable[[Any], object]
) -> None:
    document = copy.deepcopy(documents[command])
    judge = jsonschema.Draft202012Validator(schema)
    judge.validate(document)
    spoil(document)
    with pytest.raises(jsonschema.ValidationError):
        judge.validate(document)


@pytest.mark.slow
def test_numbers_say_what_they_are(schema: dict[str, object]) -> None:
    """Label, symbol and unit stand in the schema."""
    definitions = schema["$defs"]
    assert isinstance(definitions, dict)
    described = definitions["Autobalancer"]["properties"]["ball_diameter_mm"]["description"]
    assert described == "ball diameter 2r [mm]"
