"""The version, read by the build and by `abu --version`."""

__version__ = "0.1.0"
