"""The equations as straight-line code, traced from the one right-hand side.

All expressions, each once; the symbols that stand for states and parameters while they are made; the trace, the numbers
that its code runs with, and plain Python on numbers for SciPy's methods.
"""
