"""`abu simulate`: one scene integrated to a requested accuracy."""
