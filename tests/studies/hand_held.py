"""Whether verdicts hold over the band: random hand-held machines, switched on by equations outside the product.

    pip install numba
    python -m tests.studies.hand_held [machines that pass] [file of lines]

Each machine that passes without a warning gets 267 runs over the promised band and 133 over the usual one; the latter
include wheels worse than the measured one, up to the margin of the capacity. A third of these machines is horizontal
with four balls. Of machines that warn or fail by dynamics alone, the decisive run and
twenty neighbours are run. A run is made in coarse steps, and again in fine ones if it comes near a limit. One run of
a hundred is repeated in fine steps in any case. The file has a line of JSON for each machine: a later call continues.
"""

import itertools
import json
import math
import sys
import tempfile
import tomllib
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Final

import abu_calc
from abu_calc.inputs.read_machine import read_machine
from abu_calc.sizing import size
from tests.benchmarks.measuring import keep, machine
from tests.studies.decisive_runs import decisive_starts
from tests.studies.outside_runs import band_starts, broken, coarse_run, fine_run, near, quiet_limit
from tests.studies.random_machines import held_text

CODES: Final = {"ABU401", "ABU701", "ABU702", "ABU704"}
"""Checks by dynamics."""
PROMISED, USUAL, CONTROL, STRICT = 267, 133, 100, 88
"""Runs of a machine over either band; each how manieth is repeated; machines that warn or fail."""
MOST_OTHERS: Final = 100
"""Machines that are not horizontal with four balls."""
ENOUGH = 30
"""Machines, the least for a record."""

Line = dict[str, Any]


def sized(seed: int, folder: Path) -> tuple[list[tuple[str, str]], Line]:
    """Checks that do not pass, with their status, and the result of `abu size`."""
    path = folder / f"machine-{seed}.toml"
    path.write_text(held_text(seed), encoding="utf-8")
    result = abu_calc.size(abu_calc.read(str(path)), workers=1)
    return [(check.code, check.status) for check in result.checks if check.status != "pass"], result.to_dict()


def chosen_balls(seed: int, folder: Path) -> int:
    """Balls of the first choice, before it is switched on; 0: none. Hardly any machine gets others later."""
    path = folder / f"machine-{seed}.toml"
    path.write_text(held_text(seed), encoding="utf-8")
    try:
        return size(read_machine(str(path)).whole("size")).autobalancer.ball_count
    except abu_calc.AbuError:
        return 0


def judged(seed: int, folder: Path, *, others: bool, strict: bool) -> Line:
    """The line of a machine; `others`, `strict`: whether such machines are still wanted."""
    file = tomllib.loads(held_text(seed))
    if not others and not (file["machine"]["spindle_axis"] == "horizontal" and chosen_balls(seed, folder) == 4):
        return {"seed": seed, "status": "left out"}
    try:
        checks, result = sized(seed, folder)
    except abu_calc.AbuError as error:
        return {"seed": seed, "status": "refused", "why": str(error).splitlines()[0]}
    balls = result["autobalancer"]["ball_count"]
    line = {"seed": seed, "axis": file["machine"]["spindle_axis"], "balls": balls, "checks": checks}
    hindering = [(code, status) for code, status in checks if code in CODES or status in ("fail", "not-done")]
    if not hindering:
        if not others and balls != 4:
            return {**line, "status": "pass, left out"}
        return {**line, "status": "pass", **passes(file, result, seed)}
    alone = all(code in CODES and status != "not-done" for code, status in hindering)
    if alone and strict and result["ensemble"]["worst_run"]:
        return {**line, "status": "by dynamics", **refused(file, result, seed)}
    return {**line, "status": "by dynamics, left out" if alone else "other"}


def passes(file: Line, result: Line, seed: int) -> Line:
    """Runs over the band of a machine that passes: those that break a limit, and the worst.

    Quiet times in limits, levels above the limit [dB]. `unconfirmed`: runs that are late in coarse steps only.
    """
    limits, how, repeated = file["limits"], [], []
    runs, slowest, loudest, unconfirmed = Counter[str](), 0.0, -200.0, 0
    for k, (start, promised) in enumerate(band_starts(file, result, seed, PROMISED, USUAL)):
        coarse, band = coarse_run(start, result, limits), "promised" if promised else "usual"
        ending = fine_run(start, result, limits) if near(start, coarse, limits) else coarse
        runs[band] += 1
        runs["fine"] += ending is not coarse
        worse = start.of_file is not None and start.machine.imbalance > start.of_file.imbalance
        runs["worse wheel"] += worse
        quiet, level = ending.quiet / quiet_limit(limits), ending.level - limits["vibration_level_db"]
        slowest, loudest = max(slowest, quiet), max(loudest, level)
        if why := broken(ending, limits):
            told = {"run": k, "band": band, "worse wheel": worse, "kind": start.kind, "why": why}
            how.append(told | {"quiet": quiet, "level": level, "slip": ending.slip, "left": ending.left})
        unconfirmed += not why and "late" in broken(coarse, limits)
        if k % CONTROL == seed % CONTROL:
            repeated.append(broken(fine_run(start, result, limits), limits) == why)
    return {
        "runs": dict(runs), "broken": how, "slowest": slowest, "loudest": loudest, "repeated": len(repeated),
        "otherwise": repeated.count(False), "unconfirmed": unconfirmed,
    }  # fmt: skip


