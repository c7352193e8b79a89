"""Many machines like one: the share that meets the limits, and the values that decide."""

import time
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from abu_calc.features.design.study import WORKERS
from abu_calc.features.seats.seats import bearing_checks
from abu_calc.features.sweep import answers
from abu_calc.features.sweep.batches import FLAGS, MEMBER, QUANTITIES, REASON, SEED, SampleColumn
from abu_calc.features.sweep.execution import Take, Workers, compute, once_more, software
from abu_calc.features.sweep.limit_advice import advice, failed_limits
from abu_calc.features.sweep.plan import Plan, SweepRequest, asked, planned
from abu_calc.features.sweep.result import Failed, Kept, MeetsLimits, Members, Percentiles, SweepResult, Varied
from abu_calc.features.sweep.samples import SweepStudy
from abu_calc.features.sweep.store import Store, study_of
from abu_calc.features.sweep.store_faults import checked_path, damaged, fault
from abu_calc.features.sweep.tolerance_costs import Compute, Trials, prices
from abu_calc.foundation import patience
from abu_calc.foundation.checks import Check, coded
from abu_calc.foundation.errors import AbuError, InputError, NotTrustworthyError
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.validity import Range
from abu_calc.inputs.read_machine import Machine
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.result import Provenance
from abu_calc.simulation.scene_file import SceneDescription
from abu_calc.simulation.simulate import ACCURACY

WAIT: Final = Range("wait for a cluster", 0, 1e6, unit="s", open_low=True, key="cluster_wait_s")
ROUGH: Final = 256
"""Rows of Saltelli's design below which indices may be off by a tenth and more."""
FEW: Final = 0.05
"""Share of members without numbers beyond which the others speak for too few."""

MORE: Final = "Raise --patience. A store computes those samples with --resume."


@checked
def sweep(
    machine: Machine | SceneDescription,
    vary: Mapping[str, Any] | Sequence[str] | None = None,
    runs: int | None = None,
    *,
    what: str | None = None,
    tolerances: bool | None = None,
    grid: tuple[str, str] | None = None,
    sensitivity: bool | None = None,
    sampling: str | None = None,
    seed: int | None = None,
    accuracy: float = 0.01,
    time_limit_s: float | None = None,
    store: str | Path | None = None,
    resume: bool = False,
    force: bool = False,
    executor: Executor | None = None,
    workers: int | None = None,
    cluster_wait_s: float = 60.0,
    command: str | None = None,
    progress: Progress = silent,
) -> SweepResult:
    """Many machines like this one, or many runs of a scene.

    `vary`: how each value varies, by key: "normal(265, 40)", "100:300:5", a list of values; as on the command line.
    What is None is that of [sweep] in the file. `what`: build (the design is fixed; each member is one machine built
    and switched on once) or design (sized anew). `executor`: any of concurrent.futures, or `workers` processes; the
    members do not depend on it; `cluster_wait_s`: how long a Dask cluster may be without scheduler or workers before
    the sweep ends. Within `patience.limited` members that are not computed in time are told so, and no verdict rests
    on them. `store`: where they go as they come; `resume` goes on with one that is there. `result.members` has
    them as arrays. Raises InputError for what is wrong in file or arguments, NotTrustworthyError where no member gave a
    number.
    """
    ACCURACY.check(accuracy)
    WORKERS.check(1 if workers is None else workers)
    hands = Workers(workers, executor, WAIT.check(cluster_wait_s))
    path = None if store is None else store_path(store, resume, force)
    hands.refuse_other_software()
    ask = asked(
        machine, vary, runs=runs, what=what, tolerances=tolerances, grid=grid, sensitivity=sensitivity,
        sampling=sampling, seed=seed, time_limit_s=time_limit_s,
    )  # fmt: skip
    if resume and path is not None and ask.nothing and (known := study_of(path)):
        ask = _as_stored(path, machine, known, grid, time_limit_s)
    plan = planned(machine, ask, accuracy)
    plan = replace(plan, study=replace(plan.study, until=time.time() + patience.left()))
    kept = None if path else Kept()
    file = kept.folder / "members.sqlite" if kept else path or Path()
    columns, texts = _columns(plan.study)
    database = Store.open(
        file, _identity(plan, accuracy), columns, texts,
        force=force and not resume, time_limit=ask.time_limit,
    )  # fmt: skip
    try:
        with hands.noted(database, [machine], plan.study.sample.seed, command):
            compute(plan.study, database, hands, progress)
        members = Members(file, columns, database.runs, kept)
        progress("sweep: reading the answers")

        def again(study: Trials, numbers: Iterator[int], take: Take) -> None:
            """Compute samples of some studies once more."""
            count = len(study.studies) * len(study.members)
            once_more(study, numbers, take, count, hands, progress)

        return _answered(plan, ask, database, machine, members, path, again)
    except BaseException as ended:
        with suppress(AbuError):  # of a store that cannot even be asked
            ended.add_note(f"{database.done} of {database.runs} samples")
        raise
    finally:
        database.close()


