"""Result of `abu optimise`: the front of cost against share, the recommended design, runners-up."""

from typing import Annotated, Any, ClassVar

from abu_calc.features.optimise.candidates import RuledOut
from abu_calc.features.optimise.costs import CostEntry
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.simulation.result import Result

SHARE = Quantity("share", "", 4, "share of samples that meet all limits", percent=True)
LOW = Quantity("from", "", 4, "95 % confidence", percent=True)
HIGH = Quantity("to", "", 4, "95 % confidence", percent=True)


@record
class SampledShare(Record):
    """Share of samples that meet all limits, with its 95 % confidence interval (Clopper and Pearson)."""

    value: Annotated[float, SHARE]
    low: Annotated[float, LOW]
    high: Annotated[float, HIGH]
    of: Annotated[int, Quantity("samples")]
    seed: Annotated[int, Quantity("seed", "", 4, "of the samples, as `abu sweep --seed` takes it")]


@record
class FrontPoint(Record):
    """A design: its cost, and the share of its samples that meets the limits; of several machines the least share.

    `set`: its values by key; of several machines by file, then by key. `changes`: from the design before it.
    """

    cost: Annotated[float, Quantity("cost", "", 4, "in the units of [costs]")]
    share: Annotated[float, SHARE]
    low: Annotated[float, LOW]
    high: Annotated[float, HIGH]
    samples: Annotated[int, Quantity("samples", "", 4, "common to all designs, which chose among them")]
    set_: Annotated[dict[str, Any], Quantity("values")]
    changes: Annotated[tuple[str, ...], Quantity("changes", "", 4, "from the design before it on the front")]


@record
class RecommendedDesign(FrontPoint):
    """The recommended design; `fresh_share` rests on samples that had no part in the choice."""

    fresh_share: SampledShare | None
    proven: Annotated[bool, Quantity("proven in the race")]


@record
class RunnerUp(FrontPoint):
    """A design that was nearly recommended, and why it was not."""

    why_not: Annotated[str, Quantity("why not")]


@record
class ChosenKey(Record):
    """One option: the values among which the race chose."""

    name: Annotated[str, Quantity("option")]
    values: Annotated[tuple[str, ...], Quantity("values")]
    default: Annotated[bool, Quantity("by default")]


@record
class OptimiseResult(Result):
    """The cheapest design of which the wanted share of all machines built meets the limits."""

    command: ClassVar[str] = "optimise"

    files: Annotated[tuple[str, ...], Quantity("machines")]
    share: Annotated[float, Quantity("wanted share", "", 4, "", percent=True)]
    share_parts: Annotated[tuple[str, ...], Quantity("shared parts")]
    options: tuple[ChosenKey, ...]
    costs: tuple[CostEntry, ...]
    scatter: Annotated[dict[str, str], Quantity("scatter", "", 4, "of each value that varies among machines built")]
    considered: Annotated[int, Quantity("combinations")]
    ruled_out: tuple[RuledOut, ...]
    evaluated: Annotated[int, Quantity("candidates that were sampled")]
    samples: Annotated[int, Quantity("samples")]
    rounds: Annotated[int, Quantity("rounds of the race")]
    seed: Annotated[int, Quantity("seed")]
    front: tuple[FrontPoint, ...]
    recommended: RecommendedDesign
    runners_up: tuple[RunnerUp, ...]
    written_tolerances: Annotated[bool, Quantity("tolerances", "", 4, "true: the drawing's tolerances scatter, too")]
    store: Annotated[str | None, Quantity("store")]
