"""`abu compare`: machines, or variants of one, side by side."""
