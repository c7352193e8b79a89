"""Figures of a result as data (charts, drawings, a motion), and those drawn by matplotlib or in characters.

matplotlib is loaded on request only: for files, and for those who work in Python.
"""
