"""`abu accuracy`: what accuracy costs in time."""
