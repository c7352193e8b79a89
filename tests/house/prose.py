"""Lint of the texts that commands print: banned words, headless clauses, long sentences, odd numbers.

    python -m tests.house.prose size msh-230 --full      violations in what `abu size msh-230 --full` prints
    python -m tests.house.prose                          violations in all help texts, schemas, templates and errors
    python -m tests.house.prose --random 300 5000        violations in `abu size` of random machines, from a seed on

Each line names place, rule and text; numbers are replaced by #. `tests/house/test_prose.py` refuses every violation.
Tables, formulas, code and lists of values are no sentences: their length does not count.
"""

import contextlib
import re
import sys
import tempfile
import tomllib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, Final, NamedTuple

from abu_calc.cli.app import COMMANDS

COLUMNS: Final = 80
TALLEST: Final = 26
"""Lines of the screen of `abu size` for one race and two places."""
MOST_WORDS: Final = 25
"""Words of the longest sentence that passes; twenty is the aim."""
BANNED: Final = {
    "unbalance": "imbalance",
    "unbalances": "imbalances",
    "unbalanced": "out of balance",
    "felt mass": "effective mass",
    "mass felt": "effective mass",
    "masses felt": "effective masses",
    "axis motion": "spindle displacement",
    "accuracy budget": "residual-displacement budget",
    "ledger": "list of effects",
    "rung": "model level",
    "rungs": "model levels",
    "tongue": "instability region",
    "tongues": "instability regions",
    "corrected level": "weighted overall level",
    "friction torque of the seat": "slip torque of the seat",
    "as printed": "as published",
    "remedy": "action",
    "remedies": "actions",
    "not done": "NOT EVALUATED",
    "jams": "no operating clearance is left",
    "warmth": "thermal effect",
    "hangs": "stalls",
    "members": "samples",
    "press force": "feed force",
}
"""Words and phrases that the glossary replaces, where they have no other meaning in these texts."""
HEADLESS: Final = re.compile(r"(?:What|Of|Where|Who)\s")
REPEATING: Final = ("Assumed:", "Cost:", "Range:", "Left out:", "Action: See the action of", "Another requirement",
                    "The rule alone asks for", "M7 reaches the required interference",
             "Meant in", "The ring of oil is", "The balls rest after", "Cheapest method")  # fmt: skip
"""Beginnings of sentences that may repeat: computing times, ranges of formulas, effects left out of scenes, and what
holds of each bearing."""
ALL_PASS: Final = re.compile(r"All \d+ start cases, .*, then pass\.$|Then ABU.* still warn\.$")
"""Sentence that stands at each action that makes all start cases pass."""
SENTENCE: Final = re.compile(r"(?<=[.!?])\s+(?=[A-Z])")
ONE_OF_MANY: Final = re.compile(
    r"(?<![\d.,–-])(?<!race )\b1 (?!is |was |has |as |its |this |less |across |does |warns\b|fails\b|passes\b|×)"
    r"([a-z]+s)\b(?!\.\w|[_=])"
)
TINY: Final = re.compile(r"\b\d\.\d+e-1\d\b")
EMPTY: Final = re.compile(r"(?<=[:=(,] )None\b|\"None\"|(?<![\w.\"'`-])(?<!found )(?:nan|NaN|null)(?![\w\"'`-])")
LEGEND: Final = re.compile(r"\[[^\]]+\]\s*(?:[;.,]|$)|[√²·≤≥≈]|[^;]*;[^;]*;[^;]*;")
"""Marks of a formula or of the legend of its symbols, whose length does not count."""
PRESETS: Final = ("avtovaz-707-222", "avtovaz-707-305", "avtovaz-707-370", "msh-230", "swing-arm-grinder")
MARKED: Final = re.compile(r"^\s*(?:[-•*!›]|\d+[.)])\s+")


class Violation(NamedTuple):
    """One breach of a rule in one text."""

    rule: str
    text: str
    place: str

    @property
    def entry(self) -> str:
        """Rule and text, alike for the same violation in several places."""
        return f"{self.rule}: {self.text}"


