"""Bearing seats: limits, probability, losses, stress, recommendation; `seats.seat_bearing` does them all."""
