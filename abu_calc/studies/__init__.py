"""What people ask for: each study takes what was read and returns one frozen, typed result.

quantity.py   what a field of a result is called, its symbol, digits and meaning     result.py   what all results share
size.py       a machine sized and simulated                     check_fit.py  bearing seats
simulate.py   one scene integrated                              effects.py    which effects a scene calls for
stability.py  the balanced state                                accuracy.py   what accuracy costs in time
verify.py     a file held to what it expects            balance.py    a roll in two planes

A study composes the rooms before it, decides the checks, and prints nothing. Commands, reports and Python scripts stand
on studies alone, so they cannot answer differently.
"""