def paragraphs(text: str) -> Iterator[str]:
    """Running text of a report: lines of a paragraph joined, rows of tables and code left out."""
    lines: list[str] = []
    for line in (*text.splitlines(), ""):
        in_code = "\n".join(lines).count("`") % 2 == 1  # a command in back quotes goes on over a line's end
        prose = bool(line.strip()) and (in_code or not _is_table(line))
        if lines and not in_code and (not prose or MARKED.match(line) or _indent(line) != _indent(lines[-1])):
            yield " ".join(part.strip() for part in lines)
            lines = []
        if prose:
            lines.append(line)


def _is_table(line: str) -> bool:
    """True for rows of a table (gaps between columns), formulas, commands and values."""
    body = MARKED.sub("", line).strip()
    code = ("abu ", "$ ", "--set ", "[", "{", '"', "|")
    return bool(re.search(r"\S {2,}\S", body)) or " = " in body or body.startswith(code)


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip())


def sentences(paragraph: str) -> list[str]:
    """Sentences of a paragraph without the code in it."""
    plain = re.sub(r"`[^`]*`", "CODE", MARKED.sub("", paragraph))
    return [part.strip() for part in SENTENCE.split(plain) if part.strip()]


def violations(text: str, place: str, *, repeats: bool = True) -> Iterator[Violation]:
    """Every breach of the rules in a text that somebody reads; `repeats`: report repeated sentences, too."""
    yield from _of_words(text, place)
    seen = set[str]()
    for paragraph in paragraphs(text):
        for sentence in sentences(paragraph):
            words = len(re.findall(r"[^\W\d_][\w'’-]*", sentence))
            if words > MOST_WORDS and not LEGEND.search(sentence):
                yield Violation(f"{words} words", _normal(sentence), place)
            if HEADLESS.match(sentence) and not sentence.endswith("?"):
                yield Violation("headless", _normal(sentence), place)
            if (
                repeats
                and words > 5
                and sentence[0].isupper()  # else a cell of a table, wrapped
                and sentence in seen
                and not (sentence.startswith(REPEATING) or ALL_PASS.match(sentence) or LEGEND.search(sentence))
            ):
                yield Violation("twice", _normal(sentence), place)
            seen.add(sentence)


def _of_words(text: str, place: str) -> Iterator[Violation]:
    joined = " ".join(re.sub(r"`[^`]*`", "CODE", text).split())
    for banned, better in BANNED.items():
        for found in re.finditer(rf"(?i)(?<![\w.\-=\"]){re.escape(banned)}(?![\w=\-\"])", joined):
            yield Violation(f"{banned} → {better}", _around(joined, found), place)
    for rule, pattern in (("1 of many", ONE_OF_MANY), ("tiny number", TINY), ("no value", EMPTY)):
        for found in pattern.finditer(joined):
            yield Violation(rule, _around(joined, found), place)


def _around(text: str, found: re.Match[str]) -> str:
    """A few words on each side of a find, numbers replaced, so that lists do not change with them."""
    before = text[: found.start()].split()[-4:]
    after = text[found.end() :].split()[:4]
    return _normal(" ".join((*before, found.group(), *after)))


def _normal(text: str) -> str:
    return re.sub(r"\d+(?:\.\d+)?", "#", text)


def described(schema: Any) -> Iterator[str]:
    """Descriptions of a JSON Schema."""
    if isinstance(schema, dict):
        if isinstance(text := schema.get("description"), str):
            yield text
        for value in schema.values():
            yield from described(value)
    elif isinstance(schema, list):
        for value in schema:
            yield from described(value)


def comments(toml: str) -> str:
    """Comments of a TOML file as running text, those of one block joined."""
    tomllib.loads(toml)
    blocks = [line.partition("#")[2].strip() if "#" in line else "" for line in toml.splitlines()]
    return "\n\n".join(block for block in blocks if block)


def static_texts() -> Iterator[tuple[str, str]]:
    """Place and text of everything that is the same for each machine: help, explanations, schemas, templates."""
    from abu_calc.dynamics.effects.registry import REGISTRY
    from abu_calc.features.explain.steps import STEPS
    from abu_calc.foundation.checks import CHECK_CODES
    from abu_calc.inputs.reading.schema import schema_of, template_of
    from abu_calc.inputs.reading.sources import names, text_of
    from tests.cli.runner import abu

    yield "abu --help", abu("--help").out
    for command in COMMANDS:
        text = abu(command, "--help").out
        if "--help-all" in text:
            text = abu(command, "--help-all").out
        yield f"abu {command} --help", text.partition("Output:")[0]
    yield "abu effects", abu("effects").out
    for subject in (*STEPS, *CHECK_CODES, *(name for name, _ in REGISTRY)):
        yield f"abu explain {subject}", abu("explain", subject).out
    for kind in ("machine", "scene", "readings"):
        for text in dict.fromkeys(described(schema_of(kind))):
            yield f"abu schema {kind}", text
        yield f"template of {kind}", comments(template_of(kind))
    for name in names():
        yield f"preset {name}", comments(text_of(name))


