"""How the autobalancer is made: eccentricity of the race by parts, fits, closure, fastening, bearing rings."""
