"""Parts of the result of `abu size`: candidates, budget, levels, section; SI in, user units out.

The section holds every length that its drawing shows, and the outlines.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Annotated, ClassVar, Self

from abu_calc.dynamics.stability.boundaries import StabilityBoundary
from abu_calc.features.design.region import Mode, TrueRegion
from abu_calc.features.grinding.outcomes import LoadedStarts
from abu_calc.features.grinding.steady_contact import LevelBound
from abu_calc.formulas.friction_band import friction_band, friction_number
from abu_calc.formulas.rigid_body import estimate_source
from abu_calc.foundation.quantity import LEVEL_AFTER, Quantity, Record, record
from abu_calc.inputs.autobalancer import Autobalancer as AutobalancerTable
from abu_calc.simulation.vibration_records import HandleLevels
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import WHEEL_PLANE
from abu_calc.sizing.design import Design, RaceDesign
from abu_calc.sizing.drawing_requirements import hardness_text
from abu_calc.sizing.handles import BodyBands
from abu_calc.sizing.housing import RULES
from abu_calc.sizing.manufacture.bearing_ring import ring_of
from abu_calc.sizing.manufacture.cover import seat_name
from abu_calc.sizing.manufacture.eccentricity import EccentricitySplit
from abu_calc.sizing.parts.demands import GROOVE_TOLERANCE, RACE_TOLERANCE
from abu_calc.sizing.parts.housing_parts import TurnedPart, drawn
from abu_calc.sizing.places import VibrationLevels as Levelled
from abu_calc.sizing.track import Track
from abu_calc.sizing.vibration import IdleSpeedLevels, LevelsUnderLoad, SpeedLevel, SpeedLevels, idle_vibration


@record
class Frequency(Record):
    """Region of the working speeds, by the simple rule and by the eigenvalues."""

    speed: Annotated[float, Quantity("rated speed", "Ω/2π", unit="hz")]
    natural_frequencies: Annotated[tuple[float, ...], Quantity("natural frequencies x, y", "ω/2π", unit="hz")]
    region: Annotated[str, Quantity("region")]
    balancing_possible: Annotated[bool, Quantity("balancing possible")]
    finite_mass_gap: Annotated[float, Quantity("finite-mass gap", "(2m/JM)^⅓", 3)]
    stable: Annotated[
        bool | None,
        Quantity("stable at idle", "", 4, "by eigenvalues, at the rated speed, in the least stable arrangement"),
    ]
    stability_boundaries_rpm: tuple[StabilityBoundary, ...] | None
    modes: tuple[Mode, ...]
    hanging_drag: Annotated[
        float | None,
        Quantity("drag rate above which no ball stalls", "", 4, "null: no drag rate is enough", unit="per_s"),
    ]

    @classmethod
    def of(cls, design: Design, region: TrueRegion) -> Self:
        """Record of a design."""
        return cls.read(
            design.frequency,
            region,
            region=design.frequency.region,
            stability_boundaries_rpm=region.boundaries,
            hanging_drag=region.hanging.largest,
        )


@record
class AutobalancerRecord(Record):
    """An autobalancer, chosen or a runner-up: its balls, race and housing, and the numbers that judge them."""

    schema_title: ClassVar[str] = "Autobalancer"

    ball_count: Annotated[int, Quantity("number of balls", "n")]
    ball_diameter: Annotated[float, Quantity("ball diameter", "2r", 5, unit="mm")]
    ball_mass: Annotated[float, Quantity("mass of one ball", "m", unit="g")]
    race_radius: Annotated[float, Quantity("race radius", "R", unit="mm")]
    pitch_radius: Annotated[float, Quantity("pitch radius", "R − r", unit="mm")]
    groove_radius: Annotated[float | None, Quantity("groove radius (± 0.2)", "R_g", unit="mm")]
    capacity: Annotated[float, Quantity("capacity, balls touching", "mR_p·sin nβ/sin β", unit="g_mm")]
    capacity_ratio: Annotated[float | None, Quantity("capacity over required capacity", "", 3)]
    outer_diameter: Annotated[float, Quantity("outer diameter", unit="mm")]
    width: Annotated[float, Quantity("width", unit="mm")]
    mass: Annotated[float, Quantity("mass with balls", unit="g")]
    mass_fraction: Annotated[float, Quantity("share of the machine's mass", "", 3, percent=True)]
    ball_force: Annotated[float, Quantity("force of one ball at top speed", "F", 3, unit="N")]
    contact_pressure: Annotated[float, Quantity("Hertz pressure", "p₀", unit="MPa")]
    hoop_stress: Annotated[float, Quantity("hoop stress", "ρ(ΩR_o)²", 3, unit="MPa")]
    optimum_drag: Annotated[float | None, Quantity("drag rate of the fastest decay", "2√(Jκ_s)", 3, unit="per_s")]
    slowest_decay: Annotated[
        float, Quantity("slowest decay rate of the balls", "", 3, "at the given drag rate", unit="per_s")
    ]
    carry_over: Annotated[float, Quantity("carry-over speed of the balls", "√(g/R_p)", 3, unit="rpm")]
    residual: Annotated[float | None, Quantity("expected residual (root of squares)", "", 3, unit="um")]
    corrector: Annotated[str, Quantity("kind of corrector")]
    ball_material: Annotated[str, Quantity("material of the balls")]
    housing: Annotated[str, Quantity("housing")]
    why_not: Annotated[str | None, Quantity("why it was not chosen")] = None

    optional: ClassVar[frozenset[str]] = frozenset({"why_not"})

    @classmethod
    def of(cls, table: AutobalancerTable, candidate: Candidate, race: Track, **given: object) -> Self:
        """Record of a candidate and its race; `table`: the file's demands on it; `given`: fields of their own."""
        return cls.read(
            candidate,
            candidate.strength,
            candidate.budget,
            race,
            outer_diameter=candidate.housing.outer_diameter,
            width=candidate.housing.width,
            slowest_decay=race.decay_rates[0][1],
            corrector=table.corrector,
            ball_material=table.ball_material,
            housing=RULES[table.design].text,
            **given,
        )


