"""Geometry of the parts that a shop makes: one frozen description in SI, for drawings, solids and checks alike.

`profile` holds revolved outlines, `surfaces` what is asked of them, `housing_parts` the parts of each design.
"""
