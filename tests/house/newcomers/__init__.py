"""An effect and a support that the package does not have: what the recipes of the README are tried with."""
