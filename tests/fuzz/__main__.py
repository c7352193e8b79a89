"""20 000 inputs: `python -m tests.fuzz [--runs N] [--seed K] [--keep FOLDER]`.

What breaks a command is told, the smallest of each way, and kept as a seed; the exit status is then 1.
"""

import argparse
import hashlib
import sys
import tempfile
import time
import warnings
from pathlib import Path

from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import seed as seeded
from hypothesis import strategies as st

from tests.fuzz.inputs import SOURCES, Input, shared_out
from tests.fuzz.judging import broken, described

RUNS = 20_000
BATCH = 500
CALM = tuple(HealthCheck)


def main() -> int:
    """Batch after batch of each kind in turn; how many broke."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz")
    parser.add_argument("--runs", type=int, default=RUNS)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=float("inf"), help="begin no batch after so many")
    parser.add_argument("--keep", type=Path, default=Path(__file__).parent / "seeds")
    asked = parser.parse_args()
    warnings.simplefilter("error")
    done, failed, number, started = 0, 0, asked.seed, time.monotonic()
    while done < asked.runs and time.monotonic() - started < asked.seconds:
        for odd, each in shared_out(min(BATCH, asked.runs - done)).items():
            failed += _batch(odd, number, each, asked.keep)
            done += each
        print(f"{done} inputs, {failed} kept, {time.monotonic() - started:.0f} s", flush=True)
        number += 1
    return 1 if failed else 0


def _batch(odd: str, number: int, runs: int, keep: Path) -> int:
    """One batch; the inputs that broke a command, one of each way, are kept."""
    seen: dict[str, Input] = {}

    @seeded(number)
    @settings(max_examples=max(runs, 1), phases=[Phase.generate], deadline=None, database=None,
              suppress_health_check=CALM)  # fmt: skip
    @given(st.data())
    def go(data: st.DataObject) -> None:
        one = data.draw(SOURCES[odd])
        for fault in _faults(one):
            if fault not in seen or len(one.content) < len(seen[fault].content):
                seen[fault] = one

    go()
    for fault, one in seen.items():
        text = described(one)
        name = f"{odd.replace(' ', '-')}-{hashlib.sha256(text.encode()).hexdigest()[:8]}.json"
        keep.mkdir(exist_ok=True)
        (keep / name).write_text(text + "\n", encoding="utf-8")
        print(f"{odd}, seed {number}: {fault}: {' '.join(one.arguments)[:100]!r} {name}", flush=True)
    return len(seen)


def _faults(one: Input) -> list[str]:
    with tempfile.TemporaryDirectory() as folder:
        return [fault.split(" ", 2)[0] if fault.startswith("took") else fault for fault in broken(one, Path(folder))]


if __name__ == "__main__":
    sys.exit(main())
