"""Inputs made from right ones: tables with odd entries, texts with damage, odd command lines and environments."""

import datetime
import math
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, Final

import tomli_w
from hypothesis import strategies as st

from tests.fuzz.kinds import FILE, KINDS, NAME, Kind

Path = tuple[str | int, ...]


@dataclass(frozen=True)
class Input:
    """What a command is given: arguments, FILE standing for the file; its bytes; the environment."""

    arguments: tuple[str, ...]
    content: bytes = b""
    environment: dict[str, str] = field(default_factory=dict)


ODD_TEXTS: Final = (
    "", " ", "²", "٣", "x" * 5000, "1" * 5000, "a\nPASS: all good", "\x1b[2J\x1b[31mPASS", "\u202eSSAP", "\x9b31m",
    "\x00", "=1+1", "-", "--help", "@x", "[mm]", "[bold]x[/bold]", "{0}", "%s", "\u2028", "µm", "\ud83d\ude00".encode(
        "utf-16", "surrogatepass").decode("utf-16"), "nan", "1e400", "5,6", "../../etc", "C:\\x", "a.b.c", '"', "'",
)  # fmt: skip
NUMBERS: Final = (
    0, -1, 1, 2, 3, 1e-300, 5e-324, -0.0, 1e12, 1e300, 1.7e308, math.inf, -math.inf, math.nan, 10**18, -(10**18), 0.1,
    100, 1000.0, 1e6, 360.0, 10**400,
)  # fmt: skip
DATES: Final = (datetime.date(2020, 2, 29), datetime.time(7, 32), datetime.datetime(1979, 5, 27, 7, 32, 0, 999999))

odd_values = st.recursive(
    st.sampled_from(ODD_TEXTS)
    | st.sampled_from(NUMBERS)
    | st.sampled_from(DATES)
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.sampled_from(("a", "name", "x_mm", "²")), inner),
    max_leaves=6,
)
KEYS: Final = (
    "", "²", "simulation.²", "fits.0", "fits." + "9" * 5000, "mass_g", "name", "tolerance", "a b", "x\ny", "\x1b[31m",
    "machine", "scene", "rig", "expected", "status",
)  # fmt: skip
odd_keys = st.sampled_from(KEYS) | st.text(max_size=8)


