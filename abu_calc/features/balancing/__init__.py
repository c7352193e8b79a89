"""`abu balance`: balancing of a rotor in one plane or two from runs on a rig or in the field."""
