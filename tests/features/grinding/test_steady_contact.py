"""The machine at its work: closed form against simulation on machines drawn at random, and against own equations.

The own equations are those of Kladiev 1996, (1), with rolling inertia, damping and T = sfN, integrated by SciPy; the
contact rigid, or a spring.

Levels under load that are lower bounds: their weighted total by ISO 5349-1, and a wheel without runout.
"""

import cmath
import math
import random
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import Sampling
from abu_calc.features.grinding.checks import AGREES, agreement, flutter_limits, work_checks
from abu_calc.features.grinding.curves import hodograph, largest_runout, loaded_resonance, response
from abu_calc.features.grinding.simulation import working
from abu_calc.features.grinding.steady_contact import (
    LEAST,
    LevelBound,
    RestingBalls,
    bare,
    even_fan,
    fitted,
    fixed,
    lower_bound,
    runout_of,
    with_balls,
)
from abu_calc.features.grinding.verdict import AxisMotion
from abu_calc.features.grinding.work import Work, at_work
from abu_calc.formulas.tilting_contact import SteadyContact
from abu_calc.simulation.scene_of_design import grinding_without, scene_of_design
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from tests.sizing.machines import machine

ALL = 100
"""How many random machines."""


def drawn(seed: int) -> Design:
    """A machine at its work, pressed hard enough never to part, of any contact, sense and place of the runout."""
    r = random.Random(seed)
    contact: dict[str, Any] = {"contact": r.choice(["rigid", "compliant", "compliant"])}
    if contact["contact"] == "compliant":
        contact["contact_stiffness_N_per_m"] = 10 ** r.uniform(4.5, 7.5)
    return size(
        machine(
            machine__mass_kg=r.uniform(2, 8),
            machine__speed_rpm=r.uniform(3000, 9000),
            machine__spindle_axis=r.choice(["horizontal", "vertical"]),
            suspension__natural_frequencies_hz=[r.uniform(1, 12), r.uniform(1, 12)],
            suspension__damping_ratios=[r.uniform(0.15, 0.7), r.uniform(0.15, 0.7)],
            wheel__imbalance_g_mm=r.uniform(50, 300),
            wheel__runout_mm=r.uniform(0.0, 0.06),
            wheel__runout_angle_deg=r.uniform(-180, 180),
            autobalancer__max_outer_diameter_mm=90.0,
            autobalancer__ball_count=r.choice([2, 2, 3, 4]),
            autobalancer__ball_diameter_mm=16.0,
            autobalancer__race_radius_mm=r.choice([30.0, 32.0, 36.0]),
            autobalancer__rolling_drag_per_s=r.uniform(15, 60),
            grinding={
                "press_force_N": 1e5,
                "cutting_coefficient": r.uniform(0, 0.5),
                "rotation_sense": r.choice([-1, 1]),
                **contact,
            },
        )
    )


def check(seed: int) -> str:
    """The closed form of a machine against its simulation, whatever it says of its balls; gives what it says."""
    design = drawn(seed)
    balls = fitted(design, runout_of(design.case)).balls
    assert balls is not None
    says: dict[str, Callable[[Design, RestingBalls], bool]] = {
        "balanced": check_balanced, "restless": check_restless, "short": check_together, "gathered": check_together,
        "turning": check_turning,
    }  # fmt: skip
    assert says[balls.places](design, balls), (seed, balls.places)
    return balls.places


def check_balanced(design: Design, balls: RestingBalls) -> bool:
    """The run ends at the closed form, from idle or, where that takes too long or leads elsewhere, started there."""
    found = agreement(replace_runs(design), 1e-3)
    return found is not None and found.failure is None and found.apart is not None and found.apart < AGREES


