"""The scanner of lines against documents built with known lines, and against the parser."""

import tomllib
from collections.abc import Iterator

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.inputs.reading.text import Part, key_path
from abu_calc.inputs.reading.toml_text import key_lines, line_of, statements

# Values that hold what could be taken for keys, headers, comments or ends; some run over several lines.
VALUES = [
    "1", "-2.5e-3", "true", '"a"', "'[x]'", '"a # b"', '"\\" = [z]"', "[1, 2]", "[\n 1,\n 2 # ]\n]",
    "{ a = 1, b = [2] }", '"""\n[no.header]\nno = key\n"""', "'''\n# no comment\n'''", '"""a\\"""b"""',
    '"""one quote""""', '"""two quotes"""""', "'''it''s''''", "1979-05-27", '[{ a = "]" }]', "[[1], [2]]", "''", '""',
]  # fmt: skip
WORDS = ["a", "b-1", "C_2", "7", '"with space"', '"dot.ted"', "'single'", '"q\\"uote"', '"ü"']
PLAIN = {'"with space"': "with space", '"dot.ted"': "dot.ted", "'single'": "single", '"q\\"uote"': 'q"uote', '"ü"': "ü"}
FILLERS = ["", "\n", "# comment = [x]\n", "   \n\t# [t]\n"]


@st.composite
def documents(draw: st.DrawFn) -> tuple[str, dict[str, int]]:
    """A TOML text, and the line of each of its keys."""
    rows, lines = "", {}

    def add(text: str, path: tuple[Part, ...]) -> None:
        nonlocal rows
        rows += draw(st.sampled_from(FILLERS))
        lines[key_path(path)] = rows.count("\n") + 1
        rows += (
            draw(st.sampled_from(["", "  ", "\t"]))
            + text
            + draw(st.sampled_from(["", "  ", " # end", ' # " [', " # ' {"]))
            + "\n"
        )

    def keys(table: tuple[Part, ...]) -> None:
        for word in draw(st.lists(st.sampled_from(WORDS), unique=True, max_size=3)):
            value = draw(st.sampled_from(VALUES))
            second = draw(st.sampled_from([None, *WORDS]))
            path = (*table, PLAIN.get(word, word), *([PLAIN.get(second, second)] if second else []))
            dotted = f"{word}{draw(st.sampled_from(['.', ' . ']))}{second}" if second else word
            add(f"{dotted}{draw(st.sampled_from([' = ', '=']))}{value}", path)

    keys(())
    for number in range(draw(st.integers(0, 3))):
        if draw(st.booleans()):
            add(f"[ table{number} . deep ]", (f"table{number}", "deep"))
            keys((f"table{number}", "deep"))
        else:
            for index in range(draw(st.integers(1, 3))):
                add(f"[[array{number}]]", (f"array{number}", index))
                keys((f"array{number}", index))
                if draw(st.booleans()):
                    add(f"[array{number}.inner]", (f"array{number}", index, "inner"))
    return rows, lines


@settings(deadline=None, derandomize=True)
@given(documents())
@pytest.mark.slow
def test_lines_of_documents_built_with_known_lines(built: tuple[str, dict[str, int]]) -> None:
    text, lines = built
    tomllib.loads(text)  # the text is TOML indeed
    scanned = key_lines(text)
    assert {path: scanned.get(path) for path in lines} == lines


def leaves(value: object, path: tuple[Part, ...] = ()) -> Iterator[tuple[Part, ...]]:
    if isinstance(value, dict) and value:
        for key, inner in value.items():
            yield from leaves(inner, (*path, key))
    elif isinstance(value, list) and value and all(isinstance(item, dict) for item in value):
        for index, inner in enumerate(value):
            yield from leaves(inner, (*path, index))
    else:
        yield path


@pytest.mark.slow
@settings(deadline=None, derandomize=True)
@given(documents())
def test_every_key_the_parser_sees_has_a_line_that_names_it(built: tuple[str, dict[str, int]]) -> None:
    text, _ = built
    scanned, rows = key_lines(text), text.split("\n")
    for path in leaves(tomllib.loads(text)):
        if not path:
            continue
        line = line_of(scanned, path)
        assert line is not None
        around = next(path[:n] for n in range(len(path), 0, -1) if key_path(path[:n]) in scanned)
        name = next(part for part in reversed(around) if isinstance(part, str))
        assert name.replace('"', '\\"') in rows[line - 1]


@settings(deadline=None, derandomize=True)
@given(st.text(alphabet="a.=[]{}\"'#\\\n ,1", max_size=80))
def test_any_text_is_scanned_to_its_end(text: str) -> None:
    found = list(statements(text))
    assert [one.line for one in found] == sorted(one.line for one in found)
    assert all(1 <= one.line <= one.last_line <= text.count("\n") + 1 for one in found)


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_line_ends_of_both_kinds(end: str) -> None:
    assert key_lines(f"[a]{end}b = 1{end}[[c]]{end}d = 2") == {"a": 1, "a.b": 2, "c": 3, "c[0]": 3, "c[0].d": 4}
