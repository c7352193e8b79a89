"""A roll on a rig, simulated by Lagrange's equations of our own: place of the centre of mass and tilt as coordinates.

Everything goes as in the workshop: the mark is painted on the roll, heavy spots are so many degrees behind it, the roll
turns counterclockwise, the sensors look along angle 0, the mark's sensor stands `sensor` degrees on in the sense of
rotation, and time begins when the mark passes that one.
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Simulated:
    """Masses [kg], stiffnesses [N/m], damping of supports [N s/m], lengths [m]; planes at −b and c, supports at −(a+b)
    and c+d from the centre of mass.
    """

    M1: float = 18.0
    M2: float = 21.0
    C1: float = 3e5
    C2: float = 3.6e5
    M3: float = 64.0
    J3: float = 9.5
    a: float = 0.15
    b: float = 0.52
    c: float = 0.61
    d: float = 0.20
    damping: tuple[float, float] = (0.0, 0.0)
    radii: tuple[float, float] = (0.12, 0.15)

    @property
    def supports(self) -> np.ndarray:
        """Rows: how both supports move with centre and tilt."""
        return np.array([[1.0, -(self.a + self.b)], [1.0, self.c + self.d]])

    @property
    def matrices(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Mass, damping, stiffness by T = ½M₃y'² + ½J₃θ'² + Σ½M_j·x_j'², V = Σ½C_j·x_j²."""
        r = self.supports
        mass = np.diag([self.M3, self.J3]) + r.T @ np.diag([self.M1, self.M2]) @ r
        return mass, r.T @ np.diag(self.damping) @ r, r.T @ np.diag([self.C1, self.C2]) @ r

    def force(self, masses_g, angles_deg, sensor_deg=0.0) -> np.ndarray:
        """Generalised force over Ω², as the factor of e^{iΩt}: the heavy spot points at sensor + Ωt − angle."""
        pulls = [1e-3 * m * R * np.exp(1j * np.radians(sensor_deg - angle))
                 for m, R, angle in zip(masses_g, self.radii, angles_deg, strict=True)]  # fmt: skip
        return np.array([pulls[0] + pulls[1], -self.b * pulls[0] + self.c * pulls[1]])

    def motion(self, speed, masses_g, angles_deg, sensor_deg=0.0) -> np.ndarray:
        """Displacements of both supports [m], factors of e^{iΩt}."""
        mass, damping, stiffness = self.matrices
        stiff = stiffness + 1j * speed * damping - speed**2 * mass
        return self.supports @ np.linalg.solve(stiff, speed**2 * self.force(masses_g, angles_deg, sensor_deg))

    def natural_hz(self) -> list[float]:
        """By the eigenvalues of the undamped rig."""
        mass, _, stiffness = self.matrices
        return sorted(np.sqrt(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real) / (2 * np.pi))


UNITS = {"displacement": 1e3, "velocity": 1e3, "acceleration": 1.0}


def shown(motion: np.ndarray, quantity: str, speed: float) -> list[tuple[float, float]]:
    """Amplitude and phase of each sensor as an instrument shows them, in mm, mm/s or m/s²."""
    order = {"displacement": 0, "velocity": 1, "acceleration": 2}[quantity]
    values = motion * (1j * speed) ** order * UNITS[quantity]
    return [(float(abs(one)), float(-np.degrees(np.angle(one)))) for one in values]


@dataclass
class Workshop:
    """A roll with its imbalance (grams and degrees against rotation in both planes) on a rig, and how it is read."""

    rig: Simulated = field(default_factory=Simulated)
    masses: tuple[float, float] = (12.0, 7.0)
    angles: tuple[float, float] = (205.0, 320.0)
    speed_rpm: float = 3000.0
    quantity: str = "displacement"
    sensor_deg: float = 0.0
    noise: float = 0.0
    rng: np.random.Generator = field(default_factory=lambda: np.random.default_rng(1))

    @property
    def speed(self) -> float:
        return self.speed_rpm * np.pi / 30

    def vectors(self) -> np.ndarray:
        """Imbalances m·e^{−iφ} [g]."""
        return np.array([m * np.exp(-1j * np.radians(a)) for m, a in zip(self.masses, self.angles, strict=True)])

    def put_on(self, plane: int, mass_g: float, angle_deg: float) -> "Workshop":
        """The roll with a mass more (or, negative, less) in a plane."""
        found = self.vectors()
        found[plane] += mass_g * np.exp(-1j * np.radians(angle_deg))
        changed = Workshop(**vars(self))
        changed.masses = tuple(np.abs(found))
        changed.angles = tuple(-np.degrees(np.angle(found)))
        return changed

    def motion(self) -> np.ndarray:
        return self.rig.motion(self.speed, self.masses, self.angles, self.sensor_deg)

    def read(self) -> list[tuple[float, float]]:
        """What the instruments show, with noise: relative of the amplitude, and as much across it."""
        spoilt = self.motion()
        if self.noise:
            spoilt = spoilt * (1 + self.noise * (self.rng.standard_normal(2) + 1j * self.rng.standard_normal(2)))
        return shown(spoilt, self.quantity, self.speed)

    def run(self, trial: str = "") -> str:
        """As a [[run]] of a file."""
        (A, alpha), (B, beta) = self.read()
        return (
            f"[[run]]\nspeed_rpm = {self.speed_rpm!r}\nquantity = \"{self.quantity}\"\n"
            f"left = {{ amplitude = {A!r}, phase_deg = {alpha!r} }}\n"
            f"right = {{ amplitude = {B!r}, phase_deg = {beta!r} }}\n"
            f"sensor_to_mark_deg = {self.sensor_deg!r}\n{trial}\n"
        )  # fmt: skip


