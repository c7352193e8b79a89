"""The balanced state: resting places of the balls, small motions about them, and whether these die out."""
