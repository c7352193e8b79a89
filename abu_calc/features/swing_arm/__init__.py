"""Judgement of a machine on a swing arm: bounds, forced motion, instability region, scenes, sketch."""
