"""One file per solver library, each with `integrate(equations, tolerance, sample_times) -> Trajectory`.

run.py       what they share       scipy_.py    always there       heyoka_.py   fast, optional, by
choice.py    which one, and why                                    symbols.py   tracing the equations
"""
