"""Recorded runs: marks of revolutions, and amplitude and phase at the speed of rotation."""
