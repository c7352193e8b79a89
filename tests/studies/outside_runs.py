"""Runs of a sized machine by the outside equations: its numbers from its file and the result of `abu size`, its starts,
and when a run keeps what a PASS promises.

Nothing is imported from the product. What counts as quiet, as settled and as balanced is written here anew from the
README and `abu explain`. Quiet: no further revolution is louder than the limit and than the machine without balls.
Settled: |U(t)| within the mean of the end and a tenth of the imbalance. Balanced: no ball moves on against its race.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from tests.studies.outside_equations import Machine, run, workspace

GRAVITY: Final = 9.80665
STEPS, COARSE = 208, 48
"""In a revolution; multiples of 16. A coarse run that comes near a limit is repeated."""
NEAR, NEAR_DB = 0.85, 1.0
"""Shares of a limit, and dB below one, from which a run is near it."""
CALM_DB = 1.5
"""So far below the limit and the level without balls a run is calm."""

HANDS: Final = {
    "x": ((0.4129, 0.0736, 0.0163, 0.0100), (400.0, 200.0, 4000.0, 8000.0), (20.0, 100.0, 144.6, 79.9)),
    "z": ((1.1252, 0.0769, 0.0200, 0.0100), (1000.0, 12000.0, 43635.0, 174542.0), (111.5, 39.3, 86.8, 121.0)),
}
"""One hand, ISO 10068:2012, annex C, model 2, table C.1: masses [kg], stiffness [N/m], damping [N·s/m]."""

Json = Mapping[str, Any]


@dataclass(frozen=True)
class Start:
    """One way of switching on: `kind` in words, ball angles [rad] and speeds [rad/s] in space, rotor angle [rad]."""

    kind: str
    machine: Machine
    angles: tuple[float, ...]
    speeds: tuple[float, ...]
    rotor: float = 0.0
    full: float = 0.0
    of_file: Machine | None = None
    """The machine as its file has it, by which the run is judged; None: that which runs."""


@dataclass(frozen=True)
class Ending:
    """What a run came to. `time` until it settled and `quiet` until it was quiet [s], from full speed on, infinite:
    never. `left` in shares of what is allowed.
    """

    time: float
    quiet: float
    level: float
    slip: float
    left: float
    modulus: float


def hands(mass: float) -> tuple[np.ndarray[Any, Any], ...]:
    """Masses, stiffness and damping of a machine in two hands: x, y, palms x, y, fingers x, y."""
    M, K, C = np.zeros(6), np.zeros((6, 6)), np.zeros((6, 6))
    ways = np.array(((0, 1, 0), (0, -1, 1), (1, -1, 0), (1, 0, -1)), dtype=float)
    for axis, name in enumerate("xz"):
        masses, stiffness, damping = HANDS[name]
        nodes = [axis, 2 + axis, 4 + axis]
        M[nodes] = mass + 2 * (masses[2] + masses[3]), 2 * masses[0], 2 * masses[1]
        for way, k, c in zip(ways, stiffness, damping, strict=True):
            K[np.ix_(nodes, nodes)] += 2 * k * np.outer(way, way)
            C[np.ix_(nodes, nodes)] += 2 * c * np.outer(way, way)
    return M, K, C


def machine_of(file: Json, result: Json, *, on_arm: bool = False) -> Machine:
    """The numbers of a machine and its autobalancer; on its suspension, or on its arm."""
    top, table, balls = file["machine"], file["autobalancer"], result["autobalancer"]
    wheel, count = file["wheel"]["mass_kg"], balls["ball_count"]
    bare, ball = top["mass_kg"] + wheel, balls["ball_mass_g"] / 1e3
    housing = balls["mass_g"] / 1e3 - count * ball
    pitch, radius = balls["pitch_radius_mm"] / 1e3, balls["ball_diameter_mm"] / 2e3
    at = top.get("center_of_mass_to_wheel_mm", 0.0) / 1e3
    race = at + table.get("plane_offset_mm", 0.0) / 1e3
    held = _held(file, bare, housing, race) if not on_arm else _on_arm(file["swing_arm"], housing)
    handles = [entry["from_center_of_mass_mm"] / 1e3 for entry in top.get("handle", ())]
    imbalance, motor = result["imbalance_g_mm"] / 1e6, file.get("motor", {})
    core = 1 if on_arm else len(held[0])
    speed = top["speed_rpm"] * math.tau / 60
    rigid = core == 4
    inertia = top["transverse_inertia_kg_m2"] if rigid else math.inf
    felt = [1 / bare + race * place / inertia for place in (at, race)]
    return Machine(
        core=core, arm=file["swing_arm"]["arm_length_mm"] / 1e3 if on_arm else 0.0,
        mass=held[0], stiffness=held[1], damping=held[2], nodes=held[3],
        felt=1 / felt[1] if not on_arm else float(held[0][0, 0]) / (file["swing_arm"]["arm_length_mm"] / 1e3) ** 2,
        wheel=at if rigid else 0.0, race=race if rigid else 0.0,
        places=np.array(handles or [at]) if rigid else np.zeros(1),
        imbalance=imbalance, carried=imbalance * felt[0] / felt[1], balls=count, ball_mass=ball, pitch=pitch,
        ball_radius=radius, rolling=0.4, drag=table["rolling_drag_per_s"],
        friction=table["rolling_friction_mm"] / 1e3 / radius,
        gravity=GRAVITY if top["spindle_axis"] == "horizontal" else 0.0,
        offset=table["race_eccentricity_mm"] / 1e3, offset_angle=math.pi,
        gap=2 * math.asin(radius / pitch), restitution=0.5, speed=speed, ramp=0.0,
        stall=0.0, no_load=motor.get("no_load_speed_rpm", 0.0) * math.tau / 60,
        inertia=motor.get("rotor_inertia_kg_m2", 0.0), longest=_longest(held), housing=housing,
    )  # fmt: skip


Held = tuple[np.ndarray[Any, Any], np.ndarray[Any, Any], np.ndarray[Any, Any], np.ndarray[Any, Any]]


def _held(file: Json, bare: float, housing: float, race: float) -> Held:
    """Mass matrix, stiffness, damping and further nodes on springs or in hands, the housing of the balls in the race's
    plane. A rigid body is held so that it moves and tilts alike.
    """
    top, suspension = file["machine"], file["suspension"]
    if "transverse_inertia_kg_m2" not in top:
        if suspension["model"] == "hands":
            M, K, C = hands(bare + housing)
            return np.diag(M[:2]), K, C, M[2:].copy()
        own = np.array((bare, bare))
        mass = np.diag(own + housing)
    else:
        J = top["transverse_inertia_kg_m2"]
        own = np.array((bare, bare, J, J))
        to_race = np.array(((1, 0, race, 0), (0, 1, 0, race)), dtype=float)
        mass = np.diag(own) + housing * to_race.T @ to_race
        if suspension["model"] == "hands":
            return _rigid_in_hands(file, mass)
    hertz, damping = (
        np.resize(np.array(suspension[key], dtype=float), len(own))
        for key in ("natural_frequencies_hz", "damping_ratios")
    )
    natural = math.tau * hertz
    return mass, np.diag(own * natural**2), np.diag(2 * damping * own * natural), np.zeros(0)


def _rigid_in_hands(file: Json, mass: np.ndarray[Any, Any]) -> Held:
    """Both hands hold the plane of the wheel, as those of the product do: no standard says how hands resist tilt."""
    M, K, C = hands(0.0)
    at = file["machine"]["center_of_mass_to_wheel_mm"] / 1e3
    place = np.zeros((6, 8))
    place[:2, :4] = ((1, 0, at, 0), (0, 1, 0, at))
    place[2:, 4:] = np.eye(4)
    skin = place[:2, :4].T @ np.diag(M[:2]) @ place[:2, :4]
    return mass + skin, place.T @ K @ place, place.T @ C @ place, M[2:].copy()


def _on_arm(table: Json, housing: float) -> Held:
    """An arm that turns: J_O with the housing, (c, b) l²; no contact."""
    square = (table["arm_length_mm"] / 1e3) ** 2
    each = (
        table["moment_of_inertia_kg_m2"] + housing * square, table["joint_stiffness_N_per_m"] * square,
        table["joint_damping_N_s_per_m"] * square,
    )  # fmt: skip
    mass, stiffness, damping = (np.array([[one]]) for one in each)
    return mass, stiffness, damping, np.zeros(0)


def _longest(held: Held) -> float:
    """Half a time constant of the fastest free motion."""
    mass, stiffness, damping, nodes = held
    size = len(stiffness)
    whole = np.eye(size)
    whole[: len(mass), : len(mass)] = mass
    whole[range(len(mass), size), range(len(mass), size)] = nodes
    inverse = np.linalg.inv(whole)
    motion = np.block([[np.zeros((size, size)), np.eye(size)], [-inverse @ stiffness, -inverse @ damping]])
    return float(0.5 / max(np.abs(np.linalg.eigvals(motion)).max(), 1.0))


def starts(file: Json, result: Json, seed: int, random: int = 50, run_ups: int = 20) -> Iterator[Start]:
    """Balls anywhere, turning with the race or not, and run-ups; on arms every other start on the arm itself."""
    rng = np.random.default_rng(10_000 + seed)
    on_springs = machine_of(file, result)
    on_arm = machine_of(file, result, on_arm=True) if "swing_arm" in file else on_springs
    for k in range(random + run_ups):
        machine = on_arm if k % 2 else on_springs
        words = "arm, " if machine.arm else ""
        machine = machine._replace(offset_angle=float(rng.choice([0.0, math.pi])), speed=_speed(file, result, rng))
        if k < random:
            yield _anywhere(machine, "motor" in file, words, rng)
        else:
            yield _run_up(machine, "motor" in file, words, rng)


def band_starts(
    file: Json, result: Json, seed: int, promised: int = 80, usual: int = 40
) -> Iterator[tuple[Start, bool]]:
    """Machines within the band, half of the starts with the balls together; and whether all of it is promised.

    Promised: the race's eccentricity from none to the file's at any angle, 0.1 … 1 of the imbalance, any position of a
    machine in the hands. Usual, too: oil from hot to cold, friction, speed, suspension, mass of the balls, run-ups,
    and an imbalance from a measured level up to `capacity_margin` times it.
    """
    rng, of_file = np.random.default_rng(20_000 + seed), machine_of(file, result)
    top, suspension = file["machine"], file["suspension"]
    any_way = suspension["model"] == "hands" or max(suspension["natural_frequencies_hz"]) <= 8
    for k in range(promised + usual):
        is_usual = k >= promised
        share = rng.uniform(0.1, 1) if rng.random() < 0.6 else 1.0
        turned = any_way and rng.random() < 0.5
        gravity = GRAVITY if (top["spindle_axis"] == "horizontal") != turned else 0.0
        machine = of_file._replace(
            offset=of_file.offset * rng.uniform(), offset_angle=float(rng.uniform(0, math.tau)), gravity=gravity,
            imbalance=share * of_file.imbalance, carried=share * of_file.carried, speed=_speed(file, result, rng),
        )  # fmt: skip
        if is_usual:
            stiffer = rng.uniform(0.7, 1.3) if suspension["model"] == "springs" else 1.0
            margin = file["autobalancer"].get("capacity_margin", 1.2)
            more = rng.uniform(1, margin) if share == 1 and "measured_level_db" in file["wheel"] else 1.0
            machine = machine._replace(
                drag=machine.drag * math.exp(rng.uniform(-1, 1) * math.log(3)),
                friction=machine.friction * math.exp(rng.uniform(math.log(0.3), math.log(2))),
                ball_mass=machine.ball_mass * rng.uniform(0.995, 1.005),
                imbalance=machine.imbalance * more, carried=machine.carried * more,
                stiffness=machine.stiffness * stiffer**2, damping=machine.damping * stiffer,
                speed=machine.speed * (1.0 if "motor" in file else rng.uniform(0.95, 1.05)),
            )  # fmt: skip
        if rng.random() < 0.15:
            start = _run_up(machine, "motor" in file, "", rng)
            if not is_usual and not start.machine.stall:
                own = file.get("run_up", {}).get("time_s", 1.0)
                start = replace(start, machine=start.machine._replace(ramp=own), full=own, kind="run-up of the file")
        else:
            start = _anywhere(machine, "motor" in file, "", rng)
            if not is_usual:
                turning = float(rng.choice([0.0, 1.0, 1.0]))
                speeds = (turning * machine.speed,) * machine.balls
                start = replace(start, speeds=speeds, kind=f"anywhere, turning at {turning:.2f}")
            if rng.random() < 0.5:
                middle = rng.uniform(0, math.tau)
                together = tuple(middle + (j - (machine.balls - 1) / 2) * machine.gap * 1.0001
                                 for j in range(machine.balls))  # fmt: skip
                start = replace(start, angles=together, kind=f"together, {start.kind}")
        yield replace(start, of_file=of_file._replace(gravity=gravity)), not is_usual


def _speed(file: Json, result: Json, rng: np.random.Generator) -> float:
    """The rated one, an idle speed of a motor; of two speeds either, of a range any."""
    top = file["machine"]
    if "motor" in file:
        return float(result["idle_speed_rpm"]) * math.tau / 60
    low, high = top.get("speed_range_rpm", (top["speed_rpm"],) * 2)
    # A range below 0.7 of its top is that of two gears.
    rpm = rng.uniform(low, high) if low >= 0.7 * high else rng.choice([low, high])
    return float(rpm) * math.tau / 60


def _anywhere(machine: Machine, motor: bool, words: str, rng: np.random.Generator) -> Start:
    n, span = machine.balls, machine.gap * 1.001
    gaps = rng.dirichlet(np.ones(n)) * (math.tau - n * span)
    angles = rng.uniform(0, math.tau) + np.cumsum(gaps + span)
    turning = 1 + float(rng.choice([0.0, -1.0, -rng.uniform()]))
    if motor:
        machine = machine._replace(stall=1.0)
    return Start(f"{words}anywhere, turning at {turning:.2f}", machine, tuple(angles), (turning * machine.speed,) * n)


def _run_up(machine: Machine, motor: bool, words: str, rng: np.random.Generator) -> Start:
    """From rest, the balls touching: at the bottom of a horizontal race, anywhere in a vertical one."""
    n, ramp = machine.balls, float(np.exp(rng.uniform(math.log(0.3), math.log(8))))
    middle = -math.pi / 2 if machine.gravity else rng.uniform(0, math.tau)
    angles = tuple(middle + (k - (n - 1) / 2) * machine.gap * 1.0001 for k in range(n))
    rotor = float(rng.uniform(0, math.tau))
    machine = machine._replace(stall=1.0) if motor else machine._replace(ramp=ramp)
    return Start(f"{words}run-up in {ramp:.2f} s", machine, angles, (0.0,) * n, rotor, -1.0 if motor else ramp)


def with_motor(start: Start, file: Json) -> Start:
    """The start with the torque of the file's motor, at full speed after five of its time constants J Ω₀/M."""
    if not start.machine.stall:
        return start
    torque = file["motor"]["stall_torque_N_m"]
    machine = start.machine._replace(stall=torque)
    full = 5 * machine.inertia * machine.no_load / torque if start.full else 0.0
    return replace(start, machine=machine, full=full)


