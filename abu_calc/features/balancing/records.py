"""Parts of the result of `abu balance`, in user units."""

from typing import Annotated, ClassVar

from abu_calc.foundation.quantity import Quantity, Record, record

Complex = tuple[float, float]


@record
class SensorReading(Record):
    """Reading of a sensor, in the unit of the run."""

    name: Annotated[str, Quantity("sensor")]
    amplitude: Annotated[float, Quantity("amplitude", "A_j", 5, "in the unit of the run")]
    phase_deg: Annotated[float | None, Quantity("phase", "ψ_j", 5, "by the convention of the run, −180 … 180")]


@record
class RunReadings(Record):
    """A run as it was taken; of a recorded one the data of its marks."""

    optional: ClassVar[frozenset[str]] = frozenset({"left", "right"})

    speed_rpm: Annotated[float, Quantity("speed", "Ω", 6)]
    quantity: Annotated[str, Quantity("quantity", "", 4, "displacement, velocity or acceleration")]
    unit: Annotated[str, Quantity("unit of amplitudes", "", 4, "0–peak if it names no kind of amplitude")]
    phase: Annotated[str | None, Quantity("phases", "", 4, "lag: A·cos(ωt − phase), lead: A·cos(ωt + phase)")]
    left: SensorReading | None
    right: SensorReading | None
    sensors: tuple[SensorReading, ...]
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

    optional: ClassVar[frozenset[str]] = frozenset({"depth_mm", "weights_g"})

    action: Annotated[str, Quantity("to do", "", 4, "remove or add")]
    mass_g: Annotated[float, Quantity("mass", "", 4, "at the correction radius")]
    angle_deg: Annotated[float, Quantity("at", "", 5, "by the angle marks of the rotor")]
    depth_mm: Annotated[float | None, Quantity("depth of the hole", "", 3, "to the tip of the drill")] = None
    weights_g: Annotated[tuple[float, ...] | None, Quantity("weights in stock", "", 4)] = None


@record
class PlaneCorrection(Record):
    """One plane: its heavy spot and its correction. Angles count from the zero mark, 0 … 360."""

    mass_g: Annotated[float, Quantity("mass of the heavy spot", "m_j", 4, "at the correction radius")]
    angle_deg: Annotated[float, Quantity("heavy spot at", "φ_j", 5, "from the zero mark, against rotation")]
    mass_uncertainty_g: Annotated[float, Quantity("uncertainty of the mass", "", 2, "one standard deviation")]
    angle_uncertainty_deg: Annotated[
        float, Quantity("uncertainty of the angle", "", 2, "one standard deviation; 180: not known")
    ]
    remove_at_deg: Annotated[float, Quantity("remove at", "", 5, "the heavy spot by the angle marks of the rotor")]
    add_at_deg: Annotated[float, Quantity("or add at", "", 5, "opposite, by the angle marks of the rotor")]
    corrections: tuple[Share, ...]
    """Corrections to make, by the metal and the places there are."""
    imbalance_g_mm: Annotated[float, Quantity("imbalance", "|Q|", 4, "that the correction takes away")]
    permitted_g_mm: Annotated[
        float | None, Quantity("permitted imbalance", "U_per", 4, "of the tolerance plane on this side")
    ]
    rest_g_mm: Annotated[float, Quantity("imbalance to be expected after it", "", 2, "rms over the errors")]
    rest_at_most_g_mm: Annotated[
        float, Quantity("imbalance after it, at most", "", 2, "twice that: exceeded less than once in twenty")
    ]
    leftover_g_mm: Annotated[
        float, Quantity("imbalance that limits or stock leave", "", 2, "without any errors; part of the expected one")
    ]
    printed_mass_g: Annotated[float | None, Quantity("mass by the published formula", "", 4, "readings not converted")]
    printed_angle_deg: Annotated[float | None, Quantity("angle by the published formula", "", 5)]


@record
class SensorVerification(Record):
    """Readings of a sensor, in the unit of the run."""

    name: Annotated[str, Quantity("sensor")]
    before: Annotated[float, Quantity("as measured", "", 4)]
    after: Annotated[float, Quantity("predicted", "", 3, "without errors")]
    expected: Annotated[float, Quantity("expected", "", 2, "rms over the errors")]
    at_most: Annotated[float, Quantity("at most", "", 2, "twice the rms errors: exceeded less than once in twenty")]


@record
class Predicted(Record):
    """Reading of a sensor at a speed, measured and predicted after the correction, in the unit of the run."""

    sensor: Annotated[str, Quantity("sensor")]
    speed_rpm: Annotated[float, Quantity("speed", "Ω", 6)]
    measured: Annotated[float, Quantity("measured", "|X_s|", 4, "without trial masses")]
    after: Annotated[float, Quantity("predicted after the correction", "", 3, "without errors")]
    unit: Annotated[str, Quantity("unit of amplitudes")]


