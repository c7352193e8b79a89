"""Compiled loop: steps, located events and natural next modes, as machine code or as plain Python.

program.py           the equations of a structure as text; balls numbered round their races
arrays.py            places in the arrays of the loop
dopri5.py, dop853.py step, error, dense output
locate.py            the first event of a step
impact.py            balls that press on each other, and their impacts
mode_transitions.py  natural next modes, checked by the equations
loop.py              all of it together, with the size of steps
kernels.py           the modules that make the loop of a method
translator.py        their text in LLVM's language, written by llvm_text.py
llvm_engine.py       LLVM's language to machine code
code.py              a structure's machine code
plain.py             the same without a compiler
availability.py      whether compiled code runs here, tried on systems that nobody has tried
run.py               from one general decision to the next
"""
