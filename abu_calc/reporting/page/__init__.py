"""A result as one HTML file that opens anywhere: no network, light and dark, on paper without cut tables."""
