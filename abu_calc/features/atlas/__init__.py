"""Atlas of autobalancing: dimensionless charts, and the place of a machine on those whose fixed numbers it has."""
