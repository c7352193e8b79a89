"""Builders of supports: each turns a machine's springs, masses and dampers into one linear system and its race map."""
