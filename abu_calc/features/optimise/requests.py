"""Request of an optimisation: the tables [optimise] and [sweep] of the files, with the arguments in their place."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from abu_calc.features.sweep.plan import SweepRequest, asked
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range
from abu_calc.inputs.optimisation import PARTS, Optimise
from abu_calc.inputs.read_machine import Machine

TARGET = Range("wanted share", 0.5, 0.9999, key="share")
SEED = Range("seed", 0, 2**31 - 2, key="seed")
MOST_MACHINES = 20


@dataclass(frozen=True)
class OptimiseRequest:
    """What is asked, of which machines, with the sampling of each."""

    machines: tuple[Machine, ...]
    places: tuple[Place, ...]
    choose: Any
    choose_place: Place
    share: float
    share_parts: tuple[str, ...]
    seed: int
    requests: tuple[SweepRequest, ...]

    def refuse_scattered(self, machine: int, values: Mapping[str, Any]) -> None:
        """Raise InputError for a chosen value that [sweep] scatters: the choice would change nothing."""
        for key, _ in self.requests[machine].vary:
            if key in values:
                raise InputError(
                    "[sweep] scatters a value that is to be chosen, so that the choice would change nothing",
                    place=self.places[machine], found=key, remedy="Remove it from [sweep] vary, or pin it.",
                )  # fmt: skip


def asked_of(
    machines: Machine | Sequence[Machine], choose: Any, *, share: float | None, share_parts: Any,
    tolerances: bool | None, seed: int | None, most: int,
) -> OptimiseRequest:  # fmt: skip
    """The request, checked. Raises InputError."""
    several = (machines,) if isinstance(machines, Machine) else tuple(machines)
    if not 0 < len(several) <= MOST_MACHINES or not all(isinstance(each, Machine) for each in several):
        raise InputError(
            "machines are expected", place=Place(key="machines"), found=f"{len(several)}",
            allowed=f"1 … {MOST_MACHINES} machines",
        )  # fmt: skip
    first = several[0]
    table = first.whole("optimise").optimise or Optimise()
    in_file = choose is None and table.choose is not None
    lines = first.lines.get("optimise.choose")
    place = Place(first.file or None, lines, "optimise.choose") if in_file else Place(key="choose")
    own_seed = int(SEED.check(table.seed if seed is None else seed))
    return OptimiseRequest(
        machines=several,
        places=tuple(Place(machine.file or None) for machine in several),
        choose=table.choose if choose is None else choose,
        choose_place=place,
        share=TARGET.check(table.share if share is None else share),
        share_parts=_parts(table.share_parts if share_parts is None else share_parts, len(several)),
        seed=own_seed,
        requests=tuple(_request(machine, tolerances, own_seed, most) for machine in several),
    )


def _parts(given: Any, machines: int) -> tuple[str, ...]:
    if given is None:
        return ("balls", "race") if machines > 1 else ()
    parts = [part.strip() for part in given.split(",")] if isinstance(given, str) else list(given)
    for part in parts:
        if part not in PARTS:
            raise InputError(
                "no part that machines can share", place=Place(key="share_parts"), found=str(part),
                allowed=", ".join(PARTS),
            )  # fmt: skip
    return tuple(dict.fromkeys(parts)) if machines > 1 else ()


def _request(machine: Machine, tolerances: bool | None, seed: int, most: int) -> SweepRequest:
    """Scatter of a machine as `abu sweep` takes it; listed values are drawn at random, not in turn."""
    known = machine.whole("optimise").sweep
    wanted = (known is None or None) if tolerances is None else tolerances
    request = asked(machine, None, runs=most, what="build", tolerances=wanted, sampling="sobol", seed=seed)
    vary = tuple((key, replace(way, kind="choice") if way.listed else way) for key, way in request.vary)
    return replace(request, vary=vary, grid=None, sensitivity=False)
