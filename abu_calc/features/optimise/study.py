"""The cheapest design of a series: options → candidates → race → front → fresh samples of the recommended one."""

import math
import time
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager, suppress
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import Any, Final

from abu_calc.features.design.study import WORKERS
from abu_calc.features.optimise.answers import OptimiseRequest, answered, asked_of
from abu_calc.features.optimise.choices import Choice, options_of, usual_of_family
from abu_calc.features.optimise.racing import (
    COLUMNS,
    FIRST,
    MOST,
    CandidateRace,
    SampleSource,
    VariantStudy,
    front,
    highest,
    run,
    runners_up,
)
from abu_calc.features.optimise.result import OptimiseResult, SearchSpace, search_space
from abu_calc.features.sweep.batches import RenewableExecutor
from abu_calc.features.sweep.execution import Workers, software
from abu_calc.features.sweep.result import Kept
from abu_calc.features.sweep.store import Store
from abu_calc.features.sweep.study import WAIT, store_path
from abu_calc.foundation import patience
from abu_calc.foundation.errors import AbuError, NotTrustworthyError
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.validity import Range
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.variation import Variants
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.simulate import ACCURACY

RUNS: Final = Range("number of fresh samples", 100, MOST, key="runs")
SAMPLES: Final = Range("number of samples of the race", 100, 100_000_000, key="samples")
FRONT_BUDGET: Final = 1000
"""Samples for the front and the runners-up, beside those of the race."""
PER_VARIANT, AT_LEAST = 20, 4000
"""Samples of the race, if no number is given: so many for each variant, and so many besides."""


@checked
def optimise(
    machines: Machine | Sequence[Machine],
    choose: Mapping[str, Any] | Sequence[str] | None = None,
    *,
    share: float | None = None,
    share_parts: Sequence[str] | str | None = None,
    tolerances: bool | None = None,
    seed: int | None = None,
    runs: int = 1000,
    samples: int | None = None,
    accuracy: float = 0.01,
    store: str | Path | None = None,
    resume: bool = False,
    force: bool = False,
    executor: Executor | None = None,
    workers: int | None = None,
    cluster_wait_s: float = 60.0,
    command: str | None = None,
    progress: Progress = silent,
) -> OptimiseResult:
    """The design of least cost of which the share of all machines built that meets the limits is at least `share`.

    `choose`: values to choose from, by key: "choice(0.005, 0.010)" or a list; as on the command line. What is None is
    that of [optimise] in the file of the first machine. `tolerances`: the drawing's tolerances and the usual scatter of
    use; None: as [sweep] says, true without that table. `runs`: fresh samples of the recommended design; `samples`:
    most samples of the race. Several machines share `share_parts`. The same seed gives the same answer with any
    `executor` or number of `workers`. Raises InputError for what is wrong in files or arguments, NotTrustworthyError
    if no sample gives a number.
    """
    ACCURACY.check(accuracy)
    WORKERS.check(1 if workers is None else workers)
    RUNS.check(runs)
    hands = Workers(workers, executor, WAIT.check(cluster_wait_s))
    path = None if store is None else store_path(store, resume, force)
    hands.refuse_other_software()
    ask = asked_of(machines, choose, share=share, share_parts=share_parts, tolerances=tolerances, seed=seed, most=MOST)
    progress("optimise: candidates")
    options = _options(ask)
    space = search_space(ask.machines, options, ask.share_parts, ask.places)
    budget = PER_VARIANT * len(space.variants) + AT_LEAST if samples is None else int(SAMPLES.check(samples))
    study = _study(ask, space, accuracy, runs)
    kept = None if path else Kept()
    file = kept.folder / "members.sqlite" if kept else path or Path()
    count = 2 * len(space.variants) * MOST
    identity = {**_identity(ask, study, accuracy), "runs": count}
    database = Store.open(file, identity, COLUMNS, frozenset(), force=force and not resume)
    try:
        with _hands(hands) as workers_, hands.noted(database, ask.machines, ask.seed, command):
            source = SampleSource(study, database, workers_, progress)
            return _raced(ask, options, space, source, budget, runs, path)
    except BaseException as ended:
        with suppress(AbuError):
            ended.add_note(f"{database.done} samples")
        raise
    finally:
        database.close()


def _raced(
    ask: OptimiseRequest, options: Sequence[tuple[Choice, ...]], space: SearchSpace, source: SampleSource, budget: int,
    runs: int, path: Path | None,
) -> OptimiseResult:  # fmt: skip
    race = CandidateRace(space.rows, space.costs, ask.share, source, MOST, max(budget, FIRST * len(space.variants)))
    best = run(race)
    computed = "SELECT COUNT(*) FROM members WHERE reason IS NULL"
    if not any(flags.any() for flags in race.met) and not source.store.ask(computed)[0][0]:
        raise NotTrustworthyError("no sample gave a number that can be trusted: run `abu sweep FILE`")
    proven = best is not None
    if best is None:
        best = highest(race)
    race.budget = race.spent + FRONT_BUDGET
    on_front = front(race, best)
    others = runners_up(race, best)
    fresh = [source.fresh(arm, runs) for arm in space.rows[best].tolist()]
    return answered(ask, options, space, race, source, best, proven, on_front, others, fresh, path)


def _options(ask: OptimiseRequest) -> list[tuple[Choice, ...]]:
    if ask.choose is None and len(ask.machines) > 1 and {"balls", "housing"} & set(ask.share_parts):
        return usual_of_family(ask.machines)
    return [options_of(machine, ask.choose, ask.choose_place) for machine in ask.machines]


def _study(ask: OptimiseRequest, space: SearchSpace, accuracy: float, runs: int) -> VariantStudy:
    for variant in space.variants:
        ask.refuse_scattered(variant.machine, variant.values)
    variants = tuple((variant.machine, tuple(sorted(variant.values.items()))) for variant in space.variants)
    fresh = tuple(
        replace(request, runs=runs, seed=ask.seed + 1, sampling="latin-hypercube") for request in ask.requests
    )
    key = sha256(repr((variants, [m.sha256 for m in ask.machines], [m.overrides for m in ask.machines], ask.requests,
                       fresh, accuracy)).encode()).hexdigest()  # fmt: skip
    until = time.time() + patience.left()
    return VariantStudy(
        ask.machines, variants, ask.requests, fresh, accuracy, key, until=until if math.isfinite(until) else math.inf
    )


def _identity(ask: OptimiseRequest, study: VariantStudy, accuracy: float) -> dict[str, Any]:
    """Identity of the samples: machines, variants, scatter, seeds, versions."""
    return {
        "what": "optimise",
        "base": 0,
        "seed": ask.seed,
        "accuracy": accuracy,
        "machines": [Variants.of(machine, MachineFile).content for machine in ask.machines],
        "scatter": [
            {"tolerances": request.tolerances, "vary": {key: way.text for key, way in request.vary},
             "time limit": request.time_limit}
            for request in ask.requests
        ],
        "fresh": study.fresh[0].runs,
        "variants": [{"machine": machine + 1, **dict(values)} for machine, values in study.variants],
        "versions": software(),
    }  # fmt: skip


@contextmanager
def _hands(hands: Workers) -> Iterator[RenewableExecutor]:
    """Executors for all rounds of the race."""
    own = hands.executors()
    try:
        yield own
    except BaseException:
        own.close(at_once=True)
        raise
    own.close()
