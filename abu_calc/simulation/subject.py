"""Subject of a scene's study: a scene of a sized machine, of a scene file, or made in a script.

All keep every effect there is data for. The estimated influence of the effects decides which of them are simulated, see
`Subject.ledger`.

Choice of the effects to simulate: those whose absence would be seen at the requested accuracy.

An estimate of an influence holds at steady state. So a run without light effects is held against one with them, and
what that changes counts as error. `audit` simulates the scene once more with every effect in, to the same accuracy.
"""

import math
import time
from collections.abc import Sequence, Set
from contextlib import AbstractContextManager, nullcontext, suppress
from dataclasses import field, replace
from pathlib import Path
from typing import Annotated, Final

import numpy as np

from abu_calc.dynamics.effect import EffectInfluence
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.dynamics.trajectory import Array
from abu_calc.foundation.errors import InputError, NotTrustworthyError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import shown, to_si
from abu_calc.foundation.validity import Range
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.reading.document import FileReading
from abu_calc.simulation.arguments import check_effects, one_of
from abu_calc.simulation.model_level import difference
from abu_calc.simulation.quiet import lasting
from abu_calc.simulation.response import Course, Response, evaluate, sampling
from abu_calc.simulation.result import Provenance
from abu_calc.simulation.scene_file import SceneDescription
from abu_calc.simulation.scene_of_design import SCENES, STARTS, WORST, scene_of_design
from abu_calc.simulation.scene_of_file import scene_from
from abu_calc.simulation.simulate import ACCURACY, Simulation, run_difference, simulate, tolerances, usual_work
from abu_calc.sizing import size
from abu_calc.sizing.design import Design

SHARE: Final = 0.5
"""Share of the accuracy that all omitted effects together may use.

The rest is for the errors of integration.
"""


@record
class EffectEntry(Record):
    """One effect: whether it was simulated, what leaving it out would change, and why."""

    name: Annotated[str, Quantity("effect")]
    included: Annotated[bool, Quantity("simulated")]
    weight: Annotated[float | None, Quantity("weight", "", 2, "what leaving it out changes; None: nothing cheap tells")]
    why: Annotated[str, Quantity("why")]


@dataclass(frozen=True)
class Ledger:
    """The scene to simulate, and what stands for each effect there is data for; `promise`: weight of what is out.

    `spared`: what those left out for being light take of the accuracy, by estimate and, once simulated, as measured;
    the rest is for the integration. `whole`: the scene with them.
    """

    scene: Scene
    entries: tuple[EffectEntry, ...]
    whole: Scene
    spared: float = 0.0

    @property
    def promise(self) -> float:
        """Largest expected influence of the omitted effects, as far as it is known."""
        return sum((entry.weight or 0.0) for entry in self.entries if not entry.included)


def chosen(
    full: Scene,
    accuracy: float,
    wanted: Sequence[str] = (),
    unwanted: Sequence[str] = (),
) -> Ledger:
    """The scene with the effects it calls for, out of one that has all there is data for.

    The lightest are left out as long as they weigh no more together than half the accuracy; an effect of unknown weight
    is in. Events take the most work: where as many remain without the light effects, only those are left out that act
    on nothing. `wanted` and `unwanted` are asked for by name.
    """
    weights = {effect.name: effect.weight(full) for effect in full.effects}
    light = _light(weights, accuracy)
    idle = frozenset(name for name in light if not weights[name].value)
    switching = {effect.name for effect in full.effects if effect.switching(full)}.difference(unwanted, idle)
    out = light if switching <= light or not light.isdisjoint(switching) else idle
    entries = tuple(
        EffectEntry(
            name=name, included=name in wanted or (name not in out and name not in unwanted), weight=weight.value,
            why=f"asked for; {weight.why}" if name in wanted
            else f"left out by request; {weight.why}" if name in unwanted
            else _why(weight, name in light, name in out),
        )
        for name, weight in weights.items()
    )  # fmt: skip
    scene = _without(full, {entry.name for entry in entries if not entry.included})
    spared = sum(weights[name].value or 0.0 for name in out.difference(wanted, unwanted))
    return Ledger(scene, entries, _without(full, {*unwanted}.difference(wanted)), spared)


def _without(scene: Scene, names: Set[str]) -> Scene:
    """The scene without effects of these names."""
    return replace(scene, effects=tuple(effect for effect in scene.effects if effect.name not in names))


