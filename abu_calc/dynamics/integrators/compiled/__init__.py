"""A compiled way through scenes that switch: steps, located events and natural next modes, without Python.

program.py   the equations of a structure as text          arrays.py, layout.py   where the loop finds what
method.py    step, error, dense output                     locate.py    the first event of a step
friction.py, contact.py, impact.py, decide.py              natural next modes, checked by the equations
loop.py      all of it together                            language.py  that text in LLVM's language, by
machine.py   LLVM's language to machine code               calls.py, expressions.py, writer.py
cache.py     machine code on disk                          code.py      a structure's machine code
order.py     balls numbered round their races              run.py       from one general decision to the next

method … loop are plain Python on numbers and run as such; compiled, they do the same.
"""
