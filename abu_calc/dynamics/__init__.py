"""From a scene to its motion: Scene → Equations → Trajectory, and the closed forms that hold beside them.

Own files, the nouns and the faces, which import no room below them:

motion.py         where everything is, what balls feel, what effects add, all accelerations
rotor.py          how a rotor turns: steady, guided, driven      parameters.py     the numbers that the equations read
race.py           races and their balls                          support.py        the face of a support
circumstances.py  all of a scene but its effects                 effect.py         the face of an effect
scene.py          both together                                  trajectory.py     what an integrator hands on

Rooms; each imports only those before it:

supports/     one file a kind: it answers for itself      equations/    the one right-hand side, with the map of it
switching/    modes: what sticks, touches, stands         effects/      one file an effect, and how they go together
tracing/      the equations in other languages            integrators/  the only files that know solvers
slow/         averages, and the envelope by them          balanced/     states of rest, and whether they are stable
"""
