"""What each effect costs and changes, simulated when the page is built.

```{abu-effect-prices} left-out
```

shows scenes whose accuracy needs no effect of that name, `decides` scenes that an effect decides.
"""

import copy
import tomllib
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList
from sphinx.application import Sphinx

import abu_calc
from abu_calc.simulation.model_level import difference

SCENE = Path(__file__).parents[1] / "examples" / "scene.toml"


class Case(NamedTuple):
    """A scene like docs/examples/scene.toml with these effects alone, one of which is looked at; words of a table."""

    effect: str
    words: str
    effects: dict[str, Any]
    scene: dict[str, Any] = {}  # noqa: RUF012
    race: dict[str, Any] = {}  # noqa: RUF012
    accuracy: float = 0.01


def _friction(lever_arm_mm: float) -> dict[str, Any]:
    return {"dry_rolling_friction": {"lever_arm_mm": lever_arm_mm, "ball_radius_mm": 8.0}}


def _across(axial_runout_mm: float, groove_radius_mm: float) -> dict[str, Any]:
    across = {"groove_radius_mm": groove_radius_mm, "ball_radius_mm": 8.0, "axial_runout_mm": axial_runout_mm}
    return {"transverse_motion": across, **_friction(0.002)}


def _pressed(contact: str, **more: float) -> dict[str, Any]:
    return {"grinding_contact": {"contact": contact, "press_force_N": 45.0, "cutting_coefficient": 0.35, **more}}


APART = {"start_angles_deg": [90.0, -90.0]}
TOUCHING = {"ball_contact": {"ball_radius_mm": 8.0, "restitution": 0.5}}
DRIVE = {"stall_torque_N_m": 3.0, "no_load_speed_rpm": 6000.0, "rotor_inertia_kg_m2": 2e-3}

CASES = {
    "left-out": (
        Case("gravity", "30 000 rpm, accuracy 0.02", {"gravity": {}}, {"speed_rpm": 30000.0}, accuracy=0.02),
        Case("race_eccentricity", "a nanometre", {"race_eccentricity": {"magnitude_mm": 1e-6, "angle_deg": 180.0}}),
        Case("dry_rolling_friction", "lever arm 5e-8 mm", _friction(5e-8)),
        Case("transverse_motion", "axial runout 0.1 µm", _across(1e-4, 29.0)),
        Case("grinding_contact", "by the wheel's face", _pressed("face")),
    ),
    "decides": (
        Case("gravity", "1500 rpm", {"gravity": {}}, {"speed_rpm": 1500.0}),
        Case("race_eccentricity", "10 µm", {"race_eccentricity": {"magnitude_mm": 0.01, "angle_deg": 180.0}}),
        Case("dry_rolling_friction", "lever arm 2 µm", _friction(0.002)),
        Case("transverse_motion", "axial runout 50 µm, near resonance", _across(0.05, 24.5)),
        Case("grinding_contact", "200 N/mm, runout 40 µm",
             _pressed("compliant", contact_stiffness_N_per_m=2e5, runout_mm=0.04)),
        Case("ball_contact", "balls start together", TOUCHING),
        Case("ball_contact", "balls start apart: nothing, but not known before", TOUCHING, race=APART),
        Case("run_up", "1 s", {"run_up": {"time_s": 1.0}}),
        Case("motor", "3 N·m", {"motor": DRIVE}),
    ),
}  # fmt: skip
HEADER = ("effect", "scene", "estimate", "simulated", "leaving it out changes", "time with it, s", "without, s",
          "as chosen, s")  # fmt: skip


def row(case: Case) -> tuple[str, ...]:
    """Simulate a case with the effect, without it, and as the program chooses."""
    file = copy.deepcopy(tomllib.loads(SCENE.read_text(encoding="utf-8")))
    file["scene"].update({"duration_s": 2.0, **case.scene}, effects=case.effects)
    file["scene"]["race"][0].update(case.race)
    scene, accuracy, name = abu_calc.read_scene(file), case.accuracy, case.effect
    whole = abu_calc.simulate(scene, accuracy=accuracy, with_effects=[name])
    reduced = abu_calc.simulate(scene, accuracy=accuracy, without_effects=[name])
    chosen = abu_calc.simulate(scene, accuracy=accuracy)
    (estimate,) = (each.weight for each in abu_calc.effects(scene, accuracy=accuracy).effects if each.name == name)
    (included,) = (each.included for each in chosen.effects if each.name == name)
    changed = difference(whole.run.scene, reduced.run.response, whole.run.response)
    return (
        f"`{name}`", case.words, "not known" if estimate is None else f"{estimate:.2g}", "yes" if included else "no",
        f"{changed:.2g}", *(f"{each.cost.wall_s:.2g}" for each in (whole, reduced, chosen)),
    )  # fmt: skip


class EffectPrices(Directive):
    """Table of one group of cases."""

    required_arguments: ClassVar[int] = 1

    def run(self) -> list[nodes.Node]:
        """Simulate the cases."""
        rows = [HEADER, ["---"] * len(HEADER), *map(row, CASES[self.arguments[0]])]
        lines = StringList([f"| {' | '.join(cells)} |" for cells in rows], source="effect prices")
        container = nodes.container()
        self.state.nested_parse(lines, 0, container)
        return [container]


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directive."""
    app.add_directive("abu-effect-prices", EffectPrices)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
