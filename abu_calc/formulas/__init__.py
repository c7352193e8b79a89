"""Closed forms that sizing and dynamics share."""
