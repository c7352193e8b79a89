"""Duties of the machine besides idling: grinding, run-up, work on a motor or on a swing arm."""

from typing import TYPE_CHECKING, Annotated, ClassVar, Final, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from abu_calc.inputs.reading.table import Many, Table, entry, problem, whole

if TYPE_CHECKING:
    from abu_calc.formulas.swing_arm import Arm

STIFFNESS: Final = "contact_stiffness_N_per_m"
JOINT: Final = ("arm_length_mm", "moment_of_inertia_kg_m2", "joint_stiffness_N_per_m", "joint_damping_N_s_per_m")
"""Keys of the arm itself."""
GRIP: Final = (STIFFNESS, "cutting_coefficient", "contact_angle_deg", "touch_angle_deg", "pressing_moment_N_m")
"""Keys of the contact that presses an arm to the workpiece."""


class Grinding(Table):
    """The machine under load: the wheel pressed to the work. Without this table the machine idles."""

    example_defaults: ClassVar[frozenset[str]] = frozenset({STIFFNESS})

    press_force_N: float = entry(45.0, gt=0, le=1e5, usual=(5, 500)).means(
        "Normal force between wheel and work, weight included [N]; {range}, by hand 30 … 60. Default: {default}, the "
        "upper feed force of ISO 28927-4."
    )
    cutting_coefficient: float = entry(0.35, ge=0, le=1.5, usual=(0.1, 1)).means(
        "Cutting force over normal force, f = T/N; {range}, by practice 0.3 … 0.5. Default: {default}, assumed."
    )
    contact: Literal["compliant", "rigid", "face"] = entry("compliant").means(
        "Contact of wheel and work: compliant (a spring), rigid (never parts) or face (runout does not press). "
        "Default: {default}."
    )
    contact_stiffness_N_per_m: float = entry(2e5, gt=0, le=1e12, usual=(5e3, 5e7)).means(
        "Normal stiffness of a compliant contact [N/m]; {range}: cotton wheel or body panel 2e4 … 1e5, resinoid disk "
        "edge 1e5 … 5e5, vitrified wheel on solid steel 1e6 … 1e7. Default: {default}, assumed, with a warning."
    )
    rotation_sense: Annotated[Literal[-1, 1], BeforeValidator(whole)] = entry(-1).means(
        "-1: friction on the wheel opposes rotation, the work on the -y side; 1: the mirror case. Default: {default}."
    )

    @classmethod
    def displaced_by(cls, key: str, value: object) -> tuple[str, ...]:
        """Only a compliant contact has a stiffness."""
        return (STIFFNESS,) if key == "contact" and value != "compliant" else ()

    def unused(self) -> frozenset[str]:
        """The stiffness, where the contact has none."""
        return frozenset() if self.contact == "compliant" else frozenset({STIFFNESS})


class Start(Table):
    """Start of the balls: their places in the race when the machine is switched on."""

    angles_deg: Many[Annotated[float, Field(ge=-360, le=360)]] = entry(
        example=[-30.0, 0.0, 30.0, 60.0], min_length=1, max_length=200
    ).means(
        "Angle of each ball from the wheel's imbalance [degrees]; as many as the design has balls, each -360 … 360. "
        "With two races: from the zero mark of the spindle, the first race's balls first. Balls that would overlap are "
        "moved apart."
    )
    speeds_rpm: Many[Annotated[float, Field(ge=-1e6, le=1e6)]] | None = entry(
        None, example=[0.0, 0.0, 0.0, 0.0], min_length=1, max_length=200
    ).means(
        "Speed of each ball at the start, against the race, at full speed [rpm]; as many as angles_deg, each -1000000 "
        "… 1000000. Without it: at rest in the race."
    )

    @model_validator(mode="after")
    def _a_speed_for_each_angle(self) -> Self:
        if self.speeds_rpm is not None and len(self.speeds_rpm) != len(self.angles_deg):
            raise problem(
                "one value for each ball of angles_deg", "speeds_rpm", found=str(len(self.speeds_rpm)),
                allowed=str(len(self.angles_deg)),
            )  # fmt: skip
        return self


class RunUp(Table):
    """Starting and stopping at a given pace."""

    time_s: float = entry(1.0, gt=0, le=3600, usual=(0.05, 30)).means(
        "Time from standstill to the rated speed [s]; {range}. A motor takes its own time. Default: {default}, assumed."
    )
    run_down_s: float = entry(3.0, gt=0, le=3600, usual=(0.1, 120)).means(
        "Time from the rated speed to standstill [s]; {range}. Default: {default}, assumed."
    )
    pause_speed_rpm: float | None = entry(None, ge=1, le=300_000, usual=(100, 20_000), example=1100.0).means(
        "Speed at which the rotor pauses after its run-up, so that balls that hang come to rest [rpm]; {range}, below "
        "machine.speed_range_rpm. It slows to it as in run_down_s. Default: no pause."
    )
    pause_s: float = entry(2.0, gt=0, le=3600, usual=(0.1, 60)).means(
        "Length of the temporary speed reduction [s]; {range}. Default: {default}, assumed."
    )
    pause_rise_s: float = entry(0.5, gt=0, le=3600, usual=(0.05, 30)).means(
        "Time in which it then rises to the rated speed [s]; {range}. Default: {default}, assumed."
    )

    def unused(self) -> frozenset[str]:
        """Keys of the temporary speed reduction, if there is none."""
        return frozenset({"pause_s", "pause_rise_s"}) if self.pause_speed_rpm is None else frozenset()


