"""Schemas held to what they are to be, and to the models that they are made from."""

import json
from typing import Any

from jsonschema import Draft4Validator
from pydantic import BaseModel, ValidationError

from abu_calc.inputs.reading.table import RULE
from tests.inputs.reading.test_schema import DRAFT4, words


def check_schema(schema: dict[str, Any]) -> None:
    """It is of draft 4, closed, and has a description of every key."""
    Draft4Validator.check_schema(schema)
    assert json.loads(json.dumps(schema)) == schema
    assert {word for word, _ in words(schema)} <= DRAFT4
    for name, body in schema["definitions"].items():
        assert body["additionalProperties"] is False
        for key, value in body.get("properties", {}).items():
            assert "$ref" in value or value.get("description"), f"{name}.{key}"


def right_but_for_rules(model: type[BaseModel], data: Any) -> bool:
    """Whether the model takes it, or refuses it by what a schema does not tell."""
    try:
        model.model_validate(data)
    except ValidationError as error:
        return all(_of_rules(detail) for detail in error.errors())
    return True


def _of_rules(detail: Any) -> bool:
    """A rule between keys; a list whose items break one is told as too short as well."""
    whole = detail["type"] == "too_short" and len(detail["input"]) >= detail["ctx"]["min_length"]
    return detail["type"] == RULE or whole
