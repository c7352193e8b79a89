"""Drawings to scale: what is drawn is described once, by shapes on layers; DXF, SVG and characters are views of it."""