@record
class AccuracyBudget(Record):
    """Displacements 0–peak of the race that stay when the balls have settled; None: without bound."""

    optional: ClassVar[frozenset[str]] = frozenset({"rolling_friction_reached_um"})

    race_eccentricity: Annotated[float | None, Quantity("race eccentricity", "Δ", 3, unit="um")]
    speed: Annotated[float, Quantity("at the least favourable speed", "Ω", 6, unit="rpm")]
    rolling_friction: Annotated[
        float | None, Quantity("dry friction, balls evenly spread", "w_f/cos(γ_g/2)", 3, unit="um")
    ]
    rolling_friction_worst: Annotated[
        float | None, Quantity("dry friction, bound", "", 3, "over all arrangements of the balls", unit="um")
    ]
    rolling_friction_vertical: Annotated[
        float | None,
        Quantity("the same with the spindle vertical", "", 3, "without gravity along the race", unit="um"),
    ]
    friction_number: Annotated[
        float | None, Quantity("friction over gravity", "Λ", 3, "below 1 gravity shakes friction out")
    ]
    race_ovality: Annotated[float | None, Quantity("two-lobe ovality of the race", "2a_k", 3, unit="um")]
    plane_offset: Annotated[float | None, Quantity("race off the wheel's plane", "", 3, unit="um")]
    capacity_shortfall: Annotated[float | None, Quantity("imbalance beyond the capacity", "", 3, unit="um")]
    residual: Annotated[float | None, Quantity("expected residual (root of squares)", "", 3, unit="um")]
    worst: Annotated[float | None, Quantity("largest residual (plain sum)", "", 3, unit="um")]
    worst_vertical: Annotated[float | None, Quantity("largest residual with the spindle vertical", "", 3, unit="um")]
    permitted: Annotated[float | None, Quantity("permitted by the limit", "", 3, unit="um")]
    rolling_friction_reached: Annotated[
        float | None, Quantity("friction band of simulated balls", "", 3, unit="um")
    ] = None

    @classmethod
    def of(cls, design: Design, reached: tuple[float, ...] | None) -> Self:
        """Record of a design; `reached`: angles [rad] at which the simulated balls came to rest."""
        candidate, budget = design.autobalancer, design.autobalancer.budget
        worst = next(each for each in design.worst if each.speed == budget.speed)
        friction = design.case.friction_arm, candidate.pitch_radius, candidate.ball_diameter / 2
        return cls.read(
            budget,
            rolling_friction_worst=worst.rolling_friction,
            rolling_friction_vertical=worst.upright.rolling_friction,
            friction_number=None if worst.vertical is None else friction_number(*friction, budget.speed),
            worst=worst.residual,
            worst_vertical=worst.upright.residual,
            rolling_friction_reached=None if reached is None else friction_band(*friction, reached),
        )


