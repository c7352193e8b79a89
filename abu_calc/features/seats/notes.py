"""Notes beside the numbers of a seat: list of losses, handbooks' tolerance class, selective assembly.

Handbooks allow tolerance classes at a load intensity: advice beside the makers'. Selective assembly gives how many
groups the parts are sorted into, which go together, and how many pairs each gets.
"""

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Final, NamedTuple

from abu_calc.features.seats.bearing import SEAT_LENGTH, SeatedBearing, load_factors
from abu_calc.features.seats.interference import Interval, Pair, SeatRecord, catalogue_smoothing_loss
from abu_calc.features.seats.joint import ARTICLE, BEYOND_ROWS, MEASURED, TEMPERATURE, Joint, Loss
from abu_calc.features.seats.joints import makers_classes
from abu_calc.foundation.formula import formula
from abu_calc.foundation.quantity import Quantity, record
from abu_calc.foundation.units import from_si, shown
from abu_calc.standards.tables import row_of_size, toml_table
from abu_calc.standards.tolerance_classes import NORMAL_RATIO, DeviationLimits, Seat, source_of

if TYPE_CHECKING:
    from abu_calc.features.seats.advice import JointAdvice, SeatAdvice

_AS_SOLID: Final = 0.97
"""Share of the pressure above which a part is called solid or thick."""


@formula(
    "Load intensity of a seat",
    "P_R = k₁·k₂·k₃·F_r/b_s",
    "N/m",
    shown="kN_per_m",
    where=(
        "k₁ is 1 for a moderate load (load_kind, overload to 150 %) and 1.8 for shocks and vibration (to 300 %). k₂ is "
        "1 for solid shafts and thick housings, up to 3 for hollow shafts and 1.8 for thin housings. k₃ is 1 for one "
        "row of rolling elements, up to 2 for two rows under an axial load. The tolerance class that follows from it "
        "is unverified advice."
    ),
    checked=(SEAT_LENGTH,),
    source="GOST 3325-85 as handbooks quote it; Afanasiev 2015",
)
def load_intensity(load: float, seat_length: float, factors: tuple[float, float, float]) -> float:
    """
    >>> round(1e-3 * load_intensity(3000.0, 29e-3, (1.8, 1.0, 1.0)), 1)
    186.2
    """
    return math.prod(factors) * load / SEAT_LENGTH.check(seat_length)


def intensity_factors(bearing: SeatedBearing, joint: Joint) -> tuple[float, float, float]:
    """k₁, k₂ and k₃ of the load intensity of a seat. Source: `standards/data/load_intensity.toml`."""
    table, service = toml_table("load_intensity")["factors"], bearing.service
    bore, outer = bearing.inner.diameter, bearing.outer.diameter
    if joint.seat == "housing":
        thinness, column = outer / (bearing.housing.other or math.inf), 4
    else:
        thinness = (bearing.shaft.other or 0.0) / bore
        column = 1 + sum(outer / bore > ratio for ratio in table["diameter_ratios"])
    rows = 1.0
    if bearing.kind == "spherical" and bearing.ratings and service.radial_load and service.axial_load:
        factors, _ = load_factors(bearing.kind, bearing.entry, bearing.ratings, service.axial_load)
        cotangent = 1.5 / factors.e if factors else 0.0  # e = 1.5·tan α of two rows, ISO 281
        rows = _above(table["rows"], service.axial_load / service.radial_load * cotangent)[1]
    return table["load"][service.load_kind or "shock"], _above(table["part"], thinness)[column], rows


def _above(rows: list[list[float]], value: float) -> list[float]:
    """The last row whose first number a value exceeds; the first row for none."""
    return next((row for row in reversed(rows) if value > row[0] + 1e-9), rows[0])


def seat_intensity(bearing: SeatedBearing, joint: Joint) -> float | None:
    """Load intensity of a seat [N/m]; None without a load or a length."""
    if joint.radial_load is None or joint.length is None:
        return None
    return load_intensity(joint.radial_load, joint.length, intensity_factors(bearing, joint))


def advised_class(seat: Seat, diameter: float, intensity: float) -> str | None:
    """The loosest class that handbook tables allow at a load intensity [N/m]; None outside the tables.

    Range: shafts over 18 up to 630 mm, housings over 50 up to 1600 mm; unverified advice, never the only criterion.
    Source: handbooks as quoted by Afanasiev 2015.

    >>> advised_class("shaft", 0.080, 186.2e3), advised_class("housing", 0.140, 186.2e3)
    ('js6', 'K7')
    """
    table = toml_table("load_intensity")[seat]
    row = row_of_size(table["rows"], diameter)
    if row is None:
        return None
    pairs = zip(table["fields"], row[2:], strict=True)
    return next((field for field, limit in pairs if from_si(intensity, "kN_per_m") <= limit), None)