def ended(
    start: Start, result: Json, limit: float, loudest: float = -1e3, steps: int = STEPS, longest: float = 3.0,
    least: float = 0.2, permitted: float = math.inf, *, calm: bool = False,
) -> Ending:  # fmt: skip
    """Run a start; `least`, `longest`: quiet times permitted (`limit` [s]) that are waited at least and at most.

    `calm`: a run that is quiet by 1.5 dB and grows no louder ends, though its balls still creep.

    `permitted` [dB]: the limit of the level. `loudest` [dB]: a level that falls below it need not be followed to its
    end.
    """
    p, n, of_file = start.machine, start.machine.balls, start.of_file or start.machine
    nq = len(p.stiffness)
    y = np.zeros(2 * (nq + 1 + n))
    v = nq + 1 + n
    y[nq], y[nq + 1 : v], y[v + nq + 1 :] = start.rotor, start.angles, start.speeds
    from_rest = start.full > 0
    y[v + nq] = 0.0 if from_rest else p.speed
    order = np.argsort(np.mod(y[nq + 1 : v], math.tau))
    y[nq + 1 : v] = np.mod(y[nq + 1 : v], math.tau)
    most = start.full + longest * limit
    turns = int(longest * limit * p.speed * 1.2 / math.tau) + 80
    moduli, times = np.zeros(16 * turns), np.zeros(16 * turns)
    means = np.zeros((turns, 2))
    squares, sums = np.zeros((turns, len(p.places), 2)), np.zeros((2, turns, len(p.places), 2))
    angles, slipped = np.zeros((turns, n)), np.zeros((turns, n))
    most = max(most, start.full + 60 * math.tau / p.speed)
    most_quiet = min(5e-8 * 10 ** (permitted / 20), without_balls(of_file._replace(speed=p.speed)))
    quiet = (5e-8 * 10 ** ((loudest - 0.5) / 20)) ** 2, (most_quiet * 10 ** (-CALM_DB / 20)) ** 2 if calm else 0.0
    span = (start.full, least * limit, most, 0.2 * limit)
    samples, revs, _ = run(
        p, y, order, span, quiet, steps, workspace(p), moduli, times, means, squares, sums, angles, slipped
    )
    loud = turn_velocities(squares[:revs], *sums[:, :revs]) > most_quiet
    quiet_from = quiet_time(loud, times[15:samples:16], start.full)
    seen = moduli[:samples], times[:samples], squares[:revs], angles[:revs]
    ending = judged(of_file, result, start.full, *seen, quiet_from)
    if p.friction > of_file.friction and quiet_from <= limit:
        # With more friction than the file has balls leave more: then a quiet machine counts as balanced.
        return replace(ending, left=min(ending.left, NEAR))
    return ending


