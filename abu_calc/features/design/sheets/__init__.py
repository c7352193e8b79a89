"""Sheets for the shop: the assembly with its items, and a sheet for each part that is made."""
