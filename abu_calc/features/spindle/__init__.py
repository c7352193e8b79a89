"""`abu size` of a machine with two races on one spindle."""
