"""The loop: steps, located events and natural next modes, compiled by LLVM or run as the plain Python that it is.

program.py   the equations of a structure as text          arrays.py, layout.py   where the loop finds what
rk45.py, dop853.py   step, error, dense output             step_size.py  the factor on the next step
locate.py    the first event of a step                     friction.py, contact.py, impact.py, decide.py
loop.py      all of it together                                natural next modes, checked by the equations
kernels.py   the modules that make the loop of a method    order.py     balls numbered round their races
language.py  their text in LLVM's language, by             machine.py   LLVM's language to machine code
             calls.py, expressions.py, writer.py           cache.py     machine code on disk
code.py      a structure's machine code                    plain.py     the same without a compiler
ready.py     whether compiled code runs here               trial.py     asked of systems nobody has tried
run.py       from one general decision to the next
"""
