"""`abu validate`, `abu init`, `abu presets`, `abu schema`: files that people write, and schemas."""
