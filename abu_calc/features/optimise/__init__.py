"""`abu optimise`: the cheapest design of which a wanted share of all machines built meets the limits."""
