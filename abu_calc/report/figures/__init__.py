"""What a result shows as figures: charts, drawings, a motion as data; who draws them is not said here."""
