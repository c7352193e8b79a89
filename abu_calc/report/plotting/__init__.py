"""Figures drawn by matplotlib: for files, and for those who work in Python. It is loaded when one is asked for."""
