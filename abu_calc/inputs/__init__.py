"""Tables of the files that people write, as strict models in the units of their keys."""
