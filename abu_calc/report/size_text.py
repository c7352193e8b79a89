"""The report of `abu size`: verdict, design, checks, what was assumed, then the rest."""

from collections.abc import Iterable, Sequence
from typing import Any

from abu_calc.checks import Check, Status
from abu_calc.report.blocks import Block, Facts, Grid, Heading, Paragraph
from abu_calc.report.common import check_blocks, default_blocks, facts, warning_blocks
from abu_calc.report.quantities import number, shown
from abu_calc.sizing.housing import RULES
from abu_calc.spec.machine import Autobalancer

CONVENTIONS = (
    "Amplitudes are 0–peak, velocities of levels rms, levels 20 lg(v / 5e-8 m/s) in the louder of x and y; "
    "interference is positive when tight; angles of balls are measured from the imbalance in the sense of rotation."
)
START = (
    "Every scene starts at full speed, the axis at rest at its place, balls at rest in the race, bunched side by side "
    "20° ahead of the imbalance; rolling inertia and viscous drag are always in. A weight is what leaving the effect "
    "out may change, `abu effects` tells more. Two effects take long and are left to `abu simulate`: dry rolling "
    "friction, which stands in the accuracy budget, and, but for the idle scene, ball contact: balls then pass through "
    "each other."
)


def size_blocks(
    name: str,
    table: Autobalancer,
    result: dict[str, Any],
    status: Status,
    checks: Sequence[Check],
    warnings: Iterable[str],
    defaults: Iterable[tuple[str, object]],
) -> tuple[Block, ...]:
    """The whole report."""
    return (
        Heading(name),
        *_verdict(result, status, checks),
        *_design(table, result),
        *check_blocks(checks),
        *warning_blocks(warnings),
        *default_blocks(defaults),
        *_need(result),
        *_vibration(result),
        *_simulation(result),
        *_alternatives(result),
        *_swing_arm(result),
        *_seats(result),
        *_drawing(result),
        Heading("Conventions"),
        Paragraph(CONVENTIONS),
    )


def _verdict(result: dict[str, Any], status: Status, checks: Sequence[Check]) -> list[Block]:
    abu, levels = result["autobalancer"], result["vibration"]
    balls = _balls(abu)
    failed = [check for check in checks if check.status != "pass"]
    if not failed:
        settle = next((run["settling_time_s"] for run in result["simulation"]), None)
        soon = ", not simulated" if settle is None else f", settled in {number(settle, 2)} s"
        text = (
            f"PASS: {balls} on a race of R {abu['race_radius_mm']:g} mm balance this machine. Idle "
            f"{levels['level_before_db']:.1f} → {levels['level_after_db']:.1f} dB{soon}, "
            f"{abu['mass_g']:.0f} g ({100 * abu['mass_fraction']:.1f} % of the machine)."
        )
        return [Paragraph(text, status)]
    names = "; ".join(f"{check.name} ({check.code})" for check in failed)
    word = "FAIL" if status == "fail" else "NOT DONE"
    return [
        Paragraph(f"{word}: {names}. Best that was found: {balls} on a race of R {abu['race_radius_mm']:g} mm.", status)
    ]


def _balls(abu: dict[str, Any]) -> str:
    """Count and size, inch sizes to the micrometre."""
    return f"{abu['ball_count']} × Ø{round(abu['ball_diameter_mm'], 3):g} mm"


def _design(table: Autobalancer, result: dict[str, Any]) -> list[Block]:
    abu = result["autobalancer"]
    kind = "rollers" if table.corrector == "roller" else "balls"
    balls = _balls(abu)
    keys = (
        *("ball_mass_g", "race_radius_mm", "pitch_radius_mm", "groove_radius_mm", "outer_diameter_mm", "width_mm"),
        *("mass_g", "mass_fraction", "capacity_g_mm", "capacity_ratio", "ball_force_N", "contact_pressure_MPa"),
        *("hoop_stress_MPa", "carry_over_rpm", "optimum_drag_per_s"),
    )
    rows = ((f"{table.ball_material} {kind}", "n × 2r", balls), *facts(abu, *keys).rows)
    return [Heading("Design"), Facts(rows), Paragraph(f"Housing {RULES[table.design].text}.")]


def _need(result: dict[str, Any]) -> list[Block]:
    return [
        Heading("Frequencies and capacity"),
        facts(result, "system_mass_kg", "effective_mass_kg"),
        facts(result["frequency"], "speed_hz", "natural_frequencies_hz", "region", "finite_mass_gap"),
        Paragraph(_stability(result["frequency"])),
        facts(result, "imbalance_g_mm", "required_capacity_g_mm", "required_capacity_limit_g_mm",
              "required_capacity_compliant_g_mm"),
        Heading("Accuracy budget, displacements at the wheel"),
        facts(result["accuracy_budget"], *(key for key, value in result["accuracy_budget"].items()
              if value or key not in ("plane_offset_um", "capacity_shortfall_um"))),
    ]  # fmt: skip