@record
class BodyRecord(Record):
    """The body that levels and sizing take.

    `kind`: a point mass, a rigid body along its spindle, or one in space. `estimated`: its inertia is estimated, and
    the bands [low, high] are those that 95 % of such machines lie in. Inertia is null for a point mass.
    """

    optional: ClassVar[frozenset[str]] = frozenset(
        {"estimate", "effective_mass_band_kg", "imbalance_band_g_mm", "rotor_polar_inertia_kg_m2"}
    )

    decimals: ClassVar[Mapping[str, int]] = {"mm": 9}

    kind: Annotated[str, Quantity("body")]
    estimated: Annotated[bool, Quantity("inertia estimated")]
    center_of_mass_from_wheel: Annotated[
        tuple[float, float, float] | None, Quantity("wheel to centre of mass", unit="mm")
    ]
    inertia: Annotated[tuple[float, float, float] | None, Quantity("inertia", "J_x, J_y, J_z", 3, unit="kg_m2")]
    inertia_xz: Annotated[float | None, Quantity("product of inertia", "J_xz", 3, unit="kg_m2")]
    rotor_polar_inertia: Annotated[float | None, Quantity("polar inertia of the rotor", "J_p", 3, unit="kg_m2")]
    effective_mass_band: Annotated[tuple[float, float] | None, Quantity("band of the effective mass", "", 3, unit="kg")]
    imbalance_band: Annotated[tuple[float, float] | None, Quantity("band of the imbalance", "", 3, unit="g_mm")]
    estimate: Annotated[str | None, Quantity("estimate by")]

    @classmethod
    def of(cls, design: Design) -> Self:
        """Record of a design."""
        body, bands = design.case.body, design.bands
        inertia, (x, y, z) = body.body.inertia, body.wheel
        return cls(
            kind="point mass" if inertia is None else "in space" if body.in_space else "along the spindle",
            estimated=body.estimate is not None,
            center_of_mass_from_wheel=None if inertia is None else (-x, -y, -z),
            inertia=None if inertia is None else (inertia.xx, inertia.yy, inertia.zz),
            inertia_xz=None if inertia is None else inertia.xz,
            rotor_polar_inertia=body.body.rotor_polar_inertia or None,
            effective_mass_band=None if bands is None else bands.effective_mass,
            imbalance_band=None if bands is None else bands.imbalance,
            estimate=None if body.estimate is None else estimate_source(),
        )


@record
class FrictionBound(Record):
    """The highest level that friction can leave by holding the balls, and how many simulated starts come near it."""

    level_db: Annotated[float, Quantity("bound of friction", "L")]
    reached_within_1_db: Annotated[int, Quantity("simulated starts within 1 dB of it")]
    runs: Annotated[int, Quantity("simulated starts")]

    @classmethod
    def of(cls, design: Design, levels: Iterable[float]) -> Self | None:
        """Record beside the levels [dB] of all simulated starts; None where balls cannot balance, or leave nothing."""
        if design.speed_levels is None:
            return None
        bound, simulated = design.speed_levels.arranged.level_after_db, list(levels)
        near = sum(level > bound - 1 for level in simulated)
        return cls(level_db=bound, reached_within_1_db=near, runs=len(simulated)) if math.isfinite(bound) else None


