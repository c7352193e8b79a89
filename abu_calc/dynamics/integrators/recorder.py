"""Samples on their way from an integrator to who reads and who holds them: memory is taken for what is held alone."""

from dataclasses import dataclass, field

import numpy as np

from abu_calc.dynamics.trajectory import Array, Samples, Sampling
from abu_calc.errors import InputError

BLOCK = 2**14
"""Samples that are read at once where not all are held: few enough for little memory, many enough for arrays to pay."""


@dataclass
class Recorder:
    """Is filled with states, sample by sample or many at once."""

    sampling: Sampling
    done: int = 0
    """Number of filled samples."""
    read: int = 0
    """Number of filled samples that the readers have seen."""
    block: Array = field(init=False)
    """States since then; of the whole run where all are held."""
    held: Array = field(init=False)

    def __post_init__(self) -> None:
        times = self.sampling.times
        if not (len(times) and times[0] >= 0 and 0 < times[-1] < np.inf and np.all(times[1:] > times[:-1])):
            raise InputError("sample times must be finite and ascend from 0 or later")
        self.block = self.held = np.empty((0, 0))

    def fill(self, states: Array) -> None:
        """The next samples, one column each."""
        if not self.block.size:
            self._begin(len(states))
        filled = 0
        while filled < states.shape[1]:
            at = self.done - self.read
            part = states[:, filled : filled + self.block.shape[1] - at]
            self.block[:, at : at + part.shape[1]] = part
            filled, self.done = filled + part.shape[1], self.done + part.shape[1]
            if self.done - self.read == self.block.shape[1]:
                self._hand_on()
        if self.sampling.told:
            self.sampling.told(self.done / len(self.sampling.times))

    def samples(self) -> Samples:
        """Held samples, when the run is over."""
        self._hand_on()
        times, held = self.sampling.times, self.sampling.held
        return Samples(times[: self.done], self.block[:, : self.done]) if held is None else Samples(held, self.held)

    def enough(self, t: float) -> bool:
        """True if the run may end at a time, up to which all samples are filled."""
        until = self.sampling.until
        if until is None or t not in until.times:
            return False
        return until.enough(Samples(self.sampling.times[: self.done], self.block[:, : self.done]))

    def _begin(self, states: int) -> None:
        times, held = self.sampling.times, self.sampling.held
        self.block = np.empty((states, len(times) if held is None else min(BLOCK, len(times))))
        self.held = np.empty((states, 0 if held is None else len(held)))

    def _hand_on(self) -> None:
        """The block to the readers, and what is held of it to its place."""
        if self.done == self.read:
            return
        block = Samples(self.sampling.times[self.read : self.done], self.block[:, : self.done - self.read])
        for read in self.sampling.readers:
            read(block)
        if self.sampling.held is not None:
            first = np.searchsorted(self.sampling.held, block.t[0])
            last = np.searchsorted(self.sampling.held, block.t[-1], side="right")
            self.held[:, first:last] = block.at(self.sampling.held[first:last])
        self.read = self.done
