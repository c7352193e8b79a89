"""Parts of the command line that all commands share: application, options, output, progress."""
