"""The report of `abu simulate`: what came out, where the balls ended, what was left out, what it cost."""

from collections.abc import Iterable, Sequence
from typing import Any

from abu_calc.checks import Check
from abu_calc.dynamics.scene import Scene
from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.common import check_blocks, default_blocks, facts, of_scene, warning_blocks
from abu_calc.report.effects import ledger_grid
from abu_calc.report.quantities import number, shown

CONVENTIONS = (
    "Amplitudes are 0–peak over the last twentieth of the run, about the mean place; velocities rms, in the larger of "
    "x and y; levels 20 lg(v / 5e-8 m/s). Ball angles are measured in the rotor from its zero mark (of a machine: the "
    "imbalance) in the sense of rotation, ball speeds relative to the race. Settled: the imbalance left stays near its "
    "final value."
)

FINAL = (
    *("x_mm", "y_mm", "vx_mm_per_s", "vy_mm_per_s", "tilt_x_mrad", "tilt_y_mrad", "arm_angle_mrad"),
    "rotor_speed_rpm",
)


def simulate_blocks(
    title: str,
    start: str,
    result: dict[str, Any],
    scene: Scene,
    checks: Sequence[Check],
    warnings: Iterable[str],
    defaults: Iterable[tuple[str, object]],
) -> tuple[Block, ...]:
    """The whole report."""
    keys = ("duration_s", "settling_time_s", "residual_imbalance_g_mm", "axis_amplitude_mm", "unbalanced_amplitude_mm",
            "largest_amplitude_mm", "bearing_amplitudes_mm", "velocity_rms_mm_per_s", "level_db",
            "error_estimate")  # fmt: skip
    return (
        Heading(f"{title}: simulation{of_scene(result['scene'])}"),
        Paragraph(_verdict(result), checks[0].status),
        Heading("Motion"),
        facts(result, *keys),
        *_final(result["final"]),
        *_effects(result["effects"]),
        *_audit(result.get("audit")),
        *check_blocks(checks),
        *warning_blocks(warnings),
        *default_blocks(defaults),
        Heading("Model"),
        Paragraph(f"{_model(scene)} Start: {start}."),
        Paragraph(f"{_rung(result)} {_cost(result['cost'])}"),
        Heading("Conventions"),
        Paragraph(CONVENTIONS),
    )


def _model(scene: Scene) -> str:
    """Support, races and balls in a sentence."""
    races, balls = len(scene.races), len(scene.ball_masses)
    contact = "" if scene.balls_meet or balls < 2 else "; balls pass through each other"
    where = "one race" if races == 1 else f"{races} races"
    return f"{scene.support.description}, {where} with {balls} balls in all, viscous rolling drag{contact}."


def _effects(entries: list[dict[str, Any]]) -> list[Block]:
    return [Heading("Effects"), ledger_grid(entries)] if entries else []


def _audit(audit: dict[str, Any] | None) -> list[Block]:
    if audit is None:
        return []
    if not audit["effects"]:
        return [Heading("Audit"), Paragraph("Every effect was in already.")]
    told = (
        f"With {', '.join(audit['effects'])} in as well, the results differ by {number(audit['difference'], 2)}; "
        f"{number(audit['promise'], 2)} were estimated. It took {audit['evaluations']} evaluations, "
        f"{audit['wall_s']:.2f} s."
    )
    return [Heading("Audit"), Paragraph(told)]


def _verdict(result: dict[str, Any]) -> str:
    settled = result["settling_time_s"]
    when = "not settled by the end" if settled is None else f"settled in {shown('settling_time_s', settled)}"
    before, after = (shown(key, result[key]) for key in ("unbalanced_amplitude_mm", "axis_amplitude_mm"))
    return f"The axis moves {after} in the end, {before} without balls; {when}."


def _final(final: dict[str, Any]) -> list[Block]:
    rows = tuple(
        (str(k), f"{angle:.3f}°", f"{number(speed, 3)} rpm")
        for k, (angle, speed) in enumerate(zip(final["ball_angles_deg"], final["ball_speeds_rpm"], strict=True), 1)
    )
    blocks: list[Block] = [
        Heading(f"At the end, {shown('t_s', final['t_s'])}"),
        facts(final, *FINAL),
    ]
    return [*blocks, Grid(("ball", "angle", "speed"), rows, frozenset({1, 2}))] if rows else blocks


def _rung(result: dict[str, Any]) -> str:
    """Which rung of the ladder was taken, and why not the one below."""
    if result["rung"] == "envelope":
        return "Averaged slow motion, for its error is small enough."
    return f"Equations of motion; the averaged ones will not do: {result['envelope']['why']}."


def _cost(cost: dict[str, Any]) -> str:
    events = f", {cost['events']} events" if cost["events"] else ""
    work = f"{cost['integrator']}, tolerance {cost['tolerance']:g}, {cost['evaluations']} evaluations"
    return f"Cost: {work} in {cost['steps']} steps{events}, {cost['wall_s']:.2f} s. Integrator: {cost['why']}."