def _paths(value: Any, path: Path = ()) -> Iterator[Path]:
    """Every place in a document."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield (*path, key)
        yield from _paths(inner, (*path, key))


def _parent(document: Any, path: Path) -> Any:
    for step in path[:-1]:
        document = document[step]
    return document


@st.composite
def documents(draw: st.DrawFn, text: str) -> dict[str, Any]:
    """The document of a text with one to three places changed."""
    document = tomllib.loads(text)
    for _ in range(draw(st.integers(1, 3))):
        paths = list(_paths(document))
        if not paths:
            break
        path = draw(st.sampled_from(paths))
        holder, key = _parent(document, path), path[-1]
        value = holder[key]
        match draw(st.sampled_from(("odd", "odd", "scale", "scale", "sign", "drop", "rename", "add", "wrap", "twice"))):
            case "odd":
                holder[key] = draw(odd_values)
            case "scale" if isinstance(value, (int, float)) and not isinstance(value, bool):
                holder[key] = value * 10.0 ** draw(st.integers(-12, 12))
            case "sign" if isinstance(value, (int, float)) and not isinstance(value, bool):
                holder[key] = -value
            case "drop":
                del holder[key]
            case "rename" if isinstance(holder, dict):
                holder[draw(odd_keys)] = holder.pop(key)
            case "add" if isinstance(holder, dict):
                holder[draw(odd_keys)] = draw(odd_values)
            case "wrap":
                holder[key] = [value]
            case "twice" if isinstance(holder, list):
                holder.append(value)
    return document


@st.composite
def damaged(draw: st.DrawFn, text: str) -> bytes:
    """A text with its bytes changed here and there, or written in another way."""
    lines = text.split("\n")
    at = draw(st.integers(0, len(lines) - 1))
    match draw(
        st.sampled_from(("cut", "line", "twice", "swap", "CRLF", "CR", "BOM", "16", "bytes", "deep", "many", "odd"))
    ):
        case "cut":
            return text.encode()[: draw(st.integers(0, len(text)))]
        case "line":
            lines.pop(at)
        case "twice":
            lines.insert(at, lines[at])
        case "swap":
            other = draw(st.integers(0, len(lines) - 1))
            lines[at], lines[other] = lines[other], lines[at]
        case "CRLF" | "CR" as end:
            return text.replace("\n", "\r\n" if end == "CRLF" else "\r").encode()
        case "BOM":
            return b"\xef\xbb\xbf" + text.encode()
        case "16":
            return text.encode("utf-16")
        case "bytes":
            where, raw = draw(st.integers(0, len(text))), text.encode()
            return raw[:where] + draw(st.binary(max_size=8)) + raw[where:]
        case "deep":
            piece = draw(st.sampled_from(("a.", "[", "{a=", "[a.", '"a".', '\\"', '"', "'''x", '"""x')))
            lines.insert(at, piece * draw(st.sampled_from((10, 40, 3000))))
        case "many":
            row = draw(st.sampled_from(("[[bearing]]", "[[machine.handle]]", "k{} = 1", "[t{}]", "[[scene.race]]")))
            lines[at:at] = [row.format(k) for k in range(draw(st.sampled_from((3, 150, 3000))))]
        case "odd":
            lines.insert(at, draw(st.text(max_size=30)))
    return "\n".join(lines).encode("utf-8", "surrogatepass")


@st.composite
def contents(draw: st.DrawFn, kind: Kind) -> bytes:
    """The bytes of a file that once was one of a kind."""
    text = draw(st.sampled_from(kind.texts))
    if kind.plain or draw(st.integers(0, 3)) == 0:
        return draw(damaged(text))
    document = draw(documents(text))
    try:
        made = tomli_w.dumps(document)
    except (TypeError, ValueError, UnicodeError):
        return draw(damaged(text))
    return draw(damaged(made)) if draw(st.integers(0, 9)) == 0 else made.encode("utf-8", "replace")


environments = st.dictionaries(
    st.sampled_from((
        "COLUMNS", "LINES", "TERM", "NO_COLOR", "FORCE_COLOR", "LANG", "LC_ALL", "PYTHONIOENCODING", "ABU_CALC_CACHE",
        "HOME", "XDG_CACHE_HOME", "LOCALAPPDATA", "TMPDIR",
    )),
    st.sampled_from((
        "", "0", "-1", "1", "20", "9" * 20, "dumb", "xterm-256color", "C", "²", "/dev/null", "/nowhere/at/all", "/proc",
        "ascii:strict",
    )),
    max_size=2,
)  # fmt: skip
TARGETS: Final = (
    "out.json", "out.toml", "out.csv", "out.txt", "out.html", "out.svg", "out.dxf", "out.exe", "no/out.json", NAME,
    ".", "/dev/null", "/dev/full", "out\n.json", "\x1b[31m.json", "x" * 300 + ".json", "",
)  # fmt: skip
SHOWN: Final = ("--json", "--full", "--quiet", "--no-color", "--force")


@st.composite
def shown(draw: st.DrawFn) -> tuple[str, ...]:
    """Mostly nothing; now and then how a result is shown, and the files it is written to."""
    if draw(st.integers(0, 2)):
        return ()
    how = draw(st.lists(st.sampled_from(SHOWN), max_size=2, unique=True))
    for _ in range(draw(st.integers(0, 1))):
        how += ["--output", draw(st.sampled_from(TARGETS))]
    if draw(st.integers(0, 9)) == 0:
        how += ["--figure", draw(st.sampled_from(("x=out.svg", "motion=out.png", "out.svg", "=", "a=b=c.svg")))]
    return tuple(how)


