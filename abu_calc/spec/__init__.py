"""What people write: the tables of machine.toml as strict models, and their reading, schema and template.

`read.read_machine` is the way in; the models keep the units people wrote, nothing is converted to SI here.
"""
