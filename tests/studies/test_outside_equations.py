"""The equations outside the product: what mechanics demands of them, and, compiled, that the product agrees."""

import math
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.studies.outside_equations import COMPILED, Machine, collide, rates, workspace
from tests.studies.outside_runs import Start, ended, hands, machine_of, with_motor
from tests.studies.random_machines import FAMILIES, family_of, machine_text

PLANAR = Machine(
    core=2, arm=0.0, mass=np.diag((5.0, 5.0)), stiffness=np.diag((3000.0, 8000.0)), damping=np.diag((40.0, 90.0)),
    nodes=np.zeros(0), wheel=0.0, race=0.0, felt=5.0, places=np.zeros(1), imbalance=2e-4, carried=2e-4, balls=3,
    ball_mass=0.015, pitch=0.024, ball_radius=0.007, rolling=0.4, drag=15.0, friction=3e-4, gravity=9.80665,
    offset=1e-5, offset_angle=0.4, gap=2 * math.asin(7 / 24), restitution=0.5, speed=600.0, ramp=0.0, stall=0.0,
    no_load=700.0, inertia=1e-3, longest=1e-3,
)  # fmt: skip
TILTING = PLANAR._replace(
    core=4, mass=np.diag((5.0, 5.0, 0.04, 0.04)), stiffness=np.diag((3000.0, 8000.0, 30.0, 60.0)),
    damping=np.diag((40.0, 90.0, 0.3, 0.6)), wheel=0.11, race=0.12,
)  # fmt: skip
ARM = PLANAR._replace(
    core=1, arm=0.35, mass=np.array([[0.62]]), stiffness=np.array([[245.0]]), damping=np.array([[4.9]])
)


def free(p: Machine) -> Machine:
    """Nothing dissipates, and next to no torque drives the rotor."""
    return p._replace(damping=0 * p.damping, drag=0.0, friction=0.0, gravity=0.0, stall=1e-30)


def somewhere(p: Machine, seed: int = 1) -> np.ndarray[Any, Any]:
    """A state far from any symmetry."""
    rng, nq = np.random.default_rng(seed), len(p.stiffness)
    places = rng.normal(0, 1e-3 if p.core > 1 else 0.1, nq)
    angles = np.sort(rng.uniform(0, 5, p.balls)) + np.arange(p.balls) * p.gap
    speeds = p.speed * rng.uniform(0.7, 1.2, p.balls)
    return np.concatenate((places, (0.3,), angles, rng.normal(0, 0.1, nq), (p.speed,), speeds))


