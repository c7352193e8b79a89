"""Whether a PASS holds: machines at random, sized, then switched on in ways that sizing did not try, by equations of
motion that share nothing with the product.

    pip install numba
    python -m tests.studies.verdicts [machines] [first] [file of lines]

Each machine of six families that `abu size` passes without a warning on level, balancing, settling and stalling is
switched on 190 times: 70 as its file has it, balls anywhere in the race, turning or not, and run-ups; 80 within the
band that file and drawing promise, 40 within the usual one. Runs that exceed a limit or stall are counted.
The file has one line of JSON for each machine; machines that are in it already are not done again.
"""

import json
import sys
import tempfile
import tomllib
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import abu_calc
from tests.benchmarks.measuring import keep, machine
from tests.studies.outside_equations import COMPILED
from tests.studies.outside_runs import (
    Start,
    band_starts,
    broken,
    coarse_run,
    fine_run,
    near,
    quiet_limit,
    starts,
    with_motor,
)  # fmt: skip
from tests.studies.random_machines import FAMILIES, family_of, machine_text

CODES = "ABU401", "ABU701", "ABU702", "ABU704"
ENOUGH = 200
"""Machines, the least for a record."""


@dataclass(frozen=True)
class Verdict:
    """One machine: what `abu size` says of it, and of how many further runs so many broke the promise."""

    seed: int
    family: str
    status: str
    codes: tuple[str, ...] = ()
    """Checks that do not pass, with their status."""
    warnings: tuple[str, ...] = ()
    """Messages of the checks that warn, of those that a start can break."""
    runs: int = 0
    broken: int = 0
    promised: tuple[int, int] = (0, 0)
    """Runs within the promised band, and how many of them broke a limit."""
    usual: tuple[int, int] = (0, 0)
    how: tuple[dict[str, Any], ...] = field(default=())
    """The runs that broke a limit: which, and by which start."""
    slowest: float = 0.0
    """Quiet time of the slowest run over that permitted."""
    loudest: float = 0.0
    """Level of the loudest run below the limit [dB]."""


def judged(seed: int, folder: Path) -> Verdict:
    """Size the machine, and try to break what it promises."""
    family, file = family_of(seed), folder / f"machine-{seed}.toml"
    text = machine_text(seed, family)
    file.write_text(text, encoding="utf-8")
    try:
        result = abu_calc.size(abu_calc.read(str(file)), workers=1)
    except abu_calc.AbuError as error:
        return Verdict(seed, family, f"refused: {str(error).splitlines()[0]}")
    codes = tuple(f"{check.code} {check.status}" for check in result.checks if check.status != "pass")
    statuses = {check.status for check in result.checks}
    warnings = tuple(check.message for check in result.checks if check.code in CODES and check.status == "warn")
    for status in ("fail", "not-done"):
        if status in statuses:
            return Verdict(seed, family, status, codes, warnings)
    if warnings:
        return Verdict(seed, family, "warn", codes, warnings)
    return tried(seed, family, text, codes, result.to_dict())


def tried(seed: int, family: str, text: str, codes: tuple[str, ...], result: dict[str, Any]) -> Verdict:
    """Random starts and run-ups of a machine that passes."""
    file = tomllib.loads(text)
    limits, how, slowest, loudest = file["limits"], [], 0.0, -200.0
    limit, permitted = quiet_limit(limits), limits["vibration_level_db"]
    runs, bad = Counter[str](), Counter[str]()
    for k, (start, kind) in enumerate(begun(file, result, seed)):
        ending = coarse_run(start, result, limits)
        if near(start, ending, limits):
            ending = fine_run(start, result, limits)
        runs[kind] += 1
        slowest = max(slowest, ending.quiet / limit)
        loudest = max(loudest, ending.level - permitted)
        if why := broken(ending, limits):
            bad[kind] += 1
            told = {
                "start": k,
                "of": kind,
                "kind": start.kind,
                "why": why,
                "race_centre": round(start.machine.offset_angle, 3),
            }
            numbers = {name: round(value, 4) for name, value in asdict(ending).items() if name != "modulus"}
            how.append(told | numbers)
    promised, usual = ((runs[kind], bad[kind]) for kind in (PROMISED, USUAL))
    return Verdict(
        seed, family, "pass", codes, (), runs[OF_FILE], bad[OF_FILE], promised, usual, tuple(how), round(slowest, 3),
        round(loudest, 2),
    )  # fmt: skip


