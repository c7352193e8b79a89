"""Tests of abu-calc, and the environment that keeps them and the processes they start quick."""

import os
import sys

# Each process would compile all the tests, and each `abu` that tests start the package, for seconds.
sys.dont_write_bytecode = False
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
# Threads of linear algebra wait for each other busily, which costs small matrices a third more; before NumPy is loaded.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
