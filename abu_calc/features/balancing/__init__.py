"""`abu balance`: two-plane balancing of a roll from runs on a rig."""
