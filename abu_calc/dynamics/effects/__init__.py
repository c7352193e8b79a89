"""Effects: what acts in a scene beside its support, its races and the imbalance. One effect, one file."""
