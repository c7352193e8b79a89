"""Geometry of the parts that a shop makes: one frozen description in SI, for drawings, solids and checks alike.

`housing_parts` holds revolved outlines, what is asked of surfaces, and the parts of each design; `demands` the sizes.
"""
