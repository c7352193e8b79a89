"""Figures of a result: charts, drawings, a motion as data. The code that draws them is elsewhere."""
