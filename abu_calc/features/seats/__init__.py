"""`abu check-fit`: bearing seats: interference, probability, creep, stress, clearance, tolerance classes."""
