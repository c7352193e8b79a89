"""One file per effect: its equation and source, its force beside its energy or power, and what it weighs."""
