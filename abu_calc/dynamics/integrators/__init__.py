"""Integrators of the equations of motion.

Each has `integrate(equations, tolerance, sample_times) -> Trajectory`.

choice.py          the method for a scene, and why
work_estimates.py  how fast a scene's motion dies out and oscillates, and how much work that makes
compiled/          one loop for nearly all scenes, compiled or as plain Python
scipy_solvers.py   stiff scenes, references; where SciPy's runs switch
run.py             what all share: from event to event, and samples on their way to their readers
"""