def energy(p: Machine, y: np.ndarray[Any, Any], step: float = 1e-20) -> float:
    """½ m v² of every ball by the complex step of its place, and so on: nothing of the equations is used."""
    nq, v = len(p.stiffness), len(y) // 2
    q, rate = y[:v], y[v:]

    def places(q: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        if p.arm:
            race = p.arm * np.array((np.cos(q[0]), np.sin(q[0])))
        else:
            race = q[:2] + (p.race * q[2:4] if p.core == 4 else 0.0)
        offset = q[nq] + p.offset_angle
        centre = race + p.offset * np.array((np.cos(offset), np.sin(offset)))
        return centre + p.pitch * np.array((np.cos(q[nq + 1 :]), np.sin(q[nq + 1 :]))).T

    velocities = places(q + 1j * step * rate).imag / step
    spin = (p.pitch + p.ball_radius) * rate[nq] - p.pitch * rate[nq + 1 :]
    moving = p.ball_mass / 2 * ((velocities**2).sum() + p.rolling * (spin**2).sum())
    if p.arm:
        wheel = p.arm * rate[0] * np.array((-math.sin(q[0]), math.cos(q[0])))
    else:
        wheel = rate[:2] + (p.wheel * rate[2:4] if p.core == 4 else 0.0)
    carried = p.imbalance * rate[nq] * wheel @ np.array((-math.sin(q[nq]), math.cos(q[nq])))
    own = rate[: p.core] @ p.mass @ rate[: p.core] / 2 + p.inertia * rate[nq] ** 2 / 2
    return float(moving + carried + own + q[:nq] @ p.stiffness @ q[:nq] / 2)


@pytest.mark.parametrize("p", [PLANAR, TILTING, ARM], ids=["planar", "tilting", "arm"])
def test_energy_stays_where_nothing_dissipates(p: Machine) -> None:
    """The power of the accelerations is none: dE/dt along the motion is nought beside its parts."""
    p = free(p)
    y = somewhere(p)
    slope = np.zeros_like(y)
    rates(p, y, 0.0, 1e4, workspace(p), slope)
    step = 1e-6
    change = (energy(p, y + step * slope) - energy(p, y - step * slope)) / (2 * step)
    alone = slope.copy()
    alone[len(y) // 2 :] = 0.0
    parts = (energy(p, y + step * alone) - energy(p, y - step * alone)) / (2 * step)
    assert abs(change) < 1e-4 * abs(parts)


@pytest.mark.parametrize("p", [PLANAR, TILTING], ids=["planar", "tilting"])
def test_drag_and_friction_take_their_power(p: Machine) -> None:
    """dE/dt = −Σ m R_p² h₀ s² − Σ f N R_p |s|, s = γ' − φ'; the friction below its bound by 2 N at most."""
    y = somewhere(p)
    v, nq = len(y) // 2, len(p.stiffness)
    slip = y[v + nq + 1 :] - y[v + nq]

    def power(p: Machine) -> float:
        slope, w = np.zeros_like(y), workspace(p)
        w.anchor[:, 0] = y[nq + 1 : v] - y[nq]
        rates(p, y, 0.0, 1e4, w, slope)
        return (energy(p, y + 1e-6 * slope) - energy(p, y - 1e-6 * slope)) / 2e-6

    braked = free(p)._replace(drag=15.0)
    lost = -p.ball_mass * p.pitch**2 * 15.0 * (slip**2).sum()
    assert power(braked) == pytest.approx(lost, rel=1e-3)
    rubbed = -power(free(p)._replace(friction=3e-4))
    most = 3e-4 * p.ball_mass * p.pitch**2 * (y[v + nq + 1 :] ** 2 * np.abs(slip)).sum()
    assert 0.5 * most < rubbed < 2 * most


def test_balls_bounce_by_restitution_and_no_momentum_is_made() -> None:
    """On a free machine: e of the speed of approach comes back, linear momentum and that about the axis stay."""
    p = free(PLANAR)._replace(stiffness=np.zeros((2, 2)), imbalance=0.0, offset=0.0, balls=2)
    y = np.array((0, 0, 0, 1.0, 1.0 + p.gap * (1 - 1e-9), 0, 0, 600.0, 640.0, 560.0), dtype=float)
    before, w = y.copy(), workspace(p)
    collide(p, y, np.array((0, 1)), w)
    assert y[9] - y[8] == pytest.approx(0.5 * 80, rel=1e-9)

    def momentum(y: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        along = np.array((-np.sin(y[3:5]), np.cos(y[3:5]))) * p.pitch * y[8:]
        return p.mass @ y[5:7] + p.ball_mass * (2 * y[5:7] + along.sum(axis=1))

    assert momentum(y) == pytest.approx(momentum(before), rel=1e-8)


def test_hands_weigh_what_the_standard_says() -> None:
    """Both hands move with the handle when it is shaken slowly without springs to the ground: their whole mass."""
    M, K, C = hands(5.0)
    assert M[[0, 2, 4]].sum() == pytest.approx(5 + 2 * (0.4129 + 0.0736 + 0.0163 + 0.01))
    assert K[[0, 2, 4]][:, [0, 2, 4]].sum() == pytest.approx(2 * 400.0)
    assert C[[1, 3, 5]][:, [1, 3, 5]].sum() == pytest.approx(2 * 111.5)


def test_the_sample_has_all_families() -> None:
    """And every file can be read as TOML; the same seed gives the same machine."""
    families = [family_of(seed) for seed in range(400)]
    assert families.count("held") == 160 and all(families.count(name) == 48 for name in FAMILIES[1:])
    for family in FAMILIES:
        assert tomllib.loads(machine_text(3, family)) == tomllib.loads(machine_text(3, family))


SCENES = [
    (10, "held", "bunched"), (10, "held", "standstill"), (10, "held", "run-up"), (2, "held", "behind"),
    (2, "held", "spread"), (6, "held", "bunched"), (6, "held", "standstill"), (6, "held", "run-up"),
    (17, "range", "bunched"), (27, "held", "spread"), (2, "motor", "bunched"), (2, "motor", "spread"),
]  # fmt: skip
"""Seed, family, start: isotropic and horizontal, vertical, in hands, with a motor at its idle speed."""


@pytest.mark.slow
@pytest.mark.skipif(not COMPILED, reason="plain Python would take an hour; pip install numba")
@pytest.mark.parametrize(("seed", "family", "kind"), SCENES)
def test_the_product_agrees(seed: int, family: str, kind: str, tmp_path: Path) -> None:
    """Settling within 4 % or a revolution, level within 0.2 dB: some balls still creep where a scene ends."""
    import abu_calc
    from abu_calc.features.design.verification import proven
    from abu_calc.inputs.read_machine import read_machine
    from abu_calc.simulation.ensemble import start_once
    from abu_calc.simulation.start_cases import Member, idle_speed, scene_of_member, usual_run_up
    from abu_calc.sizing import size

    text, path = machine_text(seed, family), tmp_path / "machine.toml"
    path.write_text(text, encoding="utf-8")
    design = proven(size(read_machine(str(path)).whole("size"))).design
    result, file = abu_calc.size(abu_calc.read(str(path)), workers=1).to_dict(), tomllib.loads(text)
    member = Member(kind, design.case.drag, 0.0, math.tau, speed=idle_speed(design.case))  # type: ignore[arg-type]
    if kind == "run-up":
        member = replace(usual_run_up(design), eccentricity=math.pi)
    scene = scene_of_member(design, member)
    found = start_once(design, member, 0.01, 2e-5, work=4_000_000, early_end=False)
    speeds = [0.0 if member.run_up else scene.speed + own for own in scene.races[0].start_speeds]
    machine = machine_of(file, result)._replace(
        offset_angle=member.eccentricity, speed=scene.speed, ramp=member.run_up, places=np.zeros(1)
    )
    start = Start(kind, machine, scene.races[0].start_angles, tuple(speeds), 0.0, member.run_up)
    ending = ended(with_motor(start, file), result, design.case.table.limits.settling_time_s)
    assert found.settling_time_or_inf == pytest.approx(ending.time, rel=0.04, abs=math.tau / scene.speed)  # type: ignore[union-attr]
    assert found.level == pytest.approx(ending.level, abs=0.2)  # type: ignore[union-attr]
