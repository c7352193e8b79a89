"""Ground of the package: units, symbols, registered formulas, checks, errors, records, progress."""
