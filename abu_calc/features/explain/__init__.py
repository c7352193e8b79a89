"""`abu explain`: formulas of the steps, and the meaning of check codes."""
