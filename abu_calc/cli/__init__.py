"""The command line: one file per command, each load → call → render → exit status; `app` puts them together."""