@record
class NewWheel(Record):
    """The imbalance at which the level with the autobalancer, as expected, is that without; below, the balls make it
    louder, which is no fault.
    """

    break_even_imbalance: Annotated[float, Quantity("break-even imbalance", "m₀e", 3, unit="g_mm")]
    level_db: Annotated[float, Quantity("level there", "L")]

    @classmethod
    def of(cls, design: Design) -> Self | None:
        """Found by bisection of the logarithm, up to the capacity; None where balls cannot balance, or never help."""
        case, balls, most = design.case, design.autobalancer, design.autobalancer.static_moment

        def levels(imbalance: float) -> tuple[float, float]:
            """Levels [dB] without and with the balls at an imbalance [kg m]."""
            worst = idle_vibration(case, imbalance, balls, design.frequency.balancing_possible).worst
            return -math.inf if worst.before is None else worst.before, math.inf if worst.after is None else worst.after

        def helps(imbalance: float) -> bool:
            """True if the balls lower the level."""
            without, with_balls = levels(imbalance)
            return without > with_balls

        if not most or not helps(most):
            return None
        low, high = 1e-6 * most, most
        while high > 1.001 * low:
            middle = math.sqrt(low * high)
            low, high = (low, middle) if helps(middle) else (middle, high)
        level = levels(high)[0]
        return cls(break_even_imbalance=high, level_db=level) if math.isfinite(level) else None


@record
class Vibration(Record):
    """Levels at the loudest limited place, `place`, at the rated speed, and at each; None after: balls cannot balance.

    A body in space has its level limited in the wheel plane, its handles by their weighted acceleration.

    `at_idle_speed`: at the idle speed of a motor, where that is another. `by_speed`: over the speed range;
    `worst_arrangement`: the highest of the range where friction holds the balls at their worst; none under load. Under
    load the level after is that of a machine pressed to the work when its balls have settled, `level_at_once_db` that
    of one pressed before. `parts`: whether wheel and work part: then levels are simulated, and that of steady contact
    is not valid. `starts`: the start cases of grinding; `bound`: whether the level after is a lower bound.
    """

    optional: ClassVar[frozenset[str]] = frozenset(
        {
            "at_idle_speed",
            "highest_level_band_db",
            "by_speed",
            "worst_arrangement",
            "worst_arrangement_vertical",
            "parts",
            "steady_level_after_db",
            "level_at_once_db",
            "at_once_stays",
            "starts",
            "bound",
        }
    )

    level_before_db: Annotated[float | None, Quantity("level before", "L")]
    level_after_db: Annotated[float | None, LEVEL_AFTER]
    reduction_db: Annotated[float | None, Quantity("reduction", "ΔL", 3)]
    handles: tuple[HandleLevels, ...]
    place: Annotated[str, Quantity("place of the level")] = WHEEL_PLANE
    highest_level_band_db: Annotated[
        tuple[float, float] | None, Quantity("band of the expected level, by the estimated inertia", "L")
    ] = None
    at_idle_speed: IdleSpeedLevels | None = None
    by_speed: tuple[SpeedLevel, ...] | None = None
    worst_arrangement: SpeedLevel | None = None
    worst_arrangement_vertical: SpeedLevel | None = None
    parts: Annotated[bool | None, Quantity("wheel and work part")] = None
    steady_level_after_db: Annotated[float | None, Quantity("level after if they did not part (not valid)", "L")] = None
    level_at_once_db: Annotated[float | None, Quantity("level after, pressed at once", "L")] = None
    at_once_stays: Annotated[bool | None, Quantity("pressed at once, wheel and work go on bouncing louder")] = None
    starts: LoadedStarts | None = None
    bound: LevelBound | None = None

    @classmethod
    def of(
        cls,
        vibration: Levelled,
        levels: SpeedLevels | None = None,
        speed: float | None = None,
        bands: BodyBands | None = None,
    ) -> Self:
        """Record in the words of the interface; `speed` [rad/s]: the rated one, for instrument readings."""
        worst = vibration.worst
        place_bands = (None,) * len(vibration.places) if bands is None else bands.places
        return cls(
            level_before_db=worst.before,
            level_after_db=worst.after,
            reduction_db=worst.reduction,
            handles=tuple(
                HandleLevels.of(place, speed, band=band)
                for place, band in zip(vibration.places, place_bands, strict=True)
            ),
            place=vibration.judged,
            highest_level_band_db=None if bands is None else bands.level,
            by_speed=None if levels is None else levels.by_speed,
            worst_arrangement=None if levels is None else levels.arranged,
            worst_arrangement_vertical=None if levels is None else levels.upright or levels.arranged,
        )

    @classmethod
    def of_loaded(cls, loaded: LevelsUnderLoad, speed: float | None = None) -> Self:
        """Record of the vibration under load."""
        levels = cls.of(loaded.levels, speed=speed)
        steady = loaded.steady.after if loaded.parts_after else None
        levels = replace(levels, parts=loaded.parts_before or loaded.parts_after, steady_level_after_db=steady)
        if loaded.hasty is None:
            return levels
        handles = tuple(HandleLevels.of(place, speed, hasty) for place, hasty in
                        zip(loaded.levels.places, loaded.hasty.places, strict=True))  # fmt: skip
        return replace(levels, handles=handles, level_at_once_db=loaded.hasty.worst.after, at_once_stays=loaded.stays)


