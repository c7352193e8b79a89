"""`abu factory`: levels that a factory measured of its machines, beside predictions."""
