"""Results of one machine that is built and switched on once."""

from dataclasses import replace

from abu_calc.analysis.balanced import HALF, allowed_imbalance, balances, slip
from abu_calc.analysis.ensemble import WORK, outcome_of
from abu_calc.analysis.outcomes import Outcome
from abu_calc.analysis.response import Response, evaluate, needed_times
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.integrators.run import MOST_EVALUATIONS
from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.dynamics.supports.receptance import reference_imbalance
from abu_calc.formulas.friction_band import friction_band
from abu_calc.formulas.motion import SETTLED
from abu_calc.frozen import dataclass
from abu_calc.scenes.switched_on import SwitchedOn, scene_switched_on
from abu_calc.sizing.built import with_worst
from abu_calc.sizing.design import Design


def machine_started(design: Design, start: SwitchedOn, lighter: tuple[float, ...], tolerance: float) -> Outcome:
    """One start of one machine, by one run with every effect there is data for. Raises NotTrustworthyError."""
    scene, _ = with_parted_balls(scene_switched_on(design, start, lighter))
    response = _response(scene, tolerance, WORK)
    outcome = outcome_of(design, start.member(design), scene, response)
    if outcome.balanced or outcome.hanging or outcome.imbalance > HALF * scene.imbalance:
        return outcome
    # Only where it decides: the worst arrangement of balls that friction holds takes longer than all the rest.
    return replace(outcome, allowed=allowed_imbalance(with_worst(design), scene.imbalance))


@dataclass(frozen=True)
class SceneOutcome:
    """A scene given outright, run once, and whether its balls balance."""

    response: Response
    slip: float
    balanced: bool


def scene_once(scene: Scene, tolerance: float) -> SceneOutcome:
    """One run of a scene. It balances as a machine does: see `balanced`. Raises NotTrustworthyError."""
    scene, _ = with_parted_balls(scene)
    response = _response(scene, tolerance, MOST_EVALUATIONS)
    slipping = slip(response, abs(response.final.speed) or scene.speed)
    balanced = balances(response.residual_imbalance, _allowed(scene, response), slipping)
    return SceneOutcome(response, slipping, balanced)


def _allowed(scene: Scene, response: Response) -> float:
    """A tenth of the imbalance, and what eccentricity and dry friction leave; with friction at most half of it."""
    mass = scene.support.felt_mass
    eccentric, rolling = scene.effect("race_eccentricity"), scene.effect("dry_rolling_friction")
    tenth = SETTLED * reference_imbalance(scene) + mass * getattr(eccentric, "magnitude", 0.0)
    if rolling is None:
        return tenth
    arm, radius = getattr(rolling, "lever_arm", 0.0), getattr(rolling, "ball_radius", 1.0)
    first, held = 0, 0.0
    for race in scene.races:
        angles = response.ball_angles[first : first + len(race.ball_masses)]
        held, first = max(held, friction_band(arm, race.pitch_radius, radius, angles)), first + len(angles)
    return max(tenth, min(tenth + mass * held, HALF * scene.imbalance))


def _response(scene: Scene, tolerance: float, work: int) -> Response:
    equations = assemble(scene)
    choice = choose(equations, "auto", tolerance)
    run = choice.integrate(equations, tolerance, needed_times(scene), choice.evaluations(work))
    return evaluate(scene, run)