def _stability(frequency: dict[str, Any]) -> str:
    """What the eigenvalues say beside the simple rule."""
    stable, limits = frequency["stable"], frequency["stability_boundaries_rpm"]
    if stable is None or limits is None:
        return "Whether the balanced state is stable at idle is not known."
    word = "stable" if stable else "not stable"
    changes = ", ".join(f"{number(one['speed_rpm'], 4)} rpm ({_above(one)} above)" for one in limits)
    return f"Balanced state at idle, by its eigenvalues: {word} at the rated speed. Changes at {changes or 'no speed'}."


def _above(boundary: dict[str, Any]) -> str:
    return "stable" if boundary["stable_above"] else "not stable"


def _vibration(result: dict[str, Any]) -> list[Block]:
    rows = []
    for state, key in (("idle", "vibration"), ("under load", "vibration_loaded")):
        for place in (result[key] or {}).get("handles", ()):
            keys = ("level_before_db", "level_after_db", "reduction_db", "effective_mass_kg")
            rows.append((state, place["name"], *(_tenths(place[key]) for key in keys)))
    header = ("", "place", "before, dB", "after, dB", "reduction, dB", "felt mass, kg")
    blocks: list[Block] = [Heading("Vibration level"), Grid(header, tuple(rows), frozenset({2, 3, 4, 5}))]
    if result["vibration_loaded"]:
        blocks.append(Paragraph("Under load is information, not a check: it rests on the contact's stiffness."))
    return blocks


def _tenths(value: float | None) -> str:
    return "–" if value is None else f"{value:.1f}"


def _simulation(result: dict[str, Any]) -> list[Block]:
    blocks: list[Block] = []
    for run in result["simulation"]:
        cost, angles = run["cost"], ", ".join(f"{angle:.1f}°" for angle in run["final"]["ball_angles_deg"])
        work = f"{cost['integrator']}, tolerance {cost['tolerance']:g}, {cost['evaluations']} evaluations"
        blocks += [
            Heading(f"Simulation: {run['scene']}"),
            facts(run, "duration_s", "settling_time_s", "residual_imbalance_g_mm", "axis_amplitude_mm", "level_db",
                  "error_estimate"),
            Facts(
                tuple(
                    (f"settling at a drag of {other['drag_per_s']:g} 1/s", "about", shown("settling_time_s", time))
                    for other in run.get("settling_estimates", ())
                    if (time := other["settling_time_s"]) is not None
                )
            ),
            Paragraph(f"The balls end at {angles} from the imbalance."),
            Paragraph(f"Effects in: {_in(run)}. Left out: {_out(run)}."),
            Paragraph(f"Cost: {work}, {cost['wall_s']:.2f} s."),
        ]  # fmt: skip
    return [*blocks, Paragraph(START)] if blocks else []


def _in(run: dict[str, Any]) -> str:
    return ", ".join(each["name"] for each in run["effects"] if each["included"]) or "none"


def _out(run: dict[str, Any]) -> str:
    out = [each for each in run["effects"] if not each["included"]]
    return ", ".join(f"{each['name']} ({_weight(each['weight'])})" for each in out) or "none"


def _weight(weight: float | None) -> str:
    return "weight not known" if weight is None else f"weight {number(weight, 2)}"


def _alternatives(result: dict[str, Any]) -> list[Block]:
    if not result["alternatives"]:
        return []
    keys = ("race_radius_mm", "mass_g", "capacity_ratio", "residual_um")
    rows = tuple(
        (_balls(one), *(_bare(key, one[key]) for key in keys), one["why_not"]) for one in result["alternatives"]
    )
    header = ("balls", "R, mm", "mass, g", "cap./need", "rest, µm", "why not")
    return [Heading("Runners-up"), Grid(header, rows, frozenset({1, 2, 3, 4}))]


def _bare(key: str, value: float | None) -> str:
    return "–" if value is None else shown(key, value).split(" ")[0]


def _swing_arm(result: dict[str, Any]) -> list[Block]:
    arm = result["swing_arm"]
    return [Heading("Swing arm"), facts(arm, *arm)] if arm else []


def _seats(result: dict[str, Any]) -> tuple[Block, ...]:
    if not result["fits"]:
        return ()
    from abu_calc.report.fits import fit_blocks

    return fit_blocks(result["fits"])


def _drawing(result: dict[str, Any]) -> list[Block]:
    rows = tuple(
        (line["feature"], line["requirement"], "" if line["cost_db"] is None else f"{line['cost_db']:.1f}")
        for line in result["drawing"]
    )
    note = (
        "The cost is what the level rises by when the tolerance is used up, the rest of the budget standing. "
        "Requirements are engineering practice (assumed)."
    )
    return [
        Heading("For the drawing"),
        Grid(("feature", "requirement", "costs, dB"), rows, frozenset({2})),
        Paragraph(note),
    ]
