"""Files that people write: the tables of machine.toml as strict models; reading, schema and template.

`read.read_machine` is the way in. The models keep the units of the file: nothing is converted to SI here.
"""
