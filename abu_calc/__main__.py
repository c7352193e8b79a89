"""`python -m abu_calc`."""

from abu_calc.cli.app import main

main()
