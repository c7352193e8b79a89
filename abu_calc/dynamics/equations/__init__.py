"""The one set of equations: from a scene to what is integrated."""