def check_restless(design: Design, balls: RestingBalls) -> bool:
    """Balls a milliradian off their places leave them: they swing by a twentieth of what is asked of them."""
    angles = tuple(angle + 1e-3 * (k % 2) for k, angle in enumerate(balls.angles))
    total, _ = course(design, angles, contact_only=True)
    needed = balls.needed + design.imbalance.value
    return float(np.abs(total[len(total) // 20 :] - needed).max()) > 0.05 * abs(balls.needed)


def check_together(design: Design, balls: RestingBalls) -> bool:
    """Touching balls come to rest side by side where the closed form has them, to a hundredth."""
    total, _ = course(design, None, contact_only=False)
    assert balls.resultant is not None
    told, last = design.imbalance.value + balls.resultant, total[-len(total) // 20 :]
    return abs(complex(last.mean()) - told) < 0.01 * abs(balls.resultant)


def check_turning(design: Design, balls: RestingBalls) -> bool:
    """They never come to rest: what they add up to goes on changing by much of what is asked of them."""
    total, _ = course(design, None, contact_only=False)
    last = total[-len(total) // 3 :]
    return float(np.abs(last - last.mean()).max()) > 0.3 * abs(balls.needed)


def course(
    design: Design, angles: tuple[float, ...] | None, *, contact_only: bool, seconds: float = 6.0
) -> tuple[np.ndarray, Scene]:
    """Imbalance of rotor and balls in time, nothing in but wheel and work, and unless `contact_only` balls that touch.

    From these angles, or from where balls balance at idle; what may be chaotic by one run.
    """
    scene = scene_of_design(design, "grinding", "settled")
    kinds = (GrindingContactEffect,) if contact_only else (GrindingContactEffect, BallContactEffect)
    races = tuple(race if angles is None else replace(race, start_angles=angles) for race in scene.races)
    kept = tuple(each for each in scene.effects if isinstance(each, kinds))
    turns = round(seconds / scene.revolution)
    scene = replace(scene, effects=kept, races=races, duration=turns * scene.revolution)
    equations, times = assemble(scene), scene.duration * np.arange(16 * turns + 1) / (16 * turns)
    choice = choose(equations, "auto", 1e-6)
    run = choice.integrate(equations, 1e-6, Sampling(times), 50_000_000)
    first = 2 * len(scene.support.names)
    return scene.total_imbalance(run.at(times)[first : first + len(scene.ball_masses)]), scene


def replace_runs(design: Design) -> Any:
    """The work of a machine, without its runs: these are simulated in `agreement` alone."""
    from abu_calc.features.grinding import work as grinding

    runout = runout_of(design.case)
    sides = grinding.Side(bare(design, runout)), grinding.Side(fitted(design, runout))
    return grinding.Work(design, *sides, sides[1], design.idle, design.idle, None, 0.0)


USUAL = {0: "balanced", 1: "balanced", 16: "restless", 11: "short", 40: "gathered", 147: "balanced"}
"""Machines as they are drawn: compliant, rigid of the sense that feeds balls, and others that are not so simple. 147 is
within a fifth of the contact's resonance, where its balls go round when they come from idle.
"""


@pytest.mark.few(1)
@pytest.mark.parametrize("seed", USUAL)
@pytest.mark.slow
def test_closed_form_and_simulation_agree(seed: int) -> None:
    assert check(seed) == USUAL[seed]


@pytest.mark.hard
def test_closed_form_and_simulation_agree_on_a_hundred_machines() -> None:
    """As they are drawn, none left out: where balls balance, where they go otherwise, and where they never rest."""
    said = Counter(check(seed) for seed in range(ALL))
    assert said["balanced"] > 75 and len(said) == 5, said


def test_what_leads_elsewhere_from_idle_is_told() -> None:
    """Machine 147: balls started at their places stay, to a thousandth; from idle they hang at the resonance below."""
    design = drawn(147)
    work = replace_runs(design)
    found = agreement(work, 1e-3)
    assert found is not None and not found.from_idle and found.apart is not None and found.apart < 0.005
    (told,) = [one for one in work_checks(work, None, found) if one.code == "ABU425"]
    assert told.status == "warn" and "do not arrive in time" in told.message


# A second derivation.
def integrated(
    contact: SteadyContact, runout: complex, imbalance: float, mass: float, ball: float, radius: float, drag: float,
    start: np.ndarray, seconds: float,
) -> tuple[complex, complex, complex]:  # fmt: skip
    """X, Y and the mean total imbalance of Kladiev 1996, (1), corrected; ball angles absolute, J = 7/5.

    x, x', y, y', γ, γ'; springs and dampers from the dynamic stiffness at the speed.
    """
    W, sf, J = contact.speed, contact.friction, 7 / 5
    held = [d + mass * W**2 for d in contact.dynamic_stiffness]
    c, b = [k.real for k in held], [k.imag / W for k in held]
    count, rigid = len(start), contact.compliance == 0
    eps, phi = abs(runout), cmath.phase(runout)

    def motion(t: float, s: np.ndarray) -> np.ndarray:
        x, vx, y, vy = s[:4]
        g, w = s[4 : 4 + count], s[4 + count :]
        sin, cos = np.sin(g), np.cos(g)
        gap = eps * math.sin(W * t + phi)
        if rigid:
            y, vy, ay = -gap, -eps * W * math.cos(W * t + phi), W**2 * gap
        else:
            N = -(y + gap) / contact.compliance
        # γ'' = a ax + d ay + e, put into the equations of the axis.
        a, d, e = sin / (J * radius), -cos / (J * radius), -drag * (w - W) / J
        fx = imbalance * W**2 * math.cos(W * t) - c[0] * x - b[0] * vx + ball * radius * (w**2 * cos + e * sin).sum()
        fy = imbalance * W**2 * math.sin(W * t) - c[1] * y - b[1] * vy + ball * radius * (w**2 * sin - e * cos).sum()
        m = ball * radius
        xx, xy = mass - m * (a * sin).sum(), -m * (d * sin).sum()
        yx, yy = m * (a * cos).sum(), mass + m * (d * cos).sum()
        if rigid:
            # N = yx ax + yy ay − fy;  xx ax + xy ay = fx + sf N
            ax = (fx + sf * (yy * ay - fy) - xy * ay) / (xx - sf * yx)
        else:
            ax, ay = np.linalg.solve([[xx, xy], [yx, yy]], [fx + sf * N, fy + N])
        return np.concatenate([[vx, ax, vy, ay], w, a * ax + d * ay + e])

    first = contact.axis(contact.balancing_imbalance(runout), runout)
    y0 = [first[0].real, -W * first[0].imag, first[1].real, -W * first[1].imag, *start, *[W] * count]
    turn = 2 * math.pi / W
    times = seconds - 10 * turn + np.arange(10 * 40) * turn / 40
    run = solve_ivp(motion, (0, seconds), y0, "DOP853", times, rtol=1e-7, atol=1e-12, max_step=turn / 8)
    back = np.exp(-1j * W * times)
    y = -eps * np.sin(W * times + phi) if rigid else run.y[2]
    total = imbalance + ball * radius * (np.exp(1j * run.y[4 : 4 + count]) * back).sum(axis=0)
    return complex(2 * (run.y[0] * back).mean()), complex(2 * (y * back).mean()), complex(total.mean())


@pytest.mark.few(0, 2)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("stiffness", "sense", "runout"),
    [(None, -1, 4e-5), (None, 1, 4e-5), (4.9e5, -1, 9e-5), pytest.param(6e6, 1, 2e-5, marks=pytest.mark.slow)],
)
def test_closed_form_against_own_equations(stiffness: float | None, sense: int, runout: float) -> None:
    """Golden grinder, damped, its balls started 0.05 rad off: they come to where the closed form has them."""
    W, mass = 5800 * math.pi / 30, 5.6
    D = tuple(mass * (w**2 - W**2) + 60j * W for w in (80.0, 120.0))
    contact = SteadyContact(W, (D[0], D[1]), 0.0 if stiffness is None else 1 / stiffness, 0.35 * sense)
    E, own, ball, radius = cmath.rect(runout, 0.6), 100e-6, 16.728353e-3, 24e-3
    U = contact.balancing_imbalance(E)
    half = math.acos(abs(U - own) / (2 * ball * radius))
    start = np.array([cmath.phase(U - own) + sign * half + 0.05 for sign in (-1, 1)])
    # A stiff contact lets balls creep: it takes four times as long until a hundredth is left.
    found = integrated(contact, E, own, mass, ball, radius, 12.0, start, 3.6 if stiffness == 6e6 else 0.9)
    X, Y = contact.axis(U, E)
    assert found[2] == pytest.approx(U, rel=0.01, abs=1e-6)
    assert found[0] == pytest.approx(X, abs=0.01 * max(abs(X), abs(Y)))
    assert found[1] == pytest.approx(Y, abs=0.01 * max(abs(X), abs(Y)))


# Balls that do not balance.
def own_torque(contact: SteadyContact, imbalance: complex, runout: complex, angle: float) -> float:
    """What turns balls that lie together at an angle, by the motion of the axis itself: Im F e^{−iψ}."""
    x, y = contact.axis(imbalance, runout)
    return ((x + 1j * y) / 2 * cmath.exp(-1j * angle)).imag


@pytest.mark.slow
@pytest.mark.parametrize(
    ("changes", "places"),
    [
        ({"contact": "rigid", "cutting_coefficient": 0.4}, "short"),
        ({"contact": "compliant", "contact_stiffness_N_per_m": 3e6}, "gathered"),
    ],
)
def test_balls_side_by_side_rest_where_nothing_turns_them(changes: dict[str, Any], places: str) -> None:
    """No torque there, and one that drives them back from either side."""
    runout = 0.4 if places == "short" else 0.2
    design = size(machine(wheel__runout_mm=runout, wheel__runout_angle_deg=70.0, autobalancer__ball_count=2,
                          autobalancer__ball_diameter_mm=16.0, autobalancer__race_radius_mm=30.0,
                          grinding={"press_force_N": 1e5, **changes}))  # fmt: skip
    one = fitted(design, runout_of(design.case))
    assert one.balls is not None
    assert one.balls.places == places
    assert one.balls.resultant is not None
    angle, carried = cmath.phase(one.balls.resultant), abs(one.balls.resultant)
    assert carried == pytest.approx(design.autobalancer.capacity)

    def torque(at: float) -> float:
        return own_torque(one.contact, one.own + cmath.rect(carried, at), one.runout, at)

    scale = max(abs(torque(angle + shift)) for shift in (-1.0, 1.0))
    assert abs(torque(angle)) < 1e-6 * scale
    assert torque(angle + 0.02) < 0 < torque(angle - 0.02)
    spread = sum(cmath.exp(1j * each) for each in one.balls.angles)
    assert cmath.phase(spread) == pytest.approx(angle)


def test_even_fan_adds_up() -> None:
    for count, length in ((2, 0.3), (3, 1.7), (4, 0.1), (6, 3.0)):
        angles = even_fan(count, length, 0.2)
        assert sum(cmath.exp(1j * angle) for angle in angles) == pytest.approx(length, abs=1e-9)
    tight = even_fan(4, 3.99, 0.3)
    assert np.diff(tight) == pytest.approx([0.6] * 3)


# Facts.
def straight(**grinding: Any) -> Design:
    usual = {"press_force_N": 200.0, "contact": "compliant", "contact_stiffness_N_per_m": 4.9e5, **grinding}
    return size(machine(wheel__runout_mm=0.04, wheel__runout_angle_deg=30.0, grinding=usual))


def test_three_sides_of_one_machine() -> None:
    """Without the autobalancer its mass is missing; fixed balls leave no imbalance; free ones no forward whirl."""
    design = straight()
    E = runout_of(design.case)
    alone, still, free = bare(design, E), fixed(design, E), fitted(design, E)
    W2 = design.case.speed**2
    lighter = (alone.contact.dynamic_stiffness[0] - still.contact.dynamic_stiffness[0]).real / W2
    assert lighter == pytest.approx(design.autobalancer.mass)
    assert alone.imbalance == design.imbalance.value
    assert still.imbalance == 0
    assert free.axis is not None
    x, y = free.axis
    assert abs(x + 1j * y) < 1e-9 * abs(x)
    assert [one.pressure for one in (alone, still, free)] == [-1j * (one.reaction or 0) for one in (alone, still, free)]


def test_separation_is_where_the_force_reaches_the_press() -> None:
    design = straight()
    E = runout_of(design.case)
    for side in (bare, fixed, fitted):
        limit = largest_runout(design.case, side(design, E))
        assert limit is not None
        at = side(design, E / abs(E) * limit).reaction
        assert abs(at or 0) == pytest.approx(200.0)


def test_curves_hold_the_rated_machine() -> None:
    design = straight()
    E = runout_of(design.case)
    point = next(one for one in hodograph(design) if math.isclose(one.runout_angle, math.radians(30)))
    assert point.fitted == AxisMotion.of(fitted(design, E).axis)
    rated = next(one for one in response(design) if one.speed == design.case.speed)
    assert rated.without == AxisMotion.of(bare(design, E).axis)
    resonance = loaded_resonance(design)
    assert resonance is not None
    near = [abs(bare(design, E, speed=resonance * share).axis[1]) for share in (0.9, 1.0, 1.1)]  # type: ignore[index]
    assert near[1] > max(near[0], near[2])


@pytest.mark.slow
def test_a_parting_wheel_is_judged_by_its_run() -> None:
    """Pressed too little for its imbalance it parts, and the level without is that of the run."""
    design = straight(press_force_N=12.0)
    work = at_work(design, 0.01)
    assert work.without.pulls
    assert work.without.run is not None
    run = working(grinding_without(design), 0.01)
    assert work.levels.before == pytest.approx(20 * math.log10(run.velocity / 5e-8), abs=1e-6)
    assert run.parts


@pytest.mark.slow
def test_flutter_limit_decides_in_simulation() -> None:
    """Two balls at right angles at a rigid contact, f = 0.5: the drag's limit is in the closed form's eigenvalues."""
    design = drawn(0)
    limits = flutter_limits(replace_runs(design))
    assert limits is not None
    assert limits[0] <= limits[1] * (1 + 1e-9)
    none = with_balls(design, fitted(design, 0j).contact, 0j, 0j)
    assert none.balls is not None
    assert none.imbalance == 0


# Dry friction.
def left_by_friction(runout: float, seconds: float) -> float:
    """How far [m] balls at a rigid contact, of ideal race but with dry friction, stay from where they would balance."""
    design = size(
        machine(wheel__runout_mm=runout, autobalancer__ball_count=4, autobalancer__ball_diameter_mm=16.0,
                autobalancer__race_radius_mm=31.0,
                grinding={"contact": "rigid", "press_force_N": 1000.0, "cutting_coefficient": 0.0})
    )  # fmt: skip
    scene = scene_of_design(design, "grinding")
    kept = tuple(each for each in scene.effects if each.name not in ("race_eccentricity", "gravity"))
    run = working(replace(scene, effects=kept, duration=seconds), 0.01)
    steady = fitted(design, runout_of(design.case))
    return abs(run.imbalance - (steady.imbalance or 0)) / design.system_mass


@pytest.mark.slow
def test_whirl_above_the_threshold_shakes_friction_out_slowly() -> None:
    """k_r R_p/r = 5.75 µm: below it balls stay where they are held; three times above they creep home in seconds."""
    held, creeping, home = left_by_friction(0.004, 4.0), left_by_friction(0.02, 0.5), left_by_friction(0.02, 6.0)
    assert held > 2e-6
    assert creeping > 2e-6
    assert home < 0.1e-6


WEIGHT_100_HZ = 0.160
"""W_h of the third octave of 100 Hz, ISO 5349-1:2001."""


def _work(runout_mm: float, **changes: Any) -> Work:
    usual: dict[str, Any] = {
        "machine__speed_rpm": 6000,
        "machine__spindle_axis": "vertical",
        "wheel__runout_mm": runout_mm,
        "grinding": {"contact_stiffness_N_per_m": 1e5, "press_force_N": 300.0},
    }
    return at_work(size(machine(**{**usual, **changes})), 0.01)


def _bound(work: Work) -> LevelBound | None:
    """Of the usual case."""
    return lower_bound(work.levels.after, work.design.case)


@pytest.mark.few(1)
@pytest.mark.parametrize(("eccentricity_mm", "holds"), [(0.005, True), (0.01, True), (0.03, False)])
@pytest.mark.slow
def test_the_threshold_is_one_weighted_metre_per_second_squared(eccentricity_mm: float, holds: bool) -> None:
    """a_hv = √2·W_h·Ω·v with v of the level, on both sides of the threshold."""
    work = _work(0.02, autobalancer__race_eccentricity_mm=eccentricity_mm)
    bound, level = _bound(work), work.levels.after
    assert bound is not None and level is not None
    own = math.sqrt(2) * WEIGHT_100_HZ * 2 * math.pi * 100 * 5e-8 * 10 ** (level / 20)
    assert bound.total == pytest.approx(own, rel=0.01)
    assert bound.lower_bound is (own < LEAST) is holds
    assert bool(bound.sentence) is bound.lower_bound
    assert "the wheel's runout" in bound.set_by and "wheel waviness" in bound.lacks


@pytest.mark.slow
def test_a_wheel_without_runout_is_marked_however_loud_it_is() -> None:
    """Nothing but what race and friction leave drives it: the file says that the wheel of a grinder runs true."""
    bound = _bound(_work(0.0, autobalancer__race_eccentricity_mm=0.03))
    assert bound is not None and bound.lower_bound and bound.total is not None and bound.total > LEAST
    assert any("runout" in lacking for lacking in bound.lacks)
    assert not any("runout" in excitation for excitation in bound.set_by)
    assert "is a lower bound" in bound.sentence and "lacks" in bound.sentence


@pytest.mark.slow
def test_a_face_does_not_press_and_lacks_the_force_of_its_contact() -> None:
    bound = _bound(_work(0.0, grinding={"contact": "face"}))
    assert bound is not None and "the force of the contact" in bound.lacks
    assert bound.lower_bound is (bound.total is not None and bound.total < LEAST)


@pytest.mark.slow
def test_a_background_of_the_file_is_not_lacking() -> None:
    without, given = _bound(_work(0.1)), _bound(_work(0.1, machine__background_level_db=95.0))
    assert without is not None and given is not None
    assert "vibration of motor and gear" in without.lacks and "vibration of motor and gear" not in given.lacks
