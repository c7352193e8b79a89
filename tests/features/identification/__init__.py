"""Tests of `abu identify`."""
