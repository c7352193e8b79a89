"""Formulas that sizing and dynamics share: ball ring, slow motion, contact, suspension, swing arm, friction band."""