MOST_GROUPS: Final = 12
"""Groups that are listed: nobody sorts into more."""
_NOISE: Final = 1e-12
"""Lengths [m] below it are the rounding of conversions."""


class Selection(NamedTuple):
    """Number of groups, and the interference [m] that every pair of matched groups then keeps to."""

    groups: int
    interference: Interval


@record
class SortingGroup(SeatRecord):
    """A group of selective assembly: parts of one number are matched."""

    number: Annotated[int, Quantity("group")]
    part_limits: Annotated[Pair, Quantity("limits of the part", unit="um")]
    ring_limits: Annotated[Pair, Quantity("limits of the ring", unit="um")]
    interference: Annotated[Pair, Quantity("interference", unit="um")]
    pairs_of_100: Annotated[float, Quantity("pairs of a hundred", "", 3)]


@formula(
    "Fewest equal groups that bring every pair into the required range of interference; none if no number does",
    signs="n_g T₁ T₂ ei es EI ES",
    where=(
        "Both tolerance zones are cut into n_g equal groups and matched by number. The least interference of group k "
        "is ei − EI + k·(T₁−T₂)/n_g − T₂/n_g, and its range is T₁/n_g + T₂/n_g wide. Over all groups the least is "
        "min(ei − EI, es − ES) − min(T₁, T₂)/n_g. The largest is max(ei − EI, es − ES) + min(T₁, T₂)/n_g. Hence n_g ≥ "
        "min(T₁, T₂)/(min(…) − required least) and n_g ≥ min(T₁, T₂)/(required most − max(…)). The range stays wider "
        "than |T₁ − T₂|, however fine the groups are. Sorting cannot reach a narrower range, or one beside those "
        "middles."
    ),
    assumed="both limits refer to one nominal size",
    source="derived from the limits of size",
)
def selective_groups(male: DeviationLimits, female: DeviationLimits, asked: Interval) -> Selection | None:
    """
    >>> found = selective_groups(DeviationLimits(2e-6, 21e-6), DeviationLimits(-15e-6, 0.0), Interval(10e-6, 28e-6))
    >>> found.groups, round(1e6 * found.interference.smallest, 2), round(1e6 * found.interference.largest, 2)
    (3, 12.0, 26.0)
    """
    ends = male.lower - female.lower, male.upper - female.upper
    narrower = min(male.tolerance, female.tolerance)
    groups = 1
    for room in (min(ends) - asked.smallest, asked.largest - max(ends)):
        if narrower <= _NOISE and room >= -_NOISE:
            continue
        if room <= _NOISE:
            return None
        groups = max(groups, math.ceil(narrower / room - 1e-9))
    share = narrower / groups
    return Selection(groups, Interval(min(ends) - share, max(ends) + share))


def sorting_groups(part: DeviationLimits, ring: DeviationLimits, seat: Seat, count: int) -> tuple[SortingGroup, ...]:
    """The groups of a selection, from the smallest parts to the largest; none where they are too many to sort.

    Both sizes normal and centred, half a field = 3σ, parts outside their fields sorted out: matched groups of both
    parts are then equally full.

    >>> part, ring = DeviationLimits(2e-6, 21e-6), DeviationLimits(-15e-6, 0.0)
    >>> [round(group.pairs_of_100) for group in sorting_groups(part, ring, "shaft", 3)]
    [16, 68, 16]
    """
    groups = []
    for i in range(count if 1 < count <= MOST_GROUPS else 0):
        own, rings = _slice(part, i, count), _slice(ring, i, count)
        inside, around = (own, rings) if seat == "shaft" else (rings, own)
        pair = inside.lower - around.upper, inside.upper - around.lower
        share = 100 * _share(i, count)
        groups.append(SortingGroup(
            number=i + 1, part_limits=own, ring_limits=rings, interference=pair, pairs_of_100=share,
        ))  # fmt: skip
    return tuple(groups)


def _slice(field: DeviationLimits, index: int, count: int) -> DeviationLimits:
    width = field.tolerance / count
    return DeviationLimits(field.lower + index * width, field.lower + (index + 1) * width)


def _share(index: int, count: int) -> float:
    def below(place: float) -> float:
        return math.erf((6 * place - 3) / math.sqrt(2))

    return (below((index + 1) / count) - below(index / count)) / (2 * math.erf(3 / math.sqrt(2)))


