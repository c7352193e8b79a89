"""Averaged slow motion of the balls, and where it holds."""
