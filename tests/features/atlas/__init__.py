"""Tests of the atlas in the package."""
