"""Atlas of autobalancing: dimensionless charts defined as data, with a runner that goes on where it stopped."""