def store_path(given: str | Path, resume: bool, force: bool) -> Path:
    """The path of the store; refused if a study is there that nobody asks to go on with, or a file of another kind."""
    path = checked_path(given)
    if not (resume or force) and study_of(path) is not None:
        raise fault(path, "exists already", "Go on with it by --resume, name another, or overwrite it with --force.")
    return path


def _as_stored(
    path: Path, machine: Machine | SceneDescription, known: Mapping[str, Any], grid: Any, time_limit_s: float | None
) -> SweepRequest:
    """The study that a store was begun with."""
    try:
        return _ask_of(machine, known, grid, time_limit_s)
    except (InputError, LookupError, TypeError, AttributeError) as error:
        raise damaged(path, f"its study cannot be read: {error}") from None


def _ask_of(
    machine: Machine | SceneDescription, known: Mapping[str, Any], grid: Any, time_limit_s: float | None
) -> SweepRequest:
    return asked(
        machine, [f"{key}={known['vary'][key]}" for key in known["order"]], runs=known["base"] or known["runs"],
        what=None if known["what"] == "scene" else known["what"], sensitivity=known["scheme"] == "saltelli",
        sampling="sobol" if known["scheme"] == "sobol" else "latin-hypercube", seed=known["seed"],
        tolerances=False, grid=grid, time_limit_s=time_limit_s,
    )  # fmt: skip


def _columns(study: SweepStudy) -> tuple[tuple[SampleColumn, ...], frozenset[str]]:
    """Columns of the store, and the names of those that hold text."""
    varied = tuple(SampleColumn(factor.key, "varies: " + factor.variation.text) for factor in study.sample.factors)
    texts = {factor.key for factor in study.sample.factors if any(isinstance(v, str) for v in factor.variation.values)}
    return (MEMBER, SEED, *varied, *QUANTITIES[study.what], *FLAGS[study.what], REASON), frozenset(texts)


def _identity(plan: Plan, accuracy: float) -> dict[str, Any]:
    """Identity of the samples, and nothing else: the machine, the variations, seeds, versions."""
    study, sample = plan.study, plan.study.sample
    return {
        "what": study.what,
        "runs": sample.runs,
        "base": sample.base,
        "seed": sample.seed,
        "scheme": sample.scheme,
        "accuracy": accuracy,
        "vary": {factor.key: factor.variation.text for factor in sample.factors},
        "order": [factor.key for factor in sample.factors],
        "file": plan.content,
        "versions": software(),
    }


def _answered(
    plan: Plan,
    ask: SweepRequest,
    store: Store,
    source: Machine | SceneDescription,
    members: Members,
    path: Path | None,
    again: Compute,
) -> SweepResult:
    study, sample = plan.study, plan.study.sample
    store.drawn = sample.drawn
    failed, late = answers.failed(store), answers.left_out(store)
    if (
        failed.members >= store.runs
        or not store.ask(f"SELECT COUNT(*) FROM members WHERE {answers.there(store)}")[0][0]
    ):
        reason = failed.reasons[0].reason
        raise NotTrustworthyError(f"none of {store.runs} samples gave a number that can be trusted: {reason}")
    met = answers.meets(store, study.what)
    by_name, unexplained = answers.sensitivities(store, sample, study.what)
    first = next(iter(by_name), None)
    ranked = by_name[first] if first else ()
    drawn = sample.scheme if any(not factor.variation.listed for factor in sample.factors) else "listed values"
    priced = prices(study, store, ranked, again)
    limits = _limits(plan)
    failing = () if study.what != "build" or late else failed_limits(store, sample, met, limits)
    given, many = ((), 0) if not isinstance(source, Machine) else advice(plan, ask, source, failing, store, again)
    quantities = answers.spreads(store, study.what)
    tables = source.scene if isinstance(source, SceneDescription) else source.tables.machine
    return SweepResult(
        title=getattr(tables, "name", Path(source.file).name),
        checks=(_numbers(failed, late, store.runs), _unless(late, _share(met, ask.least_share))),
        warnings=(*source.warnings, *plan.warnings, *_warnings(plan, store, quantities)),
        provenance=Provenance.of(source),
        what=study.what,
        runs=store.runs,
        seed=sample.seed,
        sampling=drawn,
        varied=tuple(Varied(key=factor.key, how=factor.variation.text) for factor in sample.factors),
        failed=failed,
        quantities=quantities,
        distributions=answers.distributions(store, study.what, limits),
        meets_limits=met,
        basins=answers.basins(store),
        sensitivity_of=first,
        sensitivity=ranked,
        sensitivity_by_quantity=by_name,
        unexplained=unexplained,
        prices=priced,
        failed_limits=failing,
        advice=given,
        tried=many,
        chart=None if plan.grid is None else answers.chart(store, sample, study.what, plan.grid),
        store=None if path is None else str(path),
        members=members,
    )


