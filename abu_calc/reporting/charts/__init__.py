"""Figures drawn by matplotlib: for files, and for those who work in Python. It is loaded when one is asked for.

Figures of a result: charts, drawings, a motion as data. The code that draws them is elsewhere.
"""
