"""Keys of machine files with their meaning, read from the schema of the file."""

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any, Final, NamedTuple

_DEFINITION: Final = re.compile(r"#/definitions/(\w+)")


class FileKey(NamedTuple):
    """A key of a file: the header of its table as TOML writes it, its name, its meaning with unit and range."""

    header: str
    name: str
    meaning: str

    @property
    def path(self) -> str:
        """Table and key with a point between, as `--set` takes them; "" stands for no table."""
        return f"{self.header.strip('[]')}.{self.name}".strip(".")


def file_tables(schema: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Tables of a schema in the order of a file, with their headers as TOML writes them."""
    entries = schema.get("anyOf") or schema["allOf"]
    seen = set[str]()

    def below(name: str, header: str) -> Iterator[tuple[str, Mapping[str, Any]]]:
        table = schema["definitions"][name]
        if header and header not in seen:
            seen.add(header)
            yield header, table
        for key, entry in table["properties"].items():
            if inner := definition_of(entry):
                path = f"{header.strip('[]')}.{key}".strip(".")
                yield from below(inner, f"[[{path}]]" if '"array"' in json.dumps(entry) else f"[{path}]")

    for entry in entries:
        yield from below(entry["$ref"].rsplit("/", 1)[1], "")


def definition_of(entry: Mapping[str, Any]) -> str | None:
    """Name of the definition to which an entry of a schema refers; None: to none."""
    reference = _DEFINITION.search(json.dumps(entry))
    return reference[1] if reference else None


def meaning(entry: Mapping[str, Any], schema: Mapping[str, Any]) -> str:
    """Description of an entry, or of the table that it holds, with the values that it may have."""
    text: str = entry.get("description", "")
    if not text and (inner := definition_of(entry)):
        text = schema["definitions"][inner].get("description", "")
    if "enum" in entry and not all(str(value) in text for value in entry["enum"]):
        text += " One of: " + ", ".join(map(str, entry["enum"])) + "."
    return text


def machine_keys(asked: str) -> list[FileKey]:
    """Keys of machine files by name, by table and name, or by a name without its unit; all keys of a table by its name.

    None if there is no such key. A table that may stand once or several times counts once.

    >>> [key.path for key in machine_keys("ball_diameter")]
    ['autobalancer.ball_diameter_mm']
    """
    from abu_calc.inputs.reading.schema import schema_of

    schema = schema_of("machine")
    keys = dict[str, FileKey]()
    for header, table in file_tables(schema):
        for name, entry in table["properties"].items():
            whole = entry.get("x-canonical-key", name)
            prefix = header.strip("[]")
            if asked in (name, f"{prefix}.{name}", prefix):
                key = FileKey(header, whole, meaning(table["properties"][whole], schema))
                keys.setdefault(key.path, key)
    return list(keys.values()) or list(_outside_tables(asked, schema))


def _outside_tables(asked: str, schema: Mapping[str, Any]) -> Iterator[FileKey]:
    """A key of the whole file that no table of keys with fixed names holds, such as `costs`."""
    for entry in schema["anyOf"][:1]:
        keys = schema["definitions"][entry["$ref"].rsplit("/", 1)[1]]["properties"]
        if asked in keys:
            yield FileKey("", asked, meaning(keys[asked], schema))


MOST_LIKE: Final = 3
"""Most keys that are named to who asks for a word of theirs."""


def keys_with(word: str) -> list[str]:
    """Names of keys that have a word in them, the first few."""
    from abu_calc.inputs.reading.schema import schema_of

    tables = (table["properties"] for _, table in file_tables(schema_of("machine")))
    names = (name for table in tables for name, entry in table.items() if "x-canonical-key" not in entry)
    return list(dict.fromkeys(name for name in names if word.lower() in name.lower().split("_")))[:MOST_LIKE]
