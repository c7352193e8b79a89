"""`abu schema`: a JSON Schema of each kind of file, and of results."""

import json

import pytest

from abu_calc.features.files.schema import KINDS, schema
from abu_calc.foundation.errors import InputError
from tests.cli.runner import once


@pytest.mark.few(2)
@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_has_a_schema_that_is_printed_as_it_is(kind: str) -> None:
    outcome = schema(kind)
    assert outcome.plain is not None and json.loads(outcome.plain) == outcome.result
    draft = "2020-12" if kind == "result" else "draft-04"
    assert draft in outcome.result["$schema"]


@pytest.mark.slow
def test_machines_are_the_usual_kind() -> None:
    assert schema().result == schema("machine").result != schema("scene").result


def test_another_kind_is_refused_with_those_there_are() -> None:
    with pytest.raises(InputError, match="no schema of this kind") as caught:
        schema("recording")
    assert (caught.value.found, caught.value.allowed) == ("recording", ", ".join(KINDS))
    assert once("schema", "recording").status == 2