def simulate_chosen(
    ledger: Ledger, accuracy: float, sample_times: Sequence[float] | Array = (), most_evaluations: int | None = None,
    integrator: str = "auto", progress: Progress = silent,
) -> tuple[Ledger, Simulation]:  # fmt: skip
    """Simulation of known accuracy with the effects it needs, and what then stands for each effect.

    Without light effects, if one run with them shows that they change little enough: its difference is part of the
    error. Otherwise with them. Raises NotTrustworthyError as `simulate` does.
    """
    if not ledger.spared:
        return ledger, simulate(ledger.scene, accuracy, sample_times, most_evaluations, integrator, progress)
    most, changed = most_evaluations or usual_work(ledger.whole, integrator), math.inf
    began, spent = time.perf_counter(), 0
    with suppress(NotTrustworthyError):  # of no matter to the scene with all effects
        own = max(accuracy * (1 - SHARE), ACCURACY.low)
        run = simulate(ledger.scene, own, sample_times, most, integrator, progress)
        spent += run.cost.work
        progress(f"{ledger.whole.name}: with the effects left out")
        tolerance = run.cost.tolerance if run.rung == "equations" else tolerances(own)[1]
        with_them, evaluations, work = _once(ledger.whole, tolerance, most - spent, integrator)
        spent, changed = spent + work, run_difference(run.scene, run.response, with_them)
        if run.error_estimate + max(changed, ledger.spared) <= accuracy:
            cost = replace(run.cost, evaluations=run.cost.evaluations + evaluations, work=spent,
                           wall_s=time.perf_counter() - began)  # fmt: skip
            return replace(ledger, spared=max(changed, ledger.spared)), replace(run, cost=cost)
    run = simulate(ledger.whole, accuracy, sample_times, max(most - spent, 1), integrator, progress)
    seen = f"changed the results of this run by {changed:.2g}" if changed < math.inf else "led the balls another way"
    why, names = f"light at steady state, but leaving it out {seen}", {effect.name for effect in ledger.whole.effects}
    entries = tuple(
        replace(entry, included=True, why=why) if entry.name in names and not entry.included else entry
        for entry in ledger.entries
    )
    return Ledger(ledger.whole, entries, ledger.whole), run


def _once(scene: Scene, tolerance: float, most: int, integrator: str) -> tuple[Response, int, int]:
    """Response of one run, its evaluations and its work."""
    scene, _ = with_parted_balls(lasting(scene, None, "scene.duration"))
    equations, course = assemble(scene), Course(scene)
    choice = choose(equations, integrator, tolerance)
    times = sampling(scene, np.empty(0)).read_by(course)
    run = choice.integrate(equations, tolerance, times, choice.evaluations(max(most, 1)))
    return evaluate(scene, run, course), run.evaluations, choice.work(run)


def _light(weights: dict[str, EffectInfluence], accuracy: float) -> frozenset[str]:
    """The lightest effects that weigh no more together than their share of the accuracy."""
    known = [(weight.value, name) for name, weight in weights.items() if weight.value is not None]
    share = min(SHARE * accuracy, accuracy - ACCURACY.low)
    out, total = set(), 0.0
    for value, name in sorted(known):
        total += value
        if total > share:
            break
        out.add(name)
    return frozenset(out)


def _why(weight: EffectInfluence, light: bool, out: bool) -> str:
    if weight.value is None:
        return f"not estimated, so simulated: {weight.why}"
    kept = "" if light == out else ", but leaving it out would save no work"
    return f"{'within' if light else 'beyond'} the accuracy{kept}: {weight.why}"


@record
class Audit(Record):
    """The same scene once more with every effect in: what that changed beside what was promised."""

    difference: Annotated[float, Quantity("difference", "", 2)]
    promise: Annotated[float, Quantity("weights of what was left out", "", 2)]
    effects: Annotated[tuple[str, ...], Quantity("taken in for the audit")]
    evaluations: Annotated[int, Quantity("evaluations of the equations")]
    wall_s: Annotated[float, Quantity("time it took", "", 3)] = field(compare=False)


def audit(
    full: Scene, ledger: Ledger, run: Simulation, accuracy: float, most_evaluations: int | None,
    integrator: str = "auto", progress: Progress = silent,
) -> Audit:  # fmt: skip
    """Simulate the scene with all its effects to the same accuracy, by the work that the run has left.

    Raises NotTrustworthyError as `simulate` does.
    """
    added = tuple(entry.name for entry in ledger.entries if not entry.included)
    if not added:
        return Audit(difference=0.0, promise=0.0, effects=(), evaluations=0, wall_s=0.0)
    left = max((most_evaluations or usual_work(full, integrator)) - run.cost.work, 1)
    whole = simulate(full, accuracy, (), left, integrator=integrator, progress=progress)
    return Audit(
        difference=difference(run.scene, run.response, whole.response),
        promise=ledger.promise,
        effects=added,
        evaluations=whole.cost.evaluations,
        wall_s=whole.cost.wall_s,
    )


