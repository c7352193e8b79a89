"""Wear of the wheel, in the report of `abu grinding`."""

from typing import Final

from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.numbers import number
from abu_calc.studies.grinding import GrindingResult
from abu_calc.studies.grinding_wear import WearCourse

ENDS: Final = {
    "halved": "runout halved after",
    "limit": "level above its limit after",
    "parted": "wheel and work part after",
    "settled": "settled after",
    "worn out": "worn out after",
}


def wear_blocks(result: GrindingResult) -> list[Block]:
    """Wear with and without autobalancer, at this contact and a rigid one; then the claim of the source."""
    both = ((result.wear_without, "without"), (result.wear, "with"))
    rigid = ((result.wear_rigid_without, "rigid, without"), (result.wear_rigid, "rigid, with"))
    bouncing = ((result.wear_bouncing_without, "bouncing, without"), (result.wear_bouncing, "bouncing, with"))
    named = (*both, *bouncing, *(rigid if result.contact != "rigid" else ()))
    rows = tuple(_row(name, wear) for wear, name in named if wear is not None)
    if not rows:
        return []
    header = ("", "dε/ds_w", "wheel is", "what comes first")
    title = "Wear: change of the runout ε per depth s_w worn off (Archard)"
    return [Heading(title), Grid(header, rows, frozenset({1})),
            *_stages(result), *_claim(result)]  # fmt: skip


def _row(name: str, wear: WearCourse) -> tuple[str, ...]:
    turned = "centred" if wear.centres else "driven off"
    if wear.ends is None or wear.depth_um is None:
        return name, f"{wear.runout_rate:+.2f}", turned, ""
    if wear.depth_um == 0:
        return name, "", "", "wheel and work part already"
    time = "" if wear.time_min is None else f" ({_minutes(wear.time_min)})"
    depth = f"{number(wear.depth_um, 3)} µm" if wear.depth_um < 1000 else f"{number(wear.depth_um / 1e3, 3)} mm"
    left = f", at {number(1e3 * wear.stages[-1].runout_mm, 3)} µm" if wear.ends != "halved" else ""
    return name, f"{wear.runout_rate:+.2f}", turned, f"{ENDS[wear.ends]} {depth}{time}{left}"


def _minutes(time: float) -> str:
    return f"{number(60 * time, 2)} s" if time < 1 else f"{number(time, 3)} min"


def _stages(result: GrindingResult) -> list[Block]:
    """The course with and without, as far as closed forms go."""
    blocks: list[Block] = []
    for wear, name in ((result.wear_without, "without autobalancer"), (result.wear, "with it")):
        if wear is None or not wear.stages or not wear.depth_um:
            continue
        rows = tuple(
            (number(stage.depth_um, 3), number(1e3 * stage.runout_mm, 4), number(stage.runout_angle_deg, 4),
             number(stage.imbalance_g_mm, 4), number(stage.variable_force_N, 3))
            for stage in wear.stages
        )  # fmt: skip
        header = ("worn, µm", "runout, µm", "at, °", "imbalance, g·mm", "force ±, N")
        blocks += [Heading(f"Course of wear {name}"), Grid(header, rows, frozenset(range(5)))]
    return blocks


def _claim(result: GrindingResult) -> list[Block]:
    claim = result.claim
    if claim is None:
        return []
    power = ("no power of the force up to 50 does that here" if claim.needed_exponent is None
             else f"wear with the force to the power {number(claim.needed_exponent, 2)}")  # fmt: skip
    return [
        Heading("The source's claim"),
        Paragraph(
            f"Kladiev 1996 has a wheel last {claim.life_with_min:g} min with an autobalancer, "
            f"{claim.life_without_min:g} without. By this law both last alike: mean wear goes with the mean force. For "
            f"the claim it would take {power}; or a mean force of {number(claim.needed_press_N, 3)} N, a calmer "
            "machine being pressed less; or wheels that are thrown away for their runout."
        ),
    ]  # fmt: skip
