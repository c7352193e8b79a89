"""abu-calc."""