def without_balls(p: Machine) -> float:
    """Rms velocity [m/s] of the machine without an autobalancer, of its loudest axis at its loudest place.

    (K + iΩC − Ω²M) q = Ω² U at the wheel, M without the housing. On an arm Ω² U l turns it.
    """
    size, mass = len(p.stiffness), np.zeros_like(p.stiffness)
    axes = ((0,),) if p.arm else ((0, 2), (1, 3)) if p.core == 4 else ((0,), (1,))
    held = p.mass.copy()
    for axis in axes:
        way = np.zeros(p.core)
        way[list(axis)] = (p.arm,) if p.arm else (1.0, p.race)[: len(axis)]
        held -= p.housing * np.outer(way, way)
    mass[: p.core, : p.core] = held
    mass[range(p.core, size), range(p.core, size)] = p.nodes
    dynamic = p.stiffness + 1j * p.speed * p.damping - p.speed**2 * mass
    largest = 0.0
    for axis in axes:
        force = np.zeros(size, dtype=complex)
        force[list(axis)] = (p.arm,) if p.arm else (1.0, p.wheel)[: len(axis)]
        moved = np.linalg.solve(dynamic, p.imbalance * p.speed**2 * force)
        for place in p.places:
            way = (p.arm,) if p.arm else (1.0, place)[: len(axis)]
            largest = max(largest, abs(sum(w * moved[k] for w, k in zip(way, axis, strict=True))))
    return largest * p.speed / math.sqrt(2)


