"""`abu levels`: octave levels, weighted acceleration and daily exposure of a motion."""