def refused(file: Line, result: Line, seed: int) -> Line:
    """What the decisive run breaks, or else the first neighbour that breaks something, of a machine that warns or
    fails; it holds if none does.
    """
    limits = file["limits"]
    for k, start in enumerate(decisive_starts(file, result, seed)):
        ending = coarse_run(start, result, limits)
        if k == 0 or near(start, ending, limits):
            ending = fine_run(start, result, limits)
        if why := broken(ending, limits):
            break
    return {"decisive": result["ensemble"]["worst_run"], "run": k, "why": why, "holds": not why}


def summary(lines: Iterable[Line]) -> Line:
    """Counts of all lines; quiet times in limits, levels above the limit [dB]."""
    lines = list(lines)
    passed, strict = ([line for line in lines if line["status"] == status] for status in ("pass", "by dynamics"))
    found: Line = {
        "sized": sum("checks" in line for line in lines), "pass": len(passed),
        "horizontal_with_four_balls": sum(_kind(line) for line in passed),
        **{key: sum(line[key] for line in passed) for key in ("repeated", "otherwise", "unconfirmed")},
    }  # fmt: skip
    found |= {band: _counts(passed, band) for band in ("promised", "usual", "worse wheel")}
    found["decisive"] = {"machines": len(strict), "hold": sum(line["holds"] for line in strict)}
    return found


def _counts(passed: list[Line], band: str) -> Line:
    """Runs over a band, those that break a limit, and the worst of them."""
    bad = [[run for run in line["broken"] if run["band"] == band or run.get(band)] for line in passed]
    count, all_bad = sum(line["runs"][band] for line in passed), list(itertools.chain(*bad))
    return {
        "runs": count, "broken": len(all_bad), "share": len(all_bad) / max(count, 1), "machines": sum(map(bool, bad)),
        "never quiet": sum(math.isinf(run["quiet"]) for run in all_bad),
        "slowest": max((run["quiet"] for run in all_bad if math.isfinite(run["quiet"])), default=None),
        "loudest": max((run["level"] for run in all_bad), default=None),
    }  # fmt: skip


def _kind(line: Line) -> bool:
    return line["axis"] == "horizontal" and line["balls"] == 4


def main() -> None:
    """Print each machine, and keep the record."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 150
    path = Path(sys.argv[2] if len(sys.argv) > 2 else Path(tempfile.gettempdir()) / "hand-held.jsonl")
    lines = [json.loads(text) for text in path.read_text().splitlines()] if path.exists() else []
    with tempfile.TemporaryDirectory() as folder, path.open("a") as file:
        for seed in itertools.count(len(lines)):
            passed = [line for line in lines if line["status"] == "pass"]
            if len(passed) >= count:
                break
            others = sum(not _kind(line) for line in passed) < MOST_OTHERS * count / 150
            strict = sum(line["status"] == "by dynamics" for line in lines) < STRICT
            lines.append(judged(seed, Path(folder), others=others, strict=strict))
            text = json.dumps(lines[-1])
            print(text, flush=True)
            print(text, file=file, flush=True)
    kept(lines)


def kept(lines: list[Line]) -> None:
    """Print the summary, and keep it with every machine of which a run breaks a limit, and those that are refused."""
    cases = {"summary": summary(lines), "broken": [line for line in lines if line.get("broken")],
             "decisive": [line for line in lines if "holds" in line]}  # fmt: skip
    print(json.dumps(cases["summary"]))
    if cases["summary"]["pass"] >= ENOUGH:
        what = "hand-held machines over the band, switched on by equations written outside the product"
        print(keep("verdicts", what, "python -m tests.studies.hand_held", machine("not bound"), 0, cases))


if __name__ == "__main__":
    main()