def turn_velocities(squares: Any, sums: Any, moments: Any) -> Any:
    """Rms velocity [m/s] of each revolution of 16 samples, its mean and its trend taken off: loudest axis and place.

    The trend is that from the mean of the revolution before to that of the one after; `moments`: Σ v (k − 7.5).
    """
    mean = sums / 16
    slope = np.gradient(mean, axis=0) / 16 if len(mean) > 1 else 0 * mean
    variance = squares / 16 - mean**2 - 2 * slope * moments / 16 + slope**2 * (16**2 - 1) / 12
    return np.sqrt(np.maximum(variance, 0.0).max(axis=(1, 2)))


def quiet_time(loud: Any, ends: Any, full: float) -> float:
    """End of the last loud revolution [s] from full speed on; infinite in the last 5 % of the run."""
    last = np.flatnonzero(loud)
    if not len(last):
        return 0.0
    time, whole = float(ends[last[-1]] - full), float(ends[-1] - full)
    return math.inf if time > 0.95 * whole else time


def judged(
    p: Machine, result: Json, full: float, moduli: Any, times: Any, squares: Any, angles: Any, quiet: float
) -> Ending:
    """Settling, level, slip and what is left over what is allowed, of the samples of a run."""
    moment = p.balls * p.ball_mass * p.pitch
    last = min(len(squares), max(10, len(squares) // 20))
    final = float(moduli[-16 * last :].mean())
    above = np.flatnonzero(moduli > final + 0.1 * max(p.carried, 0.01 * moment))
    late = len(above) and (above[-1] == len(moduli) - 1 or times[above[-1]] > full + 0.95 * (times[-1] - full))
    time = math.inf if late else float(times[above[-1]] - full) if len(above) else 0.0
    rms = math.sqrt(float((squares[-last:].sum(axis=0) / (16 * last)).max()))
    back = angles[-1 - min(last, len(angles) - 1)]
    slip = float(np.abs(angles[-1] - back).max()) / (math.tau * last)
    left = final / allowed(p, result)
    return Ending(time, quiet, 20 * math.log10(max(rms, 1e-12) / 5e-8), slip, left, final)


def allowed(p: Machine, result: Json) -> float:
    """Imbalance [kg m] that may be left: a tenth of it, what the eccentricity asks for, and what friction holds.

    Friction at its worst, as on a vertical spindle, counts up to half the imbalance.
    """
    budget, mass = result["accuracy_budget"], result["effective_mass_kg"]
    if p.arm:
        mass = float(p.mass[0, 0]) / p.arm**2
    moment = p.balls * p.ball_mass * p.pitch
    tenth = 0.1 * max(p.carried, 0.01 * moment) + mass * p.offset
    fan, worst = (mass * budget[key] / 1e6 for key in ("rolling_friction_um", "rolling_friction_vertical_um"))
    return max(tenth + fan, min(tenth + worst, 0.5 * p.carried))


def quiet_limit(limits: Json) -> float:
    """Longest quiet time permitted [s], by whichever of its names."""
    return float(limits.get("quiet_time_s", limits.get("settling_time_s", 1.0)))


def coarse_run(start: Start, result: Json, limits: Json) -> Ending:
    """Run a start in coarse steps until it is calm or at rest."""
    level = limits["vibration_level_db"]
    return ended(start, result, quiet_limit(limits), level, COARSE, permitted=level, calm=True)


def fine_run(start: Start, result: Json, limits: Json) -> Ending:
    """Run a start in fine steps; if it breaks a limit, again to its end: a vibration may still have been dying out."""
    limit, level = quiet_limit(limits), limits["vibration_level_db"]
    ending = ended(start, result, limit, level, permitted=level)
    return ended(start, result, limit, least=2.9, permitted=level) if broken(ending, limits) else ending


def near(start: Start, ending: Ending, limits: Json) -> bool:
    """Whether a run comes near a limit or breaks one."""
    level, machine = limits["vibration_level_db"], start.of_file or start.machine
    without = 20 * math.log10(without_balls(machine._replace(speed=start.machine.speed)) / 5e-8)
    return (
        ending.slip > NEAR * 0.05 or ending.left > NEAR or ending.quiet > NEAR * quiet_limit(limits)
        or ending.level > min(level, without) - NEAR_DB
    )  # fmt: skip


def broken(ending: Ending, limits: Json) -> str:
    """Which limits a run breaks, in words; empty: none."""
    words = []
    if ending.slip > 0.05:
        words.append("stalls")
    elif ending.left > 1:
        words.append("does not balance")
    if ending.quiet > quiet_limit(limits):
        words.append("late")
    if ending.level > limits["vibration_level_db"]:
        words.append("loud")
    return ", ".join(words)
