"""The report of `abu simulate`: what came out, where the balls ended, what was left out, what it cost."""

from collections.abc import Sequence

from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.effects import effects_grid
from abu_calc.report.numbers import number
from abu_calc.report.parts import check_blocks, facts, notices, of_scene, provenance_blocks, value_of
from abu_calc.studies.simulate import SimulateResult
from abu_calc.studies.simulated_scene import Audit, Cost, EffectEntry, End

CONVENTIONS = (
    "Amplitudes are 0–peak over the last twentieth of the run, about the mean place; velocities rms, in the larger of "
    "x and y; levels 20 lg(v / 5e-8 m/s). Ball angles are measured in the rotor from its zero mark (of a machine: the "
    "imbalance) in the sense of rotation, ball speeds relative to the race. Settled: the imbalance left stays near its "
    "final value."
)

MOTION = (
    *("duration_s", "settling_time_s", "residual_imbalance_g_mm", "axis_amplitude_mm", "unbalanced_amplitude_mm"),
    *("largest_amplitude_mm", "bearing_amplitudes_mm", "velocity_rms_mm_per_s", "level_db", "error_estimate"),
)
FINAL = (
    *("x_mm", "y_mm", "vx_mm_per_s", "vy_mm_per_s", "tilt_x_mrad", "tilt_y_mrad", "arm_angle_mrad"),
    "rotor_speed_rpm",
)


def simulate_blocks(result: SimulateResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        Heading(f"{result.title}: simulation{of_scene(result.scene)}"),
        Paragraph(_verdict(result), result.checks[0].status),
        Heading("Motion"),
        facts(result, *MOTION),
        *_final(result.final),
        *_effects(result.effects),
        *_audit(result.audit),
        *check_blocks(result.checks),
        *notices(result),
        Heading("Model"),
        Paragraph(f"{result.description} Start: {result.start}."),
        Paragraph(f"{_rung(result)} {_cost(result.cost)}"),
        Heading("Conventions"),
        Paragraph(CONVENTIONS),
        *provenance_blocks(result.provenance),
    )


def _verdict(result: SimulateResult) -> str:
    settled = result.settling_time_s is not None
    when = f"settled in {value_of(result, 'settling_time_s')}" if settled else "not settled by the end"
    before, after = (value_of(result, name) for name in ("unbalanced_amplitude_mm", "axis_amplitude_mm"))
    return f"The axis moves {after} in the end, {before} without balls; {when}."


def _final(final: End) -> list[Block]:
    rows = tuple(
        (str(k), f"{angle:.3f}°", f"{number(speed, 3)} rpm")
        for k, (angle, speed) in enumerate(zip(final.ball_angles_deg, final.ball_speeds_rpm, strict=True), 1)
    )
    blocks: list[Block] = [Heading(f"At the end, {value_of(final, 't_s')}"), facts(final, *FINAL)]
    return [*blocks, Grid(("ball", "angle", "speed"), rows, frozenset({1, 2}))] if rows else blocks


def _effects(entries: Sequence[EffectEntry]) -> list[Block]:
    return [Heading("Effects"), effects_grid(entries)] if entries else []


def _audit(audit: Audit | None) -> list[Block]:
    if audit is None:
        return []
    if not audit.effects:
        return [Heading("Audit"), Paragraph("Every effect was in already.")]
    text = (
        f"With {', '.join(audit.effects)} in as well, the results differ by {number(audit.difference, 2)}; "
        f"{number(audit.promise, 2)} were estimated. It took {audit.evaluations} evaluations, {audit.wall_s:.2f} s."
    )
    return [Heading("Audit"), Paragraph(text)]


def _rung(result: SimulateResult) -> str:
    """Which rung of the ladder was taken, and why not the one below."""
    if result.rung == "envelope":
        return "Averaged slow motion, for its error is small enough."
    return f"Equations of motion; the averaged ones will not do: {result.envelope.why}."


def _cost(cost: Cost) -> str:
    events = f", {cost.events} events" if cost.events else ""
    work = f"{cost.integrator}, tolerance {cost.tolerance:g}, {cost.evaluations} evaluations"
    return f"Cost: {work} in {cost.steps} steps{events}, {cost.wall_s:.2f} s. Integrator: {cost.why}."
