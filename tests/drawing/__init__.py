"""Drawings: geometry, DXF, SVG, characters."""
