"""Ways through the equations, each with `integrate(equations, tolerance, sample_times) -> Trajectory`.

choice.py   which one, and why        counts.py    about how much work that is
compiled/   one loop for nearly all scenes, compiled or as plain Python
scipy_.py   stiff scenes, references  events.py    where SciPy's runs switch
run.py      what they share: from event to event
rates.py    how fast a scene's motion dies out and oscillates
recorder.py samples on their way to who reads them
"""
