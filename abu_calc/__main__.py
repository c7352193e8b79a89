"""`python -m abu_calc`."""

from abu_calc.cli.start import main

main()
