"""The equations translated into other languages: plain Python, heyoka.

symbols.py   what stands for states and numbers while the one right-hand side runs
traced.py    the trace, one for every language, and the numbers its code is run with
plain.py     straight-line Python of it; heyoka's own expressions need no file, `integrators.heyoka_` compiles them
lanes.py     straight-line code on arrays: derivatives at many states at once
"""
