"""`abu verify`: files held to the results they expect."""
