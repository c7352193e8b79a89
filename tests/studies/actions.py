"""Whether the next step of a machine holds: random machines of all layouts, each next step followed literally.

    python -m tests.studies.actions [machines] [first] [file of lines]

Machines that do not simply suit get a next step with its promise, or none. Its command is followed as printed: the
promised number has to come true, no check may get worse, and what is said of all checks has to be true of all. The
file has one line of JSON for each machine; machines that are in it already are not done again.
"""

import json
import math
import shlex
import sys
import tempfile
import time
import tomllib
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import numpy as np
import tomli_w

import abu_calc
from abu_calc.foundation.checks import RANK, Check
from abu_calc.inputs.read_machine import Machine, variant_of
from tests.benchmarks.measuring import keep, machine
from tests.studies.bounded_work import working_machine
from tests.studies.random_machines import family_of, machine_text

ENOUGH: Final = 100
"""Machines, the least for a record."""
EXACT: Final = 1e-9
"""Relative difference from a promise that counts as none."""


def random_machine(seed: int) -> tuple[str, dict[str, Any]]:
    """Kind and tables of a machine: of each ten one has two races, one is fixed on a bench; a third names its oil."""
    if seed % 10 == 9:
        return "two races", working_machine(seed)
    rng = np.random.default_rng((seed, 57))
    family = family_of(seed)
    file = tomllib.loads(machine_text(seed, family))
    if seed % 10 == 8 and family == "held":
        family = "fixed"
        file["machine"]["held"] = "as-given"
        file["suspension"] = {
            "model": "springs", "natural_frequencies_hz": [float(rng.uniform(10, 60))],
            "damping_ratios": [float(rng.uniform(0.02, 0.2))],
        }  # fmt: skip
    if rng.random() < 1 / 3:
        file["autobalancer"].pop("rolling_drag_per_s")
        file["oil"] = {"grade": str(rng.choice(["VG 22", "VG 46", "VG 68", "VG 100"])), "fill_ml": 1.0}
    return family, file


def followed(machine: Machine, result: Any) -> tuple[str, list[str]]:
    """The verdict with the next step, and what does not come true of it."""
    words = shlex.split(result.verdict.next)
    entries = [words[k + 1] for k, word in enumerate(words) if word == "--set"]
    after = abu_calc.size(variant_of(machine, ",".join(entries)), workers=1)
    return after.verdict.word, list(faults(result, after))


def faults(before: Any, after: Any) -> Iterator[str]:
    """What is not as promised."""
    grades = {_key(check): check.status for check in before.checks if check.requested}
    for check in after.checks:
        if check.requested and RANK.index(check.status) < RANK.index(grades.get(_key(check), "pass")):
            yield f"{check.code} got worse: {check.status}"
    promise = before.verdict.promise
    for result, told in ((before, promise["from"]), (after, promise["to"])):
        value = at(result.to_dict(), promise["path"])
        same = value == told or (
            isinstance(value, float) and isinstance(told, float) and math.isclose(value, told, rel_tol=EXACT)
        )
        if not same:
            yield f"{promise['path']} is {value}, told {told}"
    left = [check.code for check in after.checks if check.requested and check.status != "pass"]
    for check in before.checks:
        text = check.remedy or ""
        if "All checks then pass" in text and left:
            yield f"{check.code} says that all pass: {left} do not"
        if "still warn" in text and not all(code in text for code in left):
            yield f"{check.code} does not name all of {left}"


def at(result: Any, path: str) -> Any:
    """Value of a result at a path with points."""
    for key in path.split("."):
        result = result if result is None else result[int(key)] if isinstance(result, list) else result[key]
    return result


def _key(check: Check) -> tuple[str, str]:
    return check.code, check.name


def judged(seed: int, folder: Path) -> dict[str, Any]:
    """One machine: its verdict, its next step followed."""
    kind, tables = random_machine(seed)
    file = folder / f"machine-{seed}.toml"
    file.write_text(tomli_w.dumps(tables), encoding="utf-8")
    found: dict[str, Any] = {"seed": seed, "kind": kind}
    begun = time.process_time()
    try:
        source = abu_calc.read(str(file))
        result = abu_calc.size(source, workers=1)
    except abu_calc.AbuError as error:
        return found | {"word": "refused", "why": str(error).splitlines()[0]}
    bad = [f"{check.code} {check.status}" for check in result.checks if check.requested and check.status != "pass"]
    found |= {"word": result.verdict.word, "bad": bad, "seconds": round(time.process_time() - begun, 1)}
    if result.verdict.next is None:
        return found
    word, wrong = followed(source, result)
    changed = result.verdict.next.partition(".toml ")[2]
    return found | {"next": changed, "promise": result.verdict.promise, "then": word, "faults": wrong}


def summary(lines: list[dict[str, Any]]) -> dict[str, Any]:
    """Counts of all machines."""
    words = Counter(line["word"] for line in lines)
    ill = [line for line in lines if line["word"] not in ("suits", "refused")]
    stepped = [line for line in ill if "next" in line]
    return {
        "machines": len(lines), **words, "with_a_next_step": len(stepped),
        "that_then_suit": sum(line["then"] == "suits" for line in stepped),
        "with_a_fault": sum(bool(line["faults"]) for line in stepped),
        "share_with_a_next_step": len(stepped) / max(len(ill), 1),
    }  # fmt: skip


def main() -> None:
    """Print each machine, and keep the record."""
    count, first = (int(sys.argv[k]) if len(sys.argv) > k else value for k, value in ((1, 300), (2, 0)))
    lines = Path(sys.argv[3] if len(sys.argv) > 3 else Path(tempfile.gettempdir()) / "actions.jsonl")
    known = {}
    if lines.exists():
        known = {line["seed"]: line for line in map(json.loads, lines.read_text(encoding="utf-8").splitlines())}
    with tempfile.TemporaryDirectory() as folder, lines.open("a", encoding="utf-8") as file:
        for seed in range(first, first + count):
            if seed not in known:
                known[seed] = judged(seed, Path(folder))
                text = json.dumps(known[seed], ensure_ascii=False)
                print(text, flush=True)
                print(text, file=file, flush=True)
    every = [known[seed] for seed in range(first, first + count)]
    cases = {"summary": summary(every), "faults": [line for line in every if line.get("faults")]}
    print(json.dumps(cases["summary"]))
    if count >= ENOUGH:
        what = "random machines of all layouts, the next step of each followed as printed"
        print(keep("actions", what, "python -m tests.studies.actions", machine("not bound"), first, cases))


if __name__ == "__main__":
    main()
