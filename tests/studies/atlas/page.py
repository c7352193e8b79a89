"""The page of the atlas in the documentation, written from the charts and their records."""

from collections.abc import Iterator
from pathlib import Path
from textwrap import wrap
from typing import Final

from tests.studies.atlas.charts import AtlasChart, place
from tests.studies.atlas.fresh import agreement
from tests.studies.atlas.recipe import FOLDER
from tests.studies.atlas.recipes import RECIPES
from tests.studies.atlas.records import family, letters, record, stored

PAGE: Final = FOLDER.parents[2] / "docs" / "explanation" / "atlas.md"
WIDE: Final = 118
AVERAGED: Final = "cf"
"""Letters whose starts follow averaged equations."""

READING: Final = {
    "a": "No start balances below the natural frequency. Above it, more starts balance at more speed and more drag. "
    "With three balls, friction and contact, single starts rest off balance even at much drag.",
    "b": "With light damping, a slow run-up lets balls stall near the natural frequency; at h₀/ω of 0.02 and less, "
    "many have no time to settle. Hand-held, gravity decides: balls stay at the bottom unless the drag lifts them "
    "(h₀·Ω above g/R_p, here h₀/ω above 0.045), or a quick run-up sets them rolling (ω·t below 12).",
    "c": "On a vertical spindle friction adds to the eccentricity, about as the root of the sum of squares. Above an "
    "eccentricity of 1 the machine is louder with balls than without.",
    "d": "At a soft contact the balls help at every runout. At a stiff one with much runout, wheel and workpiece "
    "bounce, and the machine is louder with balls. The edge lies between 0.2 and 0.5 on the lower axis, where a mark "
    "between cells means either.",
    "e": "An ovality of half the displacement without balls leaves about half of the vibration.",
    "f": "A background above 1.2 times the vibration without balls leaves no eccentricity at which the declared value "
    "falls.",
    "g": "Far above the natural frequency the smallest useful imbalance grows with the mass alone. Near it the machine "
    "is louder without balls, so that smaller imbalances are worth balancing.",
    "h": "A weak motor leaves the balls at the bottom of the race. Gravity holds them there unless the drag lifts them "
    "(h₀·Ω above g/R_p, here h₀/ω above 0.045), or the motor sets them rolling at its start (here above 0.06). "
    "Motors of power tools have 0.1 and more. The rotor itself passes the natural frequency in all cells.",
}
"""What each chart shows, in a sentence or two."""


def starts(some: str) -> int:
    """Number of starts in the records of some letters."""
    return sum(int(row["starts"]) for letter in some for row in stored(letter).values())


def text() -> str:
    """The page."""
    blocks = [*_opening(), *(block for letter in letters() for block in _chart(letter))]
    return "\n\n".join(blocks) + "\n"


def _opening() -> Iterator[str]:
    every = "".join(letters())
    full = starts("".join(letter for letter in every if letter not in AVERAGED))
    cells = sum(len(stored(letter)) for letter in every)
    same, compared = agreement()
    yield "# Atlas of autobalancing"
    yield _wrapped(
        "For a designer: far above the resonance and with enough drag, nearly every start ends balanced. Near the "
        "resonance, with a rough race or very thin oil, some do not, however the balls are chosen. The charts show "
        "where that line runs, for machines of any size. Your own machine needs none of them: `abu size` runs "
        "its own starts."
    )
    yield _wrapped(
        "Charts over dimensionless numbers. Each cell is a command, and each number has its interval in a CSV file "
        "beside the figure."
    )
    yield _wrapped(
        f"The records hold {cells} cells and {starts(every):,} starts. Of these, {full:,} follow the full equations of "
        f"motion. The other {starts(AVERAGED):,} follow averaged equations, as in `abu declare`. Computed again on "
        f"fresh seeds, {same} of {compared} cells drawn at random agreed with the record by a test at 95 %."
    )
    yield "```text\npython -m tests.studies.atlas SECONDS [--chart LETTER] [--starts N]\n" + (
        "python -m tests.studies.atlas SECONDS --fresh 100\n```"
    )
    yield _wrapped(
        "The first command computes cells that the records lack, and goes on where it stopped. The second one computes "
        "cells again on fresh seeds."
    )
    yield _wrapped(
        "Symbols: Ω speed of the rotor, ω natural frequency with the balls, m₀ and m_F effective mass without and with "
        "the autobalancer, U imbalance, n balls of mass m and radius r on the pitch radius R_p, h₀ viscous drag rate, "
        "k_r lever arm of rolling friction, Δ race eccentricity, a amplitude of the race's two lobes, ε runout of the "
        "wheel, k_c contact stiffness, N₀ press force, T_s stall torque of the motor, Ω₀ its no-load speed, I inertia "
        "of all that turns. In the first chart ω is that without the balls."
    )


def _chart(letter: str) -> Iterator[str]:
    panels, rows = family(letter), stored(letter)
    chart, recipe = panels[0], RECIPES[letter]
    yield f"## {chart.title}"
    yield f"![{chart.title}](../../tests/studies/atlas/{chart.file}.png)"
    yield _wrapped(READING[letter])
    own = starts(letter)
    counted = f"{len(rows)} cells, {own:,} starts" if own else f"{len(rows)} cells, without starts"
    facts = {
        "Axes": f"{chart.across.label}; {chart.up.label}.",
        "Value": f"{chart.quantity}. {chart.definition}",
        "Fixed": "; ".join(each.text for each in common(panels)) + ".",
        **({"Each field": _fields(panels)} if len(panels) > 1 else {}),
        "Confidence": chart.confidence,
        "Data": f"`{record(letter).relative_to(FOLDER.parents[2])}`, {counted}.",
    }
    yield "\n".join(_wrapped(f"- {name}: {words}", "  ") for name, words in facts.items())
    last = panels[-1]
    across, up = last.across.values[len(last.across.values) // 2], last.up.values[len(last.up.values) // 2]
    number = int(rows[place(last.name, across, up)]["starts"])
    yield f"The cell at {across:g} and {up:g}{'' if len(panels) == 1 else f' ({last.panel})'}:"
    yield f"```text\n{recipe.command(last, across, up, number or recipe.starts)}\n```"


def common(panels: tuple[AtlasChart, ...]) -> list:  # type: ignore[type-arg]
    """Numbers that are fixed in all panels alike."""
    return [each for each in panels[0].fixed if all(each in panel.fixed for panel in panels)]


def _fields(panels: tuple[AtlasChart, ...]) -> str:
    alike = common(panels)
    own = {panel.panel: [each.text for each in panel.fixed if each not in alike] for panel in panels}
    return "; ".join(f"{name}: {', '.join(texts)}" if texts else name for name, texts in own.items()) + "."


def _wrapped(words: str, indent: str = "") -> str:
    return "\n".join(wrap(words, WIDE, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False))


def write() -> Path:
    """Write the page."""
    PAGE.write_text(text(), encoding="utf-8")
    return PAGE