RACE_CENTRE: Final = Range("angle of the race's centre from the imbalance", -360, 360, "deg", key="race_centre_deg")

Source = Machine | SceneDescription | Scene
"""A machine's file, a scene file, or a scene in SI."""


@dataclass(frozen=True)
class Subject:
    """A scene with all effects there is data for, and where it comes from.

    `half_angle` of touching balls [rad], 0 without size; `start`: how the balls start, in words; `reading`: the file,
    if there is one; `design`: that of a machine.
    """

    title: str
    reading: FileReading | None
    scene: Scene
    start: str
    half_angle: float = 0.0
    warnings: tuple[str, ...] = ()
    design: Design | None = None

    @property
    def provenance(self) -> Provenance:
        """Provenance of a result about it."""
        return Provenance.today() if self.reading is None else Provenance.of(self.reading)

    def located(self) -> AbstractContextManager[None]:
        """Gives errors that know only a key the file and the line they come from."""
        return nullcontext() if self.reading is None else self.reading.located()

    def lasting(self, duration_s: float | None) -> "Subject":
        """Subject with another duration, if one is given; refused if it is longer than can be integrated."""
        if duration_s is not None:
            return replace(self, scene=lasting(self.scene, duration_s, "duration_s"))
        with self.located():
            return replace(self, scene=lasting(self.scene, None, "scene.duration_s"))

    def ledger(self, accuracy: float, with_effects: Sequence[str] = (), without_effects: Sequence[str] = ()) -> Ledger:
        """The scene with the effects it calls for, and why."""
        present = [effect.name for effect in self.scene.effects]
        check_effects(present, with_effects, without_effects, machine=self.design is not None)
        with self.located():
            return chosen(self.scene, accuracy, with_effects, without_effects)


def checked_centre(race_centre_deg: float | None, usual: float) -> float:
    """Angle of the race's centre [rad]: the one asked for, else the usual one."""
    return usual if race_centre_deg is None else to_si(RACE_CENTRE.check(race_centre_deg), "deg")


def subject_of(
    source: Source, scene: str | None = None, start: str | None = None, *, race_centre_deg: float | None = None,
    command: str = "simulate",
) -> Subject:  # fmt: skip
    """Subject of a source; only machines take a scene (by default `idle`) and a start case of the balls.

    `race_centre_deg`: angle of the race's centre from the imbalance, for machines only, by default 180.
    `command`: the study that asks, as its command is called.
    """
    one_of("scene", scene, SCENES)
    one_of("start", start, STARTS)
    if isinstance(source, Machine):
        centre = checked_centre(race_centre_deg, WORST)
        return _of_machine(source, scene or "idle", start, centre, command)
    subject = _of_file(source) if isinstance(source, SceneDescription) else _of_script(source)
    for argument, value in (("scene", scene), ("start", start), ("race_centre_deg", race_centre_deg)):
        if value is not None:
            raise InputError(
                f"for machines only; {subject.title} is one scene, given outright",
                place=Place(key=argument),
                found=str(value),
                remedy="Leave it out.",
            )
    return subject


def _of_machine(machine: Machine, scene: str, start: str | None, race_centre: float, command: str) -> Subject:
    tables = machine.whole(command)
    usual = "bunched" if tables.start is None else "placed"
    chosen_start = next(each for each in STARTS if each == (start or usual))
    with machine.located():
        design = size(tables)
        full = scene_of_design(design, scene, chosen_start, race_centre)
    off = f"; centre of the race {shown(race_centre, 'deg', '.4g')} from the imbalance"
    return Subject(
        title=tables.machine.name,
        reading=machine,
        scene=full,
        start=STARTS[chosen_start] + (off if design.case.race_eccentricity else ""),
        half_angle=design.autobalancer.half_angle,
        warnings=(*machine.warnings, *design.warnings),
        design=design,
    )


def _of_file(description: SceneDescription) -> Subject:
    with description.located():
        scene = scene_from(description.scene)
    title, start = Path(description.file).name, "as the file says"
    return Subject(title, description, scene, start, warnings=description.warnings)


def _of_script(scene: Scene) -> Subject:
    return Subject(scene.name, None, scene, "as the scene says")
