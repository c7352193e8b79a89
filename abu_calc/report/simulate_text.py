"""The report of `abu simulate`: what came out, where the balls ended, what was left out, what it cost."""

from collections.abc import Iterable, Sequence
from typing import Any

from abu_calc.checks import Check
from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.common import check_blocks, default_blocks, facts, warning_blocks
from abu_calc.report.quantities import number, shown

CONVENTIONS = (
    "Amplitudes are 0–peak over the last twentieth of the run, about the mean place; velocities rms, in the larger of "
    "x and y; levels 20 lg(v / 5e-8 m/s). Ball angles are measured in the rotor from its zero mark (of a machine: the "
    "imbalance) in the sense of rotation, ball speeds relative to the race. Settled: the imbalance left stays near its "
    "final value."
)
MODEL = "Planar support at constant speed, one race, viscous rolling drag; balls pass through each other."


def simulate_blocks(
    title: str,
    start: str,
    result: dict[str, Any],
    checks: Sequence[Check],
    warnings: Iterable[str],
    defaults: Iterable[tuple[str, object]],
) -> tuple[Block, ...]:
    """The whole report."""
    keys = ("duration_s", "settling_time_s", "residual_imbalance_g_mm", "axis_amplitude_mm", "unbalanced_amplitude_mm",
            "velocity_rms_mm_per_s", "level_db", "error_estimate")  # fmt: skip
    return (
        Heading(f"{title}: simulation of the scene {result['scene']}"),
        Paragraph(_verdict(result), checks[0].status),
        Heading("Motion"),
        facts(result, *keys),
        *_final(result["final"]),
        *_effects(result["effects"]),
        *check_blocks(checks),
        *warning_blocks(warnings),
        *default_blocks(defaults),
        Heading("Model"),
        Paragraph(f"{MODEL} Start: {start}."),
        Paragraph(_cost(result["cost"])),
        Heading("Conventions"),
        Paragraph(CONVENTIONS),
    )


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
        facts(final, "x_mm", "y_mm", "vx_mm_per_s", "vy_mm_per_s"),
    ]
    return [*blocks, Grid(("ball", "angle", "speed"), rows, frozenset({1, 2}))] if rows else blocks


def _effects(effects: Sequence[dict[str, Any]]) -> list[Block]:
    rows = tuple(
        (effect["name"], "in" if effect["included"] else "out",
         "" if effect["weight"] is None else number(effect["weight"], 2), effect["why"])
        for effect in effects
    )  # fmt: skip
    return [Heading("Effects"), Grid(("effect", "", "weight", "why"), rows, frozenset({2}))] if rows else []


def _cost(cost: dict[str, Any]) -> str:
    work = f"{cost['integrator']}, tolerance {cost['tolerance']:g}, {cost['evaluations']} evaluations"
    return f"Cost: {work} in {cost['steps']} steps, {cost['wall_s']:.2f} s."
