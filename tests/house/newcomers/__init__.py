"""An effect and a support that the package does not have: the recipes of docs/contributing.md are tried with them."""
