"""Which machines any change can cure, by a slow search over all entries that the program knows, alone and together.

    python -m tests.studies.all_changes [lines of actions] [seconds] [lines]

A random sample of the ill machines that their next step does not cure is searched without bound of work, until the
seconds are over. Each change is judged as `abu size` does it, and ends at the first start case that fails. The lines of
actions are those of `tests.studies.actions`; the result has one line of JSON for each machine that was searched.
"""

import itertools
import json
import math
import random
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import tomli_w

import abu_calc
from abu_calc.features.design import study
from abu_calc.features.design.changes import changes_for_starts, more_damping
from abu_calc.features.design.judgement import Judgement, judge
from abu_calc.features.design.next_step import (
    ChangeWatcher,
    Entries,
    NotBetterError,
    next_step,
    proposals,
)
from abu_calc.features.spindle import judgement as advice
from abu_calc.features.spindle import study as two_studies
from abu_calc.features.spindle.judgement import SpindleJudgement
from abu_calc.features.spindle.judgement import judge as judge_two
from abu_calc.foundation.checks import RANK, worst
from abu_calc.foundation.progress import silent
from abu_calc.inputs.read_machine import Machine, variant_of
from abu_calc.sizing import usable
from abu_calc.sizing.actions import PINS, overrides, pins, speeds_from
from abu_calc.sizing.oil import usual_oils
from abu_calc.sizing.proposals import PROPOSED, mended
from abu_calc.sizing.vibration import truer_races
from tests.studies.actions import random_machine

ACCURACY: Final = 0.01
LONGEST: Final = 150.0
"""Seconds of processor time after which the search of a machine ends."""
SEED: Final = 57
"""Of the sample."""
Pool = dict[str, list[Entries]]
"""Changes by their kind; two of one kind exclude each other."""
PINNED: Final = frozenset(f"autobalancer.{key}" for key in PINS)


def pool_of(before: Judgement) -> Pool:
    """Every change for a machine with one race, by kind."""
    design, case = before.design, before.design.case
    own = pins(design.autobalancer)
    bad = [check for check in before.checks if check.requested and check.status != "pass"]
    sizing = [overrides(entries) for entries in mended(design)]
    sizing += [check.overrides for check in bad if check.overrides]
    for check in bad:
        if check.key in PROPOSED and check.code not in TRUER:
            changes, same = PROPOSED[check.key]
            sizing += [overrides({**entries, **own} if same else entries) for entries in changes(design)]
    oils = [entries for entries, _ in usual_oils(case, design.autobalancer)]
    starts = list(changes_for_starts(before.facts, loud=False))
    run = [entries for entries in starts if any(key.startswith("run_up.") for key in entries)]
    balls = [pins(runner_up) for runner_up, _ in design.choice.runners_up if usable(case, runner_up)]
    damping = more_damping(design)
    boundaries = before.region.boundaries or ()
    speeds = [entries for boundary in boundaries[-1:] for entries in speeds_from(case, 1.05 * boundary.speed)]

    def pinned(changes: Iterable[Mapping[str, object]]) -> list[Entries]:
        return [overrides({**own, **entries}) for entries in changes]

    pool = {"sizing": list(dict.fromkeys(sizing)), "balls": pinned(balls), "oil": pinned(oils),
            "truer": pinned([*truer_races(case, design.eccentricity.least), *truer_races(case, 0.0)]),
            "run-up": pinned(run), "speed": pinned(speeds),
            "damping": pinned([damping] if damping else [])}  # fmt: skip
    return {kind: list(dict.fromkeys(changes)) for kind, changes in pool.items() if changes}


TRUER: Final = frozenset({"ABU202", "ABU401", "ABU402", "ABU404"})
"""Checks for which truer races are proposed, a kind of their own."""


def pool_of_two(before: SpindleJudgement) -> Pool:
    """Every change for a machine with two races, alike for both of them."""
    design = before.facts.design
    pool = Pool()
    made = [
        *advice._sturdier(design),
        *advice._truer(design),
        *({"ball_diameter_mm": larger} for larger in advice._larger(design)),
    ]
    for entries in made:
        pool.setdefault("+".join(sorted(entries)), []).append(advice._of_all(design, entries))
    return {kind: list(dict.fromkeys(changes)) for kind, changes in pool.items()}


def all_changes(pool: Pool, most: int) -> Iterator[Entries]:
    """All changes alone, then one each of two kinds, and of as many as three kinds with what sizing mends first."""
    known = set[frozenset[str]]()
    for count in range(1, most + 1):
        for kinds in itertools.combinations(pool, count):
            lists = [pool[kind] for kind in kinds]
            if count > 2:
                lists = [
                    changes[: FIRST[kind]] if kind in FIRST else changes
                    for kind, changes in zip(kinds, lists, strict=True)
                ]
            for changes in itertools.product(*lists):
                entries = as_one(changes)
                if entries and frozenset(entries) not in known:
                    known.add(frozenset(entries))
                    yield entries


FIRST: Final = {"sizing": 2, "balls": 3, "oil": 8}
"""Changes of a kind of which three together are made."""


def as_one(changes: Sequence[Entries]) -> Entries:
    """Changes together; the first that pins balls and race decides these. None if they contradict each other."""
    entries = dict[str, str]()
    for entry in itertools.chain.from_iterable(changes):
        key = entry.partition("=")[0]
        if entries.setdefault(key, entry) != entry and key not in PINNED:
            return ()
    return tuple(entries.values())


