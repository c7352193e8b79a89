"""`abu effects`: the effects of the model, and those that a scene is simulated with."""
