"""What each check code means, as data: what is asked, what fails it, what to do; `abu explain ABU203` shows it.

1xx speeds, 2xx the autobalancer, 3xx strength, 4xx vibration and power, 5xx swing arm, 6xx bearing seats, 7xx what a
simulation shows of a design, 8xx how far a computation can be trusted, 9xx files, 10xx balancing on a rig.
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
    "Whether the interference of the tolerance class holds a ring whose load turns round it, beside the makers' class. "
    "A ring under a load fixed in direction needs no grip: it passes, with the share of loose pairs.",
    "What the ring needs is the larger of two rules for the load, and the losses by roughness, temperature and speed "
    "that the file asks for. The least interference, of the loosest pair, passes; the mean alone warns, with the share "
    "of pairs that fall short; a mean below it fails. Not done without radial load or chamfer.",
    "Take the recommended class; or a longer seat, a smaller load, a larger bearing.",
)
_BEARS: Final = (
    "Whether the largest interference of the tolerance class, with the tightest pair of parts, is permitted.",
    "The hoop stress is above 400 MPa in the ring, or above the strength of shaft or housing. Above a thousandth of "
    "the diameter, the makers' advice, and in a split housing that pinches the ring it warns.",
    "Take the recommended class, or a looser one.",
)
_STARTS: Final = (
    "Whether the seat at its least interference, losses taken off, passes on the torque when the machine starts.",
    "The friction torque of the seat is below starting_torque_N_m. Not done without a chamfer.",
    "Take the recommended class, or a longer seat.",
)
_WARMS: Final = (
    "Whether the part expands as its ring does, where no temperature is given.",
    "It never fails: it warns of light metals and stainless steel, with the change of interference for every 10 K.",
    "Give temperature_rise_K, or the temperature difference of the seat.",
)
_GRIP_FORMULAS: Final = (
    "fits.interference:theoretical_interference",
    "fits.requirement:creep_interference",
    "fits.requirement:load_loss",
)
_STRESS_FORMULAS: Final = ("fits.stress:contact_pressure", "fits.stress:inner_ring_stress")
_WARM_FORMULAS: Final = ("fits.requirement:temperature_loss",)
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
        "ABU411", "octave level",
        "Whether the rms velocity in each octave of IEC 61260-1 from 8 to 1000 Hz keeps the limit of GOST 17770-86, on "
        "the loudest axis of the loudest place.",
        "It is above 115 dB at 8 Hz, or 109 dB in an octave from 16 Hz on. Not done where the record is shorter than "
        "36 periods of the octave, or sampled too slowly for it.",
        "A longer record, or one sampled faster, where it is not done; else `abu size`.",
        "levels",
    ),
    CheckCode(
        "ABU412", "corrected level",
        "Whether the rms velocity of all octaves together, that of 8 Hz counted at half, keeps the limit of GOST "
        "17770-86.",
        "It is above 112 dB. Not done while octaves are missing, unless those that are there exceed it.",
        "A longer record, or one sampled faster, where it is not done; else `abu size`.",
        "levels",
    ),
    CheckCode(
        "ABU413", "daily exposure",
        "Whether the exposure A(8) of ISO 5349-1, by the minutes given, keeps the values of Directive 2002/44/EC.",
        "It is above the limit of 5 m/s². Warns above the action value of 2.5 m/s², or where axes that were not "
        "measured may bring it there: a total is up to 1.7 times one axis. Not done where W_h cannot be put on the "
        "record.",
        "Less vibration, or fewer minutes.",
        "levels", ("standards.vibration:daily_exposure", "standards.vibration:hand_arm_response"),
    ),
    CheckCode(
        "ABU421", "level lowered under load",
        "Whether the autobalancer lowers the level of the machine at its work, at the loudest handle.",
        "The machine moves no less with it: by steady contact, or by simulation where wheel and work part. Not done "
        "where a rigid contact would have to pull, where no simulation gave an answer, or where levels of chaotic "
        "bouncing are no further apart than its runs. Warns where it does not when the machine is pressed to the work "
        "before the balls have settled.",
        "A truer wheel, a softer contact, a harder press; what was tried on this machine stands in the report.",
        "grinding", ("formulas.grinding:hodograph_limit",),
    ),
    CheckCode(
        "ABU422", "capacity under load",
        "Whether the balls, side by side, carry what this contact asks of them, at the file's angle of the runout.",
        "They carry less: they lie side by side, and the rest moves the machine.",
        "More or larger balls, a truer or better balanced wheel, a softer contact.",
        "grinding", ("formulas.contact:SteadyContact.balancing_imbalance", "formulas.ball_ring:capacity"),
    ),
    CheckCode(
        "ABU423", "balls hold still under load",
        "Whether balls go where they balance at this contact, and drag keeps them from the flutter that cutting "
        "friction feeds.",
        "They go where they add to the imbalance, between MΩ² − c_y and 2MΩ² − c_x − c_y; or small disturbances grow, "
        "by flutter below the limit of drag, or near a natural frequency. Warns where that is so in another "
        "arrangement. Not done where balls cannot carry the need.",
        "Another contact stiffness or speed; more drag, or another number of balls.",
        "grinding", ("formulas.grinding:loaded_stiffness", "formulas.grinding:flutter_drag",
                     "formulas.loaded_stability:characteristic", "formulas.grinding:stiffness_regions"),
    ),
    CheckCode(
        "ABU424", "wheel stays on the work",
        "Whether the variable force of wheel and work, with the autobalancer, stays below the press force.",
        "Never failed: it warns where they part. The level is then that of a simulation.",
        "Press harder, or run the wheel truer.",
        "grinding",
    ),
    CheckCode(
        "ABU425", "closed form under load",
        "Whether the simulation of the contact with ideal race and balls ends where the closed form says.",
        "Never failed: it warns where they are further apart than the limit. Not done where no simulation reached the "
        "accuracy; not asked where wheel and work part or balls do not balance.",
        "Damp the suspension, or take another drag: something has not died out in the run.",
        "grinding", ("formulas.contact:SteadyContact.balancing_imbalance",),
    ),
    CheckCode(
        "ABU501", "arm contact stiffness",
        "Whether a swing arm is supercritical at the lowest speed and the worst contact angle.",
        "The contact is stiffer than the safer of two limits, by the series and exact. Necessary, not sufficient.",
        "More inertia about the arm's axis, a higher speed, or a softer wheel.",
        "swing-arm", ("formulas.swing_arm:stiffness_limit", "formulas.swing_arm:series_gain"),
    ),
    CheckCode(
        "ABU502", "arm joint damping",
        "Whether the joint damps what parametric resonance at twice the natural frequency feeds in.",
        "The damping is not above the limit. It warns where balls that stand on the heavy side at a start need more.",
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
    CheckCode(
        "ABU505", "balanced state on the arm",
        "Whether the balls stay where they balance on a swing arm, off the work and on it, over the speed range; by "
        "Floquet multipliers.",
        "Some small disturbance does not die out. It warns where that is so at the worst contact angle alone, or where "
        "the arm does not stand or press, so that it is judged off the work alone. Not done where the balls cannot "
        "carry the imbalance.",
        "More joint damping or more inertia; what was tried on this arm stands in the report.",
        "swing-arm", ("formulas.arm_motion:free_rates",),
    ),
    CheckCode("ABU601", "seat on the shaft", *_GRIPS, "seats", _GRIP_FORMULAS),
    CheckCode("ABU602", "largest interference, seat on the shaft", *_BEARS, "seats", _STRESS_FORMULAS),
    CheckCode("ABU603", "hold of the seat on the shaft at the start", *_STARTS, "seats", _TORQUE_FORMULAS),
    CheckCode("ABU604", "warmth of the seat on the shaft", *_WARMS, "seats", _WARM_FORMULAS),
    CheckCode("ABU611", "seat in the housing", *_GRIPS, "seats", _GRIP_FORMULAS),
    CheckCode("ABU612", "largest interference, seat in the housing", *_BEARS, "seats", _STRESS_FORMULAS),
    CheckCode("ABU613", "hold of the seat in the housing at the start", *_STARTS, "seats", _TORQUE_FORMULAS),
    CheckCode("ABU614", "warmth of the seat in the housing", *_WARMS, "seats", _WARM_FORMULAS),
    CheckCode(
        "ABU621", "clearance left in the bearing",
        "Whether a deep groove ball bearing keeps radial clearance when mounted and warm.",
        "Half of the bearings of its group (internal_clearance) or more have none left. It warns where more than "
        "0.135 % have none.",
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
        "Never failed: not done where no simulation reached the accuracy. Warns where wheel and work bounce "
        "chaotically, and the mean of long runs is known.",
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
    CheckCode(
        "ABU1001", "planes told apart",
        "Whether the two sensors tell the two planes apart, at the speeds of the runs.",
        "The condition number of the way from imbalances to readings is above 30: errors of a reading may grow by "
        "that. Warns above 10; above 300 no number is given.",
        "Planes farther apart, a speed farther from the natural frequencies, other trial masses.",
        "balance", ("formulas.two_planes:condition_number",),
    ),
    CheckCode(
        "ABU1002", "speed off the rig's natural frequencies",
        "Whether the runs are far from where small errors of rig and damping turn the phase.",
        "A speed is within a tenth of a natural frequency of roll and supports. Warns within three tenths, and where "
        "trial masses make data of the rig needless.",
        "Another speed: the check names what it would leave. Or trial masses.",
        "balance", ("formulas.two_planes:natural_frequencies",),
    ),
    CheckCode(
        "ABU1003", "rigid roll",
        "Whether the roll stays straight at the speeds of runs and service, as two planes ask for.",
        "The highest speed is above 0.7 of rotor.first_bending_speed_rpm, assumed; warns above half. Without that key "
        "it warns above 0.7 of what a solid steel bar of the same mass and length would have.",
        "More planes, at more speeds (ISO 21940-12); or a lower speed.",
        "balance", ("formulas.two_planes:bar_bending_speed",),
    ),
    CheckCode(
        "ABU1004", "correction surer than its errors",
        "Whether what readings, rig and the correction itself may be off, [errors], leaves little of the vibration.",
        "They leave more than half of it; above a tenth it warns. Where they leave all, no number is given.",
        "A second run after the correction; better readings; another speed.",
        "balance", ("formulas.two_planes:imbalances",),
    ),
    CheckCode(
        "ABU1005", "permitted residual imbalance",
        "Whether the imbalance to be expected after the correction is what tolerance.balance_grade permits, in each "
        "plane.",
        "It is above. Warns where twice it is.",
        "A second run after the correction.", "balance", ("standards.balance:permissible_imbalance",),
    ),
    CheckCode(
        "ABU1006", "runs agree",
        "Whether several runs tell the same imbalance, as well as their errors let them.",
        "A reading is off by more than six standard deviations; above three it warns.",
        "Look for what changed between the runs; or the roll bends, or data of the rig are wrong.", "balance",
    ),
    CheckCode(
        "ABU1007", "trial masses tell",
        "Whether the trial masses move the sensors enough to tell influence coefficients.",
        "The weaker one moves them by less than a twentieth of the largest reading; below three tenths it warns.",
        "Heavier trial masses.", "balance",
    ),
    CheckCode(
        "ABU1008", "metal to take off",
        "Whether what is to be taken off in a plane is there, by rotor.max_removable_g.",
        "The places given leave no way with less. Where any place will do, mass is put on opposite instead.",
        "More places, so that mass can be put on opposite.", "balance",
    ),
)  # fmt: skip

CHECK_CODES: Final[Mapping[str, CheckCode]] = {one.code: one for one in _ALL}
"""By code."""
