"""Results of many machines, frozen before a rebuild and compared after it: JSON, screen, full text, page.

    python -m tests.house.frozen write FOLDER [machines]      presets, examples, cases, so many random machines
    python -m tests.house.frozen compare FOLDER [machines]    what differs now: numbers by more than 1e-9, any text

Computing times are left out. Each command line is a process of its own, two at a time. A folder that was written
remembers its machines; a command line that is in it already is not written again. A copy of it needs a name as long,
since texts are wrapped.
"""

import json
import math
import random
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Final

import tomli_w

from tests.studies.random_machines import family_of, machine_text

ROOT: Final = Path(__file__).parents[2]
FILES: Final = ("presets", "docs/examples", "tests/machines")
MACHINES, FIRST, EQUAL = 200, 30_000, 1e-9
"""Random machines, the seed of the first, and the relative difference of numbers that are equal."""
TIMES: Final = re.compile(r"(evaluations[^;.]{0,60}?),\s+[\d.]+\s+s\b")
TIMED: Final = frozenset({"wall_s"})
"""Computing times, in texts and in JSON."""
WRITTEN: Final = ("json", "txt", "html")
DESIGNATIONS: Final = ("608", "6203", "6205-2RS", "6208", "7205", "NU208", "30205", "22210", "HK2020", "51108", "7516")


def commands(file: Path) -> Iterator[tuple[str, ...]]:
    """Commands that take a file, by the tables it has."""
    tables = tomllib.loads(file.read_text(encoding="utf-8"))
    if "scene" in tables:
        yield ("simulate",)
    elif "run" in tables:
        yield ("balance",)
    elif "machine" in tables and "autobalancer" in tables:
        yield from (("size",), ("grinding",), ("stability",), ("effects",))
    if "bearing" in tables:
        yield ("check-fit",)


def bearings(seed: int) -> str:
    """A file with two bearings, everything about their seats random."""
    rng = random.Random(seed)
    tables = list[dict[str, Any]]()
    for number in range(2):
        table: dict[str, Any] = {"name": f"bearing {number}", "designation": rng.choice(DESIGNATIONS)}
        choices: dict[str, Any] = {
            "radial_load_kN": rng.uniform(0.05, 8), "axial_load_kN": rng.random(), "speed_rpm": rng.uniform(9, 9e3),
            "shaft_fit": rng.choice(["g6", "h6", "js5", "k5", "k6", "m6", "p6"]), "housing_rz_um": rng.uniform(1, 9),
            "housing_fit": rng.choice(["G7", "H7", "J7", "K7", "M7", "N7"]), "shaft_rz_um": rng.uniform(1, 6),
            "shaft_limits_um": [-4.0, 9.0], "asked_interference_um": [2.0, rng.uniform(12, 60)],
            "ring_temperature_difference_K": rng.uniform(-5, 15), "temperature_range_K": [-40.0, rng.uniform(10, 80)],
            "housing_material": rng.choice(["aluminium", "magnesium", "cast-iron"]), "internal_clearance": "C3",
            "inner_ring_load": rng.choice(["stationary", "indeterminate"]), "housing_outer_mm": rng.uniform(150, 300),
            "starting_torque_N_m": rng.uniform(0.5, 40), "lubricant_viscosity_mm2_per_s": rng.uniform(5, 90),
        }  # fmt: skip
        table |= {key: value for key, value in choices.items() if rng.random() < 0.4}
        tables.append(table)
    return tomli_w.dumps({"machine": {"name": f"bearings {seed}"}, "bearing": tables})


