"""Published statements that no single command of abu-calc shows, worked out again for the validation page."""
