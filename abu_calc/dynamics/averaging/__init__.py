"""Averaged slow motion of the balls, and the conditions under which it holds."""
