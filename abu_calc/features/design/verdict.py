"""Verdict of a design in one word and one sentence: whether the machine suits, and what decides it."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Final, Self

from abu_calc.foundation.checks import Check, Grade, worst
from abu_calc.foundation.escaping import shell_word
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.reporting.parts import replaced_entries
from abu_calc.simulation.result import Provenance

WORDS: Final[dict[Grade, str]] = {
    "pass": "suits", "warn": "suits-but", "fail": "does-not-suit", "not-done": "not-known"
}  # fmt: skip
"""The word for the worst grade of all checks."""
SENTENCES: Final[dict[Grade, str]] = {
    "warn": "The machine suits with a reservation", "fail": "The machine does not suit",
    "not-done": "Whether the machine suits is not known",
}  # fmt: skip
VERBS: Final[dict[Grade, tuple[str, str]]] = {
    "warn": ("this check warns", "these checks warn"), "fail": ("this check fails", "these checks fail"),
    "not-done": ("this check is not evaluated", "these checks are not evaluated"),
}  # fmt: skip
"""How the sentence begins, and its verb for one check and for several."""


@record
class Verdict(Record):
    """Whether the machine suits an autobalancer, and the command of the change that was tried, if one mends it."""

    word: Annotated[str, Quantity("verdict", "", 4, "suits, suits-but, does-not-suit or not-known")]
    sentence: Annotated[str, Quantity("in a sentence")]
    next: Annotated[str | None, Quantity("next command")]
    promise: Annotated[
        Mapping[str, str | float | None] | None, Quantity("what the next command moves: path of the result, from, to")
    ]

    @classmethod
    def of(
        cls, checks: Sequence[Check], benefit: str, reading: Provenance, entries: Sequence[str] = (),
        promise: Mapping[str, str | float | None] | None = None, *, incurable: bool = False,
    ) -> Self:  # fmt: skip
        """Verdict of these checks: those of the worst grade decide; `benefit`: a sentence if all pass.

        `reading`: the file, with the entries that a command replaces already, which the next one replaces, too.

        `entries`: those of the change that was tried; `promise`: what it moves; `incurable`: whether none was found.
        """
        grade = worst(checks)
        if grade == "pass":
            return cls(word=WORDS[grade], sentence=benefit, next=None, promise=None)
        deciding = [check for check in checks if check.requested and check.status == grade]
        reasons = "; ".join(dict.fromkeys(map(_reason, deciding)))
        sentence = f"{SENTENCES[grade]}, for {VERBS[grade][len(deciding) > 1]}: {reasons}."
        if incurable and grade == "fail":
            sentence += " No change of the file was found that mends it."
        step = None
        if entries:
            changed = {entry.partition("=")[0] for entry in entries}
            given = (entry.replace(" = ", "=", 1) for entry in replaced_entries(reading))
            kept = (entry for entry in given if entry.partition("=")[0] not in changed)
            options = (f"--set {shell_word(entry)}" for entry in (*kept, *entries))
            step = " ".join(["abu size", shell_word(reading.file or "FILE"), *options])
        return cls(word=WORDS[grade], sentence=sentence, next=step, promise=promise)


def benefit(place: str, before: float | None, after: float | None, limit: float, quiet: float | None) -> str:
    """What the autobalancer does to the level [dB] at a place, and after how long [s], in a sentence."""
    if before is None or after is None:
        return "All checks pass."
    moves = "falls" if after < before else "rises"
    text = f"The idle level at the {place} {moves} from {before:.1f} to {after:.1f} dB (limit {limit:g} dB)"
    return f"{text}." if quiet is None else f"{text}; the machine is quiet {quiet:.2g} s after full speed."


def _reason(check: Check) -> str:
    """Name of a check with its value and limit; if the value keeps the limit, with what its message says first.

    What it says of further start cases stands last, and decides where it is said.
    """
    value, limit = check.value, check.limit
    kept = value is None or limit is None or (value <= limit if check.bound == "most" else value >= limit)
    if kept:
        first = check.message.split(". ")[0]
        further = next((text for text in check.message.split(". ") if text.startswith("Further start cases")), None)
        return f"{check.name} ({(further or first).rstrip('.')})"
    unit = f" {check.unit}" if check.unit else ""
    return f"{check.name} ({value:.4g}{unit}, at {check.bound} {limit:.4g}{unit})"