def search(machine: Machine, before: Any, changes: Iterable[Entries], judged_by: Any) -> dict[str, Any]:
    """The first change with which all checks pass, and the first that leads to a better verdict."""
    rank, found, end = RANK.index(worst(before.checks)), dict[str, Any](), time.process_time() + LONGEST
    tried, reached, best = 0, 0, None
    for entries in changes:
        if time.process_time() > end:
            return found | {"tried": tried, "simulated": reached, "ended": True}
        trial, tried = ChangeWatcher(before, rank, judged_by, best=best), tried + 1
        try:
            after = judged_by.judged(variant_of(machine, ",".join(entries)), silent, trial)
        except NotBetterError:
            reached += trial.work > 0
            continue
        except abu_calc.AbuError:
            continue
        rank, best = RANK.index(worst(after.checks)), after
        left = [f"{check.code} {check.status}" for check in after.checks if check.requested and check.status != "pass"]
        found["better" if left else "cure"] = {"entries": entries, "left": left, "trial": tried}
        if not left:
            break
    return found | {"tried": tried, "simulated": reached}


def searched(seed: int, folder: Path) -> dict[str, Any]:
    """One machine: what cures it, and what the program tries."""
    kind, tables = random_machine(seed)
    file = folder / f"machine-{seed}.toml"
    file.write_text(tomli_w.dumps(tables), encoding="utf-8")
    machine = abu_calc.read(str(file))
    begun = time.process_time()
    if machine.spindle is not None:
        before: Any = judge_two(machine, two_studies.ACCURACY, silent, 1)
        pool, judged_by, own = (
            pool_of_two(before),
            two_studies._judge(two_studies.ACCURACY, 1),
            [*advice.proposals(before)],
        )
    else:
        with machine.located():
            before = judge(machine.whole("size"), ACCURACY, silent, 1)
        pool, judged_by, own = pool_of(before), study._judge(ACCURACY, 1), [*proposals(before)]
    before_s = time.process_time() - begun
    bad = [f"{check.code} {check.status}" for check in before.checks if check.requested and check.status != "pass"]
    begun = time.process_time()
    step = next_step(machine, before, own, judged_by, silent)
    line = {
        "seed": seed, "kind": kind, "bad": bad, "pool": {name: len(changes) for name, changes in pool.items()},
        "own": len(own), "hurried": step.hurried, "without_success": len(step.without_success),
        "before_s": round(before_s, 1), "step_s": round(time.process_time() - begun, 1),
    }  # fmt: skip
    begun = time.process_time()
    if step.best is not None:
        left = [
            f"{check.code} {check.status}"
            for check in step.best.after.checks
            if check.requested and check.status != "pass"
        ]
        line["step"] = {"entries": step.best.entries, "left": left}
    if "step" in line and not line["step"]["left"]:
        return line
    begun = time.process_time()
    line |= search(machine, before, itertools.chain(own, all_changes(pool, 3)), judged_by)
    return line | {"search_s": round(time.process_time() - begun, 1)}


def share(cured: int, uncured: int, curable: int, searched: int) -> tuple[float, float, float]:
    """Share of the curable machines that their next step cures, with its 95 % interval by Wilson's for a proportion.

    Of the `uncured` ones a sample was `searched`, of which so many are `curable`.

    >>> tuple(round(value, 2) for value in share(33, 50, 13, 20))
    (0.5, 0.45, 0.6)
    """
    part, z = curable / searched, 1.96
    middle, spread = part + z**2 / (2 * searched), z * math.sqrt((part * (1 - part) + z**2 / (4 * searched)) / searched)
    low, high = ((middle + sign * spread) / (1 + z**2 / searched) for sign in (-1, 1))
    best, least, most = (cured / (cured + uncured * each) for each in (part, high, low))
    return best, least, most


def main() -> None:
    """Print each machine of the sample, and the share."""
    source, seconds, path = Path(sys.argv[1]), float(sys.argv[2]), Path(sys.argv[3])
    lines = [json.loads(line) for line in source.read_text(encoding="utf-8").splitlines()]
    ill = [line["seed"] for line in lines if line["word"] not in ("suits", "refused")]
    cured = {line["seed"] for line in lines if line.get("then") == "suits"}
    sample = [seed for seed in ill if seed not in cured]
    random.Random(SEED).shuffle(sample)
    done = (
        {json.loads(line)["seed"] for line in path.read_text(encoding="utf-8").splitlines()} if path.exists() else set()
    )
    end = time.monotonic() + seconds
    with tempfile.TemporaryDirectory() as folder, path.open("a", encoding="utf-8") as file:
        for seed in sample:
            if seed in done:
                continue
            if time.monotonic() > end:
                break
            text = json.dumps(searched(seed, Path(folder)), ensure_ascii=False)
            print(text, flush=True)
            print(text, file=file, flush=True)
    found = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    curable = sum("cure" in line or (line.get("step") or {"left": [""]})["left"] == [] for line in found)
    print(
        len(ill),
        "ill",
        len(cured),
        "cured",
        curable,
        "of",
        len(found),
        "curable",
        share(len(cured), len(sample), curable, len(found)),
    )


if __name__ == "__main__":
    main()