class Motor(Table):
    """A motor of limited power: its torque falls linearly from stall to the no-load speed. The defaults are an
    example, not your motor.
    """

    example_defaults: ClassVar[frozenset[str]] = frozenset(
        {"stall_torque_N_m", "no_load_speed_rpm", "rotor_inertia_kg_m2"}
    )

    stall_torque_N_m: float = entry(3.0, gt=0, le=1e6, usual=(0.05, 100)).means(
        "Torque at standstill, at the spindle [N·m]; {range}. Default: {default}, an example."
    )
    no_load_speed_rpm: float = entry(6000.0, ge=1, le=300_000, usual=(700, 80_000)).means(
        "Speed of the spindle at which the torque is zero [rpm]; {range}, not below machine.speed_rpm. Levels, "
        "stresses and stability are judged at the idle speed that follows from it, too. Default: {default}, an example."
    )
    rotor_inertia_kg_m2: float = entry(2e-3, gt=0, le=1e6, usual=(1e-06, 2)).means(
        "Moment of inertia of all that turns, reduced to the spindle [kg·m²]; {range}. Default: {default}, an example."
    )


class SwingArm(Table):
    """The machine mounted on a swing arm (Kovalenko 2010). The defaults are an example, not your machine."""

    example_defaults: ClassVar[frozenset[str]] = frozenset({*JOINT, *GRIP})

    arm_length_mm: float = entry(350.0, ge=1, le=1e5, usual=(50, 3000)).means(
        "From the arm's axis to the wheel's axis [mm]; {range}. Default: {default}, an example."
    )
    moment_of_inertia_kg_m2: float = entry(0.62, gt=0, le=1e6, usual=(0.001, 200)).means(
        "Moment of inertia of arm and machine about the arm's axis, without autobalancer [kg·m²]; {range}. Default: "
        "{default}, an example."
    )
    joint_stiffness_N_per_m: float = entry(2000.0, ge=0, le=1e12, usual=(5, 1000000.0)).means(
        "Stiffness of the joint reduced to the arm length [N/m]; {range}. Default: {default}, an example."
    )
    joint_damping_N_s_per_m: float = entry(40.0, ge=0, le=1e9, usual=(0.01, 10000.0)).means(
        "Damping of the joint reduced to the arm length [N·s/m]; {range}. Default: {default}, an example."
    )
    contact_stiffness_N_per_m: float = entry(1e6, ge=0, le=1e12, usual=(5e3, 5e7)).means(
        "Normal stiffness of the work [N/m]; {range}. Default: {default}, an example."
    )
    cutting_coefficient: float = entry(0.45, ge=0, le=1.5, usual=(0.1, 1)).means(
        "Cutting force over normal force, f = T/N; {range}. Default: {default}, an example."
    )
    contact_angle_deg: float = entry(90.0, ge=0, le=180, usual=(10, 180)).means(
        "Angle between the arm and the contact radius [degrees]; {range}. Default: {default}, an example."
    )
    touch_angle_deg: float = entry(2.0, ge=-90, le=90, usual=(0.1, 60)).means(
        "Angle of the arm at which the disk touches the work [degrees]; {range}. Default: {default}, an example."
    )
    pressing_moment_N_m: float = entry(20.0, ge=0, le=1e6, usual=(0.2, 1000)).means(
        "Torque that presses the disk to the work [N·m]; {range}. Default: {default}, an example."
    )

    def arm(self, wheel_radius: float, added_mass: float = 0.0) -> "Arm":
        """The arm in SI; `wheel_radius` [m], `added_mass` at its end [kg] beside what its moment of inertia counts."""
        from abu_calc.formulas.swing_arm import Arm

        return Arm(
            length=self.arm_length,
            inertia=self.moment_of_inertia + added_mass * self.arm_length**2,
            joint_stiffness=self.joint_stiffness,
            joint_damping=self.joint_damping,
            contact_stiffness=self.contact_stiffness,
            friction=self.cutting_coefficient,
            disk_radius=wheel_radius,
            contact_angle=self.contact_angle,
            touch_angle=self.touch_angle,
            pressing_moment=self.pressing_moment,
        )
