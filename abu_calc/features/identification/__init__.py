"""`abu identify`: viscous drag rate, rolling friction and race eccentricity of a machine, from recorded starts."""
