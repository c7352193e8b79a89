"""What each check code means, as data: what is asked, what fails it, what to do; `abu explain ABU203` shows it.

1xx speeds, 2xx the autobalancer, 3xx strength, 4xx vibration and power, 5xx swing arm, 6xx bearing seats, 7xx what a
simulation shows of a design, 8xx how far a computation can be trusted, 9xx files.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final


@dataclass(frozen=True)
class CheckCode:
    """One kind of check: its code, its name, and what a reader of a report wants to know of it."""

    code: str
    name: str
    asks: str
    fails: str
    remedy: str
    step: str = ""
    """The step of `abu explain` that it belongs to, if any."""
    formulas: tuple[str, ...] = ()
    """Keys of the formulas that decide it."""


_GRIPS: Final = (
    "Whether the least interference of the tolerance class, with the loosest pair of parts, holds a ring whose load "
    "turns round it. A ring under a load fixed in direction needs no grip: it passes, with the share of loose pairs.",
    "The least interference is below what the ring needs: the larger of two rules for the load, and the losses by "
    "roughness, temperature and speed that the file asks for. Not done without radial load or chamfer.",
    "Take the recommended class; or a longer seat, a smaller load, a larger bearing.",
)
_BEARS: Final = (
    "Whether the largest interference of the tolerance class, with the tightest pair of parts, is permitted.",
    "It is above what 400 MPa of hoop stress in the ring permit, or above a thousandth of the diameter.",
    "Take the recommended class, or a looser one.",
)
_STARTS: Final = (
    "Whether the seat at its least interference, losses taken off, passes on the torque when the machine starts.",
    "The friction torque of the seat is below starting_torque_N_m. Not done without a chamfer.",
    "Take the recommended class, or a longer seat.",
)
_GRIP_FORMULAS: Final = (
    "fits.interference:theoretical_interference",
    "fits.requirement:creep_interference",
    "fits.requirement:load_loss",
)
_STRESS_FORMULAS: Final = ("fits.stress:contact_pressure", "fits.stress:inner_ring_stress")
_TORQUE_FORMULAS: Final = ("fits.creep:friction_torque",)

_ALL: Final = (
    CheckCode(
        "ABU101", "frequency region",
        "Whether light balls can balance at every speed of machine.speed_range_rpm.",
        "At some speed they go to the heavy side: the support moves with the imbalance. That speed is below the "
        "natural frequencies, and not in the zone between the two.",
        "Keep all speeds above the limit, or hold the machine more softly. Passing is necessary, not sufficient.",
        "frequency", ("sizing.frequency:zones",),
    ),
    CheckCode(
        "ABU103", "stable speed range",
        "Whether every small disturbance of the balanced state dies out, at every speed of machine.speed_range_rpm and "
        "in the worst arrangement of the balls that balances: by eigenvalues or Floquet multipliers, idle.",
        "At some speed one grows or stays; or there is no balanced state, since the balls cannot carry the imbalance.",
        "Keep all speeds above the boundary it names, or change drag and damping; or lighter balls.",
        "frequency",
    ),
    CheckCode(
        "ABU102", "ball carry-over",
        "Whether a horizontal spindle carries the balls round at its lowest speed. Not asked of vertical ones.",
        "The lowest speed is not above the one at which weight keeps balls at the bottom of the race.",
        "Raise the lowest speed, or enlarge the race.", "track", ("sizing.track:carry_over_speed",),
    ),
    CheckCode(
        "ABU201", "capacity",
        "Whether the balls, side by side, can balance the need times autobalancer.capacity_margin.",
        "The imbalance that they can balance is below it.",
        "More or larger balls, a larger envelope, or a better balanced and truer wheel.",
        "capacity", ("sizing.capacity:required_capacity", "formulas.ball_ring:capacity"),
    ),
    CheckCode(
        "ABU202", "accuracy budget",
        "Whether what balls cannot balance stays below the limit, at the worst speed of the range: race eccentricity, "
        "dry rolling friction, an oval race, and a race off the wheel's plane, as the root of the sum of squares.",
        "The displacement that rests at the wheel is above the one that limits.vibration_level_db permits.",
        "Smaller race eccentricity, a harder and cleaner race, or larger balls.",
        "budget", ("formulas.friction_band:friction_band", "sizing.budget:permitted_displacement"),
    ),
    CheckCode(
        "ABU203", "mass of the autobalancer",
        "Whether the autobalancer with its balls is light beside the machine (machine.mass_kg).",
        "Its share of the machine's mass is above autobalancer.max_mass_fraction.",
        'The design "light", a smaller bore, less margin, or a better balanced wheel.',
        "balls", ("sizing.housing:housing",),
    ),
    CheckCode(
        "ABU205", "race plane",
        "Whether a race off the wheel's plane (autobalancer.plane_offset_mm) leaves little at the wheel.",
        "What rests there is more than the limit permits. Not done for a point mass, whose inertia is not given.",
        "Bring the race nearer to the wheel; give transverse inertia and centre of mass of the machine.",
        "budget", ("sizing.capacity:plane_ratio", "sizing.budget:plane_rest"),
    ),
    CheckCode(
        "ABU301", "contact pressure",
        "Whether balls at the highest speed leave no dents in the race.",
        "Their Hertz pressure is above 5.2·HV, an assumed rule.",
        "A harder race, more and smaller balls, or a smaller race radius.",
        "track", ("sizing.stress:hertz_ball_in_toroid", "sizing.stress:permitted_pressure"),
    ),
    CheckCode(
        "ABU302", "race hardness",
        "Whether the race is hard enough: a soft race dents, and dents hold the balls.",
        "autobalancer.race_hardness_HRC is below 58 HRC; machines with soft races gained nothing.",
        "Harden the race to 60–63 HRC and grind it.", "track", ("sizing.stress:permitted_pressure",),
    ),
    CheckCode(
        "ABU303", "hoop stress",
        "Whether the rim bears its own rotation at the highest speed.",
        "The hoop stress is above a third of the yield strength, assumed.",
        "Reduce the outer diameter, or choose the one-piece steel design.", "track", ("sizing.stress:hoop_stress",),
    ),
    CheckCode(
        "ABU304", "race stays round",
        "Whether two opposite balls at the highest speed leave the race round: an oval one has two lobes, which hold "
        "the axis off by twice their amplitude. Held by one web alone, since a cover fitted with clearance lets the "
        "wall move; the accuracy budget takes web and cover as drawn, both carrying the wall.",
        "The lobes alone leave more than limits.vibration_level_db permits at that speed.",
        "A thicker wall (autobalancer.min_wall_mm), a smaller race, or more and smaller balls.",
        "track", (
            "sizing.stress:web_lobes", "sizing.stress:wall_lobes", "sizing.stress:hinged_wall_lobes",
            "sizing.stress:ring_flexure", "sizing.budget:oval_rest",
        ),
    ),
    CheckCode(
        "ABU401", "idle vibration level",
        "Whether the idle level with the autobalancer, at the worst handle and the worst speed of the range, keeps the "
        "limit of the file.",
        "It is above limits.vibration_level_db. Warns where only the worst is: friction holds the balls where they "
        "leave most, and all parts of the budget lie in line. Not done where balls cannot balance at these speeds.",
        "Smaller race eccentricity, a harder and cleaner race, larger balls.",
        "vibration", ("sizing.vibration:idle_vibration", "formulas.worst_friction:worst_friction"),
    ),
    CheckCode(
        "ABU402", "level lowered",
        "Whether the autobalancer lowers the idle level at all.",
        "The wheel moves no less with it. Not done where balls cannot balance at these speeds.",
        "The wheel is balanced better than balls can do: no autobalancer is needed.",
        "vibration", ("sizing.vibration:idle_vibration",),
    ),
    CheckCode(
        "ABU403", "cutting power",
        "Whether motor and grinding go together: the cutting power f·N·v at the rated speed against machine.power_W.",
        "Cutting takes more power than the motor has.",
        "A smaller press force or cutting coefficient, or more power.",
    ),
    CheckCode(
        "ABU501", "arm contact stiffness",
        "Whether a swing arm is supercritical at the lowest speed and the worst contact angle.",
        "The contact is stiffer than the safer of two limits, by the series and exact. Necessary, not sufficient.",
        "A longer arm, more inertia, a higher speed, or a softer wheel.",
        "swing-arm", ("formulas.swing_arm:stiffness_limit", "formulas.swing_arm:series_gain"),
    ),
    CheckCode(
        "ABU502", "arm joint damping",
        "Whether the joint damps what parametric resonance at twice the natural frequency feeds in.",
        "The damping is not above the limit.",
        "More damping in the joint, or less imbalance.",
        "swing-arm", ("formulas.swing_arm:damping_limit", "formulas.swing_arm:resonance"),
    ),
    CheckCode(
        "ABU503", "arm pressed to the work",
        "Whether the arm rests beyond the angle at which it touches the work, so that it presses.",
        "It rests before that. Not done where the arm does not stand, or points along the contact's normal.",
        "A larger pressing torque or a softer joint; a contact angle nearer to 90°.",
        "swing-arm", ("formulas.swing_arm:pressed_angle",),
    ),
    CheckCode(
        "ABU504", "arm stands while cutting",
        "Whether joint and contact together hold the arm.",
        "The static stiffness is not above zero: friction lifts the wheel by itself (static divergence).",
        "Turn the contact angle nearer to 90°, or a much stiffer joint.",
        "swing-arm", ("formulas.swing_arm:arm_stiffness",),
    ),
    CheckCode("ABU601", "seat on the shaft", *_GRIPS, "seats", _GRIP_FORMULAS),
    CheckCode("ABU602", "largest interference, seat on the shaft", *_BEARS, "seats", _STRESS_FORMULAS),
    CheckCode("ABU603", "hold of the seat on the shaft at the start", *_STARTS, "seats", _TORQUE_FORMULAS),
    CheckCode("ABU611", "seat in the housing", *_GRIPS, "seats", _GRIP_FORMULAS),
    CheckCode("ABU612", "largest interference, seat in the housing", *_BEARS, "seats", _STRESS_FORMULAS),
    CheckCode("ABU613", "hold of the seat in the housing at the start", *_STARTS, "seats", _TORQUE_FORMULAS),
    CheckCode(
        "ABU621", "clearance left in the bearing",
        "Whether a deep groove ball bearing keeps radial clearance when mounted and warm.",
        "The least probable clearance of its group (internal_clearance) is below zero.",
        "The group that the check names, or looser fits.", "seats", ("fits.clearance:clearance_left",),
    ),
    CheckCode(
        "ABU701", "balances from every start",
        "Whether balls go where they balance however the idle machine is switched on: bunched before and behind the "
        "imbalance, spread, from standstill, by the run-up; simulated with every effect that counts.",
        "From some start at the drag given more is left than a tenth of the imbalance and what eccentricity and "
        "friction keep. Starts at a third and three times the drag, oil hot and cold, warn. Not done where the balls "
        "cannot carry the imbalance, or where a start gave no answer.",
        "Leave the forbidden speeds, or change the drag; what was tried on this machine stands in the report.",
        "simulation", ("formulas.motion:simulate", "formulas.slow_motion:optimum_drag"),
    ),
    CheckCode(
        "ABU702", "settling time",
        "Whether they get there soon enough, from the slowest of these starts; in a run-up from full speed on.",
        "It takes longer than limits.settling_time_s, or they settle where they do not balance. At a third and three "
        "times the drag it warns.",
        "Another drag, or more capacity; what was tried stands in the report.",
        "simulation", ("formulas.motion:settling_time", "formulas.slow_motion:optimum_drag"),
    ),
    CheckCode(
        "ABU703", "simulated scene",
        "Whether a further scene that the file calls for (grinding, swing arm) could be simulated.",
        "Never failed: not done where no simulation reached the accuracy.",
        "A drag nearer to the optimum, or less accuracy (--accuracy).", "simulation", ("formulas.motion:simulate",),
    ),
    CheckCode(
        "ABU704", "no balls left hanging",
        "Whether any of these starts leaves balls going round behind the rotor: caught at a resonance of the "
        "suspension, driven round by it, or held back by their weight.",
        "At the end of a start at the drag given, balls keep a mean speed against the race above 5 % of the rotor's. "
        "At a third and three times the drag it warns.",
        "More drag, a faster run-up, more damping of the suspension, fewer or smaller balls, or a pause at a lower "
        "speed after the run-up.",
        "simulation", ("formulas.motion:simulate",),
    ),
    CheckCode(
        "ABU801", "accuracy reached",
        "Whether the error of a simulation, that of effects left out included, is within --accuracy.",
        "Two ways to compute it differ by more.",
        "Ask for less accuracy, or take effects in: --with EFFECT.", "simulation", ("formulas.motion:simulate",),
    ),
    CheckCode(
        "ABU802", "stability of the balanced state",
        "Whether every small disturbance of the balanced balls dies out, in the worst arrangement that balances.",
        "One grows or stays; or there is no balanced state, since the balls cannot carry the imbalance. Not done where "
        "the balanced state is not one of rest or not unique, or the scene presses a wheel to its work.",
        "Leave the forbidden speeds (abu stability --speeds finds them), or change drag and damping.",
        "track", ("formulas.slow_motion:decay_rate",),
    ),
    CheckCode(
        "ABU803", "effects left out",
        "Whether the effects that were left out may be: one more run, with every effect in, shows it.",
        "Amplitude, settling time or ball angles differ by more than the accuracy.",
        "Ask for more accuracy, or take effects in: --with EFFECT.", "simulation",
    ),
    CheckCode(
        "ABU811", "accuracy affordable",
        "Whether some way to compute, measured within the budget of time, reaches the accuracy.",
        "The error of each that was tried is above it.",
        "More time (--budget), or less accuracy.", "simulation",
    ),
    CheckCode(
        "ABU821", "members with numbers",
        "Whether the members of a sweep gave numbers that can be trusted; those that did not count as not meeting "
        "the limits.",
        "Not done where more than one in twenty gave none; it warns where any did.",
        "The reasons stand in the report; distributions may reach values that no machine has.", "simulation",
    ),
    CheckCode(
        "ABU822", "share that meets the limits",
        "Whether as many machines of the series meet the limits as [sweep] least_share asks for.",
        "The share of members is below it. It warns while the confidence interval reaches below it, and where nothing "
        "is asked for and not all members meet the limits.",
        "Tighten what the report names, or change the design.", "simulation",
    ),
    CheckCode(
        "ABU901", "expected values",
        "Whether the results of a file are those of its table [expected]; the check bears the name of the file.",
        "A value differs by more than its tolerance.",
        "If the change is meant, write it with abu verify --update.",
    ),
)  # fmt: skip

CHECK_CODES: Final[Mapping[str, CheckCode]] = {one.code: one for one in _ALL}
"""By code."""
