"""The report of `abu grinding`, on one screen and whole: verdict, levels, balls, contact, start cases, wear."""

import re
from typing import Final

from abu_calc.features.grinding.curves import FrictionBand
from abu_calc.features.grinding.outcomes import LoadedOutcomeGroup, LoadedStarts
from abu_calc.features.grinding.start_cases import WHEN
from abu_calc.features.grinding.study import GrindingResult
from abu_calc.features.grinding.verdict import AxisMotion, Simulated
from abu_calc.features.grinding.wear import WearCourse
from abu_calc.foundation.checks import Status, first_of
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number, with_unit
from abu_calc.reporting.parts import check_blocks, facts, measured_after_blocks, notices, provenance_blocks, value_of
from abu_calc.reporting.screen import shortened, verdict_line

RIGHT: Final = frozenset({1, 2, 3, 4, 5})
MARKS: Final[dict[bool | None, Status]] = {True: "pass", False: "fail", None: "not-done"}
STEADY: Final = (
    "Spindle amplitudes and forces: closed forms for an ideal race and steady contact. Levels include race and "
    "friction."
)


def grinding_blocks(result: GrindingResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        Heading(f"{result.title}: grinding", "title"),
        verdict_line(result),
        Paragraph(result.verdict, _mark(result)),
        numbers_that_matter(result),
        Paragraph(STEADY),
        *measured_after_blocks(result.measured_after),
        *start_blocks(result.starts),
        *wear_blocks(result),
        *balls_blocks(result),
        *contact_blocks(result),
        *friction_blocks(result),
        *_simulated(result),
        *_hodograph(result),
        *_response(result),
        *_profile(result),
        *check_blocks(result.checks),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def _mark(result: GrindingResult) -> Status:
    """Mark of the usual case, unless a start case fails."""
    lowered = first_of(result.checks, "level_under_load")
    return "fail" if lowered is not None and lowered.status == "fail" else MARKS[result.helps]


def numbers_that_matter(result: GrindingResult) -> Grid:
    """Levels, motions, forces: without autobalancer, its balls fixed, free."""
    axes = result.axis_without, result.axis_fixed, result.axis
    forces = result.reaction_without, result.reaction_fixed, result.reaction
    after = _db(result.level_after_db, result.simulation)
    rows = [
        ("level, pressed after settling", _db(result.level_before_db, result.simulation_without), "", after),
        ("  pressed earlier", "", "", _db(result.level_at_once_db, result.simulation_at_once)),
        ("spindle along workpiece", *(_um(axis.x_amplitude) for axis in axes)),
        ("  normal to it", *(_um(axis.y_amplitude) for axis in axes)),
    ]
    if result.contact_stiffness_regions_N_per_m is not None:
        rows += [
            (f"normal force {result.reaction.mean_N:g} N ±",
             *(_newton(force.amplitude_N, parts=force.separates) for force in forces)),
            ("  runout keeping contact", *(_limit(force.largest_runout) for force in forces)),
        ]  # fmt: skip
    return Grid(("grinding", "without", "balls fixed", "with"), tuple(rows), RIGHT)


def balls_blocks(result: GrindingResult) -> list[Block]:
    """Resting places of the balls, and the places that the source gives."""
    places = {
        "balanced": "The balls balance",
        "restless": "The balls do not stay where they would balance",
        "short": "The capacity of the balls is too small: they lie side by side",
        "gathered": "The balls gather where they add to the imbalance",
        "turning": "The balls come to no rest",
    }[result.balls]
    text = places
    if result.ball_angles_deg is not None and result.ball_resultant_g_mm is not None:
        many = ", one of many arrangements" if len(result.ball_angles_deg) > 2 and result.balls == "balanced" else ""
        angles = ", ".join(f"{number(angle, 4)}°" for angle in result.ball_angles_deg)
        text += f": {number(result.ball_resultant_g_mm, 4)} g·mm, at {angles} from the imbalance{many}"
    blocks: list[Block] = [Heading("Balls"), Paragraph(f"{text}.")]
    if result.printed is not None and result.balls == "balanced":
        given = result.printed.ball_angles_deg or (result.printed.resultant_angle_deg,)
        angles = " and ".join(f"{number(angle, 4)}°" for angle in given)
        if len(given) == 1:
            angles = f"{number(result.printed.resultant_g_mm, 4)} g·mm at {angles}"
        blocks.append(Paragraph(
            f"The formula as published (Kladiev 1996, 4), without friction, gives {angles}. Its error is "
            f"{with_unit(result.printed.error_deg or 0.0, '°', 3)}; it leaves "
            f"{with_unit(result.printed.open_g_mm or 0.0, 'g·mm', 3)}."
        ))  # fmt: skip
    if result.flutter_drag_limit_per_s is not None and result.flutter_drag_worst_per_s is not None:
        here, worst = (number(each, 3) for each in (result.flutter_drag_limit_per_s, result.flutter_drag_worst_per_s))
        blocks.append(Paragraph(
            f"Viscous drag rate required against flutter: {here} 1/s where the balls rest, {worst} 1/s in the worst "
            "arrangement."
        ))  # fmt: skip
    return blocks


def contact_blocks(result: GrindingResult) -> list[Block]:
    """Regions of stiffness; resonance; power."""
    power = f"Cutting power: {number(result.cutting_power_W, 3)} W."
    if result.contact_stiffness_regions_N_per_m is None:
        return [Heading("Contact"), Paragraph(f"A face: runout in the plane causes no variable force. {power}")]
    stiffness, bounds = result.model.contact_stiffness_N_per_m, result.contact_stiffness_regions_N_per_m
    first, second = map(_stiffness, bounds)
    if bounds[0] <= 0:
        own = "Rigid" if stiffness is None else f"Stiffness {_stiffness(stiffness)} N/m"
        here = f"{own}. At this speed the suspension is too stiff for balls to balance on any contact"
        here += f" below {second} N/m" if bounds[1] > 0 else " that is not rigid"
    elif stiffness is not None and stiffness < bounds[0]:
        here = (
            f"Stiffness {_stiffness(stiffness)} N/m, below {first} N/m: the balls balance, and wear reduces the runout"
        )
        here += f". Between {first} and {second} N/m they would add to the imbalance. Above, wear increases the runout"
    elif stiffness is not None and stiffness < bounds[1]:
        here = (
            f"Stiffness {_stiffness(stiffness)} N/m, between {first} and {second} N/m: the balls add to the imbalance"
        )
    else:
        own = "Rigid" if stiffness is None else f"Stiffness {_stiffness(stiffness)} N/m"
        here = f"{own}, above {second} N/m: the balls balance, and wear increases the runout. Below {first} N/m it "
        here += "would reduce the runout"
    resonance = "" if result.resonance_rpm is None else (
        f" Without autobalancer the machine resonates on it at {value_of(result, 'resonance_rpm')}.")  # fmt: skip
    return [Heading("Contact"), Paragraph(f"{here}.{resonance} {power}")]


def friction_blocks(result: GrindingResult) -> list[Block]:
    """Displacement that dry friction holds, and the motion that shakes the friction out."""
    band = result.friction
    if band.threshold_um == 0:
        return [Heading("Dry friction of the balls"), Paragraph("None.")]
    held = f"Dry friction leaves a spindle displacement of {number(band.typical_um, 3)} µm typically"
    held += "." if band.worst_um is None else f", {number(band.worst_um, 3)} µm in the worst arrangement."
    plane = result.contact_stiffness_regions_N_per_m is not None
    shaking = "Axial runout of a wheel that is pressed in the plane does not shake the balls free"
    if not plane:
        shaking = f"Axial runout of the wheel, {number(band.axial_um, 3)} µm, {_shakes(band.axial_shakes)}"
    if plane and band.whirl_um is not None:
        shaking += f". The whirl by its runout there, {number(band.whirl_um, 3)} µm, {_shakes(band.whirl_shakes)}"
        shaking += f", slowly, in some {number(band.creep_s, 2)} s" if band.creep_s else ""
    need = f"More than {number(band.threshold_um, 3)} µm would."
    return [Heading("Dry friction of the balls"), Paragraph(f"{held} {shaking}. {need}{_shaken(band)}")]


def _shaken(band: FrictionBand) -> str:
    """Sentence on the simulated effect of runout; empty if nothing was simulated."""
    if band.simulated_way is None or band.simulated_um is None or band.simulated_s is None:
        return ""
    left = [f"{number(each, 2)} µm" if each is not None else "not known" for each in (band.unshaken_um, band.shaken_um)]
    tried = f"an axial runout of {number(band.simulated_um, 2)} µm, as a trial"
    by, after = "this runout" if band.simulated_given else tried, f"after {band.simulated_s:g} s"
    worse = band.unshaken_um is not None and band.shaken_um is not None and band.shaken_um > band.unshaken_um
    more = " That runout moves the balls away from their places." if worse else ""
    return f" Simulated, balls together at the start: {left[0]} without, {left[1]} with {by}, {after}.{more}"


def _shakes(does: bool) -> str:
    return "shakes the balls free" if does else "does not shake the balls free"


def _simulated(result: GrindingResult) -> list[Block]:
    """The runs, with every effect that counts."""
    blocks: list[Block] = []
    for simulation, title, section in (
        (result.simulation, "Simulated with the autobalancer", "simulated"),
        (result.simulation_at_once, "Pressed before the balls have settled", "simulated-at-once"),
        (result.simulation_without, "Simulated without autobalancer", "simulated-without"),
    ):
        if simulation is not None:
            blocks += [Heading(title, section), facts(simulation)]
    if result.agreement is not None:
        title = "Contact alone, simulated against the closed form: relative differences"
        blocks += [Heading(title, "agreement"), facts(result.agreement)]
    return blocks


def _hodograph(result: GrindingResult) -> list[Block]:
    rows = tuple((number(row.runout_angle_deg, 4), *_pair(row.without), *_pair(row.fitted)) for row in result.hodograph)
    header = ("runout at, °", "without: x", "y, µm", "with: x", "y, µm")
    return [
        Heading("Spindle amplitude against the angle from imbalance to runout", "angles"),
        Grid(header, rows, RIGHT),
    ]


def _response(result: GrindingResult) -> list[Block]:
    rows = tuple(
        (number(point.speed_rpm, 5), _um(point.without.largest), _um(point.fitted.largest),
         _newton(point.force_without), _newton(point.force_with), point.balls or "")
        for point in result.response
    )  # fmt: skip
    header = ("rpm", "spindle without", "with", "force without", "with", "balls")
    return [Heading("Over the speeds", "speeds"), Grid(header, rows, frozenset({0, 1, 2, 3, 4}))]


def _profile(result: GrindingResult) -> list[Block]:
    if result.profile is None:
        return []
    rows = tuple(
        (number(point.wheel_angle_deg, 4), *(_newton(each) for each in (point.without_N, point.with_N,
                                           point.simulated_without_N, point.simulated_N)))
        for point in result.profile
    )  # fmt: skip
    header = ("wheel at, °", "without", "with", "simulated without", "simulated with")
    return [Heading("Force round the wheel, from its imbalance", "force"), Grid(header, rows, RIGHT)]


def _pair(axis: AxisMotion) -> tuple[str, str]:
    """x and y in µm."""
    x, y = ("" if each is None else number(1e6 * each, 3) for each in (axis.x_amplitude, axis.y_amplitude))
    return x, y


def _db(level: float | None, run: Simulated | None) -> str:
    """Level as text, with its scatter if the run is a mean of chaotic ones."""
    if level is None:
        return "not known"
    return f"{level:.1f} ± {max(run.scatter_db, 0.1):.1f} dB" if run and run.scatter_db else f"{level:.1f} dB"


def _um(length: float | None) -> str:
    return "" if length is None else f"{number(1e6 * length, 3)} µm"


def _newton(force: float | None, *, parts: bool = False) -> str:
    return "" if force is None else f"{number(force, 3)} N{' (bounces)' if parts else ''}"


def _stiffness(value: float) -> str:
    """Stiffness as files have it, 4.9e5."""
    return f"{value:.3g}".replace("e+0", "e")


def _limit(length: float | None) -> str:
    return "none" if length is None else _um(length)


LEFT_OUT = (
    *("simulated", "simulated-at-once", "simulated-without", "agreement", "angles", "speeds", "force"),
    *("wear-without", "wear-with"),
)
"""Ids of the sections that are left to the whole report."""
MOST_SENTENCES: Final = 3
"""Sentences of the verdict on one screen; the checks tell the first change."""


def grinding_screen(result: GrindingResult) -> tuple[Block, ...]:
    """Verdict, numbers that matter, balls, contact, wear, friction; curves are left to the whole report."""
    title, grades, _, *others = grinding_blocks(result)
    told = Paragraph(" ".join(re.split(r"(?<=\.) (?=[A-Z])", result.verdict)[:MOST_SENTENCES]), _mark(result))
    return shortened(result, (title, grades, told, *others), *LEFT_OUT, head=3)


def start_blocks(starts: LoadedStarts | None) -> list[Block]:
    """The motions that the start cases end with, and the share of each."""
    if starts is None:
        return []
    rows = tuple(
        (
            WHEN[group.pressed],
            f"{group.count} of {group.total}",
            group.state + ("" if group.steady else ", still changing"),
            _range(group),
        )
        for group in starts.outcomes
    )
    lost = f", {starts.without_answer} without a result" if starts.without_answer else ""
    return [
        Heading(f"Start cases under load: {starts.count} simulated{lost}"),
        Grid(("pressed", "share", "motion", "level"), rows, frozenset({1, 3})),
    ]


def _range(group: LoadedOutcomeGroup) -> str:
    """The level, or the lowest and the highest of several."""
    low, high = f"{group.lowest_db:.1f}", f"{group.highest_db:.1f}"
    return f"{high} dB" if low == high else f"{low} to {high} dB"


ENDS: Final = {
    "halved": "runout halved after",
    "limit": "level above its limit after",
    "parted": "wheel loses contact after",
    "settled": "settled after",
    "worn out": "worn out after",
}


def wear_blocks(result: GrindingResult) -> list[Block]:
    """Wear with and without autobalancer, at this contact and a rigid one; then its measured life."""
    both = ((result.wear_without, "without"), (result.wear, "with"))
    rigid = ((result.wear_rigid_without, "rigid, without"), (result.wear_rigid, "rigid, with"))
    bouncing = ((result.wear_bouncing_without, "bouncing, without"), (result.wear_bouncing, "bouncing, with"))
    named = (*both, *bouncing, *(rigid if result.contact != "rigid" else ()))
    rows = tuple(_row(name, wear) for wear, name in named if wear is not None)
    if not rows:
        return _claim(result)
    header = ("", "dε/ds_w", "runout", "first event")
    title = "Wear: change of the runout ε per depth s_w worn off (Archard)"
    return [Heading(title, "wear"), Grid(header, rows, frozenset({1})),
            *_stages(result), *_claim(result)]  # fmt: skip


def _row(name: str, wear: WearCourse) -> tuple[str, ...]:
    turned = "falls" if wear.centres else "grows"
    if wear.ends is None or wear.depth_um is None:
        return name, f"{wear.runout_rate:+.2f}", turned, ""
    if wear.depth_um == 0:
        return name, "", "", "wheel loses contact already"
    time = "" if wear.time_min is None else f" ({_minutes(wear.time_min)})"
    depth = f"{number(wear.depth_um, 3)} µm" if wear.depth_um < 1000 else f"{number(wear.depth_um / 1e3, 3)} mm"
    left = f", at {number(1e3 * wear.stages[-1].runout_mm, 3)} µm" if wear.ends != "halved" else ""
    return name, f"{wear.runout_rate:+.2f}", turned, f"{ENDS[wear.ends]} {depth}{time}{left}"


def _minutes(time: float) -> str:
    return f"{number(60 * time, 2)} s" if time < 1 else f"{number(time, 3)} min"


def _stages(result: GrindingResult) -> list[Block]:
    """The course with and without, as far as closed forms go."""
    blocks: list[Block] = []
    for wear, name, section in (
        (result.wear_without, "without autobalancer", "wear-without"), (result.wear, "with it", "wear-with"),
    ):  # fmt: skip
        if wear is None or not wear.stages or not wear.depth_um:
            continue
        rows = tuple(
            (number(stage.depth_um, 3), number(1e3 * stage.runout_mm, 4), number(stage.runout_angle_deg, 4),
             number(stage.imbalance_g_mm, 4), number(stage.variable_force_N, 3))
            for stage in wear.stages
        )  # fmt: skip
        header = ("worn, µm", "runout, µm", "at, °", "imbalance, g·mm", "force ±, N")
        blocks += [Heading(f"Course of wear {name}", section), Grid(header, rows, frozenset(range(5)))]
    return blocks


def _claim(result: GrindingResult) -> list[Block]:
    claim = result.claim
    if claim is None:
        return []
    power = ("No power of the variable force up to 50 explains the difference" if claim.needed_exponent is None
             else f"Wear by the force to the power {number(claim.needed_exponent, 2)} would explain it")  # fmt: skip
    return [
        Heading("Life of the wheel", "claim"),
        Paragraph(
            f"Measured: {claim.life_without_min:g} min without the autobalancer, {claim.life_with_min:g} min with it. "
            f"Predicted with it: {claim.predicted_life_with_min:g} min, as without. By Archard's law mean wear follows "
            f"the mean force, which the operator sets. {power}. So would a mean force of "
            f"{number(claim.needed_press_N, 3)} N with the autobalancer, or wheels that are discarded for their runout "
            "or their vibration."
        ),
    ]
