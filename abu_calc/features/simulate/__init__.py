"""`abu simulate`: one scene integrated to the accuracy asked for."""
