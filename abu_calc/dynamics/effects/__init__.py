"""Effects that act in a scene besides its support, its races and the imbalance: one effect, one file.

Rules of how they go together, to which tests hold them:

An effect READS the kinematics (`Motion`), the levers, its own numbers, mode and states, the numbers of the scene
(`Parameters`), and what is known of the scene (`Circumstances`: speed, races, support, how the rotor turns, how
long it runs down, which dry friction holds balls, whether balls move across their race). It never reads another effect.

It WRITES
    Motion        in `move`: acceleration of a guided rotor, offset of the races, radii, speed across; one effect each
    Levers        in `act`: `carry` adds; `axial`, `sunk`, `sinking` are extended by what moves along the spindle
    Loads.add     pull, press, frame: forces, which ADD
    Loads.own     bound; across; mates, leads; grip, free, hold: each SET BY ONE effect; a second one raises

and ANSWERS, so that nobody asks for it by name: rotor, rotor_inertia, from_rest, run_down, least_duration,
offset, falling, holding, placed, averaged, balls_meet, ball_states, switching, rule, whole_run.

What is coupled by physics, and where:
    dry friction needs the normal force          it sets `grip` per normal force; the equations solve both together
    dry friction and the second direction        `across` comes first; friction rubs against the whole velocity, so it
                                                 sets `across.grip` and `across.free` beside its own
    balls in contact move and stick together     contact sets `mates`, `leads`; friction reads them from `Loads` when it
                                                 decides, and contact reads `hold`: one problem,
                                                 `switching.ball_impacts`
    gravity and race eccentricity                the offset stands in `Motion`, since `move` comes before all `act`
    a wheel stands on its work                   a constraint, `beside` that of a rigid contact:
                                                 `switching.contact_stop`
    gravity shakes balls loose                   its weight reads `Circumstances.holding`

ORDER: that of their stages. What moves the rotor and the races comes before what acts on the balls, what opens a
direction before what rubs in it, and what decides by all forces comes last.

A new effect is a file here, its line in `registry.py`, and its example in `tests/dynamics/examples.py`. Its file
declares its table in scene files, too, as `keys`. One that comes with its support names the support's table instead, as
`table`.
"""
