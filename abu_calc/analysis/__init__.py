"""Quantities computed from a motion: amplitudes, levels, settling, and the trust in these numbers."""
