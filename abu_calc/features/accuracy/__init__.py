"""`abu accuracy`: computing time against accuracy."""
