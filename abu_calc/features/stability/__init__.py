"""`abu stability`: stability of the balanced state, and the speeds at which it changes."""