def error_texts(folder: Path) -> Iterator[tuple[str, str]]:
    """Place and text of the errors that wrong files give."""
    from tests.cli.runner import abu
    from tests.inputs.reading.test_errors import CASES
    from tests.inputs.samples import BASIC

    file = folder / "machine.toml"
    for old, new, *_ in CASES:
        if old in BASIC:
            file.write_text(BASIC.replace(old, new, 1), encoding="utf-8")
            yield f"error of {new[:40]!r}", abu("validate", str(file)).err.replace(str(file), "machine.toml")


SCREENS: Final = (
    *(("size", name, *more) for name in PRESETS for more in ((), ("--full",), ("--explain",))),
    *(("effects", name, *more) for name in PRESETS for more in ((), ("--full",))),
    ("check-fit", "mmg-3200k-knife-shaft"),
    ("check-fit", "mmg-3200k-knife-shaft", "--full"),
    ("check-fit", "--designation", "6203"),
    ("balance", "sapropel-screw-rig"),
    ("balance", "sapropel-screw-rig", "--full"),
    ("declare", "avtovaz-707-222", "--starts", "100"),
    ("declare", "avtovaz-707-305", "--starts", "100", "--full"),
    *((command, name) for name in PRESETS for command in ("simulate", "stability", "levels")),
    *(("grinding", name) for name in PRESETS[:4]),
    ("compare", "avtovaz-707-222", "msh-230"),
    ("factory",),
    ("explain",),
    ("presets",),
)
"""Commands whose reports are read."""


def screens() -> Iterator[tuple[str, str]]:
    """Place and text of the reports of all presets."""
    from tests.cli.runner import once

    for words in SCREENS:
        seen = once(*words)
        yield f"abu {' '.join(words)}", f"{seen.out}\n\n{seen.err}"


def random_reports(count: int, first: int) -> Iterator[tuple[str, str]]:
    """Place and text of screen and whole report of random machines; prints screens that are too wide or too tall."""
    import tomli_w

    from tests.cli.runner import again
    from tests.studies.actions import random_machine

    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        for seed in range(first, first + count):
            kind, tables = random_machine(seed)
            Path(f"{seed}.toml").write_text(tomli_w.dumps(tables), encoding="utf-8")
            for more in ((), ("--full",)):
                seen = again("size", f"{seed}.toml", *more)
                lines = seen.out.splitlines()
                wide = [line for line in lines if len(line) > COLUMNS and not line.startswith("  abu size ")]
                if wide or seen.status not in (0, 1) or (len(lines) > TALLEST and not more):
                    print(f"{seed} {kind}: status {seen.status}, {len(lines)} lines", *more, *wide)
                yield f"{seed}.toml {' '.join(more)}", f"{seen.out}\n\n{seen.err}"


def found_in(texts: Iterable[tuple[str, str]]) -> list[Violation]:
    """Violations in texts with their places; a schema's descriptions and templates may repeat themselves."""
    once: dict[str, Violation] = {}
    for place, text in texts:
        for each in violations(
            text, place, repeats=not place.startswith(("abu schema", "abu explain", "template", "preset"))
        ):
            once.setdefault(each.entry, each)
    return list(once.values())


def main(arguments: list[str]) -> int:
    """Print the violations of one command's texts, or of all static ones; return 1 if there are any."""
    from tests.cli.runner import abu

    if arguments[:1] == ["--random"]:
        texts: Iterable[tuple[str, str]] = random_reports(int(arguments[1]), int(arguments[2]))
    elif arguments:
        seen = abu(*arguments)
        texts = [(f"abu {' '.join(arguments)}", f"{seen.out}\n\n{seen.err}")]
    else:
        texts = static_texts()
    found = found_in(texts)
    for each in found:
        print(f"{each.place}: {each.entry}")
    return min(len(found), 1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