PATHS: Final = (
    "machine.mass_kg", "wheel.mass_kg", "bearing[0].radial_load_kN", "bearing.0.name", "bearing[9].name",
    "machine.name", "machine.handle[0].name", "expected.status", "expected.\"fits.0.fit\"", "a.b.c",
    "scene.speed_rpm", "machine", "", "scene.race[0].ball_masses_g", "x" * 300, "[0]", ".", "=", "²",
    "suspension.natural_frequencies_hz", "bearing",
)  # fmt: skip
WORDS: Final = (
    "size", "check-fit", "verify", "validate", "presets", "schema", "explain", "effects", "simulate", "stability",
    "init", "nonsense", "--help", "--version", "--json", "--full", "--quiet", "--no-color", "--output", "--force",
    "--set", "-o", "--scene", "--accuracy", "--duration", "--designation", "--bore", "--outer", "--width",
    "--shaft", "--housing", FILE, "msh-230", "mmg-3200k-knife-shaft", "6203", "k6", "H7", "80", "140", "nan",
    "machine", "result", "capacity", "ABU201", ".", "/", "/dev/null", "/dev/zero", "-", "out.json", "out.csv",
    "out.txt", "no/out.json", "out.exe", "out.json\n",
)  # fmt: skip
QUICK: Final = ("check-fit", "validate", "verify", "effects", "presets", "schema", "explain", "init")
SLOW: Final = frozenset({"size", "simulate", "stability", "accuracy", "verify", "factory", "grinding", "compare"})
"""Commands that take seconds where all is right."""


@st.composite
def command_lines(draw: st.DrawFn) -> tuple[str, ...]:
    """A quick command with options, or words at random."""
    if draw(st.booleans()):
        words = draw(st.lists(st.sampled_from(WORDS) | st.sampled_from(ODD_TEXTS[:-1]), max_size=5))
        return tuple("nonsense" if word in SLOW else word for word in words)
    command = draw(
        st.sampled_from(("check-fit", "validate", "verify", "effects", "presets", "schema", "explain", "init"))
    )
    options: list[str] = []
    for _ in range(draw(st.integers(0, 3))):
        name = draw(st.sampled_from(("--set", "--json", "--full", "--output", "--accuracy", "--bore", "--designation")))
        options.append(name)
        if name == "--set":
            options.append(f"{draw(st.sampled_from(PATHS))}={draw(st.sampled_from(ODD_TEXTS) | st.text(max_size=9))}")
        elif name not in ("--json", "--full"):
            options.append(draw(st.sampled_from(WORDS + ODD_TEXTS)))
    # Without a file all presets are verified, for seconds.
    first = (FILE,) if command == "verify" else ()
    files = draw(st.lists(st.sampled_from((FILE, FILE, "-", "x.toml", "msh-230")), max_size=2))
    return (command, *first, *files, *options)


def files_of(kind: Kind) -> st.SearchStrategy[Input]:
    """Commands for a file of a kind."""
    commands = st.tuples(st.sampled_from(kind.commands), shown()).map(lambda both: both[0] + both[1])
    return st.builds(Input, commands, contents(kind), environments)


lines = st.builds(Input, command_lines(), st.sampled_from(KINDS).flatmap(contents), environments)
"""Odd command lines, and odd files beside them."""

SOURCES: Final = {**{kind.name: files_of(kind) for kind in KINDS}, "command line": lines}
"""All inputs, by what is odd about them."""


HEAVY: Final = 0.2
"""Inputs of a kind that is computed with, for each of another."""


def shared_out(total: int) -> dict[str, int]:
    """How many of so many inputs each kind has."""
    shares = {name: HEAVY if name.startswith("computed") else 1.0 for name in SOURCES}
    each = {name: int(total * share / sum(shares.values())) for name, share in shares.items()}
    return each | {"command line": each["command line"] + total - sum(each.values())}
