"""The balanced state: where balls rest, small motions about it, and whether they die out."""
