"""Drawings to scale, described once by shapes on layers; DXF, SVG and characters are views of them."""
