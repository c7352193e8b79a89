"""Ground of the package: units, symbols, formulas as registered, checks, errors, records with quantities, progress."""
