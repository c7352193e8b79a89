"""Reading of files: TOML with places, overrides, messages of errors, schema and template."""
