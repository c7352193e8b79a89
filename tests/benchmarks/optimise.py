"""Records what an optimum costs: `python -m tests.benchmarks.optimise` (some two minutes of processor).

Of the preset avtovaz-707-222 with the default choices, two processes, wanted share 0.99. The time of all processors is
the one to compare: other work on the machine lengthens the clock only.
"""

import json
import os
import platform
import time
from pathlib import Path

import abu_calc
from abu_calc.features.sweep.execution import versions

RECORD = Path(__file__).parent / "records" / "optimise.json"


def main() -> None:
    """Measure and write the record."""
    begun, used, load = time.perf_counter(), sum(os.times()[:4]), os.getloadavg()[0]
    result = abu_calc.optimise(abu_calc.read("avtovaz-707-222"), share=0.99, workers=2)
    wall, processors = time.perf_counter() - begun, sum(os.times()[:4]) - used
    fresh = result.recommended.fresh_share
    record = {
        "machine": f"{os.cpu_count()} processors, {platform.system()} {platform.machine()}, "
        f"Python {platform.python_version()}",
        "versions": versions("numpy", "scipy", "llvmlite"),
        "load_before": round(load, 1),
        "wall_s": round(wall, 1),
        "processor_s": round(processors, 1),
        "candidates": result.evaluated,
        "samples": result.samples,
        "status": result.status,
        "front": [[point.cost, point.share, point.samples] for point in result.front],
        "recommended": result.recommended.set_,
        "fresh_share": None if fresh is None else fresh.to_dict(),
    }
    RECORD.write_text(json.dumps(record, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
