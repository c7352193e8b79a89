"""Faults on purpose: signals at every stage, killed workers, other versions, full and damaged stores."""
