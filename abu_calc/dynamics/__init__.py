"""From a scene to its motion: Scene → Equations → Trajectory, and the closed forms that hold beside them.

scene.py         what is simulated, in SI           supports/      builders of linear supports
equations.py     states, rhs, parameters            energy.py      mass matrix, energy, power: the second derivation
integrators/     the only files that know solvers   jacobian.py    exact derivatives by the complex step
stationary.py    where the balls come to rest       resting.py     the same for any balls
linearised.py    small motions about that state     stability.py   whether they die out, and at which speeds
from_design.py   the scene of a machine             from_scene.py  the scene of a scene file
modes.py         how effects switch, and agree      sticking.py    which balls stick, which roll
touching.py      impacts, and who presses whom      envelope.py    the averaged slow motion
receptance.py    the support's steady response      trajectory.py  what an integrator hands on
"""
