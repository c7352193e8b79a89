"""Modes, which balls stick, which touch, what a wheel does on its work: what is decided where a scene switches."""