@record
class Eccentricity(Record):
    """Parts of the eccentricity that the drawing permits; the simulation uses `total_um`."""

    decimals: ClassVar[Mapping[str, int]] = {"um": 6}

    rule: Annotated[str, Quantity("rule of the sum")]
    total: Annotated[float, Quantity("permitted in all", "Δ", 3, unit="um")]
    sum: Annotated[float, Quantity("sum of the parts", "", 3, unit="um")]
    race: Annotated[float, Quantity("race to bore", "Δ_r", 3, unit="um")]
    clearance: Annotated[float, Quantity("clearance of bore and spindle", "Δ_f", 3, unit="um")]
    spindle: Annotated[float, Quantity("spindle", "Δ_s", 3, unit="um")]
    race_tir: Annotated[float, Quantity("run-out of the race as a gauge shows it", "TIR", 3, unit="um")]
    spindle_tir: Annotated[float, Quantity("run-out of the spindle as a gauge shows it", "TIR", 3, unit="um")]
    housing: Annotated[float, Quantity("imbalance of the housing", "Δ_h", 3, unit="um")]
    least: Annotated[float, Quantity("least attainable sum", "", 3, unit="um")]
    bore_class: Annotated[str | None, Quantity("tolerance class of the bore")]
    spindle_class: Annotated[str | None, Quantity("tolerance class of the spindle")]
    spindle_limits: Annotated[tuple[float, float] | None, Quantity("limits of the spindle", unit="um")]
    balance_grade: Annotated[str, Quantity("balance grade of the housing")]

    @classmethod
    def of(cls, split: EccentricitySplit) -> Self:
        """Record in user units."""
        fit = split.fit
        return cls.read(
            split,
            race_tir=2 * split.race,
            spindle_tir=2 * split.spindle,
            bore_class=None if fit is None else fit.bore_class,
            spindle_class=None if fit is None else fit.spindle_class,
            spindle_limits=None if fit is None else (fit.spindle.lower, fit.spindle.upper),
        )


@record
class SectionPart(Record):
    """One part of the housing.

    `outline_mm`: half section, counter-clockwise, of each corner the place along the axis from the closed web's face,
    the distance from the axis, and the bulge of the edge that leaves it (tangent of a quarter of its arc).
    """

    name: Annotated[str, Quantity("part")]
    material: Annotated[str, Quantity("material")]
    mass: Annotated[float, Quantity("mass", unit="g")]
    section_area_mm2: Annotated[float, Quantity("area of the half section")]
    outline_mm: Annotated[tuple[tuple[float, float, float], ...], Quantity("outline of the half section")]

    @classmethod
    def of(cls, part: TurnedPart) -> Self:
        """Record in user units."""
        return cls(
            name=part.name,
            material=part.material,
            mass=part.mass,
            section_area_mm2=1e6 * part.area,
            outline_mm=tuple((drawn(edge.start.z), drawn(edge.start.r), edge.bulge) for edge in part.profile),
        )


