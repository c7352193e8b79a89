"""Path from a scene to its motion: Scene → Equations → Trajectory, and the closed forms beside them.

Files of this folder hold the nouns and the interfaces, and import no package below them:

motion.py      places and speeds of everything, loads, all accelerations; balls that move as one
rotor.py       how a rotor turns: steady, guided, driven; its races and their balls; the numbers that the equations read
support.py     the interface of a support, and all of a scene but its effects
effect.py      the interface of an effect
scene.py       both together
trajectory.py  the samples that an integrator returns

Packages; each imports only those before it:

supports/     one file a kind: it answers for itself
equations/    the one right-hand side, with the map of it
switching/    modes: what sticks, touches, stands
effects/      one file an effect, and how they go together
codegen/      the equations as straight-line code
integrators/  the only files that know solvers
averaging/    averages, and the envelope by them
stability/    states of rest, and whether they are stable
"""
