"""One file per solver library, each with `integrate(equations, tolerance, sample_times) -> Trajectory`.

run.py      what they share: from event to event      choice.py   which one, and why
compiled/   fast where scenes switch, optional
scipy_.py   always there                              heyoka_.py  fast, optional
events.py   where SciPy's runs switch
"""
