"""Parts of the result of `abu balance`, in user units."""

from typing import Annotated

from abu_calc.foundation.quantity import Quantity, Record, record

Complex = tuple[float, float]


@record
class SensorReading(Record):
    """Reading of a sensor, in the unit of the run's quantity."""

    amplitude: Annotated[float, Quantity("amplitude", "A_j", 5, "0–peak, in the unit of the run")]
    phase_deg: Annotated[float, Quantity("phase", "ψ_j", 5, "of A·cos(ωt − α), −180 … 180")]


@record
class RunReadings(Record):
    """A run as it was taken; of a recorded one what its marks tell."""

    speed_rpm: Annotated[float, Quantity("speed", "Ω", 6)]
    quantity: Annotated[str, Quantity("quantity", "", 4, "displacement, velocity or acceleration")]
    unit: Annotated[str, Quantity("unit of amplitudes")]
    left: SensorReading
    right: SensorReading
    file: Annotated[str | None, Quantity("recorded in")]
    sha256: Annotated[str | None, Quantity("SHA-256 of the record")]
    revolutions: Annotated[int | None, Quantity("revolutions evaluated")]
    mark_edge: Annotated[
        str | None, Quantity("passage of the mark by", "", 4, "leading, middle or trailing of a pulse")
    ]
    trials: Annotated[int, Quantity("known masses that were on")]


@record
class Share(Record):
    """A mass to remove or to add."""

    action: Annotated[str, Quantity("to do", "", 4, "remove or add")]
    mass_g: Annotated[float, Quantity("mass", "", 4)]
    angle_deg: Annotated[float, Quantity("at", "", 5, "from the zero mark, against rotation")]


@record
class PlaneCorrection(Record):
    """One plane: its heavy spot and what to do about it. Angles from the zero mark, AGAINST rotation, 0 … 360."""

    mass_g: Annotated[float, Quantity("mass of the heavy spot", "m_j", 4, "at the correction radius")]
    angle_deg: Annotated[float, Quantity("heavy spot at", "φ_j", 5, "from the zero mark, against rotation")]
    mass_uncertainty_g: Annotated[float, Quantity("uncertainty of the mass", "", 2, "one standard deviation")]
    angle_uncertainty_deg: Annotated[
        float, Quantity("uncertainty of the angle", "", 2, "one standard deviation; 180: not known")
    ]
    remove_at_deg: Annotated[float, Quantity("remove at", "", 5, "the heavy spot")]
    add_at_deg: Annotated[float, Quantity("or add at", "", 5, "opposite")]
    corrections: tuple[Share, ...]
    """Corrections to make, by the metal and the places there are."""
    imbalance_g_mm: Annotated[float, Quantity("imbalance", "|Q|", 4)]
    permitted_g_mm: Annotated[float | None, Quantity("permitted imbalance", "U_per", 4)]
    rest_g_mm: Annotated[float, Quantity("imbalance to be expected after it", "", 2, "rms over the errors")]
    printed_mass_g: Annotated[float | None, Quantity("mass by the published formula", "", 4, "readings not converted")]
    printed_angle_deg: Annotated[float | None, Quantity("angle by the published formula", "", 5)]


@record
class Verification(Record):
    """The run after the correction, as it is to be expected at the speed of a run, in the unit of its quantity."""

    speed_rpm: Annotated[float, Quantity("speed", "Ω", 6)]
    quantity: Annotated[str, Quantity("quantity")]
    unit: Annotated[str, Quantity("unit of amplitudes")]
    left_before: Annotated[float, Quantity("left, as it is", "", 4)]
    right_before: Annotated[float, Quantity("right, as it is", "", 4)]
    left_expected: Annotated[float, Quantity("left, expected", "", 2, "rms over the errors")]
    right_expected: Annotated[float, Quantity("right, expected", "", 2, "rms over the errors")]
    left_at_most: Annotated[float, Quantity("left, at most", "", 2, "twice that: exceeded less than once in twenty")]
    right_at_most: Annotated[float, Quantity("right, at most", "", 2, "likewise")]


@record
class ResidualCheck(Record):
    """Residual after the correction, by the errors of readings, rig and correction."""

    permitted_g_mm: Annotated[float | None, Quantity("permitted imbalance of the roll", "U_per", 4)]
    rest_share: Annotated[float, Quantity("vibration expected to be left", "", 2, "of that before, rms", percent=True)]
    reproduced: Annotated[
        float, Quantity("misfit of the runs", "", 2, "largest, of the answer put back, over the largest reading")
    ]
    disagreement: Annotated[float | None, Quantity("misfit in standard deviations", "", 2)]
    verification: tuple[Verification, ...]
    """Verifications for each speed and quantity of the runs."""


@record
class ErrorShare(Record):
    """Share of one cause in the uncertainty."""

    cause: Annotated[str, Quantity("cause")]
    left_percent: Annotated[float, Quantity("left", "", 2, "of the left imbalance, one standard deviation, %")]
    right_percent: Annotated[float, Quantity("right", "", 2, "of the right imbalance, %")]


@record
class BalanceModel(Record):
    """Numbers of the balancing in SI; complex numbers as real and imaginary part, imbalances q·R·e^{−iφ}."""

    method: str
    speeds_rad_per_s: tuple[float, ...]
    displacements_m: tuple[tuple[Complex, Complex], ...]
    placed_kg_m: tuple[tuple[Complex, Complex], ...]
    imbalances_kg_m: tuple[Complex, Complex]
    influence_m_per_kg_m: tuple[tuple[Complex, Complex], tuple[Complex, Complex]]
    natural_frequencies_rad_per_s: tuple[float, float] | None
    support_damping_N_s_per_m: tuple[float, float] | None
    service_speed_rad_per_s: float
