"""`abu sweep`: many machines like one: share that meets the limits, percentiles, deciding values."""
