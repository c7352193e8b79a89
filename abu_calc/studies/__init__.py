"""Studies that people ask for: each takes what was read and returns one frozen, typed result.

quantity.py   name, symbol, digits and meaning of a result's field
result.py     common parts of all results
size.py       a machine sized and simulated
check_fit.py  bearing seats
simulate.py   one scene integrated
effects.py    effects that a scene calls for
stability.py  the balanced state
accuracy.py   cost of accuracy in time
verify.py     a file compared with its expected values
balance.py    a roll in two planes

A study composes the modules before it, decides the checks, and prints nothing. Commands, reports and Python
scripts rest on studies alone, so they cannot answer differently.
"""