@record
class Verification(Record):
    """The run after the correction, as it is to be expected at the speed of a run, in its unit."""

    optional: ClassVar[frozenset[str]] = frozenset(
        f"{side}_{what}" for side in ("left", "right") for what in ("before", "expected", "at_most")
    )

    speed_rpm: Annotated[float, Quantity("speed", "Ω", 6)]
    quantity: Annotated[str, Quantity("quantity")]
    unit: Annotated[str, Quantity("unit of amplitudes")]
    left_before: Annotated[float | None, Quantity("left, as it is", "", 4)]
    right_before: Annotated[float | None, Quantity("right, as it is", "", 4)]
    left_expected: Annotated[float | None, Quantity("left, expected", "", 2, "rms over the errors")]
    right_expected: Annotated[float | None, Quantity("right, expected", "", 2, "rms over the errors")]
    left_at_most: Annotated[
        float | None, Quantity("left, at most", "", 2, "twice that: exceeded less than once in twenty")
    ]
    right_at_most: Annotated[float | None, Quantity("right, at most", "", 2, "likewise")]
    sensors: tuple[SensorVerification, ...]


@record
class ToleranceResult(Record):
    """Permitted residual imbalance and the imbalance of each tolerance plane; null for the planes there are not."""

    optional: ClassVar[frozenset[str]] = frozenset(
        {"left_g_mm", "right_g_mm", "left_now_g_mm", "right_now_g_mm", "left_rest_g_mm", "right_rest_g_mm",
         "single_plane_g_mm", "single_plane_now_g_mm", "single_plane_rest_g_mm"}
    )  # fmt: skip

    planes: Annotated[str, Quantity("tolerance planes", "", 4, "bearing planes, or correction planes")]
    rule: Annotated[str, Quantity("rule")]
    whole_g_mm: Annotated[float, Quantity("permitted imbalance of the rotor", "U_per", 4)]
    left_g_mm: Annotated[float | None, Quantity("left, permitted", "U_A", 4)] = None
    right_g_mm: Annotated[float | None, Quantity("right, permitted", "U_B", 4)] = None
    left_now_g_mm: Annotated[float | None, Quantity("left, now", "", 4)] = None
    right_now_g_mm: Annotated[float | None, Quantity("right, now", "", 4)] = None
    left_rest_g_mm: Annotated[float | None, Quantity("left, expected", "", 2, "rms over the errors")] = None
    right_rest_g_mm: Annotated[float | None, Quantity("right, expected", "", 2, "rms over the errors")] = None
    single_plane_g_mm: Annotated[float | None, Quantity("permitted", "U_per", 4)] = None
    single_plane_now_g_mm: Annotated[float | None, Quantity("now", "", 4)] = None
    single_plane_rest_g_mm: Annotated[float | None, Quantity("expected", "", 2, "rms over the errors")] = None


@record
class TrialMassResult(Record):
    """Trial mass proposed for a plane, for the next time."""

    plane: Annotated[str, Quantity("plane")]
    mass_g: Annotated[float, Quantity("trial mass", "", 3)]
    safe_g: Annotated[float, Quantity("largest safe one", "", 3, "a tenth of the bearing load")]
    visible_g: Annotated[float | None, Quantity("least visible one", "", 3, "changes a reading by 30 %")]
    force_percent: Annotated[float, Quantity("centrifugal force", "", 2, "of the bearing load")]


@record
class ResidualCheck(Record):
    """Residual after the correction, by the errors of readings, rig and correction."""

    permitted_g_mm: Annotated[float | None, Quantity("permitted imbalance of the roll", "U_per", 4)]
    rest_share: Annotated[float, Quantity("vibration expected to be left", "", 2, "of that before, rms", percent=True)]
    reproduced: Annotated[
        float, Quantity("misfit of the runs", "", 2, "largest, of the answer put back, over the largest reading")
    ]
    disagreement: Annotated[float | None, Quantity("misfit in standard deviations", "", 2)]
    planes_share: Annotated[
        float | None,
        Quantity("vibration that the planes leave", "", 2, "of that before; more sensors than planes", percent=True),
    ]
    minimised: Annotated[
        str | None, Quantity("quantity whose sum of squares is the least", "", 4, "if something remains")
    ]
    verification: tuple[Verification, ...]
    """Verifications for each speed and quantity of the runs."""


@record
class ErrorShare(Record):
    """Share of one cause in the uncertainty; null for the planes there are not."""

    optional: ClassVar[frozenset[str]] = frozenset({"left_percent", "right_percent", "single_plane_percent"})

    cause: Annotated[str, Quantity("cause")]
    left_percent: Annotated[
        float | None, Quantity("left", "", 2, "of the left imbalance, one standard deviation, %")
    ] = None
    right_percent: Annotated[float | None, Quantity("right", "", 2, "of the right imbalance, %")] = None
    single_plane_percent: Annotated[float | None, Quantity("single plane", "", 2, "of its imbalance, %")] = None


@record
class BalanceModel(Record):
    """Numbers of the balancing in SI; complex numbers as real and imaginary part, imbalances q·R·e^{−iφ}."""

    method: str
    speeds_rad_per_s: tuple[float, ...]
    displacements_m: tuple[tuple[Complex, ...], ...]
    placed_kg_m: tuple[tuple[Complex, ...], ...]
    imbalances_kg_m: tuple[Complex, ...]
    influence_m_per_kg_m: tuple[tuple[Complex, ...], ...]
    natural_frequencies_rad_per_s: tuple[float, float] | None
    support_damping_N_s_per_m: tuple[float, float] | None
    service_speed_rad_per_s: float
