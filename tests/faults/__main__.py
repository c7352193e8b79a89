"""2 000 trials: `python -m tests.faults [--trials N] [--first K] [--record FILE]`; exit status 1 if any went wrong.

They take a quarter of an hour on two processors. The record beside this file is that of the last whole run.
"""

import argparse
import json
import platform
import sys
import tempfile
import time
import warnings
from dataclasses import asdict
from pathlib import Path

from abu_calc.features.sweep.execution import software
from tests.faults.trials import Faults

TRIALS = 2_000
RECORD = Path(__file__).parent / "records" / "faults.json"


def main() -> int:
    """Trial after trial; the record is written as it grows."""
    parser = argparse.ArgumentParser(prog="python -m tests.faults")
    parser.add_argument("--trials", type=int, default=TRIALS)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--record", type=Path, default=RECORD)
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    started = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        faults = Faults(Path(folder))
        for number in range(asked.first, asked.first + asked.trials):
            faults.trial(number)
            if (number + 1) % 50 == 0 or number + 1 == asked.first + asked.trials:
                _write(asked.record, faults, asked.first, number + 1 - asked.first)
                seconds = time.monotonic() - started
                print(f"{number + 1 - asked.first} trials, {len(faults.tally.failures)} failed, {seconds:.0f} s",
                      flush=True)  # fmt: skip
    print(*faults.tally.failures, sep="\n")
    return 1 if faults.tally.failures else 0


def _write(record: Path, faults: Faults, first: int, count: int) -> None:
    record.parent.mkdir(exist_ok=True)
    content = {
        "trials": count,
        "first": first,
        **asdict(faults.tally),
        "software": {key: value for key, value in software().items() if key != "source"},
        "system": f"{platform.system()} {platform.machine()}, Python {platform.python_version()}",
    }
    record.write_text(json.dumps(content, indent=2, ensure_ascii=False, sort_keys=True) + "\n", encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