def _unless(late: int, check: Check) -> Check:
    """The check of a share; not done where members were left out for patience."""
    if not late:
        return check
    message = f"{late} samples were not computed within --patience; of the others: {check.message}"
    return replace(check, status="not-done", message=message, remedy=MORE)


def _numbers(failed: Failed, late: int, runs: int) -> Check:
    share = failed.members / runs
    if late:
        message = f"{late} of {runs} samples were not computed within --patience"
        return coded("ABU821", "not-done", message, share, FEW, MORE)
    message = "every sample gave numbers"
    if failed.members:
        failure = failed.reasons[0]
        message = f"{failed.members} of {runs} samples gave none, {failure.members} of them: {failure.reason}"
    status = "pass" if not failed.members else "warn" if share <= FEW else "not-done"
    remedy = "Check the reasons. Narrow distributions that reach values no machine has." if failed.members else None
    return coded("ABU821", status, message, share, FEW, remedy)  # type: ignore[arg-type]


def _share(met: MeetsLimits, least: float | None) -> Check:
    low, high = met.confidence_interval
    message = f"{met.met} of {met.of} samples meet all limits, by 95 % confidence {100 * low:.1f} to {100 * high:.1f} %"
    if least is None:
        message = (
            "every sample meets all limits"
            if met.met == met.of
            else (f"{met.of - met.met} of {met.of} samples do not; [sweep] least_share sets how many must")
        )
        return coded("ABU822", "pass" if met.met == met.of else "warn", message, met.share, bound="most")
    status = "pass" if low >= least else "warn" if met.share >= least else "fail"
    remedy = (
        None
        if status == "pass"
        else "More samples (--runs) narrow the interval."
        if status == "warn"
        else ("Tighten what the report names, or change the design: `abu size FILE` judges it.")
    )
    return coded("ABU822", status, message, met.share, least, remedy)  # type: ignore[arg-type]


def _limits(plan: Plan) -> dict[str, float]:
    """Limits on the numbers that the file limits."""
    if plan.limits is None:
        return {}
    level = plan.limits.vibration_level_db
    return {"level_db": level, "level_after_db": level, "quiet_time_s": plan.limits.longest_quiet_time}


def _warnings(plan: Plan, store: Store, quantities: Mapping[str, Percentiles]) -> list[str]:
    """Warnings about answers that rest on little."""
    notes = []
    checks = (*plan.design.checks, *bearing_checks(plan.design.case.table.bearing)) if plan.design else ()
    failing = [check.code for check in checks if check.status == "fail"]
    if failing:
        notes.append(f"The design itself does not pass {', '.join(dict.fromkeys(failing))}: see `abu size FILE`.")
    rows = plan.study.sample.base
    if 0 < rows < ROUGH:
        notes.append(f"Sensitivities by {rows} rows of Saltelli's design are rough: --runs {ROUGH} or more do better.")
    if plan.study.what != "design":
        never = store.ask(
            "SELECT COUNT(*) FROM members WHERE reason IS NULL AND quiet_time_s IS NULL AND member < ?",
            (store.drawn,),
        )[0][0]
        if never and quantities["quiet_time_s"].mean is None:
            notes.append(f"{never} samples are never quiet: they count as slowest, and the quiet time has no mean.")
    return notes