RIG = """\
[rig]
left_support_mass_kg = 18.0
right_support_mass_kg = 21.0
left_stiffness_N_per_m = 3.0e5
right_stiffness_N_per_m = 3.6e5
"""
ROTOR = """\
[rotor]
mass_kg = 64.0
transverse_inertia_kg_m2 = 9.5
left_end_to_left_plane_m = 0.15
left_plane_to_centre_m = 0.52
centre_to_right_plane_m = 0.61
right_plane_to_right_end_m = 0.20
left_correction_radius_mm = 120.0
right_correction_radius_mm = 150.0
"""
BARE_ROTOR = "[rotor]\nleft_correction_radius_mm = 120.0\nright_correction_radius_mm = 150.0\n"


def written(folder: Path, *parts: str, name: str = "readings.toml") -> str:
    """A file of these parts, by its name."""
    path = folder / name
    path.write_text("\n".join(parts), encoding="utf-8")
    return str(path)


def trial(plane: int, mass_g: float, angle_deg: float) -> str:
    """A key of a run."""
    name = ("left", "right")[plane]
    return f'trial = {{ plane = "{name}", mass_g = {mass_g!r}, angle_deg = {angle_deg!r} }}'


def turned(one: float, other: float) -> float:
    """Degrees from one angle to another, −180 … 180."""
    return (one - other + 180) % 360 - 180


DAMPING = (150.0, 150.0)


def recorded(
    shop: Workshop, seconds: float = 1.2, rate: float = 12_800.0, drift: float = 0.0, first_deg: float = 75.0
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time, displacements of both supports [m], and the angle of the mark past its sensor [rad], by integrating the
    equations of motion (Runge and Kutta, fourth order) from the steady state on; the speed drifts evenly.
    """
    mass, damping, stiffness = shop.rig.matrices
    inverse = np.linalg.inv(mass)
    pull = shop.rig.force(shop.masses, shop.angles, shop.sensor_deg)
    omega, rise = shop.speed * (1 - drift / 2), shop.speed * drift / seconds
    start = np.radians(first_deg)

    def angle(t):
        return start + omega * t + rise * t * t / 2

    def slope(t, state):
        speed = omega + rise * t
        turn = np.exp(1j * angle(t)) * (speed**2 - 1j * rise)
        force = (pull * turn).real
        return np.concatenate([state[2:], inverse @ (force - damping @ state[2:] - stiffness @ state[:2])])

    stiff = stiffness + 1j * omega * damping - omega**2 * mass
    steady = np.linalg.solve(stiff, omega**2 * pull) * np.exp(1j * start)
    state = np.concatenate([steady.real, (1j * omega * steady).real])
    h = 1 / rate
    times, places = np.arange(0, seconds, h), []
    for t in times:
        places.append(shop.rig.supports @ state[:2])
        k1 = slope(t, state)
        k2 = slope(t + h / 2, state + h / 2 * k1)
        k3 = slope(t + h / 2, state + h / 2 * k2)
        k4 = slope(t + h, state + h * k3)
        state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return times, np.array(places), angle(times)


def csv(folder: Path, columns: dict[str, np.ndarray], name: str = "run1.csv", sign: str = ",") -> None:
    """A record with a header."""
    rows = np.column_stack(list(columns.values()))
    body = "\n".join(sign.join(f"{value:.9g}" for value in row) for row in rows)
    (folder / name).write_text(sign.join(columns) + "\n" + body + "\n", encoding="utf-8")