def lines(folder: Path, machines: int) -> dict[str, tuple[str, ...]]:
    """Command lines by the names of their results. Random files are written into the folder: machines are sized alone,
    bearings judged.
    """
    files = {
        f"{path.parent.name}-{path.stem}": path for place in FILES for path in sorted((ROOT / place).glob("*.toml"))
    }
    named = {
        f"{name}-{command[0]}": (*command, path.relative_to(ROOT).as_posix())
        for name, path in files.items()
        for command in commands(path)
    }
    for seed in range(FIRST, FIRST + machines):
        path = folder / f"random-{seed}.toml"
        if not path.exists():
            path.write_text(machine_text(seed, family_of(seed)), encoding="utf-8")
        named[f"{path.stem}-size"] = ("size", str(path))
        path = folder / f"bearings-{seed}.toml"
        if not path.exists():
            path.write_text(bearings(seed), encoding="utf-8")
        named[f"{path.stem}-check-fit"] = ("check-fit", str(path), "--explain")
    return named


def outcome(name: str, line: tuple[str, ...], folder: Path) -> dict[str, Any]:
    """What a command line prints and writes, and its exit status."""
    files = {kind: folder / f"{name}.new.{kind}" for kind in WRITTEN}
    options = [word for path in files.values() for word in ("-o", str(path))]
    call = (sys.executable, "-m", "abu_calc", *line, *options, "--force", "--no-color")
    done = subprocess.run(call, capture_output=True, text=True, encoding="utf-8", check=False, cwd=ROOT)
    texts = {"screen": done.stdout, "errors": done.stderr}
    for kind, path in files.items():
        if path.exists():
            texts[kind] = path.read_text(encoding="utf-8")
            path.unlink()
    for old, new in ((f"{name}.new.", f"{name}."), (str(ROOT), "ROOT"), (str(folder), "FOLDER")):
        texts = {kind: text.replace(old, new) for kind, text in texts.items()}
    result = json.loads(texts.pop("json", "null"))
    return {"status": done.returncode, "result": result, **{kind: text.splitlines() for kind, text in texts.items()}}


def timeless(kept: dict[str, Any]) -> dict[str, Any]:
    """An outcome whose texts tell no computing time."""
    texts = {kind: "\n".join(lines) for kind, lines in kept.items() if kind not in ("status", "result")}
    return {**kept, **{kind: TIMES.sub(r"\1", text).splitlines() for kind, text in texts.items()}}


def differences(old: Any, new: Any, path: str = "") -> Iterator[str]:
    """Paths at which two results differ, with both values."""
    if isinstance(old, dict) and isinstance(new, dict):
        for key in dict.fromkeys((*old, *new)):
            if key not in TIMED:
                yield from differences(old.get(key), new.get(key), f"{path}.{key}")
    elif isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        for k, pair in enumerate(zip(old, new, strict=True)):
            yield from differences(*pair, f"{path}[{k}]")
    elif isinstance(old, float) and isinstance(new, float):
        if not math.isclose(old, new, rel_tol=EQUAL, abs_tol=1e-15):
            yield f"{path}: {old!r} → {new!r}"
    elif old != new:
        yield f"{path}: {old!r} → {new!r}"


def main() -> int:
    """Write or compare; the status is 1 if anything differs."""
    action, folder = sys.argv[1], Path(sys.argv[2]).absolute()
    folder.mkdir(parents=True, exist_ok=True)
    named = lines(folder, int(sys.argv[3]) if len(sys.argv) > 3 else MACHINES)
    kept = {name: folder / f"{name}.frozen.json" for name in named}
    wanted = {name: line for name, line in named.items() if kept[name].exists() == (action == "compare")}
    changed = 0
    with ThreadPoolExecutor(2) as pool:
        for name, new in zip(
            wanted, pool.map(lambda each: outcome(each[0], each[1], folder), wanted.items()), strict=True
        ):
            if action == "write":
                kept[name].write_text(json.dumps(new, ensure_ascii=False), encoding="utf-8")
                continue
            changes = list(differences(timeless(json.loads(kept[name].read_text(encoding="utf-8"))), timeless(new)))
            changed += bool(changes)
            print(*(f"{name}{each}" for each in changes), sep="\n", end="\n" * bool(changes), flush=True)
    print(
        f"{len(wanted)} command lines, {changed} with a difference" if action == "compare" else f"{len(wanted)} written"
    )
    return int(bool(changed))


if __name__ == "__main__":
    sys.exit(main())
