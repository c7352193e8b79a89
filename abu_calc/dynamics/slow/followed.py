"""The run that an envelope stands for, sampled as those of the integrators are."""

import numpy as np

from abu_calc.dynamics.integrators.recorder import Recorder
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.slow.envelope import envelope, motion
from abu_calc.dynamics.trajectory import Sampling, Times, Trajectory

AT_ONCE = 2**17
"""Samples between which the slow motion is begun anew where not all are held; each takes some hundred bytes."""


def followed(scene: Scene, tolerance: float, times: Times) -> Trajectory:
    """The slow motion through all times, the first of which is 0, and the states of the equations at them.

    Raises NotTrustworthyError when the integration fails.
    """
    recorder = Recorder(Sampling.of(times))
    wanted = recorder.sampling.times
    room = len(wanted) if recorder.sampling.held is None else AT_ONCE
    state, evaluations, steps = None, 0, 0
    for first in range(0, len(wanted), room):
        before = max(first - 1, 0)
        slow = envelope(scene, tolerance, wanted[before : first + room], start=state)
        state = np.concatenate([slow.theta[:, -1], slow.rate[:, -1]])
        recorder.fill(motion(scene, slow)[:, first - before :])
        evaluations, steps = evaluations + slow.evaluations, steps + slow.steps
    samples = recorder.samples()
    return Trajectory(samples.t, samples.y, "scipy-lsoda", tolerance, evaluations, steps)
