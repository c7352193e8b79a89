"""Solids of revolution and their assembly, and the STEP file that CAD programs read them from."""