@record
class Section(Record):
    """Lengths, tolerances and parts of the housing, as its drawing shows them; requirements are assumed practice."""

    decimals: ClassVar[Mapping[str, int]] = {"mm": 9, "um": 6}

    design: Annotated[str, Quantity("kind of housing")]
    bore_diameter: Annotated[float, Quantity("bore", "", 5, unit="mm")]
    bore_class: Annotated[str, Quantity("tolerance class of the bore")]
    bore_limits: Annotated[tuple[float, float] | None, Quantity("limits of the bore", unit="um")]
    hub_diameter: Annotated[float, Quantity("hub", "", 5, unit="mm")]
    race_diameter: Annotated[float, Quantity("race", "2R", 5, unit="mm")]
    race_tolerance: Annotated[float, Quantity("tolerance of the race's radius", "±", unit="mm")]
    shoulder_diameter: Annotated[float, Quantity("race at the webs", "", 5, unit="mm")]
    groove_tolerance: Annotated[float, Quantity("tolerance of the groove's radius", "±", unit="mm")]
    ring_diameter: Annotated[float, Quantity("outside of the race ring", "", 5, unit="mm")]
    wall: Annotated[float, Quantity("wall outside the race", unit="mm")]
    web: Annotated[float, Quantity("web and cover", unit="mm")]
    inner_width: Annotated[float, Quantity("between web and cover", unit="mm")]
    runout: Annotated[float, Quantity("runout of the race to the bore", "TIR", unit="um")]
    circularity: Annotated[float, Quantity("circularity of the race", unit="um")]
    roughness_Ra: Annotated[float, Quantity("roughness of the race", "Ra", unit="um")]
    hardness: Annotated[str, Quantity("hardness of the race")]
    case_depth: Annotated[float, Quantity("depth of the hard case, at least", unit="mm")]
    closure: Annotated[str, Quantity("closure")]
    cover_fit: Annotated[str, Quantity("fit or thread of the cover")]
    fastening: Annotated[str, Quantity("fastening")]
    ring_seat_class: Annotated[str | None, Quantity("tolerance class of the ring's seat", "", 3, "None: no ring")]
    ring_seat_limits: Annotated[tuple[float, float] | None, Quantity("limits of the ring's seat", unit="um")]
    bearing_ring: Annotated[str | None, Quantity("bearing whose outer ring is the race")]
    parts: tuple[SectionPart, ...]

    @classmethod
    def of(cls, design: "Design | RaceDesign") -> Self:
        """Record of a design."""
        built = design.construction
        parts, quality, fit, seat = built.parts, built.quality, design.eccentricity.fit, built.seat
        cut, ring = parts.dimensions, ring_of(design.case, design.autobalancer.race_radius)
        return cls(
            design=design.case.autobalancer.design,
            bore_diameter=2 * cut.bore_radius,
            bore_class="" if fit is None else fit.bore_class,
            bore_limits=None if fit is None else (fit.bore.lower, fit.bore.upper),
            hub_diameter=2 * cut.hub_radius,
            race_diameter=2 * cut.race_radius,
            race_tolerance=RACE_TOLERANCE,
            shoulder_diameter=2 * cut.shoulder_radius,
            groove_tolerance=GROOVE_TOLERANCE,
            ring_diameter=2 * cut.ring_radius,
            wall=cut.ring_radius - cut.race_radius,
            web=cut.web,
            inner_width=cut.inner_width,
            runout=2 * design.eccentricity.race,
            circularity=quality.circularity,
            roughness_Ra=quality.roughness,
            hardness=hardness_text(quality),
            case_depth=quality.case_depth,
            closure=parts.closure,
            cover_fit=seat_name(parts, built.cover),
            fastening=parts.fastening,
            ring_seat_class=None if seat is None else seat.seat_class,
            ring_seat_limits=None if seat is None else (seat.seat.lower, seat.seat.upper),
            bearing_ring=None if ring is None else ring.designation,
            parts=tuple(map(SectionPart.of, parts.turned)),
        )
