"""What people write: the tables of files as strict models, in the units of their keys."""
