"""Modes of motion: which balls stick, which touch, how a wheel moves on its workpiece."""