OF_FILE, PROMISED, USUAL = "file", "promised", "usual"


def begun(file: dict[str, Any], result: dict[str, Any], seed: int) -> Iterator[tuple[Start, str]]:
    """Every start, and of which kind its machine is."""
    for start in starts(file, result, seed):
        yield with_motor(start, file), OF_FILE
    if "swing_arm" not in file:
        for start, promised in band_starts(file, result, seed):
            yield with_motor(start, file), PROMISED if promised else USUAL


def summary(verdicts: list[Verdict]) -> dict[str, Any]:
    """Counts, and the worst machines."""
    passed = [one for one in verdicts if one.status == "pass"]
    runs, bad = sum(one.runs for one in passed), sum(one.broken for one in passed)
    statuses = Counter(one.status.split(":")[0] for one in verdicts)
    not_done = [one for one in verdicts if _undone(one)]
    held = [one for one in verdicts if one.family == "held"]
    return {
        "machines": len(verdicts), **{name: statuses[name] for name in ("pass", "warn", "fail", "not-done", "refused")},
        "runs": runs, "broken": bad, "share": bad / max(runs, 1),
        **{f"{name}_{what}": sum(getattr(one, name)[k] for one in passed)
           for name in ("promised", "usual") for k, what in enumerate(("runs", "broken"))},
        "machines_with_promised_broken": sum(one.promised[1] > 0 for one in passed),
        "most_of_one": max((one.broken for one in passed), default=0),
        "held_pass_share": sum(one.status == "pass" for one in held) / max(len(held), 1),
        "share_with_not_done": len(not_done) / max(len(verdicts), 1),
    }  # fmt: skip


def _undone(verdict: Verdict) -> bool:
    """Whether a check was not done for work, not since the balls cannot carry the imbalance or cannot balance it."""
    undone = any(code.endswith("not-done") for code in verdict.codes)
    return undone and not {"ABU201 fail", "ABU103 fail"} & set(verdict.codes)


def by_family(verdicts: list[Verdict]) -> dict[str, Any]:
    """Of each family: machines, passing, runs, broken."""
    found = {}
    for family in FAMILIES:
        own = [one for one in verdicts if one.family == family]
        passed = [one for one in own if one.status == "pass"]
        found[family] = {
            "machines": len(own), "pass": len(passed), "runs": sum(one.runs for one in passed),
            "broken": sum(one.broken for one in passed),
        }  # fmt: skip
    return found


def _known(lines: Path) -> dict[int, Verdict]:
    """Verdicts of an earlier run."""
    if not lines.exists():
        return {}
    entries = (json.loads(line) for line in lines.read_text(encoding="utf-8").splitlines())
    return {
        entry["seed"]: Verdict(
            **entry | {key: tuple(entry[key]) for key in ("codes", "warnings", "how", "promised", "usual")}
        )
        for entry in entries
    }


def main() -> None:
    """Print each machine, and keep the record."""
    count, first = (int(sys.argv[k]) if len(sys.argv) > k else value for k, value in ((1, 400), (2, 0)))
    lines = Path(sys.argv[3] if len(sys.argv) > 3 else Path(tempfile.gettempdir()) / "verdicts.jsonl")
    if not COMPILED:
        print("numba is not installed: the equations run as plain Python, for days. pip install numba", file=sys.stderr)
    known = _known(lines)
    with tempfile.TemporaryDirectory() as folder, lines.open("a", encoding="utf-8") as file:
        for seed in range(first, first + count):
            if seed not in known:
                known[seed] = judged(seed, Path(folder))
                text = json.dumps(asdict(known[seed]))
                print(text, flush=True)
                print(text, file=file, flush=True)
    verdicts = [known[seed] for seed in range(first, first + count)]
    cases = {
        "summary": summary(verdicts), "families": by_family(verdicts),
        "broken": [asdict(one) for one in verdicts if one.broken],
    }  # fmt: skip
    print(json.dumps(cases["summary"]), json.dumps(cases["families"]), sep="\n")
    if count >= ENOUGH:
        what = "machines that pass without a warning, switched on by equations written outside the product"
        print(
            keep("verdicts-of-families", what, "python -m tests.studies.verdicts", machine("not bound"), first, cases)
        )


if __name__ == "__main__":
    main()
