"""Whatever stands in a file, on a command line or in the environment: a command ends well.

A new kind of file is one entry in `kinds.py`. `pytest tests/fuzz` tries 500 inputs, `python -m tests.fuzz` 20 000.
"""
