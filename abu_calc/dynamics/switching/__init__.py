"""Modes, which balls stick, which touch: what is decided where a scene switches."""
