"""What is computed from a motion: amplitudes, levels, settling, and how far the numbers can be trusted."""