def ledger(joint: Joint) -> tuple[Loss, ...]:
    """List of losses: the load by both rules, of which the larger counts, then the losses given, each by its formula.

    Gains by temperature do not count.
    """
    needs = joint.required.by if joint.required else None
    items = [
        Loss(name="load", amount=bound.value, formula=bound.by, counted=bound.by == needs) for bound in joint.criteria
    ]
    if joint.criteria and joint.pressure_kept < 1:
        larger = max(bound.value for bound in joint.criteria)
        lost = larger * (1 / joint.pressure_kept - 1)
        items.append(Loss(name="pressure", amount=lost, formula="of the load, over the share of the pressure kept"))
    warmest = max(joint.thermal_cases, key=lambda case: case.loss)
    if warmest.name in ("lowest", "highest"):
        formula_text = f"d·(α₂·ΔT₂ − α₁·ΔT₁) at the {warmest.name} temperature"
        items.append(Loss(name=TEMPERATURE, amount=warmest.loss, formula=formula_text, counted=warmest.loss > 0))
    for loss in joint.losses:
        if loss.name == TEMPERATURE and warmest.name in ("lowest", "highest"):
            items.append(replace(loss, counted=False))
            continue
        items.append(replace(loss, counted=loss.amount > 0 or loss.name != TEMPERATURE))
        if loss.name == "smoothing":
            value = catalogue_smoothing_loss(joint.interference.smallest, joint.diameter)
            text = "δ·2/(d + 2) (bearing catalogues, unverified)"
            items.append(Loss(name="smoothing", amount=value, formula=text, counted=False))
    return tuple(items)


def clearance_note(advice: "JointAdvice") -> tuple[str, ...]:
    """Note on a group of clearance that the recommended classes alone would not need."""
    shaft, housing = advice.shaft.best, advice.housing.best
    if shaft is None or housing is None or advice.group is None or advice.group == advice.own_group:
        return ()
    return (
        f"Clearance {advice.group} suits the classes given. For shaft {shaft.tolerance_class} with housing "
        f"{housing.tolerance_class}, {advice.own_group} is enough.",
    )


def seat_notes(
    bearing: SeatedBearing,
    joint: Joint,
    own: "SeatAdvice",
    given: bool,
    asked: Interval | None,
    selection: "Selection | None",
    rule: str | None,
) -> tuple[str, ...]:
    """The notes of a seat, what concerns the bearing alike for both; `rule`: the class by the rules for the load."""
    return (
        *_needs(joint),
        *_kept(joint),
        *_differs(joint, own, rule),
        *_load(bearing, joint),
        *bearing.remarks,
        *_advised(bearing, joint, own, given),
        *_sorting(joint, asked, selection),
    )


def _needs(joint: Joint) -> tuple[str, ...]:
    if not joint.must_grip or not joint.criteria:
        return ()
    needs = " and ".join(f"{shown(criterion.value, 'um', '.2f')} by {criterion.by}" for criterion in joint.criteria)
    larger = "; the larger counts" if len(joint.criteria) > 1 else ""
    return (f"Interference required under {ARTICLE[joint.ring.load]} load, without losses: {needs}{larger}.",)


def _kept(joint: Joint) -> tuple[str, ...]:
    """What a hollow shaft, a thin or a light-alloy housing keeps of the pressure."""
    kept = joint.pressure_kept
    if not joint.must_grip or kept > _AS_SOLID or joint.runs_on_needles:
        return ()
    part = "hollow or soft shaft" if joint.seat == "shaft" else "thin or soft housing"
    like = "a solid shaft" if joint.seat == "shaft" else "a thick housing"
    return (
        f"The {part} keeps {kept:.0%} of the pressure in {like} of steel (Lamé): the load needs {1 / kept:.3g} times "
        "the interference.",
    )


def _differs(joint: Joint, own: "SeatAdvice", rule: str | None) -> tuple[str, ...]:
    """The class by the rules for the load beside the catalogue's, where they differ."""
    listed = joint.catalogue_class
    if not joint.must_grip or listed is None or joint.required is None or rule == listed:
        return ()
    asks = f"asks for {rule}" if rule else "finds no tabulated class tight enough"
    loosest = f"{least_text(joint.with_class(listed).interference.smallest)} of the loosest pair of {listed}"
    best = own.best.tolerance_class if own.best else listed
    moved = "" if best == listed else f" The losses or the stress move it to {best}."
    return (
        f"The rule {joint.required.by} {asks}: {least_text(joint.required.value)} required, {loosest}.",
        f"The catalogue's {listed} governs: it rests on experience with this type, size and P/C.{moved}",
    )


def least_text(length: float) -> str:
    """A length in micrometres."""
    return shown(length, "um")


