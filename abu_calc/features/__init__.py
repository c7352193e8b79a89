"""Features: one folder for each thing people ask for, from its tables to its command.

Each holds what it needs of tables, theory, a study (input → one frozen, typed result), views, figures and `command`.
`abu_calc.registry` lists the commands. A feature imports only features before it in the order that a test holds.
"""
