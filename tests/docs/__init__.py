"""Tests of the documentation's sources; CI builds the site itself."""