def _load(bearing: SeatedBearing, joint: Joint) -> tuple[str, ...]:
    if joint.load_assumed:
        normal = shown(joint.radial_load or 0.0, "kN")
        return (f"No radial load is given: a normal one is judged, P/C = {NORMAL_RATIO:g}, {normal}.",)
    intensity = seat_intensity(bearing, joint)
    if intensity is None:
        return ()
    static = bearing.ratings.static if bearing.ratings else 0.0
    heavy = joint.must_grip and joint.radial_load is not None and 0 < static < 4 * joint.radial_load
    tolerance_class = advised_class(joint.seat, joint.diameter, intensity)
    table = f"table gives {tolerance_class}" if tolerance_class else "tables end below it"
    load, part, rows = intensity_factors(bearing, joint)
    factors = f"k₁ {load:g} ({bearing.service.load_kind or 'shock'}), k₂ {part:g}, k₃ {rows:g}"
    return (
        f"k_B = {joint.factor:g} of the {bearing.series} series is an unverified handbook value.",
        f"Load intensity {shown(intensity, 'kN_per_m', '.0f')}, {factors}: the handbook {table} (unverified).",
        *(("The load is above a quarter of C0: catalogues then give 0.02·F_r/B as its loss.",) if heavy else ()),
    )


def _advised(bearing: SeatedBearing, joint: Joint, own: "SeatAdvice", given: bool) -> tuple[str, ...]:
    best = own.best.tolerance_class if own.best else None
    notes = (
        [] if given or best is None else [f"No class of the {joint.seat} is given: the recommended {best} is judged."]
    )
    if joint.maker is not None and bearing.load_ratio is not None:
        remark = f"; {joint.maker.note}" if joint.maker.note else ""
        named = (*joint.maker.classes[1:], *joint.maker.special)
        others = f", also {', '.join(named)}" if named else ""
        notes.append(
            f"{source_of(bearing.kind)}: {joint.maker.classes[0]}{others} for a {bearing.kind} bearing, "
            f"P/C = {bearing.load_ratio:.2g}, load {joint.ring.load}, "
            f"seat of {shown(joint.diameter, 'mm', 'g')}{remark}."
        )
        if best not in (None, *joint.maker.classes, *joint.maker.special):
            notes.append(_moved(joint, best or ""))
    elif (usual := makers_classes(bearing, joint.seat)) is not None and best in usual.classes:
        kind = bearing.kind or "ball"
        what = "the load" if joint.radial_load is None else "C"
        if not joint.must_grip or joint.required is None:
            notes.append(
                f"{what.capitalize()} is not known, so {best} is the class that {source_of(kind)} gives for a "
                f"{kind} bearing under normal load."
            )
    if joint.fit_name == MEASURED:
        ring = "the ring's, too" if joint.ring.measured else "the ring's are those of a new bearing"
        notes.append(f"The limits of the {joint.seat} are as measured, {ring}.")
    elif joint.ring.measured:
        notes.append("The limits of the ring are as measured.")
    return tuple(notes)


def _moved(joint: Joint, best: str) -> str:
    """Reason for another class than those of the catalogue's row."""
    listed = joint.catalogue_class
    if listed is None:
        return f"{best} is recommended by the rule for the load. {BEYOND_ROWS[joint.seat]}."
    if joint.maker is not None and listed != joint.maker.classes[0] and best == listed:
        return (
            f"{best} is recommended: its mean interference is nearest to that of {joint.maker.classes[0]} over "
            f"{joint.pressure_kept:.0%} (SKF's rule for hollow shafts)."
        )
    if not joint.must_grip:
        case = joint.coldest_or_hottest
        when = "" if case.rise is None else f" at {case.rise:+g} K"
        return f"{best} is recommended: {listed} would be tight{when}."
    return f"{best} is recommended: {listed} fails by its short pairs, its interference or its stress."


def _sorting(joint: Joint, asked: Interval | None, selection: "Selection | None") -> tuple[str, ...]:
    if asked is None:
        return ()
    band = shown(asked, "um", "g")
    if selection is None:
        male, female = joint.male_and_female
        ends = sorted((male.lower - female.lower, male.upper - female.upper))
        return (
            f"Sorting cannot keep {joint.fit_name} within {band}. The finest groups still spread over "
            f"{shown(ends, 'um', 'g')}; the band must be wider than that on both sides.",
        )
    if selection.groups == 1:
        return (f"{joint.fit_name} keeps within {band} without sorting.",)
    return (
        f"Selective assembly into {selection.groups} equal groups, matched by number: {joint.fit_name} keeps within "
        f"{shown(selection.interference, 'um')} ({band} required){_after(joint, selection)}.",
    )


def _after(joint: Joint, selection: "Selection") -> str:
    """The verdict on the pairs after sorting."""
    if not joint.must_grip or joint.required is None:
        return ""
    least, needed = selection.interference.smallest, joint.required.value
    if least >= needed:
        return f". Every pair has the required {shown(needed, 'um')}"
    return f". The loosest pairs still lack {shown(needed - least, 'um', '.2g')} of the required {shown(needed, 'um')}"
